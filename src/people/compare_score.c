/* people/compare_score.c - numbers of the comparison (docs/compare.md).
 *
 * With y_i the prediction and m_i, s_i mean and deviation of the reference at its n points:
 *
 *   rmse       sqrt( sum (y_i - m_i)^2 / n )
 *   r          sum (y_i - mean y)(m_i - mean m) / sqrt( sum (y_i - mean y)^2 sum (m_i - mean m)^2 )
 *   within     share of the points with |y_i - m_i| <= 2 s_i
 *   peak       largest value every half percent of what the reference covers of the cycle
 *   roughness  mean |f_{k-1} - 2 f_k + f_{k+1}|, f the vertical force in body weights every
 *              2 percent (51 points a cycle) from 4 to 56 percent, the loaded part
 */
#include "people/compare_score.h"
#include "ambulo/tools/compare.h"

#include <math.h>

static double mean_of(const double *y, int n) {
  double sum = 0.0;
  for (int i = 0; i < n; i++) sum += y[i];
  return sum / (double)n;
}

double ambulo__correlation(const double *a, const double *b, int n) {
  double mean_a = mean_of(a, n), mean_b = mean_of(b, n), aa = 0.0, bb = 0.0, ab = 0.0;
  for (int i = 0; i < n; i++) {
    double da = a[i] - mean_a, db = b[i] - mean_b;
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  return aa > 0.0 && bb > 0.0 ? ab / sqrt(aa * bb) : (double)NAN;
}

static int largest(const double *y, int from, int to) {
  int best = from;
  for (int i = from + 1; i <= to; i++) {
    if (y[i] > y[best]) best = i;
  }
  return best;
}

static int smallest(const double *y, int from, int to) {
  int best = from;
  for (int i = from + 1; i <= to; i++) {
    if (y[i] < y[best]) best = i;
  }
  return best;
}

void ambulo__score_curve(const ambulo__reference_curve *reference, const double *values,
                         const double *fine, ambulo_curve_score *score) {
  int n = reference->points, inside = 0;
  double squares = 0.0;
  for (int i = 0; i < n; i++) {
    double d = values[i] - reference->mean[i];
    squares += d * d;
    inside += reference->sd && fabs(d) <= 2.0 * reference->sd[i];
  }
  score->points = n;
  score->rmse = sqrt(squares / (double)n);
  score->r = ambulo__correlation(values, reference->mean, n);
  score->within_2sd = reference->sd ? (double)inside / (double)n : (double)NAN;
  int first = (int)floor(2.0 * reference->percent[0]);
  int last = (int)ceil(2.0 * reference->percent[n - 1]);
  int peak = largest(fine, first, last);
  score->peak = fine[peak];
  score->peak_time = 0.5 * (double)peak;
  peak = largest(reference->mean, 0, n - 1);
  score->reference_peak = reference->mean[peak];
  score->reference_peak_time = reference->percent[peak];
}

/* ---------------------------------------------------------------- landmarks */

enum { PERCENT = (AMBULO__FINE - 1) / 100 }; /* fine points per percent */

static void add(const char *name, const char *unit, double value, double time,
                ambulo_landmark *landmarks, int *count) {
  landmarks[(*count)++] = (ambulo_landmark){name, unit, value, time};
}

static void add_at(const char *name, const char *unit, const double *fine, int at, double scale,
                   ambulo_landmark *landmarks, int *count) {
  add(name, unit, scale * fine[at], (double)at / PERCENT, landmarks, count);
}

void ambulo__knee_landmarks(const double *fine, ambulo_landmark *landmarks, int *count) {
  int loading = largest(fine, 0, 25 * PERCENT), swing = largest(fine, 55 * PERCENT, 100 * PERCENT);
  add_at("knee at strike", "deg", fine, 0, 1.0, landmarks, count);
  add_at("knee loading peak", "deg", fine, loading, 1.0, landmarks, count);
  add_at("knee swing peak", "deg", fine, swing, 1.0, landmarks, count);
}

void ambulo__ankle_landmarks(const double *fine, ambulo_landmark *landmarks, int *count) {
  int stance = largest(fine, 0, 55 * PERCENT), push = smallest(fine, 50 * PERCENT, 80 * PERCENT);
  add_at("ankle dorsiflexion", "deg", fine, stance, 1.0, landmarks, count);
  add_at("ankle push-off", "deg", fine, push, 1.0, landmarks, count);
}

void ambulo__vertical_landmarks(const double *fine, double gravity, ambulo_landmark *landmarks,
                                int *count) {
  int first = largest(fine, 0, 25 * PERCENT), second = largest(fine, 30 * PERCENT, 62 * PERCENT);
  int valley = smallest(fine, first, second);
  double roughness = 0.0;
  int terms = 0;
  for (int p = 6; p <= 54; p += 2, terms++) {
    int k = p * PERCENT, step = 2 * PERCENT;
    roughness += fabs(fine[k - step] - 2.0 * fine[k] + fine[k + step]);
  }
  add_at("vertical force first peak", "BW", fine, first, 1.0 / gravity, landmarks, count);
  add_at("vertical force valley", "BW", fine, valley, 1.0 / gravity, landmarks, count);
  add_at("vertical force second peak", "BW", fine, second, 1.0 / gravity, landmarks, count);
  add("vertical force roughness", "BW", roughness / (double)terms / gravity, (double)NAN, landmarks,
      count);
}

void ambulo__forward_landmarks(const double *fine, ambulo_landmark *landmarks, int *count) {
  int braking = smallest(fine, 0, 100 * PERCENT), push = largest(fine, 0, 100 * PERCENT);
  add_at("forward force smallest", "N/kg", fine, braking, 1.0, landmarks, count);
  add_at("forward force largest", "N/kg", fine, push, 1.0, landmarks, count);
}
