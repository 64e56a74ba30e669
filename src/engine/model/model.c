/* model/model.c - building an immutable model from a definition, and freeing it.
 *
 * Reading order: model.h, model.c, model_check.c, contact_check.c, link_bodies.c, model_query.c,
 * neutral_pose.h, placement.h, mirror_image.h, conditions.h.
 */
#include "model/model.h"

#include "base/alloc.h"
#include "base/sized.h"
#include "model/model_check.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <string.h>

/* -------------------------------------------------------------- renumbering */

/* Numbers before and after sorting. */
typedef struct numbering {
  int *order;          /* [links] new -> old */
  int *place;          /* [links] old -> new; -1: not placed yet */
  int *old_coordinate; /* [links] old link -> old coordinate; -1: fixed */
  int *new_coordinate; /* [coordinates] old -> new */
} numbering;

static void split(numbering *n, int *block, int links) {
  n->order = block;
  n->place = block + links;
  n->old_coordinate = block + 2 * links;
  n->new_coordinate = block + 3 * links;
}

/* Parents before children, otherwise in the given order. The unplaced ancestors of a link are
 * stacked at the far end of `order`, which cannot meet the placed ones: together they are at
 * most all links. */
static void sort_links(const ambulo_model_definition *d, numbering *n) {
  int count = 0, coordinate = 0;
  for (int i = 0; i < d->link_count; i++) n->place[i] = -1;
  for (int i = 0; i < d->link_count; i++) {
    int top = d->link_count;
    for (int k = i; k >= 0 && n->place[k] < 0; k = d->links[k].parent) n->order[--top] = k;
    while (top < d->link_count) {
      int link = n->order[top++];
      n->order[count] = link;
      n->place[link] = count++;
    }
    n->old_coordinate[i] = ambulo__link_has_coordinate(&d->links[i]) ? coordinate++ : -1;
  }
  coordinate = 0;
  for (int i = 0; i < d->link_count; i++) {
    int old = n->old_coordinate[n->order[i]];
    if (old >= 0) n->new_coordinate[old] = coordinate++;
  }
}

/* ------------------------------------------------------------------ copying */

static size_t text_size(const ambulo_model_definition *d) {
  size_t size = strlen(d->name) + 1;
  for (int i = 0; i < d->link_count; i++) size += strlen(d->links[i].name) + 1;
  for (int i = 0; i < d->coordinate_count; i++) size += strlen(d->coordinates[i].name) + 1;
  for (int i = 0; i < d->point_count; i++) size += strlen(d->points[i].name) + 1;
  for (int i = 0; i < d->foot_count; i++) size += strlen(d->feet[i].name) + 1;
  for (int i = 0; i < d->patch_count; i++) size += strlen(d->patches[i].name) + 1;
  for (int i = 0; i < d->capsule_count; i++) size += strlen(d->capsules[i].name) + 1;
  return size;
}

static const char *keep(char **end, const char *name) {
  char *kept = *end;
  size_t size = strlen(name) + 1;
  memcpy(kept, name, size);
  *end += size;
  return kept;
}

static void copy_function(ambulo_model *m, ambulo_link *link, const numbering *n,
                          double **splines) {
  size_t numbers = 2 * (size_t)link->knot_count;
  link->coupled_to = n->new_coordinate[link->coupled_to];
  if (numbers > 0) memcpy(*splines, link->knots, numbers * sizeof **splines);
  link->knots = numbers > 0 ? (const double(*)[2])(const void *)*splines : NULL;
  *splines += numbers;
  m->coupled_count++;
}

void ambulo__model_couple(ambulo_model *model) {
  ambulo__piece *pieces = model->pieces;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    model->couplings[i] = (ambulo__coupling){.to = link->coupled_to};
    if (link->coupled_to < 0) continue;
    ambulo__coupling_fill(link, pieces);
    model->couplings[i].pieces = pieces;
    model->couplings[i].count = ambulo__coupling_count(link);
    pieces += model->couplings[i].count;
  }
}

static void copy_links(ambulo_model *m, const ambulo_model_definition *d, const numbering *n,
                       char **text) {
  double *splines = m->splines;
  for (int i = 0; i < m->link_count; i++) {
    ambulo_link *link = &m->links[i];
    *link = d->links[n->order[i]];
    link->name = keep(text, link->name);
    if (link->parent >= 0) link->parent = n->place[link->parent];
    int old = n->old_coordinate[n->order[i]];
    link->coordinate = old >= 0 ? n->new_coordinate[old] : -1;
    m->mass += link->mass;
    if (link->coupled_to >= 0) copy_function(m, link, n, &splines);
    if (old < 0) continue;
    ambulo_coordinate *coordinate = &m->coordinates[link->coordinate];
    *coordinate = d->coordinates[old];
    coordinate->name = keep(text, coordinate->name);
    coordinate->type = link->type;
    coordinate->mirror = n->new_coordinate[coordinate->mirror < 0 ? old : coordinate->mirror];
    m->coordinate_link[link->coordinate] = m->coordinate_written[link->coordinate] = i;
  }
}

