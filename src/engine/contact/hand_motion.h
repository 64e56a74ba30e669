/* contact/hand_motion.h - a point of the body, how it moves, and what each coordinate does to that.
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
#ifndef AMBULO_CONTACT_HAND_MOTION_H
#define AMBULO_CONTACT_HAND_MOTION_H

#include "contact/device_path.h"

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
