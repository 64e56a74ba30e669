/* mechanics/plan_local.h - the program of the kernels that work in the bodies' own axes.
 *
 * One step for each coordinate, parents first. A step that is `carried` follows its parent, whose
 * vectors are still in registers. A pass down the tree and the pass up that follows take one limb
 * after the other, so that what the one has stored is still at hand when the other reads it: a body
 * of many limbs costs as much per coordinate as one of a few. Kinds tell which constants are
 * structurally zero: an axis k of the frame is 0, 1 or 2.
 */
#ifndef AMBULO_MECHANICS_PLAN_LOCAL_H
#define AMBULO_MECHANICS_PLAN_LOCAL_H

#include <stdbool.h>
#include <stdint.h>

#include "mechanics/plan.h"

/* Vectors of a slot, in the frame's axes about its origin (3 entries each). The load that a frame
 * has of its own is read just before that of its subtree is known, and shares its place. */
enum {
  local_rate = 0,                   /* w */
  local_gain = 3 * AMBULO__LANES,   /* alpha */
  local_pull = 6 * AMBULO__LANES,   /* a */
  local_moment = 9 * AMBULO__LANES, /* n of the subtree */
  local_force = 12 * AMBULO__LANES, /* f of the subtree */
  local_load = local_moment,        /* moment and force of the body and of branches (6) */
  local_turn = 15 * AMBULO__LANES,  /* eta */
  local_slide = 18 * AMBULO__LANES, /* u */
  local_weight = local_turn,        /* points' weights from branches, when eta and u are done (6) */
  local_adjoint = 21 * AMBULO__LANES, /* adjoints of w, alpha and a from branches (9) */
  local_angle = 30 * AMBULO__LANES,   /* sine, cosine; q if prismatic */
  local_columns = 32 * AMBULO__LANES, /* points, world axes: orientation (9), */
  local_axis = 41 * AMBULO__LANES,    /* axis of a slider, */
  local_origin = 44 * AMBULO__LANES,  /* origin */
  /* odd: else the same vectors of all slots share cache sets. Of the odd sizes from 51 to 73 this
   * one was the fastest with ground reaction (Intel, AVX-512; they differ by 10 %) */
  local_slot = 69 * AMBULO__LANES
};

typedef enum ambulo__joint_kind {
  AMBULO__TURNS_X = 0, /* revolute about axis 0, 1, 2 */
  AMBULO__TURNS_Y,
  AMBULO__TURNS_Z,
  AMBULO__SLIDES,
  AMBULO__SLIDES_X, /* prismatic along axis 0, 1, 2, and the frame does not turn */
  AMBULO__SLIDES_Y,
  AMBULO__SLIDES_Z
} ambulo__joint_kind;

typedef enum ambulo__offset_kind {
  AMBULO__OFFSET_X = 0, /* along axis 0, 1, 2 */
  AMBULO__OFFSET_Y,
  AMBULO__OFFSET_Z,
  AMBULO__OFFSET_ANY,
  AMBULO__OFFSET_NONE
} ambulo__offset_kind;

typedef enum ambulo__body_kind {
  AMBULO__BODY_X = 0, /* diagonal inertia, centre of mass on axis 0, 1, 2 */
  AMBULO__BODY_Y,
  AMBULO__BODY_Z,
  AMBULO__BODY_DIAGONAL,
  AMBULO__BODY_ANY,
  AMBULO__BODY_NONE
} ambulo__body_kind;

/* What is done with a frame in world axes: columns, origin and axis (a slider's) are read by other
 * steps or passes; points hang on it; with ground reaction it counts in the centre of mass, and its
 * body's load in the root wrench. */
enum {
  ambulo__shows_x = 1,
  ambulo__shows_y = 2,
  ambulo__shows_z = 4,
  ambulo__shows_origin = 8,
  ambulo__shows_place = 15,
  ambulo__shows_axis = 16,
  ambulo__shows_points = 32,
  ambulo__shows_mass = 64,
  ambulo__shows_body = 128
};

/* In the order in which the passes read it: what every step needs fills a line of the cache, the
 * body's constants fill two. */
