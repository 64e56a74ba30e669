/* ambulo/collision.h - collisions, obstacles and places to reach: parts of problem.h.
 *
 * A model's capsules (ambulo_capsule in model.h) keep clear of each other and of obstacles. A point
 * of the body comes to a place at a given time, or keeps its offset from another point. A place is
 * three lengths, m: along forward and left from the world's origin, and up from the ground's
 * height. Relative places (ambulo_reach) are offsets from a point instead. Rows, at the nodes:
 *
 *   collision  distance of two capsules' segments - (r1 + r2 + margin) >= 0              m
 *   obstacle   the same for a capsule and an obstacle                                    m
 *   reach      |point - place| <= tolerance along each of the three axes                 m
 *              |point - about - place| <= tolerance for a relative place                 m
 *              equations if the tolerance is 0
 *
 * The distance is smoothed (docs/equations.md, 14.h): rows keep at least the margin, and at most
 * 0.5 mm more. */
#ifndef AMBULO_COLLISION_H
#define AMBULO_COLLISION_H

#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_collision_mode {
  AMBULO_COLLISION_OFF = 0,
  AMBULO_COLLISION_PAIRS, /* the listed pairs */
  /* All pairs but three kinds: those of links connected by joints alone; those that overlap in the
   * rest pose (coordinates 0, or as near to 0 as their ranges allow) and are both connected to one
   * link; and those that stay at least 0.1 m apart (for a stature of 1.75 m) in 1024 poses within
   * the ranges. Others that overlap in the rest pose may overlap as far as there. */
  AMBULO_COLLISION_AUTOMATIC
} ambulo_collision_mode;

/* Two capsules of the model, by index. */
typedef struct ambulo_capsule_pair {
  int one, other;
} ambulo_capsule_pair;

/* With mirrored ends the mirror image of each pair, listed or automatic, is kept apart too. */
typedef struct ambulo_collision {
  ambulo_collision_mode mode;
  const ambulo_capsule_pair *pairs; /* [pair_count] */
  int pair_count;
  double margin; /* least gap, m, >= 0 */
} ambulo_collision;

typedef enum ambulo_obstacle_shape {
  AMBULO_OBSTACLE_SHAPE_NOT_SET = 0, /* refused */
  AMBULO_OBSTACLE_BOX,
  AMBULO_OBSTACLE_CAPSULE
} ambulo_obstacle_shape;

/* A fixed obstacle. Not allowed with mirrored ends, where one step represents both. */
typedef struct ambulo_obstacle {
  const char *name; /* "hurdle"; unique */
  ambulo_obstacle_shape shape;
  double center[3], half[3]; /* box: its middle; half its size along its own forward, left and up,
                                m, > 0 */
  double heading;            /* box: about up, turned to the left, rad */
  double from[3], to[3];     /* capsule: ends of its axis, m */
  double radius;             /* capsule: m, > 0 */
  double margin;             /* least gap to the model's capsules, m, >= 0 */
  const int *capsules;       /* [capsule_count] of the model, to be kept clear; NULL: all */
  int capsule_count;
} ambulo_obstacle;

/* A point of the model is at a place during an interval, or at one time. The place is fixed in the
 * world, or relative to another point of the model: two hands that keep their distance can hold
 * something between them. */
typedef struct ambulo_reach {
  int point;
  int is_relative; /* 1: `place` is the offset from the point `about`, along forward, left and up */
  int about;
  double place[3];
  double from, to;  /* s; rows at the nodes within 1e-9 s of [from, to], at least one. On a grid on
                       events both are events. to INFINITY: until the end */
  double tolerance; /* along each axis, m; 0: equations */
} ambulo_reach;

/* Automatic, without a margin; a box of size 0 for all capsules; a point at the world's origin from
 * 0 until the end, whose index must be set. */
AMBULO_PROBLEM_DEFAULT(ambulo_collision);
AMBULO_PROBLEM_DEFAULT(ambulo_obstacle);
AMBULO_PROBLEM_DEFAULT(ambulo_reach);
AMBULO_PROBLEM_DEFAULT(ambulo_capsule_pair); /* -1: must be set */

#ifdef __cplusplus
}
#endif
#endif
