/* Direct searches on residuals by formula: where they end, bounds, limits, stops. */
#include "support/fit_task.h"

static ambulo_fit_ending run(fit_made_up *w, ambulo__fit_method method, ambulo__fit_trial *best) {
  ambulo_fit_ending ending = AMBULO_FIT_INTERRUPTED;
  assert_int_equal(ambulo__fit_direct_search(&w->task, method, best, &ending), AMBULO_OK);
  return ending;
}

static const ambulo__fit_method methods[] = {AMBULO__FIT_BOBYQA, AMBULO__FIT_SBPLX};

static void the_least(void **state) {
  (void)state;
  for (int i = 0; i < 2; i++) {
    fit_made_up w = {.scale = 5.0};
    ambulo__fit_trial *best;
    fit_made_up_open(&w, &best);
    w.task.iterations = 2000;
    w.task.tolerance = 0.0;
    assert_int_equal(run(&w, methods[i], best), AMBULO_FIT_CONVERGED);
    assert_close(best->u[0], 1.0, 0.1);
    assert_close(best->u[1], 1.0, 0.2);
    assert_int_equal(w.notes, w.evaluated);
    assert_true(w.refreshed > 1 && w.refreshed < w.evaluated);
    fit_made_up_close(&w, best);
  }
}

static void bounds_hold(void **state) {
  (void)state;
  for (int i = 0; i < 2; i++) {
    fit_made_up w = {.scale = 5.0, .lower = {-0.1, -3.0}, .upper = {0.5, 3.0}};
    ambulo__fit_trial *best;
    fit_made_up_open(&w, &best);
    w.task.iterations = 500;
    w.task.tolerance = 0.0;
    double before = best->cost;
    (void)run(&w, methods[i], best); /* whose evaluate checks the bounds */
    assert_true(best->cost < 0.9 * before);
    fit_made_up_close(&w, best);
  }
}

static void a_limit_and_a_stop(void **state) {
  (void)state;
  for (int i = 0; i < 2; i++) {
    fit_made_up w = {.scale = 5.0};
    ambulo__fit_trial *best;
    fit_made_up_open(&w, &best);
    w.task.iterations = 5;
    assert_int_equal(run(&w, methods[i], best), AMBULO_FIT_ITERATIONS);
    assert_int_equal(w.evaluated, 5);
    fit_made_up_close(&w, best);
    w = (fit_made_up){.scale = 5.0, .stop_at = 4};
    fit_made_up_open(&w, &best);
    assert_int_equal(run(&w, methods[i], best), AMBULO_FIT_INTERRUPTED);
    assert_int_equal(w.evaluated, 4);
    fit_made_up_close(&w, best);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_least), cmocka_unit_test(bounds_hold),
                                     cmocka_unit_test(a_limit_and_a_stop)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
