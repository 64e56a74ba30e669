/* people/compare_subject.c - a person's own motion: its angles, its forces, and the strides in it
 * (compare.h). */
#include "people/compare.h"

#include "base/numtext.h"

#include <math.h>
#include <string.h>

static const char *const feet[] = {"left", "right"};
static const double near = 0.08;   /* of the stride: a strike by reach beside one by force */
static const double uneven = 1.35; /* longest over shortest stride of one foot */

typedef enum strike_kind { GIVEN, BY_FORCE, BY_REACH, NONE } strike_kind;

/* strikes with a force beside them are loaded; those by reach take its time */
static void adopt(ambulo__subject *s, int side, const double *onsets, int count, int take_time) {
  double *t = s->strikes[side];
  int n = s->count[side];
  for (int i = 0; i < n; i++) {
    double stride = n < 2 ? 0.0 : i + 1 < n ? t[i + 1] - t[i] : t[i] - t[i - 1];
    for (int k = 0; k < count; k++) {
      if (fabs(onsets[k] - t[i]) > near * stride) continue;
      if (take_time) t[i] = onsets[k];
      s->loaded[side][i] = 1;
      break;
    }
  }
  for (int i = 0; i < n; i++)
    s->loaded[side][i] = s->loaded[side][i] && i + 1 < n && t[i + 1] <= s->force_until + 1e-9;
}

static int is_inside(const ambulo__motion *m, double t) {
  double slack = 1e-6 * (m->time[m->rows - 1] - m->time[0]);
  return t >= m->time[0] - slack && t <= m->time[m->rows - 1] + slack;
}

/* times within those of the motion; their number */
static int keep_inside(const ambulo__motion *m, double *times, int count) {
  int kept = 0;
  for (int i = 0; i < count; i++) {
    if (is_inside(m, times[i])) times[kept++] = times[i];
  }
  return kept;
}

static ambulo_status find_side(ambulo__subject *s, int side, const char *given, double *onsets,
                               int onset_count, strike_kind *kind) {
  double *t = s->strikes[side];
  int *count = &s->count[side];
  *kind = GIVEN;
  ambulo_status status =
      ambulo__subject_given(given, side, s->file, s->diagnostics, t, AMBULO__MOST_STRIKES, count);
  if (status) return status;
  onset_count = keep_inside(s->table, onsets, onset_count);
  if (*count == 0 && onset_count > 1) {
    *kind = BY_FORCE;
    memcpy(t, onsets, (size_t)onset_count * sizeof *t);
    *count = onset_count;
  } else if (*count == 0) {
    *kind = BY_REACH;
    status = ambulo__subject_reach(s, side, t, AMBULO__MOST_STRIKES, count);
  }
  *count = keep_inside(s->table, t, *count);
  if (!status) adopt(s, side, onsets, onset_count, *kind == BY_REACH);
  if (*count < 2) *kind = NONE;
  return status;
}

/* how they were found, and whether they look like it */
static void tell(const ambulo__subject *s, const strike_kind kind[2]) {
  static const char *const how[] = {
      "as given", "where the force begins",
      "2 percent of the stride after the ankle is farthest ahead; sure to some 2 percent"};
  ambulo__place place = {.file = s->file};
  for (int side = 0; side < 2; side++) {
    if (kind[side] == NONE) continue;
    const double *t = s->strikes[side];
    double shortest = INFINITY, longest = 0.0;
    for (int i = 0; i + 1 < s->count[side]; i++) {
      shortest = fmin(shortest, t[i + 1] - t[i]);
      longest = fmax(longest, t[i + 1] - t[i]);
    }
    ambulo__note(s->diagnostics, place, "%s foot, strides: %d, of %.2f to %.2f s; strikes %s",
                 feet[side], s->count[side] - 1, shortest, longest, how[kind[side]]);
    if (longest > uneven * shortest)
      ambulo__warning(s->diagnostics, place, "--strike LEFT|RIGHT=T,T,... gives them",
                      "strides of the %s foot last from %.2f to %.2f s: strikes may be missing",
                      feet[side], shortest, longest);
  }
}

static ambulo_status find_strikes(ambulo__subject *s, const char *given, double *const onsets[2],
                                  const int onset_count[2]) {
  strike_kind kind[2] = {NONE, NONE};
  for (int side = 0; side < 2; side++) {
    ambulo_status status = find_side(s, side, given, onsets[side], onset_count[side], &kind[side]);
    if (status) return status;
  }
  tell(s, kind);
  ambulo__place place = {.file = s->file};
  if (kind[0] != NONE || kind[1] != NONE) return AMBULO_OK;
  return ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, place,
                       "--strike left=T,T,... gives the times at which the left heel strikes",
                       "no whole stride: %d strikes of the left foot and %d of the right one; "
                       "expected two of one foot from %g to %g s",
                       s->count[0], s->count[1], s->table->time[0],
                       s->table->time[s->table->rows - 1]);
}

static ambulo_status read_motion(ambulo__subject *s, const ambulo_compare_options *options) {
  static const char *const forces[AMBULO__SUBJECT_FORCES] = {
      "grf.left.x", "grf.left.y", "grf.left.z", "grf.right.x", "grf.right.y", "grf.right.z"};
  ambulo__motion *motion = NULL;
  ambulo_status status = ambulo__motion_read(s->file, 0, &s->allocator, s->diagnostics, &motion);
  if (!status && motion->rows < 5) {
    ambulo__place place = {.file = s->file};
    status = ambulo__error(s->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "%d times; expected at least 5", motion->rows);
  }
  if (!status)
    status =
        ambulo__subject_columns(s, motion, forces, options->forces ? AMBULO__SUBJECT_FORCES : 0);
  ambulo__motion_free(motion);
  return status;
}

ambulo_status ambulo__subject_open(const char *file, const ambulo_compare_options *options,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo__subject *subject) {
  ambulo__subject s = {.allocator = ambulo__allocator_or_default(allocator),
                       .diagnostics = diagnostics,
                       .file = file};
  double *onsets[2] = {NULL, NULL};
  int onset_count[2] = {0, 0}, failed = 0;
  ambulo_status status = read_motion(&s, options);
  for (int side = 0; !status && side < 2; side++) {
    onsets[side] = ambulo__alloc(&s.allocator, AMBULO__MOST_STRIKES, sizeof(double));
    s.strikes[side] = ambulo__alloc(&s.allocator, AMBULO__MOST_STRIKES, sizeof(double));
    s.loaded[side] = ambulo__alloc(&s.allocator, AMBULO__MOST_STRIKES, 1);
    failed |= !onsets[side] || !s.strikes[side] || !s.loaded[side];
  }
  if (failed) status = AMBULO_E_MEMORY;
  if (!status && options->forces)
    status =
        ambulo__subject_forces(&s, options->forces, options->force_columns, onsets, onset_count);
  if (!status) status = find_strikes(&s, options->strikes, onsets, onset_count);
  for (int side = 0; side < 2; side++) ambulo__free(&s.allocator, onsets[side]);
  if (status) {
    ambulo__subject_free(&s);
  } else {
    *subject = s;
  }
  return status;
}

void ambulo__subject_free(ambulo__subject *s) {
  for (int side = 0; side < 2; side++) {
    ambulo__free(&s->allocator, s->strikes[side]);
    ambulo__free(&s->allocator, s->loaded[side]);
  }
  ambulo__motion_free(s->table);
}

/* when feet strike, as the angles of the legs tell it.
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
