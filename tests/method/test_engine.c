/* What an engine is set up with: caps of steps, scales of objectives. */
#include "support/engine_fixture.h"
#include "support/problem_fixture.h"

static void scatter(double *x, int n, double size) {
  unsigned seed = 5;
  for (int j = 0; j < n; j++) x[j] += size * random_number(&seed);
}

/* angles by a radian, lengths by twice their range, of which mirrored ends leave what a second step
 * does not need */
static void steps_are_capped_by_what_moves(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "support/walker_2d_step");
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
    if (c[i].type == AMBULO_REVOLUTE) assert_close(f.engine->setup->cap[i], 1.0, 0);
  }
  assert_close(f.engine->setup->cap[tx], 5.0 - f.problem->definition.travel, 1e-12);
  double *step = f.engine->quadratic->step;
  memset(step, 0, (size_t)f.n * sizeof *step);
  step[f.problem->coordinates + tx] = 1.5;
  assert_close(ambulo__step_limit(f.engine->setup, step, 0.5), 1.0, 0);
  step[f.problem->coordinates + tx] = -2.0 * f.engine->setup->cap[tx];
  assert_close(ambulo__step_limit(f.engine->setup, step, 0.5), 0.25, 1e-15);
  engine_close(&f);
}

static void the_start_does_not_move_the_scales(void **state) {
  (void)state;
  engine_fixture zero, rough;
  engine_open(&zero, "support/walk_rigid");
  engine_open(&rough, "support/walk_rigid");
  ambulo__engine_free(rough.engine);
  scatter(rough.x, rough.n, 0.5);
  assert_int_equal(
      ambulo__engine_create(rough.problem, rough.x, NULL, &rough.run, NULL, &rough.engine),
      AMBULO_OK);
  assert_close(rough.engine->setup->objective_scale, zero.engine->setup->objective_scale, 0);
  assert_close(rough.engine->setup->negligible, zero.engine->setup->negligible, 0);
  double share = zero.options.optimality_tolerance;
  assert_close(zero.engine->setup->negligible, share * zero.engine->setup->at_rest,
               1e-12 * zero.engine->setup->at_rest);
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
    product[k] = factor * e->setup->objective_scale;
    ambulo__engine_free(e);
    fixture_close(&f);
  }
  assert_close(product[1], product[0], 1e-9 * product[0]);
}

/* mu on the diagonal, and rounding of each element: relative to that element */
static void the_metric_is_clear_of_rounding(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_restored(&f, "yardstick_12");
  ambulo__engine *e = f.engine;
  assert_int_equal(ambulo__evaluate_jacobian(e->workspace, f.x), AMBULO_OK);
  const ambulo__band *base = &e->linearized.base, *raw = &e->linearized.whitener;
  ambulo__metric_fill(&e->linearized.metric, e->workspace, e->setup->objective_scale,
                      &e->linearized.whitener);
  e->linearized.assembled = 1;
  e->linearized.filled_mu = -1.0; /* the way to the surface has left its own */
  assert_int_equal(ambulo__engine_fill_metric(e, 0.0), 0);
  assert_int_equal(e->linearized.assembled, 0); /* what was made of it is of another one */
  for (int j = 0; j < e->setup->n; j++) {
    size_t at = (size_t)j * (size_t)base->ld;
    double raised = base->a[at] / raw->a[at] - 1.0;
    assert_true(raised > 1e-14 && raised < 1e-12);
    assert_true(base->a[at + 1] == raw->a[at + 1]);
  }
  engine_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_metric_is_clear_of_rounding),
                                     cmocka_unit_test(steps_are_capped_by_what_moves),
                                     cmocka_unit_test(the_start_does_not_move_the_scales),
                                     cmocka_unit_test(linear_objectives_have_a_scale)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
