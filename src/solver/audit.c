/* solver/audit.c - see audit.h.
 *
 * First-order conditions. With g = grad J, the rows with |c| within the active tolerance
 * or below count as active, A. The nearest direction to -g that keeps the active rows to first
 * order,
 *
 *     minimize |d + g|^2 / 2   subject to   J_e d = 0, C d = 0, J_A d >= 0
 *
 * is zero exactly at a KKT point, and its multipliers are the least-squares multipliers
 * with the right signs (Moreau's decomposition of -g by the cone of feasible directions).
 * kkt = |d| / |g| in infinity norms. It is solved by the piecewise quadratic model of
 * model_step.c with H0 = I, a large penalty, and the method of multipliers.
 *
 * kkt is relative to g, which vanishes where the objective reaches zero, its lower bound: there
 * the bound itself is the proof (engine.c, negligible_objective).
 */
#include "solver/audit.h"

#include <math.h>
#include <string.h>

enum { MULTIPLIER_PASSES = 12 };
static const double active_factor = 10.0; /* times the feasibility tolerance */
static const double cone_penalty = 1e4;
static const double far_away = -1e30; /* excess of a row that is not active */
static const double cone_tolerance = 1e-9;

double ambulo__row_violation(const ambulo_problem *p, int row, double value) {
  if (!isfinite(value)) return HUGE_VAL;
  return p->table.rows[row].relation == AMBULO_EQUAL ? fabs(value) : fmax(0.0, -value);
}

/* -------------------------------------------------------------- violations */

static ambulo_violation violation_of(const ambulo_problem *p, int row, double worst) {
  const ambulo__table_row *r = &p->table.rows[row];
  ambulo_violation v = {r->family, r->subject, r->detail, r->unit, r->time, worst};
  return v;
}

static void audit_violations(const ambulo_problem *p, ambulo_result *result) {
  ambulo_violation none = {"", "", "", "", 0.0, 0.0};
  int families = 0;
  result->audit.violation = none;
  for (int r = 0; r < p->rows; r++) {
    double worst = ambulo__row_violation(p, r, result->row[r]);
    int f = 0;
    while (f < families && strcmp(result->family[f].family, p->table.rows[r].family) != 0) f++;
    if (f == families) {
      result->family[families++] = violation_of(p, r, worst);
    } else if (worst > result->family[f].worst) {
      result->family[f] = violation_of(p, r, worst);
    }
    if (r == 0 || worst > result->audit.violation.worst)
      result->audit.violation = violation_of(p, r, worst);
  }
}

/* ------------------------------------------------------- first-order conditions */

static double largest(const double *v, int n) {
  double worst = 0.0;
  for (int j = 0; j < n; j++) worst = fmax(worst, fabs(v[j]));
  return worst;
}

/* solves the cone problem; the direction stays in engine->total; 0 on success */
static int project(ambulo__engine *e) {
  double decrease, bound = cone_tolerance * largest(e->gradient, e->n);
  ambulo__band_clear(&e->base);
  ambulo__band_add_diagonal(&e->base, 1.0);
  e->rho = cone_penalty;
  memset(e->lambda, 0, (size_t)e->inequalities * sizeof *e->lambda);
  memset(e->equality_multiplier, 0, (size_t)e->equalities * sizeof *e->equality_multiplier);
  for (int pass = 0; pass < MULTIPLIER_PASSES; pass++) {
    for (int i = 0; i < e->inequalities; i++)
      e->linear[i] = e->held.excess[i] < 0.0 ? far_away : 0.0;
    if (ambulo__model_minimize(e, &decrease) < 0) return 1;
    double worst = 0.0;
    for (int i = 0; i < e->inequalities; i++) {
      worst = fmax(worst, fabs(fmax(e->linear[i], -e->lambda[i] / e->rho)));
      e->lambda[i] = fmax(0.0, e->lambda[i] + e->rho * e->linear[i]);
    }
    if (worst <= bound) break;
  }
  return 0;
}

/* gradients of length 1, which neither the cone nor the tolerance of a row notices: on fine
 * grids rows on accelerations are so much longer than others that the penalty of some would
 * drown the rest */
static void normalize(ambulo__sparse_rows *rows) {
  for (int i = 0; i < rows->count; i++) {
    double norm = ambulo__sparse_rows_norm(rows, i);
    if (norm > 0.0) ambulo__sparse_rows_set_scale(rows, i, rows->scale[i] / norm);
  }
}

/* marks active rows in held.excess: 0 active, -1 not; returns their number */
static int mark(ambulo__engine *e, double tolerance) {
  const ambulo__sparse_rows *rows = &e->rows.inequality;
  int count = 0;
  ambulo__engine_excess(e, e->held.excess);
  for (int i = 0; i < e->inequalities; i++) {
    int active = e->held.excess[i] >= tolerance * rows->scale[i];
    e->held.excess[i] = active ? 0.0 : -1.0;
    count += active;
  }
  return count;
}

