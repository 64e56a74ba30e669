/* problem/bodies.c - capsules of a problem: their points in the model, their pairs, obstacles'
 * names.
 *
 * Rows carry names, and what reports of them outlives the problem that made it: grids that a solve
 * makes for itself. Names of capsules live in the model, which all grids of a problem share. So do
 * they share obstacles' names, which belong to the problem of the first.
 */
#include "model/capsule_points.h"
#include "problem/problem.h"

#include <string.h>

/* the pairs of the definition as they came out; a copy of the list belongs to the definition */
static ambulo_status resolve_pairs(ambulo_problem *p) {
  ambulo_collision *c = &p->definition.collision;
  ambulo__pairs pairs;
  ambulo_status status = ambulo__pairs_create(&p->definition, &p->allocator, &pairs);
  if (status) return status;
  ambulo_capsule_pair *kept = ambulo__alloc(&p->allocator, (size_t)pairs.kept_count, sizeof *kept);
  if (!kept) {
    ambulo__pairs_free(&p->allocator, &pairs);
    return AMBULO_E_MEMORY;
  }
  if (pairs.kept_count > 0) memcpy(kept, pairs.kept, (size_t)pairs.kept_count * sizeof *kept);
  ambulo__definition_set_pairs(&p->allocator, &p->definition, kept, pairs.kept_count);
  if (c->mode != AMBULO_COLLISION_OFF) c->mode = AMBULO_COLLISION_PAIRS;
  p->pairs = pairs;
  return AMBULO_OK;
}

static ambulo_status extend_model(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_model *m = p->definition.model;
  size_t count = (size_t)m->capsule_count;
  int missing = 0, *used = ambulo__alloc(&p->allocator, count, sizeof *used);
  if (!used) return AMBULO_E_MEMORY;
  for (int i = 0; i < m->capsule_count; i++) {
    used[i] = ambulo__capsule_is_used(&p->definition, i);
    missing += used[i] && m->capsule_point[i] < 0;
  }
  ambulo_status status = AMBULO_OK;
  if (missing > 0) {
    status =
        ambulo__model_with_capsule_points(m, used, &p->allocator, diagnostics, &p->extended_model);
    if (!status) p->definition.model = p->extended_model;
  }
  ambulo__free(&p->allocator, used);
  return status;
}

ambulo_status ambulo__problem_add_bodies(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  ambulo_status status = resolve_pairs(p);
  return status ? status : extend_model(p, diagnostics);
}

ambulo_status ambulo__obstacles_copy(const ambulo_problem_definition *d,
                                     const ambulo_allocator *allocator, ambulo_obstacle **obstacles,
                                     char **names) {
  size_t size = 1, count = (size_t)d->obstacle_count;
  for (size_t i = 0; i < count; i++) size += strlen(d->obstacles[i].name) + 1;
  *names = ambulo__alloc(allocator, size, 1);
  *obstacles = ambulo__alloc(allocator, count, sizeof **obstacles);
  if (!*names || !*obstacles) {
    ambulo__free(allocator, *names);
    ambulo__free(allocator, *obstacles);
    return AMBULO_E_MEMORY;
  }
  char *end = *names;
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(d->obstacles[i].name) + 1;
    (*obstacles)[i] = d->obstacles[i];
    (*obstacles)[i].name = memcpy(end, d->obstacles[i].name, length);
    end += length;
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- queries */

/* how many there are; the index-th one into *pair */
static int nth(const ambulo_capsule_pair *pairs, int count, int index, ambulo_capsule_pair *pair) {
  if (pair && index >= 0 && index < count) *pair = pairs[index];
  return count;
}

int ambulo_problem_pairs(const ambulo_problem *p, int index, ambulo_capsule_pair *pair) {
  if (!p || p->definition.collision.mode == AMBULO_COLLISION_OFF) return 0;
  return nth(p->definition.collision.pairs, p->definition.collision.pair_count, index, pair);
}

int ambulo_problem_pairs_left_out(const ambulo_problem *p, int index, ambulo_capsule_pair *pair) {
  if (!p) return 0;
  const ambulo__pairs *pairs = &ambulo__problem_root(p)->pairs; /* an extension is given the rest */
  return nth(pairs->left, pairs->left_count, index, pair);
}

int ambulo_problem_pairs_too_far(const ambulo_problem *p) {
  return p ? ambulo__problem_root(p)->pairs.too_far : 0;
}

int ambulo_problem_obstacle_count(const ambulo_problem *p) {
  return p ? p->definition.obstacle_count : 0;
}

const ambulo_obstacle *ambulo_problem_obstacle(const ambulo_problem *p, int index) {
  return p && index >= 0 && index < p->definition.obstacle_count ? &p->definition.obstacles[index]
                                                                 : NULL;
}