static void copy_contacts(ambulo_model *m, const ambulo_model_definition *d, const numbering *n,
                          char **text) {
  for (int i = 0; i < m->point_count; i++) {
    m->points[i] = d->points[i];
    m->points[i].name = keep(text, d->points[i].name);
    m->points[i].link = n->place[d->points[i].link];
  }
  for (int i = 0; i < m->foot_count; i++) {
    m->feet[i] = d->feet[i];
    m->feet[i].name = keep(text, d->feet[i].name);
    if (m->feet[i].mirror < 0) m->feet[i].mirror = i;
  }
  for (int i = 0; i < m->patch_count; i++) {
    m->patches[i] = d->patches[i];
    m->patches[i].name = keep(text, d->patches[i].name);
    if (m->patches[i].mirror < 0) m->patches[i].mirror = i;
  }
}

static void copy_capsules(ambulo_model *m, const ambulo_model_definition *d, const numbering *n,
                          char **text) {
  for (int i = 0; i < m->capsule_count; i++) {
    m->capsules[i] = d->capsules[i];
    m->capsules[i].name = keep(text, d->capsules[i].name);
    m->capsules[i].link = n->place[d->capsules[i].link];
    if (m->capsules[i].mirror < 0) m->capsules[i].mirror = i;
    m->capsule_point[i] = -1;
  }
}

/* up = -g/|g|; forward made horizontal; left = up x forward. */
static void set_directions(ambulo_model *m, const double forward[3]) {
  const double *g = m->gravity;
  double *u = m->up, *f = m->forward, *l = m->left;
  double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  for (int i = 0; i < 3; i++) u[i] = g[i] == 0 ? 0 : -g[i] / size;
  double climb = u[0] * forward[0] + u[1] * forward[1] + u[2] * forward[2];
  for (int i = 0; i < 3; i++) f[i] = forward[i] - climb * u[i];
  size = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
  for (int i = 0; i < 3; i++) f[i] /= size;
  l[0] = u[1] * f[2] - u[2] * f[1];
  l[1] = u[2] * f[0] - u[0] * f[2];
  l[2] = u[0] * f[1] - u[1] * f[0];
}

static int allocate(ambulo_model *m, const ambulo_model_definition *d) {
  const ambulo_allocator *a = &m->allocator;
  size_t links = (size_t)d->link_count, coordinates = (size_t)d->coordinate_count;
  size_t points = 0, pieces = 0;
  for (int i = 0; i < d->link_count; i++) {
    if (d->links[i].coupled_to < 0) continue;
    points += (size_t)d->links[i].knot_count;
    pieces += (size_t)ambulo__coupling_count(&d->links[i]);
  }
  m->couplings = ambulo__alloc(a, links, sizeof *m->couplings);
  m->splines = ambulo__alloc(a, 2 * points, sizeof *m->splines);
  m->pieces = ambulo__alloc(a, pieces, sizeof *m->pieces);
  m->text = ambulo__alloc(a, text_size(d), 1);
  m->links = ambulo__alloc(a, links, sizeof *m->links);
  m->coordinates = ambulo__alloc(a, coordinates, sizeof *m->coordinates);
  m->coordinate_link = ambulo__alloc(a, coordinates, sizeof *m->coordinate_link);
  m->coordinate_written = ambulo__alloc(a, coordinates, sizeof *m->coordinate_written);
  m->points = ambulo__alloc(a, (size_t)d->point_count, sizeof *m->points);
  m->neutral = ambulo__alloc(a, 3 * (size_t)d->point_count, sizeof *m->neutral);
  m->feet = ambulo__alloc(a, (size_t)d->foot_count, sizeof *m->feet);
  m->patches = ambulo__alloc(a, (size_t)d->patch_count, sizeof *m->patches);
  m->capsules = ambulo__alloc(a, (size_t)d->capsule_count, sizeof *m->capsules);
  m->capsule_point = ambulo__alloc(a, (size_t)d->capsule_count, sizeof *m->capsule_point);
  return m->couplings && m->splines && m->pieces && m->text && m->links && m->coordinates &&
         m->coordinate_link && m->coordinate_written && m->points && m->neutral && m->feet &&
         m->patches && m->capsules && m->capsule_point;
}

