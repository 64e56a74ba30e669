/* problem/problem.h - pieces of problem construction. */
#ifndef AMBULO_PROBLEM_PROBLEM_H
#define AMBULO_PROBLEM_PROBLEM_H

#include "problem/nlp.h"

/* A problem of more rows is refused. */
enum { AMBULO__MOST_ROWS = 50000000 };

/* bodies.c: of a problem that was checked, the model with points on its capsules, and the pairs of
 * automatic collision as pairs that are listed. E_MEMORY, E_MODEL, E_LIMIT. */
ambulo_status ambulo__problem_add_bodies(ambulo_problem *problem, ambulo_diagnostics *diagnostics);
/* A copy of the obstacles with copies of their names in *names, both freed by the caller; those of
 * problems made from this one are the same. E_MEMORY. */
ambulo_status ambulo__obstacles_copy(const ambulo_problem_definition *definition,
                                     const ambulo_allocator *allocator, ambulo_obstacle **obstacles,
                                     char **names);

/* What ambulo_problem_definition_default() sets. */

/* definition_check.c: every check that needs no grid; all faults are reported. E_ARGUMENT for a
 * definition that did not come from ambulo_problem_definition_default(). */
ambulo_status ambulo__definition_check(const ambulo_problem_definition *definition,
                                       ambulo_diagnostics *diagnostics);
/* Deep copy: arrays, names, scales, references (the model stays shared). E_MEMORY leaves
 * a half copy that ambulo__definition_free accepts. */
ambulo_status ambulo__definition_copy(const ambulo_problem_definition *from,
                                      const ambulo_allocator *allocator,
                                      ambulo_problem_definition *to);
void ambulo__definition_free(const ambulo_allocator *allocator,
                             ambulo_problem_definition *definition);
/* A copy's pairs of capsules are these, which it frees, instead of those it had. */
void ambulo__definition_set_pairs(const ambulo_allocator *allocator,
                                  ambulo_problem_definition *definition, ambulo_capsule_pair *pairs,
                                  int count);
/* start_pose.c: unknowns x [variables] of a motion that rests in the model's start pose. */
void ambulo__start_pose(const ambulo_problem *problem, double *x);
/* The same problem on another grid: `intervals` time intervals and `spline_intervals`
 * intervals of the trajectory. Breakpoints of its own are kept only while their number
 * stays, and times of nodes of its own likewise: other numbers are distributed over the phases.
 * Tracked references are interpolated linearly. The model stays shared, so the
 * new problem must not outlive `problem`. */
ambulo_status ambulo__problem_with_grid(const ambulo_problem *problem, int intervals,
                                        int spline_intervals, const ambulo_allocator *allocator,
                                        ambulo_problem **out);
/* extend.c: `base` extended by what `like` has beyond its root, which takes `base` over, also on
 * failure; *extended is `base` itself where that is nothing. Errors: as ambulo_problem_extend. */
ambulo_status ambulo__extend_alike(const ambulo_problem *like, ambulo_problem *base,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_problem **extended);
/* ambulo_problem_create without the hash, a quarter of its time: for grids that nobody names. */
ambulo_status ambulo__problem_create_unnamed(const ambulo_problem_definition *definition,
                                             const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics,
                                             ambulo_problem **problem);
/* FNV-1a over rows, terms, grid and link parameters, the same on every machine with
 * the same byte order. */
unsigned long long ambulo__problem_hash_of(const ambulo_problem *problem);

#endif
