/* Numbers of devices and of what hands hold, and what else moves when bodies have them, by hand
 * against central differences. */
#include "support/sensitivity_check.h"

/* beside a foot's stride; angles in degrees */
static void springs_on_four_steps(void **state) {
  (void)state;
  static const setting c = {
      "models/yardstick_12.yaml",
      {"angles=degrees", "time.duration=null", "gait.step_time=0.6105",
       "devices=[{name: ankle_r, kind: spring, coordinate: ankle_r, stiffness: 180, rest: -3, "
       "pretension: 4, side: above, smoothing: 5, foot: right, "
       "engaged: {from: 0.02, to: 0.6, ramp: 0.1}, mirror: true}, "
       "{name: tendon, kind: spring, between: [{link: foot_r, position: [0.1, 0, 0]}, "
       "{link: foot_l, position: [0.1, 0, 0]}], stiffness: 120, rest: 0.25, side: above, "
       "smoothing: 0.05}, "
       "{name: brake, kind: damper, between: [{link: foot_r, position: [0, 0, 0]}, "
       "{link: pelvis, position: [0, 0.3, 0.1]}], damping: 12}, "
       "{name: motor, kind: actuator, coordinate: hip_flexion_l, amount: 3, by: stride, foot: "
       "left, "
       "points: [[0, 1], [0.3, 2.5], [0.7, -1]]}, "
       "{name: push, kind: actuator, coordinate: knee_r, amount: -4, by: time, "
       "points: [[0.1, 0], [0.5, 1], [1.9, 0.2]]}, "
       "{name: pull, kind: actuator, coordinate: knee_l, amount: 2}]",
       "objective=[{term: torque_squared, weight: 0.01, scale: {pelvis_tx: 0.05, pelvis_ty: 0.05, "
       "pelvis_tz: 0.05}, offset: {pelvis_tz: body_weight}}, "
       "{term: device_effort, weight: 0.02, scale: {tendon: 0.3, brake: 0.1, default: 0.05}}]"},
      {"devices[ankle_r].stiffness", "devices[ankle_r].rest", "devices[ankle_r].pretension",
       "devices[ankle_r].smoothing", "devices[ankle_r].engaged.from", "devices[ankle_r].engaged.to",
       "devices[ankle_r].engaged.ramp", "devices[tendon].stiffness", "devices[tendon].rest",
       "devices[brake].damping", "devices[motor].amount", "devices[push].amount",
       "devices[pull].amount", "gait.step_time", "objective[device_effort].weight",
       "ground.slope"}};
  check(&c, NULL);
}

/* both sides listed, mirrored ends, contacts that share the load, nodes on events that move */
static void a_mirrored_step_on_events(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_normal.yaml",
      {"time.intervals=30", "trajectory.intervals=9",
       "devices=[{name: ankle_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: "
       "-30, "
       "side: above, smoothing: 4, foot: right, engaged: {from: 0.05, to: 0.65, ramp: 0.08}}, "
       "{name: ankle_l, kind: spring, coordinate: ankle_angle_l, stiffness: 150, rest: -30, "
       "side: above, smoothing: 4, foot: left, engaged: {from: 0.05, to: 0.65, ramp: 0.08}}, "
       "{name: hip, kind: actuator, coordinate: hip_flexion_r, amount: 4, by: stride, foot: right, "
       "points: [[0, -1], [0.4, 0.5], [0.6, 2]], mirror: true}, "
       "{name: band, kind: spring, between: [{point: heel_r}, {point: heel_l}], stiffness: 60, "
       "rest: 0.3, pretension: 2}]"},
      {"devices[ankle_r].stiffness", "devices[ankle_r].rest", "devices[hip].amount",
       "devices[band].stiffness", "devices[band].rest", "devices[band].pretension",
       "gait.phases.toe_off", "gait.phases.heel_off", "subject.mass", "ground.slope",
       "devices[ankle_r].engaged.to"}};
  check(&c, NULL);
}

