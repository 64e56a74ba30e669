/* Every number that a file has a name for, by hand against central differences. */
#include "ambulo/tools/load.h"
#include "support/sensitivity_check.h"

static void an_arm(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/two_link_reach.yaml",
      {"objective=[{term: torque_absolute, smoothing: 2, scale: {shoulder: 1.1, elbow: 0.9}, "
       "offset: {shoulder: 3, elbow: -1}}, "
       "{term: torque_rate, weight: 0.001, scale: {shoulder: 0.7}}, "
       "{term: mechanical_power, weight: 0.3, scale: {shoulder: 0.8}, tendon: {shoulder: 60}}, "
       "{term: torque_power, power: 2.5, scale: {shoulder: .01, elbow: .02}, "
       "strength: {shoulder: [40, 0.3, 0.1, 50, 0.2, -0.1], elbow: [30, 0.4, 1, 20, 0.5, 0.8]}, "
       "passive: {elbow: [-1, 0.5, 0.3, -0.7]}, offset: {elbow: 2}}]",
       "constraints.speed_limits=true"},
      {"time.duration", "ends.initial.shoulder", "ends.final_speed.elbow",
       "objective[torque_rate].scale.shoulder", "objective[torque_rate].weight",
       "objective[mechanical_power].tendon.shoulder", "objective[mechanical_power].scale.shoulder",
       "objective[torque_absolute].offset.shoulder", "objective[torque_power].strength.elbow[3]",
       "objective[torque_power].strength.shoulder[0]", "objective[torque_power].offset.elbow",
       "model.links[upper].coordinate.torque[0]", "model.links[lower].coordinate.range[1]"}};
  check(&c, NULL);
}

/* ends that are its mirror image, rows on corners and places, a box for the zero-moment point */
static void a_planar_step(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walker_2d_step.yaml",
      {"angles=degrees", "constraints.zmp_margin=0.005", "constraints.speed_limits=true",
       "constraints.minimum_force=0.1", "constraints.torque_limits=true"},
      {"gait.step_length", "gait.speed", "subject.mass", "ground.slope", "constraints.zmp_margin",
       "constraints.minimum_force", "constraints.ground_height",
       "model.links[shank_r].coordinate.range[0]", "objective[torque_squared].offset.pelvis_ty"}};
  check(&c, NULL);
}

static void four_steps_on_hulls(void **state) {
  (void)state;
  static const setting c = {
      "models/yardstick_12.yaml",
      {"angles=degrees", "constraints.zmp=hull", "constraints.zmp_margin=0.002",
       "time.duration=null", "gait.step_time=0.6105"},
      {"gait.step_length", "gait.step_width", "gait.step_time", "ground.slope",
       "constraints.zmp_margin", "constraints.ground_height"}};
  check(&c, NULL);
}

/* times of listed contacts stay where they are when the duration changes */
static void contacts_one_by_one(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walker_2d_step.yaml",
      {"gait=null", "ends=null", "time.duration=0.5", "angles=degrees",
       "contacts=[{foot: right, mode: flat, from: 0, to: 0.4, place: [0, 0]}, "
       "{foot: left, mode: heel, from: 0.3, to: 0.5, place: [0.4, 0]}]"},
      {"contacts[0].place[0]", "contacts[1].place[0]", "subject.mass", "ground.slope"}};
  check(&c, "time.duration");
}

/* the root is carried forward and up, and each by itself */
static void ends_that_rise(void **state) {
  (void)state;
  static const setting c = {"tests/support/walker_2d_step.yaml",
                            {"gait=null", "time.duration=0.5", "constraints={joint_limits: nodes}",
                             "ends={kind: mirrored, order: 1, travel: 0.5, rise: 0.1}"},
                            {"ends.travel", "ends.rise", "time.duration"}};
  check(&c, NULL);
}

static void breakpoints_stay_in_seconds(void **state) {
  (void)state;
  static const setting c = {"tests/support/two_link_reach.yaml",
                            {"trajectory.intervals=null", "trajectory.breakpoints=[0, 0.3, 0.8]"},
                            {"ends.initial.shoulder"}};
  check(&c, "time.duration");
}

