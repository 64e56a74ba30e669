/* people/stride_measures.h - what a motion costs in work, and how its centre of mass goes.
 *
 * P_i = tau_i qd_i is the power of actuated coordinate i, W. Over the motion as it is shown (whole
 * strides, stride.h) each has done
 *
 *     W+_i = integral max(0, P_i) dt,   W-_i = integral min(0, P_i) dt          J
 *
 * Without ground reaction torques of a leg that stands are not those of a person, and there is
 * none. What a walk costs a person is in people/walking_cost.h.
 */
#ifndef AMBULO_PEOPLE_STRIDE_MEASURES_H
#define AMBULO_PEOPLE_STRIDE_MEASURES_H

#include "people/stride.h"
#include "problem/nlp.h"

typedef struct ambulo__economy {
  ambulo_allocator allocator;
  double *positive, *negative;       /* [coordinates], J; 0 of those that are not actuated */
  double positive_sum, negative_sum; /* J */
  double distance;                   /* of the centre of mass along forward, m */
  double feet; /* of the foot that goes farthest, m; 0 without feet, or where none goes forward */
  double rise, sway; /* largest less smallest height above the mean path along up, and place along
                        left, m */
} ambulo__economy;

/* Fills *economy, which ambulo__economy_free releases. Errors: E_MEMORY. */
ambulo_status ambulo__economy_of(const ambulo__stride *stride, const ambulo_allocator *allocator,
                                 ambulo__economy *economy);
void ambulo__economy_free(ambulo__economy *economy); /* accepts a zero-filled one */

/* integral of the forces on feet and patches over the motion as it is shown. */

/* impulse [effectors][3] (contact/contacts.h; without patches the feet's), N s, world axes: over
 * [0, T], or over the whole stride when its second step is the mirror image (people/stride.h). A
 * motion that is not finite gives numbers that are not. Nothing without ground reaction. Errors:
 * E_MEMORY.
 */
ambulo_status ambulo__impulses(const ambulo_problem *problem, const double *x,
                               const ambulo_allocator *allocator, double *impulse);

/* how near a motion comes to what it keeps clear of. */

/* A capsule, and another or an obstacle, where they are nearest. Names live in the problem. */
typedef struct ambulo__approach {
  const char *capsule, *other;
  int is_obstacle;
  double gap, time; /* m of air, negative: one is inside the other; s. NaN: the motion is not
                       finite */
} ambulo__approach;

/* Of every pair that has rows, then of every obstacle that of each of its capsules, at `samples`
 * evenly spaced times of the stride (stride.h). *list is freed by the caller. E_MEMORY. */
ambulo_status ambulo__approaches(const ambulo_problem *problem, const double *x, int samples,
                                 const ambulo_allocator *allocator, ambulo__approach **list,
                                 int *count);

#endif
