/* Where nodes fall beside the times at which contacts change. */
#include "solver/dense.h"
#include "ambulo/tools/load.h"
#include "support/dense_fixture.h"
#include "support/engine_fixture.h"

/* [0, 1] in ten: nodes at 0, 0.1, ... */
static void gaps_reach_to_the_nodes_that_hold_a_contact(void **state) {
  (void)state;
  assert_close(ambulo__dense_gap_before(0.33, 1.0, 10), 0.03, 1e-12);
  assert_close(ambulo__dense_gap_after(0.33, 1.0, 10), 0.07, 1e-12);
  /* a contact that ends on a node is not held there; one that begins there is */
  assert_close(ambulo__dense_gap_before(0.3, 1.0, 10), 0.1, 1e-12);
  assert_close(ambulo__dense_gap_after(0.3, 1.0, 10), 0.0, 1e-12);
  /* nor one that ends a rounding later, nor is one missed that begins a rounding later */
  assert_close(ambulo__dense_gap_before(0.3 + 1e-13, 1.0, 10), 0.1, 1e-9);
  assert_close(ambulo__dense_gap_after(0.3 + 1e-13, 1.0, 10), 0.0, 1e-9);
  assert_true(ambulo__dense_gap_after(0.3 + 1e-13, 1.0, 10) >= 0.0); /* has broken powers */
  /* one that ends just after a node is held until shortly before */
  assert_close(ambulo__dense_gap_before(0.3001, 1.0, 10), 0.0001, 1e-9);
}

static void intervals_with_an_event_are_known(void **state) {
  (void)state;
  double time[2] = {0.33, 0.6};
  ambulo__events events = {2, time};
  static const struct {
    double time;
    int near;
  } want[] = {{0.29, 0}, {0.31, 1}, {0.39, 1}, {0.41, 0}, {0.49, 0},
              {0.51, 1}, {0.59, 1}, {0.61, 0}, {0.95, 0}};
  for (size_t i = 0; i < sizeof want / sizeof *want; i++)
    assert_int_equal(ambulo__dense_near_event(&events, want[i].time, 1.0, 10), want[i].near);
}

/* both nodes of the interval belong to it, wherever rounding puts them */
static void nodes_beside_an_event_are_near_it(void **state) {
  (void)state;
  for (int intervals = 7; intervals < 60; intervals += 4) {
    for (int k = 0; k + 1 < intervals; k++) {
      double step = 0.54 / intervals, time = (k + 0.37) * step;
      ambulo__events events = {1, &time};
      for (int side = 0; side < 2; side++) {
        double node = 0.54 * (k + side) / intervals;
        assert_int_equal(ambulo__dense_near_event(&events, node, 0.54, intervals), 1);
      }
    }
  }
}

/* on a grid on events there is no gap at an event that is a node; one that is none has its interval
 */
static void events_that_are_nodes_leave_no_gap(void **state) {
  (void)state;
  static const char *const settings[] = {"time.grid=events"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", settings, 1, NULL, NULL, &p), AMBULO_OK);
  double time[2] = {p->times[6], 0.5 * (p->times[9] + p->times[10])};
  ambulo__events events = {2, time};
  assert_false(ambulo__dense_beside_event(p, &events, p->times[6]));
  assert_false(ambulo__dense_beside_event(p, &events, p->times[6] + 1e-4));
  assert_false(ambulo__dense_beside_event(p, &events, p->times[9] - 1e-6));
  assert_true(ambulo__dense_beside_event(p, &events, p->times[9]));
  assert_true(ambulo__dense_beside_event(p, &events, p->times[10] - 1e-6));
  assert_false(ambulo__dense_beside_event(p, &events, p->times[10] + 1e-6));
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaps_reach_to_the_nodes_that_hold_a_contact),
      cmocka_unit_test(intervals_with_an_event_are_known),
      cmocka_unit_test(nodes_beside_an_event_are_near_it),
      cmocka_unit_test(events_that_are_nodes_leave_no_gap),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
