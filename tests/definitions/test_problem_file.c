/* Problem files as a whole: headers, overrides, positions, damage, memory. */
#include "base/diagnostics.h"
#include "ambulo/tools/load.h"
#include "ambulo/tools/tools.h"
#include "definitions/problem_text.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"

#define REST "time: {duration: 1, intervals: 4}\nobjective: none\n"

static void the_smallest_problem_loads(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(PENDULUM REST);
  assert_string_equal(ambulo_problem_name(p), "problem");
  assert_string_equal(ambulo_model_name(ambulo_problem_model(p)), "pendulum");
  assert_int_equal(ambulo_problem_node_count(p), 5);
  assert_int_equal(ambulo_problem_variable_count(p), 7);
  assert_int_equal(ambulo_problem_row_count(p), 0);
  assert_int_equal(ambulo_problem_term_count(p), 0);
  ambulo_problem_free(p);
}

static void every_shipped_problem_loads(void **state) {
  (void)state;
  static const char *const names[] = {"yardstick_12",          "fig5a_feasible", "fig5b_torque",
                                      "walk_without_reaction", "pendulum_swing", "two_link_reach",
                                      "walker_2d_step",        "yardstick_36",   "yardstick_72"};
  for (int i = 0; i < 9; i++) {
    char path[64];
    (void)snprintf(path, sizeof path, "models/%s.yaml", names[i]);
    ambulo_problem *p = NULL;
    assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &p), AMBULO_OK);
    assert_string_equal(ambulo_problem_name(p), names[i]);
    ambulo_problem_free(p);
  }
}

/* the first example of docs/problem-format.md */
static void the_documented_example_loads(void **state) {
  (void)state;
  char text[32768];
  FILE *stream = fopen("docs/problem-format.md", "r");
  assert_non_null(stream);
  text[fread(text, 1, sizeof text - 1, stream)] = '\0';
  fclose(stream);
  char *begin = strstr(text, "```yaml\n");
  assert_non_null(begin);
  begin += 8;
  char *end = strstr(begin, "```");
  assert_non_null(end);
  *end = '\0';
  ambulo_problem *p = problem_of(begin);
  assert_string_equal(ambulo_problem_name(p), "stroll");
  assert_close(ambulo_problem_duration(p), 2.4, 1e-14);
  ambulo_problem_free(p);
}

static void the_subject_scales_the_model(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(WALKER "subject: {mass: 60, stature: 1.6, sex: female}\n" REST);
  assert_close(ambulo_model_mass(ambulo_problem_model(p)), 60.0, 1e-9);
  assert_close(ambulo_model_stature(ambulo_problem_model(p)), 1.6, 1e-12);
  ambulo_problem_free(p);
  expect_refusal(WALKER "subject: {mass: -1}\n" REST, AMBULO_E_SCHEMA, "p.yaml:4:17: error");
}

static void headers_are_checked(void **state) {
  (void)state;
  expect_refusal("kind: problem\nmodel: pendulum.yaml\n" REST, AMBULO_E_SCHEMA,
                 "missing required key 'ambulo'");
  expect_refusal("ambulo: 2\nkind: problem\nmodel: pendulum.yaml\n" REST, AMBULO_E_SCHEMA,
                 "p.yaml:1:9: error[E_SCHEMA]: format version 2 is not supported; expected 1");
  expect_refusal("ambulo: 1\nkind: modle\n" REST, AMBULO_E_SCHEMA, "p.yaml:2:7: error[E_SCHEMA]");
  expect_refusal("ambulo: 1\nkind: problem\n" REST, AMBULO_E_SCHEMA,
                 "missing required key 'model'");
  expect_refusal(PENDULUM "objective: none\n", AMBULO_E_SCHEMA, "missing required key 'time'");
  expect_refusal(PENDULUM "time: {duration: 1, intervals: 4}\n", AMBULO_E_SCHEMA,
                 "missing required key 'objective'");
  expect_refusal(PENDULUM "objectiv: none\n" REST, AMBULO_E_SCHEMA,
                 "p.yaml:4:1: error[E_SCHEMA]: "
                 "unknown key 'objectiv'");
  expect_refusal(PENDULUM "solver: fast\n" REST, AMBULO_E_SCHEMA, "'solver' is not a mapping");
  expect_refusal("[1, 2]\n", AMBULO_E_SCHEMA, "mapping");
}

