/* solver/audit.c - how good a point is (result.h).
 *
 * First-order conditions. With g = grad J, the rows with c within the active tolerance
 * or below count as active, A; and those within ten times that whose multiplier times c, what
 * taking up their slack could gain, is a trifle of J: a row that the last micrometre of the solve
 * left a little inside would else be none at all, and its force a residual. The nearest direction
 * to -g that keeps the active rows to first order,
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
#include "solver/result.h"
#include "base/arithmetic.h"
#include "method/point.h"
#include "method/model_step.h"
#include "method/row_roles.h"

#include <math.h>
#include <string.h>

enum { MULTIPLIER_PASSES = 12 };
static const double active_factor = 10.0; /* times the feasibility tolerance */
static const double near_factor = 100.0;  /* the same, of rows whose slack is a trifle */
static const double trifle = 1e-2;        /* gain / J, times the optimality tolerance */
static const double cone_penalty = 1e4;
static const double far_away = -1e30; /* excess of a row that is not active */
static const double cone_tolerance = 1e-9;

double ambulo__row_violation(const ambulo_problem *p, int row, double value) {
  return ambulo__row_missed(&p->table.rows[row], value);
}

ambulo_violation ambulo__violation_of(const ambulo_problem *p, int row, double value) {
  const ambulo__table_row *r = &p->table.rows[row];
  ambulo_violation v = {.family = r->family,
                        .subject = r->subject,
                        .detail = r->detail,
                        .unit = r->unit,
                        .time = r->time,
                        .worst = ambulo__row_violation(p, row, value),
                        .size = r->size};
  return v;
}

/* -------------------------------------------------------------- violations */

static ambulo_violation no_violation(double worst) {
  ambulo_violation none = {.family = "", .subject = "", .detail = "", .unit = "", .size = 1.0};
  none.worst = worst;
  return none;
}

static void keep_worse(ambulo_violation v, ambulo_violation *worst) {
  if (!worst->family[0] || ambulo__is_worse(ambulo__relative(worst), ambulo__relative(&v)))
    *worst = v;
}

/* (A.1) |c|, max(0, -c) */
static void audit_violations(const ambulo_problem *p, ambulo_result *result) {
  result->audit.violation = no_violation(0.0);
  for (int g = 0; g < p->table.group_count; g++) result->family[g] = no_violation(0.0);
  for (int r = 0; r < p->rows; r++) {
    ambulo_violation v = ambulo__violation_of(p, r, result->row[r]);
    keep_worse(v, &result->family[p->table.rows[r].group]);
    keep_worse(v, &result->audit.violation);
  }
}

/* ------------------------------------------------------- first-order conditions */

/* (A.3): solves the cone problem for the gradient in the engine's model and the rows marked active;
 * the direction stays in the model; 0 on success */
static int project(ambulo__engine *e, const int *active) {
  ambulo__quadratic *q = e->quadratic;
  double *lambda = e->iterate.lambda, decrease;
  double bound = cone_tolerance * ambulo__largest(q->gradient, (size_t)e->setup->n);
  ambulo__band_clear(&e->linearized.base);
  ambulo__band_add_diagonal(&e->linearized.base, 1.0);
  e->linearized.filled_mu = -1.0; /* no H0 */
  e->linearized.assembled = 0;
  for (int pass = 0; pass < MULTIPLIER_PASSES; pass++) {
    for (int i = 0; i < e->setup->inequalities; i++) q->linear[i] = active[i] ? 0.0 : far_away;
    if (ambulo__model_minimize(e, cone_penalty, 0, &decrease)) return 1;
    double worst = 0.0;
    for (int i = 0; i < e->setup->inequalities; i++) {
      double balance = ambulo__worse(q->linear[i], -lambda[i] / cone_penalty);
      worst = ambulo__worse(worst, fabs(balance));
      lambda[i] = ambulo__worse(0.0, lambda[i] + cone_penalty * q->linear[i]);
    }
    if (worst <= bound) break;
  }
  return 0;
}

