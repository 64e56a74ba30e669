/* ambulo/evaluate.h - a problem (problem.h) at one point x: objective, rows, their gradients, the
 * motion; and a check of the hand-derived gradients by differences.
 *
 * A problem is immutable; scratch memory is in a workspace. Several threads may share a problem,
 * each with a workspace of its own. */
#ifndef AMBULO_EVALUATE_H
#define AMBULO_EVALUATE_H

#include "ambulo/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Names a value or derivative that is not finite. Strings belong to the problem and the model. */
typedef enum ambulo_fault_kind {
  AMBULO_FAULT_NONE = 0,  /* everything was finite */
  AMBULO_FAULT_UNKNOWN,   /* a component of x itself */
  AMBULO_FAULT_TERM,      /* an objective term */
  AMBULO_FAULT_ROW,       /* a row */
  AMBULO_FAULT_MECHANICS, /* inverse dynamics: finite values, a derivative that is not */
  AMBULO_FAULT_SUM        /* finite parts whose sum is not finite */
} ambulo_fault_kind;
typedef struct ambulo_fault {
  ambulo_fault_kind kind;
  int derivative;               /* 0: the value; 1: its derivative by `by` of `of`; 2: second one */
  const char *name;             /* of the term, or family of the row; "" otherwise */
  const char *subject, *detail; /* of the row; "" otherwise */
  const char *by; /* "q", "qd", "qdd", "tau", "wrench", "points", "reaction", "unknown" */
  const char *of; /* coordinate, component, point or foot */
  int node;       /* -1: not tied to one node */
  double time;    /* s */
  double value;   /* NAN, INFINITY or -INFINITY */
} ambulo_fault;
/* In words: "the derivative of objective term 'effort' by tau of elbow at node 3 (t = 0.3 s) is
 * nan". Writes at most `size` bytes to buffer[size], including the terminating NUL. */
AMBULO_API void ambulo_fault_text(const ambulo_fault *fault, char *buffer, size_t size);

/* Scratch memory for evaluations of `problem`. `allocator` may be NULL. Free with
 * ambulo_workspace_free, before or after the problem. E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_workspace_create(const ambulo_problem *problem,
                                                                  const ambulo_allocator *allocator,
                                                                  ambulo_workspace **workspace);
AMBULO_API void ambulo_workspace_free(ambulo_workspace *workspace); /* accepts NULL */
/* The cause of the last E_NUMERIC returned with this workspace. Belongs to the workspace; valid
 * until its next call. */
AMBULO_API const ambulo_fault *ambulo_workspace_fault(const ambulo_workspace *workspace);

/* Objective, its weighted terms [term_count] and row values [row_count] at x [variable_count]; each
 * output may be NULL. Calls at the same x reuse what was computed. E_NUMERIC: a value is not finite
 * (ambulo_workspace_fault says which). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_evaluate(const ambulo_problem *problem,
                                                                  ambulo_workspace *workspace,
                                                                  const double *x,
                                                                  double *objective, double *terms,
                                                                  double *rows);

/* Gradient [variable_count] of objective_weight * J + sum_r row_weights[r] c_r by one reverse
 * sweep; row_weights [row_count] or NULL. E_NUMERIC: a value or a derivative is not finite; the
 * gradient is filled anyway. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_problem_gradient(const ambulo_problem *problem, ambulo_workspace *workspace, const double *x,
                        double objective_weight, const double *row_weights, double *gradient);

/* Gradient of one row, dense [variable_count]. E_NUMERIC as above. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_row_gradient(const ambulo_problem *problem,
                                                                      ambulo_workspace *workspace,
                                                                      const double *x, int row,
                                                                      double *gradient);

/* Where the motion at `count` times goes. Each output may be NULL. World axes, SI units:
 *
 *   q, qd, qdd, tau    [count][d], wrench [count][6], points [count][p][3]: as in mechanics.h. With
 *                      devices, tau is the person's share
 *   zmp                [count][3] on the ground plane, m; NaN where n . F <= 0
 *
 * With ground reaction, for each foot (without it, these are NaN):
 *
 *   grf                [count][feet][3] force on the foot, N
 *   cop                [count][feet][3] centre of pressure, m; NaN where the ground does not push
 *   free_moment        [count][feet] about the normal at the centre of pressure, N m; 0 without one
 *   grf_moment         [count][feet][3] whole moment about the world's origin, N m
 *   patch_...          the same four for each patch, [count][patches]...; zeros and a NaN centre
 *                      while it is not in contact
 *
 * For each device (ambulo/device.h) and each load in hands (ambulo/hold.h):
 *
 *   device_effort      [count][devices] N m or N
 *   device_along       [count][devices] coordinate or length, rad or m
 *   device_power       [count][devices] power on the body, W
 *   hold_force         [count][holds][2][3] exerted by each hand, N; 0 without the hand or the hold
 *   hold_moment        [count][holds][2][3] of each hand about its point, N m; likewise
 *   hold_power         [count][holds] power of the forces, W */
typedef struct ambulo_motion {
  size_t size; /* set by ambulo_motion_default() */
  double *q, *qd, *qdd, *tau, *wrench, *points, *zmp;
  double *grf, *cop, *free_moment, *grf_moment;
  double *patch_force, *patch_cop, *patch_free_moment, *patch_moment;
  double *device_effort, *device_along, *device_power;
  double *hold_force, *hold_moment, *hold_power;
} ambulo_motion;
AMBULO_DEFAULT(ambulo_motion); /* NULL */
/* Fills `motion` at times [count] in [0, T], count >= 1. E_ARGUMENT: a time outside [0, T].
 * E_NUMERIC: a value is not finite; the outputs are filled anyway. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_motion(const ambulo_problem *problem,
                                                                ambulo_workspace *workspace,
                                                                const double *x, int count,
                                                                const double *times,
                                                                const ambulo_motion *motion);

/* --------------------------------------------------------- derivative check */

/* Worst disagreement between the hand-derived gradients and central differences: one entry per
 * family of rows and one per objective term. Strings belong to the problem and the model. */
typedef struct ambulo_derivative_error {
  const char *family;   /* row family or term name */
  const char *subject;  /* of the worst row; "" for a term */
  const char *variable; /* coordinate whose control point is worst */
  int control_point;
  double time; /* of the worst row, s */
  double analytic, numeric;
  double error; /* |analytic - numeric| / max(1, size of the row's gradient) */
} ambulo_derivative_error;
/* Fills errors [capacity] and sets *count to the number filled. `step`: of the differences, rad or
 * m;
 * <= 0: chosen here. E_ARGUMENT, E_MEMORY, E_NUMERIC. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_check_derivatives(
    const ambulo_problem *problem, ambulo_workspace *workspace, const double *x, double step,
    ambulo_derivative_error *errors, int capacity, int *count);

/* Converts x_from [variable_count of `from`] to x_to [variable_count of `to`] by knot insertion.
 * Grid and basis of the problems may differ. E_ARGUMENT (other coordinates or duration), E_MEMORY.
 */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_transfer(const ambulo_problem *from,
                                                                  const double *x_from,
                                                                  const ambulo_problem *to,
                                                                  double *x_to);

#ifdef __cplusplus
}
#endif
#endif
