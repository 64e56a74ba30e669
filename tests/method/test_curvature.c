/* Slopes that are kept are those that would be found, at every node and of every channel. */
#include "method/metric.h"
#include "support/engine_fixture.h"
#include "support/gauss_newton.h"
#include "support/metric_along.h"
#include "support/problem_fixture.h"
#include "support/random_model.h"
#include "support/test.h"

static void expect(ambulo__channel_slopes *s, const ambulo_workspace *w, int node, int channel) {
  const ambulo__basis_point *point = &ambulo__lane_map_points(w->problem->map)[node];
  const int d = w->problem->coordinates;
  double want[1024], largest = 1.0;
  assert_true(point->span * d <= 1024);
  ambulo__channel_local_gradient(w, node, channel, want);
  const double *got = ambulo__channel_slopes_of(s, w, node, channel);
  for (int j = 0; j < point->span * d; j++) largest = fmax(largest, fabs(want[j]));
  for (int j = 0; j < point->span * d; j++) {
    double sum = 0.0;
    for (int o = 0; o < 3; o++) sum += point->weight[o][j / d] * got[o * d + j % d];
    assert_close(sum / largest, want[j] / largest, 1e-13);
  }
}

static void kept_slopes_are_those_of_their_node(void **state) {
  (void)state;
  static const char *const names[] = {"walk_normal", "yardstick_12", "support/walk_rigid"};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    ambulo_problem *p = load_problem(names[n]);
    ambulo_workspace *w = NULL;
    ambulo__pool pool;
    ambulo__channel_slopes g;
    double *x = calloc((size_t)p->variables, sizeof *x);
    ambulo__pool_init(&pool, NULL);
    assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
    assert_int_equal(ambulo__channel_slopes_create(p, &pool, &g), AMBULO_OK);
    for (int point = 0; point < 3; point++) { /* nothing of the one before is left */
      for (int j = 0; j < p->variables; j++) x[j] = 0.1 * sin(1.0 + j + point);
      assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
      ambulo__channel_slopes_clear(&g);
      for (int k = 0; k < (point == 1 ? 1 : p->nodes); k++) { /* or of its first nodes */
        for (int c = 0; c < w->channel_count; c++) {
          expect(&g, w, k, c);
          if (k < p->nodes - 1) expect(&g, w, k + 1, c); /* and again, as the node */
        }
      }
    }
    ambulo__pool_clear(&pool);
    ambulo_workspace_free(w);
    ambulo_problem_free(p);
    free(x);
  }
}

/* -------------------------------------------------------- squares of a coordinate */

enum { SQUARES = 5, SPAN = 3 };

static double light_of(const ambulo__joint_squares *s, const double y[3]) {
  double sum = 0.0;
  for (int a = 0, at = 0; a < 3; a++) {
    for (int b = 0; b <= a; b++) sum += (a == b ? 1.0 : 2.0) * s->light[at++] * y[a] * y[b];
  }
  return sum;
}

static double value_of(const ambulo__joint_squares *s, const double y[4]) {
  double r = s->tau * y[3];
  for (int o = 0; o < 3; o++) r += s->motion[o] * y[o];
  return r * r + light_of(s, y);
}

/* squares with and without the torque, in any order */
static void turned_squares_have_the_same_sum(void **state) {
  (void)state;
  random_source source = {11};
  for (int trial = 0; trial < 20; trial++) {
    ambulo__joint_squares s = {0.0, {0.0}, {0.0}};
    double slope[SQUARES][4], least = 0.0;
    for (int k = 0; k < SQUARES; k++) {
      for (int o = 0; o < 4; o++) slope[k][o] = random_between(&source, -2.0, 2.0);
      if ((k + trial) % 3 == 0) slope[k][3] = 0.0;
      ambulo__joint_squares_add(&s, slope[k][3], slope[k]);
      least += slope[k][3] * slope[k][3];
    }
    assert_close(s.tau, sqrt(least), 1e-13);
    for (int point = 0; point < 6; point++) {
      double y[4], want = 0.0;
      for (int o = 0; o < 4; o++) y[o] = random_between(&source, -1.0, 1.0);
      for (int k = 0; k < SQUARES; k++) {
        double r = 0.0;
        for (int o = 0; o < 4; o++) r += slope[k][o] * y[o];
        want += r * r;
      }
      assert_close(value_of(&s, y), want, 1e-12);
    }
  }
}

/* the form by control points is that by q, qd and qdd of these control points */
static void control_points_move_the_motion(void **state) {
  (void)state;
  random_source source = {5};
  ambulo__joint_squares s = {0.0, {0.0}, {0.0}};
  ambulo__basis_point point = {.span = SPAN};
  double x[SPAN], y[3] = {0.0}, form[SPAN * (SPAN + 1) / 2];
  assert_int_equal(ambulo__joint_squares_light(&s, &point, form), 0);
  for (int k = 0; k < 4; k++) {
    double slope[4];
    for (int o = 0; o < 4; o++) slope[o] = random_between(&source, -2.0, 2.0);
    ambulo__joint_squares_add(&s, slope[3], slope);
  }
  for (int c = 0; c < SPAN; c++) {
    x[c] = random_between(&source, -1.0, 1.0);
    for (int o = 0; o < 3; o++) {
      point.weight[o][c] = random_between(&source, -1.0, 1.0);
      y[o] += point.weight[o][c] * x[c];
    }
  }
  double by_points = 0.0;
  assert_int_equal(ambulo__joint_squares_light(&s, &point, form), 1);
  for (int c = 0, at = 0; c < SPAN; c++) {
    for (int b = 0; b <= c; b++) by_points += (b == c ? 1.0 : 2.0) * form[at++] * x[b] * x[c];
  }
  assert_close(by_points, light_of(&s, y), 1e-13);
}

