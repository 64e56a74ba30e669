/* Every number that a file has a name for, phases and times of contacts among them, on grids on
 * events: by hand against central differences. */
#include "support/sensitivity_check.h"
#include "ambulo/tools/load.h"

#define ON_EVENTS "time.grid=events", "trajectory.knots=events"

/* without a load, motions and prices by strength are those of any mass */
#define LOADED "load={link: pelvis, mass: 10, position: [-0.1, 0.3, 0]}"

#define BY_SPEED "time.duration=null", "gait.step_length=null", "gait.speed=1.4"

/* what changes the speed moves the phases along */
static void phases_by_speed(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_normal.yaml",
      {BY_SPEED,
       "gait.phases={foot_flat: {slope: 0.05}, toe_off: {comfortable: 0.61, slope: -0.3}}",
       "written_for={mass: 60, stature: 1.6}", "trajectory.knots=events", LOADED,
       "ground_reaction.pressure={arc: 0.004}"},
      {"gait.speed", "gait.phases.foot_flat.comfortable", "gait.phases.toe_off.comfortable",
       "gait.phases.heel_off", "gait.step_width", "subject.mass", "constraints.contact_tolerance",
       "ground_reaction.moment_arm", "constraints.orientation_tolerance",
       "constraints.clearance.height", "ground_reaction.pressure.arc"}};
  check(&c, "gait.phases.toe_off");
  static const setting time = {"models/walk_normal.yaml",
                               {"time.duration=null", "gait.step_time=0.5", "gait.phases=by_speed"},
                               {"gait.step_time", "gait.step_length"}};
  check(&time, "gait.phases.toe_off.comfortable");
}

#define AT_A_SPEED "time.duration=null", "gait.step_length=null", "gait.speed=1.6"

/* without nodes on events phases have no derivative, and then the speed has none either */
static void phases_by_speed_between_nodes(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml", {AT_A_SPEED, "gait.phases=by_speed"}, {"gait.step_width"}};
  expect_absent(&c, (const char *const[]){"gait.speed", NULL});
  static const setting fixed = {"tests/support/walk_rigid.yaml", {AT_A_SPEED}, {"gait.speed"}};
  check(&fixed, NULL);
}

#define SLOPED "gait.phases={heel_strike: 0.01, heel_off: {slope: 0.1}, toe_off: {slope: -0.3}}"

/* dL/dv reaches every key that changes the speed, and none that does not */
static void keys_that_change_the_speed(void **state) {
  (void)state;
  static const setting cadence = {"models/walk_normal.yaml",
                                  {"time.duration=null", "gait.step_length=null", "gait.speed=1.26",
                                   "gait.step_time=0.54", SLOPED},
                                  {"gait.step_time", "gait.speed"}},
                       length = {"models/walk_normal.yaml",
                                 {"time.duration=null", "gait.speed=1.26", SLOPED},
                                 {"gait.step_length", "gait.speed"}},
                       limp = {"models/walk_asymmetric.yaml",
                               {SLOPED, "objective[0].weight=2", ON_EVENTS},
                               {"gait.step_length[0]", "gait.step_length[1]",
                                "gait.phases.toe_off.comfortable"}};
  check(&cadence, NULL);
  check(&length, NULL);
  check(&limp, NULL);
}

/* where phases have no derivative, neither has what changes the speed; a cadence does not */
static void keys_that_change_the_speed_between_nodes(void **state) {
  (void)state;
  static const setting cadence = {"tests/support/walk_rigid.yaml",
                                  {AT_A_SPEED, "gait.step_time=0.48", "gait.phases=by_speed"},
                                  {"gait.step_time"}},
                       both = {"tests/support/walk_rigid.yaml",
                               {"time.duration=null", "gait.step_time=0.48",
                                "gait.step_length=0.77", "gait.phases=by_speed"},
                               {NULL}},
                       tubes = {"models/walk_normal.yaml",
                                {SLOPED, "constraints.tubes=[{reference: walk_tracking_angles.csv, "
                                         "coordinates: {hip_flexion_r: 40}}]"},
                                {NULL}},
                       tracked = {"models/walk_tracking.yaml", {SLOPED}, {NULL}};
  check(&cadence, "gait.speed");
  expect_absent(&both, (const char *const[]){"gait.step_time", "gait.step_length", NULL});
  expect_absent(&tubes, (const char *const[]){"gait.step_length", NULL});
  expect_absent(&tracked, (const char *const[]){"gait.step_length", NULL});
}

