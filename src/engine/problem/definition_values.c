/* problem/definition_values.c - values by loops over the members (members.h): defaults, definitions
 * by programs of older headers, and those for a body of another size.
 *
 * A definition holds parts by value. In an older one they, and the whole, may be shorter:
 *
 *     ours    [ a ][ clearance .... ][ ground_reaction .. ][ b ][ collision ... ][ c ..... ]
 *     theirs  [ a ][ clearance ][ ground_reaction ][ b ][ collision ][ c .. ]
 *
 * with the same a and b, between parts, and a beginning of c. The sizes stand at the beginning of
 * a. Items of arrays follow the sizes of theirs (base/sized.h).
 */
#include "ambulo/evaluate.h"
#include "base/alloc.h"
#include "base/sized.h"
#include "problem/definition.h"
#include "problem/members.h"
#include "problem/term.h"

#include <math.h>
#include <string.h>

typedef ambulo_problem_definition definition;

/* --------------------------------------------------------------------- defaults */

static const struct {
  const char *name;
  const ambulo__structure *members;
} parts[] = {{"ambulo_contact", &ambulo__contact_members},
             {"ambulo_end_value", &ambulo__end_value_members},
             {"ambulo_tube", &ambulo__tube_members},
             {"ambulo_user_row", &ambulo__user_row_members},
             {"ambulo_ground_reaction", &ambulo__ground_reaction_members},
             {"ambulo_clearance", &ambulo__clearance_members},
             {"ambulo_collision", &ambulo__collision_members},
             {"ambulo_capsule_pair", &ambulo__capsule_pair_members},
             {"ambulo_obstacle", &ambulo__obstacle_members},
             {"ambulo_reach", &ambulo__reach_members},
             {"ambulo_hold", &ambulo__hold_members},
             {"ambulo_device", &ambulo__device_members},
             {"ambulo_term", &ambulo__term_members},
             {"ambulo_options", &ambulo__options_members}};

typedef union part_storage {
  int kind; /* the first member of devices and terms, which have one */
  ambulo_contact contact;
  ambulo_end_value end_value;
  ambulo_tube tube;
  ambulo_user_row user_row;
  ambulo_ground_reaction ground_reaction;
  ambulo_clearance clearance;
  ambulo_collision collision;
  ambulo_capsule_pair capsule_pair;
  ambulo_obstacle obstacle;
  ambulo_reach reach;
  ambulo_hold hold;
  ambulo_device device;
  ambulo_term term;
  ambulo_options options;
} part_storage;

/* defaults of a part of which `item` is the beginning, so that it has its kind */
static void fill_part(const ambulo__structure *s, part_storage *usual, const void *item) {
  ambulo__members_fill(s, usual);
  if (s != &ambulo__device_members && s != &ambulo__term_members) return;
  memcpy(&usual->kind, item, sizeof usual->kind);
  if (s == &ambulo__device_members) return;
  const ambulo__term_info *info = ambulo__term_info_of(usual->term.kind);
  if (info && info->smoothing > 0.0) usual->term.smoothing = info->smoothing;
  if (info && info->power > 0.0) usual->term.power = info->power;
}

/* ------------------------------------------------------------- older definitions */

enum { MOST_PARTS = 4, MOST_RUNS = 2 * MOST_PARTS + 1 };

/* A run of bytes that both have. */
typedef struct run {
  size_t ours, theirs, length;
} run;

static size_t size_at(const definition *d, size_t at) {
  size_t size;
  memcpy(&size, (const char *)d + at, sizeof size);
  return size;
}

static void set_size(definition *d, size_t at, size_t size) {
  memcpy((char *)d + at, &size, sizeof size);
}

/* Fills `runs`, in order, and returns how many; 0: no header of this library or of an older one had
 * these sizes. */
static int runs_of(const definition *theirs, run runs[MOST_RUNS]) {
  const ambulo__structure *s = &ambulo__definition_members;
  size_t ours = 0, given = 0;
  int known = 1, count = 0;
  for (int i = 0; i < s->count && count + 2 < MOST_RUNS; i++) {
    const ambulo__member *m = &s->members[i];
    if (m->type != AMBULO__PART) continue;
    size_t size = size_at(theirs, m->size_at), full = m->of->size;
    known &= ambulo__sized_item(size, full) && size % sizeof(double) == 0;
    runs[count++] = (run){ours, given, m->at - ours};
    given += m->at - ours;
    runs[count++] = (run){m->at, given, size < full ? size : full};
    given += size;
    ours = m->at + full;
  }
  size_t behind = sizeof(definition) - ours, left = theirs->size - given;
  known &= theirs->size >= given && left <= behind;
  runs[count++] = (run){ours, given, left < behind ? left : behind};
  return known ? count : 0;
}

static void fill_definition(definition *filled) {
  definition usual;
  run runs[MOST_RUNS];
  ambulo__members_fill(&ambulo__definition_members, &usual);
  memcpy(&usual, filled, offsetof(definition, name)); /* the sizes */
  int count = runs_of(&usual, runs);
  memset(filled, 0, usual.size); /* what a newer header has besides */
  for (int i = 0; i < count; i++)
    memcpy((char *)filled + runs[i].theirs, (const char *)&usual + runs[i].ours, runs[i].length);
}

