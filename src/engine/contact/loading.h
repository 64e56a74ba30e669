/* contact/loading.h - which contact holds a foot or patch when. */
#ifndef AMBULO_CONTACT_LOADING_H
#define AMBULO_CONTACT_LOADING_H

#include "contact/contact_image.h"

/* 1 if `contact` is active at `time`: from <= time < to, both within 1e-9 s; a contact that
 * ends at `duration` includes it. */
int ambulo__contact_holds(const ambulo_contact *contact, double duration, double time);

/* The uninterrupted contact of an effector around `time`; 0 if it is in the air. */
int ambulo__loaded_span(const ambulo_problem_definition *definition, int effector, double time,
                        ambulo__span *span);
/* The time in the air around `time`: from the last toe-off to the next strike, at most
 * [0, T] if the motion does not repeat. */
ambulo__span ambulo__air_span(const ambulo_problem_definition *definition, int foot, double time);

/* The contact of an effector at `time`, NULL if there is none. */
const ambulo_contact *ambulo__contact_of(const ambulo_problem_definition *definition, int effector,
                                         double time);
/* Just before `time`. */
const ambulo_contact *ambulo__contact_before(const ambulo_problem_definition *definition,
                                             int effector, double time);

#endif