/* forces shared by two feet, tolerances, clearance, a load, a slope, every term of a walk */
static void a_walk_under_load(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}",
       "ground_reaction.pressure={heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], "
       "roll: 0.04, width: 0.035}",
       "ground={slope: 3}", "constraints.torque_limits=true", "constraints.clearance.feet=0.01"},
      {"load.mass", "subject.mass", "ground.slope", "gait.step_width",
       "ground_reaction.pressure.roll", "ground_reaction.pressure.flat[1]",
       "ground_reaction.pressure.width", "ground_reaction.friction", "ground_reaction.free_moment",
       "constraints.clearance.inward", "constraints.clearance.feet", "constraints.strike_pitch[0]",
       "time.duration"}};
  check(&c, NULL);
}

#define ON_EVENTS "time.grid=events", "trajectory.knots=events"

/* contacts share the load: what they are told, their rows, a term on their forces */
#define SHARED                                                                                     \
  "ground_reaction={kind: shared, moment_arm: 0.15, slant: 0.3, loading_rate: 14, pressure: "      \
  "{heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], roll: 0.04, width: 0.035}}",   \
      "objective=[{term: torque_squared, scale: {default: 0.001}}, {term: force_rate, weight: "    \
      "0.02}]"

static void a_walk_on_shared_contacts(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}", SHARED, "ground={slope: 3}",
       "constraints.torque_limits=true"},
      {"ground_reaction.moment_arm", "ground_reaction.slant", "ground_reaction.loading_rate",
       "ground_reaction.pressure.roll", "ground_reaction.pressure.flat[1]",
       "ground_reaction.pressure.width", "ground_reaction.friction", "ground_reaction.free_moment",
       "gait.step_width", "gait.step_length", "time.duration", "constraints.ground_height"}};
  check(&c, NULL);
}

static void a_walk_on_shared_contacts_on_events(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}", SHARED, "time.intervals=40",
       "time.duration=null", "gait.speed=1.26", "ground_reaction.minimum_force=0.1", ON_EVENTS},
      {"ground_reaction.moment_arm", "ground_reaction.slant", "ground_reaction.loading_rate",
       "ground_reaction.pressure.heel[0]", "ground_reaction.pressure.toe[0]", "load.mass",
       "subject.mass", "gait.step_width", "gait.step_length", "gait.speed",
       "ground_reaction.minimum_force", "ground.slope"}};
  check(&c, NULL);
}

/* on heels and forefeet that roll: where a force may be follows the foothold it stands on */
static void a_walk_on_shared_arcs(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}", SHARED,
       "model.feet[right].arcs={heel: ankle_r, toe: ankle_r}",
       "model.feet[left].arcs={heel: ankle_l, toe: ankle_l}", "ground={slope: 3}"},
      {"ground_reaction.moment_arm", "ground_reaction.loading_rate", "gait.step_length",
       "gait.step_width", "subject.mass", "load.mass", "ground.slope"}};
  check(&c, NULL);
}

/* heels that sink by what presses on them, which goes with the foothold, the events, the weight */
static void a_walk_on_heel_pads(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}", SHARED,
       "ground_reaction.heel_pad=0.008", "ground={slope: 3}", "time.intervals=40", ON_EVENTS},
      {"ground_reaction.heel_pad", "ground_reaction.moment_arm", "gait.step_length",
       "gait.step_width", "gait.phases.foot_flat", "gait.phases.heel_off", "time.duration",
       "subject.mass", "load.mass", "ground.slope"}};
  static const setting rigid = {"tests/support/walk_rigid.yaml", {NULL}, {NULL}};
  static const char *const idle[] = {"ground_reaction.heel_pad", NULL};
  check(&c, NULL);
  expect_absent(&rigid, idle);
}

/* Nothing holds the body for part of the step; steps and phases are functions of the speed. Of
 * force_rate as little as leaves differences of the toe-off their digits. */
