/* solver/free_refined.c - finer grids until the objective no longer changes.
 *
 * Each grid has twice the intervals of the last one, of time and of the trajectory; more in time,
 * up to four times, where the dense audit predicts that the trajectory holds on more nodes. It is
 * solved from the motion found so far, which it contains exactly (knot insertion). The end is where
 * the motion holds between its nodes and one more grid changes the objective by less than `change`
 * of it, or ROUNDS grids further.
 *
 * A finer grid's result is kept unless it is in a worse valley. The coarser motion is one of the
 * finer grid too, and a candidate there if it holds between its nodes: what comes to more than that
 * is no better. Where the coarser motion holds at its nodes alone, the finer one replaces it.
 *
 * What is left. The objective J(h) of the optimal spline on intervals h tends to that of all
 * motions as J(h) = J + C h^p. With J_0, J_1, J_2 on h, h/2, h/4 (Richardson)
 *
 *     2^p = (J_0 - J_1) / (J_1 - J_2),   J_2 - J = (J_1 - J_2) / (2^p - 1).
 *
 * Of two grids p = 2 is taken, which the shipped problems have: limits and events, at which higher
 * derivatives jump, hold the order down. So is it where the three give no order between 1/2 and 4.
 * The resolution error is (J_2 - J) / |J_2|; negative where finer grids have more to hold.
 *
 * With free parameters their best values are found on the problem's own grid, and are fixed then.
 */
#include "ambulo/parameters.h"
#include "base/machine.h"
#include "ambulo/again.h"
#include "base/diagnostics.h"
#include "solver/result.h"
#include "problem/nlp.h"
#include "solver/session.h"

#include <math.h>

enum { ROUNDS = 4, MOST_GRIDS = ROUNDS + 1, MOST_STEP = 4 };
static const double change = 1e-2;      /* of the objective */
static const double same_valley = 1e-3; /* how far a finer solve may end above */

typedef struct ambulo__refinement {
  ambulo_refinement shown;
  ambulo_refined_grid grid[MOST_GRIDS];
} ambulo__refinement;

typedef struct refinement {
  const ambulo_problem *first;
  ambulo_options options;
  const ambulo_allocator *allocator;
  double began;
  ambulo_problem *problem; /* NULL: the first */
  ambulo__refinement *grids;
  ambulo_result *result;
  ambulo_diagnostics *messages;
} refinement;

static const ambulo_problem *current(const refinement *r) {
  return r->problem ? r->problem : r->first;
}

static int holds(const ambulo_result *result) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  return ambulo_verdict_is_solution(result->verdict) && dense && dense->samples > 0 &&
         dense->failing == 0;
}

static int is_solved(const ambulo_result *result) {
  return ambulo_verdict_is_solution(ambulo__verdict_at_nodes(result->verdict));
}

/* twice as many; or in the ratio to the trajectory's that the dense audit predicts to hold */
static int next_intervals(const refinement *r) {
  const ambulo_problem *p = current(r);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(r->result);
  int nodes = p->definition.intervals, same = 0;
  if (dense) same = dense->spline_intervals == ambulo__basis_intervals(p->basis);
  int enough = same && dense->intervals > nodes ? 2 * dense->intervals : 2 * nodes;
  return enough < MOST_STEP * nodes ? enough : MOST_STEP * nodes;
}

/* ------------------------------------------------------------- what is left */

double ambulo__resolution_error(const double *objective, int count) {
  if (count < 2) return (double)NAN;
  double last = objective[count - 2] - objective[count - 1], ratio = 4.0;
  if (count > 2) {
    double before = objective[count - 3] - objective[count - 2];
    if (before * last > 0.0 && before / last >= sqrt(2.0) && before / last <= 16.0)
      ratio = before / last;
  }
  double size = fabs(objective[count - 1]);
  return size > 0.0 ? last / (ratio - 1.0) / size : 0.0;
}

static void add_grid(refinement *r, const ambulo_problem *p, const ambulo_result *result,
                     int kept) {
  ambulo_refinement *shown = &r->grids->shown;
  if (shown->grid_count == MOST_GRIDS) return;
  r->grids->grid[shown->grid_count++] =
      (ambulo_refined_grid){.intervals = p->definition.intervals,
                            .spline_intervals = ambulo__basis_intervals(p->basis),
                            .objective = result->objective,
                            .verdict = result->verdict,
                            .holds = holds(result),
                            .kept = kept};
}

static void estimate(refinement *r) {
  double objective[MOST_GRIDS];
  int count = 0;
  for (int g = 0; g < r->grids->shown.grid_count; g++)
    if (r->grids->grid[g].kept) objective[count++] = r->grids->grid[g].objective;
  r->grids->shown.resolution = ambulo__resolution_error(objective, count);
}

const ambulo_refinement *ambulo_result_refinement(const ambulo_result *result) {
  return result->refinement ? &result->refinement->shown : NULL;
}

/* ------------------------------------------------------------------ one grid */

/* the finer grid's result is to replace the one so far */
static int is_better(const ambulo_result *now, const ambulo_result *finer) {
  if (!is_solved(finer)) return 0;
  if (!holds(now)) return 1;
  return holds(finer) && finer->objective <= now->objective + same_valley * fabs(now->objective);
}

