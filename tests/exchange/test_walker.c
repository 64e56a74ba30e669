/* Bodies that are to walk: parts, legs, feet, limits; and those that cannot. */
#include "support/walk_case.h"

static void robot_is_measured(void **state) {
  (void)state;
  import_case c = walk_biped();
  ambulo__walker w;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &w), AMBULO_OK);
  int parts[3] = {0};
  for (int i = 0; i < w.count; i++) parts[w.part[i]]++;
  assert_int_equal(parts[AMBULO__PART_ROOT], 6);
  assert_int_equal(parts[AMBULO__PART_LEG], 12);
  assert_int_equal(parts[AMBULO__PART_REST], 0);
  assert_string_equal(ambulo_model_foot(c.model, w.foot[0])->name, "left");
  assert_close(w.mass, 36.0, 1e-9);
  assert_close(w.width, 0.18, 1e-9);
  assert_close(w.leg, 0.76, 1e-9); /* 0.35 to the knee, 0.35 to the ankle, 0.06 to the sole */
  assert_true(w.symmetric && !w.planar && w.has_torque_limits && w.has_speed_limits);
  ambulo__walker_free(&w);
  import_shut(&c);
}

/* legs that are bent over flat feet are as long as straight ones */
static void bent_knees(void **state) {
  (void)state;
  import_case c = walk_biped();
  char *knees = walk_changed(c.text, "_knee, range:", "_knee, default: 40, range:");
  char *hips = walk_changed(knees, "_hip_pitch, range:", "_hip_pitch, default: -20, range:");
  char *bent = walk_changed(hips, "_ankle_pitch, range:", "_ankle_pitch, default: -20, range:");
  ambulo_model *model = walk_model(bent);
  ambulo__walker straight, other;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &straight), AMBULO_OK);
  assert_int_equal(ambulo__walker_measure(model, NULL, NULL, &other), AMBULO_OK);
  assert_true(other.symmetric);
  assert_close(other.leg, straight.leg, 1e-9);
  ambulo__walker_free(&straight);
  ambulo__walker_free(&other);
  ambulo_model_free(model);
  free(knees);
  free(hips);
  free(bent);
  import_shut(&c);
}

/* a bent knee takes the foot back: central differences of the heel's place would say the same */
static void slope_of_a_knee(void **state) {
  (void)state;
  import_case c = walk_person();
  ambulo__walker w;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &w), AMBULO_OK);
  int knee = ambulo_model_find_coordinate(c.model, "knee_angle_r");
  double forward = ambulo__walker_slope(&w, w.foot[1], ambulo_model_forward(c.model), knee);
  double other = ambulo__walker_slope(&w, w.foot[0], ambulo_model_forward(c.model), knee);
  assert_true(forward < -0.3 && forward > -0.6);
  assert_close(other, 0.0, 1e-15);
  ambulo__walker_free(&w);
  import_shut(&c);
}

static void refused(const char *text, const char *told) {
  ambulo_model *model = walk_model(text);
  import_case c = {AMBULO_OK, ambulo_diagnostics_create(NULL), NULL, NULL};
  ambulo__walker w;
  assert_int_equal(ambulo__walker_measure(model, NULL, c.list, &w), AMBULO_E_MODEL);
  assert_told(&c, told);
  ambulo__walker_free(&w);
  ambulo_diagnostics_free(c.list);
  ambulo_model_free(model);
}

static void no_walkers(void **state) {
  (void)state;
  import_case c = walk_biped();
  char *feet = walk_changed(c.text, "\nfeet:", "\n# feet:");
  feet[strstr(feet, "\n# feet:") - feet] = '\0';
  refused(feet, "needs two feet or four (got 0)");
  ambulo_import_options options = ambulo_import_options_default();
  options.root = AMBULO_ROOT_FIXED;
  import_case fixed = import_file("tests/users/biped.urdf", &options);
  refused(fixed.text, "fixed to the world");
  free(feet);
  import_shut(&fixed);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(robot_is_measured),
      cmocka_unit_test(bent_knees),
      cmocka_unit_test(slope_of_a_knee),
      cmocka_unit_test(no_walkers),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
