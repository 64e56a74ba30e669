/* What is suggested when one row is missed by a known amount: the sentence, and settings that can
 * be handed to --set as they stand. With them the row gives way by that amount. Limits and ends. */
#include "support/suggest_cases.h"

static const miss misses[] = {
    {WALK,
     {0},
     "joint_limit",
     "knee_angle_l",
     "upper",
     -0.1,
     "raise the upper end of the range of "
     "knee_angle_l by 0.1 rad: from 2.094 (120 deg) to 2.196 rad (126 deg)",
     {"model.links[shank_l].coordinate.range=[0, 125.",
      "model.links[shank_r].coordinate.range=[0, 125."},
     0},
    {WALK,
     {0},
     "joint_limit",
     "pelvis_list",
     "lower",
     -0.1,
     "lower the lower end of the range of "
     "pelvis_list by 0.1 rad",
     {"model.links[pelvis_lean].coordinate.range=[-25."},
     1},
    {WALK,
     {"constraints.torque_limits=true"},
     "torque_limit",
     "ankle_angle_r",
     "lower",
     -10.0,
     "lower the lower torque limit of ankle_angle_r by 10 N m",
     {"model.links[talus_r].coordinate.torque=[-0.1",
      "model.links[talus_l].coordinate.torque=[-0.1"},
     0},
    {WALK,
     {"model.links[shank_r].coordinate.speed=[-500, none]",
      "model.links[shank_l].coordinate.speed=[-500, none]", "constraints.speed_limits=true"},
     "speed_limit",
     "knee_angle_r",
     "lower",
     -1.0,
     "lower the lower speed limit of knee_angle_r",
     {"model.links[shank_r].coordinate.speed=[-55", "model.links[shank_l].coordinate.speed=[-55"},
     0},
    {WALK,
     {0},
     "pressure",
     "left",
     "right",
     -0.005,
     "left would have to carry a moment of 0.005 body weights m (right) with hardly a force",
     {0},
     1},
    {WALK,
     {0},
     "mirrored",
     "pelvis_tx",
     "value",
     -0.08,
     "gets 0.6 m forward where 0.68 m",
     {"gait.step_length=0.6"},
     0},
    {WALK,
     {"time.duration=null", "gait.speed=1.25"},
     "mirrored",
     "pelvis_tx",
     "value",
     -0.08,
     "gets 0.6 m forward where 0.68 m",
     {"gait.step_length=0.6", "gait.speed=1.10"},
     0},
    {WALK,
     {"ends.travel=0.68"},
     "mirrored",
     "pelvis_tx",
     "value",
     -0.08,
     "gets 0.6 m forward",
     {"gait.step_length=0.6", "ends.travel=0.6"},
     0},
    {"tests/infeasible/support_too_narrow.yaml",
     {0},
     "zmp",
     "support",
     "front",
     -0.02,
     "lower the margin of the zero-moment point by 0.02 m: from 0.08 m to 0.0598",
     {"constraints.zmp_margin=0.0598"},
     1},
    {"tests/infeasible/equalities_contradict.yaml",
     {0},
     "periodic",
     "pelvis_tx",
     "value",
     -0.3,
     "change the travel from 0.3 m to 0 m",
     {"ends.travel=0"},
     0},
    {"tests/infeasible/equalities_contradict.yaml",
     {0},
     "tracking_tube",
     "pelvis_tx",
     "on",
     0.15,
     "leave the motion that it follows by 0.15 m",
     {"constraints.tubes[0].coordinates.pelvis_tx=0.1515"},
     1},
    {"tests/support/two_link_reach.yaml",
     {0},
     "final_state",
     "elbow",
     "value",
     0.1,
     "ask for another final "
     "value of elbow",
     {"ends.final.elbow="},
     0},
    {"tests/support/two_link_reach.yaml",
     {0},
     "initial_state",
     "elbow",
     "rate",
     0.1,
     "ask for another initial "
     "rate of elbow",
     {"ends.initial_speed.elbow=5.72"},
     0},
    {"tests/support/two_link_reach.yaml",
     {"ends.final_acceleration={elbow: 0}"},
     "final_state",
     "elbow",
     "acceleration",
     0.1,
     "ask for another final "
     "acceleration of elbow",
     {"ends.final_acceleration.elbow="},
     0},
};
enum { MISSES = sizeof misses / sizeof *misses };

