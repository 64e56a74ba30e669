/* Expressions of a column map: sums, components, power, sizes, and columns of muscles.csv. */
#include "people/compare.h"
#include "support/gait_folder.h"
#include "support/messages.h"

static ambulo_status open_cycle(void **state, ambulo__cycle *cycle) {
  ambulo_compare_options options = ambulo_compare_options_default();
  options.strike = 0.1;
  return ambulo__cycle_open(*state, &options, NULL, NULL, cycle);
}

static void sums_components_and_power(void **state) {
  ambulo__cycle c;
  double values[41];
  int found = 0;
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, "{\"body\": {\"up\": [0, 2, 0]}}");
  assert_int_equal(open_cycle(state, &c), AMBULO_OK);
  assert_int_equal(ambulo__cycle_samples(&c, "tau.hip_flexion_l+tau.none+tau.hip_flexion_{side}", 0,
                                         AMBULO__CYCLE_RIGHT, values, &found),
                   AMBULO_OK);
  assert_int_equal(found, 1);
  for (int k = 0; k < 41; k++) assert_close(values[k], 0.0, 1e-9);
  assert_int_equal(
      ambulo__cycle_samples(&c, "grf.{foot}.up", 0, AMBULO__CYCLE_LEFT, values, &found), AMBULO_OK);
  assert_close(values[22], 2.0 * gait_force(0.3), 1e-6);
  assert_int_equal(ambulo__cycle_samples(&c, "power.hip_flexion_l", 0, 0, values, &found),
                   AMBULO_OK);
  assert_int_equal(found, 0);
  assert_int_equal(ambulo__cycle_samples(&c, "zmp.x", 0, 0, values, &found), AMBULO_E_SCHEMA);
  ambulo__cycle_close(&c);
}

/* beside sums, which stay */
static void sizes_and_muscles(void **state) {
  ambulo__cycle c;
  double values[41];
  int found = 0;
  char path[SCRATCH_PATH + 64];
  (void)snprintf(path, sizeof path, "%s/muscles.csv", (const char *)*state);
  gait_motion(*state, 0.0, 1);
  gait_summary(*state, "{}");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fputs("time,a.m_l,contact.hip_l.x,contact.hip_l.y,contact.hip_l.z\n", f);
  for (int k = 0; k < 41; k++) fprintf(f, "%d,%d,%d,%d,%d\n", k, k, 2 * k, -3 * k, 6 * k);
  fclose(f);
  assert_int_equal(open_cycle(state, &c), AMBULO_OK);
  assert_int_equal(ambulo__cycle_samples(&c, "a.m_{side}+size.contact.hip_{side}", 0,
                                         AMBULO__CYCLE_LEFT, values, &found),
                   AMBULO_OK);
  assert_int_equal(found, 1);
  for (int k = 0; k < 41; k++) assert_close(values[k], 8.0 * k, 1e-12 * k);
  assert_int_equal(
      ambulo__cycle_samples(&c, "size.contact.hip_{side}", 0, AMBULO__CYCLE_RIGHT, values, &found),
      AMBULO_OK);
  assert_int_equal(found, 0);
  ambulo__cycle_close(&c);
}

/* a knee of another name that bends the other way round, of a map that speaks of people; a map of
 * columns takes them as they are */
static void joints_of_the_body_stand_for_those_of_people(void **state) {
  char motion[SCRATCH_PATH + 64];
  (void)snprintf(motion, sizeof motion, "%s/motion.csv", (const char *)*state);
  scratch_write(motion, "time,q.bend,qd.bend,tau.bend,q.knee_angle_r\n0,-1,2,3,9\n1,-2,2,5,9\n"
                        "2,-3,2,5,9\n3,-2,2,5,9\n4,-1,2,3,9\n");
  gait_summary(*state, "{\"body\": {\"mass\": 70, \"joints\": {\"knee_angle_r\": {\"coordinate\": "
                       "\"bend\", \"sign\": -1}}}}");
  ambulo_compare_options options = ambulo_compare_options_default();
  ambulo__cycle c;
  double values[5];
  int found = 0;
  assert_int_equal(ambulo__cycle_open(*state, &options, NULL, NULL, &c), AMBULO_OK);
  static const struct {
    const char *expression;
    int by_body;
    double at_1;
  } cases[] = {{"q.knee_angle_{side}", 1, 2.0},
               {"tau.knee_angle_{side}", 1, -5.0},
               {"power.knee_angle_{side}", 1, 10.0},
               {"q.knee_angle_{side}", 0, 9.0}};
  for (int i = 0; i < 4; i++) {
    assert_int_equal(ambulo__cycle_samples(&c, cases[i].expression, cases[i].by_body,
                                           AMBULO__CYCLE_RIGHT, values, &found),
                     AMBULO_OK);
    assert_int_equal(found, 1);
    assert_close(values[1], cases[i].at_1, 0.0);
  }
  ambulo__cycle_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(joints_of_the_body_stand_for_those_of_people, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(sums_components_and_power, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(sizes_and_muscles, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_expression", tests, NULL, NULL);
}
