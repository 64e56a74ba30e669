/* Solves of trials: which cases are asked for, what they start from, what is scored, failures. */
#include "support/fit_runner.h"

#define CHAIN                                                                                      \
  "conditions:\n  - {name: slow, reference: slow.csv, weight: 3}\n"                                \
  "  - {name: quick, after: slow, set: {time.duration: 0.7}, reference: quick.csv}\n"              \
  "  - {name: apart, set: {time.duration: 0.8}, reference: quick.csv, held_out: true}\n"
#define TEXT                                                                                       \
  FIT_HEAD FIT_PARAMETERS CHAIN                                                                    \
      "distance: {curves: {pin: 1, top: {curve: pin, of: peak, weight: 2}}}\n"

static double sum_of(const fit_runner *w, const ambulo__fit_trial *t) {
  double sum = 0.0;
  for (int k = 0; k < w->sizes.residuals; k++) sum += t->residual[k] * t->residual[k];
  return sum;
}

static void scopes_and_starts(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  ambulo__fit_trial *t = w.trial;
  ambulo__fit_runner *r = &w.runner;
  assert_int_equal(ambulo__fit_evaluate(r, AMBULO__FIT_ALL, NULL, &t[0], 1), AMBULO_OK);
  const ambulo__sweep_case *cases = r->sweep->cases;
  assert_int_equal(r->sweep->case_count, 3);
  assert_true(t[0].complete && t[0].solved[0] && t[0].solved[1] && t[0].solved[2]);
  assert_int_equal(cases[t[0].index[0]].previous, -1);
  assert_int_equal(cases[t[0].index[1]].previous, t[0].index[0]); /* after */
  assert_int_equal(cases[t[0].index[2]].previous, -1);
  /* the next ones start from it, held-out ones are left alone */
  t[1].u[0] = 1.0;
  t[2].u[0] = 2.0;
  assert_int_equal(ambulo__fit_evaluate(r, AMBULO__FIT_FITTED, &t[0], &t[1], 2), AMBULO_OK);
  assert_int_equal(r->sweep->case_count, 7);
  cases = r->sweep->cases;
  for (int i = 1; i < 3; i++)
    for (int c = 0; c < 2; c++) assert_int_equal(cases[t[i].index[c]].previous, t[0].index[c]);
  assert_int_equal(t[1].index[2], -1);
  assert_true(isnan(t[1].apart[2]));
  /* asked for again, it is the same case */
  t[3].u[0] = 1.0;
  assert_int_equal(ambulo__fit_evaluate(r, AMBULO__FIT_FITTED, &t[0], &t[3], 1), AMBULO_OK);
  assert_int_equal(r->sweep->case_count, 7);
  assert_int_equal(t[3].index[1], t[1].index[1]);
  assert_true(t[3].distance == t[1].distance);
  /* held-out ones alone, and all from zero: slow from zero has been solved already */
  assert_int_equal(ambulo__fit_evaluate(r, AMBULO__FIT_HELD_OUT, &t[0], &t[4], 1), AMBULO_OK);
  assert_int_equal(t[4].index[0], -1);
  assert_int_equal(r->sweep->cases[t[4].index[2]].previous, t[0].index[2]);
  assert_int_equal(ambulo__fit_evaluate(r, AMBULO__FIT_FROM_ZERO, NULL, &t[5], 1), AMBULO_OK);
  for (int c = 0; c < 3; c++) assert_int_equal(r->sweep->cases[t[5].index[c]].previous, -1);
  assert_int_equal(t[5].index[0], t[0].index[0]);
  fit_runner_close(&w);
}

static void distances(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  ambulo__fit_trial *t = w.trial;
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, t, 1), AMBULO_OK);
  assert_close(sum_of(&w, t), t->distance, 1e-12);
  /* each by its weights: curves 1 and 2, conditions 3 and 1 */
  double z[3];
  for (int c = 0; c < 3; c++) {
    z[c] = (t->score[2 * c].z + 2.0 * t->score[2 * c + 1].z) / 3.0;
    assert_close(t->apart[c], z[c], 1e-12);
    assert_true(z[c] > 0.1);
  }
  assert_close(t->distance, (3.0 * z[0] + z[1]) / 4.0, 1e-12);
  fit_runner_close(&w);
}

static void failures(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  w.options.program = "/bin/false";
  ambulo__fit_trial *t = w.trial;
  char word[24];
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, t, 1), AMBULO_OK);
  assert_true(t->complete);
  assert_false(t->solved[0]);
  assert_close(t->distance, 24.0, 1e-12); /* twice the cap */
  assert_close(sum_of(&w, t), 24.0, 1e-12);
  assert_int_equal(ambulo__fit_state(&w.runner, t->index[0], word), AMBULO_OK);
  assert_string_equal(word, "error");
  assert_int_equal(ambulo__fit_state(&w.runner, -1, word), AMBULO_OK);
  assert_string_equal(word, "missing");
  assert_int_equal(w.runner.progress.failed, 3);
  fit_runner_close(&w);
}

static int stop_now(void *user, const ambulo_fit_progress *p) {
  (void)user;
  (void)p;
  return 1;
}

static void a_stop(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  w.options.progress = stop_now;
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, w.trial, 1), AMBULO_OK);
  assert_false(w.trial->complete);
  fit_runner_close(&w);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(scopes_and_starts), TEST(distances), TEST(failures),
                                     TEST(a_stop)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
