/* problem/problem.h - pieces of problem construction. */
#ifndef AMBULO_PROBLEM_PROBLEM_H
#define AMBULO_PROBLEM_PROBLEM_H

#include "problem/definition.h"
#include "problem/nlp.h"

/* A problem of more rows is refused. */
enum { AMBULO__MOST_ROWS = 50000000 };

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
/* ambulo_problem_create of a definition that is known to be good, or that moves beyond the ranges
 * of members a little; its obstacles have names that outlive it. */
ambulo_status ambulo__problem_build(const ambulo_problem_definition *definition,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **problem);

/* ---------------------------------------------------------- memory (workspace.c) */

/* How much a problem takes, before it is taken; bytes, as doubles: absurd sizes do not overflow
 * them. Of a workspace of a problem whose grid and plan are there. */
double ambulo__workspace_bytes(const ambulo_problem *problem, int with_jacobians);
/* Of the rows that this definition can bring at the most, with the tables made of them. */
double ambulo__row_bytes(const ambulo_problem *problem, double rows);
double ambulo__rows_at_most(const ambulo_problem *problem);
/* E_LIMIT with the figures when a problem whose grid and plan are there would not fit. */
ambulo_status ambulo__check_memory(const ambulo_problem *problem, ambulo_diagnostics *diagnostics);

#endif
