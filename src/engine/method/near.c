/* method/near.c - which rows between bodies a solve works with.
 *
 * A body has many pairs of parts that could meet, and few do. A pair that stays away from its bound
 * does not decide on the motion, but its rows cost, and rows that press for a moment lead a solve
 * elsewhere. So each engine has a working set:
 *
 *     at x_0         rows whose value is at most NEAR_ROWS are in it, the others are far
 *     begin at x     where a far row is below NEAR_SEEN, all within NEAR_ROWS join
 *     end at x       where a far row is broken, all within NEAR_ROWS join, and the solve goes on,
 *                    with the multipliers that it had; at most NEAR_ROUNDS times
 *
 * Rows do not leave the set of an engine, so this ends. The audit looks at every row.
 */
#include "method/pipeline.h"

#include "base/alloc.h"
#include "method/multipliers.h"
#include "method/parameters.h"
#include "problem/callbacks.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

/* Those within NEAR_ROWS at x join where one of the far rows is below `least`. Returns how many. */
static int look(ambulo_workspace *w, const double *x, double least) {
  const ambulo_problem *p = w->problem;
  int joined = 0, needed = 0;
  w->has_values = 0; /* those of far rows are older */
  if (ambulo__evaluate(w, x)) return 0;
  for (int r = 0; r < p->rows; r++) needed |= w->far[r] && w->row_value[r] < least;
  for (int r = 0; needed && r < p->rows; r++) {
    if (!w->far[r] || w->row_value[r] > AMBULO__NEAR_ROWS) continue;
    w->far[r] = 0;
    joined++;
  }
  return joined;
}

static int has_far_rows(const ambulo_workspace *w) {
  return memchr(w->far, 1, (size_t)w->problem->rows) != NULL;
}

/* the engine for the rows that are in the set now, with the multipliers it had */
static ambulo_status renew(ambulo__engine *e, const double *x, double *by_row) {
  double carried = e->iterate.carried_objective;
  ambulo__multipliers_keep(e, by_row);
  ambulo_status status = ambulo__engine_renew(e, x);
  if (status) return status;
  ambulo__multipliers_take(e, by_row);
  e->iterate.carried_objective = carried;
  return AMBULO_OK;
}

static ambulo_status solve_near(ambulo__engine *e, ambulo__stage stage, double *x) {
  e->workspace->leaves_far_out = 1;
  ambulo_status status = ambulo__pipeline_of_set(e, stage, x);
  e->workspace->leaves_far_out = 0;
  e->workspace->has_values = e->workspace->has_jacobian = 0;
  return status;
}

static ambulo_status solve_rounds(ambulo__engine *e, ambulo__stage stage, double *x,
                                  double *by_row) {
  ambulo_status status = AMBULO_OK;
  if (look(e->workspace, x, AMBULO__NEAR_SEEN) > 0) status = renew(e, x, by_row);
  for (int round = 0; !status; round++) {
    status = solve_near(e, stage, x);
    double missed = -e->run->options->feasibility_tolerance;
    if (status || stage == AMBULO__COARSE || round == AMBULO__NEAR_ROUNDS ||
        ambulo__run_over(e->run))
      break;
    if (look(e->workspace, x, missed) == 0) break;
    status = renew(e, x, by_row);
    e->iterate.carried_objective = fabs(e->workspace->objective); /* multipliers are kept */
  }
  return status;
}

ambulo_status ambulo__pipeline(ambulo__engine *e, ambulo__stage stage, double *x) {
  if (!has_far_rows(e->workspace)) return ambulo__pipeline_of_set(e, stage, x);
  ambulo_allocator a = e->pool.allocator;
  double *by_row = ambulo__alloc(&a, (size_t)e->setup->problem->rows, sizeof *by_row);
  ambulo_status status = by_row ? solve_rounds(e, stage, x, by_row) : AMBULO_E_MEMORY;
  ambulo__free(&a, by_row);
  return status;
}

ambulo_status ambulo__near_all(ambulo__engine *e, const double *x) {
  if (!has_far_rows(e->workspace)) return AMBULO_OK;
  memset(e->workspace->far, 0, (size_t)e->setup->problem->rows);
  return ambulo__engine_renew(e, x);
}
