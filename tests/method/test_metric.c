/* The banded metric is the sum of the nodes' Gauss-Newton matrices. */
#include "support/gauss_newton.h"
#include "support/problem_fixture.h"
#include "support/engine_fixture.h"

static void band_is_the_sum_over_nodes(void **state) {
  (void)state;
  engine_fixture f;
  unsigned seed = 8;
  engine_open(&f, "yardstick_12");
  ambulo__engine *e = f.engine;
  const ambulo_problem *p = f.problem;
  double *d = calloc((size_t)f.n, sizeof *d), *got = calloc((size_t)f.n, sizeof *got);
  double *want = calloc((size_t)f.n, sizeof *want);
  size_t widest = (size_t)ambulo__metric_diagonals(p) + 1;
  double *local = calloc(widest * widest, sizeof *local);
  for (int j = 0; j < f.n; j++) f.x[j] = 0.2 * random_number(&seed);
  for (int j = 0; j < f.n; j++) d[j] = random_number(&seed);
  assert_int_equal(ambulo__evaluate_jacobian(e->workspace, f.x), AMBULO_OK);
  ambulo__metric_fill(&e->linearized.metric, e->workspace, 2.0, &e->linearized.base);
  ambulo__band_multiply(&e->linearized.base, d, got);
  for (int k = 0; k < p->nodes; k++) {
    int first = ambulo__node_first(p, k), width = ambulo__node_width(p, k);
    memset(local, 0, widest * widest * sizeof *local);
    node_gauss_newton(e->workspace, k, local);
    for (int i = 0; i < width; i++) {
      for (int j = 0; j < width; j++) want[first + i] += 2.0 * local[i * width + j] * d[first + j];
    }
  }
  for (int j = 0; j < f.n; j++) assert_close(got[j], want[j], 1e-10);
  free(d);
  free(got);
  free(want);
  free(local);
  engine_close(&f);
}

static double scale_with(const char *name, const char *override) {
  engine_fixture f;
  engine_open_with(&f, name, override);
  double scale = f.engine->setup->objective_scale;
  engine_close(&f);
  return scale;
}

static void scale_takes_the_unit_away(void **state) {
  (void)state;
  double one = scale_with("yardstick_12", NULL);
  assert_true(one > 0.3 && one < 3.0); /* the problem that the constants were found on */
  double heavy = scale_with("yardstick_12", "objective[0].weight=1e6");
  double light = scale_with("yardstick_12", "objective[0].weight=3e-5");
  assert_close(heavy * 1e6 / (light * 3e-5), 1.0, 1e-12);
}

/* angles and postures are not bent by accelerations as much as torques are */
static void postures_do_not_move_the_scale(void **state) {
  (void)state;
  double with = scale_with("walk_normal", NULL);
  assert_close(scale_with("walk_normal", "objective[1].weight=0") / with, 1.0, 0.1); /* upright */
  assert_close(scale_with("walk_normal", "objective[4].weight=0") / with, 1.0, 0.1); /* ankle */
  assert_close(scale_with("walk_normal", "objective[5].weight=0") / with, 1.0, 0.1); /* pelvis */
}

/* the scale of torque squared for one slider from rest to rest; tau = mass qdd, a row of the root
 * force, so that the curvature along the acceleration goes with mass squared */
static double slider_scale(double mass) {
  ambulo_link link = ambulo_link_default();
  ambulo_coordinate coordinate = ambulo_coordinate_default();
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  ambulo_end_value ends[] = {{0, 0, 0, 0.0}, {0, 0, 1, 0.3}, {0, 1, 0, 0.0}, {0, 1, 1, 0.0}};
  ambulo_model_definition body = ambulo_model_definition_default();
  ambulo_problem_definition swing = ambulo_problem_definition_default();
  ambulo_model *model;
  engine_fixture f = {.options = ambulo_options_default()};
  link.name = coordinate.name = body.name = swing.name = "slider";
  link.type = coordinate.type = AMBULO_PRISMATIC;
  link.parent = -1;
  link.mass = mass;
  for (int i = 0; i < 3; i++) link.inertia[i] = 0.1;
  coordinate.mirror = 0;
  body.links = &link;
  body.coordinates = &coordinate;
  body.link_count = body.coordinate_count = 1;
  assert_int_equal(ambulo_model_create(&body, NULL, NULL, &model), AMBULO_OK);
  swing.model = model;
  swing.intervals = 10;
  swing.end_values = ends;
  swing.end_value_count = 4;
  swing.terms = &term;
  swing.term_count = 1;
  assert_int_equal(ambulo_problem_create(&swing, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)ambulo_problem_variable_count(f.problem), sizeof *f.x);
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  double scale = f.engine->setup->objective_scale;
  engine_close(&f);
  ambulo_model_free(model);
  return scale;
}

static void scale_goes_with_the_mass_squared(void **state) {
  (void)state;
  double one = slider_scale(1.0);
  assert_true(slider_scale(2.0) == one / 4.0 && slider_scale(0.5) == one * 4.0);
}

static void problem_without_objective_has_a_metric(void **state) {
  (void)state;
  engine_fixture f;
  engine_open(&f, "fig5a_feasible");
  ambulo__engine *e = f.engine;
  assert_int_equal(e->linearized.metric.channels, 0);
  ambulo__metric_fill(&e->linearized.metric, e->workspace, 1.0, &e->linearized.base);
  assert_true(ambulo__band_largest(&e->linearized.base) > 0.0);
  ambulo__band_add_diagonal(&e->linearized.base, 1e-6);
  assert_int_equal(ambulo__band_factor(&e->linearized.base), 0);
  engine_close(&f);
}

/* a torque that is not a number leaves a matrix that cannot be factored, not one without it */
static void nan_reaches_the_factorization(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition d = arm_definition(f.model);
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_ABSOLUTE);
  d.terms = &term;
  fixture_open(&f, &d);
  ambulo__pool pool;
  ambulo__metric metric;
  ambulo__band h;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__metric_create(f.problem, &pool, &metric), AMBULO_OK);
  assert_int_equal(ambulo__band_create(&pool, f.n, ambulo__metric_diagonals(f.problem), &h),
                   AMBULO_OK);
  assert_int_equal(ambulo__evaluate_jacobian(f.workspace, f.x), AMBULO_OK);
  for (int spoilt = 0; spoilt < 2; spoilt++) {
    int tau = ambulo__channel_tau(&f.problem->channels, 1);
    if (spoilt) f.workspace->channel[ambulo__lane_index(4, f.workspace->channel_count, tau)] = NAN;
    ambulo__metric_fill(&metric, f.workspace, 1.0, &h);
    ambulo__band_add_diagonal(&h, 1.0);
    assert_int_equal(ambulo__band_factor(&h) != 0, spoilt);
  }
  ambulo__pool_clear(&pool);
  fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(band_is_the_sum_over_nodes),
                                     cmocka_unit_test(scale_takes_the_unit_away),
                                     cmocka_unit_test(postures_do_not_move_the_scale),
                                     cmocka_unit_test(scale_goes_with_the_mass_squared),
                                     cmocka_unit_test(problem_without_objective_has_a_metric),
                                     cmocka_unit_test(nan_reaches_the_factorization)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
