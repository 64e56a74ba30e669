/* Solves from zero take the place of solutions with a greater objective, and of nothing else. */
#include "support/fit_runner.h"

/* t[1] stands at u = 0, but follows the solutions of t[0], whose prices are others */
static void follow(fit_runner *w, double u) {
  ambulo__fit_trial *t = w->trial;
  t[0].u[0] = u;
  assert_int_equal(ambulo__fit_evaluate(&w->runner, AMBULO__FIT_ALL, NULL, &t[0], 1), AMBULO_OK);
  ambulo__fit_trial_copy(&w->sizes, &t[0], &t[1]);
  t[1].u[0] = 0.0;
}

static void a_worse_one_is_replaced(void **state) {
  fit_runner w;
  fit_runner_open(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE, &w);
  ambulo__fit_trial *t = w.trial;
  follow(&w, 3.0); /* dearer: a greater objective */
  assert_int_equal(ambulo__fit_refresh(&w.runner, &w.sizes, &t[1]), AMBULO_OK);
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, &t[2], 1), AMBULO_OK);
  for (int c = 0; c < 2; c++) {
    assert_int_equal(t[1].index[c], t[2].index[c]);
    assert_true(t[1].apart[c] == t[2].apart[c]);
    assert_true(t[1].score[c].z == t[2].score[c].z);
  }
  for (int k = 0; k < w.sizes.residuals; k++) assert_true(t[1].residual[k] == t[2].residual[k]);
  assert_close(t[1].distance, t[2].distance, 1e-12);
  assert_true(t[1].distance != t[0].distance);
  fit_runner_close(&w);
}

static void a_better_one_stays(void **state) {
  fit_runner w;
  fit_runner_open(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE, &w);
  ambulo__fit_trial *t = w.trial;
  follow(&w, -3.0); /* cheaper: a lesser objective */
  assert_int_equal(ambulo__fit_refresh(&w.runner, &w.sizes, &t[1]), AMBULO_OK);
  for (int c = 0; c < 2; c++) assert_int_equal(t[1].index[c], t[0].index[c]);
  assert_close(t[1].distance, t[0].distance, 1e-12);
  fit_runner_close(&w);
}

static void one_that_failed_is_replaced(void **state) {
  fit_runner w;
  fit_runner_open(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE, &w);
  ambulo__fit_trial *t = w.trial;
  follow(&w, -3.0);
  t[1].solved[1] = 0;
  assert_int_equal(ambulo__fit_refresh(&w.runner, &w.sizes, &t[1]), AMBULO_OK);
  assert_int_equal(t[1].index[0], t[0].index[0]);
  assert_int_not_equal(t[1].index[1], t[0].index[1]);
  assert_true(t[1].solved[1]);
  fit_runner_close(&w);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(a_worse_one_is_replaced), TEST(a_better_one_stays),
                                     TEST(one_that_failed_is_replaced)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
