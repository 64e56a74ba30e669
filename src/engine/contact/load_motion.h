/* contact/load_motion.h - a point of one link seen from another, with what moves it: the kinematics
 * of a linear element.
 *
 * The coordinates that move one of two points but not the other are those of the links between
 * them, below the link that carries both; the distance depends on these alone, and on where they
 * hang on that link, whose frame is taken as the world's. On each side, from there down, the
 * constants between two joints are one transform. Joint i turns about, or slides along, the z axis
 * of the frame before it (classical Denavit-Hartenberg): axis z_i through o_i. With p the side's
 * point,
 *
 *     turning   dp/dq_i = z_i x (p - o_i),    sliding   dp/dq_i = z_i
 *     d2p/dq_i dq_j = z_i x dp/dq_j           i turns, and is j or above it; 0 if i slides
 */
#ifndef AMBULO_CONTACT_LOAD_MOTION_H
#define AMBULO_CONTACT_LOAD_MOTION_H

#include "ambulo/device.h"
#include "base/alloc.h"

typedef struct ambulo__path_joint {
  int coordinate, turns;
  double angle, offset; /* theta, d at q = 0 */
  double after[12];     /* to the next joint, rows of 3 x 4; behind the last: to the point */
} ambulo__path_joint;

typedef struct ambulo__device_path {
  double start[12]; /* from the common frame to the first joint; to the point where there is none */
  int count;
  ambulo__path_joint *joints; /* [count] */
} ambulo__device_path;

/* From link `common` (-1: the world) down to a point of `link`. E_MEMORY. */
ambulo_status ambulo__path_create(const ambulo_model *model, int common, int link,
                                  const double position[3], const ambulo_allocator *allocator,
                                  ambulo__device_path *path);
void ambulo__path_free(const ambulo_allocator *allocator, ambulo__device_path *path);
/* The deepest link that carries both, or is one of them; -1: the world. */
int ambulo__path_common(const ambulo_model *model, const int link[2]);

/* frame (rows of 3 x 4) before a joint to that before the next, behind the last: at the point. */
void ambulo__path_follow(double frame[12], const ambulo__path_joint *joint, double q);

/* Where the point is, with axis[count][3] and slope[count][3] = dp/dq of the joints; q has a stride
 * of AMBULO__LANES. */
void ambulo__path_point(const ambulo__device_path *path, const double *q, double point[3],
                        double *axis, double *slope);

/* a point of the body, how it moves, and what each coordinate does to that.
 *
 * p, v, a are its position, velocity and acceleration in the world. Of coordinate j of the chain
 * that carries it, with the axis z through o of the frame before the joint, which turns with w and
 * alpha, and has v_o and a_o at o:
 *
 *     zd = w x z,   zdd = alpha x z + w x zd
 *     turning   J = z x (p - o),   Jd = zd x (p - o) + z x (v - v_o),
 *               Jdd = zdd x (p - o) + 2 zd x (v - v_o) + z x (a - a_o)
 *     sliding   J = z,  Jd = zd,  Jdd = zdd
 *
 * and since p is a function of q alone, with J = dp/dq_j along the motion,
 *
 *     da/dq_j = Jdd,   da/dqd_j = 2 Jd,   da/dqdd_j = J
 */

/* Where the parts stand in what is kept of a point: n joints of the chain. */
typedef struct ambulo__hand_motion {
  double *place, *velocity, *acceleration; /* [3] */
  double *axis, *axis_rate, *axis_gain;    /* z, zd, zdd: [n][3] */
  double *slope, *slope_rate, *slope_gain; /* J, Jd, Jdd: [n][3] */
} ambulo__hand_motion;

static inline size_t ambulo__hand_entries(int joints) {
  return 9 + 18 * (size_t)joints;
}
ambulo__hand_motion ambulo__hand_motion_in(double *kept, int joints);

/* Of a path from the world; q, qd, qdd have a stride of AMBULO__LANES. */
void ambulo__hand_move(const ambulo__device_path *path, const double *q, const double *qd,
                       const double *qdd, const ambulo__hand_motion *motion);

#endif
