/* one period of a motion, repeated: against the whole motion in closed form. */
#include "ambulo/tools/load.h"
#include "definitions/motion_repeat.h"
#include "model/neutral_pose.h"
#include "support/test.h"

#include <math.h>

enum { INTERVALS = 20, PERIODS = 3 };
static const double pi = 3.14159265358979323846, travel = 0.3;

static int is_left(const ambulo_coordinate *c, int i) {
  return c->mirror > i;
}

/* q_m(t + T) = sign_i q_i(t) + shift: cosines with the period 2 T, constants, a steady travel */
static double value_at(const ambulo_model *model, int i, double periods) {
  const ambulo_coordinate *c = &model->coordinates[i];
  double wave = cos(pi * periods);
  if (ambulo__is_root_translation(model, i) && c->mirror_sign > 0.0) return travel * periods;
  if (c->mirror == i) return c->mirror_sign < 0.0 ? wave : 0.4;
  return is_left(c, i) ? wave : -c->mirror_sign * wave;
}

/* of the first period as cubics: values and interval * rates at the ends of intervals */
static double *first_period(const ambulo_problem *p) {
  size_t d = (size_t)p->coordinates;
  double *points = test_malloc((INTERVALS + 1) * 2 * d * sizeof *points);
  for (size_t k = 0; k <= INTERVALS; k++) {
    for (size_t i = 0; i < d; i++) {
      double t = (double)k / INTERVALS, h = 1e-6;
      double rate = (value_at(p->model, (int)i, t + h) - value_at(p->model, (int)i, t - h)) / h / 2;
      points[2 * k * d + i] = value_at(p->model, (int)i, t);
      points[(2 * k + 1) * d + i] = rate / INTERVALS;
    }
  }
  return points;
}

static double worst_error(const ambulo_problem *p, const double *x) {
  double worst = 0.0;
  int d = p->coordinates;
  for (int k = 0; k <= 100; k++) {
    ambulo__basis_point point;
    double t = k / 100.0;
    ambulo__basis_at(p->basis, t * p->definition.duration, &point);
    for (int i = 0; i < d; i++) {
      double value = 0.0;
      for (int j = 0; j < point.span; j++)
        value += point.weight[0][j] * x[(point.first + j) * d + i];
      worst = fmax(worst, fabs(value - value_at(p->model, i, PERIODS * t)));
    }
  }
  return worst;
}

static void test_steps(void **state) {
  static const char *const three[] = {"gait.steps=3", "time.duration=1.62", "time.intervals=75",
                                      "trajectory.intervals=60"};
  ambulo_problem *p = NULL;
  ambulo__basis *one = NULL;
  (void)state;
  assert_int_equal(ambulo_problem_load("tests/support/walk_rigid.yaml", three, 4, NULL, NULL, &p),
                   AMBULO_OK);
  assert_int_equal(
      ambulo__basis_create(AMBULO__HERMITE, 3, INTERVALS, 0.54, NULL, &p->allocator, &one),
      AMBULO_OK);
  double *points = first_period(p), *x = test_calloc((size_t)p->variables, sizeof *x);
  assert_int_equal(ambulo__motion_repeat(one, points, PERIODS, AMBULO_ENDS_MIRRORED, p, x),
                   AMBULO_OK);
  assert_true(worst_error(p, x) < 1e-4);
  /* as strides they are another motion */
  assert_int_equal(ambulo__motion_repeat(one, points, PERIODS, AMBULO_ENDS_PERIODIC, p, x),
                   AMBULO_OK);
  assert_true(worst_error(p, x) > 0.1);
  test_free(points);
  test_free(x);
  ambulo__basis_free(one);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_steps)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
