/* exchange/free_base.h - the root of a body as one free joint: a quaternion and a twist in its
 * axes.
 */
#ifndef AMBULO_EXCHANGE_FREE_BASE_H
#define AMBULO_EXCHANGE_FREE_BASE_H

#include "exchange/bodies.h"

/* Of a link's frame, in the ground's axes: place, and rates of its origin. */
typedef struct ambulo__frame_motion {
  ambulo__rigid place;
  double velocity[3], acceleration[3]; /* of the origin, m/s, m/s^2 */
  double spin[3], spin_rate[3];        /* angular velocity and acceleration, rad/s, rad/s^2 */
} ambulo__frame_motion;

/* The motion of `link` for q, qd, qdd [d]; `world` turns the model's world to the ground's axes. */
void ambulo__frame_motion_of(const ambulo_model *model, int link, const ambulo__rigid *world,
                             const double *q, const double *qd, const double *qdd,
                             ambulo__frame_motion *motion);

/* Unit quaternion (x, y, z, w) of a rotation, of the two the nearer to `before` (NULL: w >= 0). */
void ambulo__quaternion_of(const double rotation[3][3], const double *before, double q[4]);

#endif
