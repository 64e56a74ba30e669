/* Limits and the caller's word end a run, and the first reason stays. */
#include "solver/run.h"
#include "support/test.h"

static int stop_at_three(void *user, const ambulo_progress *progress) {
  (void)user;
  return progress->iteration >= 3;
}

static void evaluations_run_out(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.maximum_evaluations = 2;
  ambulo__run_begin(&run, &options);
  assert_int_equal(ambulo__run_count(&run), 0);
  assert_int_equal(ambulo__run_count(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_EVALUATIONS);
}

static void time_runs_out(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.time_limit = 1e-9;
  ambulo__run_begin(&run, &options);
  run.started -= 1.0;
  assert_int_equal(ambulo__run_over(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_TIME);
}

static void caller_says_stop(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.progress = stop_at_three;
  ambulo__run_begin(&run, &options);
  run.iterations = 2;
  assert_int_equal(ambulo__run_progress(&run, 1.0, 0.0), 0);
  run.iterations = 3;
  assert_int_equal(ambulo__run_progress(&run, 1.0, 0.0), 1);
  run.evaluations = options.maximum_evaluations;
  assert_int_equal(ambulo__run_over(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_CALLER);
}

/* within an iteration, not only after it */
static void caller_is_asked_while_evaluations_are_counted(void **state) {
  (void)state;
  ambulo_options options = ambulo_options_default();
  ambulo__run run;
  options.progress = stop_at_three;
  ambulo__run_begin(&run, &options);
  run.iterations = 3;
  run.polled_at += 1e9;
  assert_int_equal(ambulo__run_count(&run), 0);
  run.polled_at -= 2e9;
  assert_int_equal(ambulo__run_count(&run), 1);
  assert_int_equal(run.ending, AMBULO_ENDING_CALLER);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(evaluations_run_out), cmocka_unit_test(time_runs_out),
      cmocka_unit_test(caller_says_stop),
      cmocka_unit_test(caller_is_asked_while_evaluations_are_counted)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
