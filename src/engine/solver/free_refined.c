/* solver/free_refined.c - finer grids until a motion holds between its nodes too.
 *
 * After a solve the dense audit predicts the grid that would bring every family under its
 * tolerance (solver/dense_cure.c); the problem on that grid is solved from the motion found, and so
 * on. What is predicted is on the safe side for grids nearby only: no grid more than doubles, and
 * none has more than MOST_FINER times the intervals of the first.
 */
#include "ambulo/parameters.h"
#include "base/machine.h"
#include "base/diagnostics.h"
#include "solver/result.h"
#include "problem/nlp.h"
#include "solver/session.h"

#include <math.h>

enum { ROUNDS = 6, MOST_FINER = 16 };

typedef struct refinement {
  const ambulo_problem *first;
  ambulo_options options;
  const ambulo_allocator *allocator;
  double began;
  ambulo_problem *problem; /* NULL: the first */
  ambulo_result *result;
  ambulo_diagnostics *messages;
} refinement;

static const ambulo_problem *current(const refinement *r) {
  return r->problem ? r->problem : r->first;
}

static int limited(int predicted, int now) {
  if (predicted <= now) return now;
  return predicted < 2 * now ? predicted : 2 * now;
}

/* the grid to solve next; 0: none, since this one holds, or nothing better is predicted */
static int next_grid(const refinement *r, int *intervals, int *spline) {
  const ambulo_problem *p = current(r);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r->result);
  if (!dense || !ambulo_verdict_is_solution(ambulo__verdict_at_nodes(r->result->verdict))) return 0;
  int nodes = p->definition.intervals, knots = ambulo__basis_intervals(p->basis);
  *intervals = limited(dense->intervals, nodes);
  *spline = limited(dense->spline_intervals, knots);
  if (*intervals == nodes && *spline == knots) return 0;
  return *intervals <= MOST_FINER * r->first->definition.intervals;
}

static ambulo_status solve(refinement *r, const ambulo_problem *problem, const double *start,
                           ambulo_result **result, ambulo_diagnostics **messages) {
  ambulo_options options = r->options;
  *messages = ambulo_diagnostics_create(r->allocator);
  if (!*messages) return AMBULO_E_MEMORY;
  if (options.time_limit > 0.0)
    options.time_limit = fmax(1e-3, options.time_limit - (ambulo__seconds_now() - r->began));
  return ambulo_solve(problem, &options, start, r->allocator, *messages, result);
}

/* one grid further; *done: there is none, or it is no better */
static ambulo_status refine(refinement *r, int *done) {
  ambulo_allocator a = ambulo__allocator_or_default(r->allocator);
  int intervals, spline;
  ambulo_problem *finer = NULL;
  ambulo_result *result = NULL;
  ambulo_diagnostics *messages = NULL;
  *done = !next_grid(r, &intervals, &spline);
  if (*done) return AMBULO_OK;
  ambulo_status status =
      ambulo__problem_with_grid(current(r), intervals, spline, r->allocator, &finer);
  double *x = status ? NULL : ambulo__alloc(&a, (size_t)finer->variables, sizeof *x);
  if (!status && !x) status = AMBULO_E_MEMORY;
  if (!status) status = ambulo_problem_transfer(current(r), r->result->x, finer, x);
  if (!status) status = solve(r, finer, x, &result, &messages);
  ambulo__free(&a, x);
  int better = !status && ambulo_verdict_is_solution(ambulo__verdict_at_nodes(result->verdict));
  *done = !better;
  if (better) {
    ambulo_problem *coarser = r->problem;
    finer->keys = r->first->keys;
    ambulo_result_free(r->result);
    ambulo_diagnostics_free(r->messages);
    r->result = result;
    r->messages = messages;
    r->problem = finer;
    ambulo_problem_free(coarser);
    return AMBULO_OK;
  }
  ambulo_result_free(result);
  ambulo_problem_free(finer);
  ambulo_diagnostics_free(messages);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

ambulo_status ambulo_solve_refined(const ambulo_problem *problem, const ambulo_options *options,
                                   const double *start, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_problem **finer,
                                   ambulo_result **result) {
  if (!problem || !finer || !result) return AMBULO_E_ARGUMENT;
  refinement r = {.first = problem, .allocator = allocator, .began = ambulo__seconds_now()};
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &r.options);
  if (status) return status;
  status = solve(&r, problem, start, &r.result, &r.messages);
  r.options.starts = 1;
  int done = status != AMBULO_OK;
  for (int k = 0; k < ROUNDS && !done && !status; k++) {
    int stopped = r.result->ending_code == AMBULO_ENDING_CALLER ||
                  r.result->ending_code == AMBULO_ENDING_TIME;
    if (stopped) break;
    status = refine(&r, &done);
  }
  ambulo__diagnostics_append(r.messages, diagnostics);
  ambulo_diagnostics_free(r.messages);
  if (status) {
    ambulo_result_free(r.result);
    ambulo_problem_free(r.problem);
    return status;
  }
  r.result->timing.total = ambulo__seconds_now() - r.began;
  *finer = r.problem;
  *result = r.result;
  return AMBULO_OK;
}
