/* ambulo/solve.h - solving a problem, and judging the answer.
 *
 * Three facts are kept apart: the ambulo_status of the call (was it legal, was there memory), the
 * ambulo_verdict (what the point is), and the ambulo_audit (how good it is). The verdict follows
 * from the audit alone. The solver's own return code is reported but not used.
 */
#ifndef AMBULO_SOLVE_H
#define AMBULO_SOLVE_H

#include "ambulo/evaluate.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Zero is no verdict, so a zero-filled value never reads as a solution. */
#define AMBULO_VERDICT_LIST(X)                                                                     \
  X(AMBULO_NOT_JUDGED, "not_judged", "no audit was made")                                          \
  X(AMBULO_OPTIMAL, "optimal", "feasible, and a first-order (KKT) point")                          \
  X(AMBULO_FEASIBLE, "feasible", "every row holds at the nodes; not shown to be optimal")          \
  X(AMBULO_INFEASIBLE, "infeasible", "some row is violated")                                       \
  X(AMBULO_NUMERIC_FAILURE, "numeric_failure",                                                     \
    "a value or a derivative is not finite, or no matrix could be factored")                       \
  X(AMBULO_LIMIT_REACHED, "limit", "stopped by a limit, not feasible")                             \
  X(AMBULO_INTERRUPTED, "interrupted", "stopped by the caller; the best point so far")             \
  X(AMBULO_NOT_CONVERGED, "not_converged",                                                         \
    "some row is violated, and nothing shows that it has to be")                                   \
  X(AMBULO_OPTIMAL_AT_NODES, "optimal_at_nodes",                                                   \
    "optimal at the nodes only; between them a row is off by more than 10 tolerances")             \
  X(AMBULO_FEASIBLE_AT_NODES, "feasible_at_nodes",                                                 \
    "feasible at the nodes only; between them a row is off by more than 10 tolerances")

typedef enum ambulo_verdict {
#define AMBULO_VERDICT_ENUM(id, name, text) id,
  AMBULO_VERDICT_LIST(AMBULO_VERDICT_ENUM)
#undef AMBULO_VERDICT_ENUM
} ambulo_verdict;

AMBULO_API const char *ambulo_verdict_name(ambulo_verdict verdict);
AMBULO_API const char *ambulo_verdict_text(ambulo_verdict verdict);

/* 1 for the verdicts of a motion that can be used: optimal and feasible. One that holds at the
 * nodes only is none. */
AMBULO_API int ambulo_verdict_is_solution(ambulo_verdict verdict);

/* Why a solve ended: which test was met, or which limit. It says nothing about the point. */
#define AMBULO_ENDING_LIST(X)                                                                      \
  X(AMBULO_ENDING_NONE, "none", "no solver ran")                                                   \
  X(AMBULO_ENDING_CONVERGED, "converged",                                                          \
    "the objective settled, the reduced gradient is small, the rows hold")                         \
  X(AMBULO_ENDING_SETTLED, "settled",                                                              \
    "the objective settled and the rows hold; no test of the gradient was met")                    \
  X(AMBULO_ENDING_VANISHED, "vanished", "the objective went to zero")                              \
  X(AMBULO_ENDING_STALLED, "stalled", "neither the violation nor the objective moved any more")    \
  X(AMBULO_ENDING_NO_DESCENT, "no_descent", "no trial point lowered the merit function")           \
  X(AMBULO_ENDING_NOT_RESTORED, "not_restored",                                                    \
    "no point was found that satisfies the equalities")                                            \
  X(AMBULO_ENDING_BREAKDOWN, "breakdown", "a factorization failed at every damping")               \
  X(AMBULO_ENDING_NOT_FINITE, "not_finite", "a value or a derivative is not finite")               \
  X(AMBULO_ENDING_NLOPT, "nlopt", "NLopt ended by a test of its own")                              \
  X(AMBULO_ENDING_ITERATIONS, "maximum_iterations", "the iteration limit was met")                 \
  X(AMBULO_ENDING_EVALUATIONS, "maximum_evaluations", "the evaluation limit was met")              \
  X(AMBULO_ENDING_TIME, "time_limit", "the time limit was met")                                    \
  X(AMBULO_ENDING_CALLER, "stopped", "stopped by the caller")                                      \
  X(AMBULO_ENDING_SOLVES, "maximum_solves", "the limit of inner solves was met")