typedef struct ambulo__local_step {
  _Alignas(64) uint8_t joint; /* ambulo__joint_kind */
  uint8_t offset;             /* ambulo__offset_kind */
  uint8_t moving;             /* the same, none if still: the offset then has no acceleration */
  uint8_t body;               /* ambulo__body_kind */
  bool carried;        /* the parent is the frame of the step before, or the world at the first */
  bool plain;          /* carried, and neither an offset nor a constant turn before the joint */
  bool kept;           /* a step that is not carried starts from this frame */
  bool stored;         /* kept, or the reverse sweep starts from it: it knows no child's motion */
  bool unwinds;        /* the reverse sweep goes on to a parent whose motion is not stored */
  bool loaded;         /* local_load holds something when the pass up the tree arrives */
  bool first;          /* top of a limb: first of the branches, and no body, above it */
  bool first_adjoint;  /* not carried: first to write the local_adjoint above it */
  bool from_world;     /* the parent is the world */
  bool still;          /* the parent does not turn */
  bool turned;         /* the axis is oblique */
  bool pointed;        /* points hang on the frame or further down */
  bool carries_points; /* the step after is carried and pointed */
  bool weighted;       /* as loaded, for the points' weights */
  bool first_weight;   /* as first, for the points' weights */
  uint8_t shows;       /* of ambulo__shows_x etc. */
  uint8_t keeps;       /* the same, when a gradient follows */
  bool draws;          /* weights come to those of the step after */
  bool levers;         /* and their moment is not that of the step after */
  bool vanishes;       /* ground reaction: tau is zero, see plan_contacts.c */
  int parent;          /* step, -1: the world */
  int input;           /* entries of the coordinate in the arrays of the caller */
  int at, above;       /* slots of the frame and of its parent */
  int virtual_at;      /* eta and u (6): local_turn of the slot in a stem, else a place that the
                          limbs share */
  int group;           /* of points, in plan_layout.h; -1: none */
  double sign;         /* of a revolute joint's axis */
  double length;       /* the offset, if it is along one axis */

  double mass, com[3], first_moment[3]; /* mass times com */
  double inertia[6];                    /* about the centre of mass: xx yy zz xy xz yz */
  double difference[3];                 /* zz - yy, xx - zz, yy - xx */

  double turn[9];  /* oblique axis: the turned frame in the parent frame */
  double slide[3]; /* prismatic: the axis in the frame */
  double move[3];  /* offset of the origin, parent frame */

  /* ground reaction */
  uint8_t weighs;             /* bits 0 to 2: components of `moment`; 3: `anchored` */
  uint8_t contacts;           /* on this frame, a bit each */
  bool floats;                /* the last joint that carries the whole body */
  double moment[3], anchored; /* b and m of kernel_local_points.h */
} ambulo__local_step;

/* The angle sign q + shift, and where its sine and cosine go. */
typedef struct ambulo__local_angle {
  int input, at;
  double sign, shift;
} ambulo__local_angle;

enum { ambulo__angle_row = 4 };

/* Steps from `first` to `stem` are those on which other limbs may stand: `stem` is the last one
 * that is kept, or the one before `first`. Down the steps from `first` to `leaf`, which has no
 * children; then up from there to `top`, the last frame of which all is known: it adds what it
 * carries to its parent's. */
typedef struct ambulo__limb {
  int first, stem, leaf, top;
  int rise;  /* the last frame that passes its load on: `top`, or, with ground reaction, the one
                below a joint that carries the whole body: there loads cancel */
  int ends;  /* it is the latter */
  int fresh; /* first to write the local_load above `top` */
} ambulo__limb;

/* Sets of contacts that lie one in the other or apart. */
enum { AMBULO__MOST_PATHS = 2 * AMBULO__MOST_CONTACTS - 1 };

/* A joint that carries a contact, and where its axis in world axes stands (a slider's with
 * its sign).
 */
typedef struct ambulo__carrier {
  int axis_at;
  int input;
  double sign;
} ambulo__carrier;

/* Hinges that follow each other on a path and share an origin, or sliders. */
typedef struct ambulo__pivot {
  int origin_at;
  int slides;
  int count;
} ambulo__pivot;

/* Joints, from the root on, that carry the same contacts and whose tau does not vanish. */
typedef struct ambulo__path {
  int contacts;      /* a bit each */
  int above;         /* the path that it continues, which carries more; -1: none */
  int first_carrier; /* up to those of the next path */
  int first_pivot;
} ambulo__path;

typedef struct ambulo__local_plan {
  ambulo__local_step *steps; /* [coordinates] */
  ambulo__limb *limbs;       /* [limb_count] */
  int limb_count;
  ambulo__local_angle *angles; /* [angle_count]; the last is repeated to fill a row of
                                  ambulo__angle_row */
  int angle_count;
  int world_at;           /* slot of the world */
  int branched;           /* several joints stand on the world */
  int world_group;        /* points fixed to the world, -1: none */
  double fixed_moment[3]; /* ground reaction: b of the world, without the bodies fixed to it */
  /* Ground reaction: step of the frame that the wrench of a contact acts on, -1: none;
   * whether nothing else is in its load yet; the last path above it, -1: none. */
  int contact_step[AMBULO__MOST_CONTACTS], bare[AMBULO__MOST_CONTACTS];
  int contact_path[AMBULO__MOST_CONTACTS];
  ambulo__carrier *carrier;
  ambulo__pivot *pivots;
  ambulo__path path[AMBULO__MOST_PATHS + 1]; /* those above before those below, then the ends */
  int carrier_count, pivot_count, path_count;
} ambulo__local_plan;

#endif
