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

/* The surfaces under a figure, `half` px to either side, and what is below them as far as `bottom`,
 * px; nothing where the motion is not finite. */
void ambulo__gait_ground_draw(const ambulo__gait_ground *ground, const ambulo__figure_view *view,
                              double half, double bottom, ambulo__text_buffer *text);

/* The surface that a patch in contact rests on, as long as the patch. */
void ambulo__gait_patches_draw(const ambulo__stride *stride, const ambulo__pose *pose,
                               const ambulo__figure_view *view, ambulo__text_buffer *text);

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

/* what a body wears and carries (gait_worn.c). */

typedef enum ambulo__worn_kind {
  AMBULO__WORN_CABLE, /* a device between two points: its ends */
  AMBULO__WORN_BRACE, /* one at a joint: cuffs on the bodies before and after it, and the joint */
  AMBULO__WORN_LOAD   /* a box: its middle, and those of its front and its top */
} ambulo__worn_kind;

typedef struct ambulo__worn {
  ambulo__worn_kind kind;
  int link[3]; /* -1: the world */
  double at[3][3];
  double half[3]; /* of a load: half its size along forward, left and up in the rest pose, m */
} ambulo__worn;

/* Devices, then loads. */
typedef struct ambulo__worn_list {
  ambulo_allocator allocator;
  int count;
  ambulo__worn *mark;
} ambulo__worn_list;

/* Errors: E_MEMORY. */
ambulo_status ambulo__worn_create(const ambulo__stride *stride, const ambulo_allocator *allocator,
                                  ambulo__worn_list *list);
void ambulo__worn_free(ambulo__worn_list *list); /* accepts a zero-filled one */
/* 1 for a load, and for a device that does at least a fiftieth of the most that it does. */
int ambulo__worn_acts(const ambulo__stride *stride, int sample, int i);
/* Half the size of the box that stands for a load, m. */
void ambulo__load_half_size(double mass, double half[3]);

/* Behind the limbs (`ahead` 0): loads and braces. Before them: cuffs, hinges, cables; pale while
 * they do nothing. A hinge is a ring for a spring, a disc for an actuator, a square for a damper.
 */
void ambulo__gait_worn_draw(const ambulo__stride *stride, const ambulo__worn_list *list, int sample,
                            int ahead, const ambulo__pose *pose, const ambulo__figure_view *view,
                            ambulo__text_buffer *text);

#endif
