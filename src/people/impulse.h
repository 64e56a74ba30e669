/* people/impulse.h - integral of the forces on feet and patches over the motion as it is shown. */
#ifndef AMBULO_PEOPLE_IMPULSE_H
#define AMBULO_PEOPLE_IMPULSE_H

#include "problem/nlp.h"

/* impulse [effectors][3] (contact/effector.h; without patches the feet's), N s, world axes: over
 * [0, T], or over the whole stride when its second step is the mirror image (people/stride.h). A
 * motion that is not finite gives numbers that are not. Nothing without ground reaction. Errors:
 * E_MEMORY.
 */
ambulo_status ambulo__impulses(const ambulo_problem *problem, const double *x,
                               const ambulo_allocator *allocator, double *impulse);

#endif
