/* ambulo/evaluate.h - what a problem (problem.h) says of one point x: objective, rows, their
 * gradients, the motion; and whether the hand-derived gradients agree with differences.
 *
 * A problem is immutable; what an evaluation needs besides lives in a workspace. Several threads
 * may use one problem, each with a workspace of its own. */
#ifndef AMBULO_EVALUATE_H
#define AMBULO_EVALUATE_H

#include "ambulo/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A value or a derivative that is not finite. Strings belong to the problem and the model. */
typedef enum ambulo_fault_kind {
  AMBULO_FAULT_NONE = 0,  /* everything was finite */
  AMBULO_FAULT_UNKNOWN,   /* an unknown of the point itself */
  AMBULO_FAULT_TERM,      /* an objective term */
  AMBULO_FAULT_ROW,       /* a row */
  AMBULO_FAULT_MECHANICS, /* inverse dynamics: finite values, a derivative that is not */
  AMBULO_FAULT_SUM        /* finite parts with a sum that is not */
} ambulo_fault_kind;
typedef struct ambulo_fault {
  ambulo_fault_kind kind;
  int derivative;               /* 0: the value; 1: its derivative by `by` of `of`; 2: the second */
  const char *name;             /* of the term, family of the row; "" for others */
  const char *subject, *detail; /* of the row; "" for others */
  const char *by; /* "q", "qd", "qdd", "tau", "wrench", "points", "reaction", "unknown" */
  const char *of; /* coordinate, component, point or foot */
  int node;       /* -1: not tied to one node */
  double time;    /* s */
  double value;   /* NAN, INFINITY or -INFINITY */
} ambulo_fault;
/* In words: "the derivative of objective term 'effort' by tau of elbow at node 3 (t = 0.3 s) is
 * nan". Writes at most `size` bytes, ended by 0. */
AMBULO_API void ambulo_fault_text(const ambulo_fault *fault, char *buffer, size_t size);

AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_workspace_create(const ambulo_problem *problem,
                                                                  const ambulo_allocator *allocator,
                                                                  ambulo_workspace **workspace);
AMBULO_API void ambulo_workspace_free(ambulo_workspace *workspace); /* accepts NULL */
/* What made the last call with this workspace that returned E_NUMERIC do so. */
AMBULO_API const ambulo_fault *ambulo_workspace_fault(const ambulo_workspace *workspace);

/* Objective, its terms [term_count] and row values [row_count] at x
 * [variable_count]; each output may be NULL. Nothing is recomputed while x stays
 * the same. E_NUMERIC: a value is not finite (ambulo_workspace_fault tells which). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_evaluate(const ambulo_problem *problem,
                                                                  ambulo_workspace *workspace,
                                                                  const double *x,
                                                                  double *objective, double *terms,
                                                                  double *rows);

/* Gradient [variable_count] of objective_weight * J + sum_r row_weights[r] c_r
 * (row_weights may be NULL): one reverse sweep. E_NUMERIC: a value or a derivative is not
 * finite; the gradient is filled all the same. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_problem_gradient(const ambulo_problem *problem, ambulo_workspace *workspace, const double *x,
                        double objective_weight, const double *row_weights, double *gradient);

/* Gradient of one row, dense [variable_count]. E_NUMERIC as above. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_row_gradient(const ambulo_problem *problem,
                                                                      ambulo_workspace *workspace,
                                                                      const double *x, int row,
                                                                      double *gradient);

/* The motion at `count` >= 1 times in [0, T]. Outputs [count][...] as in mechanics.h
 * plus the ZMP [count][3] on the ground plane (NaN where n . F <= 0); each may be
 * NULL. With ground reaction also the force on each foot grf [count][feet][3] (N), its centre of
 * pressure cop [count][feet][3] (m; NaN where the ground does not push), its free moment about the
 * normal there free_moment [count][feet] (N m; 0 without a centre), its moment about the world's
 * origin grf_moment [count][feet][3] (N m; all of it, wherever the centre of pressure may be), and
 * the same of each patch of the model, patch_... [count][patches]: zeros and a NaN centre where it
 * is not in contact. Without ground reaction these are filled with NaN. Of devices
 * (ambulo/device.h) effort, coordinate or length, and power on the body, [count][devices] (N m or
 * N; rad or m; W); tau is what they leave to the person. Of what hands hold (ambulo/hold.h) the
 * force that each hand exerts and the moment about its point, [count][holds][2][3], world axes (N,
 * N m; zeros of a hand that is not there, and while nothing is held), and the power of the forces,
 * [count][holds] (W). E_ARGUMENT: a time outside [0, T]. E_NUMERIC: some value is not finite; the
 * outputs are filled all the same. */
typedef struct ambulo_motion {
  size_t size; /* set by ambulo_motion_default() */
  double *q, *qd, *qdd, *tau, *wrench, *points, *zmp;
  double *grf, *cop, *free_moment, *grf_moment;
  double *patch_force, *patch_cop, *patch_free_moment, *patch_moment;
  double *device_effort, *device_along, *device_power;
  double *hold_force, *hold_moment, *hold_power;
} ambulo_motion;
AMBULO_DEFAULT(ambulo_motion); /* NULL */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_motion(const ambulo_problem *problem,
                                                                ambulo_workspace *workspace,
                                                                const double *x, int count,
                                                                const double *times,
                                                                const ambulo_motion *motion);

/* --------------------------------------------------------- derivative check */

/* Worst disagreement between the hand-derived gradients and central differences,
 * one entry per family of rows and one per objective term. */
typedef struct ambulo_derivative_error {
  const char *family;   /* row family or term name */
  const char *subject;  /* of the worst row; "" for a term */
  const char *variable; /* coordinate whose control point is worst */
  int control_point;
  double time; /* of the worst row, s */
  double analytic, numeric;
  double error; /* |analytic - numeric| / max(1, size of the row's gradient) */
} ambulo_derivative_error;
/* Fills up to `capacity` entries, sets *count. `step` <= 0 picks one. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_check_derivatives(
    const ambulo_problem *problem, ambulo_workspace *workspace, const double *x, double step,
    ambulo_derivative_error *errors, int capacity, int *count);

/* Carries a solution of another problem (same coordinates and duration, another
 * grid or basis) over to this one: knot insertion. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_transfer(const ambulo_problem *from,
                                                                  const double *x_from,
                                                                  const ambulo_problem *to,
                                                                  double *x_to);

#ifdef __cplusplus
}
#endif
#endif
