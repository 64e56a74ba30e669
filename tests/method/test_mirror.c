/* The mirror is NLopt's own update: NLopt's augmented Lagrangian, values and gradients, beside what
 * the mirror makes of them, to the last bits, on a small problem whose rows come and go. */
#define _GNU_SOURCE /* dlsym's RTLD_NEXT */
#include "method/mirror.h"
#include "support/test.h"

#include <dlfcn.h>
#include <math.h>
#include <nlopt.h>

enum { N = 2, ROWS = 3 };

/* one call of AUGLAG */
typedef struct watched {
  ambulo__mirror mirror;
  nlopt_func inner; /* NLopt's augmented Lagrangian, and its data */
  void *data;
  int started, inner_calls, with_force;
  int first;                       /* 1: the next point with a gradient begins an inner solve */
  double from[N], gradient[N];     /* where it began, and its gradient */
  int steps;                       /* first steps that were compared */
  double worst_value, worst_slope; /* relative errors */
} watched;

static watched *watching;

/* c_i(x) <= 0: a circle, a line that is slack at the end, a hyperbola */
static void rows_at(const double *x, double *c) {
  c[0] = x[0] * x[0] + x[1] * x[1] - 2.0;
  c[1] = x[0] - 3.0;
  c[2] = 0.5 - x[0] * x[1];
}

static void slopes_at(const double *x, double *slope) {
  const double of[ROWS * N] = {2.0 * x[0], 2.0 * x[1], 1.0, 0.0, -x[1], -x[0]};
  memcpy(slope, of, sizeof of);
}

static double objective_at(const double *x, double *gradient) {
  if (gradient) {
    gradient[0] = 2.0 * (x[0] - 3.0);
    gradient[1] = 4.0 * (x[1] - 2.0);
  }
  return (x[0] - 3.0) * (x[0] - 3.0) + 2.0 * (x[1] - 2.0) * (x[1] - 2.0);
}

/* NLopt asks without a gradient when it starts, and when an inner solve has ended */
static double objective(unsigned n, const double *x, double *gradient, void *data) {
  watched *w = data;
  double value = objective_at(x, gradient), c[ROWS];
  (void)n;
  if (gradient) return value;
  rows_at(x, c);
  if (w->started++ == 0) {
    ambulo__mirror_start(&w->mirror, value, c);
  } else {
    (void)ambulo__mirror_update(&w->mirror, c);
  }
  w->first = 1;
  return value;
}

static void rows(unsigned m, double *c, unsigned n, const double *x, double *gradient, void *data) {
  (void)m, (void)n, (void)data;
  rows_at(x, c);
  if (gradient) slopes_at(x, gradient);
}

/* what the mirror says of the augmented Lagrangian, in NLopt's order */
static double predicted(watched *w, const double *x, double *gradient) {
  double c[ROWS], slope[ROWS * N], rho = w->mirror.penalty;
  double value = objective_at(x, gradient);
  rows_at(x, c);
  slopes_at(x, slope);
  for (int i = 0; i < ROWS; i++) {
    double force = c[i] + w->mirror.multiplier[i] / rho;
    if (!(force > 0.0)) continue;
    w->with_force++;
    value += 0.5 * rho * force * force;
    for (int j = 0; j < N; j++) gradient[j] += (rho * force) * slope[i * N + j];
  }
  return value;
}

static void compare_step(watched *w, const double *x, const double *gradient) {
  if (w->first == 2) {
    assert_true(ambulo__mirror_agrees(N, w->from, x, w->gradient));
    for (int j = 0; j < N; j++) w->gradient[j] *= 1.001;
    assert_false(ambulo__mirror_agrees(N, w->from, x, w->gradient));
    w->steps++;
  }
  w->first = w->first == 1 ? 2 : 0;
  memcpy(w->from, x, sizeof w->from);
  memcpy(w->gradient, gradient, sizeof w->gradient);
}

static double listen(unsigned n, const double *x, double *gradient, void *data) {
  watched *w = data;
  double want[N], value = w->inner(n, x, gradient, w->data), own = predicted(w, x, want);
  w->inner_calls++;
  w->worst_value = fmax(w->worst_value, fabs(value / own - 1.0));
  if (!gradient) return value;
  double size = hypot(want[0], want[1]);
  for (int j = 0; j < N; j++)
    w->worst_slope = fmax(w->worst_slope, fabs(gradient[j] - want[j]) / size);
  compare_step(w, x, gradient);
  return value;
}

/* Stands before NLopt's own. AUGLAG hands its augmented Lagrangian to the inner solver by it. */
__attribute__((visibility("default"))) nlopt_result
nlopt_set_min_objective(nlopt_opt opt, nlopt_func f, void *data) {
  typedef nlopt_result (*set)(nlopt_opt, nlopt_func, void *);
  union {
    void *object;
    set function;
  } next = {dlsym(RTLD_NEXT, "nlopt_set_min_objective")};
  if (!next.object) return NLOPT_FAILURE;
  if (f == objective || !watching) return next.function(opt, f, data);
  watching->inner = f;
  watching->data = data;
  return next.function(opt, listen, watching);
}

