/* tests/support/walker_fixture.h - a biped simple enough to compute by hand.
 *
 * World: x forward, y up, z right (left = -z), g = 9.81. Root translations pelvis_tz,
 * pelvis_ty, pelvis_tx, then per leg a hip and a knee that turn about z. At q = 0 the hips
 * are at height 0.92 m and the soles on the ground; in the shank frame x is up, y backward,
 * z right. Legs: thigh and shank 0.42 m, sole 0.08 m below the ankle; heel 0.05 m behind,
 * toe 0.17 m ahead of it; 0.08 m wide. Mass 50 + 2 (7 + 4) = 72 kg.
 * planar: no pelvis_tz, both legs in the plane z = 0, one corner at each end of a foot. */
#ifndef AMBULO_TESTS_WALKER_FIXTURE_H
#define AMBULO_TESTS_WALKER_FIXTURE_H

#include "ambulo/model.h"
#include "support/test.h"

enum { WALKER_RIGHT = 0, WALKER_LEFT = 1 };

#define WALKER_PI 3.14159265358979323846

static inline ambulo_link walker_link(const char *name, int parent, ambulo_joint_type type,
                                      double theta, double d, double a, double alpha) {
  ambulo_link link = ambulo_link_default();
  link.name = name;
  link.parent = parent;
  link.type = type;
  link.theta = theta;
  link.d = d;
  link.a = a;
  link.alpha = alpha;
  return link;
}

static inline void walker_body(ambulo_link *link, double mass, double com_x) {
  link->mass = mass;
  link->com[0] = com_x;
  for (int i = 0; i < 3; i++) link->inertia[i] = 0.01 * mass;
}

static inline ambulo_coordinate walker_coordinate(const char *name, ambulo_joint_type type,
                                                  int mirror, double sign) {
  ambulo_coordinate c = ambulo_coordinate_default();
  c.name = name;
  c.type = type;
  c.mirror = mirror;
  c.mirror_sign = sign;
  return c;
}

/* six points of one foot: heel and toe centre, heel and toe corners (inner, outer) */
static inline void walker_foot_points(ambulo_point *points, int link, int planar,
                                      const char *const names[6]) {
  static const double place[6][3] = {{-0.08, 0.05, 0.0},    {-0.08, -0.17, 0.0},
                                     {-0.08, 0.05, -0.04},  {-0.08, 0.05, 0.04},
                                     {-0.08, -0.17, -0.04}, {-0.08, -0.17, 0.04}};
  for (int i = 0; i < 6; i++) {
    points[i].name = names[i];
    points[i].link = link;
    for (int axis = 0; axis < 3; axis++) points[i].position[axis] = place[i][axis];
    if (planar) points[i].position[2] = 0.0;
  }
}

static inline ambulo_foot walker_foot(const char *name, int first, int planar, int mirror) {
  ambulo_foot foot = {.name = name,
                      .heel = {first + 2, planar ? -1 : first + 3},
                      .toe = {first + 4, planar ? -1 : first + 5},
                      .heel_center = first,
                      .toe_center = first + 1,
                      .mirror = mirror};
  return foot;
}

/* fails the test when the model is refused */
static inline ambulo_model *walker_create(int planar) {
  static const char *const right[6] = {"r_heel",     "r_toe",    "r_heel_in",
                                       "r_heel_out", "r_toe_in", "r_toe_out"};
  static const char *const left[6] = {"l_heel",     "l_toe",    "l_heel_in",
                                      "l_heel_out", "l_toe_in", "l_toe_out"};
  double half = planar ? 0.0 : 0.09, quarter = 0.5 * WALKER_PI;
  ambulo_joint_type sideways = planar ? AMBULO_FIXED : AMBULO_PRISMATIC;
  ambulo_link links[] = {walker_link("side", -1, sideways, 0, 0, 0, -quarter),
                         walker_link("up", 0, AMBULO_PRISMATIC, quarter, 0.92, 0, quarter),
                         walker_link("pelvis", 1, AMBULO_PRISMATIC, quarter, 0, 0, -quarter),
                         walker_link("thigh_r", 2, AMBULO_REVOLUTE, 0, half, -0.42, 0),
                         walker_link("shank_r", 3, AMBULO_REVOLUTE, 0, 0, -0.42, 0),
                         walker_link("thigh_l", 2, AMBULO_REVOLUTE, 0, -half, -0.42, 0),
                         walker_link("shank_l", 5, AMBULO_REVOLUTE, 0, 0, -0.42, 0)};
  walker_body(&links[2], 50.0, 0.2);
  for (int leg = 3; leg <= 5; leg += 2) {
    walker_body(&links[leg], 7.0, 0.2);
    walker_body(&links[leg + 1], 4.0, 0.2);
  }
  int skip = planar ? 1 : 0;
  ambulo_coordinate coordinates[] = {
      walker_coordinate("pelvis_tz", AMBULO_PRISMATIC, 0, -1.0),
      walker_coordinate("pelvis_ty", AMBULO_PRISMATIC, 1 - skip, 1.0),
      walker_coordinate("pelvis_tx", AMBULO_PRISMATIC, 2 - skip, 1.0),
      walker_coordinate("hip_r", AMBULO_REVOLUTE, 5 - skip, 1.0),
      walker_coordinate("knee_r", AMBULO_REVOLUTE, 6 - skip, 1.0),
      walker_coordinate("hip_l", AMBULO_REVOLUTE, 3 - skip, 1.0),
      walker_coordinate("knee_l", AMBULO_REVOLUTE, 4 - skip, 1.0)};
  coordinates[4].range[0] = -2.0;
  coordinates[4].range[1] = 0.1;
  coordinates[3].range[1] = 1.5;
  coordinates[3].speed[0] = -8.0;
  coordinates[3].torque[1] = 120.0;
  ambulo_point points[12];
  walker_foot_points(points, 4, planar, right);
  walker_foot_points(points + 6, 6, planar, left);
  ambulo_foot feet[] = {walker_foot("right", 0, planar, 1), walker_foot("left", 6, planar, 0)};
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "walker";
  definition.links = links;
  definition.link_count = 7;
  definition.coordinates = coordinates + skip;
  definition.coordinate_count = 7 - skip;
  definition.points = points;
  definition.point_count = 12;
  definition.feet = feet;
  definition.foot_count = 2;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &model), AMBULO_OK);
  return model;
}

#endif
