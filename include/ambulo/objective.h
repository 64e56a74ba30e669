/* ambulo/objective.h - what is minimized, and rows of the caller's own: parts of problem.h.
 *
 * Terms are integrated over the motion; functions of the caller see one node at a time, and give
 * their gradient with their value.
 */
#ifndef AMBULO_OBJECTIVE_H
#define AMBULO_OBJECTIVE_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_relation {
  AMBULO_RELATION_NOT_SET = 0, /* refused */
  AMBULO_EQUAL,
  AMBULO_NOT_NEGATIVE
} ambulo_relation;

/* ------------------------------------------------- what callbacks get to see */

/* State of one node. Arrays: q, qd, qdd, tau [d]; wrench [6] (M about the world
 * origin, then F); points [p][3]. */
typedef struct ambulo_node_state {
  double time;
  int node;
  const double *q, *qd, *qdd, *tau, *wrench, *points;
} ambulo_node_state;

/* Gradient with respect to the members of ambulo_node_state; zero on entry. */
typedef struct ambulo_node_gradient {
  double *q, *qd, *qdd, *tau, *wrench, *points;
} ambulo_node_gradient;

/* Value at one node, gradient added where `gradient` is not NULL. Must be a pure
 * function of the state's members; called from the thread that evaluates, also with members that do
 * not belong to one motion: the solver learns the curvature of a term from gradients at states
 * nearby. Of AMBULO_USER_SQUARE it knows the curvature without, and solves faster. A value or a
 * gradient that is not finite gives a trial point up (a barrier may return NAN beyond its wall); at
 * the start, at every iterate and at the end it is a numeric failure. */
typedef double (*ambulo_node_function)(void *user, const ambulo_node_state *state,
                                       ambulo_node_gradient *gradient);

/* ----------------------------------------------------------------- objective */

typedef enum ambulo_term_kind {
  AMBULO_TERM_KIND_NOT_SET = 0, /* refused */
  AMBULO_TORQUE_SQUARED,        /* sum_i u_i^2,  u_i = scale_i (tau_i - offset_i) */
  AMBULO_TORQUE_ABSOLUTE,  /* sum_i sqrt(u_i^2 + s^2) - s,  s = smoothing (the seed's Fig. 5b) */
  AMBULO_ACCELERATION,     /* sum_i (scale_i qdd_i)^2 */
  AMBULO_TRACKING,         /* sum_i (scale_i (q_i - reference_i))^2 */
  AMBULO_USER_TERM,        /* function(user, state, gradient) */
  AMBULO_TORQUE_POWER,     /* sum_i (u_i^2 + s^2)^(p/2) - s^p,  u_i the active torque as a share
                              of strength: scale_i (tau_i - offset_i - passive_i(q)) / strength_i(q) */
  AMBULO_TORQUE_RATE,      /* sum_i (scale_i dtau_i/dt)^2, differences between nodes */
  AMBULO_MECHANICAL_POWER, /* sum_i sqrt(u_i^2 + s^2) - s,  u_i = scale_i tau_i qd_i / m, W/kg;
                              with `tendon` tau_i (qd_i + dtau_i/dt / tendon_i) for tau_i qd_i */
  AMBULO_POSTURE,          /* sum_i (scale_i (q_i - offset_i))^2 */
  AMBULO_UPRIGHT,      /* squared horizontal parts of a line, point[0] to point[1], by its length */
  AMBULO_GROUND_FORCE, /* |F / (m g) - n|^2, F the root force, n up */
  AMBULO_CLEARANCE,    /* max(0, 1 - height of heel, ball, tip / `height`)^2, feet in the air */
  AMBULO_USER_SQUARE,  /* function(user, state, gradient)^2 */
  AMBULO_FORCE_RATE,   /* |df/dt|^2 / (10 m g)^2 of each contact's force f, differences between
                          nodes; needs ground reaction */
  AMBULO_DEVICE_EFFORT /* sum_i (device_scale_i E_i)^2, E_i the efforts of the devices */
} ambulo_term_kind;

typedef struct ambulo_term {
  ambulo_term_kind kind;
  const char *name;              /* for reports; NULL: the kind's name */
  double weight;                 /* >= 0 */
  const double *scale;           /* [d]; NULL: 1 everywhere */
  const double *offset;          /* [d]; NULL: 0 everywhere (torques: N m, N; posture: rad, m) */
  double smoothing;              /* s > 0 where the kind has one, unit of u */
  double power;                  /* p in [2, 8] of AMBULO_TORQUE_POWER */
  const double *passive;         /* [d][4]: b1, k1, b2, k2 of b1 exp(k1 q) + b2 exp(k2 q), N m and
                                    1/rad; NULL: none (AMBULO_TORQUE_POWER) */
  const double *strength;        /* [d][2][3]: for positive, then negative torque: peak (N m), c2
                                    (1/rad), c3 (rad) of peak cos(c2 (q - c3)); peak 0: strength 1;
                                    NULL: 1 everywhere (AMBULO_TORQUE_POWER) */
  int strength_is_limits;        /* 1: the strength of each coordinate is its torque limit in the
                                    model, of positive and of negative torque, whatever `strength`
                                    is; scale then is a price (AMBULO_TORQUE_POWER) */
  const double *price;           /* [d][2]: with strength_is_limits what scale is multiplied by for
                                    negative, for positive torque, > 0; NULL: 1 */
  int point[2];                  /* model points of AMBULO_UPRIGHT; length: of q = 0 */
  double height;                 /* of AMBULO_CLEARANCE, m > 0; 0.02 */
  const double *device_scale;    /* [device_count] of AMBULO_DEVICE_EFFORT, >= 0; NULL: 1 */
  const double *reference;       /* [N + 1][d] at the time nodes, for AMBULO_TRACKING */
  ambulo_node_function function; /* AMBULO_USER_TERM */
  void *user;
  const double *tendon; /* [d]: stiffness in series with the muscles, N m/rad (N/m), >= 0;
                           0: none. Power then is the muscles', from means and differences
                           of neighbouring nodes; NULL: that of the joint, at the nodes
                           (AMBULO_MECHANICAL_POWER) */
} ambulo_term;

/* A constraint of the caller's own, one row at each node in [from, to]. */
typedef struct ambulo_user_row {
  const char *name; /* its family in reports, apart from one of the engine under the same name */
  const char *unit;
  ambulo_relation relation;
  double from, to; /* s */
  ambulo_node_function function;
  void *user;
} ambulo_user_row;

/* Of weight 1, each number as docs/problem-format.md has it; a row c >= 0 at every node. */
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_term ambulo_term_default(ambulo_term_kind kind) {
  ambulo_term usual;
  usual.kind = kind;
  ambulo_problem_defaults("ambulo_term", &usual, sizeof usual);
  return usual;
}
#endif
AMBULO_PROBLEM_DEFAULT(ambulo_user_row);

#ifdef __cplusplus
}
#endif
#endif
