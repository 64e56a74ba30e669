/* tests/mechanics/contact_fixture.h - random trees on contacts, and the shipped bodies.
 *
 * One to six contacts act on any links: on limbs, on each other's ancestors, on the same link, on
 * massless links, or on the world. From number contact_coupled_cases on, some joints are functions
 * of coordinates. They lie below or beside the centre of mass of their lane. In lane 0 the first
 * contact is alone, in lane 1 the last; in lane 2 none has weight; in lane 3 the weights are of
 * very different sizes. */
#ifndef TESTS_MECHANICS_CONTACT_FIXTURE_H
#define TESTS_MECHANICS_CONTACT_FIXTURE_H

#include <complex.h>

#include "mechanics/lagrangian.h"
#include "kernel_fixture.h"
#include "ambulo/tools/load.h"
#include "mechanics/plan_layout.h"
#include "support/contact_reference.h"

enum {
  contact_coupled_cases = 150,
  contact_case_count = 210,
  contact_max_rows = 240,
  shipped_contact_count = 4
};
enum { alone_first = 0, alone_last = 1, in_flight = 2, uneven = 3 };

static const char *const contact_bodies[shipped_contact_count] = {
    "models/lower_body_18.yaml", "models/yardstick_body.yaml", "models/lower_body_18.yaml",
    "models/lower_body_21.yaml"};

typedef struct contact_case {
  kernel_case body;
  reference_contacts contacts;
  double *ground; /* [3 + 4 K][lanes] */
  int first_row;
} contact_case;

static inline void contact_reference_rows(const contact_case *c, const double *state, int k,
                                          double step, const double *ground, double complex *rows) {
  int d = c->body.d;
  double z[2 * 3 * max_d];
  for (int i = 0; i < 3 * d; i++) {
    z[2 * i] = state[i];
    z[2 * i + 1] = i == k ? step : 0;
  }
  assert_int_equal(contact_reference(c->body.model, &c->contacts, ground, z, z + 2 * d, z + 4 * d,
                                     (double *)rows, c->body.reference_scratch),
                   AMBULO_OK);
}

static inline void contact_ground_of_lane(const contact_case *c, int lane, double *ground) {
  for (int i = 0; i < 3 + 4 * c->contacts.count; i++)
    ground[i] = c->ground[i * AMBULO__LANES + lane];
}

static inline double contact_weight(const contact_case *c, int contact, int lane,
                                    random_source *source) {
  double weight = random_between(source, 0.01, 1);
  switch (lane) {
  case alone_first:
    return contact == 0 ? weight : 0;
  case alone_last:
    return contact == c->contacts.count - 1 ? weight : 0;
  case in_flight:
    return 0;
  case uneven:
    return weight * pow(10, -3 * contact);
  default:
    return weight;
  }
}

static inline void contact_fill(contact_case *c, random_source *source) {
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    const double none[3 + 4 * reference_most_contacts] = {0};
    double state[3 * max_d], *to = c->ground + lane, center[3];
    double complex rows[contact_max_rows];
    case_state(&c->body, lane, state);
    contact_reference_rows(c, state, -1, 0, none, rows);
    for (int i = 0; i < 3; i++) {
      double down = c->body.model->up[i] * random_between(source, -1.1, -0.7);
      center[i] = creal(rows[c->first_row + 6 * c->contacts.count + i]) + down;
      to[i * AMBULO__LANES] = center[i] + random_between(source, -0.2, 0.2);
    }
    for (int k = 0; k < c->contacts.count; k++) {
      double *at = to + (3 + 4 * k) * AMBULO__LANES;
      at[0] = contact_weight(c, k, lane, source);
      for (int i = 0; i < 3; i++) {
        at[(1 + i) * AMBULO__LANES] = center[i] + random_between(source, -0.4, 0.4);
      }
    }
  }
}

/* The feet, and with more contacts than feet any links. */
static inline void contact_choose_links(contact_case *c, random_source *source) {
  const ambulo_model *model = c->body.model;
  for (int k = 0; k < c->contacts.count; k++) {
    c->contacts.link[k] = c->body.number < 0 && k < model->foot_count
                              ? model->points[model->feet[k].heel_center].link
                              : random_below(source, model->link_count);
  }
}

static inline void contact_load(contact_case *c, random_source *source) {
  kernel_case *b = &c->body;
  int number = b->number;
  if (number >= 0) {
    random_tree_make(&b->tree, 37 * (uint64_t)number + 11, 1 + number % 40);
    if (number % 3 == 0 && number % 40 < 30) {
      random_tree_put_on_root(&b->tree, 31 * (uint64_t)number + 2);
    }
    if (number % 3 != 1) random_tree_drive(&b->tree, 7 * (uint64_t)number + 3);
    if (number >= contact_coupled_cases) random_tree_couple(&b->tree, 23 * (uint64_t)number + 7);
    assert_int_equal(ambulo_model_create(&b->tree.definition, NULL, NULL, &b->model), AMBULO_OK);
    c->contacts.count = 1 + number % 6;
  } else {
    const char *path = contact_bodies[-1 - number];
    assert_int_equal(ambulo_model_load(path, NULL, NULL, NULL, &b->model), AMBULO_OK);
    c->contacts.count = number >= -2 ? 2 : 6;
  }
  contact_choose_links(c, source);
  c->contacts.moment_arm = random_between(source, 0.05, 0.3);
  c->contacts.slant = number % 4 == 3 ? 1 : random_between(source, 0.15, 1.2);
}