/* from the engine's scaled multipliers to those of grad J = sum multiplier grad c */
static void collect_multipliers(ambulo__engine *e, ambulo_result *result) {
  const ambulo__rows_split *s = &e->rows;
  memset(result->multiplier, 0, (size_t)result->rows * sizeof *result->multiplier);
  for (int i = 0; i < e->inequalities; i++)
    result->multiplier[s->inequality.row[i]] =
        -s->inequality.scale[i] * e->lambda[i] / e->objective_scale;
  for (int i = 0; i < e->equalities; i++)
    result->multiplier[s->equality.row[i]] = -e->equality_multiplier[i] / e->objective_scale;
  for (int i = 0; i < e->borders; i++)
    result->multiplier[s->border.row[i]] = -e->border_multiplier[i] / e->objective_scale;
}

static void audit_complementarity(const ambulo__engine *e, ambulo_result *result) {
  const ambulo__sparse_rows *rows = &e->rows.inequality;
  for (int i = 0; i < e->inequalities; i++) {
    int r = rows->row[i];
    result->audit.complementarity =
        fmax(result->audit.complementarity, fabs(result->multiplier[r] * result->row[r]));
  }
  result->audit.complementarity /= fmax(1.0, fabs(result->objective));
}

/* rank of all equalities together with the active inequalities */
static ambulo_status audit_rank(ambulo__engine *e, ambulo_result *result) {
  const ambulo_problem *p = e->problem;
  ambulo__sparse_rows rows;
  int count = 0;
  int *list = ambulo__pool_ints(&e->pool, (size_t)p->rows);
  int *rank = ambulo__pool_ints(&e->pool, (size_t)p->rows);
  if (e->pool.failed) return AMBULO_E_MEMORY;
  for (int r = 0; r < p->rows; r++) {
    if (p->table.rows[r].relation == AMBULO_EQUAL) list[count++] = r;
  }
  for (int i = 0; i < e->inequalities; i++) {
    if (e->held.excess[i] >= 0.0) list[count++] = e->rows.inequality.row[i];
  }
  double *value = ambulo__pool_doubles(&e->pool, (size_t)count);
  ambulo_status status = ambulo__sparse_rows_create(p, list, count, &e->pool, &rows);
  if (status) return status;
  ambulo__sparse_rows_fill(&rows, e->workspace, 1);
  ambulo__sparse_rows_values(&rows, e->workspace, value);
  status = ambulo__rank_sort(&rows, value, &e->pool, rank);
  if (status) return status;
  result->audit.active_rows = count;
  for (int i = 0; i < count; i++) result->audit.rank += rank[list[i]] == AMBULO__ROW_INDEPENDENT;
  return AMBULO_OK;
}

static void audit_first_order(ambulo__engine *e, const ambulo_options *options,
                              ambulo_result *result) {
  ambulo__sparse_rows_fill(&e->rows.equality, e->workspace, 1);
  ambulo__sparse_rows_fill(&e->rows.inequality, e->workspace, 1);
  mark(e, active_factor * options->feasibility_tolerance);
  ambulo__engine_gradient(e, NULL, NULL, e->gradient);
  double size = largest(e->gradient, e->n);
  result->audit.kkt = HUGE_VAL;
  if (!isfinite(size)) return;
  if (project(e)) {
    normalize(&e->rows.inequality);
    if (project(e)) return;
  }
  result->audit.kkt = size > 0.0 ? largest(e->total, e->n) / fmax(1e-12, size) : 0.0;
  collect_multipliers(e, result);
  audit_complementarity(e, result);
}

ambulo_status ambulo__audit(ambulo__engine *e, const ambulo_options *options,
                            ambulo_result *result) {
  const ambulo_problem *p = e->problem;
  ambulo_violation none = {"", "", "", "", 0.0, NAN};
  memset(&result->audit, 0, sizeof result->audit);
  result->audit.dropped_equalities = e->rows.dropped;
  result->audit.kkt = HUGE_VAL;
  result->audit.violation = result->audit.dense_violation = none;
  if (ambulo__evaluate_jacobian(e->workspace, result->x)) {
    result->objective = NAN;
    return AMBULO_OK;
  }
  result->objective = e->workspace->objective;
  result->audit.at_lower_bound = ambulo__engine_at_lower_bound(e);
  memcpy(result->term, e->workspace->term_value, (size_t)result->terms * sizeof *result->term);
  memcpy(result->row, e->workspace->row_value, (size_t)result->rows * sizeof *result->row);
  audit_violations(p, result);
  audit_first_order(e, options, result);
  return audit_rank(e, result);
}
