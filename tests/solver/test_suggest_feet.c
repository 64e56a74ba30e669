/* What is suggested where feet miss their places, their angles or their height in the air. */
#include "support/suggest_cases.h"
#include "support/toed_body.h"

static const miss misses[] = {
    {WALK,
     {0},
     "contact",
     "heel_l",
     "ahead",
     -0.003,
     "is 0.003 m further ahead than its contact lets",
     {"constraints.contact_tolerance=0.0052"},
     0},
    {WALK,
     {0},
     "contact",
     "left",
     "left side low",
     -0.02,
     "widen the tolerance of its direction",
     {"constraints.orientation_tolerance=0.0201"},
     1},
    {WALK, {0}, "contact", "left", "toes high", -0.01, "to turn further", {0}, 1},
    {WALK,
     {0},
     "clearance",
     "ball_r",
     "low",
     -0.005,
     "lower the clearance of feet in the air from "
     "0.02 m to ",
     {"constraints.clearance.height="},
     0},
    {WALK,
     {0},
     "clearance",
     "ball_r",
     "high",
     -0.01,
     "let the height of feet in the air be up to "
     "0.3602",
     {"constraints.clearance.ceiling=0.3602"},
     0},
    {WALK,
     {0},
     "clearance",
     "right",
     "turned left",
     -0.05,
     "let the turn (sine)",
     {"constraints.clearance.turn=0.2505"},
     0},
    {WALK,
     {0},
     "clearance",
     "heel_r",
     "to the right",
     -0.01,
     "outward of feet",
     {"constraints.clearance.outward=0.0702"},
     0},
    {WALK,
     {"constraints.ground_height=0.1"},
     "clearance",
     "ball_r",
     "low",
     -0.005,
     "lower the clearance of feet in the air",
     {"constraints.clearance.height="},
     0},
    {WALK,
     {"constraints.clearance.feet=0.02"},
     "clearance",
     "heel_r",
     "near the other foot",
     -0.004,
     "let feet pass each other 0.01571 m apart instead of 0.02 m",
     {"constraints.clearance.feet=0.01571"},
     1},
    {WALK,
     {"constraints.clearance.feet=0.02"},
     "clearance",
     "ball_l",
     "near the other foot",
     -0.03,
     "put the footholds further apart",
     {0},
     1},
    /* more than a key may be: the sentence alone */
    {WALK, {0}, "contact", "heel_l", "ahead", -0.2, "give them more time", {0}, 1},
    {WALK, {0}, "contact", "left", "left side low", -1.2, "widen the tolerance", {0}, 1},
    {WALK, {0}, "clearance", "ball_r", "low", -0.05, "give the step more time", {0}, 1},
    {WALK, {0}, "clearance", "right", "turned left", -0.9, "let the turn (sine)", {0}, 1},
    {WALK,
     {0},
     "mirrored",
     "pelvis_ty",
     "value",
     -0.08,
     "stay 0.08 m apart",
     {"ends.kind=free"},
     1},
    {"models/stairs_up.yaml",
     {0},
     "mirrored",
     "pelvis_tx",
     "rate",
     -0.08,
     "leave the ends free",
     {"ends.kind=free", "ends.rise=0"},
     1},
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

/* at the first node the left heel strikes, at the fifth the foot is flat: pitch of either */
static void pitch_belongs_to_the_phase(void **state) {
  (void)state;
  static const miss low = {WALK,
                           {0},
                           "contact",
                           "left",
                           "toes low",
                           -0.05,
                           "strike the ground "
                           "flatter",
                           {"constraints.strike_pitch=[9.05"},
                           1};
  static const miss high = {WALK,
                            {0},
                            "contact",
                            "left",
                            "toes high",
                            -0.05,
                            "strike the ground "
                            "steeper",
                            {"constraints.strike_pitch=[12, 27.2"},
                            1};
  static const miss upright = {WALK, {0},       "contact", "left", "toes high",
                               -0.6, "steeper", {NULL},    1};
  static const miss flat = {WALK,
                            {0},
                            "contact",
                            "left",
                            "toes low",
                            -0.02,
                            "widen the tolerance",
                            {"constraints.orientation_tolerance=0.0302"},
                            1};
  ambulo_problem *p = load(WALK, NULL, 0);
  expect_at(p, &low, 0);
  expect_at(p, &high, 0);
  expect_at(p, &upright, 0); /* no angle has a sine above 1 */
  expect_at(p, &flat, 5);
  ambulo_problem_free(p);
}

/* the place that explains the bound is looked for on the row's side: -0.05 + 0.03, not -0.08 + 0.06
 */
static void the_track_is_on_its_side(void **state) {
  (void)state;
  static const miss inward = {WALK,
                              {0},
                              "clearance",
                              "heel_r",
                              "to the left",
                              -0.01,
                              "inward of",
                              {"constraints.clearance.inward=0.0402"},
                              1};
  ambulo_problem *p = load(WALK, NULL, 0);
  ambulo_contact *contacts = (ambulo_contact *)p->definition.contacts;
  contacts[p->definition.contact_count - 1].place[1] = 0.08;
  expect_at(p, &inward, -2);
  ambulo_problem_free(p);
}

/* feet that stand too far apart ask for a shorter step, feet that are both off for other places */
static void spacing_counts_where_it_is_most_of_the_miss(void **state) {
  (void)state;
  static const char *const phrases[2] = {"shorten the step from 0.6 m to 0.549 m",
                                         "move the foothold of heel_r"};
  const miss front = {.family = "foot_strike", .subject = "heel_r", .detail = "forward"};
  const miss back = {.family = "foot_strike", .subject = "toe_l", .detail = "forward"};
  ambulo_problem *p = load("tests/support/walker_2d_step.yaml", NULL, 0);
  double *values = calloc((size_t)p->rows, sizeof *values);
  ambulo__remedy remedy = {.conflict = 0, .row = find_row(p, &front, 0), .value = values};
  remedy.single = 1;
  values[remedy.row] = -0.05;
  for (int off = 0; off < 2; off++) {
    ambulo__explanation *out = calloc(1, sizeof *out);
    values[find_row(p, &back, 0)] = -0.04 * off;
    ambulo__suggest(p, &remedy, out);
    if (!strstr(out->suggestion, phrases[off])) print_error("got '%s'\n", out->suggestion);
    assert_non_null(strstr(out->suggestion, phrases[off]));
    free(out);
  }
  free(values);
  ambulo_problem_free(p);
}

/* every step counts for the travel and the speed; steps unlike each other have no one length */
static void step_settings_fit_together(void **state) {
  (void)state;
  ambulo_problem *p = load(WALK, NULL, 0);
  ambulo__explanation *out = calloc(1, sizeof *out);
  ambulo__advice a = {.problem = p, .out = out};
  p->keys.steps = 2;
  p->keys.speed = p->keys.travel = 1;
  ambulo__advice_set_step(&a, -0.27); /* backward: a speed has no sign */
  assert_int_equal(out->view.setting_count, 3);
  assert_string_equal(out->setting[0], "gait.step_length=-0.27");
  assert_string_equal(out->setting[1], "gait.speed=1");
  assert_string_equal(out->setting[2], "ends.travel=-0.54");
  out->view.setting_count = 0;
  p->keys.unlike_steps = 1;
  ambulo__advice_set_step(&a, 0.27);
  assert_int_equal(out->view.setting_count, 0);
  free(out);
  ambulo_problem_free(p);
}

/* from flat to toes the flat foot leaves less room, and the toes' pitch is not to be widened; a
 * foot that leaves was on its toes */
static void on_an_event_the_tighter_contact_counts(void **state) {
  (void)state;
  static const char *const settings[] = {"time.grid=events"};
  ambulo_problem *p = load(WALK, settings, 1);
  const miss turned = {WALK,
                       {0},
                       "contact",
                       "left",
                       "turned left",
                       -0.01,
                       "widen the tolerance of its direction",
                       {"constraints.orientation_tolerance=0.0202"},
                       1};
  const miss pitched = {
      WALK, {0}, "contact", "left", "toes high", -0.01, "change the times of its phases", {0}, 1};
  const miss left = {WALK,
                     {0},
                     "contact",
                     "right",
                     "turned left",
                     -0.01,
                     "widen the tolerance of its direction",
                     {"constraints.orientation_tolerance=0.0151"},
                     1};
  expect_at(p, &turned, 19);
  expect_at(p, &pitched, 19);
  expect_at(p, &left, 6);
  ambulo_problem_free(p);
}

/* the rear foot is held by its ball, which is on the link of the toes */
static void a_step_between_toes_and_a_heel_is_shortened(void **state) {
  (void)state;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_contact contacts[12];
  ambulo_model *model = toed_body();
  ambulo_problem *p = NULL;
  const ambulo_gait gait = {.size = sizeof(ambulo_gait),
                            .contact_size = sizeof(ambulo_contact),
                            .steps = 1,
                            .step_length = 0.68,
                            .step_time = 0.54,
                            .step_width = 0.1,
                            .foot_flat = 0.08,
                            .heel_off = 0.38,
                            .toe_off = 0.62,
                            .other_step_length = AMBULO_OFF,
                            .other_step_time = AMBULO_OFF};
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 12, &d.contact_count), AMBULO_OK);
  d.model = model;
  d.duration = 0.54;
  d.contacts = contacts;
  d.foot_strike = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &p), AMBULO_OK);
  const miss front = {NULL, {0}, "foot_strike", "heel_r", "forward", 0.0, NULL, {0}, 1};
  const miss rear = {NULL, {0}, "foot_strike", "ball_l", "forward", 0.0, NULL, {0}, 1};
  int ahead = find_row(p, &front, 0), behind = find_row(p, &rear, 0);
  assert_true(ahead >= 0 && behind >= 0);
  double *values = calloc((size_t)p->rows, sizeof *values);
  ambulo__explanation *out = calloc(1, sizeof *out);
  values[ahead] = -0.05;
  values[behind] = 0.05;
  ambulo__remedy remedy = {.conflict = 0, .row = ahead, .value = values, .single = 1};
  ambulo__suggest(p, &remedy, out);
  assert_non_null(strstr(out->suggestion, "shorten the step from 0.68 m to 0.58 m or less"));
  free(out);
  free(values);
  ambulo_problem_free(p);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_row_misses_can_be_set),
                                     cmocka_unit_test(without_a_file_there_are_no_settings),
                                     cmocka_unit_test(pitch_belongs_to_the_phase),
                                     cmocka_unit_test(on_an_event_the_tighter_contact_counts),
                                     cmocka_unit_test(the_track_is_on_its_side),
                                     cmocka_unit_test(spacing_counts_where_it_is_most_of_the_miss),
                                     cmocka_unit_test(a_step_between_toes_and_a_heel_is_shortened),
                                     cmocka_unit_test(step_settings_fit_together)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
