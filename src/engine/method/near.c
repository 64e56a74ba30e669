/* method/near.c - which rows between bodies a solve looks at.
 *
 * A body has many pairs of parts that could meet, and meets few: a pair that stays away from its
 * bound all along does not decide on the motion, and its rows cost. So a solve has a working set:
 *
 *     x_0   rows whose value there is at most `wide` are in it, the others are far
 *     x     the end of the solve: far rows whose value is below `narrow` join, with all within
 *           `wide`, and where one of them is broken the solve goes on from x with the multipliers
 *           that it had; at most ROUNDS times
 *
 * Rows do not leave the set of an engine, so this ends. The audit looks at every row. Only rows of
 * collision take part: where a body stands in the way, the way that a solve finds past it depends
 * on the rows that it starts with.
 */
#include "method/pipeline.h"

#include "base/alloc.h"
#include "method/parameters.h"
#include "problem/callbacks.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

enum { ROUNDS = 4 };
static const double wide = 0.02;    /* m */
static const double narrow = 0.003; /* m */

static int may_be_far(const ambulo_problem *p, int row) {
  return p->table.rows[row].kind == AMBULO__KIND_COLLISION;
}

void ambulo__near_begin(ambulo_workspace *w, const double *x) {
  const ambulo_problem *p = w->problem;
  memset(w->far, 0, (size_t)p->rows);
  if (ambulo__evaluate(w, x)) return;
  for (int r = 0; r < p->rows; r++)
    w->far[r] = (unsigned char)(may_be_far(p, r) && w->row_value[r] > wide);
}

/* Every far row at x: those within `wide` join where one is below `least`. Returns how many. */
static int look(ambulo_workspace *w, const double *x, double least) {
  const ambulo_problem *p = w->problem;
  int joined = 0, needed = 0;
  w->has_values = 0; /* those of far rows are older */
  if (ambulo__evaluate(w, x)) return 0;
  for (int r = 0; r < p->rows; r++) needed |= w->far[r] && w->row_value[r] < least;
  for (int r = 0; needed && r < p->rows; r++) {
    if (!w->far[r] || w->row_value[r] > wide) continue;
    w->far[r] = 0;
    joined++;
  }
  return joined;
}

static int has_far_rows(const ambulo_workspace *w) {
  return memchr(w->far, 1, (size_t)w->problem->rows) != NULL;
}

/* the multipliers of an engine, by rows of the problem */
static void keep_multipliers(const ambulo__engine *e, double *by_row) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  memset(by_row, 0, (size_t)e->setup->problem->rows * sizeof *by_row);
  for (int i = 0; i < rows->count; i++)
    by_row[rows->row[i]] = -rows->scale[i] * e->iterate.lambda[i] / e->setup->objective_scale;
}

static void take_multipliers(ambulo__engine *e, const double *by_row) {
  const ambulo__sparse_rows *rows = &e->setup->rows->inequality;
  for (int i = 0; i < rows->count; i++)
    e->iterate.lambda[i] = by_row[rows->row[i]] * e->setup->objective_scale / -rows->scale[i];
}

/* the engine for the rows that are in the set now, with the multipliers it had */
static ambulo_status renew(ambulo__engine *e, const double *x, double *by_row) {
  double coarse = e->iterate.coarse_objective;
  keep_multipliers(e, by_row);
  ambulo_status status = ambulo__engine_renew(e, x);
  if (status) return status;
  take_multipliers(e, by_row);
  e->iterate.coarse_objective = coarse;
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
  if (look(e->workspace, x, narrow) > 0) status = renew(e, x, by_row);
  for (int round = 0; !status; round++) {
    status = solve_near(e, stage, x);
    double missed = -e->run->options->feasibility_tolerance;
    if (status || stage == AMBULO__COARSE || round == ROUNDS || ambulo__run_over(e->run)) break;
    if (look(e->workspace, x, missed) == 0) break;
    status = renew(e, x, by_row);
    e->iterate.coarse_objective = fabs(e->workspace->objective); /* multipliers are kept */
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
