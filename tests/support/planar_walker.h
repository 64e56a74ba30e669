/* tests/support/planar_walker.h - seven links in the sagittal plane, one mirrored step.
 *
 * Root: forward, up, tilt; on each side hip, knee, ankle about z (right). Feet have one heel
 * and one toe point. The motion is made up of sines: it looks like walking and satisfies
 * nothing. */
#ifndef AMBULO_TESTS_PLANAR_WALKER_H
#define AMBULO_TESTS_PLANAR_WALKER_H

#include "ambulo/ambulo.h"

#include <math.h>
#include <string.h>

enum { WALKER_LINKS = 10, WALKER_COORDINATES = 9, WALKER_POINTS = 5 };

static const double walker_pi = 3.14159265358979323846;
static const double walker_step_time = 0.55, walker_step_length = 0.7;

static inline ambulo_link planar_walker_link(const char *name, int parent, ambulo_joint_type type,
                                             double theta, double a, double alpha, double mass) {
  ambulo_link link = ambulo_link_default();
  link.name = name;
  link.parent = parent;
  link.type = type;
  link.theta = theta;
  link.a = a;
  link.alpha = alpha;
  link.mass = mass;
  if (mass > 0.0) {
    link.com[0] = -0.5 * a;
    for (int i = 0; i < 3; i++) link.inertia[i] = 0.02 * mass;
  }
  return link;
}

static inline ambulo_model *planar_walker_create(void) {
  static const char *const names[WALKER_COORDINATES] = {
      "pelvis_tx",     "pelvis_ty",     "pelvis_tilt",  "hip_flexion_r", "knee_angle_r",
      "ankle_angle_r", "hip_flexion_l", "knee_angle_l", "ankle_angle_l"};
  const double quarter = walker_pi / 2.0;
  ambulo_link links[WALKER_LINKS] = {
      planar_walker_link("ground", -1, AMBULO_FIXED, quarter, 0.0, quarter, 0.0),
      planar_walker_link("forward", 0, AMBULO_PRISMATIC, -quarter, 0.0, -quarter, 0.0),
      planar_walker_link("up", 1, AMBULO_PRISMATIC, -quarter, 0.0, quarter, 0.0),
      planar_walker_link("trunk", 2, AMBULO_REVOLUTE, 0.0, 0.0, 0.0, 45.0),
      planar_walker_link("thigh_r", 3, AMBULO_REVOLUTE, -quarter, 0.41, 0.0, 8.0),
      planar_walker_link("shank_r", 4, AMBULO_REVOLUTE, 0.0, 0.43, 0.0, 3.5),
      planar_walker_link("foot_r", 5, AMBULO_REVOLUTE, quarter, 0.0, 0.0, 1.2),
      planar_walker_link("thigh_l", 3, AMBULO_REVOLUTE, -quarter, 0.41, 0.0, 8.0),
      planar_walker_link("shank_l", 7, AMBULO_REVOLUTE, 0.0, 0.43, 0.0, 3.5),
      planar_walker_link("foot_l", 8, AMBULO_REVOLUTE, quarter, 0.0, 0.0, 1.2)};
  links[3].com[1] = 0.3;
  ambulo_coordinate coordinates[WALKER_COORDINATES];
  for (int i = 0; i < WALKER_COORDINATES; i++) {
    coordinates[i] = ambulo_coordinate_default();
    coordinates[i].name = names[i];
    coordinates[i].type = i < 2 ? AMBULO_PRISMATIC : AMBULO_REVOLUTE;
    coordinates[i].actuated = i >= 3;
    coordinates[i].mirror = i < 3 ? i : i < 6 ? i + 3 : i - 3;
  }
  const ambulo_point points[WALKER_POINTS] = {{"head_top", 3, {0.0, 0.8, 0.0}},
                                              {"right_heel", 6, {-0.05, -0.06, 0.0}},
                                              {"right_toe", 6, {0.16, -0.06, 0.0}},
                                              {"left_heel", 9, {-0.05, -0.06, 0.0}},
                                              {"left_toe", 9, {0.16, -0.06, 0.0}}};
  const ambulo_foot feet[2] = {{"right", {1, -1}, {2, -1}, 1, 2, 1, .tip = -1},
                               {"left", {3, -1}, {4, -1}, 3, 4, 0, .tip = -1}};
  ambulo_model_definition definition = ambulo_model_definition_default();
  definition.name = "planar_walker";
  definition.links = links;
  definition.link_count = WALKER_LINKS;
  definition.coordinates = coordinates;
  definition.coordinate_count = WALKER_COORDINATES;
  definition.points = points;
  definition.point_count = WALKER_POINTS;
  definition.feet = feet;
  definition.foot_count = 2;
  ambulo_model *model = NULL;
  if (ambulo_model_create(&definition, NULL, NULL, &model)) return NULL;
  return model;
}

/* One mirrored step with contact rows; NULL if it is refused. */
static inline ambulo_problem *walker_problem_on(const ambulo_model *model, int intervals,
                                                ambulo_grid grid) {
  const ambulo_gait gait = {.size = sizeof(ambulo_gait),
                            .contact_size = sizeof(ambulo_contact),
                            .steps = 1,
                            .step_length = walker_step_length,
                            .step_time = walker_step_time,
                            .foot_flat = 0.08,
                            .heel_off = 0.38,
                            .toe_off = 0.62,
                            .other_step_length = AMBULO_OFF,
                            .other_step_time = AMBULO_OFF};
  ambulo_contact contacts[12];
  ambulo_problem_definition definition = ambulo_problem_definition_default();
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  if (ambulo_gait_expand(model, &gait, contacts, 12, &definition.contact_count)) return NULL;
  definition.name = "planar step";
  definition.model = model;
  definition.duration = walker_step_time;
  definition.intervals = intervals;
  definition.grid = grid;
  definition.contacts = contacts;
  definition.ground_penetration = definition.foot_strike = 1;
  definition.ends = AMBULO_ENDS_MIRRORED;
  definition.travel = walker_step_length;
  definition.terms = &term;
  definition.term_count = 1;
  ambulo_problem *problem = NULL;
  if (ambulo_problem_create(&definition, NULL, NULL, &problem)) return NULL;
  return problem;
}

static inline ambulo_problem *walker_problem(const ambulo_model *model, int intervals) {
  return walker_problem_on(model, intervals, AMBULO_GRID_UNIFORM);
}

/* Control points (as values at their times) of something like walking. */
static inline void walker_point(const ambulo_problem *problem, double *x) {
  int count = ambulo_problem_control_point_count(problem);
  for (int c = 0; c < count; c++) {
    double *q = x + WALKER_COORDINATES * c;
    double t = walker_step_time * (double)c / (double)(count - 1);
    q[0] = walker_step_length * t / walker_step_time - 0.12;
    q[1] = 0.865 - 0.02 * cos(2.0 * walker_pi * t / walker_step_time);
    q[2] = -0.05;
    for (int side = 0; side < 2; side++) {
      double phase = 2.0 * walker_pi * (t / (2.0 * walker_step_time) + (side ? 0.5 : 0.0));
      q[3 + 3 * side] = 0.14 + 0.42 * cos(phase + 0.2);
      q[4 + 3 * side] = -0.36 - 0.28 * cos(phase - 4.5) - 0.16 * cos(2.0 * phase - 8.9);
      q[5 + 3 * side] = 0.02 + 0.18 * sin(2.0 * phase - 1.9) - 0.06 * cos(phase);
    }
  }
}

#endif