static int has_settled(const ambulo_result *now, const ambulo_result *finer) {
  return holds(finer) && fabs(finer->objective - now->objective) <= change * fabs(finer->objective);
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

static void replace(refinement *r, ambulo_problem *finer, ambulo_result *result,
                    ambulo_diagnostics *messages) {
  ambulo_problem *coarser = r->problem;
  finer->keys = r->first->keys;
  ambulo_result_free(r->result);
  ambulo_diagnostics_free(r->messages);
  r->result = result;
  r->messages = messages;
  r->problem = finer;
  ambulo_problem_free(coarser);
}

/* one grid further; *done: it is the last */
static ambulo_status refine(refinement *r, int *done) {
  ambulo_allocator a = ambulo__allocator_or_default(r->allocator);
  int intervals = next_intervals(r);
  int spline = 2 * ambulo__basis_intervals(current(r)->basis);
  ambulo_problem *finer = NULL;
  ambulo_result *result = NULL;
  ambulo_diagnostics *messages = NULL;
  ambulo_status status =
      ambulo__problem_with_grid(current(r), intervals, spline, r->allocator, &finer);
  double *x = status ? NULL : ambulo__alloc(&a, (size_t)finer->variables, sizeof *x);
  if (!status && !x) status = AMBULO_E_MEMORY;
  if (!status) status = ambulo_problem_transfer(current(r), r->result->x, finer, x);
  ambulo_multipliers *multipliers = NULL;
  if (!status) status = ambulo_multipliers_of(current(r), r->result, r->allocator, &multipliers);
  r->options.multipliers = multipliers;
  if (!status) status = solve(r, finer, x, &result, &messages);
  r->options.multipliers = NULL;
  ambulo_multipliers_free(multipliers);
  ambulo__free(&a, x);
  int better = !status && is_better(r->result, result);
  *done = !better || has_settled(r->result, result);
  if (!status) add_grid(r, finer, result, better);
  if (better) {
    replace(r, finer, result, messages);
    return AMBULO_OK;
  }
  ambulo_result_free(result);
  ambulo_problem_free(finer);
  ambulo_diagnostics_free(messages);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

static int was_stopped(const ambulo_result *result) {
  return result->ending_code == AMBULO_ENDING_CALLER || result->ending_code == AMBULO_ENDING_TIME;
}

/* from r->result, which the problem's own grid has */
static ambulo_status refine_all(refinement *r) {
  ambulo_allocator a = ambulo__allocator_or_default(r->allocator);
  r->grids = ambulo__alloc(&a, 1, sizeof *r->grids);
  if (!r->grids) return AMBULO_E_MEMORY;
  ambulo_status status = AMBULO_OK;
  r->grids->shown.grids = r->grids->grid;
  r->options.starts = 1;
  add_grid(r, r->first, r->result, 1);
  int done = !is_solved(r->result);
  for (int k = 0; k < ROUNDS && !done && !status && !was_stopped(r->result); k++)
    status = refine(r, &done);
  estimate(r);
  return status;
}

ambulo_status ambulo_solve_refined(const ambulo_problem *problem, const ambulo_options *options,
                                   const double *start, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_problem **finer,
                                   ambulo_result **result) {
  if (!problem || !finer || !result) return AMBULO_E_ARGUMENT;
  refinement r = {.first = problem, .allocator = allocator, .began = ambulo__seconds_now()};
  ambulo_parameters free = ambulo_problem_parameters(problem);
  ambulo_problem *best = NULL;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &r.options);
  if (status) return status;
  if (free.count > 0) {
    free.start = start;
    r.messages = ambulo_diagnostics_create(allocator);
    if (!r.messages) return AMBULO_E_MEMORY;
    status = ambulo_solve_parameters(problem, &free, &r.options, allocator, r.messages, &best,
                                     &r.result);
    if (!status) r.first = best;
  } else {
    status = solve(&r, problem, start, &r.result, &r.messages);
  }
  struct ambulo__outcome *outcome = status ? NULL : r.result->outcome;
  if (!status) r.result->outcome = NULL;
  if (!status) status = refine_all(&r);
  ambulo__diagnostics_append(r.messages, diagnostics);
  ambulo_diagnostics_free(r.messages);
  if (status) {
    ambulo_allocator a = ambulo__allocator_or_default(allocator);
    ambulo__free(&a, outcome);
    ambulo__free(&a, r.grids);
    ambulo_result_free(r.result);
    ambulo_problem_free(r.problem);
    ambulo_problem_free(best);
    return status;
  }
  if (best && r.problem) { /* the finer problem takes the model over */
    r.problem->owned_model = best->owned_model;
    best->owned_model = NULL;
    r.problem->owned_muscles = best->owned_muscles;
    best->owned_muscles = NULL;
    ambulo_problem_free(best);
    best = NULL;
  }
  r.result->outcome = outcome;
  r.result->refinement = r.grids;
  r.result->timing.total = ambulo__seconds_now() - r.began;
  *finer = best ? best : r.problem;
  *result = r.result;
  return AMBULO_OK;
}
