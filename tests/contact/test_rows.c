/* The one table of row kinds: families, units and sizes of every row that a shipped problem or a
 * variant of one has, against lists written out here; and rows of the caller. */
#include "ambulo/tools/load.h"
#include "contact/rows.h"
#include "problem/nlp.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"
#include "support/problem_path.h"
#include "support/row_fixture.h"
#include "support/test.h"

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
    {"passive", {"N", "N m"}, 30.0},
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
  /* cones and arcs are judged relative to what their contact may carry */
  int by_load = ambulo__row_curved_of(&p->table, row) &&
                (!strcmp(row->family, "friction") || !strcmp(row->family, "pressure"));
  double size = size_by_hand(row->unit, p->table.weight);
  if (by_load)
    assert_true(row->size > 0.0 && row->size <= size);
  else
    assert_close(row->size, size, 0.0);
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
      {"support/walk_without_reaction", {NULL}},
      {"yardstick_12", {NULL}},
      {"acrobot_swing", {NULL}},
      {"yardstick_36", {NULL}},
      {"yardstick_72", {NULL}},
      {"fig5a_feasible", {NULL}},
      {"fig5b_torque", {NULL}},
      {"support/walker_2d_step", {NULL}},
      {"pendulum_swing", {NULL}},
      {"support/two_link_reach", {NULL}},
      {"support/two_link_reach",
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
  ambulo_problem *base = load_problem("support/two_link_reach"), *tube = with_tube(base);
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
  ambulo_problem *p = load_problem("support/two_link_reach"), *with = NULL;
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

static int test_row_kind_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_row_is_of_a_kind), cmocka_unit_test(what_the_table_says),
      cmocka_unit_test(rates_follow_what_they_are_rates_of), cmocka_unit_test(rows_of_the_caller)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The row table: growth, terms that belong to their row, families, memory running out. */

static void rows_and_terms_grow(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  for (int r = 0; r < 1000; r++) {
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "subject", "detail", AMBULO__METRES, AMBULO_EQUAL,
                      r, 0.1 * r, -r);
    for (int t = 0; t < r % 4; t++) ambulo__row_term_add(&table, r, t, 1.0 + t);
    ambulo__row_term_add(&table, r, 99, 0.0);
  }
  assert_int_equal(table.status, AMBULO_OK);
  assert_int_equal(table.row_count, 1000);
  assert_int_equal(table.term_count, 1500);
  int next = 0;
  for (int r = 0; r < 1000; r++) {
    assert_int_equal(table.rows[r].first_term, next);
    assert_int_equal(table.rows[r].term_count, r % 4);
    assert_int_equal(table.rows[r].user, -1);
    assert_close(table.rows[r].constant, -r, 0.0);
    next += r % 4;
  }
  assert_int_equal(table.terms[next - 1].node, 999);
  assert_close(table.terms[next - 1].coefficient, 3.0, 0.0);
  ambulo__row_table_clear(&table);
  assert_int_equal(table.row_count, 0);
  ambulo__row_table_clear(&table);
}

static void rows_know_which_phase_they_are_of(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  for (int r = 0; r < 4; r++) {
    table.before = r / 2;
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, r, 0.0,
                      0.0);
  }
  for (int r = 0; r < 4; r++) assert_int_equal(table.rows[r].before, r / 2);
  ambulo__row_table_clear(&table);
}

static void no_memory_is_remembered(void **state) {
  (void)state;
  for (long k = 0; k < 3; k++) { /* the rows, their families, the terms */
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__row_table table;
    ambulo__row_table_init(&table, &allocator);
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, 0, 0.0,
                      0.0);
    ambulo__row_term_add(&table, 0, 0, 1.0);
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, 0, 0.0,
                      0.0);
    assert_int_equal(table.status, AMBULO_E_MEMORY);
    assert_int_equal(table.row_count, k == 2);
    assert_int_equal(table.term_count, 0);
    ambulo__row_table_clear(&table);
    assert_int_equal(memory.live, 0);
  }
}

static void what_is_missed(void **state) {
  (void)state;
  ambulo__table_row row = {.relation = AMBULO_EQUAL};
  assert_close(ambulo__row_missed(&row, 0.25), 0.25, 0.0);
  assert_close(ambulo__row_missed(&row, -0.25), 0.25, 0.0);
  assert_true(ambulo__row_missed(&row, NAN) == HUGE_VAL);
  row.relation = AMBULO_NOT_NEGATIVE;
  assert_close(ambulo__row_missed(&row, 0.25), 0.0, 0.0);
  assert_close(ambulo__row_missed(&row, -0.25), 0.25, 0.0);
  assert_true(ambulo__row_missed(&row, NAN) == HUGE_VAL);
  assert_true(ambulo__row_missed(&row, INFINITY) == HUGE_VAL);
}

static void begin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                  const char *detail, int node) {
  ambulo__row_begin(table, kind, subject, detail, AMBULO__METRES, AMBULO_EQUAL, node, 0.1 * node,
                    0.0);
}

static void families_are_numbered_as_they_begin(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  begin(&table, AMBULO__KIND_ZMP, "s", "front", 0);
  begin(&table, AMBULO__KIND_CONTACT, "s", "front", 0);
  begin(&table, AMBULO__KIND_ZMP, "s", "front", 1);
  begin(&table, AMBULO__KIND_ZMP, "s", "back", 1);
  begin(&table, AMBULO__KIND_ZMP, "other", "front", 1);
  begin(&table, AMBULO__KIND_SLIP, "s", "front", 1);
  static const int group[] = {0, 1, 0, 0, 0, 2}, alike[] = {1, 0, 1, 0, 0, 0};
  assert_int_equal(table.group_count, 3);
  for (int r = 0; r < 6; r++) {
    assert_int_equal(table.rows[r].group, group[r]);
    assert_int_equal(ambulo__rows_alike(&table.rows[0], &table.rows[r]), alike[r]);
  }
  assert_int_equal(table.group_row[1], 1);
  assert_int_equal(table.group_row[2], 5);
  ambulo__row_table_clear(&table);
  assert_int_equal(table.group_count, 0);
}

static int test_row_table_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rows_and_terms_grow), cmocka_unit_test(rows_know_which_phase_they_are_of),
      cmocka_unit_test(no_memory_is_remembered), cmocka_unit_test(what_is_missed),
      cmocka_unit_test(families_are_numbered_as_they_begin)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_row_kind_tests() + test_row_table_tests();
}
