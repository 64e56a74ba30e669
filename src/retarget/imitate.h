/* retarget/imitate.h - the coordinates with which one body stands as another does.
 *
 * Segment by segment, from the pelvis outward: a group of hinges with axes a_i turns its segment by
 * the damped Gauss-Newton step of e, the turn that is left to the goal,
 *
 *     dq = J^T (J J^T + m 1)^-1 e,   J = [a_1 ... a_n]
 *
 * repeated until it is small. A group of three hinges gets there; one of fewer as near as it can.
 * Limits are not looked at: what a joint cannot do shall be seen. Arms follow the torso as it is,
 * all else the goal in space, so that a body without a waist still leans like the person. Arms are
 * also pulled a little toward a pose at ease: hanging arms of some robots turn about one line by
 * two joints, which would spin against each other.
 */
#ifndef AMBULO_RETARGET_IMITATE_H
#define AMBULO_RETARGET_IMITATE_H

#include "retarget/figure.h"

/* Moves the mapped hinges of q [coordinates] from where they are. What the goal cannot be reached
 * by, rad, is left in miss [AMBULO__SEGMENTS]. */
void ambulo__imitate(ambulo__figure *figure, const ambulo__posture *goal, double *q,
                     double miss[AMBULO__SEGMENTS]);

/* Where an arm's joint is at ease: in the start pose, or as near as a tenth of its range away from
 * either end. Of two ways to reach a goal that is the one within the range. */
double ambulo__at_ease(const ambulo_coordinate *about);

#endif
