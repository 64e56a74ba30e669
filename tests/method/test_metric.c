/* The banded metric is the objective's curvature, found by another route; its scale, and what
 * stands in where there is none. */
#include "method/parameters.h"
#include "support/problem_fixture.h"
#include "support/residual_curvature.h"
#include "support/engine_fixture.h"
#include "support/metric_along.h"

static void compare_along(ambulo_workspace *w, const double *x, double second, unsigned seed) {
  int n = w->problem->variables;
  double *d = calloc((size_t)n, sizeof *d);
  for (int trial = 0; trial < 4; trial++) {
    for (int j = 0; j < n; j++)
      d[j] = trial < 2 ? random_number(&seed) : (j % (n / 3) == trial ? 1.0 : 0.0);
    double want = curvature_along(w, x, d, second), got = metric_along(w, x, d);
    assert_true(want > 0.0);
    if (fabs(got / want - 1.0) > 1e-4) print_error("along %d: %g, expected %g\n", trial, got, want);
    assert_close(got / want, 1.0, 1e-4);
  }
  free(d);
}

/* 0.3 + tau_1 - 2 qd_0 + the hand's height */
static double mixed(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  if (g) {
    g->tau[1] += 1.0;
    g->qd[0] -= 2.0;
    g->points[1] += 1.0;
  }
  return 0.3 + s->tau[1] - 2.0 * s->qd[0] + s->points[1];
}

/* 1.5 tau_0^2, of unknown shape */
static double bowl(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  if (g) g->tau[0] += 3.0 * s->tau[0];
  return 1.5 * s->tau[0] * s->tau[0];
}

/* of each kind of term by itself, and of all together: on an arm */
static void curvature_is_that_of_the_residuals(void **state) {
  (void)state;
  static const ambulo_term_kind kinds[] = {
      AMBULO_TORQUE_SQUARED, AMBULO_TORQUE_ABSOLUTE,
      AMBULO_ACCELERATION,   AMBULO_TORQUE_POWER,
      AMBULO_TORQUE_RATE,    AMBULO_MECHANICAL_POWER,
      AMBULO_POSTURE,        AMBULO_TRACKING,
      AMBULO_UPRIGHT,        AMBULO_USER_SQUARE,
      AMBULO_USER_TERM,      AMBULO_MECHANICAL_POWER}; /* once more, with a tendon */
  static const double tendon[ARM_COORDINATES] = {5.0, 0.0};
  enum { KINDS = sizeof kinds / sizeof *kinds, NODES = 11 };
  static const double scale[ARM_COORDINATES] = {0.5, 2.0};
  static const double offset[ARM_COORDINATES] = {1.0, -0.5};
  static const double reference[NODES * ARM_COORDINATES] = {0.1, 0.2, 0.3};
  static const ambulo_discretization grids[] = {AMBULO_BSPLINE, AMBULO_HERMITE,
                                                AMBULO_CENTRAL_DIFFERENCE};
  for (int only = 0; only < KINDS + 3; only++) { /* the last: all, on nodes of different widths */
    fixture f = {.model = arm_create()};
    ambulo_problem_definition d = arm_definition(f.model);
    ambulo_term terms[KINDS];
    int count = 0;
    for (int k = 0; k < KINDS; k++) {
      if (only < KINDS && k != only) continue;
      ambulo_term *term = &terms[count++];
      *term = ambulo_term_default(kinds[k]);
      term->weight = 0.3 + 0.1 * k;
      if (!ambulo__is_user_term(term) && kinds[k] != AMBULO_UPRIGHT) term->scale = scale;
      if (kinds[k] == AMBULO_TORQUE_SQUARED || kinds[k] == AMBULO_POSTURE) term->offset = offset;
      if (kinds[k] == AMBULO_TRACKING) term->reference = reference;
      if (k == KINDS - 1) term->tendon = tendon;
      if (kinds[k] == AMBULO_MECHANICAL_POWER) term->negative = 0.4;
      term->point[0] = 0;
      term->point[1] = 1;
      term->function = kinds[k] == AMBULO_USER_SQUARE ? mixed : bowl;
    }
    d.terms = terms;
    d.term_count = count;
    d.discretization = grids[only < KINDS ? 0 : only - KINDS];
    fixture_open(&f, &d);
    compare_along(f.workspace, f.x, 3.0, 5u + (unsigned)only);
    fixture_close(&f);
  }
}

/* several terms may have residuals over two nodes */
static void every_residual_has_room(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition d = arm_definition(f.model);
  ambulo_term terms[3];
  for (int k = 0; k < 3; k++) {
    terms[k] = ambulo_term_default(AMBULO_TORQUE_RATE);
    terms[k].weight = 1.0 + k;
  }
  d.terms = terms;
  d.term_count = 3;
  fixture_open(&f, &d);
  compare_along(f.workspace, f.x, 0.0, 3u);
  fixture_close(&f);
}

