/* What goes along with an event, against problems whose phases are others. */
#include "ambulo/tools/tools.h"
#include "contact/gait.h"
#include "solver/event_rates.h"
#include "support/fail_alloc.h"
#include "support/test.h"

enum { MOST = 200 };

static ambulo_problem *walk_with(const char *file, const char *phase, double value) {
  char text[64];
  ambulo_problem *problem = NULL;
  const char *const overrides[] = {"time.grid=events", "trajectory.knots=events", text};
  (void)snprintf(text, sizeof text, "gait.phases.%s=%.17g", phase, value);
  assert_int_equal(ambulo_problem_load(file, overrides, 3, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

/* events that move with the phase; the sum of their rates */
static void expect_rates(const char *file, const char *phase, double value) {
  double by = 1e-4, stride, node[MOST] = {0}, knot[MOST] = {0}, one[MOST];
  ambulo_problem *p = walk_with(file, phase, value);
  ambulo_problem *moved[2] = {walk_with(file, phase, value - by),
                              walk_with(file, phase, value + by)};
  ambulo__event_map map, other;
  ambulo__pool pool;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__event_map_create(p, &pool, &map), AMBULO_OK);
  assert_int_equal(ambulo__event_map_create(moved[1], &pool, &other), AMBULO_OK);
  assert_int_equal(map.contacts.count, other.contacts.count);
  stride = ambulo__gait_strike(&p->keys.walk, 2);
  int found = 0, knots = ambulo__basis_intervals(p->basis) + 1;
  for (int e = 0; e < map.contacts.count; e++) {
    double moves = (other.contacts.time[e] - map.contacts.time[e]) / (by * stride);
    assert_true(fabs(moves) < 1e-6 || fabs(moves - 1.0) < 1e-6);
    if (moves < 0.5) continue;
    found++;
    assert_int_equal(map.unclear[e], 0);
    ambulo__event_node_rates(&map, e, one);
    for (int k = 0; k < p->nodes; k++) node[k] += stride * one[k];
    ambulo__event_knot_rates(&map, e, one);
    for (int k = 0; k < knots; k++) knot[k] += stride * one[k];
  }
  assert_true(found > 0);
  for (int k = 0; k < p->nodes; k++)
    assert_close(node[k], (moved[1]->times[k] - moved[0]->times[k]) / (2.0 * by), 1e-9);
  for (int k = 0; k < knots; k++)
    assert_close(knot[k],
                 (ambulo__basis_breakpoints(moved[1]->basis)[k] -
                  ambulo__basis_breakpoints(moved[0]->basis)[k]) /
                     (2.0 * by),
                 1e-9);
  ambulo__pool_clear(&pool);
  for (int k = 0; k < 2; k++) ambulo_problem_free(moved[k]);
  ambulo_problem_free(p);
}

/* with tips that have to clear from a part of the swing on, which both its ends move */
static void nodes_and_knots_go_along(void **state) {
  (void)state;
  expect_rates("tests/support/walk_rigid.yaml", "foot_flat", 0.08);
  expect_rates("tests/support/walk_rigid.yaml", "heel_off", 0.38);
  expect_rates("tests/support/walk_rigid.yaml", "toe_off", 0.62);
  /* 1 ms after foot-flat, which alone has a knot */
  expect_rates("tests/support/walk_rigid.yaml", "toe_off", 0.581);
  expect_rates("tests/support/walk_rigid.yaml", "foot_flat", 0.119);
  expect_rates("tests/support/walk_rigid.yaml", "heel_strike", -0.02);
  expect_rates("models/walk_asymmetric.yaml", "heel_strike", 0.02);
  expect_rates("models/walker_2d_step.yaml", "toe_off", 0.56);
}

/* a tip that has to clear from the moment on when the other foot's heel rises */
static void two_at_one_time_are_unclear(void **state) {
  (void)state;
  char text[64];
  ambulo_problem *problem = NULL;
  const char *const overrides[] = {"time.grid=events", text};
  double from = (0.38 - 0.12) / (0.5 - 0.12); /* of the swing */
  (void)snprintf(text, sizeof text, "constraints.clearance.tip_from=%.17g", from);
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", overrides, 2, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo__event_map map;
  ambulo__pool pool;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__event_map_create(problem, &pool, &map), AMBULO_OK);
  assert_int_equal(map.contacts.count, 3); /* foot flat, toe-off, heel off */
  assert_int_equal(map.rows.count, 3);
  const int want[3] = {0, 1, 1};
  for (int e = 0; e < 3; e++) assert_int_equal(map.unclear[e], want[e]);
  ambulo__pool_clear(&pool);
  ambulo_problem_free(problem);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  ambulo_problem *p = walk_with("tests/support/walk_rigid.yaml", "toe_off", 0.62);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__event_map map;
    ambulo__pool pool;
    ambulo__pool_init(&pool, &allocator);
    ambulo_status status = ambulo__event_map_create(p, &pool, &map);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__pool_clear(&pool);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nodes_and_knots_go_along),
      cmocka_unit_test(two_at_one_time_are_unclear),
      cmocka_unit_test(every_allocation_may_fail),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
