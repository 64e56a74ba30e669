/* method/pipeline.c - the method on one grid: carries x to the equalities, then has NLopt's AUGLAG
 * minimize on them (auglag.c), each row divided by what balances it; a rough start is smoothed.
 *
 *     mu = mu_0 T/K, rho = 10, lambda = 0; rho = 3000 where the start nearly satisfies the rows: a
 *     weaker penalty would let go of them, and the solve would wander off into another valley.
 *     lambda of a coarser grid (refine.c), rho = 160 and a quarter of mu where that grid had
 *     resolved the motion; lambda of a solution beside (multipliers.h), rho = 80 to
 *     640 by its distance
 *
 * Equalities hold all along: every point is a retracted one.
 *
 * Reading order: engine.h, row_roles.h, metric.h, point.h, pipeline.h, pipeline.c, equalities.c,
 * auglag.c, augmented.h, mirror.h, model_step.c, augmented.c, stopping.c; refine.c around it.
 * Besides: slsqp.c.
 */
#include "method/pipeline.h"

#include "base/arithmetic.h"
#include "method/equalities.h"
#include "method/parameters.h"
#include "method/point.h"

#include <math.h>
#include <string.h>

/* (P.13) R beside a solution: the farther it is, the weaker. d is by what share the objective has
 * changed on the way here. */
static double penalty_beside(const ambulo__engine *e, double objective) {
  double carried = e->iterate.carried_objective, d = fabs(objective - carried);
  double share = carried > 0.0 ? d / carried : HUGE_VAL;
  double factor = pow(AMBULO__BESIDE_FAR / share, 0.25);
  return AMBULO__PENALTY_BESIDE * fmax(1.0, fmin(AMBULO__BESIDE_MOST, factor));
}

/* The multipliers of a coarser grid are kept where that grid had resolved the motion: its objective
 * is about the one of its solution here. Those of a solution beside are kept. */
static void begin_multipliers(ambulo__engine *e, ambulo__stage stage) {
  double objective = fabs(e->workspace->objective);
  int carried = e->iterate.carried_objective >= 0.0 &&
                (stage == AMBULO__BESIDE ||
                 objective <= AMBULO__COARSE_OBJECTIVE * e->iterate.carried_objective);
  e->iterate.rho = stage == AMBULO__NEAR ? AMBULO__PENALTY_LIMIT : AMBULO__PENALTY_START;
  if (carried) {
    e->iterate.rho =
        stage == AMBULO__BESIDE ? penalty_beside(e, objective) : AMBULO__PENALTY_COARSE;
    e->iterate.mu /= AMBULO__DAMPING_CHANGE * AMBULO__DAMPING_CHANGE;
  } else {
    memset(e->iterate.lambda, 0, (size_t)e->setup->inequalities * sizeof *e->iterate.lambda);
  }
  e->iterate.carried_objective = -1.0;
  memset(e->iterate.equality_multiplier, 0,
         (size_t)e->setup->equalities * sizeof *e->iterate.equality_multiplier);
}

static ambulo_status solve(ambulo__engine *e, ambulo__stage stage, ambulo__stopping *stopping,
                           double *x, ambulo_ending *ending) {
  double error;
  ambulo_status status = ambulo__restore(e, x, &error);
  if (!status) status = ambulo__evaluate(e->workspace, x);
  if (status || !(error <= AMBULO__RESTORED)) {
    *ending = status == AMBULO_E_NUMERIC ? AMBULO_ENDING_NOT_FINITE : AMBULO_ENDING_NOT_RESTORED;
    return status;
  }
  begin_multipliers(e, stage);
  ambulo__balance_rows(e, stage, x);
  return ambulo__auglag(e, stopping, x, ending);
}

