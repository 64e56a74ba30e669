/* Every number that a file has a name for: the derivative of the Lagrangian by hand against central
 * differences over problems that are read anew with the number moved, at the same point and with
 * the same multipliers. The identity holds at any point and with any multipliers, so that those are
 * chosen such that every row counts: the best point a little off, random multipliers. */
#include "ambulo/ambulo.h"
#include "judge/result.h"
#include "sensitivity/partials.h"
#include "support/moved_problem.h"

enum { MOST_OVERRIDES = 8 };

typedef struct setting {
  const char *file;
  const char *overrides[MOST_OVERRIDES];
  const char *wanted[12]; /* names that have to be among those compared */
} setting;

static double noise(unsigned *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 8388608.0 - 1.0;
}

/* a result that says so of itself, at a point that is none */
static ambulo_result *scattered(const ambulo_problem *problem) {
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_problem_options(problem);
  unsigned state = 7;
  options.maximum_iterations = 3;
  options.continuation = 0;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  for (int i = 0; i < result->variables; i++) result->x[i] += 1e-3 * noise(&state);
  for (int r = 0; r < result->rows; r++) result->multiplier[r] = 0.1 * noise(&state);
  result->verdict = AMBULO_OPTIMAL;
  return result;
}

static double step_of(const ambulo_sensitivity *s) {
  return s->value == 0.0 ? 1e-3 * s->step : 1e-5 * fmax(fabs(s->value), 0.1 * s->step);
}

/* 0: the file refuses the number moved */
static int compare(const setting *c, int count, const ambulo_problem *problem,
                   const ambulo_result *r, const ambulo_sensitivity *s) {
  double value[2] = {NAN, NAN}, by = step_of(s);
  for (int k = 0; k < 2; k++) {
    ambulo_problem *moved = moved_problem(c->file, c->overrides, count, problem, s, k ? by : -by);
    if (moved) value[k] = lagrangian_at(moved, r->x, r->multiplier, r->rows);
    ambulo_problem_free(moved);
  }
  double difference = (value[1] - value[0]) / (2.0 * by);
  if (isnan(difference)) return 0;
  /* what rounding leaves of a difference of two values of this size */
  double slack = 1e-7 * fabs(s->derivative) + 4e-15 * (fabs(value[0]) + 1.0) / by;
  if (fabs(difference - s->derivative) <= slack) return 1;
  fail_msg("%s: %s is %.12g by hand, %.12g by differences (+- %.1g)", c->file, s->name,
           s->derivative, difference, slack);
  return 1;
}