/* torques counted in shares of the model's limits, which have the price then */
static void limits_as_strength(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_normal.yaml",
      {"objective[torque_power].strength=limits",
       "objective[torque_power].scale={default: 0, hip_flexion_r: 1, hip_flexion_l: 1, "
       "ankle_angle_r: [2, 3], ankle_angle_l: [2, 3], hip_adduction_r: 1, hip_adduction_l: 1, "
       "pelvis_list: 0}",
       LOADED},
      {"subject.mass", "objective[torque_power].scale.ankle_angle_r[0]",
       "objective[torque_power].scale.ankle_angle_r[1]",
       "objective[torque_power].scale.hip_flexion_r", "model.links[talus_r].coordinate.torque[0]",
       "model.links[talus_r].coordinate.torque[1]",
       "model.links[hip_flexion_r].coordinate.torque[0]"}};
  check(&c, "objective[torque_power].strength.ankle_angle_r[0]");
  static const setting of_another = {
      "models/walk_normal.yaml",
      {"objective[torque_power].strength=limits",
       "objective[torque_power].scale={default: 0, ankle_angle_r: [2, 3], ankle_angle_l: [2, 3]}",
       "written_for={mass: 60, stature: 1.6}", LOADED},
      {"subject.mass", "model.links[talus_r].coordinate.torque[0]"}};
  check(&of_another, NULL);
  static const setting of_the_trunk = {
      "models/walk_normal.yaml",
      {"model=lower_body_21.yaml", "objective[upright].points=[lumbar, head_top]",
       "objective[torque_power].strength=limits",
       "objective[torque_power].scale={default: 0, ankle_angle_r: [1, 3], ankle_angle_l: [1, 3], "
       "knee_angle_r: [2, 1], knee_angle_l: [2, 1], lumbar_bending: [0.5, 0.5]}"},
      {"objective[torque_power].scale.ankle_angle_r[0]",
       "objective[torque_power].scale.ankle_angle_r[1]",
       "objective[torque_power].scale.knee_angle_r[0]",
       "objective[torque_power].scale.lumbar_bending[0]"}};
  check(&of_the_trunk, "objective[torque_power].scale.lumbar_bending[1]");
}

/* terms of a file that is written for another body go with the subject's mass */
static void terms_written_for(void **state) {
  (void)state;
#define TERMS(power)                                                                               \
  "objective=[{term: torque_power, name: plain, scale: {default: 0, hip_flexion_r: 0.01, "         \
  "hip_flexion_l: 0.01}, offset: {hip_flexion_r: 4, hip_flexion_l: 4}" power                       \
  "}, {term: torque_power, name: curves, scale: {default: 0, knee_angle_r: 1, knee_angle_l: 1}, "  \
  "strength: {knee_angle_r: [100, 1, 0.5, 200, 0.9, 0.8], knee_angle_l: [100, 1, 0.5, 200, 0.9, "  \
  "0.8]}}, {term: torque_squared, scale: 0.01, offset: {pelvis_ty: body_weight}}, "                \
  "{term: mechanical_power, tendon: {ankle_angle_r: 300, ankle_angle_l: 300}}, "                   \
  "{term: torque_absolute, scale: 0.01}, {term: torque_rate, scale: 0.001}]"
  static const setting c = {"models/walk_normal.yaml",
                            {TERMS(""), LOADED, "written_for={mass: 60, stature: 1.6}"},
                            {"subject.mass", "load.mass"}};
  check(&c, NULL);
  static const setting passive = {
      "models/walk_normal.yaml",
      {TERMS(", passive: {hip_flexion_r: [-2, -5, 1, 4], hip_flexion_l: [-2, -5, 1, 4]}"), LOADED,
       "written_for={mass: 60, stature: 1.6}"},
      {"load.mass", "subject.mass"}};
  check(&passive, NULL);
}

