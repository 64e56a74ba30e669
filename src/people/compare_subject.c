/* people/compare_subject.c - see compare_subject.h. */
#include "people/compare_subject.h"
#include "ambulo/tools/compare.h"

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
  ambulo_status status = ambulo__motion_read(s->file, &s->allocator, s->diagnostics, &motion);
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