typedef enum ambulo_ending {
#define AMBULO_ENDING_ENUM(id, name, text) id,
  AMBULO_ENDING_LIST(AMBULO_ENDING_ENUM)
#undef AMBULO_ENDING_ENUM
} ambulo_ending;

typedef enum ambulo_algorithm {
  AMBULO_AUTO = 0, /* NLopt's AUGLAG */
  AMBULO_SLSQP,    /* NLopt's SLSQP on every row, dense: small problems. Up to 4 GB */
  AMBULO_AUGLAG    /* NLopt's AUGLAG with inner L-BFGS */
} ambulo_algorithm;

/* Progress of a solve, given to the callback after every iteration, and at least every tenth of a
 * second in between, where the objective or the violation may be NAN: nothing to tell. */
typedef struct ambulo_progress {
  int iteration, evaluations;
  double objective, violation; /* violation: worst over all rows, relative to their size */
  double seconds, time_limit;  /* since the start; AMBULO_OFF: no limit */
  double seconds_left;         /* estimate; AMBULO_OFF: unknown */
  const char *stage;           /* "set-up", "coarse grids", "solve", "audit", "explanation" */
  int solve;                   /* with free parameters: which inner solve this is, from 1 on */
  double best;                 /* ... their least F so far; NAN before there is one */
  /* What is solved, the caller's problem or one on another grid or of other numbers, and the point
   * where that stands [variable_count]; both are there during the call. */
  const ambulo_problem *problem;
  const double *point;
} ambulo_progress;

#define AMBULO_MOST_STARTS 100

typedef struct ambulo_multipliers ambulo_multipliers; /* ambulo/again.h */

typedef struct ambulo_options {
  size_t size; /* set by ambulo_options_default() */
  ambulo_algorithm algorithm;
  int maximum_evaluations; /* of the objective and the rows; 20000 */
  int maximum_iterations;  /* inner solves of AUGLAG a grid, calls of NLopt otherwise; 150 */
  double time_limit; /* s of wall time, from set-up to explanation; AMBULO_OFF: none. The audit of
                        the last point may add a tenth of it */
  double maximum_memory;        /* bytes that a solve may be predicted to take; AMBULO_OFF: what is
                                   free */
  double feasibility_tolerance; /* worst violation that counts as feasible, relative to the size of
                                   its row (ambulo_violation.size), 1e-14 to 1; 1e-6 */
  double optimality_tolerance;  /* relative KKT residual that counts as optimal, 1e-14 to 1; 1e-3 */
  int continuation;             /* 1: solve on coarser grids first where that helps */
  int dense_samples;            /* the audit's second grid: nodes per interval; 10 */
  int refine; /* 1: what a problem file asks of ambulo_solve_refined (parameters.h), by `grid:
                 auto`, and `ambulo solve --refine`; without effect in ambulo_solve */
  int starts; /* 1: the solver's own; more, up to AMBULO_MOST_STARTS: so many on a grid half as
                 fine, the same in every run; the solve continues from the best and from its own
                 start, and returns the better result (ambulo_result_starts); without effect where
                 the caller gives a start */
  /* Non-zero return: stop and keep the best point. NULL: none. */
  int (*progress)(void *user, const ambulo_progress *progress);
  void *user;
  const ambulo_multipliers *multipliers; /* of the solution that the start is; NULL: none */
} ambulo_options;

AMBULO_PROBLEM_DEFAULT(ambulo_options);
/* The defaults, changed by what the problem file says under `solver:`. */
AMBULO_API void ambulo_problem_options_fill(const ambulo_problem *problem, ambulo_options *filled,
                                            size_t size);
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_options ambulo_problem_options(const ambulo_problem *problem) {
  ambulo_options usual;
  ambulo_problem_options_fill(problem, &usual, sizeof usual);
  return usual;
}
#endif

/* Violation of one family of rows. It is judged relative to the size of the row, so that one
 * tolerance fits every unit:
 *
 *     lengths 1 m, angles 1 rad
 *     forces the body weight m g, torques m g times 1 m
 *     rates 10 m/s and rad/s, accelerations 100 m/s^2 and rad/s^2
 *     anything else 1 of its unit, as rows of the caller may have it
 *
 * With the default tolerance of 1e-6 a foot may stand a micrometre off its place, and a person of
 * 75 kg may pass a torque limit by .0007 N m. */
typedef struct ambulo_violation {
  const char *family, *subject, *detail, *unit;
  double time, worst; /* worst >= 0, in unit */
  double size;        /* in unit; worst / size is what is compared with the tolerance */
} ambulo_violation;

