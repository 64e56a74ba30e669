/* method/polish.c - the last micrometres.
 *
 * An augmented Lagrangian approaches the inequalities linearly, and slowly where active rows
 * nearly depend on each other. Once the objective has settled and the excesses are small,
 * the nearest point of the linearized feasible set
 *
 *     minimize d' H0 d / 2   subject to   J_e d = 0, C d = 0, v + J d <= 0,
 *                                         = 0 where the multiplier is positive
 *
 * is a few Newton steps from a feasible point; the objective moves by multiplier * excess.
 * Solved by the model of model_step.c with a large penalty, the multipliers, and an
 * objective gradient - J' lambda that balances them: rows with a force then pull both ways.
 */
#include "method/engine.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

/* one step from engine->center into y; 0 on success */
static int step(ambulo__engine *e, double *y) {
  double decrease;
  if (ambulo__sparse_rows_fill(&e->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&e->rows.inequality, e->workspace, 0))
    return 1;
  if (ambulo__engine_fill_metric(e, e->mu)) return 1;
  memset(e->gradient, 0, (size_t)e->n * sizeof *e->gradient);
  ambulo__sparse_rows_add_transpose(&e->rows.inequality, -1.0, e->lambda, e->gradient);
  if (ambulo__model_minimize(e, 0, &decrease)) return 1;
  for (int j = 0; j < e->n; j++) y[j] = e->center[j] + e->total[j];
  return !ambulo__retract(e, y);
}

int ambulo__polish(ambulo__engine *e, double *x) {
  size_t bytes = (size_t)e->n * sizeof *x;
  double rho = e->rho, target = AMBULO__POLISH_SHARE * e->run->options->feasibility_tolerance;
  double begin = ambulo__seconds_now();
  int done = 0;
  memcpy(e->iterate, x, bytes);
  memcpy(e->lambda, e->reached.multiplier, (size_t)e->inequalities * sizeof *e->lambda);
  e->rho = AMBULO__POLISH_PENALTY;
  for (int k = 0; k < AMBULO__POLISH_STEPS && !done; k++) {
    memcpy(e->center, e->iterate, bytes);
    if (ambulo__evaluate_jacobian(e->workspace, e->center)) break;
    double worst = ambulo__engine_excess(e, e->linear);
    done = worst <= target ||
           (k == AMBULO__POLISH_STEPS - 1 && worst <= target / AMBULO__POLISH_SHARE);
    if (!done && step(e, e->iterate)) break;
  }
  e->rho = rho;
  memcpy(e->equality_multiplier, e->reached.equality_multiplier,
         (size_t)e->equalities * sizeof *e->equality_multiplier);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  if (done) memcpy(x, e->center, bytes);
  return done;
}
