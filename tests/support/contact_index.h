/* support/contact_index.h - which contact of a foot or a patch is active at a time. */
#ifndef TEST_CONTACT_INDEX_H
#define TEST_CONTACT_INDEX_H

#include "contact/contacts.h"
#include "problem/nlp.h"

/* index of the contact; -1: none */
static inline int effector_contact_index_at(const ambulo_problem *p, int effector, double time) {
  const ambulo_contact *contact = ambulo__contact_of(&p->definition, effector, time);
  return contact ? (int)(contact - p->definition.contacts) : -1;
}

static inline int contact_index_at(const ambulo_problem *p, int foot, double time) {
  return effector_contact_index_at(p, foot, time);
}

static inline int patch_contact_index_at(const ambulo_problem *p, int patch, double time) {
  return effector_contact_index_at(p, p->model->foot_count + patch, time);
}

#endif
