/* Rows of a box in the hands: which bodies keep clear of it, when, how large, and their gradients
 * by row against differences, in any pose.
 */
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "problem/nlp.h"
#include "support/test.h"

#include <math.h>
#include <string.h>

static const char path[] = "models/lift.yaml";

static ambulo_problem *load(const char *setting) {
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load(path, &setting, setting ? 1 : 0, NULL, NULL, &p), AMBULO_OK);
  return p;
}

static int is_between(const ambulo__table_row *row, const char *one, const char *other) {
  return !strcmp(row->family, "collision") && !strcmp(row->subject, one) &&
         !strcmp(row->detail, other);
}

static int count(const ambulo_problem *p, const char *one, const char *other) {
  int found = 0;
  for (int r = 0; r < p->rows; r++) found += is_between(&p->table.rows[r], one, other);
  return found;
}

static void arms_hold_it_and_the_rest_keeps_clear(void **state) {
  (void)state;
  ambulo_problem *p = load(NULL);
  int held = 0;
  for (int k = 0; k < p->nodes; k++) held += p->times[k] >= 0.9 - 1e-9 && p->times[k] <= 2.8 + 1e-9;
  const char *const clear[] = {"thigh_r", "thigh_l", "shank_r", "shank_l", "trunk",
                               "pelvis",  "foot_r",  "foot_l",  "head"};
  const char *const arms[] = {"hand_r", "hand_l", "forearm_r", "forearm_l", "upper_arm_r"};
  for (size_t i = 0; i < sizeof clear / sizeof *clear; i++)
    assert_int_equal(count(p, clear[i], "box"), held);
  for (size_t i = 0; i < sizeof arms / sizeof *arms; i++)
    assert_int_equal(count(p, arms[i], "box"), 0);
  assert_int_equal(count(p, "box", "table"), held);
  assert_int_equal(count(p, "box", "ground"), held);
  ambulo_problem_free(p);
  p = load("constraints.collision=off");
  assert_int_equal(count(p, "thigh_r", "box") + count(p, "box", "table"), 0);
  ambulo_problem_free(p);
}

/* unknowns without pattern */
static void fill(const ambulo_problem *p, double *x) {
  ambulo__start_pose(p, x);
  for (int j = 0; j < p->variables; j++) x[j] += 0.2 * sin(1.7 * j + 0.3);
}

static double row_at(const ambulo_problem *p, ambulo_workspace *w, const double *x, double *rows,
                     int row) {
  assert_int_equal(ambulo_problem_evaluate(p, w, x, NULL, NULL, rows), AMBULO_OK);
  return rows[row];
}

static void check_gradient(const ambulo_problem *p, ambulo_workspace *w, double *x, int row) {
  double *gradient = calloc((size_t)p->variables, sizeof *gradient);
  double *rows = calloc((size_t)p->rows, sizeof *rows);
  assert_int_equal(ambulo_problem_row_gradient(p, w, x, row, gradient), AMBULO_OK);
  for (int j = 0; j < p->variables; j++) {
    double old = x[j], h = 1e-6;
    if (gradient[j] == 0.0 && j % 17) continue;
    x[j] = old + h;
    double up = row_at(p, w, x, rows, row);
    x[j] = old - h;
    double down = row_at(p, w, x, rows, row);
    x[j] = old;
    assert_true(fabs(gradient[j] - (up - down) / (2.0 * h)) < 1e-6);
  }
  free(gradient);
  free(rows);
}

static void gradients_are_those_of_differences(void **state) {
  (void)state;
  ambulo_problem *p = load("time.intervals=24");
  ambulo_workspace *w = NULL;
  double *x = calloc((size_t)p->variables, sizeof *x);
  int checked = 0;
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  fill(p, x);
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (!is_between(row, "shank_r", "box") && !is_between(row, "trunk", "box") &&
        !is_between(row, "box", "table") && !is_between(row, "box", "ground"))
      continue;
    if (row->node % 3) continue;
    check_gradient(p, w, x, r);
    checked++;
  }
  assert_true(checked > 8);
  free(x);
  ambulo_workspace_free(w);
  ambulo_problem_free(p);
}

/* a box fixed in the world and turned by `turn` about up, grown by what is carried: by its half
 * size along each of the fixed one's axes */
static void what_is_carried_makes_the_other_larger(void **state) {
  (void)state;
  for (double turn = 0.0; turn < 1.6; turn += 0.4) {
    double c = cos(turn), s = sin(turn);
    ambulo__solid box = {.axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .half = {0.1, 0.2, 0.3}};
    ambulo__solid fixed = {.axes = {{c, s, 0}, {-s, c, 0}, {0, 0, 1}}, .half = {0.4, 0.5, 0.6}};
    ambulo__solid sum = ambulo__solid_carried(&box, &fixed, 0.01);
    assert_close(sum.half[0], 0.4 + 0.1 * fabs(c) + 0.2 * fabs(s), 1e-12);
    assert_close(sum.half[1], 0.5 + 0.1 * fabs(s) + 0.2 * fabs(c), 1e-12);
    assert_close(sum.half[2], 0.9, 1e-12);
    assert_close(sum.distance, 0.01, 0.0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arms_hold_it_and_the_rest_keeps_clear),
      cmocka_unit_test(gradients_are_those_of_differences),
      cmocka_unit_test(what_is_carried_makes_the_other_larger),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
