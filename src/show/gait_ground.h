/* show/gait_ground.h - the ground under a motion, seen from the side: the surfaces of its
 * contacts one behind the other. */
#ifndef AMBULO_SHOW_GAIT_GROUND_H
#define AMBULO_SHOW_GAIT_GROUND_H

#include "problem/nlp.h"

typedef struct ambulo__surface {
  double from, to;          /* along forward, m; the first and the last one are endless */
  double at, height, slope; /* height above the ground's at `at`, m, and its rise per m forward */
} ambulo__surface;

typedef struct ambulo__gait_ground {
  ambulo_allocator allocator;
  int count; /* 0: level at the ground's height */
  ambulo__surface *surface;
} ambulo__gait_ground;

/* Of the contacts and, where the motion repeats, of those before and after it. Risers stand where
 * contact/step_edge.h has them. Errors: E_MEMORY. */
ambulo_status ambulo__gait_ground_create(const ambulo_problem *problem,
                                         const ambulo_allocator *allocator,
                                         ambulo__gait_ground *ground);
void ambulo__gait_ground_free(ambulo__gait_ground *ground); /* accepts a zero-filled one */

/* Radians that the ground rises along forward: gravity is not along its normal then. */
double ambulo__ground_slope(const ambulo_model *model);

/* Height of a surface at x along forward, m above the ground's height. */
double ambulo__surface_height(const ambulo__surface *surface, double x);

#endif