/* `unwanted`: a name that has no derivative; NULL */
static void check(const setting *c, const char *unwanted) {
  int count = 0, compared = 0;
  ambulo_problem *problem = NULL;
  ambulo_sensitivity_list *list = NULL;
  while (count < MOST_OVERRIDES && c->overrides[count]) count++;
  assert_int_equal(ambulo_problem_load(c->file, c->overrides, count, NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_result *result = scattered(problem);
  assert_int_equal(ambulo_sensitivities(problem, result, NULL, &list), AMBULO_OK);
  int found[12] = {0};
  for (int i = 0; i < list->count; i++) {
    int did = compare(c, count, problem, result, &list->items[i]);
    compared += did;
    for (int k = 0; k < 12 && c->wanted[k]; k++)
      found[k] |=
          did && list->items[i].derivative != 0.0 && strcmp(c->wanted[k], list->items[i].name) == 0;
  }
  for (int k = 0; k < 12 && c->wanted[k]; k++)
    if (!found[k]) fail_msg("%s: %s was not compared", c->file, c->wanted[k]);
  for (int i = 0; unwanted && i < list->count; i++)
    assert_string_not_equal(unwanted, list->items[i].name);
  assert_true(compared > 6);
  ambulo_sensitivities_free(list);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void an_arm(void **state) {
  (void)state;
  static const setting c = {
      "models/two_link_reach.yaml",
      {"objective=[{term: torque_absolute, smoothing: 2, scale: {shoulder: 1.1, elbow: 0.9}, "
       "offset: {shoulder: 3, elbow: -1}}, "
       "{term: torque_rate, weight: 0.001, scale: {shoulder: 0.7}}, "
       "{term: torque_power, power: 2.5, scale: {shoulder: .01, elbow: .02}, "
       "strength: {shoulder: [40, 0.3, 0.1, 50, 0.2, -0.1], elbow: [30, 0.4, 1, 20, 0.5, 0.8]}, "
       "passive: {elbow: [-1, 0.5, 0.3, -0.7]}, offset: {elbow: 2}}]",
       "constraints.speed_limits=true"},
      {"time.duration", "ends.initial.shoulder", "ends.final_speed.elbow",
       "objective[torque_rate].scale.shoulder", "objective[torque_rate].weight",
       "objective[torque_absolute].offset.shoulder", "objective[torque_power].strength.elbow[3]",
       "objective[torque_power].strength.shoulder[0]", "objective[torque_power].offset.elbow",
       "model.links[upper].coordinate.torque[0]", "model.links[lower].coordinate.range[1]"}};
  check(&c, NULL);
}

/* ends that are its mirror image, rows on corners and places, a box for the zero-moment point */
static void a_planar_step(void **state) {
  (void)state;
  static const setting c = {
      "models/walker_2d_step.yaml",
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
      "models/walker_2d_step.yaml",
      {"gait=null", "ends=null", "time.duration=0.5", "angles=degrees",
       "contacts=[{foot: right, mode: flat, from: 0, to: 0.4, place: [0, 0]}, "
       "{foot: left, mode: heel, from: 0.3, to: 0.5, place: [0.4, 0]}]"},
      {"contacts[0].place[0]", "contacts[1].place[0]", "subject.mass", "ground.slope"}};
  check(&c, "time.duration");
}

static void breakpoints_stay_in_seconds(void **state) {
  (void)state;
  static const setting c = {"models/two_link_reach.yaml",
                            {"trajectory.intervals=null", "trajectory.breakpoints=[0, 0.3, 0.8]"},
                            {"ends.initial.shoulder"}};
  check(&c, "time.duration");
}

/* forces shared by two feet, tolerances, clearance, a load, a slope, every term of a walk */
static void a_walk_under_load(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {"ground_reaction.pressure={heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], "
       "roll: 0.04, width: 0.035}",
       "ground={slope: 3}", "constraints.torque_limits=true", "ground_reaction.shear=0.8"},
      {"load.mass", "subject.mass", "ground.slope", "gait.step_width",
       "ground_reaction.pressure.roll", "ground_reaction.pressure.flat[1]",
       "ground_reaction.pressure.width", "ground_reaction.friction", "ground_reaction.free_moment",
       "constraints.clearance.inward", "constraints.strike_pitch[0]", "time.duration"}};
  check(&c, NULL);
}

static void a_walk_with_other_terms(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {"objective=[{term: clearance, height: 0.06, weight: 3}, {term: posture, name: rests, "
       "scale: {knee_angle_r: 1, knee_angle_l: 1, hip_adduction_r: 2, hip_adduction_l: 2}, "
       "angles: {knee_angle_r: 10, knee_angle_l: 10, hip_adduction_r: 3, hip_adduction_l: 3}}, "
       "{term: mechanical_power, weight: 0.01}, {term: upright, weight: 10, "
       "points: [pelvis, head_top]}, {term: ground_force, weight: 0.3}]",
       "time.duration=null", "gait.speed=1.26"},
      {"objective[clearance].height", "objective[rests].angles.hip_adduction_r",
       "objective[rests].angles.knee_angle_r", "gait.speed", "gait.step_length",
       "constraints.clearance.turn", "constraints.contact_tolerance", "ground_reaction.shear",
       "constraints.orientation_tolerance", "constraints.clearance.ceiling", "load.mass"}};
  check(&c, NULL);
}

/* ------------------------------------------------------------ grids on events */

#define ON_EVENTS "time.grid=events", "trajectory.knots=events"

/* a node on an event has rows of both contacts, and half an interval of either length */
static void a_planar_step_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/walker_2d_step.yaml",
      {"angles=degrees", "constraints.zmp_margin=0.005", "constraints.speed_limits=true",
       "constraints.minimum_force=0.1", "trajectory.degree=4", ON_EVENTS},
      {"gait.step_length", "gait.speed", "subject.mass", "ground.slope", "constraints.zmp_margin",
       "constraints.minimum_force", "constraints.ground_height"}};
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
      "models/walker_2d_step.yaml",
      {"gait=null", "ends=null", "time.duration=0.5", "angles=degrees",
       "contacts=[{foot: right, mode: flat, from: 0, to: 0.3, place: [0, 0]}, "
       "{foot: right, mode: toe, from: 0.3, to: 0.4, place: [0.01, 0]}, "
       "{foot: left, mode: heel, from: 0.3, to: 0.5, place: [0.4, 0]}]",
       ON_EVENTS},
      {"contacts[0].place[0]", "contacts[1].place[0]", "contacts[2].place[0]", "subject.mass",
       "ground.slope"}};
  check(&c, "time.duration");
}

