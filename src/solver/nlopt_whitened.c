/* solver/nlopt_whitened.c - small problems: SLSQP (or AUGLAG) on independent rows in
 * whitened coordinates.
 *
 * Rounds of: metric at the point (model_step.c), NLopt from there in w. SLSQP's quadratic
 * model starts as the identity, which in w is the metric; a few rounds settle to rounding.
 */
#include "solver/nlopt_direct.h"

#include <math.h>
#include <string.h>

enum { MAX_ROUNDS = 8, ROUND_EVALUATIONS = 300 };
static const double mu_factor = 0.3; /* times T/K, as in pipeline.c */
static const double settled = 1e-8;  /* relative change of the objective */

static ambulo_status prepare(ambulo__engine *e, ambulo__direct *d) {
  d->problem = e->problem;
  d->workspace = e->workspace;
  d->run = e->run;
  d->whitener = &e->whitener;
  d->set[0] = &e->rows.equality;
  d->set[1] = &e->rows.border;
  d->set[2] = &e->rows.inequality;
  d->is_equality[0] = d->is_equality[1] = 1;
  d->sets = AMBULO__DIRECT_SETS;
  d->objective_scale = e->objective_scale;
  return ambulo__direct_create(d, &e->pool);
}

/* one round from x; *done when the objective has settled at a feasible point */
static ambulo_status round_from(ambulo__engine *e, ambulo__direct *d, ambulo_algorithm algorithm,
                                const double *x, int *done) {
  double predicted, before = d->best_objective;
  memcpy(e->center, x, (size_t)e->n * sizeof *x);
  if (ambulo__model_step(e, &predicted)) {
    *done = 1;
    return AMBULO_OK;
  }
  memcpy(d->center, x, (size_t)e->n * sizeof *x);
  ambulo_status status = ambulo__direct_minimize(d, algorithm, ROUND_EVALUATIONS);
  if (status) return status;
  double change = fabs(d->best_objective - before);
  int feasible = d->best_violation <= e->run->options->feasibility_tolerance;
  e->run->iterations++;
  *done = (feasible && change <= settled * (fabs(before) + 1e-12)) || e->run->stopped ||
          ambulo__run_progress(e->run, d->best_objective, d->best_violation);
  return AMBULO_OK;
}

ambulo_status ambulo__solve_whitened(ambulo__engine *e, ambulo_algorithm algorithm,
                                     ambulo_diagnostics *diagnostics, double *x,
                                     const char **message) {
  static const ambulo__place nowhere = {NULL, 0, 0, NULL};
  ambulo__direct d = {.message = "not called"};
  double error;
  int done = 0;
  e->mu = mu_factor * e->problem->definition.duration /
          (double)ambulo__basis_intervals(e->problem->basis);
  e->rho = 10.0;
  ambulo_status status = ambulo__restore(e, x, &error);
  if (!status) status = prepare(e, &d);
  for (int k = 0; k < MAX_ROUNDS && !status && !done; k++) {
    status = round_from(e, &d, algorithm, k == 0 ? x : d.best_x, &done);
    if (!(d.best_violation < HUGE_VAL)) break;
  }
  if (status == AMBULO_E_LIMIT)
    (void)ambulo__error(diagnostics, status, nowhere, "use solver.algorithm: auto",
                        "%d unknowns and %d rows need more memory than 4 GB in dense form", e->n,
                        e->problem->rows);
  if (!status && d.best_violation < HUGE_VAL) memcpy(x, d.best_x, (size_t)e->n * sizeof *x);
  *message = d.message;
  return status;
}
