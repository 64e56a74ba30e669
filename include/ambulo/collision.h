/* ambulo/collision.h - bodies that take up room: parts of problem.h.
 *
 * A model's capsules (ambulo_capsule in model.h) keep clear of one another and of obstacles, and a
 * point of a body comes to a place at a time, or keeps its way from another point. Places are along
 * forward, along left and up from the world's origin, the third above the ground's height; those
 * relative to a point (ambulo_reach) from that point instead; m. Rows stand at the nodes:
 *
 *   collision  distance of two capsules' segments - (r1 + r2 + margin) >= 0              m
 *   obstacle   the same of a capsule and an obstacle                                     m
 *   reach      |point - place| <= tolerance along each of the three                      m
 *              |point - about - place| <= tolerance where it is relative                 m
 *              without a tolerance both as equations
 *
 * The distance is smoothed (docs/equations.md, 14.h): at least so much is kept, and up to .5 mm
 * more. */
#ifndef AMBULO_COLLISION_H
#define AMBULO_COLLISION_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_collision_mode {
  AMBULO_COLLISION_OFF = 0,
  AMBULO_COLLISION_PAIRS, /* those that are listed */
  /* All pairs but those of links that hang on one another by joints alone, those that overlap in
   * the rest pose (all coordinates 0, or as near as their ranges let them), and those that come no
   * nearer than 0.1 m (of a body of 1.75 m) in any of 1024 poses within the ranges. */
  AMBULO_COLLISION_AUTOMATIC
} ambulo_collision_mode;

/* Two capsules of the model, by index. */
typedef struct ambulo_capsule_pair {
  int one, other;
} ambulo_capsule_pair;

/* With mirrored ends the mirror image of each pair is kept apart too. */
typedef struct ambulo_collision {
  ambulo_collision_mode mode;
  const ambulo_capsule_pair *pairs; /* [pair_count] */
  int pair_count;
  double margin; /* air that they keep, m, >= 0 */
} ambulo_collision;

typedef enum ambulo_obstacle_shape {
  AMBULO_OBSTACLE_SHAPE_NOT_SET = 0, /* refused */
  AMBULO_OBSTACLE_BOX,
  AMBULO_OBSTACLE_CAPSULE
} ambulo_obstacle_shape;

/* Something that stands still. Not with mirrored ends, where one step stands for both. */
typedef struct ambulo_obstacle {
  const char *name; /* "hurdle"; no two have the same */
  ambulo_obstacle_shape shape;
  double center[3], half[3]; /* of a box: its middle; half its size along its own forward, left and
                                up, > 0 */
  double heading;            /* of a box, about up, turned to the left, rad */
  double from[3], to[3];     /* of a capsule: ends of its line */
  double radius;             /* of a capsule, > 0 */
  double margin;             /* air that capsules keep from it, m, >= 0 */
  const int *capsules;       /* [capsule_count] of the model, which keep clear; NULL: all */
  int capsule_count;
} ambulo_obstacle;

/* A point of the model is at a place from one time to another, or at one time. The place is in the
 * world, or where it is from another point of the model: two hands that keep their distance hold
 * something between them. */
typedef struct ambulo_reach {
  int point;
  int is_relative; /* 1: `place` is the way from the point `about`, along forward, left and up */
  int about;
  double place[3];
  double from, to;  /* s; nodes within 1e-9 s of [from, to], at least one; on a grid on events both
                       are events. to INFINITY: until the end */
  double tolerance; /* along each axis, m; 0: equations */
} ambulo_reach;

/* Off, without pairs; a box for all capsules, without size; a point that is to be named, at the
 * world's origin from 0 until the end. */
AMBULO_PROBLEM_DEFAULT(ambulo_collision);
AMBULO_PROBLEM_DEFAULT(ambulo_obstacle);
AMBULO_PROBLEM_DEFAULT(ambulo_reach);
AMBULO_PROBLEM_DEFAULT(ambulo_capsule_pair); /* -1, to be given */

#ifdef __cplusplus
}
#endif
#endif