static void a_missing_model_is_named(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *p = NULL;
  ambulo_status status =
      load_text("ambulo: 1\nkind: problem\nmodel: no_such.yaml\n" REST, list, &p);
  assert_int_equal(status, AMBULO_E_IO);
  assert_null(p);
  assert_message(list, 0, "models/no_such.yaml");
  assert_message(list, 1, "p.yaml:3:8: error[E_IO]: the model 'models/no_such.yaml'");
  ambulo_diagnostics_free(list);
}

/* faults that only ambulo_problem_create() can see get the place of the key they are about */
static void contradictions_have_a_place(void **state) {
  (void)state;
  expect_refusal(WALKER "time: {duration: 1, intervals: 4}\n"
                        "objective: none\n"
                        "constraints: {foot_strike: true}\n"
                        "contacts:\n"
                        "  - {foot: left, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                        "  - {foot: left, mode: toe, from: 0.5, to: 1, place: [0, 0]}\n",
                 AMBULO_E_PROBLEM,
                 "p.yaml:8:5: error[E_PROBLEM]: contacts[0] and contacts[1] overlap");
  expect_refusal(PENDULUM "time: {duration: 1, intervals: 4}\n"
                          "objective:\n"
                          "  - {term: torque_squared, weight: 0}\n",
                 AMBULO_E_PROBLEM, "every objective weight is 0");
}

static void overrides_come_first(void **state) {
  (void)state;
  const char *text = PENDULUM REST;
  const char *const good[] = {"time.intervals=36", "name=swing", "time.duration=2.5",
                              "solver.continuation=off"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = strlen(text),
                                                      .directory = "models/",
                                                      .overrides = good,
                                                      .override_count = 4},
                               NULL, NULL, &p),
      AMBULO_OK);
  assert_int_equal(ambulo_problem_node_count(p), 37);
  assert_close(ambulo_problem_duration(p), 2.5, 0.0);
  assert_string_equal(ambulo_problem_name(p), "swing");
  assert_int_equal(ambulo_problem_options(p).continuation, 0);
  ambulo_problem_free(p);
  p = NULL;
  static const struct {
    const char *text;
    ambulo_status status;
  } bad[] = {{"intervals", AMBULO_E_ARGUMENT},
             {"=3", AMBULO_E_ARGUMENT},
             {"tim.intervals=3", AMBULO_E_SCHEMA},
             {"time.intervals=many", AMBULO_E_SCHEMA},
             {"time.interval=3", AMBULO_E_SCHEMA}};
  for (int i = 0; i < 5; i++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_status status =
        ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                        .text = text,
                                                        .length = strlen(text),
                                                        .directory = "models",
                                                        .overrides = &bad[i].text,
                                                        .override_count = 1},
                                 NULL, list, &p);
    if (status != bad[i].status) print_error("override %s\n", bad[i].text);
    assert_int_equal(status, bad[i].status);
    assert_null(p);
    assert_true(ambulo_diagnostics_count(list) > 0);
    ambulo_diagnostics_free(list);
  }
}

static void arguments_are_checked(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load(NULL, NULL, 0, NULL, NULL, &p), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("x", NULL, 1, NULL, NULL, &p), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("x", NULL, 0, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_load("models", NULL, 0, NULL, NULL, &p), AMBULO_E_IO);
}

