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

/* What the body stands on. */
typedef struct ambulo__footing {
  int count;                       /* of contacts; 0: it is in the air */
  int link[AMBULO__MOST_CONTACTS]; /* on which they act */
  double moment_arm, slant;
} ambulo__footing;

/* Which joints carry which contact, and their rows; frames, joints, bodies, points are compiled.
 * Errors: E_MEMORY. */
ambulo_status ambulo__plan_carriers(ambulo__plan *plan, const ambulo__footing *footing,
                                    const ambulo__placing *placings);
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
/* On contacts (plan_contacts.c): what the factors behind the entries are, and the vectors that the
 * kernels keep at plan->contacts_at. */
void ambulo__plan_contact_factors(ambulo__plan *plan);
int ambulo__plan_contact_parts(const ambulo__plan *plan, int row, ambulo__row_part *part);
int ambulo__plan_contact_entries(const ambulo__plan *plan);
/* Jacobian pattern. Errors: E_MEMORY. */
ambulo_status ambulo__plan_pattern_build(ambulo__plan *plan);

#endif
