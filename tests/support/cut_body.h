/* tests/support/cut_body.h - a body that comes apart at a joint, along massless sliders.
 *
 * The generalized forces of three sliders that stand still are the force that holds what lies below
 * them: inverse dynamics of a tree with three links more find it without joint_contact.c. */
#ifndef AMBULO_TESTS_CUT_BODY_H
#define AMBULO_TESTS_CUT_BODY_H

#include "ambulo/mechanics.h"
#include "people/joint_contact.h"
#include "support/test.h"

enum { CUT_LINKS = 128 };

/* four links behind `axes` that slide along its z, y and x and leave its frame as it is:
 * Rot_x(-90), Rot_z(90) Rot_x(90), Rot_x(-90), Rot_z(-90) Rot_x(90) multiply to 1. */
static inline void slider(ambulo_link *link, const char *name, int parent, ambulo_joint_type type,
                          double theta, double alpha) {
  const double quarter = 0.5 * acos(-1.0);
  *link = ambulo_link_default();
  link->name = name;
  link->parent = parent;
  link->type = type;
  link->theta = theta * quarter;
  link->alpha = alpha * quarter;
}

/* the model with sliders cut_z, cut_y, cut_x between `axes` and its child on the way to `link` */
static inline ambulo_model *cut_open(const ambulo_model *model, int link, int axes) {
  static ambulo_link links[CUT_LINKS];
  static ambulo_coordinate coordinates[CUT_LINKS];
  static ambulo_point points[CUT_LINKS];
  static const char *const names[] = {"cut_z", "cut_y", "cut_x", "cut"};
  const int n = ambulo_model_link_count(model), d = ambulo_model_coordinate_count(model);
  ambulo_model_definition definition = ambulo_model_definition_default();
  ambulo_model *opened = NULL;
  assert_true(n + 4 <= CUT_LINKS);
  for (int i = 0; i < n; i++) links[i] = *ambulo_model_link(model, i);
  for (int i = 0; i < d; i++) coordinates[i] = *ambulo_model_coordinate(model, i);
  for (int i = 0; i < ambulo_model_point_count(model); i++)
    points[i] = *ambulo_model_point(model, i);
  while (links[link].parent != axes) link = links[link].parent;
  links[link].parent = n + 3;
  slider(&links[n], names[0], axes, AMBULO_PRISMATIC, 0, -1);
  slider(&links[n + 1], names[1], n, AMBULO_PRISMATIC, 1, 1);
  slider(&links[n + 2], names[2], n + 1, AMBULO_PRISMATIC, 0, -1);
  slider(&links[n + 3], names[3], n + 2, AMBULO_FIXED, -1, 1);
  for (int k = 0; k < 3; k++) {
    coordinates[d + k] = ambulo_coordinate_default();
    coordinates[d + k].name = names[k];
    coordinates[d + k].type = AMBULO_PRISMATIC;
  }
  memcpy(definition.gravity, ambulo_model_gravity(model), sizeof definition.gravity);
  memcpy(definition.forward, ambulo_model_forward(model), sizeof definition.forward);
  definition.links = links;
  definition.link_count = n + 4;
  definition.coordinates = coordinates;
  definition.coordinate_count = d + 3;
  definition.points = points;
  definition.point_count = ambulo_model_point_count(model);
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &opened), AMBULO_OK);
  return opened;
}

/* forces along x, y, z of `axes` on what lies below, less the ground's, by the sliders */
static inline void by_sliders(const ambulo_model *model, const ambulo__cut *cut, const double *q,
                              const double *qd, const double *qdd, const double *grf,
                              double out[3]) {
  static const char *const names[] = {"cut_x", "cut_y", "cut_z"};
  static double state[3][CUT_LINKS], tau[CUT_LINKS];
  ambulo_model *opened = cut_open(model, cut->link, cut->axes);
  const int d = ambulo_model_coordinate_count(opened), points = ambulo_model_point_count(opened);
  double *by_q = calloc((size_t)(3 * points * d + 1), sizeof *by_q);
  const double *const given[] = {q, qd, qdd};
  memset(state, 0, sizeof state);
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    int to = ambulo_model_find_coordinate(opened, ambulo_model_coordinate(model, i)->name);
    for (int k = 0; k < 3; k++) state[k][to] = given[k][i];
  }
  ambulo_mechanics *mechanics = NULL;
  ambulo_outputs outputs = ambulo_outputs_default();
  ambulo_jacobians jacobians = ambulo_jacobians_default();
  outputs.tau = tau;
  jacobians.points_q = by_q;
  assert_int_equal(ambulo_mechanics_create(opened, NULL, &mechanics), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(mechanics, 1, state[0], state[1], state[2], &outputs),
      AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_jacobians(mechanics, 1, state[0], state[1], state[2], &jacobians),
      AMBULO_OK);
  for (int k = 0; k < 3; k++) {
    int column = ambulo_model_find_coordinate(opened, names[k]);
    out[k] = tau[column];
    for (int f = 0; grf && f < ambulo_model_foot_count(model); f++) {
      int point = ambulo_model_foot(model, f)->heel_center;
      for (int w = 0; w < 3; w++) out[k] -= by_q[(3 * point + w) * d + column] * grf[3 * f + w];
    }
  }
  ambulo_mechanics_free(mechanics);
  free(by_q);
  ambulo_model_free(opened);
}

#endif
