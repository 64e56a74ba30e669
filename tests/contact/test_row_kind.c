/* The one table of row kinds: families, units and sizes of every row that a shipped problem or a
 * variant of one has, against lists written out here; and rows of the caller. */
#include "contact/row_kind.h"
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "support/problem_path.h"
#include "support/engine_fixture.h"

/* family, units that its rows come in, reluctance */
static const struct {
  const char *family, *units[6];
  double reluctance;
} want[] = {
    {"ground_penetration", {"m"}, 30.0},
    {"foot_strike", {"m"}, 3.0},
    {"contact", {"m", "rad"}, 3.0},
    {"clearance", {"m", "rad"}, 1.0},
    {"zmp", {"m"}, 1.0},
    {"normal_force", {"body weights"}, 30.0},
    {"pressure", {"m"}, 1.0},
    {"friction", {"body weights"}, 1.0},
    {"free_moment", {"m"}, 1.0},
    {"flight", {"body weights", "m"}, 30.0},
    {"joint_limit", {"m", "rad"}, 1.0},
    {"speed_limit", {"m/s", "rad/s"}, 1.0},
    {"torque_limit", {"N", "N m"}, 1.0},
    {"tracking_tube", {"m", "rad"}, 1.0},
    {"collision", {"m"}, 30.0},
    {"obstacle", {"m"}, 3.0},
    {"reach", {"m"}, 3.0},
    {"initial_state", {"m", "m/s", "m/s^2", "rad", "rad/s", "rad/s^2"}, 3.0},
    {"final_state", {"m", "m/s", "m/s^2", "rad", "rad/s", "rad/s^2"}, 3.0},
    {"periodic", {"m", "rad"}, 3.0},
    {"mirrored", {"m", "rad"}, 3.0},
};
enum { FAMILIES = sizeof want / sizeof *want };

static int number_of(const char *family) {
  for (int i = 0; i < FAMILIES; i++) {
    if (strcmp(want[i].family, family) == 0) return i;
  }
  print_error("no family '%s' is expected\n", family);
  fail();
  return 0;
}

static double size_by_hand(const char *unit, double weight) {
  if (!strcmp(unit, "N") || !strcmp(unit, "N m")) return weight;
  if (!strcmp(unit, "m/s") || !strcmp(unit, "rad/s")) return 10.0;
  if (!strcmp(unit, "m/s^2") || !strcmp(unit, "rad/s^2")) return 100.0;
  return 1.0;
}

static void check_row(const ambulo_problem *p, const ambulo__table_row *row) {
  int i = number_of(row->family), comes = 0;
  for (int u = 0; u < 6 && want[i].units[u]; u++) comes |= !strcmp(row->unit, want[i].units[u]);
  if (!comes) print_error("%s: a row of %s in %s\n", p->definition.name, row->family, row->unit);
  assert_true(comes);
  assert_string_equal(ambulo__row_family(row->kind), row->family);
  assert_string_equal(ambulo__measure_text(row->measure), row->unit);
  assert_int_equal(ambulo__measure_of_text(row->unit), row->measure);
  assert_close(row->size, size_by_hand(row->unit, p->table.weight), 0.0);
  const ambulo__table_row *first = &p->table.rows[p->table.group_row[row->group]];
  assert_string_equal(first->family, row->family);
  assert_int_equal(ambulo__row_kind_entry_of(row->kind)->place == AMBULO__ACROSS_ENDS,
                   !strcmp(row->family, "periodic") || !strcmp(row->family, "mirrored"));
}

static ambulo_problem *load(const char *name, const char *const *overrides, int count) {
  char path[96];
  ambulo_problem *p = NULL;
  problem_path(name, path, sizeof path);
  assert_int_equal(ambulo_problem_load(path, overrides, count, NULL, NULL, &p), AMBULO_OK);
  return p;
}

/* no shipped problem has a tube: a narrow one around zero */
static ambulo_problem *with_tube(const ambulo_problem *base) {
  static const double reference[4] = {0.0}, half_width[2] = {0.5, 0.0};
  static const ambulo_tube tube = {2, reference, half_width};
  ambulo_problem *p = NULL;
  ambulo_problem_definition d = base->definition;
  d.tubes = &tube;
  d.tube_count = 1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &p), AMBULO_OK);
  return p;
}

static void every_row_is_of_a_kind(void **state) {
  (void)state;
  static const struct {
    const char *name, *overrides[2];
  } problems[] = {
      {"support/walk_rigid", {NULL}},
      {"support/walk_rigid", {"constraints.torque_limits=true"}},
      {"support/walk_rigid", {"constraints.joint_limits=nodes"}},
      {"walk", {NULL}},
      {"support/walk_rigid", {NULL}},
      {"support/walk_rigid", {NULL}},
      {"walk_loaded", {NULL}},
      {"walk_uphill", {NULL}},
      {"walk_tracking", {NULL}},
      {"walk_asymmetric", {NULL}},
      {"run", {NULL}},
      {"reach_standing", {NULL}},
      {"walk_without_reaction", {NULL}},
      {"yardstick_12", {NULL}},
      {"yardstick_36", {NULL}},
      {"yardstick_72", {NULL}},
      {"fig5a_feasible", {NULL}},
      {"fig5b_torque", {NULL}},
      {"walker_2d_step", {NULL}},
      {"pendulum_swing", {NULL}},
      {"two_link_reach", {NULL}},
      {"two_link_reach",
       {"constraints.speed_limits=true", "model.links[lower].coordinate.speed=[-900, 900]"}}};
  int seen[FAMILIES] = {0};
  for (size_t k = 0; k < sizeof problems / sizeof *problems; k++) {
    const char *const *overrides = problems[k].overrides;
    ambulo_problem *p = load(problems[k].name, overrides, !!overrides[0] + !!overrides[1]);
    assert_true(p->rows > 0);
    for (int r = 0; r < p->rows; r++) {
      check_row(p, &p->table.rows[r]);
      seen[number_of(p->table.rows[r].family)]++;
    }
    ambulo_problem_free(p);
  }
  ambulo_problem *base = load_problem("two_link_reach"), *tube = with_tube(base);
  for (int r = 0; r < tube->rows; r++) {
    check_row(tube, &tube->table.rows[r]);
    seen[number_of(tube->table.rows[r].family)]++;
  }
  ambulo_problem_free(tube);
  ambulo_problem_free(base);
  for (int i = 0; i < FAMILIES; i++) {
    if (!seen[i]) print_error("no problem has a row of %s\n", want[i].family);
    assert_true(seen[i]);
  }
}

