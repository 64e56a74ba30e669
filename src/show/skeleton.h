/* show/skeleton.h - a stick figure made from any model.
 *
 * Lines: from each link's joint to the next (origins of parent and child frame, where they
 * are more than 1 cm apart), ankle - heel - toe - ankle for feet, from the root body to a
 * point named "head_top" with a head below it, or to the centre of mass of a body at whose
 * joint no line begins. A model with `origin`s, an imported one, has several links at one joint
 * (model/placement.h): they count as one. Not drawn: virtual links that place the whole body in
 * the world, and frames beyond which there is nothing that weighs, moves or touches (sensors,
 * kneecaps).
 */
#ifndef AMBULO_SHOW_SKELETON_H
#define AMBULO_SHOW_SKELETON_H

#include "mechanics/pose.h"
#include "base/text_buffer.h"
#include "model/model.h"

/* What coordinates are called in pictures, and on which side they are.
 *
 * A coordinate that has a mirror image is called as the other one but for the side, which is where
 * the two names part: hip_flexion_l and hip_flexion_r, left_knee and right_knee, LLEG_HIP_R and
 * RLEG_HIP_R (whose last letter is no side). */
typedef enum ambulo__side { AMBULO__MIDDLE, AMBULO__LEFT, AMBULO__RIGHT } ambulo__side;

/* Left, right or neither, of a coordinate that has a mirror image: by the two names, else by where
 * its joint stands at q = 0, beside the other's. */
ambulo__side ambulo__coordinate_side(const ambulo_model *model, int coordinate);

/* Appends the name without its side, in words: "Hip flexion", "LEG HIP R". */
void ambulo__coordinate_title(const ambulo_model *model, int coordinate, ambulo__text_buffer *out);

typedef struct ambulo__bone {
  int link[2];     /* links its ends are fixed to; -1: the world */
  double at[2][3]; /* ends in the links' frames, m */
  ambulo__side side;
  double head; /* > 0: a head of this radius (m) sits at the second end */
} ambulo__bone;

typedef struct ambulo__skeleton {
  ambulo_allocator allocator;
  const ambulo_model *model;
  ambulo__pose pose; /* the last one: ambulo__pose_at, ambulo__pose_point */
  ambulo__bone *bones;
  int bone_count, bone_capacity;
  ambulo__side *side; /* [links] */
  int *joint;         /* [links]: the first link whose joint is in the same place at every pose */
  int *bears;         /* [links]: 1 if it or a link beyond weighs, moves or has a point */
} ambulo__skeleton;

/* Errors: E_MEMORY. */
ambulo_status ambulo__skeleton_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                      ambulo__skeleton *skeleton);
void ambulo__skeleton_free(ambulo__skeleton *skeleton); /* accepts a zero-filled one */

#endif
