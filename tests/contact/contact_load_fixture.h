/* tests/contact/contact_load_fixture.h - a walker whose contacts share the load. */
#ifndef TESTS_CONTACT_CONTACT_LOAD_FIXTURE_H
#define TESTS_CONTACT_CONTACT_LOAD_FIXTURE_H

#include "contact/contacts.h"
#include "support/patched_walker.h"
#include "support/toed_body.h"
#include "support/walker_fixture.h"

/* What the law that shares the load is told of contacts: a stride of 1 s, phases 0 / 0.1 / 0.4 /
 * 0.6 of it, left strikes at 0. Double support from 0 to 0.1 s and from 0.5 to 0.6 s. Walker: heel
 * to toe 0.22 m, no joint of the toes. */

typedef struct test_contact_load_fixture {
  ambulo_model *model;
  ambulo_contact contacts[12];
  ambulo_problem_definition definition;
  ambulo__foot_outline outlines[2];
  ambulo__slots slots;
} test_contact_load_fixture;

static inline void test_contact_load_open_with(test_contact_load_fixture *f, ambulo_model *model,
                                               int steps) {
  f->model = model;
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = steps,
                      .first_foot = WALKER_LEFT,
                      .step_length = 0.6,
                      .step_time = 0.5,
                      .step_width = 0.18,
                      .foot_flat = 0.1,
                      .heel_off = 0.4,
                      .toe_off = 0.6,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.duration = 0.5 * steps;
  f->definition.ends = steps % 2 ? AMBULO_ENDS_MIRRORED : AMBULO_ENDS_PERIODIC;
  f->definition.travel = 0.6 * steps;
  f->definition.contacts = f->contacts;
  assert_int_equal(
      ambulo_gait_expand(f->model, &gait, f->contacts, 12, &f->definition.contact_count), 0);
  for (int i = 0; i < 2; i++) f->outlines[i] = ambulo__foot_outline_of(f->model, i);
  f->slots = ambulo__slots_of(&f->definition);
}

static inline void close_it(test_contact_load_fixture *f) {
  ambulo_model_free(f->model);
}

static inline ambulo__contact_load load_at(const test_contact_load_fixture *f, int slot,
                                           double time) {
  return ambulo__contact_load_at(&f->definition, f->outlines, &f->slots, slot, NULL, time);
}

static inline double smooth(double u) {
  return u * u * (3.0 - 2.0 * u);
}

#endif
