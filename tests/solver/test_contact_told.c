/* Every number that a file has a name for where contacts share the load: by hand against central
 * differences, on uniform grids. */
#include "support/sensitivity_check.h"
#include "support/shared_ground.h"

static void a_walk(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {SHARED, "objective=[{term: force_rate, weight: 0.02}, {term: ground_force, weight: 0.3}]",
       "load={link: pelvis, mass: 10, position: [-0.1, 0.3, 0]}"},
      {"ground_reaction.moment_arm", "ground_reaction.slant", "ground_reaction.loading_rate",
       "ground_reaction.friction", "ground_reaction.free_moment", "ground_reaction.minimum_force",
       "ground_reaction.pressure.heel[0]", "ground_reaction.pressure.flat[1]",
       "ground_reaction.pressure.roll", "ground_reaction.pressure.width", "gait.step_length",
       "gait.step_width", "subject.mass", "time.duration", "constraints.ground_height",
       "objective[force_rate].weight"}};
  check(&c, "ground_reaction.shear");
}

static void a_walk_under_load_uphill(void **state) {
  (void)state;
  static const setting c = {"tests/support/walk_rigid.yaml",
                            {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}", SHARED,
                             "ground={slope: 3}", "time.duration=null", "gait.speed=1.26"},
                            {"load.mass", "subject.mass", "ground.slope", "gait.speed",
                             "gait.step_length", "gait.step_width", "ground_reaction.moment_arm",
                             "ground_reaction.slant", "ground_reaction.pressure.toe[0]",
                             "ground_reaction.pressure.toe[1]", "ground_reaction.pressure.heel[1]",
                             "ground_reaction.pressure.flat[0]", "constraints.contact_tolerance",
                             "constraints.clearance.inward"}};
  check(&c, NULL);
}

/* both feet on the ground, at rest at both ends; a load in front */
static void a_squat(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"gait=null", SHARED, "time.duration=1.2", "ends={kind: periodic, order: 2}",
       "load={link: pelvis, mass: 10, position: [0.2, 0.3, 0.1]}", "ground={slope: 2}",
       "contacts=[{foot: left, mode: flat, from: 0, to: 1.2, place: [0, 0.09]}, "
       "{foot: right, mode: flat, from: 0, to: 1.2, place: [0.03, -0.08]}]"},
      {"contacts[0].place[0]", "contacts[1].place[1]", "load.mass", "subject.mass",
       "ground_reaction.moment_arm", "ground_reaction.slant", "ground_reaction.pressure.flat[0]",
       "ground_reaction.pressure.width", "constraints.ground_height"}};
  check(&c, NULL);
}

static void a_planar_step(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walker_2d_step.yaml",
      {"constraints.zmp=off", "angles=degrees", SHARED, "objective[0].weight=2"},
      {"gait.step_length", "ground_reaction.moment_arm", "ground_reaction.slant",
       "ground_reaction.pressure.toe[0]", "ground_reaction.loading_rate", "ground.slope",
       "ground_reaction.friction"}};
  check(&c, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_walk),
      cmocka_unit_test(a_walk_under_load_uphill),
      cmocka_unit_test(a_squat),
      cmocka_unit_test(a_planar_step),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
