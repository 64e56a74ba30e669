/* tests/identities/point_masses.h - a branched tree whose bodies are six point masses each.
 *
 * Body b of mass m has a mass of m/6 at each of its six ends, +-r along the link's axes about
 * its centre of mass, so its inertia is diagonal with I_xx = (m/3)(r_y^2 + r_z^2). The ends are
 * points of the model: linear and angular momentum and energy of the whole body then follow
 * from positions alone, by numerical differentiation, without any of the formulas under test. */
#ifndef AMBULO_TESTS_POINT_MASSES_H
#define AMBULO_TESTS_POINT_MASSES_H

#include "ambulo/ambulo.h"
#include "support/test.h"

enum { masses_joints = 5, masses_ends = 6 * masses_joints };

static const double masses_gravity[3] = {0.4, -9.7, 0.3};
static const double masses_ground = -1.2; /* m along up */

/* mass of the body that end `k` belongs to, divided by six */
static inline double masses_of_end(int k) {
  return (1.5 + 0.8 * (k / 6)) / 6.0;
}

static inline ambulo_link masses_link(int i) {
  /* the second angle is nearly a right one, which must not be taken for one */
  static const double theta[] = {0.3, -0.7, 1.1, 0.0, 0.5},
                      alpha[] = {1.2, -1.5707963, 0.4, 2.0, 0.0};
  static const double a[] = {0.2, 0.3, 0.0, 0.25, 0.1}, d[] = {0.1, 0.0, -0.15, 0.05, 0.0};
  static const char *const names[] = {"a", "b", "c", "d", "e"};
  ambulo_link link = ambulo_link_default();
  link.name = names[i];
  link.parent = i == 3 ? 1 : i - 1; /* the fourth branches off the second */
  link.type = i == 2 ? AMBULO_PRISMATIC : AMBULO_REVOLUTE;
  link.theta = theta[i];
  link.d = d[i];
  link.a = a[i];
  link.alpha = alpha[i];
  link.mass = 6.0 * masses_of_end(6 * i);
  link.com[0] = -0.1 + 0.03 * i;
  link.com[1] = 0.05 * i;
  link.com[2] = 0.02;
  return link;
}

static inline ambulo_model *masses_create(void) {
  static const double reach[3] = {0.05, 0.11, 0.08};
  static const char *const joints[] = {"q0", "q1", "q2", "q3", "q4"};
  ambulo_link links[masses_joints];
  ambulo_coordinate coordinates[masses_joints];
  ambulo_point points[masses_ends];
  char names[masses_ends][8];
  for (int i = 0; i < masses_joints; i++) {
    links[i] = masses_link(i);
    coordinates[i] = ambulo_coordinate_default();
    coordinates[i].name = joints[i];
    coordinates[i].type = links[i].type;
    coordinates[i].mirror = i;
    for (int u = 0; u < 3; u++) {
      double v = reach[(u + 1) % 3], w = reach[(u + 2) % 3];
      links[i].inertia[u] = links[i].mass / 3.0 * (v * v + w * w);
    }
    for (int e = 0; e < 6; e++) {
      int k = 6 * i + e;
      snprintf(names[k], sizeof names[k], "p%d", k);
      points[k] = (ambulo_point){names[k], i, {links[i].com[0], links[i].com[1], links[i].com[2]}};
      points[k].position[e / 2] += e % 2 ? reach[e / 2] : -reach[e / 2];
    }
  }
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "point masses";
  definition.links = links;
  definition.link_count = definition.coordinate_count = masses_joints;
  definition.coordinates = coordinates;
  definition.points = points;
  definition.point_count = masses_ends;
  memcpy(definition.gravity, masses_gravity, sizeof masses_gravity);
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&definition, NULL, NULL, &model), AMBULO_OK);
  return model;
}

/* a smooth motion and its exact derivatives */
static inline void masses_motion(double t, double *q, double *qd, double *qdd) {
  for (int i = 0; i < masses_joints; i++) {
    double rate = 1.3 + 0.4 * i, phase = 0.9 * i;
    q[i] = 0.6 * sin(rate * t + phase) + 0.1 * i;
    qd[i] = 0.6 * rate * cos(rate * t + phase);
    qdd[i] = -0.6 * rate * rate * sin(rate * t + phase);
  }
}

#endif
