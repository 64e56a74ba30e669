/* retarget/figure.h - a body as segments: how each is turned from standing upright, and where the
 * ankles and the soles are.
 *
 * Axes here are forward, left and up of the body's world. Standing upright is not a pose of the
 * model but of its segments: thighs, shanks and arms hang straight down, feet point forward and are
 * flat, pelvis and torso are as at q = 0. With R(q) the orientation of a segment's link, and A the
 * least turn from down (of a foot: forward) to its direction at q = 0, its turn from standing is
 *
 *     S(q) = R(q) R(0)^T A
 *
 * so bodies whose zero poses differ (arms out, knees bent) stand upright alike, and joints need no
 * signs. A direction is that from the centre of one joint to the next; the centre of a group of
 * hinges is the point nearest to its axes.
 */
#ifndef AMBULO_RETARGET_FIGURE_H
#define AMBULO_RETARGET_FIGURE_H

#include "import/rigid.h"
#include "mechanics/pose.h"
#include "retarget/segments.h"

enum { AMBULO__SIDES = 2 }; /* right, left */

typedef struct ambulo__figure {
  const ambulo_model *model;
  ambulo__segment_map map;
  ambulo__pose pose;
  ambulo__rigid axes;                      /* rows forward, left, up: world to figure */
  int link[AMBULO__SEGMENTS];              /* -1: the body has no such segment */
  ambulo__rigid neutral[AMBULO__SEGMENTS]; /* R(0)^T A */
  int foot[AMBULO__SIDES];                 /* of the model; -1: none */
  double ankle[AMBULO__SIDES][3];          /* in the frame of the shank's link, m */
  /* at the foot standing flat: from the ankle to heel and toe centre; m */
  double heel[AMBULO__SIDES][3], toe[AMBULO__SIDES][3];
  double leg;                  /* from the hip to the sole, m */
  double aside[AMBULO__SIDES]; /* of the ankle when standing, along left, m */
} ambulo__figure;

/* How a body is at one time. */
typedef struct ambulo__posture {
  ambulo__rigid turn[AMBULO__SEGMENTS]; /* S; of a missing segment that of the one it hangs on */
  double pelvis[3];
  double ankle[AMBULO__SIDES][3], heel[AMBULO__SIDES][3], toe[AMBULO__SIDES][3]; /* m */
} ambulo__posture;

/* `model` must outlive it. Errors: E_MODEL (`what` in messages), E_MEMORY. */
ambulo_status ambulo__figure_create(const ambulo_model *model, const ambulo__segment_map *map,
                                    const char *what, const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo__figure *figure);
void ambulo__figure_free(ambulo__figure *figure); /* accepts a zero-filled one */

/* The body at q [coordinates]. */
void ambulo__figure_at(ambulo__figure *figure, const double *q, ambulo__posture *posture);
/* The line about which a coordinate turns, after ambulo__figure_at: a point of it and its
 * direction, along the figure's axes. */
void ambulo__figure_axis(const ambulo__figure *figure, int coordinate, double point[3],
                         double direction[3]);

/* Turn about up that a segment's forward axis has made, rad. */
double ambulo__heading_of(const ambulo__rigid *turn);
/* Axis times angle of a rotation, and the rotation of that. */
void ambulo__turn_vector(const ambulo__rigid *turn, double vector[3]);
ambulo__rigid ambulo__turn_of_vector(const double vector[3]);

#endif
