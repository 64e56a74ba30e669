/* Terms that follow points, forces on feet and centres of pressure, in whole problems: their values
 * against what ambulo_problem_motion says of the same point, their gradients against differences.
 */
#include "ambulo/extend.h"
#include "support/shared_fixture.h"
#include "support/test.h"

enum { MOST_NODES = 64, FEET = 2, MARKS = 2 };

typedef struct following {
  fixture plain;
  const ambulo_problem *problem; /* the plain one */
  ambulo_problem *extended;
  ambulo_workspace *workspace;
  int nodes;
  double grf[MOST_NODES][FEET][3], cop[MOST_NODES][FEET][3], *points;
} following;

static void open_kind(following *f, int kind) {
  *f = (following){.extended = NULL};
  fixture_open(&f->plain, kind);
  const ambulo_problem *p = f->problem = f->plain.problem;
  f->nodes = ambulo_problem_node_count(p);
  assert_true(f->nodes <= MOST_NODES);
  f->points = calloc((size_t)(f->nodes * p->channels.points) * 3, sizeof *f->points);
  ambulo_motion motion = {
      .size = sizeof motion, .grf = &f->grf[0][0][0], .cop = &f->cop[0][0][0], .points = f->points};
  assert_int_equal(
      ambulo_problem_motion(p, f->plain.workspace, f->plain.x, f->nodes, p->times, &motion),
      AMBULO_OK);
}

/* the value of the term, added behind the others */
static double value_with(following *f, const ambulo_term *term) {
  ambulo_extension extension = ambulo_extension_default();
  extension.terms = term;
  extension.term_count = 1;
  assert_int_equal(ambulo_problem_extend(f->problem, &extension, NULL, NULL, &f->extended),
                   AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(f->extended, NULL, &f->workspace), AMBULO_OK);
  double objective, values[16];
  assert_true(f->extended->definition.term_count <= 16);
  assert_int_equal(
      ambulo_problem_evaluate(f->extended, f->workspace, f->plain.x, &objective, values, NULL),
      AMBULO_OK);
  return values[f->extended->definition.term_count - 1];
}

static double value_at(const following *f, const double *x) {
  double values[16];
  assert_int_equal(ambulo_problem_evaluate(f->extended, f->workspace, x, NULL, values, NULL),
                   AMBULO_OK);
  return values[f->extended->definition.term_count - 1];
}

/* its gradient against central differences, by some of the unknowns */
static void check_gradient(const following *f) {
  const int n = f->extended->variables, term = f->extended->definition.term_count - 1;
  double *gradient = calloc((size_t)n, sizeof *gradient), *x = calloc((size_t)n, sizeof *x);
  const double h = 1e-5;
  double size = 0.0;
  memcpy(x, f->plain.x, (size_t)n * sizeof *x);
  (void)value_at(f, x);
  assert_int_equal(ambulo__term_gradient(f->workspace, term, gradient), AMBULO_OK);
  for (int i = 0; i < n; i++) size = fmax(size, fabs(gradient[i]));
  assert_true(size > 0.0);
  for (int i = 0; i < n; i += 13) {
    double kept = x[i];
    x[i] = kept + h;
    double ahead = value_at(f, x);
    x[i] = kept - h;
    double behind = value_at(f, x);
    x[i] = kept;
    assert_close((ahead - behind) / (2.0 * h), gradient[i], 1e-7 * size);
  }
  free(gradient);
  free(x);
}

static void term_close(following *f) {
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->extended);
}

static void close_kind(following *f) {
  free(f->points);
  fixture_close(&f->plain);
}

static void forces_count_by_body_weights(void **state) {
  (void)state;
  for (int i = 0; i < KINDS; i++) {
    static const double scale[FEET] = {2.0, 0.5};
    static double reference[MOST_NODES][FEET][3];
    following f;
    open_kind(&f, i);
    double weight = f.plain.weight, want = 0.0;
    for (int k = 0; k < f.nodes; k++)
      for (int foot = 0; foot < FEET; foot++)
        for (int a = 0; a < 3; a++) {
          reference[k][foot][a] = k % 5 == 4 && foot ? NAN : 100.0 * sin(k + 2.0 * a + foot);
          double u = scale[foot] * (f.grf[k][foot][a] - reference[k][foot][a]) / weight;
          if (!isnan(u)) want += f.problem->quadrature[k] * u * u;
        }
    ambulo_term term = ambulo_term_default(AMBULO_FORCE_TRACKING);
    term.foot_scale = scale;
    term.foot_reference = &reference[0][0][0];
    double value = value_with(&f, &term);
    assert_close(value, want, 1e-10 * want);
    check_gradient(&f);
    term_close(&f);
    close_kind(&f);
  }
}

/* the quotient of ambulo_motion, times the normal force, against the linear form of the term, on
 * level ground, where both mean the same point; feet of two parts too (kind 1) */
