/* What is suggested when one row is missed by a known amount: the sentence, and settings that can
 * be handed to --set as they stand. With them the row gives way by that amount. */
#include "ambulo/ambulo.h"
#include "solver/suggest.h"
#include "support/engine_fixture.h"
#include "support/test.h"

static const char WALK[] = "models/walk_normal.yaml";

typedef struct miss {
  const char *file;
  const char *overrides[3]; /* of the problem that is missed */
  const char *family, *subject, *detail;
  double value;       /* of the last row of these labels */
  const char *phrase; /* in the sentence */
  const char *setting[3];
  int elsewhere; /* 1: the bound is not the row's constant */
} miss;

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
     "ground",
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
     "of left go 0.01 m further front",
     {"ground_reaction.pressure={heel: [-0.02, 0.03], roll: 0.04, flat: [-0.005, 0.02], toe: [-0.02"
      ", 0.0652], width: 0.035}"},
     1},
    {WALK,
     {0},
     "pressure",
     "left",
     "right",
     -0.005,
     "of left go 0.005 m further right",
     {"ground_reaction.pressure={heel: [-0.02, 0.03], roll: 0.04, flat: [-0.005, 0.02], toe: [-0.02"
      ", 0.055], width: 0.0402}"},
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
    {WALK,
     {0},
     "mirrored",
     "pelvis_ty",
     "value",
     -0.08,
     "stay 0.08 m apart",
     {"ends.kind=free"},
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
    {"models/yardstick_36.yaml",
     {0},
     "zmp",
     "support",
     "front",
     -0.01,
     "leaves the support by 0.01 m",
     {0},
     1},
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
    {"models/two_link_reach.yaml",
     {0},
     "final_state",
     "elbow",
     "value",
     0.1,
     "ask for another final "
     "value of elbow",
     {"ends.final.elbow="},
     0},
    {"models/two_link_reach.yaml",
     {0},
     "initial_state",
     "elbow",
     "rate",
     0.1,
     "ask for another initial "
     "rate of elbow",
     {"ends.initial_speed.elbow=5.72"},
     0}};
enum { MISSES = sizeof misses / sizeof *misses };

static ambulo_problem *load(const char *file, const char *const *overrides, int count) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  if (ambulo_problem_load(file, overrides, count, NULL, list, &problem)) {
    char text[600];
    ambulo_diagnostics_format(list, 0, text, sizeof text);
    for (int i = 0; i < count; i++) print_error("--set '%s' ", overrides[i]);
    print_error("%s\n", text);
  }
  ambulo_diagnostics_free(list);
  return problem;
}

/* the last row of the labels, at node `node` or any */
static int find_row(const ambulo_problem *p, const miss *m, int node) {
  int found = -1;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (!strcmp(row->family, m->family) && !strcmp(row->subject, m->subject) &&
        !strcmp(row->detail, m->detail) && (node < -1 || row->node == node))
      found = r;
  }
  return found;
}

static ambulo__explanation *suggest(const ambulo_problem *p, int row, double value) {
  ambulo__explanation *out = calloc(1, sizeof *out);
  double *values = calloc((size_t)p->rows, sizeof *values);
  values[row] = value;
  ambulo__remedy remedy = {.conflict = 0, .row = row, .value = values, .single = 1};
  ambulo__suggest(p, &remedy, out);
  free(values);
  return out;
}

/* the settings are accepted, and the row's bound has moved by what it was missed by */
static void follow(const miss *m, const ambulo_problem *p, int row,
                   const ambulo__explanation *out) {
  const char *all[6] = {NULL};
  int count = 0;
  for (int i = 0; i < 3 && m->overrides[i]; i++) all[count++] = m->overrides[i];
  for (int i = 0; i < out->view.setting_count; i++) all[count++] = out->setting[i];
  ambulo_problem *cured = load(m->file, all, count);
  assert_non_null(cured);
  if (!m->elsewhere) {
    int again = find_row(cured, m, p->table.rows[row].node);
    assert_true(again >= 0);
    double moved = cured->table.rows[again].constant - p->table.rows[row].constant;
    double wanted = p->table.rows[row].relation == AMBULO_EQUAL ? fabs(moved) : moved;
    if (!(wanted >= fabs(m->value) * (1.0 - 1e-3)))
      print_error("%s %s %s moved by %g\n", m->family, m->subject, m->detail, moved);
    assert_true(wanted >= fabs(m->value) * (1.0 - 1e-3)); /* settings of ends have four figures */
    assert_true(wanted <= fabs(m->value) * 1.2);
  }
  ambulo_problem_free(cured);
}

