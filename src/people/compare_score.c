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
#include "people/compare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

static const double whole = 90.0;       /* percent that a reference of a cycle covers */
static const double most_radians = 3.2; /* no joint of a walk turns further */
static const double least_ratio = 57.3 / 3.0, most_ratio = 57.3 * 3.0;

int ambulo__curve_is_listed(const char *list, const char *curve) {
  size_t length = strlen(curve);
  if (!list) return 1;
  for (const char *at = list; at;) {
    const char *comma = strchr(at, ',');
    size_t size = comma ? (size_t)(comma - at) : strlen(at);
    if (size == length && memcmp(at, curve, length) == 0) return 1;
    at = comma ? comma + 1 : NULL;
  }
  return 0;
}

/* the curves of all files, one after the other; NULL at the end */
static const char *curve_at(const ambulo__people *people, int index) {
  for (int f = 0; f < people->count; f++) {
    const ambulo__reference *reference = &people->files[f].reference;
    if (index < reference->count) return reference->curves[index].entry->curve;
    index -= reference->count;
  }
  return NULL;
}

static int is_known(const ambulo__people *people, const char *name, size_t size) {
  const char *curve;
  for (int i = 0; (curve = curve_at(people, i)) != NULL; i++) {
    if (strlen(curve) == size && memcmp(curve, name, size) == 0) return 1;
  }
  return 0;
}

ambulo_status ambulo__curves_check(const char *list, const ambulo__people *people,
                                   ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = people->files[0].path};
  for (const char *at = list; at;) {
    char known[400] = "";
    const char *curve;
    size_t used = 0, size = strcspn(at, ",");
    if (is_known(people, at, size)) {
      at = at[size] ? at + size + 1 : NULL;
      continue;
    }
    for (int i = 0; used < sizeof known && (curve = curve_at(people, i)) != NULL; i++)
      used += (size_t)snprintf(known + used, sizeof known - used, "%s%s", i ? ", " : "", curve);
    return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "--columns: the reference has no curve '%.*s'; expected some of %s",
                         (int)(size < 100 ? size : 100), at, known);
  }
  return AMBULO_OK;
}

static double compare_doubt_largest(const double *y, int count) {
  double most = 0.0;
  for (int i = 0; i < count; i++) most = fmax(most, fabs(y[i]));
  return most;
}

int ambulo__curve_doubt(const ambulo__reference_curve *curve, const double *fine, const char *file,
                        ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = file};
  double from = curve->percent[0], to = curve->percent[curve->points - 1];
  double theirs = compare_doubt_largest(curve->mean, curve->points),
         ours = compare_doubt_largest(fine, AMBULO__FINE);
  if (to - from < whole) {
    ambulo__warning(diagnostics, place,
                    to <= 1.0 ? "a cycle is 0 to 100 percent, not 0 to 1" : NULL,
                    "'%s' covers %g to %g percent of the cycle; it is compared there",
                    curve->entry->curve, from, to);
    return 1;
  }
  if (curve->entry->unit != AMBULO__UNIT_ANGLE || theirs > most_radians) return 0;
  if (ours < least_ratio * theirs || ours > most_ratio * theirs) return 0;
  ambulo__warning(diagnostics, place, "references are in degrees",
                  "'%s' reaches %.3g degrees, the prediction %.3g: they look like radians",
                  curve->entry->curve, theirs, ours);
  return 1;
}