ambulo_status ambulo_problem_defaults(const char *name, void *structure, size_t bytes) {
  if (!name || !structure || bytes < sizeof(int)) return AMBULO_E_ARGUMENT;
  if (strcmp(name, "ambulo_problem_definition") == 0) {
    if (bytes < offsetof(definition, name)) return AMBULO_E_ARGUMENT;
    memcpy(structure, &bytes, sizeof bytes);
    fill_definition(structure);
    return AMBULO_OK;
  }
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
    if (strcmp(name, parts[i].name) != 0) continue;
    part_storage usual;
    fill_part(parts[i].members, &usual, structure);
    ambulo__sized_fill(structure, bytes, &usual, parts[i].members->size);
    int begins_with_size = parts[i].members->members[0].at > 0;
    if (begins_with_size) memcpy(structure, &bytes, sizeof bytes);
    return AMBULO_OK;
  }
  return AMBULO_E_ARGUMENT;
}

/* *array of `count` items; E_ARGUMENT: no header had their size */
static ambulo_status take_items(ambulo__taken_definition *taken, const ambulo__structure *s,
                                const void **array, int count, size_t size) {
  if (!ambulo__sized_item(size, s->size)) return AMBULO_E_ARGUMENT;
  if (size == s->size || !*array || count < 1) return AMBULO_OK;
  char *longer = ambulo__alloc(&taken->allocator, (size_t)count, s->size);
  if (!longer) return AMBULO_E_MEMORY;
  for (size_t i = 0; i < (size_t)count; i++) {
    const char *given = (const char *)*array + i * size;
    part_storage usual;
    fill_part(s, &usual, given);
    memcpy(longer + i * s->size, &usual, s->size);
    memcpy(longer + i * s->size, given, size);
  }
  *array = taken->longer[taken->count++] = longer;
  return AMBULO_OK;
}

/* arrays of a structure of the definition, which is whole already */
static ambulo_status take_arrays(ambulo__taken_definition *taken, const ambulo__structure *s,
                                 void *part) {
  definition *d = &taken->definition;
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < s->count && !status; i++) {
    const ambulo__member *m = &s->members[i];
    if (m->type == AMBULO__PART) status = take_arrays(taken, m->of, (char *)part + m->at);
    if (m->type != AMBULO__ITEMS) continue;
    const void *array = ambulo__member_array(m, part);
    int count = (int)ambulo__member_length(m, d, part);
    status = take_items(taken, m->of, &array, count, size_at(d, m->size_at));
    memcpy((char *)part + m->at, &array, sizeof array);
    set_size(d, m->size_at, m->of->size);
  }
  return status;
}

static void take_begin(ambulo__taken_definition *taken, const ambulo_allocator *allocator) {
  *taken = (ambulo__taken_definition){.definition = ambulo_problem_definition_default(),
                                      .allocator = ambulo__allocator_or_default(allocator)};
}

ambulo_status ambulo__definition_take(const ambulo_problem_definition *given,
                                      const ambulo_allocator *allocator,
                                      ambulo__taken_definition *taken) {
  run runs[MOST_RUNS];
  definition *d = &taken->definition;
  take_begin(taken, allocator);
  int count = given && given->size > offsetof(definition, name) ? runs_of(given, runs) : 0;
  if (count == 0) return AMBULO_E_ARGUMENT;
  for (int i = 0; i < count; i++)
    memcpy((char *)d + runs[i].ours, (const char *)given + runs[i].theirs, runs[i].length);
  d->size = sizeof *d;
  d->clearance_size = sizeof d->clearance;
  d->ground_reaction_size = sizeof d->ground_reaction;
  d->collision_size = sizeof d->collision;
  return take_arrays(taken, &ambulo__definition_members, d);
}

ambulo_status ambulo__extension_take(const ambulo_extension *given,
                                     const ambulo_allocator *allocator,
                                     ambulo__taken_definition *taken) {
  ambulo_extension own = ambulo_extension_default();
  definition *d = &taken->definition;
  take_begin(taken, allocator);
  if (!given || !ambulo__sized_take(&own, sizeof own, given)) return AMBULO_E_ARGUMENT;
  d->terms = own.terms;
  d->term_count = own.term_count;
  d->term_size = own.term_size;
  d->user_rows = own.user_rows;
  d->user_row_count = own.user_row_count;
  d->user_row_size = own.user_row_size;
  return take_arrays(taken, &ambulo__definition_members, d);
}

void ambulo__definition_drop(ambulo__taken_definition *taken) {
  for (int i = 0; i < taken->count; i++) ambulo__free(&taken->allocator, taken->longer[i]);
}

/* ------------------------------------------------------------- another size */

