/* study/fit_residual.c - see residual.h. */
#include "study/fit_residual.h"

#include <math.h>

#include "people/compare.h"

static const double least_ratio = 0.1;

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
  return extreme(y, n, of == AMBULO__FIT_PEAK ? 1.0 : -1.0);
}

/* residual [n + 2], before the cap */
static void fill_curve(const ambulo_fit *fit, const ambulo__fit_target *t, const double *y,
                       double *residual, const ambulo__fit_score *score) {
  int n = t->points;
  double mean = 0.0, scale = 1.0 / (t->sd * sqrt((double)n));
  for (int i = 0; i < n; i++) mean += (y[i] - t->mean[i]) / (double)n;
  if (!fit->curve[t->curve].centred) mean = 0.0;
  for (int i = 0; i < n; i++) residual[i] = scale * (y[i] - t->mean[i] - mean);
  double r = isnan(score->r) ? 0.0 : score->r;
  residual[n] = fit->correlation * (1.0 - r);
  residual[n + 1] = fit->range_cost * log(fmax(score->ratio, least_ratio));
}

static void shorten(double cap, double *residual, int count, ambulo__fit_score *score) {
  double z = 0.0;
  for (int i = 0; i < count; i++) z += residual[i] * residual[i];
  score->z = z > cap ? cap + log(z / cap) : z;
  if (!(z > cap)) return;
  double factor = sqrt(score->z / z);
  for (int i = 0; i < count; i++) residual[i] *= factor;
}

void ambulo__fit_residual(const ambulo_fit *fit, const ambulo__fit_target *t, const double *y,
                          double *residual, ambulo__fit_score *score) {
  ambulo__fit_of of = fit->curve[t->curve].of;
  double theirs = range_of(t->mean, t->points), ours = range_of(y, t->points), squares = 0.0;
  *score = (ambulo__fit_score){.r = (double)NAN, .value = (double)NAN, .reference = (double)NAN};
  score->ratio = theirs > 0.0 ? ours / theirs : 1.0;
  if (of == AMBULO__FIT_CURVE) {
    for (int i = 0; i < t->points; i++) squares += (y[i] - t->mean[i]) * (y[i] - t->mean[i]);
    score->rmse = sqrt(squares / (double)t->points);
    score->r = ambulo__correlation(y, t->mean, t->points);
    fill_curve(fit, t, y, residual, score);
  } else {
    score->value = number_of(of, y, t->points);
    score->reference = number_of(of, t->mean, t->points);
    score->rmse = fabs(score->value - score->reference);
    residual[0] = (score->value - score->reference) / t->sd;
  }
  shorten(fit->cap, residual, t->count, score);
}

void ambulo__fit_residual_failed(const ambulo_fit *fit, const ambulo__fit_target *t,
                                 double *residual, ambulo__fit_score *score) {
  double each = sqrt(2.0 * fit->cap / (double)t->count);
  for (int i = 0; i < t->count; i++) residual[i] = each;
  *score = (ambulo__fit_score){2.0 * fit->cap, (double)NAN, (double)NAN,
                               (double)NAN,    (double)NAN, (double)NAN};
}
