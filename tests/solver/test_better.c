/* Which of two points the audit prefers. */
#include "solver/better.h"
#include "support/chosen_points.h"
#include "support/fail_alloc.h"

static void audits_decide_between_two(void **state) {
  (void)state;
  chosen s;
  int better = -1;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  const ambulo_problem *p = s.f.problem;
  assert_int_equal(ambulo__is_better(p, &o, s.good, s.better, NULL, &better), AMBULO_OK);
  assert_int_equal(better, 1);
  assert_int_equal(ambulo__is_better(p, &o, s.better, s.good, NULL, &better), AMBULO_OK);
  assert_int_equal(better, 0);
  assert_int_equal(ambulo__is_better(p, &o, s.invalid, s.good, NULL, &better), AMBULO_OK);
  assert_int_equal(better, 1);
  close_chosen(&s);
}

/* "not better" is no answer to a lack of memory */
static void lack_of_memory_is_said(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  int refused = 0;
  for (long k = 0; k < 2000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    int better = -1;
    ambulo_status status =
        ambulo__is_better(s.f.problem, &o, s.good, s.better, &allocator, &better);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      assert_int_equal(better, 1);
      break;
    }
    refused++;
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_int_equal(better, 0);
  }
  assert_true(refused > 20);
  close_chosen(&s);
}

/* rows that hold more closely may cost a hundred-thousandth, no more */
static void closer_rows_have_a_price(void **state) {
  (void)state;
  chosen s;
  open_chosen(&s);
  ambulo_options o = ambulo_options_default();
  o.feasibility_tolerance = 0.1; /* all of these pass */
  o.optimality_tolerance = 1.0;
  size_t n = (size_t)s.f.n;
  double change[2], optimum = 0.0;
  for (int k = 0; k < 3; k++) { /* objective by the first unknown, which is prescribed */
    memcpy(s.x, s.better, n * sizeof *s.x);
    s.x[0] += k == 0 ? 0.0 : k == 1 ? 1e-5 : -1e-5;
    assert_true(ambulo__violation_at(s.f.engine, s.x) < 0.1);
    double objective = s.f.engine->workspace->objective;
    if (k == 0)
      optimum = objective;
    else
      change[k - 1] = objective / optimum - 1.0;
  }
  double slope = (change[0] - change[1]) / 2e-5;
  for (int k = 0; k < 2; k++) {
    int better = -1;
    memcpy(s.x, s.better, n * sizeof *s.x);
    s.x[0] -= (k ? 2e-5 : 5e-6) / slope; /* cheaper by that */
    assert_int_equal(ambulo__is_better(s.f.problem, &o, s.x, s.better, NULL, &better), AMBULO_OK);
    assert_int_equal(better, k == 0);
  }
  close_chosen(&s);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(audits_decide_between_two),
                                     cmocka_unit_test(lack_of_memory_is_said),
                                     cmocka_unit_test(closer_rows_have_a_price)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
