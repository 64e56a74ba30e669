/* people/compare_curve.h - one curve of a motion over the cycle: of the foot that is asked for, or
 * the mean of both where they are alike.
 *
 * With y_j the strides of a foot, m = mean y_j and s = mean y_j^2 at a percent; of two feet that
 * are alike m and s are means of the two. Over n strides the deviation is sqrt(n/(n - 1) (s -
 * m^2)). */
#ifndef AMBULO_PEOPLE_COMPARE_CURVE_H
#define AMBULO_PEOPLE_COMPARE_CURVE_H

#include "people/compare_cycle.h"
#include "ambulo/tools/compare.h"

typedef struct ambulo__sampler {
  ambulo__cycle *cycle;
  const ambulo_compare_options *options;
  int most;                  /* percents at once */
  double *other, *square[2]; /* [most] */
  int warned_sides;
} ambulo__sampler;

/* Errors: E_MEMORY. Fills *sampler, which ambulo__sampler_free releases. */
ambulo_status ambulo__sampler_create(ambulo__cycle *cycle, const ambulo_compare_options *options,
                                     int most, ambulo__sampler *sampler);
void ambulo__sampler_free(ambulo__sampler *sampler); /* accepts a zero-filled one */

/* values[count] at percents[count], in the unit of the entry, with the pelvic tilt where it has
 * one. deviations [count] may be NULL; they are NaN for one stride. *strides: how many; 0 when the
 * motion has no such curve. Errors: as ambulo__cycle_spread. */
ambulo_status ambulo__sample_curve(ambulo__sampler *sampler, const ambulo__map_entry *entry,
                                   const double *percents, int count, double *values,
                                   double *deviations, int *strides);

#endif
