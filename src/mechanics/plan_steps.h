/* mechanics/plan_steps.h - the program that the kernels run: lists of equal
 * steps.
 *
 * Walking a tree means a decision at every joint, and decisions cost more than
 * the arithmetic between them. So a plan is laid out as lists, one for each
 * kind of step; a kernel is a sequence of loops without branches. Integers are
 * offsets in doubles: into the scratch, or for input, output and entry into the
 * [entry][lane] arrays of the caller.
 */
#ifndef AMBULO_MECHANICS_PLAN_STEPS_H
#define AMBULO_MECHANICS_PLAN_STEPS_H

#include "mechanics/plan.h"

/* angle = sign * q + shift of a revolute joint. */
typedef struct ambulo__angle_step {
  int input, output;
  double sign, shift;
} ambulo__angle_step;

/* Columns first..2 of a frame with a constant rotation, by rows, put after its
 * parent. */
typedef struct ambulo__turn_step {
  int from[3], to[3], first;
  double turn[9];
} ambulo__turn_step;

/* A revolute joint; see ambulo__frame for what the offsets are. */
typedef struct ambulo__hinge_step {
  int turn; /* step to run before, -1: none */
  int angle, input, axis;
  int from[2], to[2]; /* columns */
  int rate_from, rate_to;
  double sign, shift;
  int place, velocity, motion;
} ambulo__hinge_step;

/* An origin that moves: the offset of a revolute joint, or a prismatic joint.
 */
typedef struct ambulo__origin_step {
  int prismatic, still; /* still: the parent's orientation is constant */
  int input, axis;      /* prismatic */
  double sign;
  double offset[3]; /* in the parent's columns */
  int columns[3];
  int place_from, place_to, rate;
  int velocity_from, velocity_to, motion;
} ambulo__origin_step;

typedef struct ambulo__body {
  int frame;
  double mass;
  double com[3]; /* in the frame */
  /* inertia about the centre of mass = base 1 + first u u' + second w w', with
   * u = (1, lower[0], lower[1]), w = (0, 1, lower[2]) in the frame's axes in
   * this order */
  double base, first, second, lower[3];
  int order[3];
  int diagonal; /* lower = 0 */
  int columns[3], ordered[3], place, rate, velocity;
} ambulo__body;

/* A joint's row and column of the Jacobians: pairs first .. first + count of
 * ancestors, and the joint itself. */
typedef struct ambulo__change_step {
  int motion;
  int first, straight, count, lower; /* the first `straight` pairs are with straight joints */
  int is_straight;                   /* prismatic along an axis that stands still */
  double mass;
} ambulo__change_step;

/* axis: 0, 1, 2 if the ancestor is straight along that world axis, else -1. */
typedef struct ambulo__pair {
  int motion, upper, axis;
} ambulo__pair;

/* The points of one frame. */
typedef struct ambulo__group_step {
  int place, columns[3];
  int first, count;       /* points */
  int chain, chain_count; /* motions of the joints that move them */
} ambulo__group_step;

typedef struct ambulo__point_step {
  double position[3];
  int output, entry; /* rows of outputs and weights; first Jacobian entry */
} ambulo__point_step;

typedef struct ambulo__steps {
  ambulo__angle_step *angles;
  ambulo__turn_step *turns;
  ambulo__hinge_step *hinges; /* as many as angles; parents first */
  ambulo__origin_step *origins;
  ambulo__change_step *changes; /* all coordinates */
  ambulo__pair *pairs;
  ambulo__group_step *groups;
  ambulo__point_step *points; /* all points, by group */
  int *chains;
  int angle_count, turn_count, late_turn; /* turns from late_turn on: axes of prismatic joints */
  int origin_count;
  int group_count;
} ambulo__steps;

#endif
