/* What the engine measures: errors relative to sizes, caps of steps, scales of objectives; and that
 * nothing in it takes NaN for zero. */
#include "judge/candidates.h"
#include "method/engine.h"
#include "support/engine_fixture.h"
#include "support/problem_fixture.h"

static void scatter(double *x, int n, double size) {
  unsigned seed = 5;
  for (int j = 0; j < n; j++) x[j] += size * random_number(&seed);
}

/* of rows whose values the problem has, relative to their sizes; those that depend are left out */
static double worst_of(const engine_fixture *f, const ambulo__sparse_rows *rows, int equal) {
  double worst = 0.0;
  for (int i = 0; i < rows->count; i++) {
    const ambulo__table_row *row = &f->problem->table.rows[rows->row[i]];
    double value = f->engine->workspace->row_value[rows->row[i]];
    worst = fmax(worst, (equal ? fabs(value) : fmax(0.0, -value)) / row->size);
  }
  return worst;
}

/* lengths, rates and torques, each beside its own size */
static void errors_are_relative_to_sizes(void **state) {
  (void)state;
  static const char *const names[] = {"two_link_reach", "walker_2d_step", "walk_normal"};
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 4; k++) {
      engine_fixture f;
      engine_open(&f, names[i]);
      scatter(f.x, f.n, pow(10.0, -k));
      assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
      double equal =
          fmax(worst_of(&f, &f.engine->rows.equality, 1), worst_of(&f, &f.engine->rows.border, 1));
      double other = worst_of(&f, &f.engine->rows.inequality, 0);
      assert_close(ambulo__engine_equality_error(f.engine), equal, 1e-12 * equal);
      assert_close(ambulo__engine_excess(f.engine, f.engine->held.excess), other, 1e-12 * other);
      assert_close(ambulo__violation_at(f.engine, f.x), fmax(equal, other),
                   1e-12 * (equal + other));
      engine_close(&f);
    }
  }
}

/* border rows alone: matching ends */
static void ends_count_among_the_equalities(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walker_2d_step");
  assert_true(f.engine->borders > 0);
  assert_int_equal(ambulo__evaluate(f.engine->workspace, f.x), AMBULO_OK);
  memset(f.engine->workspace->row_value, 0,
         (size_t)f.problem->rows * sizeof *f.engine->workspace->row_value);
  int row = f.engine->rows.border.row[0];
  f.engine->workspace->row_value[row] = 0.25 * f.problem->table.rows[row].size;
  assert_close(ambulo__engine_equality_error(f.engine), 0.25, 1e-12);
  engine_close(&f);
}

static void nan_is_no_zero(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "two_link_reach");
  ambulo__engine *e = f.engine;
  assert_int_equal(ambulo__evaluate_jacobian(e->workspace, f.x), AMBULO_OK);
  double *weights = calloc((size_t)e->inequalities, sizeof *weights);
  assert_int_equal(ambulo__engine_gradient(e, weights, NULL, e->gradient), AMBULO_OK);
  assert_int_equal(e->run->faults, 0);
  weights[e->inequalities / 2] = NAN;
  assert_int_equal(ambulo__engine_gradient(e, weights, NULL, e->gradient), AMBULO_E_NUMERIC);
  assert_int_equal(e->run->faults, 1);
  free(weights);
  e->workspace->row_value[e->rows.inequality.row[0]] = NAN;
  assert_true(isnan(ambulo__engine_excess(e, e->held.excess)));
  e->workspace->row_value[e->rows.equality.row[0]] = NAN;
  assert_true(isnan(ambulo__engine_equality_error(e)));
  memset(e->step, 0, (size_t)e->n * sizeof *e->step);
  e->step[1] = NAN;
  assert_true(isnan(ambulo__engine_step_limit(e, e->step, 0.5)));
  engine_close(&f);
}

/* angles by a radian, lengths by twice their range, of which mirrored ends leave what a second step
 * does not need */
static void steps_are_capped_by_what_moves(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "walker_2d_step");
  ambulo_coordinate *c = (ambulo_coordinate *)f.problem->model->coordinates;
  int tx = ambulo_model_find_coordinate(f.problem->model, "pelvis_tx");
  c[tx].range[0] = -1.0;
  c[tx].range[1] = 4.0;
  for (int i = 0; i < f.problem->coordinates; i++) {
    if (c[i].type == AMBULO_REVOLUTE) c[i].range[0] = -20.0;
  }
  ambulo__engine_free(f.engine);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  for (int i = 0; i < f.problem->coordinates; i++) {
    if (c[i].type == AMBULO_REVOLUTE) assert_close(f.engine->cap[i], 1.0, 0);
  }
  assert_close(f.engine->cap[tx], 2.0 * (5.0 - f.problem->definition.travel), 1e-12);
  double *step = f.engine->step;
  memset(step, 0, (size_t)f.n * sizeof *step);
  step[f.problem->coordinates + tx] = 2.0;
  assert_close(ambulo__engine_step_limit(f.engine, step, 0.5), 1.0, 0);
  step[f.problem->coordinates + tx] = -2.0 * f.engine->cap[tx];
  assert_close(ambulo__engine_step_limit(f.engine, step, 0.5), 0.25, 1e-15);
  engine_close(&f);
}

static void the_start_does_not_move_the_scales(void **state) {
  (void)state;
  engine_fixture zero, rough;
  engine_open(&zero, "walk_normal");
  engine_open(&rough, "walk_normal");
  ambulo__engine_free(rough.engine);
  scatter(rough.x, rough.n, 0.5);
  assert_int_equal(
      ambulo__engine_create(rough.problem, rough.x, NULL, &rough.run, NULL, &rough.engine),
      AMBULO_OK);
  assert_close(rough.engine->objective_scale, zero.engine->objective_scale, 0);
  assert_close(rough.engine->negligible, zero.engine->negligible, 0);
  double share = zero.options.optimality_tolerance;
  assert_close(zero.engine->negligible, share * zero.engine->at_rest, 1e-12 * zero.engine->at_rest);
  engine_close(&zero);
  engine_close(&rough);
}

static double height(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  const double *factor = user;
  if (g) g->points[1] += *factor;
  return *factor * s->points[1];
}

/* without curvature the gradient gives the scale: in the metric it has length 1 */
static void linear_objectives_have_a_scale(void **state) {
  (void)state;
  double product[2];
  for (int k = 0; k < 2; k++) {
    double factor = k ? 1e6 : 1.0;
    fixture f = {.model = arm_create()};
    ambulo_problem_definition d = arm_definition(f.model);
    ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
    term.function = height;
    term.user = &factor;
    d.terms = &term;
    fixture_open(&f, &d);
    ambulo_options options = ambulo_options_default();
    ambulo__run run;
    ambulo__engine *e = NULL;
    ambulo__run_begin(&run, &options);
    assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &run, NULL, &e), AMBULO_OK);
    product[k] = factor * e->objective_scale;
    ambulo__engine_free(e);
    fixture_close(&f);
  }
  assert_close(product[1], product[0], 1e-9 * product[0]);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(errors_are_relative_to_sizes),
                                     cmocka_unit_test(ends_count_among_the_equalities),
                                     cmocka_unit_test(nan_is_no_zero),
                                     cmocka_unit_test(steps_are_capped_by_what_moves),
                                     cmocka_unit_test(the_start_does_not_move_the_scales),
                                     cmocka_unit_test(linear_objectives_have_a_scale)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
