/* contact/effector.c - see effector.h. */
#include "contact/effector.h"
#include "model/model.h"

int ambulo__effector_count(const ambulo_model *model) {
  return model->foot_count + model->patch_count;
}

int ambulo__effector_of(const ambulo_model *model, const ambulo_contact *contact) {
  return contact->foot >= 0 ? contact->foot : model->foot_count + contact->patch;
}

int ambulo__effector_patch(const ambulo_model *model, int effector) {
  return effector < model->foot_count ? -1 : effector - model->foot_count;
}

int ambulo__effector_mirror(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  return patch < 0 ? model->feet[effector].mirror
                   : model->foot_count + model->patches[patch].mirror;
}

const char *ambulo__effector_kind(const ambulo_model *model, int effector) {
  return effector < model->foot_count ? "foot" : "patch";
}

const char *ambulo__effector_name(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  return patch < 0 ? model->feet[effector].name : model->patches[patch].name;
}

int ambulo__effector_is_known(const ambulo_model *model, const ambulo_contact *contact) {
  if (contact->mode == AMBULO_CONTACT_PATCH)
    return contact->foot == -1 && contact->patch >= 0 && contact->patch < model->patch_count;
  return contact->foot >= 0 && contact->foot < model->foot_count;
}

int ambulo__patch_is_used(const ambulo_problem_definition *d, int patch) {
  int mirror = d->ends == AMBULO_ENDS_MIRRORED ? d->model->patches[patch].mirror : patch;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (c->foot < 0 && (c->patch == patch || c->patch == mirror)) return 1;
  }
  return 0;
}

int ambulo__holds_patches(const ambulo_problem_definition *d) {
  for (int i = 0; i < d->contact_count; i++)
    if (d->contacts[i].foot < 0) return 1;
  return 0;
}
