/* method/joint_squares.h - the squares of one coordinate at one node, made few.
 *
 * Residuals of a coordinate's torque and motion, linearized (strength, mechanical power, rest
 * postures, ...), are r_j = a_j tau + m_j . (q, qd, qdd). Of their sum of squares, each times its
 * curvature whose root is in a_j and m_j, what is needed is the quadratic form alone. Turning two
 * of them by the angle whose tangent is a_2 / a_1 leaves the sum as it is, and tau in one of them:
 *
 *     r_1' = c r_1 + s r_2 = |(a_1, a_2)| tau + ...,   r_2' = c r_2 - s r_1 = (c m_2 - s m_1) .
 * (...)
 *
 * So however many there are, one square with the torque is left, whose gradient is as long as the
 * node's window, and a form of q, qd and qdd, which depend on the control points of the coordinate
 * alone. A turn cancels nothing: the squares that are left are sums of what was there.
 */
#ifndef AMBULO_METHOD_JOINT_SQUARES_H
#define AMBULO_METHOD_JOINT_SQUARES_H

#include "trajectory/basis.h"

/* (tau * torque + motion . (q, qd, qdd))^2 + the form of q, qd and qdd with the lower triangle
 * `light`, row by row; all zero: no square. */
typedef struct ambulo__joint_squares {
  double tau, motion[3], light[6];
} ambulo__joint_squares;

/* Adds (tau * torque + motion . (q, qd, qdd))^2. */
void ambulo__joint_squares_add(ambulo__joint_squares *s, double tau, const double motion[3]);
/* Lower triangle of the form `light` by the control points, row by row: form [span (span + 1) / 2].
 * 0: there is none. */
int ambulo__joint_squares_light(const ambulo__joint_squares *s, const ambulo__basis_point *point,
                                double *form);

#endif