static void a_run(void **state) {
  (void)state;
  static const setting heel = {
      "models/run.yaml",
      {"time.intervals=32", "trajectory.intervals=12", "written_for=null",
       "objective[force_rate].weight=0.14"},
      {"ground_reaction.flight_tolerance", "ground_reaction.loading_rate", "gait.speed",
       "gait.step_length.comfortable", "gait.step_length.slope", "gait.phases.toe_off.comfortable",
       "gait.phases.heel_off.comfortable", "gait.step_width", "subject.mass",
       "constraints.strike_pitch[1]", "constraints.clearance.height", "ground_reaction.friction"}};
  static const setting forefoot = {
      "models/run_forefoot.yaml",
      {"time.intervals=32", "trajectory.intervals=12",
       "load={link: thorax, mass: 8, position: "
       "[-0.1, 0.1, 0]}"},
      {"ground_reaction.flight_tolerance", "constraints.strike_pitch[0]",
       "constraints.strike_pitch[1]", "constraints.clearance.height",
       "gait.phases.foot_flat.comfortable", "gait.phases.toe_off.comfortable", "gait.speed",
       "load.mass", "ground_reaction.pressure.arc"}};
  check(&heel, NULL);
  check(&forefoot, NULL);
}

/* no step length: it follows from the speed, and the time from both */
static void a_walk_at_a_speed(void **state) {
  (void)state;
  static const setting c = {"tests/support/walk_rigid.yaml",
                            {"gait.step_length=null", "time.duration=null", "gait.speed=1.26"},
                            {"gait.speed", "gait.step_width", "subject.mass"}};
  check(&c, NULL);
}

/* the length is that of the speed and the time: neither moves without it */
static void a_cadence_at_a_speed(void **state) {
  (void)state;
  static const setting by_step = {
      "tests/support/walk_rigid.yaml",
      {"gait.step_length=null", "time.duration=null", "gait.speed=1.26", "gait.step_time=0.54"},
      {"gait.step_time", "gait.speed", "gait.step_width"}};
  static const setting by_duration = {"tests/support/walk_rigid.yaml",
                                      {"gait.step_length=null", "gait.speed=1.26"},
                                      {"time.duration", "gait.speed"}};
  static const setting unlike = {
      "models/walk_asymmetric.yaml",
      {"gait.step_length=null", "gait.speed=1.26", "gait.step_time=[0.5, 0.6]"},
      {"gait.speed"}};
  static const setting two_steps = {
      "models/walk_asymmetric.yaml",
      {"gait.step_length=null", "gait.speed=1.26", "gait.step_time=0.55"},
      {"gait.step_time", "gait.speed"}};
  check(&by_step, "time.duration");
  check(&two_steps, "time.duration");
  check(&by_duration, "gait.step_time");
  check(&unlike, "gait.step_time");
}

/* left and right move together, the other way round */
static void two_arms(void **state) {
  (void)state;
  static const setting c = {
      "tests/solver/two_arms_wave.yaml",
      {NULL},
      {"objective[torque_power].offset.lift_r", "objective[torque_power].strength.lift_r[3]",
       "objective[posture].angles.lift_r", "model.links[arm_r].coordinate.range[1]",
       "model.links[arm_r].coordinate.torque[0]"}};
  check(&c, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_arm),
      cmocka_unit_test(a_planar_step),
      cmocka_unit_test(four_steps_on_hulls),
      cmocka_unit_test(contacts_one_by_one),
      cmocka_unit_test(ends_that_rise),
      cmocka_unit_test(breakpoints_stay_in_seconds),
      cmocka_unit_test(a_walk_under_load),
      cmocka_unit_test(a_run),
      cmocka_unit_test(a_walk_at_a_speed),
      cmocka_unit_test(a_walk_on_shared_contacts),
      cmocka_unit_test(a_walk_on_shared_contacts_on_events),
      cmocka_unit_test(a_walk_on_shared_arcs),
      cmocka_unit_test(a_walk_on_heel_pads),
      cmocka_unit_test(a_cadence_at_a_speed),
      cmocka_unit_test(two_arms),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
