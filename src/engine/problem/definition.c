/* problem/definition.c - copies, memory and hash of definitions (definition.h). */
#include "problem/definition.h"

#include "base/alloc.h"
#include "model/model.h"

#include <math.h>
#include <string.h>

/* -------------------------------------------------------------------- one member */

static int int_at(const void *item, size_t at) {
  int value;
  memcpy(&value, (const char *)item + at, sizeof value);
  return value;
}

static size_t natural(int count) {
  return count > 0 ? (size_t)count : 0;
}

size_t ambulo__member_length(const ambulo__member *m, const ambulo_problem_definition *d,
                             const void *item) {
  size_t coordinates = d->model ? natural(ambulo_model_coordinate_count(d->model)) : 0;
  size_t feet = d->model ? natural(ambulo_model_foot_count(d->model)) : 0;
  size_t nodes =
      d->intervals > 0 && d->intervals <= AMBULO__MOST_INTERVALS ? natural(d->intervals) + 1 : 0;
  switch (m->extent) {
  case AMBULO__COUNTED:
    return natural(int_at(item, m->count_at));
  case AMBULO__EACH_COORDINATE:
    return coordinates;
  case AMBULO__EACH_NODE:
    return nodes;
  case AMBULO__EACH_KNOT:
    return natural(d->spline_intervals) + 1;
  case AMBULO__EACH_DEVICE:
    return natural(d->device_count);
  case AMBULO__EACH_FOOT:
    return feet;
  case AMBULO__EACH_NODE_COORDINATE:
    return nodes * coordinates;
  case AMBULO__EACH_NODE_COUNTED:
    return nodes * natural(int_at(item, m->count_at));
  case AMBULO__EACH_NODE_FOOT:
    return nodes * feet;
  case AMBULO__EACH_SAMPLE_COORDINATE:
    return natural(int_at(item, m->count_at)) * coordinates;
  }
  return 0;
}

const void *ambulo__member_array(const ambulo__member *m, const void *item) {
  const void *array;
  memcpy(&array, (const char *)item + m->at, sizeof array);
  return array;
}

void ambulo__member_range(const ambulo__member *m, double range[2]) {
  int exact = m->flags & AMBULO__EXACT_RANGE;
  range[0] = exact ? m->low : m->low > 0.0 ? 1e-3 * m->low : 1e3 * m->low;
  range[1] = m->flags & AMBULO__MAY_BE_INFINITE ? HUGE_VAL : exact ? m->high : 1e3 * m->high;
}

void ambulo__members_fill(const ambulo__structure *s, void *item) {
  memset(item, 0, s->size);
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    char *at = (char *)item + m->at;
    int whole = m->type >= AMBULO__INTEGER && m->type <= AMBULO__INDEX;
    if (m->type == AMBULO__PART) ambulo__members_fill(m->of, at);
    if (m->type > AMBULO__INDEX) continue;
    for (int k = 0; k < m->count; k++) {
      double usual = m->usual[k > 0];
      int integer = whole ? (int)usual : 0;
      memcpy(at + (size_t)k * (whole ? sizeof integer : sizeof usual),
             whole ? (const void *)&integer : &usual, whole ? sizeof integer : sizeof usual);
    }
  }
}

const char *ambulo__quantity_unit(ambulo__quantity quantity) {
  static const char *const units[] = {[AMBULO__STEP_LENGTH] = "m",
                                      [AMBULO__SHORT_LENGTH] = "m",
                                      [AMBULO__ANGLE] = "rad",
                                      [AMBULO__SMALL_ANGLE] = "rad",
                                      [AMBULO__TIME] = "s",
                                      [AMBULO__SPEED] = "m/s",
                                      [AMBULO__TURNING_SPEED] = "rad/s",
                                      [AMBULO__MASS] = "kg",
                                      [AMBULO__TORQUE] = "N m",
                                      [AMBULO__FORCE] = "N",
                                      [AMBULO__BODY_WEIGHT] = "body weights",
                                      [AMBULO__TURNING_JOLT] = "rad/s^2",
                                      [AMBULO__JOLT] = "m/s^2",
                                      [AMBULO__LOADING_RATE] = "body weights/s",
                                      [AMBULO__STRIDE_SHARE] = "",
                                      [AMBULO__EVENT_TIME] = "s",
                                      [AMBULO__TURNING_STIFF] = "N m/rad",
                                      [AMBULO__STIFF] = "N/m",
                                      [AMBULO__RATIO] = "",
                                      [AMBULO__BYTES] = "bytes"};
  return units[quantity];
}

/* an array, a text or items */
static void set_pointer(const ambulo__member *m, void *item, const void *pointer) {
  memcpy((char *)item + m->at, &pointer, sizeof pointer);
}

static size_t size_of_item(const ambulo__member *m) {
  if (m->type == AMBULO__ITEMS) return m->of->size;
  return (size_t)m->count * (m->type == AMBULO__INDEX_ARRAY ? sizeof(int) : sizeof(double));
}

/* ------------------------------------------------------------------------- copies */

typedef struct copier {
  const ambulo_problem_definition *from;
  const ambulo_allocator *allocator;
  int failed;
} copier;

