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
#include "show/coordinate_name.h"

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
