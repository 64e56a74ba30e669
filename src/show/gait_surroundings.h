/* show/gait_surroundings.h - what is drawn beside the body, seen from the side: the ground
 * (surfaces of contacts one behind the other), obstacles and places to reach, loads in hands,
 * devices. */
#ifndef AMBULO_SHOW_GAIT_SURROUNDINGS_H
#define AMBULO_SHOW_GAIT_SURROUNDINGS_H

#include "base/text_buffer.h"
#include "mechanics/pose.h"
#include "people/stride.h"
#include "problem/nlp.h"
#include "show/skeleton.h"

typedef struct ambulo__surface {
  double from, to;          /* along forward, m; the first and the last one are endless */
  double at, height, slope; /* height above the ground's at `at`, m, and its rise per m forward */
} ambulo__surface;

typedef struct ambulo__gait_ground {
  ambulo_allocator allocator;
  int count; /* 0: level at the ground's height */
  ambulo__surface *surface;
} ambulo__gait_ground;

/* Of the contacts and, where the motion repeats, of those before and after it. Risers stand where
 * contact/schedule.h has them. Errors: E_MEMORY. */
ambulo_status ambulo__gait_ground_create(const ambulo_problem *problem,
                                         const ambulo_allocator *allocator,
                                         ambulo__gait_ground *ground);
void ambulo__gait_ground_free(ambulo__gait_ground *ground); /* accepts a zero-filled one */

/* Radians that the ground rises along forward: gravity is not along its normal then. */
double ambulo__ground_slope(const ambulo_model *model);

/* Height of a surface at x along forward, m above the ground's height. */
double ambulo__surface_height(const ambulo__surface *surface, double x);

/* obstacles of a problem and places to reach, seen from the side. */

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

/* what hands hold or push, seen from the side. */

/* Where each of them stands before it is taken and after it is set down. */
typedef struct ambulo__held_places {
  int count;
  double (*place)[2][3]; /* [count]: middle of the hands at from, at to, m */
} ambulo__held_places;

/* Freed with ambulo__free(allocator, places->place). E_ARGUMENT, E_MEMORY. */
ambulo_status ambulo__held_places_create(const ambulo_problem *problem, const double *x,
                                         const ambulo_allocator *allocator,
                                         ambulo__held_places *places);

/* A box that has a size, where it is at the view's time, `pose` that of the figure; while hands
 * push, an arrow at them. */
void ambulo__gait_held_draw(const ambulo_problem *problem, const ambulo__held_places *places,
                            const ambulo__pose *pose, const ambulo__figure_view *view,
                            ambulo__text_buffer *text);

/* what a body wears and carries, as marks on its stick figures. */

/* A line between two places, or a disc at the first of them. */
typedef struct ambulo__worn {
  int link[2]; /* -1: the world */
  double at[2][3];
  double radius; /* m; 0: a line */
  const char *style;
} ambulo__worn;

/* Devices, then loads. */
int ambulo__worn_count(const ambulo__stride *stride);
/* Mark i at a sample; 0: a device that does nothing then. */
int ambulo__worn_at(const ambulo__stride *stride, int sample, int i, ambulo__worn *mark);

#endif