/* rotors and brakes: of one side, of both with mirrored ends, of a joint that nothing drives */
static void drives(void **state) {
  (void)state;
  static const setting walk = {
      "models/walk_normal.yaml",
      {"time.intervals=30", "trajectory.intervals=9",
       "model.links[shank_l].coordinate.armature=0.001",
       "model.links[shank_r].coordinate.armature=0.001",
       "model.links[shank_l].coordinate.friction=0.004",
       "model.links[shank_r].coordinate.friction=0.004"},
      {"model.links[shank_r].coordinate.armature", "model.links[shank_r].coordinate.friction"}};
  static const setting swing = {
      "models/acrobot_swing.yaml",
      {"time.intervals=60", "trajectory.intervals=30", "model.links[trunk].coordinate.damping=2",
       "model.links[legs].coordinate.armature=0.5"},
      {"model.links[trunk].coordinate.damping", "model.links[legs].coordinate.armature"}};
  check(&walk, NULL);
  check(&swing, NULL);
}

static void several_loads(void **state) {
  (void)state;
  static const setting c = {"models/walk_normal.yaml",
                            {"time.intervals=24", "trajectory.intervals=9",
                             "load=[{link: pelvis, mass: 12, position: [-0.2, 0.4, 0]}, "
                             "{link: foot_r, mass: 1.5, position: [0.05, 0, 0]}, "
                             "{link: foot_l, mass: 1.5, position: [0.05, 0, 0]}]"},
                            {"load[0].mass", "load[1].mass", "subject.mass", "ground.slope"}};
  check(&c, NULL);
}

/* a strike inside the motion is an event: strides move with it */
static void strikes_that_move(void **state) {
  (void)state;
  static const setting c = {
      "tests/support/walker_2d_step.yaml",
      {"gait=null", "ends={kind: periodic, order: 1, travel: 0.8}", "time.duration=1",
       "angles=degrees",
       "contacts=[{foot: right, mode: flat, from: 0, to: 0.45, place: [0, 0]}, "
       "{foot: left, mode: toe, from: 0, to: 0.1, place: [-0.4, 0]}, "
       "{foot: left, mode: flat, from: 0.4, to: 1, place: [0.4, 0]}, "
       "{foot: right, mode: toe, from: 0.45, to: 0.6, place: [0, 0]}, "
       "{foot: right, mode: heel, from: 0.9, to: 1, place: [0.8, 0]}]",
       "time.grid=events", "time.intervals=24", "trajectory.knots=events", "trajectory.degree=4",
       "trajectory.intervals=10",
       "devices=[{name: knee, kind: spring, coordinate: knee_angle_l, stiffness: 90, rest: 4, "
       "foot: left, engaged: {from: 0.8, to: 0.4, ramp: 0.1}}, "
       "{name: hip, kind: actuator, coordinate: hip_flexion_r, amount: 5, by: stride, foot: right, "
       "points: [[0.1, -1], [0.4, 0.5], [0.6, 2]]}]"},
      {"contacts[2].from", "contacts[4].from", "devices[knee].stiffness", "devices[hip].amount",
       "devices[knee].engaged.from"}};
  check(&c, NULL);
}

/* Springs that have no stiffness: what the first of it would save, against differences to one side
 * over 0, h and 2 h, since a file has none below 0. */
static void springs_of_no_stiffness(void **state) {
  (void)state;
  static const setting c = {
      "models/walk_normal.yaml",
      {"time.intervals=24", "trajectory.intervals=9",
       "devices=[{name: exo_r, kind: spring, coordinate: ankle_angle_r, stiffness: 0, rest: 1, "
       "side: above, smoothing: 4, mirror: true}, "
       "{name: band, kind: spring, between: [{point: heel_r}, {point: heel_l}], stiffness: 0, "
       "rest: 0.3, pretension: 2}]"},
      {NULL}};
  static const struct {
    const char *name, *unit, *words;
  } wanted[2] = {{"devices[exo_r].stiffness", "N m/rad", "1 N m/rad more stiffness of exo_r (both"},
                 {"devices[band].stiffness", "N/m", "10 N/m more stiffness of band "}};
  listed l = list_open(&c);
  for (int k = 0; k < 2; k++) {
    const ambulo_sensitivity *s = NULL;
    double value[3], by = 1e-3;
    for (int i = 0; i < l.list->count; i++)
      if (strcmp(l.list->items[i].name, wanted[k].name) == 0) s = &l.list->items[i];
    assert_non_null(s);
    assert_string_equal(s->unit, wanted[k].unit);
    assert_memory_equal(s->words, wanted[k].words, strlen(wanted[k].words));
    for (int i = 0; i < 3; i++) {
      ambulo_problem *moved = moved_problem(c.file, c.overrides, l.count, l.problem, s, i * by);
      assert_non_null(moved);
      value[i] = lagrangian_at(moved, l.result->x, l.result->multiplier, l.result->rows);
      ambulo_problem_free(moved);
    }
    double difference = (4.0 * value[1] - 3.0 * value[0] - value[2]) / (2.0 * by);
    assert_true(fabs(s->derivative) > 1e-6);
    assert_true(fabs(s->derivative - difference) <=
                1e-7 * fabs(s->derivative) + 1e-14 * (fabs(value[0]) + 1.0) / by);
  }
  list_close(&l);
}