/* a node on an event has rows of both contacts, and half an interval of either length */
static void a_planar_step_on_events(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walker_2d_step.yaml",
      {"angles=degrees", "constraints.zmp_margin=0.005", "constraints.speed_limits=true",
       "constraints.minimum_force=0.1", "trajectory.degree=4", ON_EVENTS},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off", "gait.step_length", "gait.speed", "subject.mass", "ground.slope",
       "constraints.zmp_margin", "constraints.minimum_force", "constraints.ground_height"}};
  check(&c, NULL);
}

static void four_steps_on_hulls_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/yardstick_12.yaml",
      {"angles=degrees", "constraints.zmp=hull", "constraints.zmp_margin=0.002",
       "time.duration=null", "gait.step_time=0.6105", "time.intervals=40", ON_EVENTS},
      {"gait.step_length", "gait.step_width", "gait.step_time", "ground.slope",
       "constraints.zmp_margin", "constraints.ground_height"}};
  check(&c, NULL);
}

static void contacts_one_by_one_on_events(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walker_2d_step.yaml",
      {"gait=null", "ends=null", "time.duration=0.5", "angles=degrees",
       "contacts=[{foot: right, mode: flat, from: 0, to: 0.3, place: [0, 0]}, "
       "{foot: right, mode: toe, from: 0.3, to: 0.4, place: [0.01, 0]}, "
       "{foot: left, mode: heel, from: 0.3, to: 0.5, place: [0.4, 0]}]",
       ON_EVENTS},
      {"contacts[0].place[0]", "contacts[1].place[0]", "contacts[2].place[0]", "subject.mass",
       "ground.slope", "contacts[1].to", "contacts[0].to"}};
  check(&c, "time.duration");
  expect_absent(&c, (const char *const[]){"contacts[1].from",
                                          NULL}); /* goes along with the end of the one before */
}

static void a_walk_under_load_on_events(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}",
       "ground_reaction.pressure={heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], "
       "roll: 0.04, width: 0.035}",
       "ground={slope: 3}", ON_EVENTS},
      {"gait.phases.foot_flat", "gait.phases.heel_off", "gait.phases.toe_off", "load.mass",
       "ground.slope", "gait.step_width", "gait.step_length", "ground_reaction.pressure.roll",
       "ground_reaction.pressure.flat[1]", "constraints.contact_tolerance",
       "constraints.orientation_tolerance", "constraints.clearance.inward",
       "constraints.strike_pitch[0]", "time.duration"}};
  check(&c, NULL);
}

static void a_walk_with_other_terms_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {"objective=[{term: clearance, height: 0.06, weight: 3}, "
       "{term: torque_rate, weight: 0.0001}, {term: mechanical_power, weight: 0.01}, "
       "{term: mechanical_power, name: muscles, weight: 0.02, tendon: {ankle_angle_r: 300, "
       "ankle_angle_l: 300, knee_angle_r: 500, knee_angle_l: 500}}, "
       "{term: upright, weight: 10, points: [pelvis, head_top]}, "
       "{term: ground_force, weight: 0.3}]",
       "time.duration=null", "gait.speed=1.26", "trajectory.degree=5", ON_EVENTS},
      {"gait.phases.foot_flat", "gait.phases.heel_off", "gait.phases.toe_off",
       "objective[clearance].height", "gait.speed", "gait.step_length",
       "constraints.clearance.turn", "constraints.clearance.ceiling", "load.mass",
       "constraints.ground_height", "objective[torque_rate].weight",
       "objective[muscles].tendon.ankle_angle_r"}};
  check(&c, NULL);
}