/* A definition's numbers for a body of another size.
 *
 * Bodies of one shape walk alike at one speed number v / sqrt(g H) if all that a walk is made of
 * is alike in units of the body: length H, time sqrt(H / g), mass M. Numbers for one body, in SI,
 * become for a body H' = longer H, M' = heavier M
 *
 *     lengths (tolerances, clearance, pressure, moment arm, free moment, step width)  longer
 *     loading rate, 1/s                                        1 / sqrt(longer)
 *     scale of a torque, 1 / N m                               1 / (heavier longer)
 *     scale of a force, 1 / N                                  1 / heavier
 *     torques and forces (offset, passive, strength)           their inverses
 *     rate of a torque, scale in s / N m                       sqrt(longer) / (heavier longer)
 *     turning acceleration, scale in s^2                       longer; of a translation as it is
 *     mechanical power, scale in kg / W                        1 / sqrt(longer)
 *     tendon, N m/rad; of a translation, N/m                   heavier longer; heavier / longer
 *     rate of a force, weight in s^2 by its square             longer
 *     rest of a translation, m; its scale, 1/m                 longer; 1 / longer
 *
 * Left as they are: angles, ratios, forces in body weights, prices (strength: limits), and the
 * task: speed, lengths and times of steps, contacts, ground, load, ends, tubes, references.
 * Integrals over time come out sqrt(longer) times as large, all alike.
 */

/* members that are as long as the body is, and the rate of loading; those of parts, too */
static void resize_members(const ambulo__structure *structure, double longer, void *item) {
  for (int i = 0; i < structure->count; i++) {
    const ambulo__member *m = &structure->members[i];
    double *value = (double *)(void *)((char *)item + m->at);
    if (m->type == AMBULO__PART) resize_members(m->of, longer, value);
    if (m->type != AMBULO__NUMBER) continue;
    for (int k = 0; k < m->count; k++) { /* NaN, which says off, stays so */
      if (m->flags & AMBULO__BODY_LENGTH) value[k] *= longer;
      if (m->quantity == AMBULO__LOADING_RATE) value[k] /= sqrt(longer);
    }
  }
}

typedef struct factors {
  double scale, offset;
} factors;

static factors factors_of(const ambulo_term *term, int turns, double longer, double heavier) {
  double force = turns ? heavier * longer : heavier, place = turns ? 1.0 : longer;
  int is_price = term->strength_is_limits || term->strength;
  switch (ambulo__term_info_of(term->kind)->subject) {
  case AMBULO__TERM_OF_TORQUE:
    return (factors){is_price ? 1.0 : 1.0 / force, force};
  case AMBULO__TERM_OF_TORQUE_RATE:
    return (factors){sqrt(longer) / force, 1.0};
  case AMBULO__TERM_OF_POWER:
    return (factors){1.0 / sqrt(longer), 1.0};
  case AMBULO__TERM_OF_ACCELERATION:
    return (factors){turns ? longer : 1.0, 1.0};
  case AMBULO__TERM_OF_POSITION:
    return (factors){1.0 / place, place};
  case AMBULO__TERM_OF_OTHERS: /* a device is what it is, whoever wears it */
    break;
  }
  return (factors){1.0, 1.0};
}

ambulo__term_sizes ambulo__term_sizes_of(const ambulo_term *term, int turns, double longer,
                                         double heavier) {
  factors by = factors_of(term, turns, longer, heavier);
  return (ambulo__term_sizes){.weight =
                                  ambulo__term_info_of(term->kind)->weight_is_length ? longer : 1.0,
                              .scale = by.scale,
                              .offset = by.offset,
                              .tendon = turns ? heavier * longer : heavier / longer,
                              .peak = heavier * longer};
}

/* what a const view of an array of the caller's own shows */
static double *own(const double *array) {
  union {
    const double *view;
    double *array;
  } of = {array};
  return of.array;
}

/* count blocks of `stride` numbers, of which the first is a torque */
static void resize_peaks(const double *peaks, int count, int stride, double factor) {
  for (int i = 0; peaks && i < count; i++) own(peaks)[i * stride] *= factor;
}

static void resize_term(ambulo_term *term, const ambulo_model *model, double longer,
                        double heavier) {
  int count = ambulo_model_coordinate_count(model);
  ambulo__term_sizes by = ambulo__term_sizes_of(term, 0, longer, heavier);
  for (int i = 0; i < count; i++) {
    int turns = ambulo_model_coordinate(model, i)->type == AMBULO_REVOLUTE;
    by = ambulo__term_sizes_of(term, turns, longer, heavier);
    if (term->scale) own(term->scale)[i] *= by.scale;
    if (term->offset) own(term->offset)[i] *= by.offset;
    if (term->tendon) own(term->tendon)[i] *= by.tendon;
  }
  resize_peaks(term->passive, 2 * count, 2, by.peak);
  resize_peaks(term->strength, 2 * count, 3, by.peak);
  term->weight *= by.weight;
  resize_members(&ambulo__term_members, longer, term); /* height */
}

void ambulo__definition_resize(ambulo_problem_definition *d, int terms, double longer,
                               double heavier) {
  union {
    const ambulo_term *view;
    ambulo_term *terms;
  } of = {d->terms};
  resize_members(&ambulo__definition_members, longer, d);
  for (int t = 0; t < terms; t++) resize_term(&of.terms[t], d->model, longer, heavier);
}
