/* contact/effector.h - what of a body touches its surroundings: feet and patches, in one numbering.
 *
 * Effector e < foot_count is foot e, those behind are the patches in the model's order. */
#ifndef AMBULO_CONTACT_EFFECTOR_H
#define AMBULO_CONTACT_EFFECTOR_H

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

#endif