/* strikes before 0 and T, a smooth transfer; nodes move along fixed knots */
static void a_walk_early_on_its_heel(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walk_rigid.yaml",
      {"load={link: pelvis, mass: 20, position: [-0.18, 0.35, 0]}",
       "gait.phases={heel_strike: -0.03, foot_flat: 0.05, heel_off: 0.36, toe_off: 0.6}",
       "constraints.clearance.height=0.03", "time.grid=events",
       "objective=[{term: clearance, height: 0.06, weight: 3}, {term: ground_force, weight: 0.3}, "
       "{term: torque_rate, weight: 0.0001}]"},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off"}};
  check(&c, NULL);
}

/* two steps, periodic, of other lengths and times */
static void a_limp_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_asymmetric.yaml",
      {"gait.phases={heel_strike: 0.01, foot_flat: 0.08, heel_off: 0.38, toe_off: 0.62}",
       "objective[0].weight=2", ON_EVENTS},
      {"gait.phases.heel_strike", "gait.phases.foot_flat", "gait.phases.heel_off",
       "gait.phases.toe_off"}};
  check(&c, NULL);
}

/* what another event, an end or a knot coincides with has no derivative */
static void times_that_coincide(void **state) {
  (void)state;
  static const setting strike_at_0 = {"models/walk_loaded.yaml", {ON_EVENTS}, {NULL}},
                       heel_with_strike = {"tests/support/walk_without_reaction.yaml",
                                           {"gait.phases.heel_off=0.44", ON_EVENTS},
                                           {"gait.phases.toe_off", "gait.phases.foot_flat"}},
                       uniform = {"tests/support/walker_2d_step.yaml", {NULL}, {NULL}},
                       on_a_knot = {"models/walk_loaded.yaml",
                                    {"time.grid=events", "trajectory.intervals=25",
                                     "trajectory.knots=uniform", "trajectory.degree=3"},
                                    {"gait.step_length"}},
                       above_cubic = {"models/walk_loaded.yaml",
                                      {"time.grid=events", "trajectory.intervals=25",
                                       "trajectory.knots=uniform", "trajectory.degree=5"},
                                      {"gait.phases.toe_off"}};
  expect_absent(&strike_at_0, (const char *const[]){"gait.phases.heel_strike", NULL});
  expect_absent(&heel_with_strike, (const char *const[]){"gait.phases.heel_off", NULL});
  expect_absent(&uniform, (const char *const[]){"gait.phases.toe_off", NULL});
  expect_absent(&on_a_knot, (const char *const[]){"gait.phases.toe_off", NULL});
  check(&above_cubic, NULL);
}

static int has_duration(const ambulo_problem_definition *definition) {
  ambulo_problem *problem = NULL;
  ambulo_sensitivity_list *list = NULL;
  int found = 0;
  assert_int_equal(ambulo_problem_create(definition, NULL, NULL, &problem), AMBULO_OK);
  ambulo_result *result = scattered(problem);
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  for (int i = 0; i < list->count; i++) found |= !strcmp(list->items[i].name, "time.duration");
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  return found;
}

/* from C: nodes that stay in seconds */
static void node_times_have_no_duration(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/two_link_reach.yaml", NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_problem_definition d = problem->definition;
  d.grid = AMBULO_GRID_EVENTS;
  assert_int_equal(has_duration(&d), 1);
  d.node_times = problem->times;
  assert_int_equal(has_duration(&d), 0);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(phases_by_speed),
      cmocka_unit_test(phases_by_speed_between_nodes),
      cmocka_unit_test(keys_that_change_the_speed),
      cmocka_unit_test(keys_that_change_the_speed_between_nodes),
      cmocka_unit_test(limits_as_strength),
      cmocka_unit_test(terms_written_for),
      cmocka_unit_test(a_planar_step_on_events),
      cmocka_unit_test(four_steps_on_hulls_on_events),
      cmocka_unit_test(contacts_one_by_one_on_events),
      cmocka_unit_test(a_walk_under_load_on_events),
      cmocka_unit_test(a_walk_early_on_its_heel),
      cmocka_unit_test(a_limp_on_events),
      cmocka_unit_test(times_that_coincide),
      cmocka_unit_test(node_times_have_no_duration),
      cmocka_unit_test(a_walk_with_other_terms_on_events),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
