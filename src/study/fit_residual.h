/* study/fit_residual.h - how far a predicted curve is from its target, as a block of residuals.
 *
 * With y_i the prediction and m_i the reference at the target's n points, s its deviation, and
 * e_i = y_i - m_i (centred: less its mean), a whole curve has n + 2 residuals
 *
 *     e_i / (s sqrt n)                                   i < n
 *     correlation (1 - r)                                r: Pearson's, 0 where y is constant
 *     range ln max(k, 0.1)                               k: range of y over that of m
 *
 * and a number of a curve (its range, peak or lowest value) one, (number of y - that of m) / s.
 * Their sum of squares z is 1 where the curve is off by one deviation. A block whose z is above the
 * cap is shortened, so that one curve does not outweigh all others and no gradient is lost:
 *
 *     z -> cap + ln(z / cap)
 *
 * A solve that failed counts 2 cap for each of its targets, more than any curve in practice. */
#ifndef AMBULO_STUDY_FIT_RESIDUAL_H
#define AMBULO_STUDY_FIT_RESIDUAL_H

#include "study/fit.h"

/* What a target scores; NaN where there is no such thing. */
typedef struct ambulo__fit_score {
  double z;                /* sum of squares of the block, after the cap */
  double rmse;             /* of y - m, not centred; of a number: |difference| */
  double r;                /* NaN: of a number, or y is constant */
  double ratio;            /* k */
  double value, reference; /* of a number */
} ambulo__fit_score;

/* y [points] of the target; residual [count of the target] */
void ambulo__fit_residual(const ambulo_fit *fit, const ambulo__fit_target *target, const double *y,
                          double *residual, ambulo__fit_score *score);
void ambulo__fit_residual_failed(const ambulo_fit *fit, const ambulo__fit_target *target,
                                 double *residual, ambulo__fit_score *score);

#endif
