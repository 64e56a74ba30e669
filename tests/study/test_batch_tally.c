/* Cases by state, and what the first one without a result said. */
#include "study/batch.h"
#include "support/sweep_files.h"

static const char four[] = "axes:\n  - {key: time.duration, name: T, values: [1, 2, 3, 4]}\n"
                           "case_name: \"T {T}\"\n";

static ambulo__record ended(const char *state, int result) {
  ambulo__record r = {.valid = strcmp(state, "optimal") == 0};
  (void)snprintf(r.state, sizeof r.state, "%s", state);
  r.files.count = result;
  if (result)
    (void)snprintf(r.files.file[0].ending, sizeof r.files.file[0].ending, "/summary.json");
  return r;
}

static void states_are_counted_and_the_first_refusal_is_kept(void **state) {
  ambulo_sweep *sweep = NULL;
  ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  assert_int_equal(sweep_load(state, four, NULL, &sweep), AMBULO_OK);
  ambulo__supervisor batch = {.sweep = sweep, .directory = *state, .allocator = &plain};
  const ambulo__record good = ended("optimal", 1), bad = ended("invalid", 0),
                       far = ended("infeasible", 1);
  ambulo__tally_case(&batch, 0, &good, "");
  assert_string_equal(batch.progress.refusal, "");
  ambulo__tally_case(&batch, 1, &far, "a warning\n");
  assert_string_equal(batch.progress.refusal, "");
  ambulo__tally_case(&batch, 2, &bad,
                     "p.yaml: warning: w\np.yaml:1:2: error[E_SCHEMA]: no\nmore\n");
  ambulo__tally_case(&batch, 3, &bad, "p.yaml:9:9: error[E_SCHEMA]: another\n");
  const ambulo_batch_progress *p = &batch.progress;
  assert_string_equal(p->refusal, "case 'T 3' (invalid): p.yaml:1:2: error[E_SCHEMA]: no");
  assert_int_equal(p->done, 4);
  assert_int_equal(p->failed, 3);
  assert_int_equal(p->no_result, 2);
  assert_string_equal(p->tally[2].state, "invalid");
  assert_int_equal(p->tally[0].cases, 1);
  assert_int_equal(p->tally[1].cases, 1);
  assert_int_equal(p->tally[2].cases, 2);
  assert_int_equal(p->tally[3].cases, 0);
  ambulo_sweep_free(sweep);
}

/* neither words nor a log: its state is told all the same */
static void silence_is_told_by_its_state(void **state) {
  ambulo_sweep *sweep = NULL;
  ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  assert_int_equal(sweep_load(state, four, NULL, &sweep), AMBULO_OK);
  ambulo__supervisor batch = {.sweep = sweep, .directory = *state, .allocator = &plain};
  const ambulo__record cut = ended("timeout", 0);
  ambulo__tally_case(&batch, 3, &cut, NULL);
  assert_string_equal(batch.progress.refusal, "case 'T 4' (timeout)");
  ambulo_sweep_free(sweep);
}

static void the_first_error_is_a_whole_line(void **state) {
  (void)state;
  const char log[] = "x: warning\nfile:1: error[E_IO]: a\nerror[E_IO]: b";
  assert_ptr_equal(ambulo__first_error(log), strstr(log, "file:1"));
  assert_ptr_equal(ambulo__first_error(log + 34), strstr(log, "error[E_IO]: b"));
  assert_null(ambulo__first_error("all is well"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(states_are_counted_and_the_first_refusal_is_kept,
                                      scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(silence_is_told_by_its_state, scratch_open, scratch_close),
      cmocka_unit_test(the_first_error_is_a_whole_line),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
