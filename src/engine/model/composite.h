/* model/composite.h - several rigid bodies as one. */
#ifndef AMBULO_MODEL_COMPOSITE_H
#define AMBULO_MODEL_COMPOSITE_H

/* A rigid body: mass, centre of mass, inertia about it [xx yy zz xy xz yz]. */
typedef struct ambulo__part {
  double mass, com[3], inertia[6];
} ambulo__part;

/* Adds `part` to `whole` by the parallel-axis theorem. */
void ambulo__part_add(ambulo__part *whole, const ambulo__part *part);

#endif