/* What has no torque cannot have a drive: its joints give theirs back. */
static inline void contact_plan(contact_case *c) {
  kernel_case *b = &c->body;
  for (int undriven = 0; undriven >= 0;) {
    assert_int_equal(ambulo__plan_create_contacts(b->model, c->contacts.link, c->contacts.count,
                                                  creal(c->contacts.moment_arm),
                                                  creal(c->contacts.slant), NULL, &b->plan),
                     AMBULO_OK);
    undriven = ambulo__plan_undriven(b->plan);
    if (undriven < 0) continue;
    ambulo_coordinate *given_back = &b->model->coordinates[undriven];
    given_back->armature = given_back->damping = given_back->friction = 0;
    ambulo__plan_free(b->plan);
  }
}

/* Numbers from 0: random trees; below: the shipped bodies. */
static inline void contact_case_open(contact_case *c, int number) {
  random_source source = {900 + (uint64_t)(number + shipped_contact_count)};
  kernel_case *b = &c->body;
  b->number = number;
  b->model = NULL;
  b->plan = NULL;
  contact_load(c, &source);
  contact_plan(c);
  b->d = ambulo__plan_coordinates(b->plan);
  b->rows = ambulo__plan_rows(b->plan);
  c->first_row = ambulo__plan_first_contact_row(b->plan);
  assert_in_range(b->rows, 1, contact_max_rows);
  assert_in_range(b->d, 1, max_d);
  size_t d = (size_t)b->d;
  b->q = lane_array(d);
  b->qd = lane_array(d);
  b->qdd = lane_array(d);
  b->weights = lane_array((size_t)b->rows);
  b->out = lane_array((size_t)b->rows);
  b->scratch = lane_array(ambulo__plan_scratch(b->plan) / AMBULO__LANES);
  b->reference_scratch = malloc(ambulo__lagrangian_scratch_size(b->model));
  c->ground = lane_array((size_t)ambulo__plan_ground_entries(b->plan));
  assert_non_null(b->reference_scratch);
  int regime = number < 0 ? 1 + (number % 2 == 0) : number % 5;
  for (int i = 0; i < b->d * AMBULO__LANES; i++) {
    b->q[i] = random_pose(&source, regime);
    b->qd[i] = random_between(&source, -0.5, 0.5);
    b->qdd[i] = random_between(&source, -0.5, 0.5);
  }
  for (int i = 0; i < b->rows * AMBULO__LANES; i++) b->weights[i] = random_between(&source, -1, 1);
  contact_fill(c, &source);
}

static inline void contact_case_close(contact_case *c) {
  free(c->ground);
  case_close(&c->body);
}

static inline void contact_forward(contact_case *c, const ambulo__kernels *kernels) {
  case_outputs(&c->body, kernels, c->ground);
}

/* Gradient of the weighted rows, [3][d][lanes]. */
static inline void contact_reverse(contact_case *c, const ambulo__kernels *kernels,
                                   double *gradient) {
  kernel_case *b = &c->body;
  int n = b->d * AMBULO__LANES;
  contact_forward(c, kernels);
  kernels->reverse(b->plan, b->qd, b->qdd, c->ground, b->weights, gradient, gradient + n,
                   gradient + 2 * n, b->scratch);
}

/* Entries in pattern order: by q, by qd, by qdd. */
static inline double *contact_entries(contact_case *c, const ambulo__kernels *kernels) {
  kernel_case *b = &c->body;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(b->plan);
  double *entries = zero_lane_array((size_t)(pattern.count + 2 * pattern.dynamic_count));
  double *jqd = entries + pattern.count * AMBULO__LANES;
  case_forget(b);
  kernels->jacobian(b->plan, b->q, b->qd, b->qdd, c->ground, entries, jqd,
                    jqd + pattern.dynamic_count * AMBULO__LANES, b->scratch);
  return entries;
}

/* Newtons: the weight of the whole body. */
static inline double contact_body_weight(const contact_case *c) {
  const double *g = c->body.model->gravity;
  return c->body.model->mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

/* Dense [3][rows][d] of the reference, in one lane. */
static inline void contact_reference_jacobian(const contact_case *c, int lane, double *jacobian) {
  const double step = 1e-40;
  const kernel_case *b = &c->body;
  double state[3 * max_d], ground[3 + 4 * reference_most_contacts];
  double complex rows[contact_max_rows];
  case_state(b, lane, state);
  contact_ground_of_lane(c, lane, ground);
  for (int k = 0; k < 3 * b->d; k++) {
    contact_reference_rows(c, state, k, step, ground, rows);
    for (int row = 0; row < b->rows; row++) {
      jacobian[(k / b->d * b->rows + row) * b->d + k % b->d] = cimag(rows[row]) / step;
    }
  }
}

/* Groups of rows that are compared on one scale: generalized forces and root wrench, points,
 * contacts, centre of mass; ends exclusive. */
enum { contact_groups = 4 };

static inline void contact_group_ends(const contact_case *c, int ends[contact_groups]) {
  int d = c->body.d, contacts = c->first_row + 6 * c->contacts.count;
  const int all[contact_groups] = {d + 6, c->first_row, contacts, contacts + 3};
  memcpy(ends, all, sizeof all);
}

#endif
