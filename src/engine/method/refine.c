/* method/refine.c - see refine.h.
 *
 * Local minima dominate gait problems; a coarse grid has fewer, and knot insertion carries
 * its solution over exactly. Grids go by halves while at least 24 intervals remain, then by
 * a third (72, 36, 12): the ratio that is divisible keeps coarse nodes among the fine ones. The
 * trajectory becomes coarser with them, but keeps a knot interval for two of them where it has so
 * many: one that is too coarse for its contacts is led into other motions.
 * A grid that has no room for the rows is left early (pipeline.h). Its motion is a start, but its
 * multipliers have been driven up by what cannot be, and would drive the next grid's motion far
 * away: they are not saved.
 * Grids on events distribute their intervals over the phases anew; one that is too coarse for that
 * is refused and left out.
 */
#include "method/refine.h"

#include "contact/schedule.h"
#include "method/multipliers.h"
#include "method/parameters.h"
#include "method/pipeline.h"
#include "problem/callbacks.h"
#include "problem/nlp.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_LEVELS = 16 };

/* intervals of the next coarser grid; 0: none */
static int coarser(int intervals) {
  if (intervals < AMBULO__COARSE_INTERVALS) return 0;
  if (intervals % 2 == 0 && intervals / 2 >= AMBULO__COARSE_INTERVALS) return intervals / 2;
  if (intervals % 3 == 0 && intervals / 3 >= AMBULO__COARSEST_INTERVALS) return intervals / 3;
  return intervals / 2 >= AMBULO__COARSEST_INTERVALS ? intervals / 2 : 0;
}

static int has_callbacks(const ambulo_problem *p) {
  for (int t = 0; t < p->definition.term_count; t++) {
    if (ambulo__is_user_term(&p->definition.terms[t])) return 1;
  }
  return p->definition.user_row_count > 0;
}

/* knot intervals of a grid that is coarser than the one of `nodes` intervals with `spline` */
static int coarse_spline(int intervals, int nodes, int spline, int least) {
  int in_proportion = (int)((long long)spline * intervals / nodes);
  int enough = intervals / AMBULO__COARSE_NODES_A_KNOT;
  if (enough > spline) enough = spline;
  int chosen = in_proportion > enough ? in_proportion : enough;
  return chosen > least || chosen < 1 ? chosen : least;
}

/* a solved grid: its problem, solution and multipliers */
typedef struct level {
  ambulo_problem *problem; /* NULL: none yet */
  double *x;
  ambulo_multipliers *multipliers; /* NULL: none */
} level;

static void free_level(const ambulo_allocator *a, level *l) {
  ambulo_problem_free(l->problem);
  ambulo__free(a, l->x);
  ambulo_multipliers_free(l->multipliers);
  memset(l, 0, sizeof *l);
}

static ambulo_status create_level(const ambulo_problem *problem, int intervals, int spline,
                                  const ambulo_allocator *a, const level *before, level *l) {
  ambulo_status status = ambulo__problem_coarser(problem, intervals, spline, a, &l->problem);
  if (status) return status;
  l->x = ambulo__alloc(a, (size_t)l->problem->variables, sizeof *l->x);
  if (!l->x) return AMBULO_E_MEMORY;
  ambulo__start_pose(l->problem, l->x);
  return before->problem ? ambulo_problem_transfer(before->problem, before->x, l->problem, l->x)
                         : AMBULO_OK;
}

/* solves one level from the last one, which it replaces */
static ambulo_status solve_level(const ambulo_problem *problem, int intervals, int spline,
                                 const ambulo_allocator *a, ambulo__run *run, level *before) {
  level new = {0};
  ambulo__engine *engine = NULL;
  int useful = 0, resolved = 0;
  ambulo_status status = create_level(problem, intervals, spline, a, before, &new);
  if (!status) status = ambulo__engine_create(new.problem, new.x, a, run, NULL, &engine);
  if (status == AMBULO_E_LIMIT && run->stopped) status = AMBULO_OK; /* during set-up */
  if (!status && engine && engine->setup->rows->regular) {
    ambulo__multipliers_transfer(before->multipliers, engine);
    status = ambulo__pipeline(engine, AMBULO__COARSE, new.x);
    useful = !status && engine->reached.value < HUGE_VAL;
    resolved = engine->reached.violation <= AMBULO__ROUGH_VIOLATION;
  }
  if (useful && resolved) status = ambulo__multipliers_save(engine, a, &new.multipliers);
  ambulo__engine_free(engine);
  if (useful && !status) {
    free_level(a, before);
    *before = new;
    return AMBULO_OK;
  }
  free_level(a, &new);
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

ambulo_status ambulo__refine(ambulo__engine *e, const ambulo_allocator *allocator, double *x,
                             int *levels) {
  const ambulo_problem *p = e->setup->problem;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  int grid[MAX_LEVELS], count = 0, nodes = p->definition.intervals;
  int spline = ambulo__basis_intervals(p->basis);
  level last = {0};
  *levels = 0;
  if (has_callbacks(p)) return AMBULO_OK;
  int least = 1;
  ambulo_status status = ambulo__knots_least(&p->definition, &a, &least);
  for (int n = coarser(nodes); n > 0 && count < MAX_LEVELS; n = coarser(n)) grid[count++] = n;
  while (count-- > 0 && !status && !ambulo__run_over(e->run)) {
    int coarse = coarse_spline(grid[count], nodes, spline, least);
    if (coarse >= 1) status = solve_level(p, grid[count], coarse, &a, e->run, &last);
  }
  if (!status && last.problem && ambulo_problem_transfer(last.problem, last.x, p, x) == AMBULO_OK) {
    ambulo__multipliers_transfer(last.multipliers, e);
    *levels = 1;
  }
  free_level(&a, &last);
  return status;
}
