/* show/case_data.h - what a page shows of a case: its form, what fills it, its motion.
 *
 * Cases of a study are trees (JSON) that mostly differ in numbers. Their form is the tree
 * {"summary", "scene"} in which a number stands for each leaf: k >= 0 is leaf k, -1 - i series i.
 * Of summary.json only what pages of studies show is taken. Cases of one form fill a table, a
 * column for each leaf (case_table.h); series are packed by themselves (motion_pack.h).
 *
 * Numbers of leaves have six digits. A series is given in steps, so that what is rounded to whole
 * numbers is within half of one:
 *
 *     kind        step
 *     l  length   2 mm
 *     a  angle    .0034 rad (.195 degrees)
 *     t  torque   .01 N m a kg of the body's mass; forces of actuators .01 N a kg
 *     p  power    .01 W a kg
 *     f  force    .2 % of the body's weight
 */
#ifndef AMBULO_SHOW_CASE_DATA_H
#define AMBULO_SHOW_CASE_DATA_H

#include "show/page.h"

typedef struct ambulo__case_data {
  ambulo__text_buffer form;
  ambulo__text_buffer leaves; /* JSON of each, with a zero behind it */
  int leaf_count;
  ambulo__text_buffer kinds; /* a letter for each series */
  int samples;
  float *motion; /* [series][samples], in steps */
  size_t length, capacity;
} ambulo__case_data;

/* Errors: E_MEMORY. */
ambulo_status ambulo__case_data_create(const ambulo__page_result *result,
                                       const ambulo_allocator *allocator, ambulo__case_data *data);
void ambulo__case_data_free(ambulo__case_data *data); /* accepts a zero-filled one */

/* Appends {"l": .002, ...}: steps by kind, so many times finer, of a body of one kilogram, or one
 * newton of weight. */
void ambulo__case_data_steps(ambulo__text_buffer *out, double finer);

#endif