/* the scales that the solver gave the rows */
static void restore_scales(ambulo__row_roles *rows) {
  for (int i = 0; i < rows->inequality.count; i++)
    ambulo__sparse_rows_set_scale(&rows->inequality, i, -1.0 / rows->size[i]);
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

/* marks active rows; the tolerance is relative to their sizes */
static void mark(ambulo__engine *e, double tolerance, int *active) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  const ambulo__table_row *table = e->setup->problem->table.rows;
  double *excess = e->measured.excess;
  ambulo__engine_excess(e, excess);
  for (int i = 0; i < rows->count; i++) {
    double least = tolerance * table[rows->row[i]].size * rows->scale[i]; /* scale < 0 */
    active[i] = excess[i] >= least;
  }
}

/* Takes rows beyond `tolerance` out that have no force, or slack worth more than a trifle; unit: of
 * multipliers. Returns how many had a force. */
static int drop_slack(const ambulo__engine *e, double tolerance, double unit,
                      const ambulo_result *result, double worth, int *active) {
  const ambulo__sparse_rows *rows = &e->linearized.rows.inequality;
  const ambulo__table_row *table = e->setup->problem->table.rows;
  int dropped = 0;
  for (int i = 0; i < rows->count; i++) {
    double slack = result->row[rows->row[i]];
    double multiplier = -rows->scale[i] * e->iterate.lambda[i] * unit;
    if (!active[i] || slack <= tolerance * table[rows->row[i]].size) continue;
    if (multiplier > 0.0 && multiplier * slack <= worth) continue;
    active[i] = 0;
    dropped += multiplier > 0.0;
  }
  return dropped;
}

/* from multipliers for a gradient of length 1 to those of grad J = sum multiplier grad c */
static void collect_multipliers(const ambulo__engine *e, double size, ambulo_result *result) {
  const ambulo__row_roles *s = e->setup->rows;
  const ambulo__iterate *iterate = &e->iterate;
  double unit = size / e->setup->objective_scale;
  memset(result->multiplier, 0, (size_t)result->rows * sizeof *result->multiplier);
  for (int i = 0; i < s->inequality.count; i++)
    result->multiplier[s->inequality.row[i]] = -s->inequality.scale[i] * iterate->lambda[i] * unit;
  for (int i = 0; i < s->equality.count; i++)
    result->multiplier[s->equality.row[i]] = -iterate->equality_multiplier[i] * unit;
  for (int i = 0; i < s->border.count; i++)
    result->multiplier[s->border.row[i]] = -iterate->border_multiplier[i] * unit;
}

static void audit_complementarity(const ambulo__engine *e, ambulo_result *result) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  for (int i = 0; i < rows->count; i++) {
    int r = rows->row[i];
    result->audit.complementarity =
        ambulo__worse(result->audit.complementarity, fabs(result->multiplier[r] * result->row[r]));
  }
  result->audit.complementarity /= fmax(1.0, fabs(result->objective));
}

/* rank of all equalities together with the active inequalities */
static ambulo_status audit_rank(const ambulo__engine *e, const int *active, ambulo__pool *pool,
                                ambulo_result *result) {
  const ambulo_problem *p = e->setup->problem;
  ambulo__sparse_rows rows;
  int count = 0;
  int *list = ambulo__pool_ints(pool, (size_t)p->rows);
  int *rank = ambulo__pool_ints(pool, (size_t)p->rows);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int r = 0; r < p->rows; r++) {
    if (p->table.rows[r].relation == AMBULO_EQUAL) list[count++] = r;
  }
  for (int i = 0; i < e->setup->inequalities; i++) {
    if (active[i]) list[count++] = e->setup->rows->inequality.row[i];
  }
  double *value = ambulo__pool_doubles(pool, (size_t)count);
  ambulo_status status = ambulo__sparse_rows_create(p, list, count, NULL, pool, &rows);
  if (status) return status;
  ambulo__sparse_rows_fill(&rows, e->workspace, 1);
  ambulo__sparse_rows_values(&rows, e->workspace, value);
  status = ambulo__rank_sort(&rows, value, NULL, pool, rank);
  if (status) return status;
  result->audit.active_rows = count;
  result->audit.rank = 0;
  for (int i = 0; i < count; i++) result->audit.rank += rank[list[i]] == AMBULO__ROW_INDEPENDENT;
  return AMBULO_OK;
}

/* every gradient at the point; 1 when one is not finite */
static int take_gradients(ambulo__engine *e) {
  ambulo__row_roles *rows = &e->linearized.rows;
  return ambulo__sparse_rows_fill(&rows->equality, e->workspace, 1) ||
         ambulo__sparse_rows_fill(&rows->border, e->workspace, 1) ||
         ambulo__sparse_rows_fill(&rows->inequality, e->workspace, 1) ||
         ambulo__engine_gradient(e, e->setup->objective_scale, NULL, NULL, e->quadratic->gradient);
}

