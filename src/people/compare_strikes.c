/* people/compare_strikes.c - when feet strike, as the angles of the legs tell it.
 *
 * Zeni, Richards & Higginson (2008), Gait & Posture 27:710: the heel strikes when it is farthest
 * ahead of the pelvis. Of a motion without markers the ankle's way ahead of the hip stands for it,
 *
 *     x = a sin(f) + b sin(f - k),  f = pelvis_tilt + hip_flexion,  k = knee_angle,
 *
 * with a and b thigh and shank (their ratio is that of the shipped models; x has no unit). x has
 * its peak a little early, as the leg swings back before it lands: at 98, 96, 98 and 98 percent of
 * the cycle in the means of WBDS 2018, CGM 2.3, Schwartz 2008 (free) and in the walk of Rajagopal
 * 2016. The strike is put 2 percent of the stride after the peak.
 *
 * A peak lies in the upper two fifths of x's range and is the largest within 0.4 s. Legs whose x
 * ranges over less than 0.05, a tenth of their length, do not walk. */
#include "people/compare_subject.h"

#include <math.h>
#include <string.h>

#include "base/numtext.h"

static const double thigh = 0.2425, shank = 0.2493;
static const double late = 0.02, upper = 0.6, apart = 0.4, still = 0.05;

static const double *column_of(const ambulo__motion *table, const char *name) {
  int column = ambulo__motion_column(table, name);
  return column < 0 ? NULL : table->values + column;
}

/* x[rows]; 0 where the angles are not there */
static int fill_reach(const ambulo__motion *table, int side, double *x) {
  const double *hip = column_of(table, side == 0 ? "q.hip_flexion_l" : "q.hip_flexion_r");
  const double *knee = column_of(table, side == 0 ? "q.knee_angle_l" : "q.knee_angle_r");
  const double *tilt = column_of(table, "q.pelvis_tilt");
  if (!hip || !knee) return 0;
  for (int k = 0; k < table->rows; k++) {
    size_t at = (size_t)k * (size_t)table->columns;
    double f = hip[at] + (tilt ? tilt[at] : 0.0);
    x[k] = thigh * sin(f) + shank * sin(f - knee[at]);
  }
  return 1;
}

static int is_peak(const double *time, const double *x, int rows, int k, double least) {
  if (x[k] < least || x[k - 1] >= x[k] || x[k + 1] > x[k]) return 0;
  for (int i = k - 1; i >= 0 && time[k] - time[i] < apart; i--) {
    if (x[i] >= x[k]) return 0;
  }
  for (int i = k + 1; i < rows && time[i] - time[k] < apart; i++) {
    if (x[i] > x[k]) return 0;
  }
  return 1;
}

/* time of the vertex of the parabola through the samples k - 1, k, k + 1 */
static double vertex(const double *t, const double *x, int k) {
  double left = t[k] - t[k - 1], right = t[k + 1] - t[k];
  double rise = (x[k] - x[k - 1]) / left, fall = (x[k + 1] - x[k]) / right;
  if (!(rise > fall)) return t[k];
  return t[k] + (right * rise + left * fall) / (2.0 * (rise - fall));
}

ambulo_status ambulo__subject_reach(const ambulo__subject *s, int side, double *strikes, int most,
                                    int *count) {
  int rows = s->table->rows, n = 0;
  const double *t = s->table->time;
  double *x = ambulo__alloc(&s->allocator, (size_t)rows, sizeof *x);
  if (!x) return AMBULO_E_MEMORY;
  *count = 0;
  if (fill_reach(s->table, side, x)) {
    double low = x[0], high = x[0];
    for (int k = 0; k < rows; k++) {
      low = fmin(low, x[k]);
      high = fmax(high, x[k]);
    }
    for (int k = 1; k + 1 < rows && n < most && high - low > still; k++) {
      if (is_peak(t, x, rows, k, low + upper * (high - low))) strikes[n++] = vertex(t, x, k);
    }
  }
  ambulo__free(&s->allocator, x);
  /* the last one is as late as the stride before it was long */
  double stride = 0.0;
  for (int i = 0; i < n; i++) {
    if (i + 1 < n) stride = strikes[i + 1] - strikes[i];
    strikes[i] += late * stride;
  }
  *count = n;
  return AMBULO_OK;
}

/* --------------------------------------------------------------------- given */

ambulo_status ambulo__subject_given(const char *text, int side, const char *file,
                                    ambulo_diagnostics *diagnostics, double *strikes, int most,
                                    int *count) {
  static const char *const sides[] = {"left=", "right="};
  ambulo__place place = {.file = file};
  *count = 0;
  for (const char *part = text; part && *part;) {
    size_t length = strcspn(part, ";");
    const char *end = part + length;
    int of = strncmp(part, sides[0], 5) == 0 ? 0 : strncmp(part, sides[1], 6) == 0 ? 1 : -1;
    const char *at = part + (of < 0 ? 0 : strlen(sides[of]));
    int good = of >= 0 && at < end;
    double before = -INFINITY;
    while (good && at < end) {
      size_t size = strcspn(at, ",;");
      double time;
      good = ambulo__parse_double(at, size, &time) && time > before && at + size != end - 1;
      if (good && of == side && *count < most) strikes[(*count)++] = time;
      if (good) before = time;
      at += size + (at + size < end);
    }
    if (!good)
      return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, place, NULL,
                           "strikes '%.*s'; expected left=T,T,... or right=T,T,... with rising "
                           "times in s",
                           (int)(length < 80 ? length : 80), part);
    part = *end ? end + 1 : end;
  }
  return AMBULO_OK;
}
