/* mechanics/plan_steps.h - what the kernels of the Jacobians read: lists of equal steps.
 *
 * Integers are offsets in doubles: into the scratch, or for output and entry into the [entry][lane]
 * arrays of the caller.
 */
#ifndef AMBULO_MECHANICS_PLAN_STEPS_H
#define AMBULO_MECHANICS_PLAN_STEPS_H

#include "mechanics/plan.h"

typedef struct ambulo__rigid_body {
  int frame;
  double mass;
  double com[3]; /* in the frame */
  /* inertia about the centre of mass = base 1 + first u u' + second w w', with
   * u = (1, lower[0], lower[1]), w = (0, 1, lower[2]) in the frame's axes in
   * this order */
  double base, first, second, lower[3];
  int order[3];
  int diagonal; /* lower = 0 */
} ambulo__rigid_body;

/* A joint's row and column of the Jacobians: pairs first .. first + count of
 * ancestors, and the joint itself. The first `straight` pairs are with straight
 * joints, the first `rowless` pairs with joints whose own rows of tau have no
 * entries. */
typedef struct ambulo__change_step {
  int motion;
  int subtree; /* where its subtree stands: in the slot of the frame, or of its only child */
  int first, rowless, straight, count, lower;
  int is_straight; /* prismatic along an axis that stands still: of its motion only S is read */
  int is_rowless;  /* its own row has no entries; then nor have those of its ancestors */
  double mass;
} ambulo__change_step;

/* axis: 0, 1, 2 if the ancestor is straight along that world axis, else -1; upper: the joint's
 * column in the ancestor's row. */
typedef struct ambulo__pair {
  int motion, upper, axis;
} ambulo__pair;

/* The points of one frame. */
typedef struct ambulo__group_step {
  int first, count;       /* points */
  int chain, chain_count; /* motions of the joints that move them */
} ambulo__group_step;

typedef struct ambulo__point_step {
  double position[3];
  int output, entry; /* rows of outputs and weights; first Jacobian entry */
} ambulo__point_step;

typedef struct ambulo__steps {
  ambulo__change_step *changes; /* all coordinates */
  ambulo__pair *pairs;
  ambulo__group_step *groups;
  ambulo__point_step *points; /* all points, by group */
  int *chains;
  int group_count;
} ambulo__steps;

#endif
