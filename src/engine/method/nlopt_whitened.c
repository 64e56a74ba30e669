/* method/nlopt_whitened.c - small problems: SLSQP (or AUGLAG) on independent rows in
 * whitened coordinates.
 *
 * Rounds of: metric at the point (model_step.c), NLopt from there in w. SLSQP's quadratic
 * model starts as the identity, which in w is the metric; a few rounds settle to rounding. AUGLAG
 * comes to points that are better and hold their rows nearly: where a round has none that holds
 * them, the next one starts from its last, carried onto the equalities.
 * run->ending says why they ended.
 */
#include "method/nlopt_direct.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/restore.h"

#include <math.h>
#include <string.h>

static ambulo_status prepare(ambulo__engine *e, ambulo__direct *d) {
  d->problem = e->setup->problem;
  d->workspace = e->workspace;
  d->run = e->run;
  d->whitener = &e->linearized.whitener;
  d->set[0] = &e->linearized.rows.equality;
  d->set[1] = &e->linearized.rows.border;
  d->set[2] = &e->linearized.rows.inequality;
  d->is_equality[0] = d->is_equality[1] = 1;
  d->sets = AMBULO__DIRECT_SETS;
  d->objective_scale = e->setup->objective_scale;
  return ambulo__direct_create(d, &e->pool);
}

/* one round from x; *ending when the objective has settled at a feasible point, or when the
 * violation has not fallen for `*idle` rounds */
static ambulo_status round_from(ambulo__engine *e, ambulo__direct *d, ambulo_algorithm algorithm,
                                const double *x, int *idle, ambulo_ending *ending) {
  double predicted, before = d->best_objective, violation = d->best_violation;
  memcpy(e->iterate.x, x, (size_t)e->setup->n * sizeof *x);
  int failed = ambulo__model_step(e, &predicted);
  if (failed) {
    *ending = failed == 2 ? AMBULO_ENDING_NOT_FINITE : AMBULO_ENDING_BREAKDOWN;
    return AMBULO_OK;
  }
  memcpy(d->start, x, (size_t)e->setup->n * sizeof *x);
  int most = algorithm == AMBULO_AUGLAG ? AMBULO__AUGLAG_ROUND : AMBULO__ROUND_EVALUATIONS;
  ambulo_status status = ambulo__direct_minimize(d, algorithm, most);
  if (status) return status;
  double change = fabs(d->best_objective - before);
  int feasible = d->best_violation <= e->run->options->feasibility_tolerance;
  e->run->iterations++;
  *idle = feasible || d->best_violation < AMBULO__VIOLATION_BETTER * violation ? 0 : *idle + 1;
  if (*idle == AMBULO__ROUNDS_IDLE) *ending = AMBULO_ENDING_STALLED;
  if (!(d->best_violation < HUGE_VAL)) *ending = AMBULO_ENDING_NO_DESCENT;
  if (feasible && before < HUGE_VAL && change <= AMBULO__ROUNDS_SETTLED * (fabs(before) + 1e-12))
    *ending = AMBULO_ENDING_SETTLED;
  (void)ambulo__run_iteration(e->run, d->problem->definition.intervals, d->best_objective,
                              d->best_violation, NAN);
  return AMBULO_OK;
}

/* the last point that NLopt was at, on the equalities: into x; 1 when there is none */
static int take_last(ambulo__engine *e, const ambulo__direct *d, double *x) {
  double error;
  memcpy(x, d->last_x, (size_t)e->setup->n * sizeof *x);
  return ambulo__restore(e, x, &error) || !(error <= AMBULO__RESTORED);
}

/* rounds from x until one of them, or the run, ends them */
static ambulo_status rounds(ambulo__engine *e, ambulo__direct *d, ambulo_algorithm algorithm,
                            int most, double *x) {
  ambulo_status status = AMBULO_OK;
  ambulo_ending ending = AMBULO_ENDING_NONE;
  int idle = 0, from_last = 0;
  const double *from = x;
  for (int k = 0; !status && !ending && !e->run->stopped; k++) {
    if (k == most) {
      ending = AMBULO_ENDING_ITERATIONS;
      break;
    }
    status = round_from(e, d, algorithm, from, &idle, &ending);
    from = d->best_x;
    from_last = ending == AMBULO_ENDING_SETTLED && algorithm == AMBULO_AUGLAG && !from_last;
    if (status || !from_last || take_last(e, d, x)) continue;
    ending = AMBULO_ENDING_NONE;
    from = x;
  }
  if (ending) ambulo__run_end(e->run, ending);
  return status;
}

ambulo_status ambulo__solve_whitened(ambulo__engine *e, ambulo_algorithm algorithm, int most,
                                     ambulo_diagnostics *diagnostics, double *x,
                                     const char **message) {
  ambulo__direct d = {.message = "not called"};
  double error;
  e->iterate.mu = AMBULO__DAMPING_START * e->setup->problem->definition.duration /
                  (double)ambulo__basis_intervals(e->setup->problem->basis);
  e->iterate.rho = AMBULO__PENALTY_START;
  ambulo_status status = ambulo__restore(e, x, &error);
  if (!status) status = prepare(e, &d);
  if (!status) status = rounds(e, &d, algorithm, most, x);
  if (status == AMBULO_E_LIMIT)
    (void)ambulo__error(diagnostics, status, ambulo__nowhere, "use solver.algorithm: auto",
                        "%d unknowns and %d rows need more memory than 4 GB in dense form",
                        e->setup->n, e->setup->problem->rows);
  if (!status && d.best_violation < HUGE_VAL) memcpy(x, d.best_x, (size_t)e->setup->n * sizeof *x);
  *message = d.message;
  return status;
}