static void what_a_row_misses_can_be_set(void **state) {
  (void)state;
  try_misses(misses, MISSES);
}

static void without_a_file_there_are_no_settings(void **state) {
  (void)state;
  try_without_keys(misses, MISSES);
}

/* partners whose signs differ have their limits at opposite ends */
static void a_sign_turns_the_partners_limit(void **state) {
  (void)state;
  static const miss m = {WALK,    {0},  "joint_limit",    "hip_rotation_l",
                         "upper", -0.1, "hip_rotation_l", {"model.links[", "model.links["},
                         1};
  ambulo_problem *p = load(WALK, NULL, 0);
  int l = ambulo_model_find_coordinate(p->model, "hip_rotation_l");
  ambulo_coordinate *c = (ambulo_coordinate *)&p->model->coordinates[l];
  c->mirror_sign = -1.0;
  ambulo__explanation *out = suggest(p, find_row(p, &m, 3), m.value);
  expect_advice(&m, out);
  assert_non_null(strstr(out->setting[0], "range=[-40, 45."));
  assert_non_null(strstr(out->setting[1], "range=[-45."));
  assert_non_null(strstr(out->setting[1], ", 40]"));
  free(out);
  ambulo_problem_free(p);
}

/* what a descent leaves of zero is zero; accelerations are not set */
static void ends_are_set(void **state) {
  (void)state;
  static const char file[] = "tests/support/two_link_reach.yaml";
  ambulo_problem *p = load(file, NULL, 0);
  miss m = {file,    {0}, "final_state",          "elbow",
            "value", 0.0, "final value of elbow", {"ends.final.elbow=0"},
            1};
  int row = find_row(p, &m, -2);
  m.value = p->table.rows[row].constant + 4e-6;
  ambulo__explanation *out = suggest(p, row, m.value);
  expect_advice(&m, out);
  assert_string_equal(out->setting[0], "ends.final.elbow=0");
  free(out);
  m = (miss){file,
             {0},
             "final_state",
             "elbow",
             "acceleration",
             0.1,
             "final acceleration",
             {"ends.final_acceleration.elbow="},
             1};
  p->table.rows[row].detail = m.detail;
  expect_at(p, &m, -2);
  ambulo_problem_free(p);
}

/* the travel is that of all steps, and a coordinate may point against it */
static void travel_is_shared_by_the_steps(void **state) {
  (void)state;
  static const miss m = {WALK,    {0},  "mirrored",           "pelvis_tx",
                         "value", 0.08, "gets 0.6 m forward", {"gait.step_length=0.3"},
                         1};
  ambulo_problem *p = load(WALK, NULL, 0);
  int row = find_row(p, &m, -2);
  p->keys.steps = 2;
  p->table.rows[row].constant = -p->table.rows[row].constant;
  expect_at(p, &m, -2);
  ambulo_problem_free(p);
}

/* the width that is there and what is missed; of two tubes it is not known which */
static void one_tube_is_widened(void **state) {
  (void)state;
  static const char file[] = "tests/infeasible/equalities_contradict.yaml";
  miss m = {file, {0},  "tracking_tube",    "pelvis_tx",
            "on", 0.15, "leave the motion", {"constraints.tubes[0].coordinates.pelvis_tx=0.2515"},
            1};
  ambulo_problem *p = load(file, NULL, 0);
  const ambulo_tube *kept = p->definition.tubes;
  int i = ambulo_model_find_coordinate(p->model, "pelvis_tx");
  ((double *)kept->half_width)[i] = 0.1;
  expect_at(p, &m, -2);
  ambulo_tube both[2] = {kept[0], kept[0]};
  p->definition.tubes = both;
  p->definition.tube_count = 2;
  m.setting[0] = NULL;
  expect_at(p, &m, -2);
  p->definition.tubes = kept;
  p->definition.tube_count = 1;
  ambulo_problem_free(p);
}

