/* What every caller relies on: NULL may be freed, failures leave outputs alone, options come
 * from their default function, and memory comes from the caller's allocator and goes back to it
 * whichever request fails. */
#include "support/arm.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void null_may_be_freed(void **state) {
  (void)state;
  ambulo_model_free(NULL);
  ambulo_mechanics_free(NULL);
  ambulo_problem_free(NULL);
  ambulo_workspace_free(NULL);
  ambulo_result_free(NULL);
  ambulo_diagnostics_free(NULL);
  ambulo_text_free(NULL, NULL);
  assert_int_equal(ambulo_diagnostics_count(NULL), 0);
  assert_int_equal(ambulo_diagnostics_error_count(NULL), 0);
}

static void every_status_and_verdict_has_words(void **state) {
  (void)state;
  for (int s = AMBULO_OK; s <= AMBULO_E_INTERNAL; s++) {
    assert_true(strlen(ambulo_status_name((ambulo_status)s)) > 1);
    assert_true(strlen(ambulo_status_text((ambulo_status)s)) > 1);
  }
  assert_int_equal(ambulo_status_exit_code(AMBULO_E_SCHEMA), 3);
  assert_int_equal(ambulo_status_exit_code(AMBULO_E_MEMORY), 5);
  assert_non_null(ambulo_status_name((ambulo_status)999));
  for (int v = AMBULO_OPTIMAL; v <= AMBULO_FEASIBLE_AT_NODES; v++)
    assert_true(strlen(ambulo_verdict_text((ambulo_verdict)v)) > 1);
  assert_string_equal(ambulo_version(), AMBULO_VERSION_STRING);
}

static void zero_filled_definitions_and_options_are_refused(void **state) {
  (void)state;
  ambulo_model_definition no_model;
  ambulo_problem_definition no_problem;
  ambulo_options no_options;
  memset(&no_model, 0, sizeof no_model);
  memset(&no_problem, 0, sizeof no_problem);
  memset(&no_options, 0, sizeof no_options);
  ambulo_model *model = (ambulo_model *)&no_model, *before = model;
  assert_int_equal(ambulo_model_create(&no_model, NULL, NULL, &model), AMBULO_E_ARGUMENT);
  assert_ptr_equal(model, before);
  model = arm_create();
  ambulo_problem *problem = NULL;
  no_problem.model = model;
  assert_int_equal(ambulo_problem_create(&no_problem, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
  assert_null(problem);
  ambulo_problem_definition definition = arm_definition(model);
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, &no_options, NULL, NULL, NULL, &result),
                   AMBULO_E_ARGUMENT);
  assert_null(result);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

static void a_missing_file_is_said_and_leaves_the_output_alone(void **state) {
  (void)state;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_load("no/such/file.yaml", NULL, 0, NULL, messages, &problem),
                   AMBULO_E_IO);
  assert_null(problem);
  assert_int_equal(ambulo_diagnostics_error_count(messages), 1);
  char text[400];
  size_t length = ambulo_diagnostics_format(messages, 0, text, sizeof text);
  assert_int_equal(length, strlen(text));
  assert_non_null(strstr(text, "no/such/file.yaml"));
  assert_non_null(strstr(text, "E_IO"));
  ambulo_diagnostics_free(messages);
}

/* model, problem, solve and audit with memory that gives out at request k */
static ambulo_status whole_life(const ambulo_allocator *memory) {
  static const char text[] = "links: [";
  ambulo_model *broken = NULL;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(memory);
  ambulo_status status =
      ambulo_model_load_text(text, sizeof text - 1, "text", NULL, memory, messages, &broken);
  ambulo_diagnostics_free(messages);
  if (status == AMBULO_OK) return AMBULO_E_INTERNAL;
  if (status == AMBULO_E_MEMORY) return status;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  definition.intervals = 6;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_options_default();
  options.maximum_evaluations = 5;
  status = ambulo_problem_create(&definition, memory, NULL, &problem);
  if (!status) status = ambulo_solve(problem, &options, NULL, memory, NULL, &result);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
  return status;
}

static void no_request_for_memory_may_leak_when_it_fails(void **state) {
  (void)state;
  long k = 0;
  for (; k < 20000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_status status = whole_life(&allocator);
    if (memory.live) print_error("request %ld failed: %ld blocks leaked\n", k, memory.live);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      break;
    }
    if (status != AMBULO_E_MEMORY)
      print_error("request %ld failed: status %s\n", k, ambulo_status_name(status));
    assert_int_equal(status, AMBULO_E_MEMORY);
  }
  assert_true(k > 20 && k < 20000);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(null_may_be_freed),
      cmocka_unit_test(every_status_and_verdict_has_words),
      cmocka_unit_test(zero_filled_definitions_and_options_are_refused),
      cmocka_unit_test(a_missing_file_is_said_and_leaves_the_output_alone),
      cmocka_unit_test(no_request_for_memory_may_leak_when_it_fails),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
