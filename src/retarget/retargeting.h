/* retarget/retargeting.h - a motion of one body as a task for another: footholds, times, a
 * reference.
 *
 * Lengths of the way and of its footholds are those of the person times the ratio of the legs, but
 * that the feet stand aside of the hips as far as they did: with s = -1, 1 for right and left and b
 * half the distance of the hips, a foothold is at
 *
 *     l p + (l the ratio)  s (b_target - l b_person) along the pelvis' left
 *
 * Times are those of the person, or times the root of the ratio, so that speeds keep their Froude
 * number, as a motion that flies must. Feet are where the footholds say; the pelvis is put between
 * its feet.
 *
 * A motion that ends as it began, further on, repeats: what is left between its ends is taken off
 * evenly over time.
 */
#ifndef AMBULO_RETARGET_RETARGETING_H
#define AMBULO_RETARGET_RETARGETING_H

#include "retarget/contacts.h"
#include "retarget/source.h"

typedef struct ambulo__retargeting {
  ambulo_allocator allocator;
  const ambulo__figure *target;
  int rows;
  double *time;              /* [rows], s from 0, of the target */
  double *q;                 /* [rows][coordinates]: how it would move by its angles alone */
  ambulo__standings footing; /* `ankle` becomes the target's, of a stance; times too */
  double ratio, time_ratio;
  int repeats;         /* 1: periodic, moved on by `travel` and `rise` */
  double travel, rise; /* m, of the target */
  int flights;         /* times without a foot on the ground */
} ambulo__retargeting;

/* Errors: E_SCHEMA (nothing to follow), E_MEMORY. */
ambulo_status ambulo__retargeting_make(const ambulo__given *given, ambulo__figure *person,
                                       ambulo__figure *target, ambulo_times times, double speed,
                                       ambulo_diagnostics *diagnostics, ambulo__retargeting *plan);
void ambulo__retargeting_free(ambulo__retargeting *plan); /* accepts a zero-filled one */

/* The problem file; its reference is reference.csv beside it. */
void ambulo__retargeting_problem(const ambulo__retargeting *plan, const char *motion,
                                 const char *model_file, ambulo__text_buffer *text);
void ambulo__retargeting_reference(const ambulo__retargeting *plan, ambulo__text_buffer *text);

#endif
