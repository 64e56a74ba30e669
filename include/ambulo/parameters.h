/* ambulo/parameters.h - free parameters: numbers of a problem that the solver chooses; and the
 * grid, which it may refine.
 *
 * What a problem prescribes - a step time, lengths, a slope, a limit - may be left to the solver
 * within bounds. With f*(p) the least objective of the problem at p, the best p is found by an
 * outer run of NLopt (SLSQP),
 *
 *     minimize F(p) = f*(p) / D(p)     subject to lower <= p <= upper
 *
 * where D is the distance that the body travels (cost of transport) or 1. Each f* is one
 * ambulo_solve, started from the best solution so far; its gradient is exact and costs no further
 * solve: df*_dp are the sensitivities at that solution (sensitivity.h), so that every number that
 * has one can be free.
 *
 *     dF/dp = (df*_dp - F dD/dp) / D
 *
 * p is a local minimum of F within the bounds, in the valley of the motions that the start leads
 * to. Values of p at which the inner solve finds no optimal motion are rejected (while none was
 * found yet: no motion that holds), and the run goes on between them and the best.
 */
#ifndef AMBULO_PARAMETERS_H
#define AMBULO_PARAMETERS_H

#include "ambulo/sensitivity.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One free parameter: the name of its sensitivity ("gait.step_time"), and its bounds in the unit of
 * that: SI and rad. */
typedef struct ambulo_parameter {
  const char *name;
  double lower, upper; /* lower < upper; the problem's own value is in between */
} ambulo_parameter;
AMBULO_DEFAULT(ambulo_parameter); /* without a name or bounds, which have to be given */

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
  /* The problem at values [count], with unknowns as many as before; called from the thread of the
   * run. Its model must live as long as the problem; a failure other than E_MEMORY means that there
   * is no such problem, and the values are rejected. NULL: the problem with those numbers moved, as
   * its file would say it. */
  ambulo_status (*problem_at)(void *user, const double *values, const ambulo_allocator *allocator,
                              ambulo_diagnostics *diagnostics, ambulo_problem **problem);
  void *user;
} ambulo_parameters;

/* None. And what the problem's file says under `free`; strings and items belong to the problem,
 * count is 0 for files without, and for problems made from C. */
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
/* The problem with its free parameters at values [count], SI and rad; it owns its model, and
 * nothing of it is free. E_ARGUMENT: nothing is free in this one. Other errors: as
 * ambulo_problem_create. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_at(const ambulo_problem *problem,
                                                            const double *values,
                                                            const ambulo_allocator *allocator,
                                                            ambulo_diagnostics *diagnostics,
                                                            ambulo_problem **at);

/* Finds the best values. `parameters` NULL: those of the file. `options`, `allocator`,
 * `diagnostics` as for ambulo_solve; limits of evaluations and iterations are those of each inner
 * solve, options.time_limit and options.progress those of the whole run. The callback ends the run
 * by a non-zero return; the best solution so far is kept.
 *
 * *best is the problem at the best values, to be freed by the caller after *result, which is its
 * solution, judged like any other. Where the first inner solve finds no motion that holds (verdict
 * optimal or feasible) its result is returned with ambulo_parameters_outcome.solves 1.
 * Errors: those of ambulo_solve; E_ARGUMENT (an item has no sensitivity, bounds do not hold its
 * value, named in diagnostics). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solve_parameters(
    const ambulo_problem *problem, const ambulo_parameters *parameters,
    const ambulo_options *options, const ambulo_allocator *allocator,
    ambulo_diagnostics *diagnostics, ambulo_problem **best, ambulo_result **result);

/* ambulo_solve, and again on finer grids, each started from the last motion, until it holds between
 * the nodes too (ambulo_dense_audit), or nothing better is predicted. *finer is the problem on the
 * last grid, to be freed by the caller after *result and before `problem`, whose model it shares;
 * NULL where the problem's own grid was enough. options.time_limit is that of all of it. Errors:
 * those of ambulo_solve. */
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
  double first;                    /* where the run began */
  double derivative;               /* dF/dp; NaN where the first inner solve found nothing */
  ambulo_bound bound;
} ambulo_parameter_value;

typedef struct ambulo_parameters_outcome {
  const ambulo_parameter_value *items;
  int count;
  ambulo_per per;          /* never AMBULO_PER_DEFAULT */
  double distance;         /* D at the best values, m; 1 with AMBULO_PER_NONE */
  double objective, first; /* F at the best values, and where the run began */
  int solves;              /* inner solves */
  int failed;              /* of those: values that were rejected */
  int evaluations;         /* of all of them together */
  int converged;           /* 1: dF/dp is small, or points out of the bounds; or F settled */
  double seconds;
  const char *ending; /* in words: why the run ended */
} ambulo_parameters_outcome;

/* Of results of ambulo_solve_parameters, to which it belongs; NULL of others. */
AMBULO_API const ambulo_parameters_outcome *ambulo_result_parameters(const ambulo_result *result);

#ifdef __cplusplus
}
#endif
#endif
