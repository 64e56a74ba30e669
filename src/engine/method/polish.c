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
 * objective gradient - J' lambda that balances them: rows with a force then pull both ways. The
 * penalty is relative to what the metric opposes to each row: on fine grids rows on accelerations
 * are so much longer than rows on places that a common one either lets go of these or drowns the
 * metric in the rounding of its factor.
 */
#include "method/polish.h"
#include "method/engine_point.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/retraction.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__polish_create(ambulo__engine *e) {
  ambulo__polish_scratch *s = ambulo__pool_blocks(&e->pool, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  e->polishing = s;
  s->x = ambulo__pool_doubles(&e->pool, (size_t)e->setup->n);
  return s->x ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* Row i, its excess and multiplier with `factor` times the scale that they have in the solve. */
static void rescale(ambulo__engine *e, int i, double factor) {
  ambulo__sparse_rows *rows = &e->linearized.rows.inequality;
  double scale = -factor / e->setup->rows->size[i], change = scale / rows->scale[i];
  ambulo__sparse_rows_set_scale(rows, i, scale);
  e->quadratic->linear[i] *= change;
  e->iterate.lambda[i] /= change;
}

/* Rows of length 1 in the diagonal D of the metric, J D^-1 J' = 1: one penalty is then as good as
 * equality for all of them on every grid, and drowns the metric on none. */
static void normalize(ambulo__engine *e) {
  const ambulo__linearized *at = &e->linearized;
  for (int i = 0; i < e->setup->inequalities; i++) {
    double length = ambulo__band_row_length(&at->base, &at->rows.inequality, i);
    if (length > 0.0) rescale(e, i, 1.0 / length);
  }
}

/* one step from the iterate, whose excesses are in the model, to x; 0 on success */
static int step(ambulo__engine *e, double rho, double *x) {
  ambulo__linearized *at = &e->linearized;
  ambulo__quadratic *q = e->quadratic;
  double decrease;
  if (ambulo__sparse_rows_fill(&at->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&at->rows.inequality, e->workspace, 0))
    return 1;
  if (ambulo__engine_fill_metric(e, AMBULO__POLISH_DAMPING * e->iterate.mu)) return 1;
  memset(q->gradient, 0, (size_t)e->setup->n * sizeof *q->gradient);
  ambulo__sparse_rows_add_transpose(&at->rows.inequality, -1.0, e->iterate.lambda, q->gradient);
  normalize(e);
  int failed = ambulo__model_minimize(e, rho, 0, &decrease);
  for (int i = 0; i < e->setup->inequalities; i++) rescale(e, i, 1.0);
  if (failed) return 1;
  for (int j = 0; j < e->setup->n; j++) x[j] = e->iterate.x[j] + q->total[j];
  return !ambulo__retract(e, x);
}

/* whether the point in the workspace costs more than the rows' multipliers foretold */
static int costs_more(const ambulo__engine *e) {
  const ambulo__trial *from = &e->reached;
  double foretold = AMBULO__VALUE_CHANGE * fabs(from->objective);
  for (int i = 0; i < e->setup->inequalities; i++)
    foretold += AMBULO__POLISH_RISE * from->multiplier[i] * fabs(from->excess[i]);
  return e->setup->objective_scale * e->workspace->objective - from->objective > foretold;
}

int ambulo__polish(ambulo__engine *e, int anyhow, double *x) {
  const ambulo__setup *s = e->setup;
  ambulo__iterate *iterate = &e->iterate;
  double *moved = e->polishing->x, begin = ambulo__seconds_now();
  double target = e->run->options->feasibility_tolerance;
  size_t bytes = (size_t)s->n * sizeof *x;
  int done = 0;
  double rho = AMBULO__POLISH_PENALTY;
  memcpy(moved, x, bytes);
  for (int k = 0; k < AMBULO__POLISH_STEPS && !done; k++) {
    memcpy(iterate->x, moved, bytes);
    memcpy(iterate->lambda, e->reached.multiplier,
           (size_t)s->inequalities * sizeof *iterate->lambda);
    if (ambulo__evaluate_jacobian(e->workspace, iterate->x)) break;
    double worst = ambulo__engine_excess(e, e->quadratic->linear);
    done = worst <= target;
    if (done ? !anyhow && costs_more(e) : step(e, rho, moved)) {
      done = 0;
      break;
    }
    rho *= AMBULO__PENALTY_STEP;
  }
  memcpy(iterate->equality_multiplier, e->reached.equality_multiplier,
         (size_t)s->equalities * sizeof *iterate->equality_multiplier);
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  if (done) memcpy(x, iterate->x, bytes);
  return done;
}