typedef struct ambulo_audit {
  ambulo_violation violation; /* worst of all, at the nodes */
  ambulo_violation
      dense_violation;    /* worst of all between the nodes, relative to its tolerance; family "":
                             there is none, or (worst NaN) nothing is known (ambulo_dense_audit) */
  double kkt;             /* |projected gradient| / |gradient|, infinity norms, 0 where the gradient
                             is zero; infinite: unknown */
  double complementarity; /* largest |multiplier * row| / max(1, |J|) */
  int active_rows, rank;  /* of rows active at the point; -1: a limit left no time for it */
  int dropped_equalities; /* dependent on the others */
  int at_lower_bound;     /* 1: no term of the objective can be negative, none follows a reference,
                             and each is at most optimality_tolerance times its value with all
                             unknowns zero: no point is better by more, whatever kkt says */
  ambulo_fault fault;     /* kind AMBULO_FAULT_NONE: every value and derivative is finite */
} ambulo_audit;

typedef struct ambulo_timing {
  double total, evaluate, linear_algebra, nlopt; /* s */
} ambulo_timing;

/* What NLopt did, on all grids together. */
typedef struct ambulo_nlopt_work {
  int calls; /* of nlopt_optimize */
  int outer; /* iterations of AUGLAG: completed inner solves, after each of which it updates its
                multipliers and its penalty */
  int inner; /* evaluations of objective and rows that it asked for */
  double seconds;          /* its own, without those */
  int result;              /* what the last call returned, an nlopt_result; 0: none was made */
  const char *result_name; /* "FORCED_STOP": Ambulo's own test ended it; "" without a call */
} ambulo_nlopt_work;

/* ------------------------------------------------------ between the nodes */

/* Rows are enforced at the time nodes. The dense audit looks at the same motion on a grid
 * options.dense_samples times as fine: at every row that such a grid would have (rows on the ends
 * are the same on every grid, rows of the caller are not asked), and at two quantities that no
 * row covers. Each has a tolerance:
 *
 *   slip                how far a loaded corner of a foot moves along the ground away from
 *                       where the nodes have it: from the straight line between its places at
 *                       the nodes around; before the first node of its loading and from the last
 *                       one until the contact ends, from its place there               0.001 m
 *   ground_force        how far the ground's normal force, in total and on each foot, is from the
 *                       straight line through its values at the nodes (which is how a table with
 *                       a line a node is drawn and integrated)                0.02 body weights
 *   ground_penetration, foot_strike, contact, clearance, zmp, free_moment, joint_limit,
 *   tracking_tube, collision, obstacle, reach           violation of rows in m         0.001 m
 *   contact, clearance, joint_limit, tracking_tube      of rows in rad               0.005 rad
 *   pressure            of rows in m, times the share of the load on the foot          0.001 m
 *   normal_force, friction                                                    0.02 body weights
 *   speed_limit, torque_limit                    0.02 of the larger of the coordinate's two
 *                       bounds; where both are zero of 1 rad/s, 1 m/s, the body weight, or the
 *                       body weight times 0.1 m
 *
 * A motion that fails here keeps its verdict: it is optimal, or feasible, at the nodes. */
typedef struct ambulo_dense_family {
  ambulo_violation violation; /* the worst, relative to its tolerance; not finite where the motion
                                 is not */
  double tolerance;           /* in violation.unit */
  int holds;                  /* 1: violation.worst <= tolerance */
  const char *settings;       /* what brings it under its tolerance, as arguments of `ambulo solve`:
                                 "--set time.intervals=163"; predicted, except that limits on control
                                 points hold for certain. "": nothing known does, or it holds */
  const char *advice; /* in words; "" where it holds, and for points that are no solutions */
} ambulo_dense_family;

/* Two bodies that overlap, whether rows keep them apart or not: capsules of the model that could
 * meet (ambulo_collision, automatic), boxes in hands, obstacles, and "ground". Looked for at the
 * nodes and between them, without smoothing. Those that overlap in the rest pose: by how much more.
 */
typedef struct ambulo_overlap {
  const char *one, *other;
  double depth; /* m, the deepest, more than 0.001 */
  double time;  /* s, when */
} ambulo_overlap;

