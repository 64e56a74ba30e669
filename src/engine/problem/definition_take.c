/* problem/definition_take.c - definitions of problems by programs of older headers.
 *
 * The whole and the parts that it holds by value: definition_parts.h. Items of arrays follow the
 * sizes of theirs (base/sized.h).
 */
#include "problem/definition_take.h"
#include "base/alloc.h"
#include "base/sized.h"
#include "problem/definition_parts.h"

#include <stddef.h>
#include <string.h>

typedef ambulo_problem_definition definition;

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
  ambulo__definition_run runs[AMBULO__DEFINITION_RUNS];
  *taken = (ambulo__taken_definition){.definition = ambulo_problem_definition_default(),
                                      .allocator = ambulo__allocator_or_default(allocator)};
  if (!given || given->size <= offsetof(definition, name) || !ambulo__definition_runs(given, runs))
    return AMBULO_E_ARGUMENT;
  definition *d = &taken->definition;
  for (int i = 0; i < AMBULO__DEFINITION_RUNS; i++)
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