/* of the solved cone problem, for a gradient that had this size */
static void take_first_order(const ambulo__engine *e, double size, ambulo_result *result) {
  result->audit.kkt = ambulo__largest(e->quadratic->total, (size_t)e->setup->n);
  if (!isfinite(result->audit.kkt)) result->audit.kkt = HUGE_VAL;
  collect_multipliers(e, size, result);
  audit_complementarity(e, result);
}

/* from the solver's multipliers, if it has any; else from none */
static int project_somehow(ambulo__engine *e, const int *active) {
  if (!project(e, active)) return 0;
  const ambulo__setup *s = e->setup;
  normalize(&e->linearized.rows.inequality);
  memset(e->iterate.lambda, 0, (size_t)s->inequalities * sizeof *e->iterate.lambda);
  memset(e->iterate.equality_multiplier, 0,
         (size_t)s->equalities * sizeof *e->iterate.equality_multiplier);
  return project(e, active);
}

/* also marks the rows that are active */
static void audit_first_order(ambulo__engine *e, const ambulo_options *options, int *active,
                              ambulo_result *result) {
  const ambulo__setup *s = e->setup;
  double *gradient = e->quadratic->gradient, size = ambulo__largest(gradient, (size_t)s->n);
  /* the cone does not ask how long g is; its penalty and tolerances do */
  for (int i = 0; i < s->n && size > 0.0; i++) gradient[i] /= size;
  double tolerance = options->feasibility_tolerance, unit = size / s->objective_scale;
  double worth = trifle * options->optimality_tolerance * fabs(result->objective);
  mark(e, near_factor * tolerance, active);
  int failed = project_somehow(e, active);
  while (!failed && drop_slack(e, active_factor * tolerance, unit, result, worth, active))
    failed = project_somehow(e, active);
  if (!failed) take_first_order(e, size, result);
  restore_scales(&e->linearized.rows);
}

ambulo_status ambulo__audit_values(ambulo_workspace *w, ambulo_result *result) {
  memset(&result->audit, 0, sizeof result->audit);
  result->audit.kkt = HUGE_VAL;
  result->audit.active_rows = result->audit.rank = -1;
  result->audit.violation = result->audit.dense_violation = no_violation(NAN);
  if (ambulo__evaluate(w, result->x)) {
    result->audit.fault = w->fault;
    result->objective = NAN;
    return AMBULO_E_NUMERIC;
  }
  result->objective = w->objective;
  memcpy(result->term, w->term_value, (size_t)result->terms * sizeof *result->term);
  memcpy(result->row, w->row_value, (size_t)result->rows * sizeof *result->row);
  audit_violations(w->problem, result);
  return AMBULO_OK;
}

/* at a point whose gradients are there; what takes memory */
static ambulo_status audit_rows(ambulo__engine *e, const ambulo_options *options,
                                ambulo__pool *pool, ambulo_result *result) {
  int *active = ambulo__pool_ints(pool, (size_t)e->setup->inequalities);
  if (!active) return AMBULO_E_MEMORY;
  audit_first_order(e, options, active, result);
  if (ambulo__run_late(e->run)) return AMBULO_OK;
  return audit_rank(e, active, pool, result);
}

ambulo_status ambulo__audit(ambulo__engine *e, const ambulo_options *options,
                            ambulo_result *result) {
  if (ambulo__audit_values(e->workspace, result)) return AMBULO_OK; /* the fault tells */
  result->audit.dropped_equalities = e->setup->rows->dropped;
  result->audit.at_lower_bound = ambulo__engine_at_lower_bound(e);
  if (ambulo__run_late(e->run)) return AMBULO_OK;
  if (ambulo__evaluate_jacobian(e->workspace, result->x) || take_gradients(e)) {
    result->audit.fault = e->workspace->fault;
    return AMBULO_OK;
  }
  ambulo__pool pool; /* audits are many, their memory is not kept */
  ambulo__pool_init(&pool, &e->pool.allocator);
  ambulo_status status = audit_rows(e, options, &pool, result);
  ambulo__pool_clear(&pool);
  return status;
}
