/* show/motions.h - motions of a family: series of the same kinds, in the same order. */
#ifndef AMBULO_SHOW_MOTIONS_H
#define AMBULO_SHOW_MOTIONS_H

#include <stddef.h>

typedef struct ambulo__motions {
  const float *const *motion; /* [count]: [series][samples] each, in steps */
  int count, series, samples;
  int every;    /* 1: all samples; 2: every second one ...; samples - 1 is a multiple */
  double finer; /* 2: steps are half as large */
} ambulo__motions;

/* Values that are written of one motion, [series][(samples - 1) / every + 1], and themselves, in
 * steps as fine as they are written. */
size_t ambulo__motion_values(const ambulo__motions *motions);
void ambulo__motion_row(const ambulo__motions *motions, int i, double *row);

#endif
