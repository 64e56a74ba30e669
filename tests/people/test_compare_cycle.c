/* Cycles: strikes from summary, forces, option or default; interpolation. */
#include "people/compare.h"
#include "support/gait_folder.h"
#include "support/messages.h"

static const ambulo__map_entry hip = {
    "hip", "hip", "q.hip_flexion_{side}", 1, 0, 0, AMBULO__UNIT_ANGLE, 0, 0};

static ambulo_status open_cycle(void **state, double strike, ambulo_diagnostics *list,
                                ambulo__cycle *cycle) {
  ambulo_compare_options options = ambulo_compare_options_default();
  options.strike = strike;
  return ambulo__cycle_open(*state, &options, NULL, list, cycle);
}

static void where_strikes_come_from(void **state) {
  ambulo__cycle c;
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, "{" GAIT_STRIKES "}");
  assert_int_equal(open_cycle(state, (double)NAN, NULL, &c), AMBULO_OK);
  assert_close(c.strike[AMBULO__CYCLE_LEFT], 0.4, 0.0);
  assert_close(c.strike[AMBULO__CYCLE_RIGHT], 1.0, 0.0);
  assert_close(c.length[AMBULO__CYCLE_LEFT], 1.2, 1e-12);
  ambulo__cycle_close(&c);
  gait_summary(*state, "{}");
  assert_int_equal(open_cycle(state, (double)NAN, NULL, &c), AMBULO_OK);
  assert_close(c.strike[AMBULO__CYCLE_LEFT], 0.4, 1e-9);
  assert_close(c.strike[AMBULO__CYCLE_RIGHT], 1.0, 1e-9);
  ambulo__cycle_close(&c);
  assert_int_equal(open_cycle(state, 0.25, NULL, &c), AMBULO_OK);
  assert_close(c.strike[AMBULO__CYCLE_LEFT], 0.25, 0.0);
  assert_close(c.strike[AMBULO__CYCLE_RIGHT], 0.85, 1e-12);
  ambulo__cycle_close(&c);
  gait_motion(*state, 0.0, 0);
  assert_int_equal(open_cycle(state, (double)NAN, NULL, &c), AMBULO_OK);
  assert_close(c.strike[AMBULO__CYCLE_LEFT], 0.1, 1e-12);
  ambulo__cycle_close(&c);
}

/* two strides in one motion: the first one counts */
static void the_next_strike_ends_the_cycle(void **state) {
  ambulo__cycle c;
  gait_motion(*state, 0.0, 0);
  gait_summary(*state, "{\"strikes\": [{\"foot\": \"left\", \"time\": 0.7}, {\"foot\": \"left\", "
                       "\"time\": 0.1}, {\"foot\": \"paw\", \"time\": 0.2}]}");
  assert_int_equal(open_cycle(state, (double)NAN, NULL, &c), AMBULO_OK);
  assert_close(c.strike[AMBULO__CYCLE_LEFT], 0.1, 0.0);
  assert_close(c.length[AMBULO__CYCLE_LEFT], 0.6, 1e-12);
  assert_close(c.strike[AMBULO__CYCLE_RIGHT], 0.4, 1e-12);
  ambulo__cycle_close(&c);
}

static void curves_are_interpolated_around_the_end(void **state) {
  ambulo__cycle c;
  double percents[101], values[101];
  int found = 0;
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, "{" GAIT_STRIKES ", " GAIT_BODY "}");
  assert_int_equal(open_cycle(state, (double)NAN, NULL, &c), AMBULO_OK);
  for (int i = 0; i <= 100; i++) percents[i] = i;
  for (int side = 0; side < 2; side++) {
    assert_int_equal(ambulo__cycle_spread(&c, &hip, (ambulo__cycle_side)side, percents, 101, values,
                                          NULL, &found),
                     AMBULO_OK);
    assert_int_equal(found, 1);
    for (int i = 0; i <= 100; i++) assert_close(values[i], gait_hip(0.01 * i), 2e-3);
  }
  ambulo__map_entry moment = hip;
  memcpy(moment.result, "tau.hip_flexion_{side}", sizeof "tau.hip_flexion_{side}");
  moment.unit = AMBULO__UNIT_MOMENT;
  moment.factor = -1.0;
  moment.opposite = 1;
  percents[0] = 0.0;
  assert_int_equal(
      ambulo__cycle_spread(&c, &moment, AMBULO__CYCLE_LEFT, percents, 1, values, NULL, &found),
      AMBULO_OK);
  assert_close(values[0], 80.0 / 70.0, 1e-9);
  assert_int_equal(
      ambulo__cycle_spread(&c, &moment, AMBULO__CYCLE_RIGHT, percents, 1, values, NULL, &found),
      AMBULO_OK);
  assert_close(values[0], -80.0 / 70.0, 1e-9);
  c.mass = 0.0;
  assert_int_equal(
      ambulo__cycle_spread(&c, &moment, AMBULO__CYCLE_LEFT, percents, 1, values, NULL, &found),
      AMBULO_OK);
  assert_int_equal(found, 0);
  ambulo__cycle_close(&c);
}

static void bad_folders(void **state) {
  ambulo__cycle c;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  char path[SCRATCH_PATH + 64];
  (void)snprintf(path, sizeof path, "%s/motion.csv", (const char *)*state);
  assert_int_equal(open_cycle(state, 0.0, list, &c), AMBULO_E_IO);
  assert_message(list, 0, "motion.csv");
  gait_summary(*state, "{}");
  scratch_write(path, "t,x\n0,1\n1,1\n2,1\n3,1\n4,1\n");
  assert_int_equal(open_cycle(state, 0.0, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 1, "motion.csv:1:1: error[E_SCHEMA]: no column 'time'");
  scratch_write(path, "time,x\n0,1\n1,1\n1,1\n3,1\n4,1\n");
  assert_int_equal(open_cycle(state, 0.0, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 2, "motion.csv:4:1: error[E_SCHEMA]: time 1 after 1");
  scratch_write(path, "time,x\n0,1\n");
  assert_int_equal(open_cycle(state, 0.0, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 3, "1 times; expected at least 5");
  scratch_write(path, "time,x\n0,1\n1,1\n2,1\n3,1\n4,1\n");
  gait_summary(*state, "{\"body\": {\"mass\": \"many\"}}");
  assert_int_equal(open_cycle(state, 0.0, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 4, "summary.json:1:19");
  gait_summary(*state, "{\"verdict\": \"infeasible\"}");
  assert_int_equal(open_cycle(state, 0.0, list, &c), AMBULO_OK);
  assert_message(list, 5, "warning: the result is no solution");
  ambulo__cycle_close(&c);
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(where_strikes_come_from, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(the_next_strike_ends_the_cycle, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(curves_are_interpolated_around_the_end, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(bad_folders, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_cycle", tests, NULL, NULL);
}
