/* model/placement.h - any placement and any joint axis as DH rows.
 *
 * A link that is given by an origin (a place and a rotation in its parent's frame) and an axis
 * moves by
 *
 *     T(q) = Trans(xyz) R Rot(axis, q)        or        Trans(xyz) R Trans(axis q)
 *
 * which is up to four links with DH constants, one of them the joint. Fixed ones are folded into
 * constants before anything is computed (mechanics/plan.c), so they cost nothing. */
#ifndef AMBULO_MODEL_PLACEMENT_H
#define AMBULO_MODEL_PLACEMENT_H

#include "ambulo/model.h"

typedef struct ambulo__placement {
  double xyz[3];         /* m, parent's frame */
  double rotation[3][3]; /* R; columns are the link's axes at q = 0 in the parent's frame */
  double axis[3];        /* link's frame, unit length; not read for a fixed link */
} ambulo__placement;

enum { AMBULO__MOST_ROWS = 4 };

/* R = Rot_z(yaw) Rot_y(pitch) Rot_x(roll), rad. Sines and cosines of right angles are exact. */
void ambulo__rotation_of_rpy(const double rpy[3], double rotation[3][3]);
/* The angles of a rotation; pitch in [-90, 90] degrees, roll 0 where only its sum with yaw counts.
 */
void ambulo__rpy_of_rotation(const double rotation[3][3], double rpy[3]);

/* Fills type, theta, d, a and alpha of row[0 .. count) and nothing else of them, the first next to
 * the parent, the last with the frame of the link. Returns count; *joint is the row that moves, -1
 * for a fixed link. */
int ambulo__placement_rows(const ambulo__placement *placement, ambulo_joint_type type,
                           ambulo_link row[AMBULO__MOST_ROWS], int *joint);

#endif