/* NULL of nothing, and when memory runs out */
static void *copy_bytes(copier *c, const void *from, size_t size) {
  void *to = from && size ? ambulo__alloc(c->allocator, size, 1) : NULL;
  if (to) memcpy(to, from, size);
  c->failed |= from && size && !to;
  return to;
}

/* `item` has the bytes of the original: what they point at is copied */
static void copy_members(copier *c, const ambulo__structure *s, void *item) {
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    if (m->type == AMBULO__PART) copy_members(c, m->of, (char *)item + m->at);
    if (m->type < AMBULO__TEXT || m->type > AMBULO__ITEMS || m->flags & AMBULO__NOT_COPIED)
      continue;
    const char *from = ambulo__member_array(m, item);
    size_t count = m->type == AMBULO__TEXT ? (from ? strlen(from) + 1 : 0)
                                           : ambulo__member_length(m, c->from, item);
    size_t size = m->type == AMBULO__TEXT ? 1 : size_of_item(m);
    char *to = copy_bytes(c, from, count * size);
    set_pointer(m, item, to);
    for (size_t k = 0; to && m->type == AMBULO__ITEMS && k < count; k++)
      copy_members(c, m->of, to + k * size);
  }
}

void ambulo__strength_of_limits(const ambulo_coordinate *coordinates, int count,
                                const double *price, double *curves) {
  memset(curves, 0, 6 * (size_t)count * sizeof *curves);
  for (int i = 0; i < count; i++) {
    const double *torque = coordinates[i].torque;
    if (isfinite(torque[1])) curves[6 * i] = torque[1] / (price ? price[2 * i + 1] : 1.0);
    if (isfinite(torque[0])) curves[6 * i + 3] = -torque[0] / (price ? price[2 * i] : 1.0);
  }
}

static void limits_as_strength(copier *c, ambulo_term *term) {
  const ambulo_model *model = c->from->model;
  int count = model->coordinate_count;
  double *curves = ambulo__alloc(c->allocator, 6 * (size_t)count, sizeof *curves);
  if (curves)
    ambulo__strength_of_limits(model->coordinates, count, term->price, curves);
  else
    c->failed = 1;
  term->strength = curves;
}

/* the copies are ours: casting the borrowed view's const away is sound here only */
static void *owned(const void *pointer) {
  union {
    const void *constant;
    void *owned;
  } view = {pointer};
  return view.owned;
}

ambulo_status ambulo__definition_copy(const ambulo_problem_definition *from,
                                      const ambulo_allocator *a, ambulo_problem_definition *to) {
  copier c = {from, a, 0};
  *to = *from;
  if (!to->name) to->name = "problem";
  copy_members(&c, &ambulo__definition_members, to);
  ambulo_term *terms = owned(to->terms);
  for (int t = 0; terms && t < to->term_count; t++) {
    if (!terms[t].strength_is_limits) continue;
    ambulo__free(a, owned(terms[t].strength));
    limits_as_strength(&c, &terms[t]);
  }
  return c.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static void free_members(const ambulo_allocator *a, const ambulo_problem_definition *d,
                         const ambulo__structure *s, void *item) {
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    if (m->type == AMBULO__PART) free_members(a, d, m->of, (char *)item + m->at);
    if (m->type < AMBULO__TEXT || m->type > AMBULO__ITEMS || m->flags & AMBULO__NOT_COPIED)
      continue;
    char *array = owned(ambulo__member_array(m, item));
    size_t count = array && m->type == AMBULO__ITEMS ? ambulo__member_length(m, d, item) : 0;
    for (size_t k = 0; k < count; k++) free_members(a, d, m->of, array + k * m->of->size);
    ambulo__free(a, array);
  }
}

void ambulo__definition_free(const ambulo_allocator *a, ambulo_problem_definition *d) {
  free_members(a, d, &ambulo__definition_members, d);
}

void ambulo__definition_set_pairs(const ambulo_allocator *a, ambulo_problem_definition *d,
                                  ambulo_capsule_pair *pairs, int count) {
  ambulo__free(a, owned(d->collision.pairs));
  d->collision.pairs = pairs;
  d->collision.pair_count = count;
}

/* --------------------------------------------------------------------------- hash */

typedef unsigned long long hash;

static hash add_bytes(hash h, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++) h = (h ^ byte[i]) * 1099511628211ULL;
  return h;
}

static hash add_text(hash h, const char *text) {
  return text ? add_bytes(h, text, strlen(text) + 1) : add_bytes(h, "", 1);
}

static hash add_numbers(hash h, const void *numbers, size_t count) {
  for (size_t i = 0; i < count; i++) {
    double value;
    memcpy(&value, (const char *)numbers + i * sizeof value, sizeof value);
    if (value == 0.0) value = 0.0; /* -0 is 0 */
    h = add_bytes(h, &value, sizeof value);
  }
  return h;
}

static hash add_integers(hash h, const void *integers, size_t count) {
  return add_bytes(h, integers, count * sizeof(int));
}

static hash add_members(hash h, const ambulo_problem_definition *d, const ambulo__structure *s,
                        const void *item);

