/* exchange/bodies.h - a model as other programs have it: bodies, each on its parent by one joint.
 *
 * A body moves against its parent by
 *
 *     X(q) = before J_1(q_1) ... J_n(q_n) after                                            (E.1)
 *
 * where J_i turns about or slides along axis[i] of the joint's frame: sliders first, then hinges
 * through one point. Links without mass, points or branches are parts of the joint of the next one.
 * Frames of bodies are those of the links they are called after, but for `single`. Ground: the
 * other program's world, whose axes the model's are turned to. SI units and radians. */
#ifndef AMBULO_EXCHANGE_BODIES_H
#define AMBULO_EXCHANGE_BODIES_H

#include "exchange/rigid.h"
#include "model/model.h"

enum { AMBULO__JOINT_MOST = 6 };

typedef struct ambulo__export_body {
  const char *name;
  int parent; /* body; -1: ground */
  int link;
  int joints;                         /* 0: fixed; at most three sliders and three hinges */
  int coordinate[AMBULO__JOINT_MOST]; /* of the model */
  double axis[AMBULO__JOINT_MOST][3]; /* unit, joint's frame */
  ambulo__rigid before, after;        /* (E.1) */
  double mass, com[3], inertia[6];    /* in the body's frame; about the centre of mass */
} ambulo__export_body;

typedef struct ambulo__bodies {
  ambulo_allocator allocator;
  const ambulo_model *model; /* borrowed */
  ambulo__rigid world;       /* the model's world in the ground's axes */
  int single; /* 1: one coordinate a body, and the origin on the joint's axis (URDF) */
  int root;   /* with a free root: its link, the first body, on no joint; else -1 */
  ambulo__export_body *list; /* [count], parents before children */
  int count;
  int *body_of;         /* [links]: -1: ground */
  ambulo__rigid *place; /* [links]: the link's frame in its body's */
  double *offset;       /* [coordinates]: m to add to a coordinate's values, 0 for most */
} ambulo__bodies;

typedef enum ambulo__ground_axes {
  AMBULO__Y_UP, /* OpenSim: forward near x, up near y */
  AMBULO__Z_UP  /* URDF: forward near x, up near z */
} ambulo__ground_axes;

/* The turn that takes the model's axes to a ground's: one axis to another, so that a slope stays a
 * slope and no number is rounded. */
ambulo__rigid ambulo__ground_turn(const ambulo_model *model, ambulo__ground_axes axes);

/* For OpenSim: joints of several coordinates; sliders of the root count from the ground's origin,
 * as there (`offset`). E_MEMORY. Fills *bodies, which ambulo__bodies_free releases. */
ambulo_status ambulo__bodies_merged(const ambulo_model *model, const ambulo_allocator *allocator,
                                    ambulo__bodies *bodies);
/* For URDF; free_root: without the coordinates that carry the root (ambulo__free_root). E_MEMORY.
 */
ambulo_status ambulo__bodies_single(const ambulo_model *model, int free_root,
                                    const ambulo_allocator *allocator, ambulo__bodies *bodies);
void ambulo__bodies_free(ambulo__bodies *bodies); /* accepts a zero-filled one */

/* The link that the first coordinates carry, none of them actuated, with nothing else on the way;
 * -1: the root is no free body. */
int ambulo__free_root(const ambulo_model *model);

/* Where a point of a link is in its body's frame. */
void ambulo__body_point(const ambulo__bodies *bodies, int link, const double local[3],
                        double out[3]);

#endif
