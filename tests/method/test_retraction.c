/* Retracted points satisfy the equalities; tangent vectors stay tangent. */
#include "support/engine_fixture.h"

static void open_factored(engine_fixture *f) {
  double predicted;
  engine_open_restored(f, "yardstick_12");
  assert_int_equal(ambulo__model_step(f->engine, &predicted), 0);
}

static void point_nearby_is_carried_to_the_surface(void **state) {
  (void)state;
  engine_fixture f;
  open_factored(&f);
  double t = ambulo__step_limit(f.engine->setup, f.engine->quadratic->total, 0.2);
  for (int j = 0; j < f.n; j++) f.x[j] += t * f.engine->quadratic->total[j];
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  assert_true(ambulo__engine_equality_error(f.engine) > 1e-4);
  assert_int_equal(ambulo__retract(f.engine, f.x), 1);
  assert_true(ambulo__engine_equality_error(f.engine) <= f.engine->retraction->tolerance);
  assert_true(f.engine->retraction->tolerance <= 1e-7);
  engine_close(&f);
}

static void reduced_gradient_is_tangent(void **state) {
  (void)state;
  engine_fixture f;
  open_factored(&f);
  double *z = calloc((size_t)f.n, sizeof *z);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  ambulo__reduced_gradient(f.engine, f.engine->setup->objective_scale, f.engine->iterate.lambda,
                           f.engine->iterate.equality_multiplier, z);
  double size = 0.0, off = 0.0;
  for (int j = 0; j < f.n; j++) size = fmax(size, fabs(z[j]));
  ambulo__sparse_rows_multiply(&f.engine->linearized.rows.equality, z, f.engine->measured.equality);
  for (int i = 0; i < f.engine->setup->equalities; i++)
    off = fmax(off, fabs(f.engine->measured.equality[i]));
  ambulo__sparse_rows_multiply(&f.engine->linearized.rows.border, z, f.engine->measured.border);
  for (int i = 0; i < f.engine->setup->borders; i++)
    off = fmax(off, fabs(f.engine->measured.border[i]));
  assert_true(size > 1e-6);
  assert_true(off <= 1e-5 * size);
  free(z);
  engine_close(&f);
}

static void hopeless_point_is_refused(void **state) {
  (void)state;
  engine_fixture f;
  open_factored(&f);
  for (int j = 0; j < f.n; j++) f.x[j] += j % 3 ? 50.0 : -70.0;
  assert_int_equal(ambulo__retract(f.engine, f.x), 0);
  engine_close(&f);
}

/* to rounding, which some points cannot be better than; what happened is remembered */
static void tight_tolerances_and_faults(void **state) {
  (void)state;
  engine_fixture f;
  open_factored(&f);
  f.engine->retraction->tolerance = 0.0;
  double t = ambulo__step_limit(f.engine->setup, f.engine->quadratic->total, 0.05);
  for (int j = 0; j < f.n; j++) f.x[j] += t * f.engine->quadratic->total[j];
  assert_int_equal(ambulo__retract(f.engine, f.x), 1);
  assert_true(ambulo__engine_equality_error(f.engine) <= 1e-11);
  f.x[0] = NAN;
  int faults = f.run.faults;
  assert_int_equal(ambulo__retract(f.engine, f.x), 0);
  assert_int_equal(f.run.faults, faults + 1);
  engine_close(&f);
}

/* whatever is asked for: a point that is refused is not on the surface to rounding */
static void what_rounding_leaves_is_reached(void **state) {
  (void)state;
  engine_fixture f;
  open_factored(&f);
  ambulo__engine *e = f.engine;
  double *x = calloc((size_t)f.n, sizeof *x);
  const double *step = e->quadratic->total;
  int reached = 0, refused = 0;
  e->retraction->tolerance = 0.0;
  for (int k = 1; k <= 400; k++) {
    double t = 0.005 * k * ambulo__step_limit(e->setup, step, 1.0);
    for (int j = 0; j < f.n; j++) x[j] = f.x[j] + t * step[j];
    int there = ambulo__retract(e, x);
    double error = ambulo__engine_equality_error(e);
    assert_true(there ? error <= 1e-11 : !(error <= 1e-11));
    reached += there;
    refused += !there;
  }
  assert_true(reached > 0 && refused > 0);
  free(x);
  engine_close(&f);
}

/* further for each digit that is asked for; mixing makes it few passes */
static void gradients_are_as_exact_as_asked(void **state) {
  (void)state;
  engine_fixture f;
  open_factored(&f);
  ambulo__engine *e = f.engine;
  double *exact = calloc((size_t)f.n, sizeof *exact), *z = calloc((size_t)f.n, sizeof *z);
  double t = ambulo__step_limit(e->setup, e->quadratic->total, 0.3), size = 0.0,
         off[2] = {0.0, 0.0};
  for (int j = 0; j < f.n; j++) f.x[j] += t * e->quadratic->total[j];
  assert_int_equal(ambulo__retract(e, f.x), 1);
  e->retraction->adjoint_tolerance = 1e-12;
  for (int k = 0; k < 6; k++) /* each goes on from the last */
    assert_int_equal(ambulo__reduced_gradient(e, e->setup->objective_scale, e->iterate.lambda,
                                              e->iterate.equality_multiplier, exact),
                     AMBULO_OK);
  for (int run = 0; run < 2; run++) {
    e->retraction->adjoint_tolerance = run ? 1e-8 : 1e-3;
    memset(e->iterate.equality_multiplier, 0, (size_t)e->setup->equalities * sizeof *z);
    assert_int_equal(ambulo__reduced_gradient(e, e->setup->objective_scale, e->iterate.lambda,
                                              e->iterate.equality_multiplier, z),
                     AMBULO_OK);
    for (int j = 0; j < f.n; j++) {
      size = fmax(size, fabs(exact[j]));
      off[run] = fmax(off[run], fabs(z[j] - exact[j]));
    }
  }
  if (!(off[0] <= 3e-3 * size && off[1] <= 1e-6 * size))
    print_error("%g and %g of %g\n", off[0], off[1], size);
  assert_true(off[0] <= 3e-3 * size && off[1] <= 1e-6 * size);
  free(exact);
  free(z);
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(point_nearby_is_carried_to_the_surface),
      cmocka_unit_test(reduced_gradient_is_tangent),
      cmocka_unit_test(hopeless_point_is_refused),
      cmocka_unit_test(tight_tolerances_and_faults),
      cmocka_unit_test(what_rounding_leaves_is_reached),
      cmocka_unit_test(gradients_are_as_exact_as_asked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
