/* The audit tells a good point from a spoilt one, whoever made it. */
#include "solver/result.h"
#include "ambulo/tools/load.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

static ambulo_result *audit(const ambulo_problem *problem, const double *x) {
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_audit_point(problem, &options, x, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static ambulo_result *solve(const ambulo_problem *problem) {
  ambulo_options options = ambulo_options_default();
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  return result;
}

static void spoilt_coordinate_is_found_by_name(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("support/two_link_reach");
  ambulo_result *solved = solve(problem);
  assert_int_equal(verdict_at_nodes(solved), AMBULO_OPTIMAL);
  size_t n = (size_t)ambulo_problem_variable_count(problem);
  double *x = calloc(n, sizeof *x);
  memcpy(x, ambulo_result_x(solved), n * sizeof *x);
  x[0] += 1e-3;
  ambulo_result *spoilt = audit(problem, x);
  assert_int_equal(verdict_at_nodes(spoilt), AMBULO_INFEASIBLE);
  assert_string_equal(ambulo_result_audit(spoilt)->violation.family, "initial_state");
  assert_string_equal(ambulo_result_audit(spoilt)->violation.subject, "shoulder");
  assert_true(ambulo_result_audit(spoilt)->violation.worst >= 1e-3 - 1e-9);
  free(x);
  ambulo_result_free(spoilt);
  ambulo_result_free(solved);
  ambulo_problem_free(problem);
}

/* feasible but not stationary: the restored point */
static void restored_point_is_not_called_optimal(void **state) {
  (void)state;
  engine_fixture f;
  engine_open_restored(&f, "pendulum_swing");
  ambulo_result *result = audit(f.problem, f.x);
  assert_true(ambulo_result_audit(result)->violation.worst <= 1e-6);
  assert_int_equal(verdict_at_nodes(result), AMBULO_FEASIBLE);
  assert_true(ambulo_result_audit(result)->kkt > 1e-3);
  ambulo_result_free(result);
  engine_close(&f);
}

/* grad J = sum multiplier grad c, with multipliers of inequalities >= 0 */
static void multipliers_explain_the_gradient(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_result *r = solve(problem);
  ambulo_workspace *workspace = NULL;
  int n = ambulo_problem_variable_count(problem), m = ambulo_problem_row_count(problem);
  double *rest = calloc((size_t)n, sizeof *rest), *g = calloc((size_t)n, sizeof *g);
  double *weights = calloc((size_t)m, sizeof *weights), size = 0.0, worst = 0.0;
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  for (int i = 0; i < m; i++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(problem, i, &row), AMBULO_OK);
    weights[i] = -ambulo_result_multipliers(r)[i];
    if (row.relation == AMBULO_NOT_NEGATIVE) assert_true(weights[i] <= 0.0);
  }
  assert_int_equal(ambulo_problem_gradient(problem, workspace, ambulo_result_x(r), 1.0, NULL, g),
                   AMBULO_OK);
  assert_int_equal(
      ambulo_problem_gradient(problem, workspace, ambulo_result_x(r), 1.0, weights, rest),
      AMBULO_OK);
  for (int j = 0; j < n; j++) {
    size = fmax(size, fabs(g[j]));
    worst = fmax(worst, fabs(rest[j]));
  }
  assert_true(worst <= 1.1 * ambulo_result_audit(r)->kkt * size + 1e-7 * size);
  assert_int_equal(ambulo_result_audit(r)->dropped_equalities, 16);
  assert_true(ambulo_result_audit(r)->rank <= ambulo_result_audit(r)->active_rows - 16);
  free(rest);
  free(g);
  free(weights);
  ambulo_workspace_free(workspace);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* between the nodes a coarse spline cannot hold its contacts: the audit says how far off; of
 * quantities of different unit the one that is furthest beyond its tolerance */
static void dense_violation_is_larger_than_the_nodes(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  ambulo_result *r = solve(problem);
  const ambulo_violation *worst = &ambulo_result_audit(r)->dense_violation;
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r);
  assert_true(worst->worst > 1e-3);
  assert_true(strlen(worst->family) > 0);
  for (int i = 0; i < dense->family_count; i++) {
    const ambulo_dense_family *f = &dense->families[i];
    assert_true(f->violation.worst / f->tolerance <= worst->worst / dense->families[0].tolerance);
  }
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* the worst row of a family, relative to its size */
static double worst_of(const ambulo_problem *p, const ambulo_result *r, const char *family) {
  const double *value = ambulo_result_rows(r);
  double worst = -1.0;
  for (int k = 0; k < p->rows; k++) {
    const ambulo__table_row *row = &p->table.rows[k];
    if (strcmp(row->family, family) != 0) continue;
    double missed = row->relation == AMBULO_EQUAL ? fabs(value[k]) : fmax(0.0, -value[k]);
    worst = fmax(worst, missed / row->size);
  }
  return worst;
}

static void families_are_complete(void **state) {
  (void)state;
  ambulo_problem *problem = load_problem("yardstick_12");
  size_t n = (size_t)ambulo_problem_variable_count(problem);
  double *x = calloc(n, sizeof *x), worst = 0.0;
  ambulo_result *r = audit(problem, x);
  for (int i = 0; i < ambulo_result_family_count(r); i++) {
    const ambulo_violation *v = ambulo_result_family(r, i);
    assert_non_null(v->family);
    assert_close(v->worst / v->size, worst_of(problem, r, v->family), 0.0);
    for (int k = 0; k < i; k++)
      assert_string_not_equal(v->family, ambulo_result_family(r, k)->family);
    worst = fmax(worst, v->worst);
  }
  assert_true(ambulo_result_family_count(r) >= 5);
  assert_close(worst, ambulo_result_audit(r)->violation.worst, 0.0);
  assert_null(ambulo_result_family(r, ambulo_result_family_count(r)));
  free(x);
  ambulo_result_free(r);
  ambulo_problem_free(problem);
}

/* a solve audits more than once: what an audit takes it gives back */
static void audits_keep_no_memory(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  ambulo_problem *problem = load_problem("pendulum_swing");
  ambulo_options options = ambulo_options_default();
  ambulo__engine *engine = NULL;
  ambulo_result *result = NULL;
  ambulo__run run;
  ambulo__run_begin(&run, &options);
  assert_int_equal(ambulo__result_create(problem, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo__engine_create(problem, result->x, &hook, &run, NULL, &engine),
                   AMBULO_OK);
  long before = memory.live;
  for (int k = 0; k < 300; k++)
    assert_int_equal(ambulo__audit(engine, &options, result), AMBULO_OK);
  assert_int_equal(memory.live, before);
  ambulo__engine_free(engine);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* the audit's other numbers, from their definitions */
static void figures_are_those_of_the_point(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("yardstick_12");
  for (int t = 0; t < p->definition.term_count; t++)
    ((ambulo_term *)p->definition.terms)[t].weight *= 100.0;
  ambulo_result *r = solve(p);
  const ambulo_audit *a = ambulo_result_audit(r);
  const double *value = ambulo_result_rows(r), *multiplier = ambulo_result_multipliers(r);
  double worst = 0.0;
  int active = 0;
  for (int k = 0; k < p->rows; k++) {
    const ambulo__table_row *row = &p->table.rows[k];
    if (row->relation == AMBULO_EQUAL) {
      active++;
      continue;
    }
    worst = fmax(worst, fabs(multiplier[k] * value[k]));
    active += value[k] <= 10.0 * ambulo_options_default().feasibility_tolerance * row->size;
  }
  assert_true(fabs(ambulo_result_objective(r)) > 1.5); /* it is divided by */
  assert_close(a->complementarity, worst / fabs(ambulo_result_objective(r)), 1e-12);
  assert_int_equal(a->active_rows, active);
  assert_true(a->rank > 0 && a->rank <= active);
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* contradictory and dependent equalities are active, but of no rank */
static void rank_leaves_out_what_depends(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/infeasible/equalities_contradict.yaml", NULL, 0, NULL, NULL, &p),
      AMBULO_OK);
  double *x = calloc((size_t)p->variables, sizeof *x);
  ambulo_result *r = audit(p, x);
  const ambulo_audit *a = ambulo_result_audit(r);
  assert_true(a->dropped_equalities > 0);
  assert_int_equal(a->rank, a->active_rows - a->dropped_equalities);
  free(x);
  ambulo_result_free(r);
  ambulo_problem_free(p);
}

/* rows within ten tolerances of their limit count as active, and so do those within a hundred whose
 * slack is worth little; what is not finite is named */
static void active_rows_are_near_their_limit(void **state) {
  (void)state;
  static const double gaps[4] = {5e-6, 2e-5, 2e-5, 2e-4}, stationary[4] = {1e-3, 1e-3, 1e-9, 1e-3};
  ambulo_problem *p = load_problem("support/two_link_reach"), *free_ends = NULL;
  ambulo_problem_definition d = p->definition;
  d.end_value_count = 0;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &free_ends), AMBULO_OK);
  double *x = calloc((size_t)free_ends->variables, sizeof *x);
  for (int k = 0; k < 4; k++) {
    ambulo_options options = ambulo_options_default();
    ambulo_result *r = NULL;
    options.optimality_tolerance = stationary[k];
    for (int j = 1; j < free_ends->variables; j += free_ends->coordinates)
      x[j] = p->model->coordinates[1].range[1] - gaps[k];
    assert_int_equal(ambulo_audit_point(free_ends, &options, x, NULL, NULL, &r), AMBULO_OK);
    int active = ambulo_result_audit(r)->active_rows;
    if (k == 1) assert_true(active > 0 && active < free_ends->nodes); /* those with a force */
    if (k != 1) assert_int_equal(active, k == 0 ? free_ends->nodes : 0);
    ambulo_result_free(r);
  }
  x[3] = NAN;
  ambulo_workspace *workspace = NULL;
  ambulo_result *r = NULL;
  assert_int_equal(ambulo_workspace_create(free_ends, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo__result_create(free_ends, NULL, &r), AMBULO_OK);
  memcpy(r->x, x, (size_t)free_ends->variables * sizeof *x);
  r->objective = 1.0;
  assert_int_equal(ambulo__audit_values(workspace, r), AMBULO_E_NUMERIC);
  assert_int_equal(r->audit.fault.kind, AMBULO_FAULT_UNKNOWN);
  assert_true(isnan(r->objective) && isnan(r->audit.violation.worst));
  ambulo_result_free(r);
  ambulo_workspace_free(workspace);
  free(x);
  ambulo_problem_free(free_ends);
  ambulo_problem_free(p);
}

/* no value that is not finite is a small violation */
static void infinite_rows_are_violated(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach");
  for (int r = 0; r < p->rows; r += 7) {
    assert_true(isinf(ambulo__row_violation(p, r, NAN)));
    assert_true(isinf(ambulo__row_violation(p, r, INFINITY)));
  }
  ambulo_problem_free(p);
}

/* where every row holds exactly the worst one still has a name */
static void the_worst_row_has_a_name(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach"), *free_ends = NULL;
  ambulo_problem_definition d = p->definition;
  d.end_value_count = 0;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &free_ends), AMBULO_OK);
  double *x = calloc((size_t)free_ends->variables, sizeof *x);
  ambulo_result *r = audit(free_ends, x);
  assert_true(free_ends->rows > 0);
  assert_true(ambulo_result_audit(r)->violation.worst == 0.0);
  assert_true(strlen(ambulo_result_audit(r)->violation.family) > 0);
  free(x);
  ambulo_result_free(r);
  ambulo_problem_free(free_ends);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(spoilt_coordinate_is_found_by_name),
      cmocka_unit_test(restored_point_is_not_called_optimal),
      cmocka_unit_test(multipliers_explain_the_gradient),
      cmocka_unit_test(dense_violation_is_larger_than_the_nodes),
      cmocka_unit_test(families_are_complete),
      cmocka_unit_test(audits_keep_no_memory),
      cmocka_unit_test(figures_are_those_of_the_point),
      cmocka_unit_test(rank_leaves_out_what_depends),
      cmocka_unit_test(the_worst_row_has_a_name),
      cmocka_unit_test(active_rows_are_near_their_limit),
      cmocka_unit_test(infinite_rows_are_violated),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