static void compare_shipped(const char *name) {
  ambulo_problem *p = load_problem(name);
  ambulo_workspace *w = NULL;
  unsigned seed = 4;
  double *x = calloc((size_t)p->variables, sizeof *x);
  for (int j = 0; j < p->variables; j++) x[j] = 0.1 * random_number(&seed);
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  compare_along(w, x, 0.0, 9u);
  ambulo_workspace_free(w);
  ambulo_problem_free(p);
  free(x);
}

/* and of walks: terms about feet and forces; nodes on knots, which fewer unknowns reach */
static void curvature_of_a_walk_too(void **state) {
  (void)state;
  compare_shipped("support/walk_rigid");
  compare_shipped("walk_normal"); /* rates of forces between nodes that stand close, or on knots */
  compare_shipped("support/walker_2d_step");
}

/* -lambda d2v along d, of all cones at once: the change of their slopes by the force where that
 * moves by dF = (F(x + h d) - F(x - h d)) / 2 h, without what bends the force itself */
static double cones_along(ambulo_workspace *w, const ambulo__sparse_rows *rows,
                          const double *lambda, const double *x, const double *d) {
  const ambulo_problem *p = w->problem;
  const int channels = w->channel_count, all = p->nodes * channels;
  const double h = 1e-5;
  double *y = calloc((size_t)p->variables, sizeof *y), sum = 0.0;
  double *force = calloc((size_t)(3 * all), sizeof *force);
  for (int side = 0; side < 3; side++) {
    for (int j = 0; j < p->variables; j++) y[j] = x[j] + (side - 1) * h * d[j];
    assert_int_equal(ambulo__evaluate(w, y), AMBULO_OK);
    for (int i = 0; i < all; i++)
      force[side * all + i] = w->channel[ambulo__lane_index(i / channels, channels, i % channels)];
  }
  for (int i = 0; i < rows->count; i++) {
    const ambulo__table_row *row = &p->table.rows[rows->row[i]];
    const ambulo__curved *curved = ambulo__row_curved_of(&p->table, row);
    if (!curved || curved->form != AMBULO__CURVED_CONE) continue;
    for (int side = -1; side <= 1; side += 2) {
      double at[3], by[3] = {0.0}, move[3];
      ambulo__cone cone = curved->of.cone;
      int first = row->node * channels + cone.force;
      for (int k = 0; k < 3; k++) {
        move[k] = (force[2 * all + first + k] - force[first + k]) / (2.0 * h);
        at[k] = force[all + first + k] + side * 1e-4 * move[k];
      }
      cone.force = 0;
      (void)ambulo__cone_value(&cone, at, 1, by);
      for (int k = 0; k < 3; k++) sum += lambda[i] * rows->scale[i] * side * by[k] * move[k] / 2e-4;
    }
  }
  free(force);
  free(y);
  return sum;
}

/* the Lagrangian bends where a cone has a force */
static void cones_bend_the_metric(void **state) {
  (void)state;
  engine_fixture f;
  unsigned seed = 8;
  engine_open(&f, "walk");
  const ambulo__sparse_rows *rows = &f.engine->setup->rows->inequality;
  ambulo_workspace *w = f.engine->workspace;
  ambulo__metric *metric = &f.engine->linearized.metric;
  ambulo__band *h = &f.engine->linearized.base;
  double *lambda = calloc((size_t)rows->count, sizeof *lambda);
  double *d = calloc((size_t)f.n, sizeof *d), *hd = calloc((size_t)f.n, sizeof *hd);
  for (int i = 0; i < rows->count; i++) lambda[i] = fmax(0.0, random_number(&seed));
  for (int j = 0; j < f.n; j++) f.x[j] = 0.1 * random_number(&seed);
  for (int trial = 0; trial < 3; trial++) {
    double got = 0.0;
    for (int j = 0; j < f.n; j++) d[j] = 1e-3 * random_number(&seed);
    double want = cones_along(w, rows, lambda, f.x, d);
    assert_int_equal(ambulo__evaluate_jacobian(w, f.x), AMBULO_OK);
    ambulo__metric_fill(metric, w, 1.0, h);
    ambulo__band_multiply(h, d, hd);
    for (int j = 0; j < f.n; j++) got -= d[j] * hd[j];
    ambulo__metric_add_bends(metric, w, rows, lambda, h);
    ambulo__band_multiply(h, d, hd);
    for (int j = 0; j < f.n; j++) got += d[j] * hd[j];
    assert_true(want > 0.0);
    if (fabs(got / want - 1.0) > 1e-5) print_error("along %d: %g, expected %g\n", trial, got, want);
    assert_close(got / want, 1.0, 1e-5);
  }
  free(lambda);
  free(d);
  free(hd);
  engine_close(&f);
}

