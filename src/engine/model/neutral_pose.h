/* model/neutral_pose.h - the skeleton at q = 0: where points are, how joints point.
 *
 * The neutral pose is the one in which a model stands upright with flat feet; the
 * geometry of feet and the directions of the root coordinates are read off it. */
#ifndef AMBULO_MODEL_NEUTRAL_POSE_H
#define AMBULO_MODEL_NEUTRAL_POSE_H

#include "model/model_check.h"
#include "model/model.h"

/* Fills model->neutral, which has room for it; rows ask for these places at every node. */
void ambulo__neutral_points(ambulo_model *model);
/* World position at q = 0 of a place on a link, m. */
void ambulo__neutral_place(const ambulo_model *model, int link, const double local[3],
                           double world[3]);
/* World position of a model's point at q = 0, m. */
void ambulo__neutral_point(const ambulo_model *model, int point, double world[3]);
/* The other way round: the place of a link that stands there at q = 0. */
void ambulo__neutral_local(const ambulo_model *model, int link, const double world[3],
                           double position[3]);

/* World direction (unit) of the joint axis of a coordinate at q = 0. */
void ambulo__neutral_axis(const ambulo_model *model, int coordinate, double axis[3]);

/* 1 if some coordinate can move `link` out of the vertical plane of progression. When
 * every revolute axis above it is parallel to left at q = 0 it stays so for all q, and
 * no revolute joint leaves the plane; a prismatic one must then be perpendicular to left. */
int ambulo__link_moves_sideways(const ambulo_model *model, int link);
/* The same for any link of the model. */
int ambulo__model_moves_sideways(const ambulo_model *model);

/* 1 if only fixed and prismatic links lie between the world and the link of `coordinate`,
 * itself prismatic: a translation of the whole body. */
int ambulo__is_root_translation(const ambulo_model *model, int coordinate);

/* How far the rest of a coordinate's angle moves with the ground's slope, rad: of the root's pitch,
 * the first rotation between the world and the body and about left, the slope with the axis' sign;
 * else, and on level ground, 0 (problem/term_kinds.c, posture). */
double ambulo__lean(const ambulo_model *model, int coordinate);

/* 1 if every mass moves with the coordinate: it moves the whole body. */
int ambulo__carries_whole_body(const ambulo_model *model, int coordinate);

/* the body at q = 0 as rigid segments, seen along forward, up and left.
 *
 * Segment 0 is what is fixed to the world, segment c + 1 what coordinate c carries: its link and
 * the fixed links that hang on it, as one body. All vectors and inertias are in the axes
 * (forward, up, left) about the world's origin; in them the mirror image of a vector has the third
 * component reversed. */

typedef struct ambulo__segment_frame {
  double axes[3][3]; /* column j: the frame's j-th axis */
  double origin[3];  /* m */
} ambulo__segment_frame;

typedef struct ambulo__segments {
  ambulo_allocator allocator;
  const ambulo_model *model;
  ambulo__segment_frame *frame; /* [links] */
  int *of_link;                 /* [links] */
  ambulo__part *body;           /* [coordinates + 1] */
  int *heaviest;                /* [coordinates + 1]: link with the largest part of it; that of the
                                   coordinate, or -1, where there is no mass */
} ambulo__segments;

/* E_MEMORY. Freed by ambulo__segments_free, which accepts a zero-filled one. */
ambulo_status ambulo__segments_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                      ambulo__segments *segments);
void ambulo__segments_free(ambulo__segments *segments);
/* Joints with a coordinate stay at 0, but coupled ones stand where they do for followed
 * [coordinates]. */
void ambulo__segments_at(ambulo__segments *segments, const double *followed);

/* The segment that the joint of coordinate c hangs on. */
int ambulo__segment_parent(const ambulo__segments *segments, int coordinate);
/* The frame about whose z axis the joint of coordinate c turns, or along which it slides. */
ambulo__segment_frame ambulo__segment_joint(const ambulo__segments *segments, int coordinate);
/* Place of a point of the model, m. */
void ambulo__segment_point(const ambulo__segments *segments, int point, double place[3]);

#endif
