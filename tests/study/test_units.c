/* Units of outputs and keys. */
#include "study/units.h"
#include "ambulo/tools/load.h"
#include "support/test.h"

static void outputs(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  static const char *const pairs[][2] = {{"max(tau.knee_angle_r)", "N m"},
                                         {"max(tau.pelvis_ty)", "N"},
                                         {"range(q.knee_angle_r)", "rad"},
                                         {"min(q.pelvis_ty)", "m"},
                                         {"mean(qd.pelvis_tx)", "m/s"},
                                         {"max(qdd.knee_angle_r)", "rad/s\xc2\xb2"},
                                         {"max(grf.right.y)", "N"},
                                         {"max(cop.right.x)", "m"},
                                         {"max(free_moment.left)", "N m"},
                                         {"max(q.nothing)", ""},
                                         {"objective", ""},
                                         {"duration", "s"},
                                         {"ground_reaction.right.peak", "body weights"},
                                         {"ground_reaction.left.impulse_up", "N s"},
                                         {"timing.total", "s"},
                                         {"audit.violation.worst", ""}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    assert_string_equal(ambulo__unit_of_output(pairs[i][0], model), pairs[i][1]);
  assert_string_equal(ambulo__unit_of_output("max(tau.knee_angle_r)", NULL), "");
  ambulo_model_free(model);
}

static void keys(void **state) {
  (void)state;
  static const char *const pairs[][2] = {
      {"time.duration", "s"}, {"gait.speed", "m/s"},    {"gait.step_length", "m"},
      {"subject.mass", "kg"}, {"subject.stature", "m"}, {"subject.sex", ""},
      {"time.intervals", ""}, {"load.mass", "kg"},      {"model.links[shank_r].body.mass", ""}};
  for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
    assert_string_equal(ambulo__unit_of_key(pairs[i][0]), pairs[i][1]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(outputs), cmocka_unit_test(keys)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
