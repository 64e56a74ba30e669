/* From zero to a point that satisfies every equality. */
#include "problem/callbacks.h"
#include "support/arm.h"
#include "support/engine_fixture.h"

static void equalities_hold_after(const char *name) {
  engine_fixture f;
  engine_open_restored(&f, name);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  for (int r = 0; r < f.problem->rows; r++) {
    if (f.problem->table.rows[r].relation != AMBULO_EQUAL) continue;
    assert_close(f.engine->workspace->row_value[r], 0.0, 1e-8);
  }
  engine_close(&f);
}

static void yardstick_walks(void **state) {
  (void)state;
  equalities_hold_after("yardstick_12");
}

static void mirrored_step_closes(void **state) {
  (void)state;
  equalities_hold_after("support/walker_2d_step");
}

static void end_states_are_met(void **state) {
  (void)state;
  equalities_hold_after("support/two_link_reach");
}

static void a_run_that_is_over_does_not_move(void **state) {
  (void)state;
  engine_fixture f;
  double error;
  engine_open(&f, "yardstick_12");
  unsigned seed = 7;
  double *start = calloc((size_t)f.n, sizeof *start);
  for (int j = 0; j < f.n; j++) f.x[j] = start[j] = 2.0 * random_number(&seed);
  f.options.maximum_evaluations = 0; /* the first point is all there is */
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  assert_true(error > 1e-3 && memcmp(start, f.x, (size_t)f.n * sizeof *start) == 0);
  free(start);
  engine_close(&f);
}

/* q_0^3 = 0.001 at 0.5 s: from 0.02 Newton's method goes beyond 0.3, where it is worse off; from
 * `wall` on there are no values; after `calls` of them the run is over */
typedef struct cubic {
  double wall;
  int calls;
  ambulo__run *run;
} cubic;

static double cubed(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  cubic *c = user;
  double q = s->q[0];
  if (g) g->q[0] += 3.0 * q * q;
  if (--c->calls == 0) c->run->stopped = 1;
  return q > c->wall ? (double)NAN : q * q * q - 0.001;
}

static double restore_cubic(cubic *c, double *q) {
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_user_row row = {"own", "", AMBULO_EQUAL, 0.5, 0.5, cubed, c};
  engine_fixture f = {.options = ambulo_options_default()};
  double error = -1.0;
  int calls = c->calls;
  d.end_value_count = 0;
  d.user_rows = &row;
  d.user_row_count = 1;
  d.terms = NULL;
  d.term_count = 0;
  c->run = &f.run;
  c->calls = -1;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  for (int j = 0; j < f.problem->variables; j += ARM_COORDINATES) f.x[j] = 0.02;
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  f.engine->iterate.mu = 0.05;
  f.engine->iterate.rho = 10.0;
  c->calls = calls;
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  c->calls = -1;
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  ambulo_node_state at;
  double *state = calloc((size_t)f.engine->workspace->channel_count, sizeof *state);
  ambulo__node_state_fill(f.engine->workspace, 5, state);
  at = ambulo__node_state_view(f.problem, 5, state);
  *q = at.q[0];
  free(state);
  engine_close(&f);
  ambulo_model_free(model);
  return error;
}

static void steps_into_nothing_are_halved(void **state) {
  (void)state;
  cubic c = {.wall = 0.2, .calls = -1};
  double q, error = restore_cubic(&c, &q);
  assert_true(error < 1e-9);
  assert_close(q, 0.1, 1e-6);
}

/* nothing but the start has a value: it stays */
static void without_a_way_the_start_stays(void **state) {
  (void)state;
  cubic c = {.wall = 0.02 + 1e-6, .calls = -1};
  double q, error = restore_cubic(&c, &q);
  assert_close(q, 0.02, 1e-9);
  assert_true(error > 1e-6);
}

static void the_best_point_on_the_way_is_kept(void **state) {
  (void)state;
  cubic c = {.wall = INFINITY, .calls = 2};
  double q, error = restore_cubic(&c, &q);
  assert_close(q, 0.02, 1e-9);
  assert_true(error < 1.1 * 0.001 / 1e-3); /* relative to the row's size */
}

/* a metric that cannot be factored is remembered: where x stays says nothing about the rows */
static void a_breakdown_is_remembered(void **state) {
  (void)state;
  engine_fixture f;
  double error;
  engine_open(&f, "yardstick_12");
  f.engine->iterate.mu = -1e9;
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  assert_true(error > 1e-6);
  assert_int_equal(f.run.breakdowns, 1);
  engine_close(&f);
}

/* Retracted points satisfy the equalities; tangent vectors stay tangent. */

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
  for (int k = 0; k < 6; k++) /* each continues from the last */
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
      cmocka_unit_test(yardstick_walks),
      cmocka_unit_test(mirrored_step_closes),
      cmocka_unit_test(end_states_are_met),
      cmocka_unit_test(a_run_that_is_over_does_not_move),
      cmocka_unit_test(steps_into_nothing_are_halved),
      cmocka_unit_test(without_a_way_the_start_stays),
      cmocka_unit_test(the_best_point_on_the_way_is_kept),
      cmocka_unit_test(a_breakdown_is_remembered),
      cmocka_unit_test(point_nearby_is_carried_to_the_surface),
      cmocka_unit_test(reduced_gradient_is_tangent),
      cmocka_unit_test(hopeless_point_is_refused),
      cmocka_unit_test(tight_tolerances_and_faults),
      cmocka_unit_test(what_rounding_leaves_is_reached),
      cmocka_unit_test(gradients_are_as_exact_as_asked),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
