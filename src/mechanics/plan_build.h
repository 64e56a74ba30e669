/* mechanics/plan_build.h - the steps of compiling a plan, in order. Private to plan*.c. */
#ifndef AMBULO_MECHANICS_PLAN_BUILD_H
#define AMBULO_MECHANICS_PLAN_BUILD_H

#include "mechanics/plan_layout.h"

/* A mass distribution: mass, centre of mass, inertia about it. */
typedef struct ambulo__mass {
  double mass, com[3], inertia[3][3];
} ambulo__mass;

/* Where a link stands: x_frame = rotation x_link + position, constant. */
typedef struct ambulo__placing {
  int frame;
  double rotation[3][3], position[3];
} ambulo__placing;

/* The same with the rotation and position applied: the link's body seen from its frame. */
ambulo__mass ambulo__mass_of_link(const ambulo_link *link, const ambulo__placing *placing);
/* Adds b to a as one rigid body. */
void ambulo__mass_add(ambulo__mass *a, const ambulo__mass *b);
/* Writes mass, com and the factors of the inertia. */
void ambulo__mass_factor(const ambulo__mass *mass, ambulo__body *body);

/* Which joints carry which foot, and their rows; frames, joints, bodies, points are compiled.
 * Errors: E_MEMORY. */
ambulo_status ambulo__plan_ground(ambulo__plan *plan, const ambulo_model *model,
                                  double ground_height);
/* Scratch offsets of everything; frames, joints and bodies are complete otherwise. */
void ambulo__plan_place(ambulo__plan *plan);
/* The lists of steps, from all of the above. Errors: E_MEMORY. */
ambulo_status ambulo__plan_steps_build(ambulo__plan *plan);
void ambulo__plan_steps_free(ambulo__plan *plan);
/* The steps in the bodies' own axes; enlarges the scratch. Errors: E_MEMORY. */
ambulo_status ambulo__plan_local_build(ambulo__plan *plan);
void ambulo__plan_local_free(ambulo__plan *plan);
/* The world axis along which a joint slides, -1: it turns, or slides in another direction. */
int ambulo__plan_world_axis(const ambulo__joint *joint);
/* Jacobian pattern. Errors: E_MEMORY. */
ambulo_status ambulo__plan_pattern_build(ambulo__plan *plan);

#endif
