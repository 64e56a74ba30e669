/* people/approach.h - how near a motion comes to what it keeps clear of. */
#ifndef AMBULO_PEOPLE_APPROACH_H
#define AMBULO_PEOPLE_APPROACH_H

#include "problem/nlp.h"

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