/* cut off at any byte, a file is read as a smaller problem or refused, never half accepted */
static void damaged_files_are_survived(void **state) {
  (void)state;
  const char *text = PENDULUM "angles: degrees\n"
                              "time: {duration: 1, intervals: 4}\n"
                              "trajectory: {basis: bspline, breakpoints: [0, 0.4, 1]}\n"
                              "ends: {initial: {swing: 3}, final: {swing: 90}}\n"
                              "solver: {algorithm: slsqp, continuation: off}\n"
                              "objective: [{term: torque_squared, scale: {swing: 2}}]\n";
  size_t length = strlen(text);
  for (size_t cut = 0; cut < length; cut++) {
    ambulo_problem *p = NULL;
    ambulo_status status =
        ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                        .text = text,
                                                        .length = cut,
                                                        .directory = "models"},
                                 NULL, NULL, &p);
    if (cut + 1 < length) assert_int_not_equal(status, AMBULO_OK);
    assert_true((status == AMBULO_OK) == (p != NULL));
    ambulo_problem_free(p);
  }
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  const char *text = PENDULUM "time: {duration: 1, intervals: 2}\n"
                              "ends: {initial_speed: {swing: 0}}\n"
                              "angles: radians\n"
                              "objective: [{term: torque_squared}]\n";
  const char *const overrides[] = {"time.intervals=3"};
  for (long k = 0; k < 5000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_problem *p = NULL;
    ambulo_status status =
        ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                        .text = text,
                                                        .length = strlen(text),
                                                        .name = "p",
                                                        .directory = "models",
                                                        .overrides = overrides,
                                                        .override_count = 1},
                                 &allocator, list, &p);
    if (memory.failed) assert_int_equal(status, AMBULO_E_MEMORY);
    ambulo_problem_free(p);
    ambulo_diagnostics_free(list);
    if (memory.live != 0) print_error("%ld blocks lost when request %ld fails\n", memory.live, k);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      return;
    }
  }
  fail_msg("more than 5000 allocations");
}

/* What a YAML file says it is. */

static void test_kinds(void **state) {
  ambulo_file_kind kind = AMBULO_FILE_MODEL;
  const char *path = scratch_path(state, "file.yaml");
  scratch_write(path, "ambulo: 1\nkind: problem\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, NULL, &kind), AMBULO_OK);
  assert_int_equal(kind, AMBULO_FILE_PROBLEM);
  scratch_write(path, "ambulo: 1\nkind: model\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, NULL, &kind), AMBULO_OK);
  assert_int_equal(kind, AMBULO_FILE_MODEL);
}

static void test_neither(void **state) {
  ambulo_file_kind kind = AMBULO_FILE_PROBLEM;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *path = scratch_path(state, "file.yaml");
  scratch_write(path, "ambulo: 1\nkind: modell\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, list, &kind), AMBULO_E_SCHEMA);
  assert_message(list, 0, "file.yaml:2:7: error[E_SCHEMA]");
  ambulo__diagnostics_clear(list);
  scratch_write(path, "ambulo: 1\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, list, &kind), AMBULO_E_SCHEMA);
  assert_message(list, 0, "'kind'");
  scratch_write(path, "a: [\n");
  assert_int_equal(ambulo_file_kind_of(path, NULL, NULL, &kind), AMBULO_E_PARSE);
  assert_int_equal(ambulo_file_kind_of(scratch_path(state, "none"), NULL, NULL, &kind),
                   AMBULO_E_IO);
  assert_int_equal(kind, AMBULO_FILE_PROBLEM);
  ambulo_diagnostics_free(list);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_smallest_problem_loads),
                                     cmocka_unit_test(every_shipped_problem_loads),
                                     cmocka_unit_test(the_documented_example_loads),
                                     cmocka_unit_test(the_subject_scales_the_model),
                                     cmocka_unit_test(headers_are_checked),
                                     cmocka_unit_test(a_missing_model_is_named),
                                     cmocka_unit_test(contradictions_have_a_place),
                                     cmocka_unit_test(overrides_come_first),
                                     cmocka_unit_test(arguments_are_checked),
                                     cmocka_unit_test(damaged_files_are_survived),
                                     cmocka_unit_test(memory_may_run_out_anywhere),
                                     SCRATCH_TEST(test_kinds),
                                     SCRATCH_TEST(test_neither)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
