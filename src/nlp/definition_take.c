/* nlp/definition_take.c - definitions of problems by programs of older headers.
 *
 * A definition holds three parts by value. In an older one they, and the whole, may be shorter:
 *
 *     ours    [ a ][ clearance .... ][ ground_reaction .. ][ b ][ collision ... ][ c ..... ]
 *     theirs  [ a ][ clearance ][ ground_reaction ][ b ][ collision ][ c .. ]
 *
 * with the same a and b, between parts, and a beginning of c. The sizes stand at the beginning of
 * a. Items of arrays follow the sizes of theirs (base/sized.h).
 */
#include "nlp/definition_take.h"
#include "base/alloc.h"
#include "base/sized.h"

#include <stddef.h>
#include <string.h>

typedef ambulo_problem_definition definition;

enum { PARTS = 3 };
static const struct {
  size_t at, full;
} parts[PARTS] = {
    {offsetof(definition, clearance), sizeof(ambulo_clearance)},
    {offsetof(definition, ground_reaction), sizeof(ambulo_ground_reaction)},
    {offsetof(definition, collision), sizeof(ambulo_collision)},
};

/* A run of bytes that both have. */
typedef struct run {
  size_t ours, theirs, length;
} run;

/* fills `runs`, in order; 0: no header of this library or of an older one had these sizes */
static int runs_of(const definition *theirs, run runs[2 * PARTS + 1]) {
  const size_t part_size[PARTS] = {theirs->clearance_size, theirs->ground_reaction_size,
                                   theirs->collision_size};
  size_t ours = 0, given = 0;
  int known = 1;
  for (int i = 0; i < PARTS; i++) {
    size_t size = part_size[i], full = parts[i].full;
    known &= ambulo__sized_item(size, full) && size % sizeof(double) == 0;
    runs[2 * i] = (run){ours, given, parts[i].at - ours};
    given += parts[i].at - ours;
    runs[2 * i + 1] = (run){parts[i].at, given, size < full ? size : full};
    given += size;
    ours = parts[i].at + full;
  }
  size_t behind = sizeof(definition) - ours, left = theirs->size - given;
  known &= theirs->size >= given && left <= behind;
  runs[2 * PARTS] = (run){ours, given, left < behind ? left : behind};
  return known;
}

void ambulo__definition_give(const ambulo_problem_definition *usual,
                             ambulo_problem_definition *given) {
  run runs[2 * PARTS + 1];
  definition all = *usual;
  memcpy(&all, given, offsetof(definition, name)); /* the sizes */
  (void)runs_of(&all, runs);
  memset(given, 0, all.size); /* what a newer header has besides */
  for (int i = 0; i < 2 * PARTS + 1; i++)
    memcpy((char *)given + runs[i].theirs, (const char *)&all + runs[i].ours, runs[i].length);
}

static void usual_contact(void *item, const void *given) {
  (void)given;
  *(ambulo_contact *)item = ambulo_contact_default();
}

static void usual_end_value(void *item, const void *given) {
  (void)given;
  *(ambulo_end_value *)item = ambulo_end_value_default();
}

static void usual_tube(void *item, const void *given) {
  (void)given;
  *(ambulo_tube *)item = ambulo_tube_default();
}

static void usual_obstacle(void *item, const void *given) {
  (void)given;
  *(ambulo_obstacle *)item = ambulo_obstacle_default();
}

static void usual_reach(void *item, const void *given) {
  (void)given;
  *(ambulo_reach *)item = ambulo_reach_default();
}

static void usual_device(void *item, const void *given) {
  ambulo_device_kind kind; /* the first member */
  memcpy(&kind, given, sizeof kind);
  *(ambulo_device *)item = ambulo_device_default(kind);
}

static void usual_hold(void *item, const void *given) {
  (void)given;
  *(ambulo_hold *)item = ambulo_hold_default();
}

static void usual_term(void *item, const void *given) {
  ambulo_term_kind kind; /* the first member */
  memcpy(&kind, given, sizeof kind);
  *(ambulo_term *)item = ambulo_term_default(kind);
}