static void centres_of_pressure_count_by_their_load(void **state) {
  (void)state;
  for (int i = 0; i < 2; i++) {
    static double reference[MOST_NODES][FEET][3];
    following f;
    open_kind(&f, i);
    const double *up = ambulo_model_up(f.problem->model);
    double weight = f.plain.weight, want = 0.0;
    int loaded = 0;
    for (int k = 0; k < f.nodes; k++)
      for (int foot = 0; foot < FEET; foot++) {
        double normal = 0.0, away = 0.0, off[3] = {0.03 * sin(k), 0.02 * cos(k), 0.01 * foot};
        for (int a = 0; a < 3; a++) {
          normal += up[a] * f.grf[k][foot][a];
          away += up[a] * off[a];
        }
        for (int a = 0; a < 3; a++) {
          double level = off[a] - away * up[a], u = 4.0 * normal * level / weight;
          reference[k][foot][a] = f.cop[k][foot][a] - level;
          if (!isnan(reference[k][foot][a])) want += f.problem->quadrature[k] * u * u;
        }
        loaded += normal > 0.0;
      }
    assert_true(loaded > f.nodes / 3);
    static const double scale[FEET] = {4.0, 4.0};
    ambulo_term term = ambulo_term_default(AMBULO_PRESSURE_TRACKING);
    term.foot_scale = scale;
    term.foot_reference = &reference[0][0][0];
    double value = value_with(&f, &term);
    assert_close(value, want, 1e-9 * want);
    check_gradient(&f);
    term_close(&f);
    close_kind(&f);
  }
}

static void points_count_by_their_distance(void **state) {
  (void)state;
  static double reference[MOST_NODES][MARKS][3];
  static const double scale[MARKS] = {3.0, 10.0};
  following f;
  open_kind(&f, 0);
  const int marks[MARKS] = {1, 4}, all = f.problem->channels.points;
  double want = 0.0;
  for (int k = 0; k < f.nodes; k++)
    for (int m = 0; m < MARKS; m++)
      for (int a = 0; a < 3; a++) {
        reference[k][m][a] = k % 7 == 3 ? NAN : 0.1 * cos(k + a) + m;
        double u = scale[m] * (f.points[3 * (k * all + marks[m]) + a] - reference[k][m][a]);
        if (!isnan(u)) want += f.problem->quadrature[k] * u * u;
      }
  ambulo_term term = ambulo_term_default(AMBULO_POINT_TRACKING);
  term.marks = marks;
  term.mark_count = MARKS;
  term.mark_scale = scale;
  term.mark_reference = &reference[0][0][0];
  double value = value_with(&f, &term);
  assert_close(value, want, 1e-11 * want);
  check_gradient(&f);
  term_close(&f);
  close_kind(&f);
}

/* gaps stay gaps on other grids, and what is known stays known */
static void references_go_along_to_other_grids(void **state) {
  (void)state;
  static double reference[MOST_NODES][1][3];
  following f;
  open_kind(&f, 0);
  const int mark = 2;
  for (int k = 0; k < f.nodes; k++)
    for (int a = 0; a < 3; a++) reference[k][0][a] = k == 2 ? NAN : f.problem->times[k] + a;
  ambulo_term term = ambulo_term_default(AMBULO_POINT_TRACKING);
  term.marks = &mark;
  term.mark_count = 1;
  term.mark_reference = &reference[0][0][0];
  (void)value_with(&f, &term);
  ambulo_problem *fine = NULL;
  int intervals = 2 * f.extended->definition.intervals;
  assert_int_equal(ambulo__problem_with_grid(f.extended, intervals, intervals, NULL, &fine),
                   AMBULO_OK);
  const ambulo_term *last = &fine->definition.terms[fine->definition.term_count - 1];
  for (int k = 0; k <= intervals; k++)
    for (int a = 0; a < 3; a++) {
      double value = last->mark_reference[3 * k + a];
      double t = fine->times[k], *own = f.problem->times;
      assert_int_equal(isnan(value) != 0, t > own[1] + 1e-9 && t < own[3] - 1e-9);
      if (!isnan(value)) assert_close(value, fine->times[k] + a, 1e-12);
    }
  ambulo_problem_free(fine);
  term_close(&f);
  close_kind(&f);
}

static void what_cannot_be_followed_is_refused(void **state) {
  (void)state;
  static double reference[MOST_NODES][1][3];
  static const int marks[] = {-1, 100000, 0};
  following f;
  open_kind(&f, 0);
  for (int i = 0; i < 4; i++) {
    ambulo_term term = ambulo_term_default(AMBULO_POINT_TRACKING);
    term.marks = i < 3 ? &marks[i] : NULL;
    term.mark_count = i < 3;
    term.mark_reference = i == 2 ? NULL : &reference[0][0][0];
    ambulo_extension extension = ambulo_extension_default();
    extension.terms = &term;
    extension.term_count = 1;
    assert_int_equal(ambulo_problem_extend(f.problem, &extension, NULL, NULL, &f.extended),
                     AMBULO_E_PROBLEM);
  }
  close_kind(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(forces_count_by_body_weights),
      cmocka_unit_test(centres_of_pressure_count_by_their_load),
      cmocka_unit_test(points_count_by_their_distance),
      cmocka_unit_test(references_go_along_to_other_grids),
      cmocka_unit_test(what_cannot_be_followed_is_refused),
  };
  return cmocka_run_group_tests_name("problem/force_terms", tests, NULL, NULL);
}
