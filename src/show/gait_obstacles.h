/* show/gait_obstacles.h - obstacles of a problem and places to reach, seen from the side. */
#ifndef AMBULO_SHOW_GAIT_OBSTACLES_H
#define AMBULO_SHOW_GAIT_OBSTACLES_H

#include "base/text_buffer.h"
#include "problem/nlp.h"

/* Along forward, and above the ground's height, m. */
typedef struct ambulo__outline {
  double from, to, low, high;
  int is_round; /* 1: the end of a capsule that lies across */
} ambulo__outline;

/* The smallest upright rectangle around it. */
ambulo__outline ambulo__obstacle_outline(const ambulo_problem *problem, int obstacle);

/* Widens left..right, m from `origin` along forward, by obstacles as far as `half` to either side;
 * 1 if one stands out of it. */
int ambulo__obstacles_widen(const ambulo_problem *problem, double origin, double half, double *left,
                            double *right);

/* Where one figure of a strip stands. */
typedef struct ambulo__figure_view {
  double origin;         /* what is drawn at x, along forward, m */
  double half;           /* how far to either side things are drawn, m */
  double x, base, scale; /* px; y of the ground; px per m */
  double time, apart;    /* s; from one figure to the next */
} ambulo__figure_view;

/* What is beside the figure, and rings at places that a point has to be at about its time. */
void ambulo__gait_obstacles_draw(const ambulo_problem *problem, const ambulo__figure_view *view,
                                 ambulo__text_buffer *text);

#endif
