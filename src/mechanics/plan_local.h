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
  local_axis = 32 * AMBULO__LANES,    /* points, world axes: axis of the joint, */
  local_columns = 35 * AMBULO__LANES, /* orientation (9), */
  local_origin = 44 * AMBULO__LANES,  /* origin, */
  local_first = 47 * AMBULO__LANES,   /* ground reaction: first mass moment, if not placed */
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

typedef struct ambulo__local_step {
  ambulo__joint_kind joint;
  ambulo__offset_kind offset;
  ambulo__offset_kind moving; /* none if still: the offset then has no acceleration */
  ambulo__body_kind body;
  int parent;     /* step, -1: the world */
  int input;      /* entries of the coordinate in the arrays of the caller */
  int at, above;  /* slots of the frame and of its parent */
  int virtual_at; /* eta and u (6): local_turn of the slot in a stem, else a place that the limbs
                     share */
  int carried;    /* the parent is the frame of the step before, or the world at the first step */
  int plain;      /* carried, and neither an offset nor a constant turn comes before the joint */
  int kept;       /* a step that is not carried starts from this frame */
  int loaded;     /* local_load holds something when the pass up the tree arrives */
  int first;      /* top of a rise: first to write the local_load above it */
  int first_adjoint; /* not carried: first to write the local_adjoint above it */
  int from_world;
  int still; /* the parent does not turn */
  int turned;
  int pointed;                          /* points hang on the frame or further down */
  int group;                            /* of points, in plan_steps.h; -1: none */
  int carries_points;                   /* the step after is carried and pointed */
  int weighted, first_weight;           /* as loaded and first, for the points' weights */
  int placed;                           /* its columns in world axes are read by other steps */
  int shown;                            /* placed, or of a group, or weighs */
  int draws;                            /* weights come to those of the step after */
  int levers;                           /* and their moment is not that of the step after */
  int vanishes;                         /* ground reaction: tau is zero, see plan_ground.c */
  int weighs;                           /* ground reaction: the body counts in the centre of mass */
  int feet;                             /* ground reaction: feet on this frame (1, 2, both: 3) */
  double sign;                          /* of a revolute joint's axis */
  double turn[9];                       /* oblique axis: the turned frame in the parent frame */
  double slide[3];                      /* prismatic: the axis in the frame */
  double move[3];                       /* offset of the origin, parent frame */
  double length;                        /* the offset, if it is along one axis */
  double mass, com[3], first_moment[3]; /* mass times com */
  double inertia[6];                    /* about the centre of mass: xx yy zz xy xz yz */
  double difference[3];                 /* zz - yy, xx - zz, yy - xx */
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
} ambulo__limb;

typedef struct ambulo__local_plan {
  ambulo__local_step *steps; /* [coordinates] */
  ambulo__limb *limbs;       /* [limb_count] */
  int limb_count;
  ambulo__local_angle *angles; /* [angle_count]; the last is repeated to fill a row of
                                  ambulo__angle_row */
  int angle_count;
  int world_at;    /* slot of the world */
  int branched;    /* several joints stand on the world */
  int world_group; /* points fixed to the world, -1: none */
  /* Ground reaction: the joints that carry both feet but whose tau does not vanish, then those that
   * carry foot 0 alone, then foot 1, each from the root on. */
  int *carrier, carrier_first[4];
} ambulo__local_plan;

#endif