static void minimize(watched *w, const double *start) {
  double x[N] = {start[0], start[1]}, least, tolerance[ROWS] = {0.0};
  nlopt_opt opt = nlopt_create(NLOPT_AUGLAG, N), local = nlopt_create(NLOPT_LD_LBFGS, N);
  assert_true(opt && local);
  nlopt_set_maxeval(local, 4);
  nlopt_set_ftol_rel(local, 1e-12);
  nlopt_set_local_optimizer(opt, local);
  nlopt_set_min_objective(opt, objective, w);
  nlopt_add_inequality_mconstraint(opt, ROWS, rows, NULL, tolerance);
  nlopt_set_maxeval(opt, 120);
  watching = w;
  (void)nlopt_optimize(opt, x, &least);
  watching = NULL;
  nlopt_destroy(local);
  nlopt_destroy(opt);
}

/* Where NLopt does other arithmetic, this fails, and solves give each row its own gradient. */
static void the_augmented_lagrangian_is_nlopts(void **state) {
  (void)state;
  static const double starts[][N] = {{0.1, 4.0}, {1.1, 0.7}, {-2.0, 0.5}};
  int major, minor, patch;
  nlopt_version(&major, &minor, &patch);
  print_message("NLopt %d.%d.%d\n", major, minor, patch);
  for (int s = 0; s < 3; s++) {
    ambulo__pool pool;
    watched w = {.started = 0};
    ambulo__pool_init(&pool, NULL);
    assert_int_equal(ambulo__mirror_create(ROWS, &pool, &w.mirror), AMBULO_OK);
    minimize(&w, starts[s]);
    assert_true(w.mirror.updates >= 5 && w.steps >= 5 && w.mirror.penalty > 1e-6);
    assert_true(w.inner_calls >= 25 && w.with_force >= 25);
    if (w.worst_value > 1e-15 || w.worst_slope > 1e-15)
      print_error("values differ by %g, gradients by %g\n", w.worst_value, w.worst_slope);
    assert_true(w.worst_value <= 1e-15 && w.worst_slope <= 1e-15);
    ambulo__pool_clear(&pool);
  }
}

/* one row stands for all: the same value and gradient of NLopt's sum */
static void one_row_stands_for_all(void **state) {
  (void)state;
  double multiplier[4] = {2.0, 0.0, 0.5, 0.0}, row[4] = {0.25, -1.0, 0.75, 0.0}, pooled[2];
  const double gradient[2] = {3.0, -4.0};
  ambulo__mirror m = {.rows = 4, .multiplier = multiplier, .penalty = 4.0};
  double squares = 0.75 * 0.75 + 0.875 * 0.875;
  assert_int_equal(ambulo__mirror_pool(&m, row, 2, gradient, pooled), 2);
  double force = row[2] + multiplier[2] / m.penalty;
  assert_close(force * force, squares, 1e-15);
  for (int j = 0; j < 2; j++) assert_close(m.penalty * force * pooled[j], gradient[j], 1e-15);
  assert_true(isinf(row[0]) && row[0] < 0.0 && row[1] == -1.0 && row[3] == 0.0);
  double none[4] = {-0.6, -1.0, -0.2, -0.0};
  assert_int_equal(ambulo__mirror_pool(&m, none, 2, gradient, pooled), -1);
  assert_true(none[0] == -0.6 && none[2] == -0.2);
}

/* as prepare() of auglag.c relies on */
static void penalty_starts_as_in_the_paper(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mirror m;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mirror_create(2, &pool, &m), AMBULO_OK);
  const double out[2] = {0.5, -3.0}, in[2] = {-1.0, -2.0};
  ambulo__mirror_start(&m, 0.0, out);
  assert_true(m.penalty == 1e-6);
  ambulo__mirror_start(&m, -0.25, out);
  assert_close(m.penalty, 2.0, 1e-15);
  ambulo__mirror_start(&m, 1.0, in);
  assert_true(m.penalty == 10.0);
  ambulo__pool_clear(&pool);
}

static void its_bounds_are_nlopts(void **state) {
  (void)state;
  ambulo__pool pool;
  ambulo__mirror none, one;
  double row[] = {1e30};
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__mirror_create(0, &pool, &none), AMBULO_OK);
  assert_int_equal(ambulo__mirror_create(1, &pool, &one), AMBULO_OK);
  ambulo__mirror_start(&none, 5.0, row);
  assert_true(none.penalty == 1.0);
  ambulo__mirror_start(&one, 5.0, row);
  assert_true(one.penalty == 1e-6);
  (void)ambulo__mirror_update(&one, row);
  assert_true(one.multiplier[0] == 1e20);
  ambulo__pool_clear(&pool);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_augmented_lagrangian_is_nlopts),
                                     cmocka_unit_test(one_row_stands_for_all),
                                     cmocka_unit_test(penalty_starts_as_in_the_paper),
                                     cmocka_unit_test(its_bounds_are_nlopts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