static void a_walk_under_load_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {"ground_reaction.pressure={heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], "
       "roll: 0.04, width: 0.035}",
       "ground={slope: 3}", "ground_reaction.shear=0.8", ON_EVENTS},
      {"load.mass", "subject.mass", "ground.slope", "gait.step_width", "gait.step_length",
       "ground_reaction.pressure.roll", "ground_reaction.pressure.flat[1]",
       "constraints.contact_tolerance", "constraints.orientation_tolerance",
       "constraints.clearance.inward", "constraints.strike_pitch[0]", "time.duration"}};
  check(&c, NULL);
}

static void a_walk_with_other_terms_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {"objective=[{term: clearance, height: 0.06, weight: 3}, "
       "{term: torque_rate, weight: 0.0001}, {term: mechanical_power, weight: 0.01}, "
       "{term: upright, weight: 10, points: [pelvis, head_top]}, "
       "{term: ground_force, weight: 0.3}]",
       "time.duration=null", "gait.speed=1.26", "trajectory.degree=5", ON_EVENTS},
      {"objective[clearance].height", "gait.speed", "gait.step_length",
       "constraints.clearance.turn", "constraints.clearance.ceiling", "load.mass",
       "constraints.ground_height", "objective[torque_rate].weight"}};
  check(&c, NULL);
}

/* contacts share the load: what they are told, their rows, a term on their forces */
#define SHARED                                                                                     \
  "ground_reaction={kind: shared, moment_arm: 0.15, slant: 0.3, loading_rate: 14, pressure: "      \
  "{heel: [-0.02, 0.03], flat: [-0.005, 0.02], toe: [-0.02, 0.055], roll: 0.04, width: 0.035}}",   \
      "objective=[{term: torque_squared, scale: {default: 0.001}}, {term: force_rate, weight: "    \
      "0.02}]"

static void a_walk_on_shared_contacts(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_loaded.yaml",
      {SHARED, "ground={slope: 3}", "constraints.torque_limits=true"},
      {"ground_reaction.moment_arm", "ground_reaction.slant", "ground_reaction.loading_rate",
       "ground_reaction.pressure.roll", "ground_reaction.pressure.flat[1]",
       "ground_reaction.pressure.width", "ground_reaction.friction", "ground_reaction.free_moment",
       "gait.step_width", "gait.step_length", "time.duration", "constraints.ground_height"}};
  check(&c, NULL);
}

static void a_walk_on_shared_contacts_on_events(void **state) {
  (void)state;
  static const setting c = {"models/walk_loaded.yaml",
                            {SHARED, "time.intervals=40", "time.duration=null", "gait.speed=1.26",
                             "ground_reaction.minimum_force=0.1", ON_EVENTS},
                            {"ground_reaction.moment_arm", "ground_reaction.slant",
                             "ground_reaction.loading_rate", "ground_reaction.pressure.heel[0]",
                             "ground_reaction.pressure.toe[0]", "load.mass", "subject.mass",
                             "gait.step_width", "gait.step_length", "gait.speed",
                             "ground_reaction.minimum_force", "ground.slope"}};
  check(&c, NULL);
}