static void what_the_table_says(void **state) {
  (void)state;
  for (int i = 0; i < FAMILIES; i++) {
    const ambulo__row_kind_entry *entry = ambulo__row_kind_entry_of((ambulo__row_kind)i);
    assert_string_equal(entry->family, want[i].family);
    assert_close(entry->reluctance, want[i].reluctance, 0.0);
    int is_limit = strstr(entry->family, "_limit") != NULL;
    assert_int_equal(entry->limited != AMBULO__NOT_LIMITED, is_limit);
    if (is_limit) assert_int_equal(ambulo__row_kind_of_limit((ambulo_limited)entry->limited), i);
    assert_int_equal(entry->place != AMBULO__AT_TIMES, i >= number_of("initial_state"));
  }
  assert_int_equal(AMBULO__KIND_USER, FAMILIES);
  assert_string_equal(ambulo__row_family(AMBULO__KIND_SLIP), "slip");
  assert_string_equal(ambulo__row_family(AMBULO__KIND_GROUND_FORCE), "ground_force");
}

static void rates_follow_what_they_are_rates_of(void **state) {
  (void)state;
  static const char *const units[2][3] = {{"m", "m/s", "m/s^2"}, {"rad", "rad/s", "rad/s^2"}};
  for (int order = 0; order < 3; order++) {
    for (int turns = 0; turns < 2; turns++) {
      ambulo_joint_type type = turns ? AMBULO_REVOLUTE : AMBULO_PRISMATIC;
      ambulo__measure measure = ambulo__row_measure(AMBULO__KIND_FINAL_STATE, type, order);
      assert_string_equal(ambulo__measure_text(measure), units[turns][order]);
    }
  }
  assert_int_equal(ambulo__row_measure(AMBULO__KIND_TORQUE_LIMIT, AMBULO_REVOLUTE, 0),
                   AMBULO__NEWTON_METRES);
  assert_int_equal(ambulo__row_measure(AMBULO__KIND_TORQUE_LIMIT, AMBULO_PRISMATIC, 0),
                   AMBULO__NEWTONS);
  assert_int_equal(ambulo__measure_of_text("apples"), AMBULO__OTHER_MEASURE);
  assert_int_equal(ambulo__measure_of_text(""), AMBULO__OTHER_MEASURE);
}

static double nothing(void *user, const ambulo_node_state *state, ambulo_node_gradient *gradient) {
  (void)user, (void)state, (void)gradient;
  return 0.0;
}

/* kept apart from the engine's rows, even under a name of theirs; one family a name */
static void rows_of_the_caller(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("two_link_reach"), *with = NULL;
  ambulo_user_row own[] = {{"torque_limit", "N", AMBULO_NOT_NEGATIVE, 0.0, 9.0, nothing, NULL},
                           {"apples", "apples", AMBULO_EQUAL, 0.0, 9.0, nothing, NULL},
                           {"torque_limit", "m/s", AMBULO_EQUAL, 0.0, 9.0, nothing, NULL}};
  static const double size[] = {0.0, 1.0, 10.0};
  ambulo_problem_definition d = p->definition;
  d.user_rows = own;
  d.user_row_count = 3;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &with), AMBULO_OK);
  assert_int_equal(with->rows, p->rows + 3 * p->nodes);
  assert_int_equal(with->table.group_count, p->table.group_count + 2);
  int engines = -1;
  for (int r = 0; r < with->rows; r++) {
    const ambulo__table_row *row = &with->table.rows[r];
    if (row->user < 0 && row->kind == AMBULO__KIND_TORQUE_LIMIT) engines = row->group;
    assert_int_equal(row->kind == AMBULO__KIND_USER, row->user >= 0);
    if (row->user < 0) continue;
    assert_string_equal(row->family, own[row->user].name);
    assert_string_equal(row->unit, own[row->user].unit);
    assert_int_equal(row->relation, own[row->user].relation);
    assert_true(row->group != engines);
    assert_int_equal(row->group, p->table.group_count + (row->user == 1));
    double expected = row->user == 0 ? with->table.weight : size[row->user];
    assert_close(row->size, expected, 0.0);
  }
  assert_true(engines >= 0);
  ambulo_problem_free(with);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_row_is_of_a_kind), cmocka_unit_test(what_the_table_says),
      cmocka_unit_test(rates_follow_what_they_are_rates_of), cmocka_unit_test(rows_of_the_caller)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
