/* mechanics/pose.h - where the links of a model are at a pose q [coordinates].
 *
 * Forward kinematics is Eq. (4): A_i = A_parent T_i.
 */
#ifndef AMBULO_MECHANICS_POSE_H
#define AMBULO_MECHANICS_POSE_H

#include "model/model.h"

typedef struct ambulo__pose {
  ambulo_allocator allocator;
  const ambulo_model *model;
  double *frames; /* [links][12]: rows of the 3 x 4 transform A_i, after ambulo__pose_at */
} ambulo__pose;

/* Errors: E_MEMORY. */
ambulo_status ambulo__pose_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                  ambulo__pose *pose);
void ambulo__pose_free(ambulo__pose *pose); /* accepts a zero-filled one */

/* Frames at q [coordinates]. */
void ambulo__pose_at(ambulo__pose *pose, const double *q);
/* World position of a point of a link (-1: the world). */
void ambulo__pose_point(const ambulo__pose *pose, int link, const double local[3], double world[3]);

/* Centre of mass of the body, world, m. */
void ambulo__pose_center_of_mass(const ambulo__pose *pose, double center[3]);

#endif
