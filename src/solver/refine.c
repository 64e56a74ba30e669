/* solver/refine.c - see refine.h.
 *
 * Local minima dominate gait problems; a coarse grid has fewer, and knot insertion carries
 * its solution over exactly. Grids go by halves while at least 24 intervals remain, then by
 * a third (72, 36, 12): the ratio that is divisible keeps coarse nodes among the fine ones.
 */
#include "nlp/problem.h"
#include "nlp/user_term.h"
#include "solver/refine.h"

#include <math.h>
#include <string.h>

enum { MAX_LEVELS = 16, FINEST_COARSE = 24, COARSEST = 8 };

/* intervals of the next coarser grid; 0: none */
static int coarser(int intervals) {
  if (intervals < FINEST_COARSE) return 0;
  if (intervals % 2 == 0 && intervals / 2 >= FINEST_COARSE) return intervals / 2;
  if (intervals % 3 == 0 && intervals / 3 >= COARSEST) return intervals / 3;
  return intervals / 2 >= COARSEST ? intervals / 2 : 0;
}

static int has_callbacks(const ambulo_problem *p) {
  for (int t = 0; t < p->definition.term_count; t++) {
    if (ambulo__is_user_term(&p->definition.terms[t])) return 1;
  }
  return p->definition.user_row_count > 0;
}

/* solves one level from the last one; *previous and *x_previous are replaced */
static ambulo_status solve_level(const ambulo_problem *problem, int intervals, int spline,
                                 const ambulo_allocator *a, ambulo__run *run,
                                 ambulo_problem **previous, double **x_previous) {
  ambulo_problem *level = NULL;
  ambulo__engine *engine = NULL;
  double *x = NULL;
  int warm = *previous != NULL;
  ambulo_status status = ambulo__problem_with_grid(problem, intervals, spline, a, &level);
  if (!status) {
    x = ambulo__alloc(a, (size_t)level->variables, sizeof *x);
    if (!x) status = AMBULO_E_MEMORY;
  }
  if (!status && warm) status = ambulo_problem_transfer(*previous, *x_previous, level, x);
  if (!status) status = ambulo__engine_create(level, x, a, run, NULL, &engine);
  if (status == AMBULO_E_LIMIT && run->stopped) status = AMBULO_OK; /* during set-up */
  if (!status && engine && engine->rows.regular)
    status = ambulo__pipeline(engine, AMBULO__COARSE, x);
  int useful = !status && engine && engine->rows.regular && engine->reached.value < HUGE_VAL;
  ambulo__engine_free(engine);
  if (useful) {
    ambulo_problem_free(*previous);
    ambulo__free(a, *x_previous);
    *previous = level;
    *x_previous = x;
    return AMBULO_OK;
  }
  ambulo_problem_free(level);
  ambulo__free(a, x);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

ambulo_status ambulo__refine(const ambulo_problem *p, const ambulo_allocator *allocator,
                             ambulo__run *run, double *x, int *levels) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  int grid[MAX_LEVELS], count = 0, nodes = p->definition.intervals;
  int spline = ambulo__basis_intervals(p->basis);
  ambulo_problem *previous = NULL;
  double *x_previous = NULL;
  *levels = 0;
  if (has_callbacks(p)) return AMBULO_OK;
  for (int n = coarser(nodes); n > 0 && count < MAX_LEVELS; n = coarser(n)) grid[count++] = n;
  ambulo_status status = AMBULO_OK;
  while (count-- > 0 && !status && !ambulo__run_over(run)) {
    int coarse_spline = (int)((long long)spline * grid[count] / nodes);
    if (coarse_spline < 1) continue;
    status = solve_level(p, grid[count], coarse_spline, &a, run, &previous, &x_previous);
  }
  if (!status && previous && ambulo_problem_transfer(previous, x_previous, p, x) == AMBULO_OK)
    *levels = 1;
  ambulo_problem_free(previous);
  ambulo__free(&a, x_previous);
  return status;
}
