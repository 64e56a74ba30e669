/* tests/support/arm.h - a two-link arm in a vertical plane, built in code.
 *
 * Both links 1 revolute coordinate about world z, lengths l1, l2 along their x axes,
 * gravity -9.81 along y. Point masses would do; real inertias are used. */
#ifndef AMBULO_TESTS_ARM_H
#define AMBULO_TESTS_ARM_H

#include "ambulo/ambulo.h"

#include <math.h>

enum { ARM_COORDINATES = 2 };

static inline ambulo_model *arm_create(void) {
  ambulo_link links[2] = {ambulo_link_default(), ambulo_link_default()};
  ambulo_coordinate coordinates[2] = {ambulo_coordinate_default(), ambulo_coordinate_default()};
  ambulo_point points[2] = {{"hand", 1, {0.0, 0.0, 0.0}}, {"forearm", 1, {-0.2, 0.05, 0.0}}};
  const char *names[2] = {"upper", "lower"}, *joints[2] = {"shoulder", "elbow"};
  for (int i = 0; i < 2; i++) {
    links[i].name = names[i];
    links[i].parent = i - 1;
    links[i].type = AMBULO_REVOLUTE;
    links[i].a = i ? 0.25 : 0.3;
    links[i].mass = i ? 1.5 : 2.0;
    links[i].com[0] = i ? -0.12 : -0.16;
    links[i].inertia[0] = 0.002;
    links[i].inertia[1] = 0.015;
    links[i].inertia[2] = 0.016;
    coordinates[i].name = joints[i];
    coordinates[i].type = AMBULO_REVOLUTE;
    coordinates[i].range[0] = -2.0;
    coordinates[i].range[1] = 2.5;
    coordinates[i].speed[0] = -8.0;
    coordinates[i].speed[1] = 8.0;
    coordinates[i].torque[0] = -30.0;
    coordinates[i].torque[1] = 30.0;
    coordinates[i].mirror = i;
  }
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "arm";
  definition.links = links;
  definition.link_count = 2;
  definition.coordinates = coordinates;
  definition.coordinate_count = 2;
  definition.points = points;
  definition.point_count = 2;
  ambulo_model *model = NULL;
  if (ambulo_model_create(&definition, NULL, NULL, &model)) return NULL;
  return model;
}

/* A swing from rest to rest in one second, torque squared, every limit on. */
static inline ambulo_problem_definition arm_definition(const ambulo_model *model) {
  static const ambulo_end_value ends[] = {{0, 0, 0, -1.2}, {1, 0, 0, 0.3}, {0, 1, 0, 0.0},
                                          {1, 1, 0, 0.0},  {0, 0, 1, 0.4}, {1, 0, 1, 1.1},
                                          {0, 1, 1, 0.0},  {1, 1, 1, 0.0}};
  static ambulo_term term;
  term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  ambulo_problem_definition definition = ambulo_problem_definition_default();
  definition.name = "swing";
  definition.model = model;
  definition.intervals = 10;
  definition.joint_limits = AMBULO_LIMIT_NODES;
  definition.speed_limits = definition.torque_limits = 1;
  definition.end_values = ends;
  definition.end_value_count = (int)(sizeof ends / sizeof *ends);
  definition.terms = &term;
  definition.term_count = 1;
  return definition;
}

/* A smooth deterministic point with no special structure. */
static inline void arm_point(double *x, int n, double amplitude) {
  for (int i = 0; i < n; i++) x[i] = amplitude * sin(1.0 + 1.7 * i);
}

#endif
