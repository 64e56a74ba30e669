/* Trials: their memory, copies, the cost. */
#include "support/fit_runner.h"
#include "support/fit_task.h"

static void blocks_do_not_overlap(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  ambulo_fit fit = {.residuals = 7};
  ambulo__fit_trial *t = ambulo__fit_trials_make(&fit, 4, &allocator);
  for (int i = 0; i < 4; i++) {
    assert_true(t[i].u[2] == 0.0 && !t[i].complete && isnan(t[i].distance));
    assert_int_equal(t[i].index[2], -1);
    assert_true(isnan(t[i].apart[0]));
  }
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < 3; k++) t[i].u[k] = i;
    for (int k = 0; k < 7; k++) t[i].residual[k] = 10 + i;
    for (int k = 0; k < 3; k++) t[i].apart[k] = 20 + i;
    t[i].score[2][4].z = 30 + i;
    for (int k = 0; k < 3; k++) t[i].index[k] = 40 + i;
    for (int k = 0; k < 3; k++) t[i].solved[k] = 50 + i;
  }
  ambulo__fit_trial_copy(&fit, &t[1], &t[3]);
  for (int i = 0; i < 4; i++) {
    int from = i == 3 ? 1 : i;
    for (int k = 0; k < 3; k++) assert_true(t[i].u[k] == from);
    for (int k = 0; k < 7; k++) assert_true(t[i].residual[k] == 10 + from);
    for (int k = 0; k < 3; k++) assert_true(t[i].apart[k] == 20 + from);
    assert_true(t[i].score[2][4].z == 30 + from);
    for (int k = 0; k < 3; k++) assert_int_equal(t[i].index[k], 40 + from);
    for (int k = 0; k < 3; k++) assert_int_equal(t[i].solved[k], 50 + from);
  }
  allocator.resize(allocator.user, t, 0);
  assert_int_equal(memory.live, 0);
}

static void the_cost(void **state) {
  (void)state;
  fit_made_up w = {.scale = 5.0};
  ambulo__fit_trial *t;
  fit_made_up_open(&w, &t);
  w.fit.ridge = 0.5;
  t->distance = 2.0;
  t->u[0] = 3.0;
  t->u[1] = -1.0;
  assert_close(ambulo__fit_cost(&w.fit, t), 2.0 + 0.5 * 10.0 / 2.0, 1e-15);
  fit_made_up_close(&w, t);
}

/* Solves of trials: which cases are asked for, what they start from, what is scored, failures. */

#define CHAIN                                                                                      \
  "conditions:\n  - {name: slow, reference: slow.csv, weight: 3}\n"                                \
  "  - {name: quick, after: slow, set: {time.duration: 0.7}, reference: quick.csv}\n"              \
  "  - {name: apart, set: {time.duration: 0.8}, reference: quick.csv, held_out: true}\n"
#define TEXT                                                                                       \
  FIT_HEAD FIT_PARAMETERS CHAIN                                                                    \
      "distance: {curves: {pin: 1, top: {curve: pin, of: peak, weight: 2}}}\n"

static double sum_of(const fit_runner *w, const ambulo__fit_trial *t) {
  double sum = 0.0;
  for (int k = 0; k < w->fit->residuals; k++) sum += t->residual[k] * t->residual[k];
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
    z[c] = (t->score[c][0].z + 2.0 * t->score[c][1].z) / 3.0;
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

/* Solves from zero take the place of solutions with a greater objective, and of nothing else. */

/* t[1] stands at u = 0, but follows the solutions of t[0], whose prices are others */
static void follow(fit_runner *w, double u) {
  ambulo__fit_trial *t = w->trial;
  t[0].u[0] = u;
  assert_int_equal(ambulo__fit_evaluate(&w->runner, AMBULO__FIT_ALL, NULL, &t[0], 1), AMBULO_OK);
  ambulo__fit_trial_copy(w->fit, &t[0], &t[1]);
  t[1].u[0] = 0.0;
}

static void a_worse_one_is_replaced(void **state) {
  fit_runner w;
  fit_runner_open(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE, &w);
  ambulo__fit_trial *t = w.trial;
  follow(&w, 3.0); /* dearer: a greater objective */
  assert_int_equal(ambulo__fit_refresh(&w.runner, &t[1]), AMBULO_OK);
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, &t[2], 1), AMBULO_OK);
  for (int c = 0; c < 2; c++) {
    assert_int_equal(t[1].index[c], t[2].index[c]);
    assert_true(t[1].apart[c] == t[2].apart[c]);
    assert_true(t[1].score[c][0].z == t[2].score[c][0].z);
  }
  for (int k = 0; k < w.fit->residuals; k++) assert_true(t[1].residual[k] == t[2].residual[k]);
  assert_close(t[1].distance, t[2].distance, 1e-12);
  assert_true(t[1].distance != t[0].distance);
  fit_runner_close(&w);
}

static void a_better_one_stays(void **state) {
  fit_runner w;
  fit_runner_open(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE, &w);
  ambulo__fit_trial *t = w.trial;
  follow(&w, -3.0); /* cheaper: a lesser objective */
  assert_int_equal(ambulo__fit_refresh(&w.runner, &t[1]), AMBULO_OK);
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
  assert_int_equal(ambulo__fit_refresh(&w.runner, &t[1]), AMBULO_OK);
  assert_int_equal(t[1].index[0], t[0].index[0]);
  assert_int_not_equal(t[1].index[1], t[0].index[1]);
  assert_true(t[1].solved[1]);
  fit_runner_close(&w);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(blocks_do_not_overlap),
      cmocka_unit_test(the_cost),
      TEST(scopes_and_starts),
      TEST(distances),
      TEST(failures),
      TEST(a_stop),
      TEST(a_worse_one_is_replaced),
      TEST(a_better_one_stays),
      TEST(one_that_failed_is_replaced),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