static void what_a_row_misses_can_be_set(void **state) {
  (void)state;
  for (int i = 0; i < MISSES; i++) {
    const miss *m = &misses[i];
    int overrides = 0, settings = 0;
    while (overrides < 3 && m->overrides[overrides]) overrides++;
    ambulo_problem *p = load(m->file, m->overrides, overrides);
    assert_non_null(p);
    int row = find_row(p, m, -2);
    if (row < 0) print_error("no %s %s %s in %s\n", m->family, m->subject, m->detail, m->file);
    assert_true(row >= 0);
    ambulo__explanation *out = suggest(p, row, m->value);
    if (!strstr(out->suggestion, m->phrase)) print_error("got '%s'\n", out->suggestion);
    assert_non_null(strstr(out->suggestion, m->phrase));
    while (settings < 3 && m->setting[settings]) settings++;
    if (out->view.setting_count != settings) print_error("case %d\n", i);
    assert_int_equal(out->view.setting_count, settings);
    for (int k = 0; k < settings; k++) {
      int same = !strncmp(out->setting[k], m->setting[k], strlen(m->setting[k]));
      if (!same) print_error("got '%s'; expected '%s'\n", out->setting[k], m->setting[k]);
      assert_true(same);
      assert_ptr_equal(out->settings[k], out->setting[k]);
    }
    if (settings > 0) follow(m, p, row, out);
    free(out);
    ambulo_problem_free(p);
  }
}

/* mu n - t and mu n + t of one node give n, t and the friction that holds */
static void friction_is_what_the_pair_of_rows_asks_for(void **state) {
  (void)state;
  ambulo_problem *p = load(WALK, NULL, 0);
  const miss m = {WALK, {0}, "friction", "total", "forward", 0.0, NULL, {0}, 1};
  int row = find_row(p, &m, 7);
  const double mu = p->definition.ground_reaction.friction, normal = 0.8, along = 0.52;
  double *values = calloc((size_t)p->rows, sizeof *values);
  int other = strcmp(p->table.rows[row + 1].subject, "total") == 0 &&
                      strcmp(p->table.rows[row + 1].detail, "backward") == 0
                  ? row + 1
                  : row - 1;
  assert_string_equal(p->table.rows[other].detail, "backward");
  values[row] = mu * normal - along;
  values[other] = mu * normal + along;
  ambulo__explanation *out = calloc(1, sizeof *out);
  ambulo__remedy remedy = {.conflict = 0, .row = row, .value = values, .single = 1};
  ambulo__suggest(p, &remedy, out);
  assert_string_equal(out->setting[0], "ground_reaction.friction=0.6515");
  assert_non_null(strstr(out->suggestion, "raise the friction from 0.5 to 0.6515"));
  free(out);
  free(values);
  ambulo_problem_free(p);
}

/* a problem made from C has no keys */
static void without_a_file_there_are_no_settings(void **state) {
  (void)state;
  ambulo_problem *p = load(WALK, NULL, 0);
  memset(&p->keys, 0, sizeof p->keys);
  for (int i = 0; i < MISSES; i++) {
    if (misses[i].file != WALK || misses[i].overrides[0]) continue;
    ambulo__explanation *out = suggest(p, find_row(p, &misses[i], -2), misses[i].value);
    assert_int_equal(out->view.setting_count, 0);
    assert_non_null(strstr(out->suggestion, misses[i].phrase));
    free(out);
  }
  ambulo_problem_free(p);
}

static void new_values_are_rounded_outward(void **state) {
  (void)state;
  assert_close(ambulo__outward(0.123449, 1), 0.1235, 1e-15);
  assert_close(ambulo__outward(0.123451, 0), 0.1234, 1e-15);
  assert_close(ambulo__outward(-123.44, 0), -123.5, 1e-12);
  assert_close(ambulo__outward(-123.46, 1), -123.4, 1e-12);
  assert_close(ambulo__outward(0.25, 1), 0.25, 1e-15);
  assert_true(ambulo__outward(0.0, 1) == 0.0 && isinf(ambulo__outward(INFINITY, 1)));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(what_a_row_misses_can_be_set),
                                     cmocka_unit_test(friction_is_what_the_pair_of_rows_asks_for),
                                     cmocka_unit_test(without_a_file_there_are_no_settings),
                                     cmocka_unit_test(new_values_are_rounded_outward)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
