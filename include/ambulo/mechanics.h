/* ambulo/mechanics.h - recursive inverse dynamics of a given motion, in batches.
 *
 * For n time nodes and d coordinates, motions are row-major [n][d] arrays: q (rad
 * or m), qd (per second), qdd (per second squared). Outputs:
 *   tau      [n][d]       generalized force at each coordinate, N m or N, with what its drive adds
 *                         (armature, damping, friction of ambulo_coordinate)
 *   wrench   [n][6]       root wrench that the surroundings must apply to the body: moment M
 *                         about the world origin (N m), then force F (N), world axes,
 *                         F = sum m (a - g)                   (seed Eqs. 15'-16')
 *   points   [n][p][3]    positions of the model's points, world frame, m
 * Gravity is the only external force. The recursion is in world coordinates, eight time nodes
 * at a time, with hand-derived derivatives.
 *
 * An ambulo_mechanics holds scratch memory; use one per thread. The model is only read.
 */
#ifndef AMBULO_MECHANICS_H
#define AMBULO_MECHANICS_H

#include "ambulo/model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_mechanics ambulo_mechanics; /* workspace */

/* `model` must outlive it; `allocator` may be NULL. Free with ambulo_mechanics_free. E_ARGUMENT,
 * E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_mechanics_create(const ambulo_model *model,
                                                                  const ambulo_allocator *allocator,
                                                                  ambulo_mechanics **mechanics);
AMBULO_API void ambulo_mechanics_free(ambulo_mechanics *mechanics); /* accepts NULL */

/* Where results go, each of its shape above; NULL: not wanted. */
typedef struct ambulo_outputs {
  size_t size; /* set by ambulo_outputs_default() */
  double *tau, *wrench, *points;
} ambulo_outputs;
AMBULO_DEFAULT(ambulo_outputs); /* NULL */

/* Inverse dynamics of `nodes` >= 1 states; q, qd, qdd [nodes][d].
 * Errors: E_ARGUMENT, E_NUMERIC (an input or a result is not finite). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_mechanics_inverse_dynamics(
    ambulo_mechanics *mechanics, int nodes, const double *q, const double *qd, const double *qdd,
    const ambulo_outputs *outputs);

/* Weights on the outputs of inverse dynamics; NULL: 0 everywhere. */
typedef struct ambulo_output_weights {
  size_t size;          /* set by ambulo_output_weights_default() */
  const double *tau;    /* [n][d] */
  const double *wrench; /* [n][6] */
  const double *points; /* [n][p][3] */
} ambulo_output_weights;
/* Where a gradient with respect to a motion goes: each [n][d], none may be NULL. */
typedef struct ambulo_motion_gradient {
  size_t size; /* set by ambulo_motion_gradient_default() */
  double *q, *qd, *qdd;
} ambulo_motion_gradient;
AMBULO_DEFAULT(ambulo_output_weights);  /* NULL */
AMBULO_DEFAULT(ambulo_motion_gradient); /* NULL: must be set */

/* Vector-Jacobian product: the gradient of the weighted sum of all outputs, by one reverse sweep.
 * Errors: E_ARGUMENT, E_NUMERIC. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_mechanics_gradient(
    ambulo_mechanics *mechanics, int nodes, const double *q, const double *qd, const double *qdd,
    const ambulo_output_weights *weights, const ambulo_motion_gradient *gradient);

/* Full Jacobians of tau and wrench with respect to q, qd and qdd, and of the points with respect to
 * q. Rows are outputs, columns coordinates; tau_qdd is the mass matrix, with armature. Each may be
 * NULL. */
typedef struct ambulo_jacobians {
  size_t size;                               /* set by ambulo_jacobians_default() */
  double *tau_q, *tau_qd, *tau_qdd;          /* [n][d][d] */
  double *wrench_q, *wrench_qd, *wrench_qdd; /* [n][6][d] */
  double *points_q;                          /* [n][3 p][d] */
} ambulo_jacobians;
AMBULO_DEFAULT(ambulo_jacobians); /* NULL */
/* Fills `jacobians` at `nodes` states. Errors: E_ARGUMENT, E_NUMERIC. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_mechanics_jacobians(ambulo_mechanics *mechanics, int nodes, const double *q,
                           const double *qd, const double *qdd, const ambulo_jacobians *jacobians);

/* Where the motion of one point goes, world frame; NULL: not wanted. */
typedef struct ambulo_point_motion {
  size_t size;                 /* set by ambulo_point_motion_default() */
  double *position, *velocity; /* [3], m and m/s */
  double
      *position_q; /* [3][d]: slopes of the position by q, which are those of the velocity by qd */
  double *velocity_q; /* [3][d]: slopes of the velocity by q; needs position_q */
} ambulo_point_motion;
AMBULO_DEFAULT(ambulo_point_motion); /* NULL */
/* Position and velocity of any point at one state q, qd [d]: `local`, m, in the frame of `link`
 * (-1: the world). It needs no memory, so that terms and rows of the caller's own (objective.h) may
 * call it from any thread. Errors: E_ARGUMENT, E_NUMERIC (an input is not finite or beyond 1e100).
 */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_model_point_motion(const ambulo_model *model, int link, const double local[3],
                          const double *q, const double *qd, const ambulo_point_motion *motion);

#ifdef __cplusplus
}
#endif
#endif
