/* What is suggested where a force on the ground, its centre or its moment misses its bounds. */
#include "contact/contacts.h"
#include "support/suggest_cases.h"

static const char NARROW[] = "tests/infeasible/support_too_narrow.yaml";

static const miss misses[] = {
    {WALK,
     {0},
     "clearance",
     "heel_r",
     "to the left",
     -0.01,
     "inward of feet",
     {"constraints.clearance.inward=0.0402"},
     0},
    {WALK,
     {0},
     "normal_force",
     "ground",
     "vertical",
     -0.1,
     "fall to 0.099 body weights instead of 0.2",
     {"ground_reaction.minimum_force=0.099"},
     0},
    {WALK,
     {0},
     "normal_force",
     "ground",
     "vertical",
     -0.3,
     "have to pull with 0.1 body weights",
     {0},
     1},
    {WALK,
     {0},
     "free_moment",
     "left",
     "to the left",
     -0.01,
     "be up to 0.0302 body weights m",
     {"ground_reaction.free_moment=0.0302"},
     0},
    {WALK,
     {0},
     "pressure",
     "left",
     "front",
     -0.01,
     "left would have to carry a moment of 0.01 body weights m (front) with hardly a force",
     {0},
     1},
    {"models/yardstick_36.yaml",
     {0},
     "ground_penetration",
     "heel_lateral_l",
     "height",
     0.01,
     "above the ground",
     {"constraints.contact_tolerance=0.0102"},
     1},
    {NARROW,
     {0},
     "zmp",
     "support",
     "front",
     -0.1,
     "0.1 m (front) at t = ",
     {"constraints.zmp_margin=0"},
     1},
    {NARROW,
     {0},
     "zmp",
     "support",
     "front",
     -0.08,
     "from 0.08 m to 0 m",
     {"constraints.zmp_margin=0"},
     1},
    {WALK,
     {0},
     "pressure",
     "left",
     "back",
     -0.01,
     "left would have to carry a moment of 0.01 body weights m (back) with hardly a force",
     {0},
     1},
    /* more than a key may be: the sentence alone */
    {WALK, {0}, "free_moment", "left", "to the left", -20.0, "be up to 20.", {0}, 1},
    {"models/yardstick_36.yaml",
     {0},
     "zmp",
     "support",
     "front",
     -0.01,
     "leaves the support by 0.01 m",
     {0},
     1},
};
enum { MISSES = sizeof misses / sizeof *misses };

/* contacts that share the load */
#define SHARED "ground_reaction={kind: shared}"
static const miss shared[] = {
    {WALK,
     {SHARED},
     "normal_force",
     "left",
     "loaded too fast",
     -0.1,
     "than its loading rate of 15 body weights/s lets it",
     {"ground_reaction.loading_rate="},
     0},
    {WALK,
     {SHARED},
     "normal_force",
     "left",
     "pulls",
     -0.1,
     "would have to pull on left with 0.1 body weights",
     {0},
     1},
    {WALK,
     {SHARED},
     "free_moment",
     "left",
     "to the left",
     -0.01,
     "be up to 0.0302 body weights m",
     {"ground_reaction.free_moment=0.0302"},
     0},
    /* both sides of the patch say that nothing presses there */
    {WALK,
     {SHARED},
     "pressure",
     "left",
     "front",
     -0.01,
     "a moment of 0.01 body weights m (front) with hardly a force",
     {0},
     1},
    /* nothing holds the body; a moment is in those times 1 m of 1.75 m */
    {"models/run.yaml",
     {"subject.stature=1.4"},
     "flight",
     "body",
     "pushed up",
     -0.01,
     "in flight the body would have to be pushed up by 0.01 body weights more",
     {"ground_reaction.flight_tolerance="},
     1},
    {"models/run.yaml",
     {0},
     "flight",
     "body",
     "tipped forward",
     -0.01,
     "tipped forward by 0.01 body weights m more",
     {"ground_reaction.flight_tolerance="},
     1},
    /* all feet together, where that is a row */
    {WALK,
     {"ground_reaction={kind: shared, minimum_force: 0.2}"},
     "normal_force",
     "ground",
     "vertical",
     -0.1,
     "fall to 0.099 body weights instead of 0.2",
     {"ground_reaction.minimum_force=0.099"},
     0},
};

