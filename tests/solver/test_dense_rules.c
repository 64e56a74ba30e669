/* The one table of tolerances: every row of every shipped problem has a line of its own in it, and
 * docs/results.md says the same. */
#include "solver/dense.h"
#include "support/arm.h"
#include "support/engine_fixture.h"

static const char *const names[] = {"support/walk_rigid",
                                    "walk",
                                    "support/walk_rigid",
                                    "support/walk_rigid",
                                    "walk_loaded",
                                    "walk_uphill",
                                    "walk_tracking",
                                    "yardstick_12",
                                    "walk_asymmetric",
                                    "fig5b_torque",
                                    "support/walker_2d_step",
                                    "support/walk_without_reaction",
                                    "support/two_link_reach",
                                    "fig5a_feasible",
                                    "pendulum_swing"};

static void check_rows(const char *name, const char *override) {
  ambulo_problem *p = load_problem_with(name, override);
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    int rule = ambulo__dense_rule_of_row(row);
    if (rule < 0) {
      assert_null(strstr("contact clearance zmp pressure joint_limit slip", row->family));
      continue;
    }
    const ambulo__dense_rule *found = ambulo__dense_rule_at(rule);
    assert_string_equal(ambulo__row_family(found->kind), row->family);
    if (found->measure != AMBULO__OTHER_MEASURE)
      assert_string_equal(ambulo__measure_text(found->measure), row->unit);
    assert_true(found->measure != AMBULO__OTHER_MEASURE || found->of_limit);
  }
  ambulo_problem_free(p);
}

static void every_shipped_row_has_a_rule(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) check_rows(names[i], NULL);
  check_rows("support/two_link_reach", "constraints.torque_limits=true");
}

static void every_kind_has_a_rule_but_ends_and_own_rows(void **state) {
  (void)state;
  for (int kind = 0; kind < AMBULO__ROW_KINDS; kind++) {
    const ambulo__row_kind_entry *entry = ambulo__row_kind_entry_of((ambulo__row_kind)kind);
    const ambulo__measure measures[] = {entry->straight, entry->turning};
    for (int i = 0; i < 2; i++) {
      ambulo__table_row row = {.kind = (unsigned char)kind, .measure = (unsigned char)measures[i]};
      int none = entry->place != AMBULO__AT_TIMES || kind == AMBULO__KIND_USER;
      assert_int_equal(ambulo__dense_rule_of_row(&row) == -1, none);
    }
  }
}

/* the larger of a coordinate's two bounds, by hand for two_link's own limits */
static void limits_are_compared_with_the_larger_bound(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach");
  ambulo_coordinate *shoulder = &((ambulo_model *)p->model)->coordinates[0];
  const ambulo__table_row *row = NULL;
  for (int r = 0; r < p->rows && !row; r++) {
    const ambulo__table_row *one = &p->table.rows[r];
    if (!strcmp(one->family, "torque_limit") && !strcmp(one->subject, shoulder->name)) row = one;
  }
  assert_non_null(row);
  double keep[2] = {shoulder->torque[0], shoulder->torque[1]};
  shoulder->torque[0] = -30.0;
  shoulder->torque[1] = 20.0;
  assert_close(ambulo__dense_limit_size(p, row), 30.0, 0.0);
  shoulder->torque[0] = -INFINITY;
  assert_close(ambulo__dense_limit_size(p, row), 20.0, 0.0);
  shoulder->torque[0] = shoulder->torque[1] = 0.0;
  assert_close(ambulo__dense_limit_size(p, row), 0.1 * ambulo__model_weight(p->model), 1e-12);
  ambulo_model *model = (ambulo_model *)p->model;
  double gravity[3], none[3] = {0.0, 0.0, 0.0};
  memcpy(gravity, model->gravity, sizeof gravity);
  memcpy(model->gravity, none, sizeof none); /* then 1 N m, not a ratio to nothing */
  assert_close(ambulo__dense_limit_size(p, row), 1.0, 0.0);
  memcpy(model->gravity, gravity, sizeof gravity);
  memcpy(shoulder->torque, keep, sizeof keep);
  ambulo_problem_free(p);
}

/* 1 rad/s where a joint is not to move */
static void speeds_have_limits_of_their_own(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &p), AMBULO_OK);
  ambulo_coordinate *elbow = &model->coordinates[1];
  int rows = 0;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (row->kind != AMBULO__KIND_SPEED_LIMIT || strcmp(row->subject, elbow->name)) continue;
    rows++;
    elbow->speed[0] = -3.0;
    elbow->speed[1] = 7.0;
    assert_close(ambulo__dense_limit_size(p, row), 7.0, 0.0);
    elbow->speed[0] = elbow->speed[1] = 0.0;
    assert_close(ambulo__dense_limit_size(p, row), 1.0, 0.0);
  }
  assert_true(rows > 0);
  ambulo_problem_free(p);
  ambulo_model_free(model);
}

static char *read_all(const char *path) {
  FILE *file = fopen(path, "rb");
  assert_non_null(file);
  fseek(file, 0, SEEK_END);
  size_t size = (size_t)ftell(file);
  rewind(file);
  char *text = calloc(size + 1, 1);
  assert_non_null(text);
  assert_int_equal(fread(text, 1, size, file), size);
  fclose(file);
  return text;
}

/* "| `slip` | m | 0.001 |" */
static void the_documentation_says_the_same(void **state) {
  (void)state;
  char *text = read_all("docs/results.md");
  for (int i = 0; i < AMBULO__DENSE_RULES; i++) {
    const ambulo__dense_rule *rule = ambulo__dense_rule_at(i);
    char line[120];
    (void)snprintf(line, sizeof line, "| `%s` | %s | %g%s |", ambulo__row_family(rule->kind),
                   rule->of_limit ? "of the limit" : ambulo__measure_text(rule->measure),
                   rule->tolerance, rule->kind == AMBULO__KIND_PRESSURE ? ", by load" : "");
    if (!strstr(text, line)) print_error("docs/results.md has no line '%s'\n", line);
    assert_non_null(strstr(text, line));
  }
  free(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_shipped_row_has_a_rule),
      cmocka_unit_test(every_kind_has_a_rule_but_ends_and_own_rows),
      cmocka_unit_test(limits_are_compared_with_the_larger_bound),
      cmocka_unit_test(speeds_have_limits_of_their_own),
      cmocka_unit_test(the_documentation_says_the_same),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
