/* contact/contacts.h - what of a body touches its surroundings: feet and patches, in one numbering.
 *
 * Effector e < foot_count is foot e, those behind are the patches in the model's order. */
#ifndef AMBULO_CONTACT_CONTACTS_H
#define AMBULO_CONTACT_CONTACTS_H

#include "ambulo/problem.h"

int ambulo__effector_count(const ambulo_model *model);
/* Of a contact of a foot or a patch that the model has. */
int ambulo__effector_of(const ambulo_model *model, const ambulo_contact *contact);
/* The model's patch, or -1: a foot. */
int ambulo__effector_patch(const ambulo_model *model, int effector);
/* What takes its place in the mirror image. */
int ambulo__effector_mirror(const ambulo_model *model, int effector);
/* "foot" or "patch"; its name. */
const char *ambulo__effector_kind(const ambulo_model *model, int effector);
const char *ambulo__effector_name(const ambulo_model *model, int effector);

/* 1 if the model has the foot or the patch that a contact names. */
int ambulo__effector_is_known(const ambulo_model *model, const ambulo_contact *contact);
/* 1 if some contact is of that patch or, with mirrored ends, of its mirror image. */
int ambulo__patch_is_used(const ambulo_problem_definition *definition, int patch);
/* 1 if some contact is of a patch. */
int ambulo__holds_patches(const ambulo_problem_definition *definition);

/* contacts of a motion that repeats, beyond its ends. */

typedef struct ambulo__span {
  double from, to;  /* s; may lie outside [0, T] where the motion repeats */
  int begins, ends; /* the contact with whose start or end the span begins, and ends; -1: none.
                       Loaded: its `from`, `to`; in the air: its `to`, `from` */
} ambulo__span;

/* How many periods before and after are looked at; 0 for a motion that does not repeat. */
int ambulo__image_periods(const ambulo_problem_definition *definition);
/* The effector of contact `index` (contact/contacts.h), `period` periods later; when that holds;
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

/* which contact holds a foot or patch when. */

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
