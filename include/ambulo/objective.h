/* ambulo/objective.h - objective terms, and rows of the caller's own: parts of problem.h.
 *
 * Terms are integrated over the motion. A caller's function sees one node at a time and returns its
 * gradient with its value.
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

/* State of one node, SI units. Arrays: q, qd, qdd, tau [d]; wrench [6] (M about the world origin,
 * then F); points [p][3]. Valid during the call only. */
typedef struct ambulo_node_state {
  double time;
  int node;
  const double *q, *qd, *qdd, *tau, *wrench, *points;
} ambulo_node_state;

/* Gradient with respect to the arrays of ambulo_node_state, of the same shapes; zero on entry. */
typedef struct ambulo_node_gradient {
  double *q, *qd, *qdd, *tau, *wrench, *points;
} ambulo_node_gradient;

/* Returns the value at one node, and adds its gradient if `gradient` is not NULL. It must be a pure
 * function of the state. It is called from the evaluating thread, also at states that do not belong
 * to a motion: the solver estimates the curvature of a term from gradients at nearby states. For
 * AMBULO_USER_SQUARE no such estimate is needed, and solves are faster.
 *
 * ambulo_model_point_motion() (mechanics.h) gives the velocity of any point, with its slopes.
 *
 * A value or gradient that is not finite rejects the trial point, so a barrier may return NAN
 * beyond its wall. At the start, at an iterate or at the end it is a numeric failure. */
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
  AMBULO_TORQUE_POWER,     /* sum_i (u_i^2 + s^2)^(p/2) - s^p,  u_i the active torque as a fraction
                              of strength: scale_i (tau_i - offset_i - passive_i(q)) / strength_i(q) */
  AMBULO_TORQUE_RATE,      /* sum_i (scale_i dtau_i/dt)^2, differences between nodes */
  AMBULO_MECHANICAL_POWER, /* sum_i (1 + n)/2 (sqrt(u_i^2 + s^2) - s) + (1 - n)/2 u_i,
                              u_i = scale_i tau_i qd_i / m, W/kg, n = negative;
                              with `tendon` tau_i (qd_i + dtau_i/dt / tendon_i) for tau_i qd_i */
  AMBULO_POSTURE,          /* sum_i (scale_i (q_i - offset_i))^2 */
  AMBULO_UPRIGHT, /* squared horizontal parts of the line point[0] to point[1] over its length */
  AMBULO_GROUND_FORCE,   /* |F / (m g) - n|^2, F the root force, n up */
  AMBULO_CLEARANCE,      /* max(0, 1 - height of heel, ball, tip / `height`)^2, feet in the air */
  AMBULO_USER_SQUARE,    /* function(user, state, gradient)^2 */
  AMBULO_FORCE_RATE,     /* |df/dt|^2 / (10 m g)^2 of each contact's force f, differences between
                            nodes; needs ground reaction */
  AMBULO_DEVICE_EFFORT,  /* sum_i (device_scale_i E_i)^2, E_i the efforts of the devices */
  AMBULO_MUSCLE_EFFORT,  /* the least cost at which muscles supply the torques (ambulo/muscles.h);
                            needs muscles */
  AMBULO_POINT_TRACKING, /* sum_m |mark_scale_m (r_m - mark_reference_m)|^2, r_m the points `marks`
                          */
  AMBULO_FORCE_TRACKING, /* sum_f |foot_scale_f (F_f - foot_reference_f) / (m g)|^2, F_f the force
                            of the ground on each foot; needs ground reaction */
  AMBULO_PRESSURE_TRACKING /* sum_f |foot_scale_f N_f (c_f - foot_reference_f) / (m g)|^2, N_f the
                              normal force on each foot, c_f its centre of pressure, along the
                              ground; needs ground reaction */
} ambulo_term_kind;

typedef struct ambulo_term {
  ambulo_term_kind kind;
  const char *name;              /* for reports; NULL: the kind's name */
  double weight;                 /* >= 0 */
  const double *scale;           /* [d]; NULL: 1 everywhere */
  const double *offset;          /* [d]; NULL: 0 everywhere (torques: N m, N; posture: rad, m) */
  double smoothing;              /* s > 0 of kinds with an s, in the unit of u */
  double power;                  /* p in [2, 8] of AMBULO_TORQUE_POWER */
  const double *passive;         /* [d][4]: b1, k1, b2, k2 of b1 exp(k1 q) + b2 exp(k2 q), N m and
                                    1/rad; NULL: none (AMBULO_TORQUE_POWER) */
  const double *strength;        /* [d][2][3]: for positive, then negative torque: peak (N m), c2
                                    (1/rad), c3 (rad) of peak cos(c2 (q - c3)); peak 0: strength 1;
                                    NULL: 1 everywhere (AMBULO_TORQUE_POWER) */
  int strength_is_limits;        /* 1: the strength of each coordinate is its torque limit in the
                                    model, for positive and negative torque; `strength` is ignored
                                    and scale is a price (AMBULO_TORQUE_POWER) */
  const double *price;           /* [d][2]: with strength_is_limits, factors > 0 on scale for
                                    negative and positive torque; NULL: 1 */
  int point[2];                  /* model points of AMBULO_UPRIGHT; its length is that at q = 0 */
  double height;                 /* of AMBULO_CLEARANCE, m, > 0; 0.02 */
  const double *device_scale;    /* [device_count] of AMBULO_DEVICE_EFFORT, >= 0; NULL: 1 */
  const double *reference;       /* [N + 1][d] at the time nodes, for AMBULO_TRACKING */
  ambulo_node_function function; /* AMBULO_USER_TERM */
  void *user;
  const double *tendon; /* [d]: stiffness in series with the muscles, N m/rad (N/m), >= 0; 0: none.
                           Power is then that of the muscles, from means and differences of
                           neighbouring nodes. NULL: power of the joint, at the nodes
                           (AMBULO_MECHANICAL_POWER) */
  double
      negative; /* n in [0, 1]: price of negative power beside positive (AMBULO_MECHANICAL_POWER);
                   1 */
  /* of AMBULO_MUSCLE_EFFORT: prices of ambulo_sharing, by volume; 1, 0, 0.2 */
  double activation, metabolic, reserve;
  const int *marks; /* [mark_count]: points of the model (AMBULO_POINT_TRACKING) */
  int mark_count;
  const double *mark_scale;     /* [mark_count], 1/m, >= 0; NULL: 1 */
  const double *mark_reference; /* [N + 1][mark_count][3] at the time nodes, world axes, m; NAN:
                                   nothing is asked of this point then */
  const double *foot_scale;     /* [feet], 1 or 1/m, >= 0; NULL: 1 (AMBULO_FORCE_TRACKING,
                                   AMBULO_PRESSURE_TRACKING) */
  const double *foot_reference; /* [N + 1][feet][3]: forces, N, or centres of pressure, m; NAN:
                                   nothing is asked of this foot then */
} ambulo_term;

/* A constraint of the caller's own, one row at each node in [from, to]. */
typedef struct ambulo_user_row {
  const char *name; /* its family in reports; kept apart from an engine's family of that name */
  const char *unit;
  ambulo_relation relation;
  double from, to; /* s */
  ambulo_node_function function;
  void *user;
} ambulo_user_row;

/* A term of weight 1 with the defaults of docs/problem-format.md; a row c >= 0 at every node. */
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
