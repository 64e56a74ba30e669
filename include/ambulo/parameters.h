/* ambulo/parameters.h - free parameters: numbers of a problem that the solver chooses; and
 * refinement of the grid.
 *
 * A number that a problem prescribes, such as a step time, a length, a slope or a limit, may be
 * left to the solver within bounds. Let f*(p) be the least objective of the problem at p. An outer
 * run of NLopt (SLSQP) finds the best p:
 *
 *     minimize F(p) = f*(p) / D(p)     subject to lower <= p <= upper
 *
 * D is the distance that the body travels (cost of transport), or 1. Each f* is one ambulo_solve,
 * started from the best solution so far. Its gradient needs no further solve: df*_dp are the
 * sensitivities at that solution (sensitivity.h). So any number with a sensitivity can be free.
 *
 *     dF/dp = (df*_dp - F dD/dp) / D
 *
 * The result is a local minimum of F within the bounds, in the valley that the start leads to.
 * Values of p without an optimal motion are rejected (until a first optimal motion is found: those
 * without a feasible one), and the run continues between them and the best.
 */
#ifndef AMBULO_PARAMETERS_H
#define AMBULO_PARAMETERS_H

#include "ambulo/sensitivity.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One free parameter: the name of its sensitivity ("gait.step_time"), and its bounds in the
 * sensitivity's unit (SI and rad). */
typedef struct ambulo_parameter {
  const char *name;
  double lower, upper; /* lower < upper; the problem's own value is in between */
} ambulo_parameter;
AMBULO_DEFAULT(ambulo_parameter); /* name and bounds must be set */

typedef enum ambulo_per {
  AMBULO_PER_DEFAULT = 0, /* distance where the body travels, else none */
  AMBULO_PER_DISTANCE,    /* of the definition's travel, m */
  AMBULO_PER_NONE         /* the objective itself */
} ambulo_per;

typedef struct ambulo_parameters {
  size_t size, parameter_size;   /* set by ambulo_parameters_default() */
  const ambulo_parameter *items; /* [count] */
  int count;
  ambulo_per per;
  int maximum_solves; /* inner solves; 60 */
  const double
      *start; /* [variable_count] where the first inner solve starts; NULL: as ambulo_solve */
  /* Makes the problem at values [count], with the same number of unknowns; called from the thread
   * of the run. Its model must outlive it. A failure other than E_MEMORY rejects the values. NULL:
   * the problem with those numbers changed, as in its file. */
  ambulo_status (*problem_at)(void *user, const double *values, const ambulo_allocator *allocator,
                              ambulo_diagnostics *diagnostics, ambulo_problem **problem);
  void *user;
} ambulo_parameters;

/* The default is none; _problem_parameters gives those under `free` in the problem's file. Strings
 * and items belong to the problem. count is 0 for files without `free` and for problems made in C.
 */
AMBULO_API void ambulo_problem_parameters_fill(const ambulo_problem *problem,
                                               ambulo_parameters *filled);
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_parameters ambulo_parameters_default(void) {
  ambulo_parameters usual;
  usual.size = sizeof usual;
  usual.parameter_size = sizeof(ambulo_parameter);
  ambulo_defaults("ambulo_parameters", &usual, sizeof usual);
  return usual;
}
static inline ambulo_parameters ambulo_problem_parameters(const ambulo_problem *problem) {
  ambulo_parameters usual = ambulo_parameters_default();
  ambulo_problem_parameters_fill(problem, &usual);
  return usual;
}
#endif
/* The problem with its free parameters fixed at values [count], SI and rad. It owns its model. Free
 * it with ambulo_problem_free. E_ARGUMENT: `problem` has no free parameters. Other errors: as
 * ambulo_problem_create. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_at(const ambulo_problem *problem,
                                                            const double *values,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics,
                                                            ambulo_problem **at);

/* Finds the best values. `parameters` NULL: those of the file. `options`, `allocator` and
 * `diagnostics` as for ambulo_solve. Limits of evaluations and iterations apply to each inner
 * solve; options.time_limit and options.progress to the whole run. A non-zero return of the
 * callback ends the run and keeps the best solution so far.
 *
 * *best is the problem at the best values and *result its solution, audited like any other. The
 * caller frees *result, then *best. If the first inner solve finds no solution, its result is
 * returned, with ambulo_parameters_outcome.solves 1.
 * Errors: those of ambulo_solve; E_ARGUMENT (an item has no sensitivity, or its value is outside
 * its bounds; diagnostics name it). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solve_parameters(
    const ambulo_problem *problem, const ambulo_parameters *parameters,
    const ambulo_options *options, const ambulo_allocator *allocator,
    ambulo_diagnostics *diagnostics, ambulo_problem **best, ambulo_result **result);

/* ambulo_solve, repeated on grids with twice the intervals, each started from the last motion,
 * until the motion also holds between the nodes (ambulo_dense_audit) and the objective changes by
 * less than 1 %, at most four times. *finer is the problem of *result, on the best grid; NULL if
 * that is the problem's own. The caller frees *result, then *finer, then `problem`, whose model
 * *finer shares. ambulo_result_refinement lists the grids. Where `problem` has free parameters,
 * those of its file are found on its own grid (ambulo_solve_parameters), and *finer is never NULL.
 * options.time_limit covers all solves. Errors: those of ambulo_solve. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solve_refined(
    const ambulo_problem *problem, const ambulo_options *options, const double *start,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, ambulo_problem **finer,
    ambulo_result **result);

typedef enum ambulo_bound {
  AMBULO_BOUND_NOT_SET = 0,
  AMBULO_AT_LOWER,
  AMBULO_BETWEEN,
  AMBULO_AT_UPPER
} ambulo_bound;

/* A free parameter after the run. */
typedef struct ambulo_parameter_value {
  const char *name, *label, *unit; /* "gait.step_time", "step time", "s" */
  double value, lower, upper;      /* in unit */
  double first;                    /* initial value */
  double derivative;               /* dF/dp; NaN if the first inner solve failed */
  ambulo_bound bound;
} ambulo_parameter_value;

typedef struct ambulo_parameters_outcome {
  const ambulo_parameter_value *items;
  int count;
  ambulo_per per;          /* never AMBULO_PER_DEFAULT */
  double distance;         /* D at the best values, m; 1 with AMBULO_PER_NONE */
  double objective, first; /* F at the best values, and at the initial ones */
  int solves;              /* inner solves */
  int failed;              /* inner solves whose values were rejected */
  int evaluations;         /* of all inner solves */
  int converged;           /* 1: dF/dp is small or points out of the bounds, or F settled */
  double seconds;
  const char *ending; /* in words: why the run ended */
} ambulo_parameters_outcome;

/* Belongs to the result. NULL for results of other functions than ambulo_solve_parameters. */
AMBULO_API const ambulo_parameters_outcome *ambulo_result_parameters(const ambulo_result *result);

#ifdef __cplusplus
}
#endif
#endif
