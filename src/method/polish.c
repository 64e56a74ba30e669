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
#include "method/polish.h"
#include "method/engine_point.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/retraction.h"

#include <string.h>

ambulo_status ambulo__polish_create(ambulo__engine *e) {
  ambulo__polish_scratch *s = ambulo__pool_blocks(&e->pool, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  e->polishing = s;
  s->x = ambulo__pool_doubles(&e->pool, (size_t)e->setup->n);
  return s->x ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* one step from the iterate, whose excesses are in the model, to x; 0 on success */
static int step(ambulo__engine *e, double *x) {
  ambulo__linearized *at = &e->linearized;
  ambulo__quadratic *q = e->quadratic;
  double decrease;
  if (ambulo__sparse_rows_fill(&at->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&at->rows.inequality, e->workspace, 0))
    return 1;
  if (ambulo__engine_fill_metric(e, e->iterate.mu)) return 1;
  memset(q->gradient, 0, (size_t)e->setup->n * sizeof *q->gradient);
  ambulo__sparse_rows_add_transpose(&at->rows.inequality, -1.0, e->iterate.lambda, q->gradient);
  if (ambulo__model_minimize(e, AMBULO__POLISH_PENALTY, 0, &decrease)) return 1;
  for (int j = 0; j < e->setup->n; j++) x[j] = e->iterate.x[j] + q->total[j];
  return !ambulo__retract(e, x);
}

int ambulo__polish(ambulo__engine *e, double *x) {
  const ambulo__setup *s = e->setup;
  ambulo__iterate *iterate = &e->iterate;
  double *moved = e->polishing->x, begin = ambulo__seconds_now();
  double target = e->run->options->feasibility_tolerance;
  size_t bytes = (size_t)s->n * sizeof *x;
  int done = 0;
  memcpy(moved, x, bytes);
  memcpy(iterate->lambda, e->reached.multiplier, (size_t)s->inequalities * sizeof *iterate->lambda);
  for (int k = 0; k < AMBULO__POLISH_STEPS && !done; k++) {
    memcpy(iterate->x, moved, bytes);
    if (ambulo__evaluate_jacobian(e->workspace, iterate->x)) break;
    double worst = ambulo__engine_excess(e, e->quadratic->linear);
    done = worst <= target;
    if (!done && step(e, moved)) break;
  }
  memcpy(iterate->equality_multiplier, e->reached.equality_multiplier,
         (size_t)s->equalities * sizeof *iterate->equality_multiplier);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  if (done) memcpy(x, iterate->x, bytes);
  return done;
}
