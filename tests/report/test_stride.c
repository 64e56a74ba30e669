/* Strides: sampling, and the mirror image that is the second step. */
#include "report/stride.h"
#include "support/walker_result.h"

enum { D = WALKER_COORDINATES };

static void test_nodes(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  assert_int_equal(s.samples, 25);
  assert_true(s.mirrored);
  assert_close(s.duration, 2.0 * walker_step_time, 1e-15);
  for (int k = 0; k < 25; k++) assert_close(s.times[k], (double)k * walker_step_time / 12.0, 1e-14);
  ambulo__stride_free(&s);
  walk_close(&w);
}

/* node 12 + k is node k with left and right exchanged, one step further on */
static void test_mirror(void **state) {
  (void)state;
  static const int image[D] = {0, 1, 2, 6, 7, 8, 3, 4, 5};
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  for (int k = 1; k <= 12; k++) {
    for (int i = 0; i < D; i++) {
      double shift = i == 0 ? walker_step_length : 0.0;
      int here = (12 + k) * D + image[i], there = k * D + i;
      assert_close(s.q[here], s.q[there] + shift, 1e-13);
      assert_close(s.qd[here], s.qd[there], 1e-13);
      assert_close(s.qdd[here], s.qdd[there], 1e-13);
      assert_close(s.tau[here], s.tau[there], 1e-13);
    }
    if (isfinite(s.zmp[3 * k])) {
      assert_close(s.zmp[3 * (12 + k)], s.zmp[3 * k] + walker_step_length, 1e-13);
      assert_close(s.zmp[3 * (12 + k) + 2], -s.zmp[3 * k + 2], 1e-13);
    }
  }
  ambulo__stride_free(&s);
  walk_close(&w);
}

static void test_contacts_change_sides(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 11, NULL, &s), AMBULO_OK);
  assert_int_equal(s.samples, 11);
  for (int k = 1; k < 10; k++) {
    double t = walker_step_time * ((double)k + 0.37) / 12.0;
    ambulo_contact_mode first = AMBULO_CONTACT_HEEL, second = AMBULO_CONTACT_HEEL;
    for (int foot = 0; foot < 2; foot++) {
      int now = ambulo__stride_contact(&s, foot, t, &first);
      int later = ambulo__stride_contact(&s, 1 - foot, t + walker_step_time, &second);
      assert_int_equal(now, later);
      if (now) assert_int_equal(first, second);
    }
  }
  ambulo__stride_free(&s);
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 1, NULL, &s), AMBULO_E_ARGUMENT);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_nodes), cmocka_unit_test(test_mirror),
                                     cmocka_unit_test(test_contacts_change_sides)};
  return cmocka_run_group_tests_name("report/stride", tests, NULL, NULL);
}