static ambulo_status copy(ambulo_model *m, const ambulo_model_definition *d) {
  size_t links = (size_t)d->link_count, coordinates = (size_t)d->coordinate_count;
  int *block = ambulo__alloc(&m->allocator, 3 * links + coordinates, sizeof *block);
  if (!block || !allocate(m, d)) {
    ambulo__free(&m->allocator, block);
    return AMBULO_E_MEMORY;
  }
  numbering n;
  split(&n, block, d->link_count);
  sort_links(d, &n);
  m->link_count = d->link_count;
  m->coordinate_count = d->coordinate_count;
  m->point_count = d->point_count;
  m->foot_count = d->foot_count;
  m->patch_count = d->patch_count;
  m->capsule_count = d->capsule_count;
  m->stature = isnan(d->stature) ? 0.0 : d->stature;
  char *text = m->text;
  m->name = keep(&text, d->name);
  copy_links(m, d, &n, &text);
  copy_contacts(m, d, &n, &text);
  copy_capsules(m, d, &n, &text);
  ambulo__model_couple(m);
  ambulo__neutral_points(m);
  memcpy(m->gravity, d->gravity, sizeof m->gravity);
  set_directions(m, d->forward);
  ambulo__free(&m->allocator, block);
  return AMBULO_OK;
}

ambulo_status ambulo__model_build(const ambulo_model_definition *definition,
                                  const ambulo__model_places *places,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_model **model) {
  if (!definition || definition->size != sizeof *definition || !model) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__model_check(definition, places, diagnostics);
  if (status != AMBULO_OK) return status;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_model *m = ambulo__alloc(&own, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = own;
  status = copy(m, definition);
  if (status != AMBULO_OK) {
    ambulo_model_free(m);
    return status;
  }
  *model = m;
  return AMBULO_OK;
}

ambulo_status ambulo_model_create(const ambulo_model_definition *definition,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_model **model) {
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__taken_model own;
  ambulo_status status = ambulo__model_take(definition, allocator, &own);
  if (!status) status = ambulo__model_build(&own.definition, NULL, allocator, diagnostics, model);
  ambulo__model_drop(&own);
  return ambulo__conclude(diagnostics, errors, status, NULL);
}

void ambulo_model_free(ambulo_model *model) {
  if (!model) return;
  ambulo_allocator a = model->allocator;
  ambulo__free(&a, model->text);
  ambulo__free(&a, model->links);
  ambulo__free(&a, model->couplings);
  ambulo__free(&a, model->splines);
  ambulo__free(&a, model->pieces);
  ambulo__free(&a, model->coordinates);
  ambulo__free(&a, model->coordinate_link);
  ambulo__free(&a, model->coordinate_written);
  ambulo__free(&a, model->points);
  ambulo__free(&a, model->neutral);
  ambulo__free(&a, model->feet);
  ambulo__free(&a, model->patches);
  ambulo__free(&a, model->capsules);
  ambulo__free(&a, model->capsule_point);
  ambulo__free(&a, model);
}

/* definitions of models by programs of older headers.
 *
 * Items of the size that this library knows stay where they are; shorter ones become longer, with
 * what ambulo_..._default() says behind (base/sized.h).
 */

ambulo_status ambulo__model_take(const ambulo_model_definition *given,
                                 const ambulo_allocator *allocator, ambulo__taken_model *taken) {
  *taken = (ambulo__taken_model){.definition = ambulo_model_definition_default(),
                                 .allocator = ambulo__allocator_or_default(allocator)};
  ambulo_model_definition *d = &taken->definition;
  if (!given || !ambulo__sized_take(d, sizeof *d, given)) return AMBULO_E_ARGUMENT;
  void **longer = taken->longer;
  int failed = 0;
#define TAKE(array, item, type)                                                                    \
  do {                                                                                             \
    if (!ambulo__sized_item(d->item##_size, sizeof(type))) return AMBULO_E_ARGUMENT;               \
    if (d->item##_size < sizeof(type) && d->array && d->item##_count > 0) {                        \
      *longer = ambulo__sized_items(&taken->allocator, d->array, d->item##_count, d->item##_size,  \
                                    sizeof(type), #type);                                          \
      failed = failed || !*longer;                                                                 \
      d->array = *longer++;                                                                        \
    }                                                                                              \
    d->item##_size = sizeof(type);                                                                 \
  } while (0)
  TAKE(links, link, ambulo_link);
  TAKE(coordinates, coordinate, ambulo_coordinate);
  TAKE(points, point, ambulo_point);
  TAKE(feet, foot, ambulo_foot);
  TAKE(patches, patch, ambulo_patch);
  TAKE(capsules, capsule, ambulo_capsule);
#undef TAKE
  return failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__model_drop(ambulo__taken_model *taken) {
  for (int i = 0; i < AMBULO__MODEL_ARRAYS; i++) ambulo__free(&taken->allocator, taken->longer[i]);
}