static void usual_user_row(void *item, const void *given) {
  (void)given;
  *(ambulo_user_row *)item = ambulo_user_row_default();
}

static void usual_capsule_pair(void *item, const void *given) {
  (void)given;
  *(ambulo_capsule_pair *)item = ambulo_capsule_pair_default();
}

/* *array of `count` items; E_ARGUMENT: no header had their size */
static ambulo_status take_items(ambulo__taken_definition *taken, const void **array, int count,
                                size_t size, size_t full, ambulo__usual_item *fill) {
  if (!ambulo__sized_item(size, full)) return AMBULO_E_ARGUMENT;
  if (size == full || !*array || count < 1) return AMBULO_OK;
  void *longer = ambulo__sized_items(&taken->allocator, *array, count, size, full, fill);
  if (!longer) return AMBULO_E_MEMORY;
  *array = taken->longer[taken->count++] = longer;
  return AMBULO_OK;
}

#define TAKE(of, array, item)                                                                      \
  do {                                                                                             \
    const void *items = (of)->array;                                                               \
    if (!status)                                                                                   \
      status = take_items(taken, &items, (of)->item##_count, (of)->item##_size,                    \
                          sizeof *(of)->array, usual_##item);                                      \
    (of)->array = items;                                                                           \
    (of)->item##_size = sizeof *(of)->array;                                                       \
  } while (0)

ambulo_status ambulo__definition_take(const ambulo_problem_definition *given,
                                      const ambulo_allocator *allocator,
                                      ambulo__taken_definition *taken) {
  run runs[2 * PARTS + 1];
  *taken = (ambulo__taken_definition){.definition = ambulo_problem_definition_default(),
                                      .allocator = ambulo__allocator_or_default(allocator)};
  if (!given || given->size <= offsetof(definition, name) || !runs_of(given, runs))
    return AMBULO_E_ARGUMENT;
  definition *d = &taken->definition;
  for (int i = 0; i < 2 * PARTS + 1; i++)
    memcpy((char *)d + runs[i].ours, (const char *)given + runs[i].theirs, runs[i].length);
  d->size = sizeof *d;
  d->clearance_size = sizeof d->clearance;
  d->ground_reaction_size = sizeof d->ground_reaction;
  d->collision_size = sizeof d->collision;
  ambulo_status status = AMBULO_OK;
  TAKE(d, contacts, contact);
  TAKE(d, end_values, end_value);
  TAKE(d, tubes, tube);
  TAKE(d, obstacles, obstacle);
  TAKE(d, reaches, reach);
  TAKE(d, devices, device);
  TAKE(d, holds, hold);
  TAKE(d, terms, term);
  TAKE(d, user_rows, user_row);
  const void *pairs = d->collision.pairs;
  if (!status)
    status = take_items(taken, &pairs, d->collision.pair_count, d->capsule_pair_size,
                        sizeof *d->collision.pairs, usual_capsule_pair);
  d->collision.pairs = pairs;
  d->capsule_pair_size = sizeof *d->collision.pairs;
  return status;
}

ambulo_status ambulo__extension_take(const ambulo_extension *given,
                                     const ambulo_allocator *allocator,
                                     ambulo__taken_definition *taken) {
  ambulo_extension own = ambulo_extension_default(), *e = &own;
  *taken = (ambulo__taken_definition){.definition = ambulo_problem_definition_default(),
                                      .allocator = ambulo__allocator_or_default(allocator)};
  if (!given || !ambulo__sized_take(e, sizeof *e, given)) return AMBULO_E_ARGUMENT;
  ambulo_status status = AMBULO_OK;
  TAKE(e, terms, term);
  TAKE(e, user_rows, user_row);
  taken->definition.terms = e->terms;
  taken->definition.term_count = e->term_count;
  taken->definition.user_rows = e->user_rows;
  taken->definition.user_row_count = e->user_row_count;
  return status;
}

void ambulo__definition_drop(ambulo__taken_definition *taken) {
  for (int i = 0; i < taken->count; i++) ambulo__free(&taken->allocator, taken->longer[i]);
}