ambulo_status ambulo__pipeline_of_set(ambulo__engine *e, ambulo__stage stage, double *x) {
  const ambulo_problem *p = e->setup->problem;
  double interval = p->definition.duration / (double)ambulo__basis_intervals(p->basis);
  ambulo__stopping stopping = ambulo__stopping_begin(stage == AMBULO__COARSE);
  ambulo_ending ending = AMBULO_ENDING_NONE;
  e->iterate.mu = AMBULO__DAMPING_START * interval;
  e->reached.value = HUGE_VAL;
  ambulo_status status = solve(e, stage, &stopping, x, &ending);
  int cut = e->run->stopped || ending == AMBULO_ENDING_ITERATIONS || ending == AMBULO_ENDING_NLOPT;
  if (!status && cut && !e->run->unpolished) ambulo__stopping_cut(&stopping, e, x);
  if (ending) ambulo__run_end(e->run, ending);
  return status;
}

/* the gradients at hand, row i divided by `size` */
static void divide(ambulo__engine *e, int i, double size) {
  ambulo__row_roles *rows = &e->linearized.rows;
  e->iterate.lambda[i] *= size / rows->size[i];
  rows->size[i] = size;
  ambulo__sparse_rows_set_scale(&rows->inequality, i, -1.0 / size);
}

/* (P.15) v = -c / (s max(1, sqrt l)), near a solution -c / (s max(.3, sqrt l)) */
void ambulo__balance_rows(ambulo__engine *e, ambulo__stage stage, const double *x) {
  ambulo__row_roles *rows = &e->linearized.rows;
  int near = stage == AMBULO__NEAR || stage == AMBULO__BESIDE;
  if (ambulo__evaluate_jacobian(e->workspace, x) ||
      ambulo__sparse_rows_fill(&rows->inequality, e->workspace, 0) ||
      ambulo__engine_fill_metric(e, e->iterate.mu))
    return;
  for (int i = 0; i < e->setup->inequalities; i++) {
    divide(e, i, rows->unit[i]);
    double length = ambulo__band_row_length(&e->linearized.base, &rows->inequality, i);
    double shortest = near ? AMBULO__SHORT_ROW : 1.0;
    if (isfinite(length) && length > 0.0)
      divide(e, i, rows->unit[i] * fmax(shortest, sqrt(length)));
  }
}

/*
 * A start of the caller may be rough: noise on its control points, a straight line over the index
 * of the control points, a motion from another grid. A hundredth of a radian from one control
 * point to the next is tens of rad/s^2, and torques to match. With x_0 the start, the smoothed one
 * is
 *
 *     minimize  sum_j m |x_j - x_0j|^2 / s_j^2  +  sum_k w_k sum_i |qdd_ik|^2 / a^2
 *
 * m = T/K the time of a control point, w_k the quadrature: the likeliest motion when the start is
 * off by about s (2 cm, 0.02 rad; unknowns that are rates: s sqrt(a / s)) and accelerations are
 * about a = 30 rad/s^2, m/s^2 (those of a swinging leg). It is a low-pass filter without lag, whose
 * amplitude is halved at sqrt(a / s) = 39 rad/s = 6 Hz, where gait data are filtered (Winter 2009).
 *
 * A start that loses no more than half of its squared accelerations is not rough and stays.
 * Otherwise both are carried to the equalities (equalities.c), and the one with the lower objective
 * plus penalty on the inequalities is the start: an optimum is not smoothed away.
 */

/* integral of |qdd|^2 / a^2 at the point of the workspace */
static double bending(const ambulo__engine *e) {
  const ambulo_workspace *w = e->workspace;
  const ambulo_problem *p = e->setup->problem;
  double sum = 0.0;
  for (int k = 0; k < p->nodes; k++) {
    for (int i = 0; i < p->coordinates; i++) {
      int channel = ambulo__channel_qdd(&p->channels, i);
      double qdd =
          w->channel[ambulo__lane_index(k, w->channel_count, channel)] / AMBULO__ROUGH_ACCELERATION;
      sum += p->quadrature[k] * qdd * qdd;
    }
  }
  return sum;
}

/* m / s_j^2 */
static double weight_of(const ambulo_problem *p, int j) {
  double time = p->definition.duration / (double)ambulo__basis_intervals(p->basis);
  double rate = sqrt(AMBULO__ROUGH_DEVIATION * AMBULO__ROUGH_ACCELERATION);
  int is_value = 1;
  (void)ambulo__basis_abscissa(p->basis, j / p->coordinates, &is_value);
  double size = is_value ? AMBULO__ROUGH_DEVIATION : rate;
  return time / (size * size);
}

