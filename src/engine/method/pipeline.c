/* method/pipeline.c - the method on one grid: carries x to the equalities, then has NLopt's AUGLAG
 * minimize on them (auglag.c), by rows as balance.h divides them.
 *
 *     mu = mu_0 T/K, rho = 10, lambda = 0; rho = 3000 where the start nearly satisfies the rows: a
 *     weaker penalty would let go of them, and the solve would wander off into another valley.
 *     lambda of a coarser grid (carry.c), rho = 160 and a quarter of mu where that grid had
 *     resolved the motion
 *
 * Equalities hold all along: every point is a retracted one.
 *
 * Reading order: engine.h, rows_split.h, metric.h, engine_point.h, pipeline.c, restore.c,
 * balance.h, auglag.c, chart.h, mirror.h, model_step.c, augmented.c, retraction.c, stopping.h,
 * polish.c; refine.c and carry.h around it. Besides: direct.h,
 * smooth.h.
 */
#include "method/pipeline.h"
#include "method/auglag.h"
#include "method/balance.h"
#include "method/parameters.h"
#include "method/restore.h"

#include <math.h>
#include <string.h>

/* The multipliers of a coarser grid are kept where that grid had resolved the motion: its objective
 * is about the one of its solution here. */
static void begin_multipliers(ambulo__engine *e, ambulo__stage stage) {
  double objective = fabs(e->workspace->objective);
  int carried = e->iterate.carried_objective >= 0.0 &&
                objective <= AMBULO__CARRIED_OBJECTIVE * e->iterate.carried_objective;
  e->iterate.rho = stage == AMBULO__NEAR ? AMBULO__PENALTY_LIMIT : AMBULO__PENALTY_START;
  if (carried) {
    e->iterate.rho = AMBULO__PENALTY_CARRIED;
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
  ambulo__balance_rows(e, x);
  return ambulo__auglag(e, stopping, x, ending);
}

ambulo_status ambulo__pipeline(ambulo__engine *e, ambulo__stage stage, double *x) {
  const ambulo_problem *p = e->setup->problem;
  double interval = p->definition.duration / (double)ambulo__basis_intervals(p->basis);
  ambulo__stopping stopping = ambulo__stopping_begin(stage == AMBULO__COARSE);
  ambulo_ending ending = AMBULO_ENDING_NONE;
  e->iterate.mu = AMBULO__DAMPING_START * interval;
  e->reached.value = HUGE_VAL;
  ambulo_status status = solve(e, stage, &stopping, x, &ending);
  int cut = e->run->stopped || ending == AMBULO_ENDING_ITERATIONS || ending == AMBULO_ENDING_NLOPT;
  if (!status && cut) ambulo__stopping_cut(&stopping, e, x);
  if (ending) ambulo__run_end(e->run, ending);
  return status;
}