/* ---------------------------------------------------------------------- scale */

/* qd_0 */
static double rate_of_the_first(void *user, const ambulo_node_state *s, ambulo_node_gradient *g) {
  (void)user;
  if (g) g->qd[0] += 1.0;
  return s->qd[0];
}

/* 1.5 qdd_1^2 */
static double bowl_of_accelerations(void *user, const ambulo_node_state *s,
                                    ambulo_node_gradient *g) {
  (void)user;
  if (g) g->qdd[1] += 3.0 * s->qdd[1];
  return 1.5 * s->qdd[1] * s->qdd[1];
}

/* Half a wave in the time T goes with w = pi / T: q = qdd / w^2, qd = qdd / w. The curvature along
 * qdd, mean over time and both joints, times the scale is REFERENCE_CURVATURE. */
static void scale_follows_from_half_a_wave(void **state) {
  (void)state;
  const double w = 3.14159265358979323846, T = 1.0;
  static const ambulo_term_kind kinds[] = {AMBULO_POSTURE, AMBULO_ACCELERATION, AMBULO_USER_SQUARE,
                                           AMBULO_USER_TERM};
  const double curvature[] = {2.0 / pow(w / T, 4.0), 2.0, 0.5 * 2.0 / pow(w / T, 2.0), 0.5 * 3.0};
  for (int k = 0; k < 4; k++) {
    fixture f = {.model = arm_create()};
    ambulo_problem_definition d = arm_definition(f.model);
    ambulo_term term = ambulo_term_default(kinds[k]);
    ambulo__pool pool;
    ambulo__metric metric;
    term.weight = 0.7;
    term.function = k == 2 ? rate_of_the_first : bowl_of_accelerations;
    d.terms = &term;
    fixture_open(&f, &d);
    ambulo__pool_init(&pool, NULL);
    assert_int_equal(ambulo__metric_create(f.problem, &pool, &metric), AMBULO_OK);
    assert_int_equal(ambulo__evaluate_jacobian(f.workspace, f.x), AMBULO_OK);
    assert_close(ambulo__metric_objective_scale(&metric, f.workspace) * 0.7 * curvature[k] /
                     AMBULO__REFERENCE_CURVATURE,
                 1.0, 1e-3);
    ambulo__pool_clear(&pool);
    fixture_close(&f);
  }
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
  double with = scale_with("support/walk_rigid", NULL);
  assert_close(scale_with("support/walk_rigid", "objective[1].weight=0") / with, 1.0,
               0.1); /* upright */
  assert_close(scale_with("support/walk_rigid", "objective[4].weight=0") / with, 1.0,
               0.1); /* ankle */
  assert_close(scale_with("support/walk_rigid", "objective[5].weight=0") / with, 1.0,
               0.1); /* pelvis */
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

/* a curvature is there, on few channels or light ones: then no other is put in its place */
static void the_stand_in_stands_in_for_nothing_else(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition d = arm_definition(f.model);
  ambulo_term term = ambulo_term_default(AMBULO_POSTURE);
  static const double scale[ARM_COORDINATES] = {1.0, 0.0};
  term.scale = scale;
  d.terms = &term;
  fixture_open(&f, &d);
  double *x = calloc((size_t)f.n, sizeof *x);
  for (int j = 0; j < f.n; j++) x[j] = j % ARM_COORDINATES; /* moves the elbow only */
  assert_true(metric_along(f.workspace, f.x, x) == 0.0);
  for (int j = 0; j < f.n; j++) x[j] = 1 - j % ARM_COORDINATES;
  assert_close(metric_along(f.workspace, f.x, x), 2.0, 1e-9); /* one second of u = 1 */
  free(x);
  fixture_close(&f);
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
  const struct CMUnitTest tests[] = {cmocka_unit_test(curvature_is_that_of_the_residuals),
                                     cmocka_unit_test(every_residual_has_room),
                                     cmocka_unit_test(curvature_of_a_walk_too),
                                     cmocka_unit_test(cones_bend_the_metric),
                                     cmocka_unit_test(scale_follows_from_half_a_wave),
                                     cmocka_unit_test(the_stand_in_stands_in_for_nothing_else),
                                     cmocka_unit_test(scale_takes_the_unit_away),
                                     cmocka_unit_test(postures_do_not_move_the_scale),
                                     cmocka_unit_test(scale_goes_with_the_mass_squared),
                                     cmocka_unit_test(problem_without_objective_has_a_metric),
                                     cmocka_unit_test(nan_reaches_the_factorization)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
