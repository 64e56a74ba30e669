/* ambulo/again.h - solving again beside a solution.
 *
 * What was solved once need not be found again. A solution has two halves: its control points, and
 * the multipliers of its rows, which are the expensive one. A solve that begins with both takes a
 * few iterations where one from zero takes fifty: models/walk.yaml at 1.293 m/s from its solution
 * at 1.28 m/s, 9 for 74.
 */
#ifndef AMBULO_AGAIN_H
#define AMBULO_AGAIN_H

#include "ambulo/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Multipliers of a result of `problem`, for ambulo_options.multipliers of a solve that starts from
 * its control points. They are densities over time, kept by the names of the rows and their shares
 * of the duration; so they serve problems with other numbers, durations, grids and trajectories.
 * What has no row there is left out. They need neither problem nor result afterwards. E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_multipliers_of(const ambulo_problem *problem,
                                                                const ambulo_result *result,
                                                                const ambulo_allocator *allocator,
                                                                ambulo_multipliers **multipliers);
AMBULO_API void ambulo_multipliers_free(ambulo_multipliers *multipliers); /* accepts NULL */

/* -------------------------------------------------------- the solver object
 *
 * One problem solved again and again, as a controller does: the state that it starts from, the
 * places where feet stand and the motion that it follows change, and each time a few iterations
 * continue from where the last ones ended. The object keeps the problem, its factors, the motion
 * and the multipliers. Nothing is checked or built anew between two solves, unless parts of the
 * body come near each other; and there is no audit unless one is asked for.
 *
 *     create --> start --> [ set_end, set_foothold, set_reference, shift --> iterate ] ...
 *            --> result --> free
 *
 * An object belongs to one thread at a time. */
typedef struct ambulo_solver ambulo_solver;

/* Where a solver stands; filled by ambulo_solver_iterate, owned by the solver. */
typedef struct ambulo_solver_state {
  const double *x;        /* [variable_count] */
  double objective;       /* there */
  ambulo_violation worst; /* the row that is missed most, relative to its size; worst 0: none is */
  int feasible;           /* 1: every row holds to options.feasibility_tolerance */
  int converged;          /* 1: the solver's own tests ended it, not the budget */
  int iterations, evaluations;
  double seconds; /* of this call */
  ambulo_ending ending;
} ambulo_solver_state;

/* A solver of a copy of `problem`, whose model and functions must outlive it. It stands at rest in
 * the start pose. `options` NULL: those of the problem; their tolerances, algorithm (AMBULO_SLSQP
 * is refused), progress and limits of memory and evaluations count. Errors: E_ARGUMENT, E_PROBLEM,
 * E_LIMIT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_create(const ambulo_problem *problem,
                                                               const ambulo_options *options,
                                                               const ambulo_allocator *allocator,
                                                               ambulo_diagnostics *diagnostics,
                                                               ambulo_solver **solver);
AMBULO_API void ambulo_solver_free(ambulo_solver *solver); /* accepts NULL */

/* The next iterations begin at x [variable_count], with these multipliers (NULL: none). E_ARGUMENT,
 * E_PROBLEM: something is not finite there. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_solver_start(ambulo_solver *solver, const double *x, const ambulo_multipliers *multipliers);

/* Another value of a prescribed end (ambulo_end_value): the state that a controller has measured.
 * E_ARGUMENT: the problem prescribes none of that order there. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_set_end(ambulo_solver *solver,
                                                                int coordinate, int order,
                                                                int final, double value);
/* Another foothold of a contact (ambulo_problem_contact) and of all contacts of its stance: along
 * forward, along left (m), and the heading (rad). Heights and times stay. E_ARGUMENT: no such
 * contact, or ends that match; E_PROBLEM: out of reach of the legs, or rows would begin or end;
 * E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_set_foothold(ambulo_solver *solver,
                                                                     int contact,
                                                                     const double place[2],
                                                                     double heading);
/* Another reference of a term that follows one, of the shape that it has (ambulo_term:
 * [node_count][d], [node_count][mark_count][3] or [node_count][feet][3]). E_ARGUMENT: it follows
 * none. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_set_reference(ambulo_solver *solver,
                                                                      int term,
                                                                      const double *reference);
/* The motion and its multipliers as they are `time` s later: 0 <= time <= the duration. Behind what
 * was the end the body stays where it was. E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_shift(ambulo_solver *solver, double time);

/* At most so many inner solves (> 0), and so many seconds (AMBULO_OFF: any). A budget that is met
 * ends with what there is, without the Newton steps that bring rows to their tolerance elsewhere,
 * and `worst` says what is missing. The solver stands where the last inner solve ended, better or
 * not; where it was, if no point is finite. *state is valid until the next call of this function.
 * E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_iterate(ambulo_solver *solver,
                                                                int iterations, double seconds,
                                                                const ambulo_solver_state **state);

/* Its problem, with all that was set: for motions of x. It belongs to the solver. */
AMBULO_API const ambulo_problem *ambulo_solver_problem(const ambulo_solver *solver);

/* The point where the solver stands, judged as ambulo_audit_point does, with multipliers. The
 * result belongs to the caller; what it names, to the solver. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_solver_result(const ambulo_solver *solver,
                                                               ambulo_diagnostics *diagnostics,
                                                               ambulo_result **result);

#ifdef __cplusplus
}
#endif
#endif