/* the matrix of the quadratic, factored; 1 when it cannot be */
static int assemble(const ambulo__engine *e, ambulo__band *filter) {
  const ambulo_problem *p = e->setup->problem;
  ambulo__metric_accelerations(&e->linearized.metric, e->workspace,
                               1.0 / (AMBULO__ROUGH_ACCELERATION * AMBULO__ROUGH_ACCELERATION),
                               filter);
  for (int j = 0; j < p->variables; j++)
    filter->a[(size_t)j * (size_t)filter->ld] += weight_of(p, j);
  return ambulo__band_factor(filter);
}

/* objective and penalty after x was carried to the equalities; HUGE_VAL when it could not be */
static double merit(ambulo__engine *e, double *x) {
  double error, sum = 0.0, *excess = e->measured.excess;
  if (ambulo__restore(e, x, &error) || ambulo__evaluate(e->workspace, x)) return HUGE_VAL;
  ambulo__engine_excess(e, excess);
  for (int i = 0; i < e->setup->inequalities; i++) {
    double v = ambulo__worse(0.0, excess[i]);
    sum += v * v;
  }
  double value =
      e->setup->objective_scale * e->workspace->objective + 0.5 * AMBULO__PENALTY_START * sum;
  return error <= AMBULO__RESTORED && isfinite(value) ? value : HUGE_VAL;
}

ambulo_status ambulo__smooth_curve(ambulo__engine *e, const double *x, double *smooth) {
  const ambulo_problem *p = e->setup->problem;
  ambulo__pool pool; /* of the start alone: the solve has the memory again */
  ambulo__band filter;
  ambulo__pool_init(&pool, &e->pool.allocator);
  ambulo_status status =
      ambulo__band_create(&pool, p->variables, ambulo__metric_diagonals(p), &filter);
  if (!status) status = ambulo__evaluate_jacobian(e->workspace, x);
  if (!status && assemble(e, &filter)) status = AMBULO_E_NUMERIC;
  if (!status) {
    for (int j = 0; j < p->variables; j++) smooth[j] = weight_of(p, j) * x[j];
    ambulo__band_forward(&filter, smooth);
    ambulo__band_backward(&filter, smooth);
  }
  ambulo__pool_clear(&pool);
  return status;
}

/* smooth, rough: [n] each, for points that are moved */
static ambulo_status choose(ambulo__engine *e, double *x, double *smooth, double *rough,
                            int *smoothed) {
  const ambulo_problem *p = e->setup->problem;
  size_t bytes = (size_t)p->variables * sizeof *x;
  ambulo_status status = ambulo__smooth_curve(e, x, smooth);
  if (status) return status == AMBULO_E_NUMERIC ? AMBULO_OK : status; /* a start like any other */
  double before = bending(e);
  if (ambulo__evaluate(e->workspace, smooth) || bending(e) > 0.5 * before) return AMBULO_OK;
  memcpy(rough, x, bytes);
  e->iterate.mu =
      AMBULO__DAMPING_START * (p->definition.duration / ambulo__basis_intervals(p->basis));
  double of_rough = merit(e, rough), of_smooth = merit(e, smooth);
  *smoothed = of_smooth < of_rough;
  if (*smoothed) memcpy(x, smooth, bytes);
  return AMBULO_OK;
}

/* (P.2b) the smoothest motion near x */
ambulo_status ambulo__smooth_start(ambulo__engine *e, double *x, int *smoothed) {
  size_t n = (size_t)e->setup->n;
  ambulo__pool pool;
  ambulo__pool_init(&pool, &e->pool.allocator);
  double *smooth = ambulo__pool_doubles(&pool, n), *rough = ambulo__pool_doubles(&pool, n);
  *smoothed = 0;
  ambulo_status status = pool.failed ? AMBULO_E_MEMORY : choose(e, x, smooth, rough, smoothed);
  ambulo__pool_clear(&pool);
  return status;
}
