/* people/compare_curve.c - curves over the cycle: of one foot or the mean of both, and as a table
 * (compare.h). */
#include "people/compare.h"

#include "base/text_buffer.h"
#include "formats/atomic_file.h"

#include <math.h>
#include <string.h>

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

enum { POINTS = 101 };

typedef struct cycles {
  const ambulo_allocator *allocator;
  ambulo__map map;                 /* of all curves */
  double *values, *deviations;     /* [curves][POINTS] */
  const ambulo__map_entry **entry; /* [curves] */
  int *strides;                    /* [curves] */
  int count;
} cycles;

ambulo_status ambulo__cycles_check(const char *motion, const char *people,
                                   const ambulo_compare_options *options,
                                   ambulo_diagnostics *diagnostics) {
  const char *inputs[] = {motion, people, options->forces, options->map};
  if (!options->cycles) return AMBULO_OK;
  return ambulo__output_check(options->cycles, inputs, 4, options->overwrite, diagnostics);
}

/* 1 for entries that go by the curve's own name */
static int is_own(const ambulo__map_entry *entry) {
  return strcmp(entry->reference, entry->curve) == 0;
}

static ambulo_status collect(ambulo__sampler *sampler, cycles *c) {
  double percents[POINTS];
  for (int i = 0; i < POINTS; i++) percents[i] = (double)i;
  for (int i = 0; i < c->map.count; i++) {
    size_t at = (size_t)c->count * POINTS;
    if (!is_own(&c->map.entries[i])) continue;
    ambulo_status status =
        ambulo__sample_curve(sampler, &c->map.entries[i], percents, POINTS, c->values + at,
                             c->deviations + at, &c->strides[c->count]);
    if (status) return status;
    c->entry[c->count] = &c->map.entries[i];
    c->count += c->strides[c->count] > 0;
  }
  return AMBULO_OK;
}

static void append_number(ambulo__text_buffer *text, double value) {
  double rounded = round(value * 1e6) / 1e6;
  ambulo__text_append(text, ",");
  ambulo__text_append_number(text, rounded == 0.0 ? 0.0 : rounded);
}

static void print(const ambulo__sampler *sampler, const cycles *c, ambulo__text_buffer *text) {
  const char *file = sampler->cycle->motion_path;
  const ambulo__subject *subject = sampler->cycle->subject;
  ambulo__text_append(text,
                      AMBULO__OWN_MARK " cycles: percent of the cycle from heel strike to heel "
                                       "strike; means over strides and feet\n");
  ambulo__text_append_format(text, "# source: %s", file);
  if (subject) {
    int left = subject->count[0] - 1, right = subject->count[1] - 1;
    ambulo__text_append_format(text, ", strides: %d left, %d right", left > 0 ? left : 0,
                               right > 0 ? right : 0);
  }
  ambulo__text_append(text, "\npercent");
  for (int i = 0; i < c->count; i++) {
    ambulo__text_append_format(text, ",%s", c->entry[i]->reference);
    if (c->strides[i] > 1 && subject)
      ambulo__text_append_format(text, ",%s sd", c->entry[i]->reference);
  }
  ambulo__text_append(text, "\n");
  for (int i = 0; i < c->count; i++) {
    const char *unit = ambulo__curve_unit_name(c->entry[i]->unit);
    ambulo__text_append_format(text, c->strides[i] > 1 && subject ? ",%s,%s" : ",%s", unit, unit);
  }
  for (int p = 0; p < POINTS; p++) {
    ambulo__text_append_format(text, "\n%d", p);
    for (int i = 0; i < c->count; i++) {
      append_number(text, c->values[i * POINTS + p]);
      if (c->strides[i] > 1 && subject) append_number(text, c->deviations[i * POINTS + p]);
    }
  }
  ambulo__text_append(text, "\n");
}

ambulo_status ambulo__cycles_write(ambulo__sampler *sampler) {
  const ambulo_allocator *a = &sampler->cycle->allocator;
  const char *file = sampler->options->cycles;
  cycles c = {.allocator = a};
  ambulo__text_buffer text;
  ambulo__text_init(&text, a);
  ambulo_status status = ambulo__map_default(AMBULO__LAYOUT_WIDE, a, &c.map);
  size_t room = (size_t)c.map.count;
  c.values = ambulo__alloc(a, room * POINTS, sizeof *c.values);
  c.deviations = ambulo__alloc(a, room * POINTS, sizeof *c.deviations);
  c.entry = ambulo__alloc(a, room, sizeof *c.entry);
  c.strides = ambulo__alloc(a, room, sizeof *c.strides);
  if (!status && (!c.values || !c.deviations || !c.entry || !c.strides)) status = AMBULO_E_MEMORY;
  if (!status) status = collect(sampler, &c);
  if (!status) {
    print(sampler, &c, &text);
    status = ambulo__text_status(&text);
  }
  if (!status)
    status = ambulo__write_file(file, ambulo__text_data(&text), text.length, 1, a,
                                sampler->cycle->diagnostics);
  ambulo__text_free(&text);
  ambulo__free(a, c.values);
  ambulo__free(a, c.deviations);
  ambulo__free(a, (void *)c.entry);
  ambulo__free(a, c.strides);
  ambulo__map_free(&c.map);
  return status;
}
