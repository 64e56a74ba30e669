/* show/gait_held.h - what hands hold or push, seen from the side. */
#ifndef AMBULO_SHOW_GAIT_HELD_H
#define AMBULO_SHOW_GAIT_HELD_H

#include "mechanics/pose.h"
#include "show/gait_obstacles.h"

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

#endif