static void what_is_no_number_stays_none(void **state) {
  (void)state;
  const double motion[] = {1.0, 0.0, 0.0};
  ambulo__joint_squares s = {2.0, {0.0}, {0.0}};
  ambulo__joint_squares_add(&s, (double)NAN, motion);
  assert_true(isnan(s.tau));
}

/* d'H d from the gradients of all residuals, one at a time */
static double sum_of_squares(ambulo_workspace *w, const double *x, const double *d) {
  const ambulo_problem *p = w->problem;
  ambulo__term_context context = ambulo__term_context_of(w);
  double sum = 0.0, one[GN_WIDEST];
  assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
  for (int k = 0; k < p->nodes; k++) {
    for (int c = 0; c < 4 * p->coordinates; c++) {
      double along = 0.0, curvature = gn_channel_curvature(w, k, c, c % p->coordinates);
      ambulo__channel_local_gradient(w, k, c, one);
      for (int j = 0; j < ambulo__node_width(p, k); j++)
        along += one[j] * d[ambulo__node_first(p, k) + j];
      sum += curvature * along * along;
    }
    for (int t = 0; t < p->definition.term_count; t++) {
      const ambulo_term *term = &p->definition.terms[t];
      double weight = term->weight * ambulo__term_quadrature(p, term, k);
      int forms = ambulo__term_is_simple(term) ? 0 : ambulo__term_forms(term, &context, k);
      for (int j = 0; j < forms; j++) {
        ambulo__form form;
        double along = 0.0;
        ambulo__term_form(term, &context, k, j, &form);
        for (int c = 0; c < form.count; c++) {
          int at = k + form.ahead[c];
          ambulo__channel_local_gradient(w, at, form.channel[c], one);
          for (int i = 0; i < ambulo__node_width(p, at); i++)
            along += form.slope[c] * one[i] * d[ambulo__node_first(p, at) + i];
        }
        sum += weight * ambulo__term_residual(term, form.u).curvature * along * along;
      }
    }
  }
  return sum;
}

static void compare_squares(ambulo_workspace *w, double *x) {
  const int n = w->problem->variables;
  unsigned seed = 7;
  double *d = calloc((size_t)n, sizeof *d);
  for (int j = 0; j < n; j++) x[j] = 0.1 * random_number(&seed);
  for (int trial = 0; trial < 6; trial++) { /* the last: single unknowns */
    for (int j = 0; j < n; j++) d[j] = trial < 3 ? random_number(&seed) : j == trial * n / 7;
    assert_close(metric_along(w, x, d) / sum_of_squares(w, x, d), 1.0, 1e-11);
  }
  free(d);
}

/* torques and motion of a joint in several terms, each of which looks at another part of it */
static void squares_of_a_joint_are_joined(void **state) {
  (void)state;
  static const double passive[] = {0.2, 1.0, -0.1, -2.0, -0.3, -1.5, 0.2, 1.2};
  static const double strength[] = {20.0, 0.9, 0.4, 30.0, 0.7, -0.2,
                                    25.0, 0.8, 0.1, 15.0, 1.0, 0.3};
  static const ambulo_term_kind kinds[] = {AMBULO_TORQUE_POWER, AMBULO_MECHANICAL_POWER,
                                           AMBULO_POSTURE, AMBULO_TORQUE_SQUARED,
                                           AMBULO_ACCELERATION};
  enum { KINDS = sizeof kinds / sizeof *kinds };
  fixture f = {.model = arm_create()};
  ambulo_problem_definition d = arm_definition(f.model);
  ambulo_term terms[KINDS];
  for (int k = 0; k < KINDS; k++) {
    terms[k] = ambulo_term_default(kinds[k]);
    terms[k].weight = 30.0 / (1.0 + k * k);
  }
  terms[0].passive = passive;
  terms[0].strength = strength;
  terms[1].negative = 0.4;
  d.terms = terms;
  d.term_count = KINDS;
  fixture_open(&f, &d);
  compare_squares(f.workspace, f.x);
  fixture_close(&f);
}

/* to rounding: torques that several terms look at, rates beside them, feet in the air */
static void the_metric_is_a_sum_of_squares(void **state) {
  (void)state;
  static const char *const names[] = {"walk", "walk_normal", "support/walk_rigid", "yardstick_12"};
  for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
    ambulo_problem *p = load_problem(names[n]);
    ambulo_workspace *w = NULL;
    double *x = calloc((size_t)p->variables, sizeof *x);
    assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
    compare_squares(w, x);
    ambulo_workspace_free(w);
    ambulo_problem_free(p);
    free(x);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(kept_slopes_are_those_of_their_node),
                                     cmocka_unit_test(turned_squares_have_the_same_sum),
                                     cmocka_unit_test(control_points_move_the_motion),
                                     cmocka_unit_test(what_is_no_number_stays_none),
                                     cmocka_unit_test(the_metric_is_a_sum_of_squares),
                                     cmocka_unit_test(squares_of_a_joint_are_joined)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