static void contacts_that_share_have_words_of_their_own(void **state) {
  (void)state;
  try_misses(shared, sizeof shared / sizeof *shared);
}

/* what is suggested where a side of a box is missed by 1 cm of half the body weight */
static ambulo__explanation *suggest_pressed(const ambulo_problem *p, const miss *m, int node) {
  miss pushes = *m;
  pushes.family = "normal_force";
  pushes.detail = "pulls";
  int row = find_row(p, m, node), force = find_row(p, &pushes, node);
  assert_true(row >= 0 && force >= 0);
  double *values = calloc((size_t)p->rows, sizeof *values);
  ambulo__explanation *out = calloc(1, sizeof *out);
  values[row] = -0.01;
  values[force] = 0.5;
  ambulo__remedy remedy = {.conflict = 0, .row = row, .value = values, .single = 1};
  ambulo__suggest(p, &remedy, out);
  free(values);
  return out;
}

/* 1 cm of half the body weight are 2 cm of the centre of pressure: of either end, and of the width.
 * The foot that is flat has its corners at the heel and 0.04 m to either side */
static void pressure_is_missed_by_what_its_force_makes_of_it(void **state) {
  (void)state;
#define GIVEN                                                                                      \
  "ground_reaction={kind: shared, pressure: {heel: [-0.02, 0.03], roll: 0.04, flat: [-0.005, "     \
  "0.02], toe: [-0.02, 0.055], width: 0.035}}"
#define HEEL "heel: [-0.02, 0.03], roll: 0.04, "
#define TOE ", toe: [-0.02, 0.055], "
  static const struct {
    const char *settings, *detail, *phrase, *boxes;
  } cases[] = {{GIVEN, "front", "of left go 0.02 m further front",
                HEEL "flat: [-0.005, 0.0404]" TOE "width: 0.035"},
               {GIVEN, "back", "of left go 0.02 m further back",
                HEEL "flat: [-0.0254, 0.02]" TOE "width: 0.035"},
               {GIVEN, "left", "of left go 0.02 m further left",
                HEEL "flat: [-0.005, 0.02]" TOE "width: 0.0554"},
               {GIVEN, "right", "of left go 0.02 m further right",
                HEEL "flat: [-0.005, 0.02]" TOE "width: 0.0554"},
               {SHARED, "front", "of left go 0.02 m further front", "flat: [0, 0.0404]"},
               {SHARED, "back", "of left go 0.02 m further back", "flat: [-0.0204, 0.02]"},
               {SHARED, "left", "of left go 0.02 m further left", "width: 0.0604"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const char *settings[] = {cases[i].settings};
    ambulo_problem *p = load(WALK, settings, 1);
    char setting[200];
    (void)snprintf(setting, sizeof setting, "ground_reaction.pressure={%s, arc: 0.0006}",
                   cases[i].boxes);
    const miss m = {WALK,  {cases[i].settings}, "pressure", "left", cases[i].detail,
                    -0.01, cases[i].phrase,     {setting},  1};
    ambulo__explanation *out = suggest_pressed(p, &m, 16);
    expect_advice(&m, out);
    follow(&m, p, find_row(p, &m, 16), out);
    free(out);
    ambulo_problem_free(p);
  }
}

static void what_a_row_misses_can_be_set(void **state) {
  (void)state;
  try_misses(misses, MISSES);
}

/* while a foot goes from heel to flat its pressure is in both boxes: both are moved */
static void on_an_event_both_boxes_move(void **state) {
  (void)state;
  static const char *const settings[] = {"time.grid=events"};
  ambulo_problem *p = load(WALK, settings, 1);
  const miss m = {
      WALK,
      {"time.grid=events"},
      "pressure",
      "left",
      "front",
      -0.01,
      "of left go 0.02 m further front",
      {"ground_reaction.pressure={heel: [0, 0.021], roll: 0.04, flat: [0, 0.0404], arc: 0.0006}"},
      1};
  ambulo__explanation *out = suggest_pressed(p, &m, 4);
  expect_advice(&m, out);
  follow(&m, p, find_row(p, &m, 4), out);
  free(out);
  ambulo_problem_free(p);
}

static void without_a_file_there_are_no_settings(void **state) {
  (void)state;
  try_without_keys(misses, MISSES);
}

/* a cone that misses by g asks for g / N more, N the normal force of its contact and node */
static void friction_is_what_the_cone_asks_for(void **state) {
  (void)state;
  ambulo_problem *p = load(WALK, NULL, 0);
  const miss slips = {WALK, {0}, "friction", "left", "slips", 0.0, NULL, {0}, 1};
  const miss pulls = {WALK, {0}, "normal_force", "left", "pulls", 0.0, NULL, {0}, 1};
  int row = find_row(p, &slips, 7);
  const double mu = p->definition.ground_reaction.friction, normal = 0.8, along = 0.52;
  double *values = calloc((size_t)p->rows, sizeof *values);
  values[row] = mu * normal - along;
  values[find_row(p, &pulls, 7)] = normal;
  values[find_row(p, &slips, 6)] = -1e-9; /* unloaded: no friction follows from it */
  ambulo__explanation *out = calloc(1, sizeof *out);
  ambulo__remedy remedy = {.conflict = 0, .row = row, .value = values, .single = 1};
  ambulo__suggest(p, &remedy, out);
  assert_string_equal(out->setting[0], "ground_reaction.friction=0.6515");
  assert_non_null(strstr(out->suggestion, "raise the friction from 0.5 to 0.6515"));
  free(out);
  free(values);
  ambulo_problem_free(p);
}

/* no friction holds where the ground pulls, or hardly carries */
static void friction_that_does_not_help_is_not_asked_for(void **state) {
  (void)state;
  static const double tries[][2] = {{-0.1, 0.0}, {-0.5, 0.04}, {-0.1, -0.3}}; /* c, N */
  ambulo_problem *p = load(WALK, NULL, 0);
  const miss slips = {WALK, {0}, "friction", "left", "slips", 0.0, NULL, {0}, 1};
  const miss pulls = {WALK, {0}, "normal_force", "left", "pulls", 0.0, NULL, {0}, 1};
  int row = find_row(p, &slips, 7), normal = find_row(p, &pulls, 7);
  for (int i = 0; i < 3; i++) {
    ambulo__explanation *out = calloc(1, sizeof *out);
    double *values = calloc((size_t)p->rows, sizeof *values);
    ambulo__remedy remedy = {.conflict = 0, .row = row, .value = values, .single = 1};
    values[row] = tries[i][0];
    values[normal] = tries[i][1];
    ambulo__suggest(p, &remedy, out);
    if (out->view.setting_count) print_error("case %d: '%s'\n", i, out->setting[0]);
    assert_int_equal(out->view.setting_count, 0);
    assert_non_null(strstr(out->suggestion, "more than friction holds"));
    free(values);
    free(out);
  }
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(contacts_that_share_have_words_of_their_own),
      cmocka_unit_test(pressure_is_missed_by_what_its_force_makes_of_it),

      cmocka_unit_test(what_a_row_misses_can_be_set),
      cmocka_unit_test(on_an_event_both_boxes_move),
      cmocka_unit_test(without_a_file_there_are_no_settings),
      cmocka_unit_test(friction_is_what_the_cone_asks_for),
      cmocka_unit_test(friction_that_does_not_help_is_not_asked_for)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
