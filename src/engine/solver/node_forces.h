/* solver/node_forces.h - how torques and forces of one node answer to a change of the bodies'
 * loads, of gravity, or of what the ground is told; at a fixed motion.
 *
 * World axes, moments about the world origin, as everywhere in mechanics/. A change is handed over
 * as a tangent: the change per unit of some number p. */
#ifndef AMBULO_SOLVER_NODE_FORCES_H
#define AMBULO_SOLVER_NODE_FORCES_H

#include "mechanics/pose.h"
#include "solver/partials.h"

typedef struct ambulo__node_forces {
  const ambulo__stationary *s;
  int node;
  double *q, *qd, *qdd;  /* [d] */
  ambulo__pose pose;     /* at q */
  double *axis, *origin; /* [d][3]: of the joints */
  double *omega, *alpha; /* [links][3]: angular velocity and acceleration */
  double *acceleration;  /* [links][3]: of the frames' origins, m/s^2 */
  double *torque;        /* [d]: tangent of the generalized forces without the ground's */
  double wrench[6];      /* tangent of the root wrench: moment, force */
  double center[3];      /* tangent of the centre of mass, m */
  /* where contacts share the load: tangents of their centres, weights, of moment_arm and of slant
   */
  double place[AMBULO__MOST_CONTACTS][3], load[AMBULO__MOST_CONTACTS], moment_arm, slant;
} ambulo__node_forces;

/* Memory from `pool` but for the pose, which ambulo__node_forces_free frees. E_MEMORY. */
ambulo_status ambulo__node_forces_create(const ambulo__stationary *s, ambulo__pool *pool,
                                         ambulo__node_forces *forces);
void ambulo__node_forces_free(ambulo__node_forces *forces); /* accepts a zero-filled one */

/* Places joints and links as they are at a node. */
void ambulo__node_forces_at(ambulo__node_forces *forces, int node);
/* Acceleration of a point of a link, world axes, m/s^2; `place` is where it is. */
void ambulo__node_forces_acceleration(const ambulo__node_forces *forces, int link,
                                      const double place[3], double acceleration[3]);

/* Every tangent to zero. */
void ambulo__node_forces_clear(ambulo__node_forces *forces);
/* Adds the tangent `force` on what asks for it, a link at a place: what carries it must supply it.
 */
void ambulo__node_forces_add(ambulo__node_forces *forces, int link, const double place[3],
                             const double force[3]);
/* Adds the tangent `moment` on what asks for it, a link. */
void ambulo__node_forces_turn(ambulo__node_forces *forces, int link, const double moment[3]);
/* sum w dy/dp over the node's torques, root wrench, feet and centre of mass, with the ground's
 * part: node_pull.c. */
double ambulo__node_forces_pull(const ambulo__node_forces *forces);

/* dg/ds of a slope s: |g| (sin s n - cos s f), m/s^2. */
void ambulo__turn_of_gravity(const ambulo_model *model, double turn[3]);

/* The ground's part. */
double ambulo__contact_forces_pull(const ambulo__node_forces *forces);

/* Where contacts share the load: adds the partials of all that the law is told at the node. */
void ambulo__partials_of_told(ambulo__node_forces *forces, ambulo__partials *partials);

/* The generalized force of joint i by a wrench that acts through it: S_i . w. */
double ambulo__node_forces_joint(const ambulo__node_forces *forces, int i, const double wrench[6]);

#endif
