/* contact/task.h - how fast, how far a step, how steep: what a gait asks of legs as long as these.
 *
 * With v the speed, l the length of the leg and g gravity, a body that vaults over a straight leg
 * moves on an arc: v^2 / l has to come from gravity. The Froude number
 *
 *     F = v^2 / (g l)
 *
 * is the share of the body weight that the arc needs: walking ends at 1 (Alexander, The gaits of
 * bipedal and quadrupedal animals, 1984), and people change to running at 0.5, at any gravity
 * (Kram, Domingo & Ferris, J Exp Biol 200:821, 1997). The longest steps that people walk with
 * are 1.17 legs long (Schmitt, J Exp Biol 206:1437, 2003: strides of 2.1 m, statures of 1.7 m, legs
 * 0.53 statures). A body that moves steadily is carried by a force that is vertical on average: on
 * a slope its share along the ground is the slope's tangent, and friction has to hold that.
 */
#ifndef AMBULO_CONTACT_TASK_H
#define AMBULO_CONTACT_TASK_H

#include "ambulo/problem.h"

#define AMBULO__RUNNING_FROUDE 0.5
#define AMBULO__LONGEST_STEP 1.17 /* leg lengths */

typedef struct ambulo__task {
  int is_gait;      /* two feet or more, with contacts, on legs of some length; else all is 0 */
  double leg;       /* m: the longest leg, from its first joint to the heel, straight */
  double speed;     /* m/s along forward, of a motion that repeats; 0 otherwise */
  double step;      /* m: the longest, along forward */
  double step_time; /* s, on average */
  double froude;    /* F */
  double gravity;   /* m/s^2 */
  double grade;     /* tangent of the slope, of a motion that repeats */
} ambulo__task;

ambulo__task ambulo__task_of(const ambulo_problem_definition *definition);

#endif