typedef struct ambulo_dense_audit {
  int samples; /* of each interval; 0: there is no finer grid, see `reason` */
  const ambulo_dense_family *families;
  int family_count; /* worst first, relative to the tolerance */
  int failing;      /* how many do not hold */
  /* time.intervals and trajectory.intervals that are predicted to bring all families with these
   * `settings` under their tolerances at once; 0: none */
  int intervals, spline_intervals;
  const char *const *lines; /* one for each family that fails, when the verdict is optimal or
                               feasible: where it is worst, and what helps */
  int line_count;
  const char *summary; /* all of it in one sentence; "" when every family holds, or the point is no
                          solution at the nodes either */
  const char *reason;  /* why there is no finer grid; "" when there is one */
  const ambulo_overlap *overlaps;
  int overlap_count; /* the deepest first, at most 64 */
} ambulo_dense_audit;

/* ------------------------------------------------- why there is no solution */

/* A family of rows that cannot hold together with the others. */
typedef struct ambulo_conflict {
  ambulo_violation shared;     /* its worst row where every family gives way a little */
  int alone;                   /* 1: giving way alone it makes the rest feasible; 0: it does not;
                                  -1: not tried, time was up */
  ambulo_violation relaxation; /* alone = 1: by how much, at its worst row: a bound known to
                                  suffice, from a point found by descent */
  ambulo_violation others[3];  /* alone = 1: further rows of it, other subjects or details */
  int other_count;
} ambulo_conflict;

/* Joint, speed and torque limits that the least violated motion rests on. */
typedef struct ambulo_on_limit {
  const char *family, *subject, *detail, *unit;
  double bound;    /* the limit, in unit */
  double from, to; /* first and last time, s */
  int nodes;       /* how many nodes */
} ambulo_on_limit;

/* What stands in the way, found by bringing the sum of all squared violations to a local
 * minimum. Costs about as much time as the failed solve, within its time limit. */
typedef struct ambulo_explanation {
  int complete;       /* 0: cut short by the time limit or the caller */
  int feasible_point; /* 1: a point that satisfies every row was found on the way: the
                         problem has solutions, the solver missed them */
  const ambulo_violation *contradictory; /* equalities at odds with equalities before them */
  int contradictory_count;
  const ambulo_conflict *conflicts; /* worst first; relative to the size of each row */
  int conflict_count;
  const ambulo_on_limit *on_limits;
  int on_limit_count;
  const char *const *lines; /* all of it in words, the suggestion last */
  int line_count;
  const char *suggestion; /* "" when there is none */
  /* the suggestion as settings "path=value", for --set or ambulo_problem_load; none for problems
   * made from C, nor where no key says it */
  const char *const *settings;
  int setting_count;
  int confirmed; /* 1: the rows contradict each other: equalities do, or the sum of all squared
                    violations has a minimum that is clearly not zero (a row is off by more than
                    1e-3 of its size). Only then is a solved problem called infeasible */
} ambulo_explanation;

/* Memory in bytes, predicted from sizes; within a factor of two for walks: of the problem itself;
 * of one workspace; peak of a solve, with both of them. */
typedef struct ambulo_memory {
  double problem, evaluation, solve;
} ambulo_memory;
AMBULO_API ambulo_memory ambulo_problem_memory(const ambulo_problem *problem);

/* A point that a solve passed through. */
typedef struct ambulo_iteration {
  int iteration, evaluations; /* as ambulo_result_iterations and _evaluations counted them then */
  int intervals;              /* of the time grid that it was on */
  double objective;
  double violation; /* worst over all rows, relative to their sizes */
  double gradient;  /* norm of the reduced gradient in whitened coordinates, relative to the
                       objective: what the solver's own test looks at; NAN: not known */
  double seconds;   /* since the solve began */
} ambulo_iteration;

/* The way of a solve: a point for each inner solve of AUGLAG, or for each call of NLopt where it is
 * handed every row, grid by grid from the coarsest on; the last is that returned, as audited. Of a
 * long solve one in so many of each grid, and its last. But for `seconds` the same in every run. */
typedef struct ambulo_history {
  const ambulo_iteration *items;
  int count;        /* 0: no solver ran */
  int every;        /* 1: none is left out */
  double tolerance; /* the largest violation that counts as none: feasibility_tolerance */
} ambulo_history;

typedef struct ambulo_result ambulo_result;

