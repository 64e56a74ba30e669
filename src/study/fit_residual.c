/* study/fit_residual.c - how far a predicted curve is from its target, as a block of residuals
 * (fit.h).
 *
 * With y_i the prediction and m_i the reference at the target's n points, s its deviation, and
 * e_i = y_i - m_i (centred: less its mean), a whole curve has n + 2 residuals
 *
 *     e_i / (s sqrt n)                                   i < n
 *     correlation (1 - r)                                r: Pearson's, 0 where y is constant
 *     range ln max(k, 0.1)                               k: range of y over that of m
 *
 * and a number of a curve (its range, peak, lowest or largest value) one, (number of y - that of
 * m) / s. A guard has one, too, with v the number of y and the bounds a <= b,
 *
 *     e = (v - b) / s  where v > b,    e = (v - a) / s  where v < a,    e = 0  between
 *
 * The sum of squares z of a block is 1 where the curve is off by one deviation. A block whose z is
 * above the cap is shortened, so that one curve does not outweigh all others and no gradient is
 * lost:
 *
 *     z -> cap + ln(z / cap)
 *
 * The residual p of a guard has the slope 1 / s in v, and above the cap, where p^2 is cap +
 * ln(e^2 / cap) and 2 p dp = 2 de / e, the slope 1 / (s e p).
 *
 * A solve that failed counts 2 cap for each of its targets, more than any curve in practice. */
#include "people/compare.h"
#include "study/fit.h"

#include <math.h>

static const double least_ratio = 0.1;

double ambulo__fit_weight(const ambulo_fit *fit, const ambulo__fit_condition *c, int of_guards) {
  double sum = 0.0;
  for (int k = 0; k < c->targets; k++) {
    const ambulo__fit_curve *curve = &fit->curve[c->target[k].curve];
    if (curve->is_guard == of_guards) sum += curve->weight;
  }
  return sum;
}

static double extreme(const double *y, int n, double sign) {
  double most = sign * y[0];
  for (int i = 1; i < n; i++) most = fmax(most, sign * y[i]);
  return sign * most;
}

static double range_of(const double *y, int n) {
  return extreme(y, n, 1.0) - extreme(y, n, -1.0);
}

static double number_of(ambulo__fit_of of, const double *y, int n) {
  if (of == AMBULO__FIT_RANGE) return range_of(y, n);
  if (of == AMBULO__FIT_LARGEST) return fmax(extreme(y, n, 1.0), -extreme(y, n, -1.0));
  return extreme(y, n, of == AMBULO__FIT_PEAK ? 1.0 : -1.0);
}

double ambulo__fit_guard(const ambulo_fit *fit, const ambulo__fit_target *t, double value,
                         double *slope) {
  const double *bound = fit->curve[t->curve].bound;
  int side = value > bound[1] ? 1 : value < bound[0] ? 0 : -1;
  *slope = 0.0;
  if (side < 0) return 0.0;
  double e = (value - bound[side]) / t->sd, z = e * e;
  *slope = 1.0 / t->sd;
  if (!(z > fit->cap)) return e;
  double p = copysign(sqrt(fit->cap + log(z / fit->cap)), e);
  *slope = 1.0 / (t->sd * e * p);
  return p;
}

/* residual [n + 2], before the cap */
static void fill_curve(const ambulo__fit_curve *curve, const ambulo__fit_target *t, const double *y,
                       double *residual, const ambulo__fit_score *score) {
  int n = t->points;
  double mean = 0.0, scale = 1.0 / (t->sd * sqrt((double)n));
  for (int i = 0; i < n; i++) mean += (y[i] - t->mean[i]) / (double)n;
  if (!curve->centred) mean = 0.0;
  for (int i = 0; i < n; i++) residual[i] = scale * (y[i] - t->mean[i] - mean);
  double r = isnan(score->r) ? 0.0 : score->r;
  residual[n] = curve->correlation * (1.0 - r);
  residual[n + 1] = curve->range_cost * log(fmax(score->ratio, least_ratio));
}

static void shorten(double cap, double *residual, int count, ambulo__fit_score *score) {
  double z = 0.0;
  for (int i = 0; i < count; i++) z += residual[i] * residual[i];
  score->z = z > cap ? cap + log(z / cap) : z;
  if (!(z > cap)) return;
  double factor = sqrt(score->z / z);
  for (int i = 0; i < count; i++) residual[i] *= factor;
}

/* of one that has a reference */
static void fill_compared(const ambulo__fit_curve *curve, const ambulo__fit_target *t,
                          const double *y, double *residual, ambulo__fit_score *score) {
  double theirs = range_of(t->mean, t->points), ours = range_of(y, t->points), squares = 0.0;
  score->ratio = theirs > 0.0 ? ours / theirs : 1.0;
  if (curve->of == AMBULO__FIT_CURVE) {
    for (int i = 0; i < t->points; i++) squares += (y[i] - t->mean[i]) * (y[i] - t->mean[i]);
    score->rmse = sqrt(squares / (double)t->points);
    score->r = ambulo__correlation(y, t->mean, t->points);
    fill_curve(curve, t, y, residual, score);
  } else {
    score->value = number_of(curve->of, y, t->points);
    score->reference = number_of(curve->of, t->mean, t->points);
    score->rmse = fabs(score->value - score->reference);
    residual[0] = (score->value - score->reference) / t->sd;
  }
}

void ambulo__fit_residual(const ambulo_fit *fit, const ambulo__fit_target *t, const double *y,
                          double *residual, ambulo__fit_score *score) {
  const ambulo__fit_curve *curve = &fit->curve[t->curve];
  *score = (ambulo__fit_score){2.0 * fit->cap, (double)NAN, (double)NAN,
                               (double)NAN,    (double)NAN, (double)NAN};
  for (int i = 0; !y && i < t->count; i++) residual[i] = sqrt(2.0 * fit->cap / (double)t->count);
  if (!y) return;
  if (curve->is_guard) {
    double slope = 0.0;
    score->value = number_of(curve->of, y, t->points);
    residual[0] = ambulo__fit_guard(fit, t, score->value, &slope);
    score->z = residual[0] * residual[0];
    return;
  }
  fill_compared(curve, t, y, residual, score);
  shorten(fit->cap, residual, t->count, score);
}
