/* contact/contact_image.h - contacts of a motion that repeats, beyond its ends. */
#ifndef AMBULO_CONTACT_CONTACT_IMAGE_H
#define AMBULO_CONTACT_CONTACT_IMAGE_H

#include "ambulo/problem.h"

typedef struct ambulo__span {
  double from, to;  /* s; may lie outside [0, T] where the motion repeats */
  int begins, ends; /* the contact with whose start or end the span begins, and ends; -1: none.
                       Loaded: its `from`, `to`; in the air: its `to`, `from` */
} ambulo__span;

/* How many periods before and after are looked at; 0 for a motion that does not repeat. */
int ambulo__image_periods(const ambulo_problem_definition *definition);
/* The effector of contact `index` (contact/effector.h), `period` periods later; when that holds;
 * and all of it then. */
int ambulo__image_effector(const ambulo_problem_definition *definition, int index, int period);
ambulo__span ambulo__image_span(const ambulo_problem_definition *definition, int index, int period);
ambulo_contact ambulo__contact_image(const ambulo_problem_definition *definition, int index,
                                     int period);

/* Sets of modes: 1 << mode, added. */
enum {
  AMBULO__ANY_MODE = 1 << AMBULO_CONTACT_HEEL | 1 << AMBULO_CONTACT_FLAT | 1 << AMBULO_CONTACT_TOE |
                     1 << AMBULO_CONTACT_PATCH
};

/* A span of contact of an effector, made as long as contacts in one of `modes` touch it. */
ambulo__span ambulo__uninterrupted(const ambulo_problem_definition *definition, int effector,
                                   int modes, ambulo__span span);

#endif