/* Solves from `start` [variable_count] (NULL: at rest in the start pose, each coordinate at its
 * default_value, ambulo/model.h). `options` NULL: those of the problem's file, or the defaults.
 * `allocator` and `diagnostics` may be NULL. A result is returned whatever the verdict; free it
 * with ambulo_result_free, before the problem. Errors, without a result: E_ARGUMENT, E_PROBLEM (a
 * row is not finite at the start; diagnostics name it), E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solve(
    const ambulo_problem *problem, const ambulo_options *options, const double *start,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, ambulo_result **result);

/* Judges x [variable_count] as if the solver had returned it. Else as ambulo_solve. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_audit_point(
    const ambulo_problem *problem, const ambulo_options *options, const double *x,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, ambulo_result **result);

AMBULO_API void ambulo_result_free(ambulo_result *result); /* accepts NULL */

/* Pointers belong to the result. */
AMBULO_API ambulo_verdict ambulo_result_verdict(const ambulo_result *result);
AMBULO_API const double *ambulo_result_x(const ambulo_result *result); /* [variable_count] */
AMBULO_API double ambulo_result_objective(const ambulo_result *result);
AMBULO_API const double *
ambulo_result_terms(const ambulo_result *result); /* [term_count], weighted */
AMBULO_API const double *ambulo_result_rows(const ambulo_result *result);        /* [row_count] */
AMBULO_API const double *ambulo_result_multipliers(const ambulo_result *result); /* [row_count] */
AMBULO_API const ambulo_audit *ambulo_result_audit(const ambulo_result *result);
/* Of results of ambulo_solve and ambulo_audit_point; NULL where none was made. What fails, and what
 * helps, is also one warning among the diagnostics of those. */
AMBULO_API const ambulo_dense_audit *ambulo_result_dense_audit(const ambulo_result *result);
AMBULO_API int ambulo_result_family_count(const ambulo_result *result);
AMBULO_API const ambulo_violation *ambulo_result_family(const ambulo_result *result, int index);
AMBULO_API int ambulo_result_iterations(const ambulo_result *result);
AMBULO_API int ambulo_result_evaluations(const ambulo_result *result);
AMBULO_API const ambulo_timing *ambulo_result_timing(const ambulo_result *result);
AMBULO_API const ambulo_nlopt_work *ambulo_result_nlopt(const ambulo_result *result);
/* Of several starts that of the last solve, of free parameters that of the best one. */
AMBULO_API const ambulo_history *ambulo_result_history(const ambulo_result *result);
/* Valleys of the objective (within .1 % of it, and .05 rad or m) that several starts
 * (ambulo_options.starts) ended in. */
typedef struct ambulo_basin {
  double objective; /* on the coarse grid */
  int found, first; /* how many starts ended there; number of the first, 0 is the solver's own */
  double distance;  /* from the cheapest: root mean square over the control points, rad and m */
} ambulo_basin;
typedef struct ambulo_starts {
  int count, solved, intervals; /* starts tried; that hold every row; of the coarse grid */
  const ambulo_basin *basins;   /* [basin_count], the best first */
  int basin_count;
  int chosen; /* the start whose solve on the problem's own grid is the result: 0, or the first of
                 the best valley where that came to less */
} ambulo_starts;
/* NULL for one start that needed no second look. */
AMBULO_API const ambulo_starts *ambulo_result_starts(const ambulo_result *result);
/* A grid that ambulo_solve_refined solved. */
typedef struct ambulo_refined_grid {
  int intervals, spline_intervals; /* of time, of the trajectory */
  double objective;
  ambulo_verdict verdict;
  int holds; /* 1: between the nodes too */
  int kept;  /* 1: it was the best so far; the last such grid is that of the result */
} ambulo_refined_grid;
typedef struct ambulo_refinement {
  const ambulo_refined_grid *grids; /* [grid_count], in the order in which they were solved */
  int grid_count;
  double resolution; /* by what share of it the objective is estimated to fall on finer grids; < 0:
                        to rise; NAN: unknown */
} ambulo_refinement;
/* NULL: there was one grid. */
AMBULO_API const ambulo_refinement *ambulo_result_refinement(const ambulo_result *result);
/* Why the solver ended, in words, with the method and what it took; and as a code. */
AMBULO_API const char *ambulo_result_ending(const ambulo_result *result);
AMBULO_API ambulo_ending ambulo_result_ending_code(const ambulo_result *result);
/* Of an infeasible problem or one that met a limit; NULL for every other verdict and for
 * points that were only audited. */
AMBULO_API const ambulo_explanation *ambulo_result_explanation(const ambulo_result *result);

#ifdef __cplusplus
}
#endif
#endif
