/* model/capsule_points.c - see capsule_points.h. */
#include "model/capsule_points.h"

#include <stdio.h>
#include <string.h>

#include "model/check.h"
#include "model/conditions.h"

enum { NAME_SIZE = AMBULO__MAX_NAME + 8 };

/* both ends of a capsule */
static void add_ends(const ambulo_capsule *capsule, ambulo_point *points,
                     char (*names)[NAME_SIZE]) {
  static const char *const ends[] = {"from", "to"};
  for (int end = 0; end < 2; end++) {
    (void)snprintf(names[end], NAME_SIZE, "%s.%s", capsule->name, ends[end]);
    points[end].name = names[end];
    points[end].link = capsule->link;
    memcpy(points[end].position, end ? capsule->to : capsule->from, sizeof points[end].position);
  }
}

ambulo_status ambulo__model_with_capsule_points(const ambulo_model *m, const int *used,
                                                const ambulo_allocator *allocator,
                                                ambulo_diagnostics *diagnostics,
                                                ambulo_model **extended) {
  size_t most = (size_t)m->point_count + 2 * (size_t)m->capsule_count;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_point *points = ambulo__alloc(&own, most, sizeof *points);
  char(*names)[NAME_SIZE] = ambulo__alloc(&own, 2 * (size_t)m->capsule_count, sizeof *names);
  int *first = ambulo__alloc(&own, (size_t)m->capsule_count, sizeof *first);
  ambulo_status status = points && names && first ? AMBULO_OK : AMBULO_E_MEMORY;
  int count = m->point_count;
  for (int i = 0; !status && i < m->point_count; i++) points[i] = m->points[i];
  for (int i = 0; !status && i < m->capsule_count; i++) {
    first[i] = m->capsule_point[i];
    if (first[i] >= 0 || !used[i]) continue;
    first[i] = count;
    add_ends(&m->capsules[i], points + count, names + 2 * i);
    count += 2;
  }
  if (!status) status = ambulo__model_copy(m, points, count, &own, diagnostics, extended);
  if (!status) memcpy((*extended)->capsule_point, first, (size_t)m->capsule_count * sizeof *first);
  ambulo__free(&own, points);
  ambulo__free(&own, names);
  ambulo__free(&own, first);
  return status;
}

/* the first link from `link` toward the world, itself included, that has a mass; -1: none */
static int body_of(const ambulo_model *m, int link) {
  while (link >= 0 && m->links[link].mass <= 0.0) link = m->links[link].parent;
  return link;
}

/* 1 if `below` is joined to the body above it, and that is `above` */
static int hangs_on(const ambulo_model *m, int below, int above) {
  return below >= 0 && body_of(m, m->links[below].parent) == above;
}

int ambulo__links_are_neighbours(const ambulo_model *m, int one, int other) {
  int a = body_of(m, one), b = body_of(m, other);
  return a == b || hangs_on(m, a, b) || hangs_on(m, b, a);
}