/* no step length: it follows from the speed, and the time from both */
static void a_walk_at_a_speed(void **state) {
  (void)state;
  static const setting c = {"models/walk_normal.yaml",
                            {"gait.step_length=null", "time.duration=null", "gait.speed=1.26"},
                            {"gait.speed", "gait.step_width", "subject.mass"}};
  check(&c, NULL);
}

static void a_walk_in_tubes(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_tracking.yaml",
      {"constraints.tubes=[{reference: walk_tracking_angles.csv, coordinates: {hip_flexion_r: "
       "20}}, "
       "{reference: walk_tracking_angles.csv, coordinates: {knee_angle_r: 9}}]",
       "ends=null"},
      {"constraints.tubes[0].coordinates.hip_flexion_r",
       "constraints.tubes[1].coordinates.knee_angle_r"}};
  check(&c, "time.duration");
}

static void a_step_in_a_tube_on_both_sides(void **state) {
  (void)state;
  static const setting c = {"models/walk_tracking.yaml",
                            {"constraints.tubes=[{reference: walk_tracking_angles.csv, "
                             "coordinates: {knee_angle_r: 20, knee_angle_l: 20}}]"},
                            {"constraints.tubes[0].coordinates.knee_angle_r"}};
  check(&c, NULL);
}

/* left and right move together, the other way round */
static void two_arms(void **state) {
  (void)state;
  static const setting c = {
      "tests/sensitivity/two_arms_wave.yaml",
      {NULL},
      {"objective[torque_power].offset.lift_r", "objective[torque_power].strength.lift_r[3]",
       "objective[posture].angles.lift_r", "model.links[arm_r].coordinate.range[1]",
       "model.links[arm_r].coordinate.torque[0]"}};
  check(&c, NULL);
}

/* the whole walk put down elsewhere is the same walk */
static void a_walk_may_stand_anywhere(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  ambulo_result *result = NULL;
  ambulo__partials partials;
  ambulo__pool pool;
  assert_int_equal(ambulo_problem_load("models/walker_2d_step.yaml", NULL, 0, NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.optimality_tolerance = 1e-7;
  options.maximum_iterations = 1000;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(
      ambulo__partials_at(problem, workspace, result->x, result->multiplier, &pool, &partials),
      AMBULO_OK);
  double sum = 0.0, largest = 0.0;
  for (int c = 0; c < ambulo_problem_contact_count(problem); c++) {
    sum += partials.place[2 * c];
    largest = fmax(largest, fabs(partials.place[2 * c]));
  }
  assert_true(largest > 1.0);
  assert_true(fabs(sum) < 1e-5 * largest);
  assert_true(fabs(partials.ground_height) < 1e-5 * largest);
  ambulo__pool_clear(&pool);
  ambulo_workspace_free(workspace);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(an_arm),
      cmocka_unit_test(a_planar_step),
      cmocka_unit_test(four_steps_on_hulls),
      cmocka_unit_test(contacts_one_by_one),
      cmocka_unit_test(breakpoints_stay_in_seconds),
      cmocka_unit_test(a_walk_under_load),
      cmocka_unit_test(a_walk_with_other_terms),
      cmocka_unit_test(a_walk_at_a_speed),
      cmocka_unit_test(a_planar_step_on_events),
      cmocka_unit_test(four_steps_on_hulls_on_events),
      cmocka_unit_test(contacts_one_by_one_on_events),
      cmocka_unit_test(a_walk_under_load_on_events),
      cmocka_unit_test(a_walk_with_other_terms_on_events),
      cmocka_unit_test(a_walk_on_shared_contacts),
      cmocka_unit_test(a_walk_on_shared_contacts_on_events),
      cmocka_unit_test(a_walk_in_tubes),
      cmocka_unit_test(a_step_in_a_tube_on_both_sides),
      cmocka_unit_test(two_arms),
      cmocka_unit_test(a_walk_may_stand_anywhere),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