/* an array tells its length, which tells it from its neighbours */
static hash add_array(hash h, const ambulo_problem_definition *d, const ambulo__member *m,
                      const void *item) {
  const char *array = ambulo__member_array(m, item);
  size_t count = array ? ambulo__member_length(m, d, item) : 0;
  int length = (int)count;
  h = add_integers(h, &length, 1);
  if (m->type == AMBULO__NUMBER_ARRAY) return add_numbers(h, array, count * (size_t)m->count);
  if (m->type == AMBULO__INDEX_ARRAY) return add_integers(h, array, count);
  for (size_t k = 0; k < count; k++) h = add_members(h, d, m->of, array + k * m->of->size);
  return h;
}

static hash add_members(hash h, const ambulo_problem_definition *d, const ambulo__structure *s,
                        const void *item) {
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    const char *at = (const char *)item + m->at;
    switch (m->type) {
    case AMBULO__NUMBER:
    case AMBULO__FILE_ANGLE:
      h = add_numbers(h, at, (size_t)m->count);
      break;
    case AMBULO__INTEGER:
    case AMBULO__FLAG:
    case AMBULO__CHOICE:
    case AMBULO__INDEX:
      h = add_integers(h, at, (size_t)m->count);
      break;
    case AMBULO__TEXT:
      if (!(m->flags & AMBULO__NOT_HASHED)) h = add_text(h, ambulo__member_array(m, item));
      break;
    case AMBULO__NUMBER_ARRAY:
    case AMBULO__INDEX_ARRAY:
    case AMBULO__ITEMS:
      h = add_array(h, d, m, item);
      break;
    case AMBULO__PART:
      h = add_members(h, d, m->of, at);
      break;
    case AMBULO__BORROWED:
      h = add_bytes(h, ambulo__member_array(m, item) ? "1" : "0", 1);
      break;
    }
  }
  return h;
}

static hash add_bodies(hash h, const ambulo_model *model) {
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    const int integers[] = {link->parent, (int)link->type, link->coordinate};
    h = add_integers(add_text(h, link->name), integers, 3);
    h = add_numbers(h, &link->theta, 4);
    if (link->coupled_to >= 0) {
      h = add_integers(h, &link->coupled_to, 1);
      h = add_numbers(h, link->knots, 2 * (size_t)link->knot_count);
      h = add_numbers(h, link->polynomial, AMBULO__COUPLING_TERMS);
    }
    h = add_numbers(add_numbers(add_numbers(h, &link->mass, 1), link->com, 3), link->inertia, 6);
  }
  for (int i = 0; i < model->coordinate_count; i++) {
    const ambulo_coordinate *c = &model->coordinates[i];
    const double numbers[] = {c->default_value, c->mirror_sign};
    const int integers[] = {(int)c->type, c->actuated, c->mirror};
    h = add_numbers(add_integers(add_text(h, c->name), integers, 3), numbers, 2);
    h = add_numbers(add_numbers(add_numbers(h, c->range, 2), c->speed, 2), c->torque, 2);
    const double drive[] = {c->armature, c->damping, c->friction};
    if (drive[0] != 0.0 || drive[1] != 0.0 || drive[2] != 0.0) h = add_numbers(h, drive, 3);
  }
  return h;
}

static hash add_model(hash h, const ambulo_model *model) {
  h = add_numbers(add_numbers(add_text(h, model->name), model->gravity, 3), model->forward, 3);
  h = add_bodies(add_numbers(h, &model->stature, 1), model);
  for (int i = 0; i < model->point_count; i++) {
    const ambulo_point *point = &model->points[i];
    h = add_numbers(add_integers(add_text(h, point->name), &point->link, 1), point->position, 3);
  }
  for (int i = 0; i < model->foot_count; i++) {
    const ambulo_foot *f = &model->feet[i];
    const int points[] = {f->heel[0],     f->heel[1],    f->toe[0], f->toe[1],
                          f->heel_center, f->toe_center, f->mirror, f->has_tip ? f->tip : -1,
                          f->has_arcs,    f->arc[0],     f->arc[1]};
    h = add_integers(add_text(h, f->name), points, sizeof points / sizeof *points);
  }
  for (int i = 0; i < model->patch_count; i++) {
    const ambulo_patch *patch = &model->patches[i];
    const int integers[] = {patch->point, patch->mirror};
    h = add_numbers(add_integers(add_text(h, patch->name), integers, 2), patch->size, 2);
  }
  for (int i = 0; i < model->capsule_count; i++) {
    const ambulo_capsule *c = &model->capsules[i];
    const int integers[] = {c->link, c->mirror};
    h = add_numbers(add_integers(add_text(h, c->name), integers, 2), &c->radius, 1);
    h = add_numbers(add_numbers(h, c->from, 3), c->to, 3);
  }
  return h;
}

unsigned long long ambulo__definition_hash(const ambulo_problem_definition *d,
                                           const ambulo_model *model) {
  const hash start = 14695981039346656037ULL;
  return add_members(add_model(start, model), d, &ambulo__definition_members, d);
}
