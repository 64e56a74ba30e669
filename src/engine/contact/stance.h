/* contact/stance.h - how long a foot or a patch is down without interruption, and beside which
 * others.
 */
#ifndef AMBULO_CONTACT_STANCE_H
#define AMBULO_CONTACT_STANCE_H

#include "contact/contact_image.h"

/* Times, s, may lie outside [0, T] in a motion that repeats. */
typedef struct ambulo__stance {
  double from, to; /* infinite where it never came down or leaves: in a motion that repeats
                      if it is down all the time, in another where that begins or ends with it */
  double leaves;   /* those of other feet and patches that hold as it begins: when the first of them
                      ends, at the latest half-way; -infinity: none, or it has no beginning */
  double comes;    /* those that hold as it ends: when the last of them began, at the earliest
                      half-way; infinity: none, or it has no end */
  int leaves_half_way, comes_half_way; /* 1: that is half-way */
  ambulo__span phase;                  /* the part of it in the contact's mode */
  int before, after;                   /* modes of the parts before and after; -1: none */
} ambulo__stance;

/* Of the foot or patch of one of the definition's contacts, at that contact. */
ambulo__stance ambulo__stance_of(const ambulo_problem_definition *definition,
                                 const ambulo_contact *contact);
/* How long one of `modes` holds the foot (a patch: its only one) without interruption, around a
 * contact in one of them; infinite as above. */
ambulo__span ambulo__stance_in(const ambulo_problem_definition *definition,
                               const ambulo_contact *contact, int modes);

#endif