/* rows of the family that must be relaxed too are reported, one by name */
static void others_are_mentioned(void **state) {
  (void)state;
  static const char *const phrases[3] = {NULL, "; likewise knee_angle_r upper by 0.05 rad",
                                         "; likewise the other rows named under joint_limit"};
  const miss m = {.family = "joint_limit", .subject = "knee_angle_l", .detail = "upper"};
  ambulo_problem *p = load(WALK, NULL, 0);
  double *values = calloc((size_t)p->rows, sizeof *values);
  for (int single = 0; single < 2; single++) {
    for (int count = 0; count < 3; count++) {
      ambulo__explanation *out = calloc(1, sizeof *out);
      ambulo__remedy remedy = {.row = find_row(p, &m, -2), .value = values, .single = single};
      values[remedy.row] = -0.1;
      out->conflict[0].shared.family = "joint_limit";
      out->conflict[0].other_count = count;
      out->conflict[0].others[0] = (ambulo_violation){
          .subject = "knee_angle_r", .detail = "upper", .unit = "rad", .worst = 0.05};
      ambulo__suggest(p, &remedy, out);
      assert_int_equal(strstr(out->suggestion, "; likewise") != NULL, count > 0 && !single);
      if (count > 0 && !single) assert_non_null(strstr(out->suggestion, phrases[count]));
      free(out);
    }
  }
  free(values);
  ambulo_problem_free(p);
}

static double nothing(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user, (void)state, (void)gradient;
  return 0.0;
}

/* a row of the caller may be called what the engine calls its own: it is none of them */
static void own_rows_are_not_taken_for_others(void **state) {
  (void)state;
  static const char *const names[] = {"torque_limit", "final_state", "mirrored", "tracking_tube",
                                      "foot_strike",  "friction",    "zmp",      "reach"};
  ambulo_problem *p = load(WALK, NULL, 0);
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    ambulo_user_row own = {names[i], "N", AMBULO_NOT_NEGATIVE, 0.0, 10.0, nothing, NULL};
    ambulo_problem_definition d = p->definition;
    ambulo_problem *with = NULL;
    char sentence[80];
    d.user_rows = &own;
    d.user_row_count = 1;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &with), AMBULO_OK);
    ambulo__explanation *out = suggest(with, with->rows - 1, -2.0);
    (void)snprintf(sentence, sizeof sentence, "let %s of  () give way by 2 N", names[i]);
    if (!strstr(out->suggestion, sentence)) print_error("got '%s'\n", out->suggestion);
    assert_non_null(strstr(out->suggestion, sentence));
    free(out);
    ambulo_problem_free(with);
  }
  ambulo_problem_free(p);
}

static void settings_have_room(void **state) {
  (void)state;
  ambulo_problem *p = load(WALK, NULL, 0);
  ambulo__explanation *out = calloc(1, sizeof *out);
  ambulo__advice a = {.problem = p, .out = out};
  for (int i = 0; i < AMBULO__MOST_SETTINGS + 3; i++) ambulo__advice_set(&a, "number=%d", i);
  assert_int_equal(out->view.setting_count, AMBULO__MOST_SETTINGS);
  free(out);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_row_misses_can_be_set),
                                     cmocka_unit_test(without_a_file_there_are_no_settings),
                                     cmocka_unit_test(a_sign_turns_the_partners_limit),
                                     cmocka_unit_test(ends_are_set),
                                     cmocka_unit_test(travel_is_shared_by_the_steps),
                                     cmocka_unit_test(one_tube_is_widened),
                                     cmocka_unit_test(others_are_mentioned),
                                     cmocka_unit_test(own_rows_are_not_taken_for_others),
                                     cmocka_unit_test(settings_have_room)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
