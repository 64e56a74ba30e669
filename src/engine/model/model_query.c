/* model/model_query.c - read access to a model, and a model whose capsules have their ends among
 * its points. A NULL model has nothing in it. */
#include "model/model_query.h"

#include "model/conditions.h"
#include "model/model.h"
#include "model/model_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *ambulo_model_name(const ambulo_model *model) {
  return model ? model->name : NULL;
}

int ambulo_model_link_count(const ambulo_model *model) {
  return model ? model->link_count : 0;
}

int ambulo_model_coordinate_count(const ambulo_model *model) {
  return model ? model->coordinate_count : 0;
}

int ambulo_model_point_count(const ambulo_model *model) {
  return model ? model->point_count : 0;
}

int ambulo_model_foot_count(const ambulo_model *model) {
  return model ? model->foot_count : 0;
}

int ambulo_model_patch_count(const ambulo_model *model) {
  return model ? model->patch_count : 0;
}

int ambulo_model_capsule_count(const ambulo_model *model) {
  return model ? model->capsule_count : 0;
}

const ambulo_link *ambulo_model_link(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->link_count ? &model->links[index] : NULL;
}

const ambulo_coordinate *ambulo_model_coordinate(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->coordinate_count ? &model->coordinates[index] : NULL;
}

const ambulo_point *ambulo_model_point(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->point_count ? &model->points[index] : NULL;
}

const ambulo_foot *ambulo_model_foot(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->foot_count ? &model->feet[index] : NULL;
}

const ambulo_patch *ambulo_model_patch(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->patch_count ? &model->patches[index] : NULL;
}

const ambulo_capsule *ambulo_model_capsule(const ambulo_model *model, int index) {
  return model && index >= 0 && index < model->capsule_count ? &model->capsules[index] : NULL;
}

int ambulo_model_find_link(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->link_count; i++) {
    if (strcmp(model->links[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo_model_find_coordinate(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->coordinate_count; i++) {
    if (strcmp(model->coordinates[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo_model_find_point(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->point_count; i++) {
    if (strcmp(model->points[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo_model_find_foot(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->foot_count; i++) {
    if (strcmp(model->feet[i].name, name) == 0) return i;
  }
  return -1;
}

int ambulo__find_patch(const ambulo_model *model, const char *name) {
  for (int i = 0; model && name && i < model->patch_count; i++) {
    if (strcmp(model->patches[i].name, name) == 0) return i;
  }
  return -1;
}

double ambulo_model_mass(const ambulo_model *model) {
  return model ? model->mass : 0;
}

double ambulo__model_weight(const ambulo_model *model) {
  const double *g = model->gravity;
  return model->mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

double ambulo__model_size(const ambulo_model *model) {
  return model->stature > 0.0 ? model->stature / 1.75 : 1.0;
}

double ambulo_model_stature(const ambulo_model *model) {
  return model ? model->stature : 0;
}

const double *ambulo_model_gravity(const ambulo_model *model) {
  return model ? model->gravity : NULL;
}

const double *ambulo_model_up(const ambulo_model *model) {
  return model ? model->up : NULL;
}

const double *ambulo_model_forward(const ambulo_model *model) {
  return model ? model->forward : NULL;
}

const double *ambulo_model_left(const ambulo_model *model) {
  return model ? model->left : NULL;
}

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