/* held all along in a step that is its own mirror image: the body's numbers are not the box's */
static void a_box_in_both_hands(void **state) {
  (void)state;
  static const setting c = {"models/walk_carrying.yaml",
                            {"written_for=null", "time.intervals=40"},
                            {"load[box].mass", "load[box].inertia", "load[box].center[0]",
                             "load[box].center[2]", "subject.mass", "ground.slope",
                             "gait.step_width", "gait.speed", "gait.phases.toe_off.comfortable",
                             "ground_reaction.moment_arm", "ground_reaction.loading_rate"}};
  check(&c, "load[box].center[1]");
}

/* times of its own on a grid on events: nodes go along */
static void from_the_floor_to_a_table(void **state) {
  (void)state;
  static const setting c = {"models/lift.yaml",
                            {"load[box].from=0.85", "load[box].to=2.87", "time.intervals=50",
                             "obstacles[table].heading=3"}, /* parallel edges have a kink */
                            {"load[box].mass", "load[box].inertia", "load[box].center[0]",
                             "load[box].center[1]", "load[box].center[2]", "load[box].from",
                             "load[box].to", "load[box].ramp", "subject.mass", "ground.slope"}};
  check(&c, "time.duration");
}

/* times at which rows of a reach begin, too */
static void times_that_are_shared_have_none(void **state) {
  (void)state;
  static const setting c = {"models/lift.yaml", {"time.intervals=50"}, {NULL}};
  static const char *const absent[] = {"load[box].from", "load[box].to", "load[box].ramp", NULL};
  expect_absent(&c, absent);
  /* a longer motion would have its end inside */
  static const setting at_the_end = {"tests/support/two_link_reach.yaml",
                                     {"load={hands: [hand], mass: 1.5, from: 0.2, to: 0.8}"},
                                     {NULL}};
  static const char *const no_duration[] = {"time.duration", "load.to", NULL};
  expect_absent(&at_the_end, no_duration);
}

/* one hand, and both; a load on a link between them in the list; nodes that stay */
static void a_wall_and_a_bag(void **state) {
  (void)state;
  static const setting c = {
      "models/push_wall.yaml",
      {"load=[{name: wall, hands: [hand_r, hand_l], force: [250, 20, -30], from: 0.71, to: 1.93, "
       "ramp: 0.25}, {link: thorax, mass: 7, position: [0, 0.1, 0.1]}, {hands: [hand_l], mass: 3, "
       "force: [40, 5, 20], from: 1.31}]",
       "time.grid=uniform", "time.intervals=50"},
      {"load[wall].force[0]", "load[wall].force[1]", "load[wall].force[2]", "load[wall].from",
       "load[wall].to", "load[wall].ramp", "load[1].mass", "load[2].mass", "load[2].force[1]",
       "load[2].from", "load[2].ramp", "subject.mass", "ground.slope"}};
  check(&c, "load[2].to");
}

/* without a ground: the window stays in seconds while the motion is slowed down */
static void in_the_hand_of_an_arm(void **state) {
  (void)state;
  static const setting c = {"tests/support/two_link_reach.yaml",
                            {"load={hands: [hand], mass: 1.5, force: [3, 0, -2], from: 0.21, to: "
                             "0.69, ramp: 0.1}"},
                            {"load.mass", "load.force[0]", "load.force[2]", "load.from", "load.to",
                             "load.ramp", "time.duration"}};
  check(&c, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(springs_on_four_steps),
      cmocka_unit_test(a_mirrored_step_on_events),
      cmocka_unit_test(drives),
      cmocka_unit_test(several_loads),
      cmocka_unit_test(strikes_that_move),
      cmocka_unit_test(springs_of_no_stiffness),
      cmocka_unit_test(a_box_in_both_hands),
      cmocka_unit_test(from_the_floor_to_a_table),
      cmocka_unit_test(times_that_are_shared_have_none),
      cmocka_unit_test(a_wall_and_a_bag),
      cmocka_unit_test(in_the_hand_of_an_arm),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
