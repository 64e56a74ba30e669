/* people/compare_curve.c - see compare_curve.h. */
#include "people/compare_curve.h"
#include "ambulo/tools/compare.h"

#include <math.h>

/* sides further apart than this share of the range are not averaged */
static const double alike = 0.1;
static const double degrees = 57.295779513082321;

ambulo_status ambulo__sampler_create(ambulo__cycle *cycle, const ambulo_compare_options *options,
                                     int most, ambulo__sampler *sampler) {
  ambulo__sampler s = {.cycle = cycle, .options = options, .most = most};
  const ambulo_allocator *a = &cycle->allocator;
  s.other = ambulo__alloc(a, (size_t)most, sizeof *s.other);
  for (int i = 0; i < 2; i++) s.square[i] = ambulo__alloc(a, (size_t)most, sizeof(double));
  *sampler = s;
  return s.other && s.square[0] && s.square[1] ? AMBULO_OK : AMBULO_E_MEMORY;
}

void ambulo__sampler_free(ambulo__sampler *s) {
  if (!s->cycle) return;
  ambulo__free(&s->cycle->allocator, s->other);
  for (int i = 0; i < 2; i++) ambulo__free(&s->cycle->allocator, s->square[i]);
}

/* how far two curves are apart, as a share of the first one's range */
static double difference(const double *a, const double *b, int count) {
  double least = a[0], most = a[0], squares = 0.0;
  for (int i = 0; i < count; i++) {
    least = fmin(least, a[i]);
    most = fmax(most, a[i]);
    squares += (a[i] - b[i]) * (a[i] - b[i]);
  }
  double rms = sqrt(squares / (double)count);
  return rms == 0.0 ? 0.0 : rms / (most - least);
}

static void tell_sides_apart(ambulo__sampler *s, const char *curve) {
  if (s->warned_sides) return;
  ambulo__place place = {.file = s->cycle->motion_path};
  ambulo__note(s->cycle->diagnostics, place,
               "'%s' differs between the sides; such curves are those of the left foot alone",
               curve);
  s->warned_sides = 1;
}

/* the foot that is asked for; else left, or right where only that one has the curve */
static ambulo_status first_foot(ambulo__sampler *s, const ambulo__map_entry *entry,
                                const double *percents, int count, double *values, int *strides,
                                ambulo__cycle_side *side) {
  const char *foot = s->options->foot;
  *side = foot && foot[0] == 'r' ? AMBULO__CYCLE_RIGHT : AMBULO__CYCLE_LEFT;
  ambulo_status status =
      ambulo__cycle_spread(s->cycle, entry, *side, percents, count, values, s->square[0], strides);
  if (status || *strides > 0 || foot || !s->cycle->subject) return status;
  *side = AMBULO__CYCLE_RIGHT;
  return ambulo__cycle_spread(s->cycle, entry, *side, percents, count, values, s->square[0],
                              strides);
}

ambulo_status ambulo__sample_curve(ambulo__sampler *s, const ambulo__map_entry *entry,
                                   const double *percents, int count, double *values,
                                   double *deviations, int *strides) {
  ambulo__cycle_side side;
  int others = 0;
  ambulo_status status = first_foot(s, entry, percents, count, values, strides, &side);
  if (status || *strides == 0) return status;
  if (!s->options->foot && side == AMBULO__CYCLE_LEFT)
    status = ambulo__cycle_spread(s->cycle, entry, AMBULO__CYCLE_RIGHT, percents, count, s->other,
                                  s->square[1], &others);
  if (status) return status;
  if (others > 0 && difference(values, s->other, count) > alike) {
    tell_sides_apart(s, entry->curve);
    others = 0;
  }
  *strides += others;
  int tilts = entry->tilted && !(s->cycle->subject && s->cycle->subject->marker_pelvis);
  double shift = tilts ? s->options->pelvic_tilt * degrees : 0.0, n = (double)*strides;
  for (int i = 0; i < count; i++) {
    double square = s->square[0][i];
    if (others > 0) {
      values[i] = 0.5 * (values[i] + s->other[i]);
      square = 0.5 * (square + s->square[1][i]);
    }
    if (deviations) {
      double variance = fmax(0.0, square - values[i] * values[i]);
      deviations[i] = n > 1.0 ? sqrt(variance * n / (n - 1.0)) : (double)NAN;
    }
    values[i] += shift;
  }
  return AMBULO_OK;
}
