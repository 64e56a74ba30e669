/* contact/swing.h - between which contacts a foot in the air is, and over what. */
#ifndef AMBULO_CONTACT_SWING_H
#define AMBULO_CONTACT_SWING_H

#include "contact/contact_frame.h"

/* The last contact of `foot` that ended by `time`, and the next that begins from it on, as they
 * are in the time of the motion: of one that repeats also those of its other periods, moved on by
 * the travel and, with mirrored ends, to the other side. Returns 1 if it has both; of one alone
 * both become that; 0 if it has none. */
int ambulo__swing_contacts(const ambulo_problem_definition *definition, int foot, double time,
                           ambulo_contact *from, ambulo_contact *to);

/* Which of the definition's contacts one of those is, and in *period how many periods later; -1:
 * none. */
int ambulo__swing_source(const ambulo_problem_definition *definition, const ambulo_contact *image,
                         int *period);

/* The plane that a foot's corners stay above: of the contact at `time`, else of the lower one of
 * those between which it swings, else the level ground. */
ambulo__contact_frame ambulo__surface_below(const ambulo_problem_definition *definition, int foot,
                                            double time);

#endif
