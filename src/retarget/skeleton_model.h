/* retarget/skeleton_model.h - a skeleton of joints, as SMPL and BVH have them, as a model.
 *
 * Every joint is a ball: three hinges about the axes of the skeleton, in the order x, y, z. At rest
 * the skeleton stands with y up and faces along z, its left along x. The root slides along x, y and
 * z before it turns. Feet get soles as deep as the lowest joint or end below the ankle. */
#ifndef AMBULO_RETARGET_SKELETON_MODEL_H
#define AMBULO_RETARGET_SKELETON_MODEL_H

#include "retarget/source.h"

enum { AMBULO__MOST_JOINTS = 256, AMBULO__JOINT_NAME = 48 };

typedef struct ambulo__skeleton_joint {
  char name[AMBULO__JOINT_NAME];
  int parent;       /* -1: the root; before its children */
  double offset[3]; /* from the parent's at rest, m */
  int is_end;       /* 1: nothing turns there */
} ambulo__skeleton_joint;

typedef struct ambulo__skeleton_joints {
  ambulo__skeleton_joint joint[AMBULO__MOST_JOINTS];
  int count;
} ambulo__skeleton_joints;

/* Makes the model, given->own, and its text. Errors: those of ambulo_model_load_text. */
ambulo_status ambulo__joints_model(const ambulo__skeleton_joints *joints, const char *name,
                                   ambulo_diagnostics *diagnostics, ambulo__given *given);
/* The three angles of a joint with this rotation. */
void ambulo__joint_angles(const double r[3][3], double angles[3]);
/* Index of the first coordinate of a joint in the model. */
int ambulo__joint_coordinate(const ambulo__skeleton_joints *joints, int joint);

#endif
