/* Where nodes fall beside the times at which contacts change. */
#include "judge/dense.h"
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
  ambulo__dense_events events = {2, time};
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
      ambulo__dense_events events = {1, &time};
      for (int side = 0; side < 2; side++) {
        double node = 0.54 * (k + side) / intervals;
        assert_int_equal(ambulo__dense_near_event(&events, node, 0.54, intervals), 1);
      }
    }
  }
}

/* the walk's phases by hand: stride 1.08 s, left foot first; the tip of the right foot has to clear
 * from 30 % of its swing on */
static void events_are_those_of_the_gait(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("walk_normal");
  ambulo__dense_events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__dense_events_create(p, &a, &events), AMBULO_OK);
  const double want[] = {0.08 * 1.08, 0.62 * 1.08 - 0.54,
                         0.62 * 1.08 - 0.54 + 0.3 * (1.08 - 0.62 * 1.08), 0.38 * 1.08};
  assert_int_equal(events.count, 4);
  for (int i = 0; i < 4; i++) assert_close(events.time[i], want[i], 1e-9);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
}

/* nothing has to clear the ground without rows that ask for it, nor a foot without a tip */
static void tips_that_need_not_clear_make_no_event(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("walk_normal");
  dense_fixture f;
  ambulo__dense_events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  p->definition.clearance.height = -1.0;
  assert_int_equal(ambulo__dense_events_create(p, &a, &events), AMBULO_OK);
  assert_int_equal(events.count, 3);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
  dense_open(&f, 20);
  f.problem->definition.clearance.height = 0.01;
  f.problem->definition.clearance.tip_from = 0.3;
  assert_int_equal(ambulo__dense_events_create(f.problem, &a, &events), AMBULO_OK);
  const double want[] = {0.16 * 0.55, 0.24 * 0.55, 0.76 * 0.55};
  assert_int_equal(events.count, 3);
  for (int i = 0; i < 3; i++) assert_close(events.time[i], want[i], 1e-9);
  ambulo__free(&a, events.time);
  dense_close(&f);
}

static void a_problem_without_contacts_has_none(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("two_link_reach");
  ambulo__dense_events events;
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__dense_events_create(p, &a, &events), AMBULO_OK);
  assert_int_equal(events.count, 0);
  ambulo__free(&a, events.time);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(gaps_reach_to_the_nodes_that_hold_a_contact),
      cmocka_unit_test(intervals_with_an_event_are_known),
      cmocka_unit_test(nodes_beside_an_event_are_near_it),
      cmocka_unit_test(events_are_those_of_the_gait),
      cmocka_unit_test(tips_that_need_not_clear_make_no_event),
      cmocka_unit_test(a_problem_without_contacts_has_none),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
