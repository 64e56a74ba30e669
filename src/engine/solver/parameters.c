/* solver/parameters.c - the numbers of a problem: the variant in which they are moved, and their
 * list: adding, finding, moving, units. */
#include "base/diagnostics.h"
#include "contact/schedule.h"
#include "model/conditions.h"
#include "problem/definition.h"
#include "solver/sensitivity.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------------- the copy */

static ambulo__body_numbers body_of(const ambulo_model *m) {
  const double *g = m->gravity;
  double along[2] = {0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    along[0] -= g[i] * m->up[i];
    along[1] -= g[i] * m->forward[i];
  }
  ambulo__body_numbers body = {.stature = m->stature, .slope = atan2(along[1], along[0])};
  body.mass = m->units.mass == 0.0 || m->units.mass == 1.0 ? m->mass - ambulo__model_load_mass(m)
                                                           : m->units.mass;
  for (int i = 0; i < m->load_count; i++) body.load[i] = m->loads[i].mass;
  return body;
}

/* postures that name no angles rest at 0 */
static ambulo_status fill_rests(ambulo__variant *v) {
  ambulo_term *terms = ambulo__variant_own(v->definition.terms);
  for (int t = 0; t < v->definition.term_count; t++) {
    if (terms[t].offset || !ambulo__term_has(&terms[t], AMBULO__TERM_REST)) continue;
    terms[t].offset = ambulo__alloc(&v->allocator, (size_t)v->origin->coordinates, sizeof(double));
    if (!terms[t].offset) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__variant_init(const ambulo_problem *p, const ambulo_allocator *allocator,
                                   ambulo__variant *v) {
  *v = (ambulo__variant){.allocator = ambulo__allocator_or_default(allocator), .origin = p};
  size_t bytes = (size_t)p->coordinates * sizeof *v->coordinates;
  v->body = body_of(p->model);
  memcpy(&v->rule, &p->keys.rule, sizeof v->rule);
  v->coordinates = ambulo__alloc(&v->allocator, bytes, 1);
  if (!v->coordinates) return AMBULO_E_MEMORY;
  memcpy(v->coordinates, p->model->coordinates, bytes);
  ambulo_status status = ambulo__definition_copy(&p->definition, &v->allocator, &v->definition);
  if (!status) status = ambulo__variant_take_muscles(v);
  return status ? status : fill_rests(v);
}

static void clear_variant(ambulo__variant *v) {
  if (!v->origin) return;
  ambulo__free(&v->allocator, v->coordinates);
  ambulo__free(&v->allocator, v->muscles);
  ambulo__definition_free(&v->allocator, &v->definition);
  *v = (ambulo__variant){.origin = NULL};
}

/* ------------------------------------------------------------------- the body */

static int limits_moved(const ambulo__variant *v) {
  size_t bytes = (size_t)v->origin->coordinates * sizeof *v->coordinates;
  return memcmp(v->coordinates, v->origin->model->coordinates, bytes) != 0;
}

static int body_moved(const ambulo__variant *v) {
  const ambulo__body_numbers before = body_of(v->origin->model), *now = &v->body;
  int moved =
      now->mass != before.mass || now->stature != before.stature || now->slope != before.slope;
  for (int i = 0; i < v->origin->model->load_count; i++) moved |= now->load[i] != before.load[i];
  return moved;
}

static void change(const ambulo__variant *v, ambulo_model *m) {
  const ambulo__body_numbers before = body_of(v->origin->model), *now = &v->body;
  ambulo__model_load load[AMBULO__MOST_LOADS];
  int loads = m->load_count;
  for (int i = 0; i < m->coordinate_count; i++) {
    const char *name = m->coordinates[i].name;
    m->coordinates[i] = v->coordinates[i];
    m->coordinates[i].name = name;
  }
  if (!body_moved(v)) return;
  memcpy(load, m->loads, sizeof load);
  ambulo__model_put_down(m);
  ambulo__model_resize(m, before.mass > 0.0 ? now->mass / before.mass : 1.0,
                       before.stature > 0.0 ? now->stature / before.stature : 1.0);
  for (int i = 0; i < loads; i++)
    ambulo__model_carry(m, load[i].link, now->load[i], load[i].position);
  if (now->slope != before.slope) ambulo__model_tilt(m, now->slope);
}

/* offsets that are the body weight stay it */
static void weigh(const ambulo__variant *v, ambulo_problem_definition *d, double weight) {
  double before = ambulo__model_weight(v->origin->model);
  for (int t = 0; t < d->term_count; t++) {
    const ambulo_term *was = &v->definition.terms[t];
    if (!was->offset || !ambulo__term_has(was, AMBULO__TERM_OFFSET)) continue;
    for (int i = 0; i < v->origin->coordinates; i++)
      if (fabs(fabs(was->offset[i]) - before) <= 1e-12 * before)
        ((double *)ambulo__variant_own(d->terms[t].offset))[i] = copysign(weight, was->offset[i]);
  }
}

static int is_at(const double *one, const double *other) {
  return one[0] == other[0] && one[1] == other[1] && one[2] == other[2];
}

/* ends of devices that are points of the model stay them */
static void follow_points(const ambulo__variant *v, ambulo_problem_definition *d) {
  const ambulo_model *m = v->origin->model;
  ambulo_device *devices = ambulo__variant_own(d->devices);
  for (int end = 0; end < 2 * d->device_count; end++) {
    ambulo_device *device = &devices[end / 2];
    double *place = device->position[end % 2];
    for (int i = 0; i < m->point_count && device->coordinate < 0; i++)
      if (m->points[i].link == device->link[end % 2] && is_at(m->points[i].position, place))
        memcpy(place, d->model->points[i].position, 3 * sizeof *place);
  }
}

/* ------------------------------------------------------------------- the walk */

/* contacts, duration and travel of the gait that follows; *contacts to be freed */
static ambulo_status walk(const ambulo__variant *v, const ambulo__gait_rule *rule,
                          ambulo_problem_definition *d, ambulo_gait *gait,
                          ambulo_contact **contacts) {
  int count = 0;
  ambulo__gait_follow(rule, d->model, gait);
  ambulo_status status = ambulo_gait_expand(d->model, gait, NULL, 0, &count);
  if (status == AMBULO_E_ARGUMENT) return AMBULO_E_PROBLEM; /* phases out of order */
  *contacts = ambulo__alloc(&v->allocator, (size_t)count, sizeof **contacts);
  if (!*contacts) return AMBULO_E_MEMORY;
  status = ambulo_gait_expand(d->model, gait, *contacts, count, &count);
  d->contacts = *contacts;
  d->contact_count = count;
  d->duration = rule->time_kind == AMBULO__TIME_OF_DURATION
                    ? rule->duration
                    : ambulo__gait_strike(gait, gait->steps);
  if (!v->origin->keys.travel) d->travel = ambulo__gait_place(gait, gait->steps);
  return status;
}

/* ---------------------------------------------------------------- the problem */

/* of the model that the variant has now */
static ambulo_status make(const ambulo__variant *v, const ambulo_problem_definition *definition,
                          ambulo_diagnostics *diagnostics, int checked, ambulo_problem **problem) {
  const ambulo__problem_keys *keys = &v->origin->keys;
  const ambulo__body_numbers before = body_of(v->origin->model);
  ambulo_problem_definition own = *definition, *d = &own; /* with other contacts, maybe */
  int moved = body_moved(v);
  /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): a copy, NaNs where nothing is given */
  int walks = keys->gait && (moved || memcmp(&v->rule, &keys->rule, sizeof v->rule) != 0);
  double longer = before.stature > 0.0 ? v->body.stature / before.stature : 1.0;
  double heavier = before.mass > 0.0 ? v->body.mass / before.mass : 1.0;
  ambulo__gait_rule rule = v->rule;
  ambulo_contact *contacts = NULL;
  ambulo_gait gait = keys->walk;
  ambulo_status status = AMBULO_OK;
  if (moved && keys->written_for) {
    ambulo__definition_resize(d, keys->terms, longer, heavier);
    rule.width *= longer;
  }
  if (moved) weigh(v, d, ambulo__model_weight(d->model));
  if (moved) follow_points(v, d);
  if (walks) status = walk(v, &rule, d, &gait, &contacts);
  if (!status && checked) status = ambulo_problem_create(d, &v->allocator, diagnostics, problem);
  if (!status && !checked) status = ambulo__problem_build(d, &v->allocator, diagnostics, problem);
  ambulo__free(&v->allocator, contacts);
  if (status) return status;
  (*problem)->file_options = v->origin->file_options;
  (*problem)->keys = *keys;
  (*problem)->keys.rule = rule;
  (*problem)->keys.walk = gait;
  (*problem)->keys.longer *= longer;
  (*problem)->keys.heavier *= heavier;
  return AMBULO_OK;
}

ambulo_status ambulo__variant_problem(const ambulo__variant *v, ambulo_diagnostics *diagnostics,
                                      int checked, ambulo_problem **problem) {
  ambulo_problem_definition d = v->definition;
  const ambulo_model *m = v->origin->model;
  if (!checked && !limits_moved(v) && !body_moved(v))
    return make(v, &d, diagnostics, checked, problem);
  ambulo_model *model = NULL;
  ambulo_muscles *muscles = NULL;
  ambulo_problem *made = NULL;
  ambulo_status status =
      ambulo__model_copy(m, m->points, m->point_count, &v->allocator, NULL, &model);
  if (status) return status;
  change(v, model);
  status = ambulo__definition_copy(&v->definition, &v->allocator, &d);
  d.model = model;
  if (!status) status = ambulo__variant_muscles(v, model, diagnostics, &muscles);
  d.muscles = muscles;
  if (!status) status = make(v, &d, diagnostics, checked, &made);
  ambulo__definition_free(&v->allocator, &d);
  if (status) {
    ambulo_muscles_free(muscles);
    ambulo_model_free(model);
    return status;
  }
  made->owned_muscles = muscles;
  made->owned_model = model;
  *problem = made;
  return AMBULO_OK;
}

/* ----------------------------------------------------------------------- list */

/* room for one more of `count` items; 0: memory ran out */
static int grow(ambulo__parameters *p, void **items, int count, int *capacity, size_t size) {
  if (count < *capacity) return 1;
  int larger = *capacity ? 2 * *capacity : 16;
  void *moved = ambulo__realloc(&p->allocator, *items, (size_t)larger, size);
  p->failed |= !moved;
  if (!moved) return 0;
  *items = moved;
  *capacity = larger;
  return 1;
}

void ambulo__parameter_place(ambulo__parameters *p, double sign, double *at) {
  void *addresses = p->address;
  if (p->failed || !grow(p, &addresses, p->addresses, &p->address_capacity, sizeof *p->address))
    return;
  p->address = addresses;
  p->address[p->addresses++] = (ambulo__address){at, sign};
  p->list[p->count - 1].addresses++;
}

void ambulo__parameter_add(ambulo__parameters *p, ambulo__quantity quantity, double *at,
                           const char *label, const char *name, ...) {
  void *list = p->list;
  if (p->failed || !grow(p, &list, p->count, &p->capacity, sizeof *p->list)) return;
  p->list = list;
  ambulo__parameter *next = &p->list[p->count++];
  *next = p->next;
  next->quantity = quantity;
  next->value = *at;
  next->size = 1.0;
  next->low = -HUGE_VAL;
  next->high = HUGE_VAL;
  next->address = p->addresses;
  va_list arguments;
  va_start(arguments, name);
  (void)vsnprintf(next->name, sizeof next->name, name, arguments);
  va_end(arguments);
  (void)snprintf(next->label, sizeof next->label, "%s", label);
  ambulo__parameter_place(p, 1.0, at);
}

void ambulo__parameter_with(ambulo__parameters *p, double sign, double *at, const char *name, ...) {
  if (p->failed) return;
  ambulo__parameter *last = &p->list[p->count - 1];
  size_t used = strlen(last->with), room = sizeof last->with - used;
  int comma = used ? snprintf(last->with + used, room, ", ") : 0;
  last->with_sign = sign;
  va_list arguments;
  va_start(arguments, name);
  int length = vsnprintf(last->with + used + comma, room - (size_t)comma, name, arguments);
  va_end(arguments);
  if ((size_t)(comma + length) >= room)
    p->count--;
  else
    ambulo__parameter_place(p, sign, at);
}

void ambulo__parameter_sized(ambulo__parameters *p, double size) {
  if (!p->failed && p->problem->keys.written_for) p->list[p->count - 1].size = size;
}

void ambulo__parameter_within(ambulo__parameters *p, double low, double high) {
  if (p->failed) return;
  p->list[p->count - 1].low = low;
  p->list[p->count - 1].high = high;
}

void ambulo__member_label(const ambulo__member *m, int k, const char *of,
                          char text[AMBULO__PARAMETER_TEXT]) {
  const char *label = m->label;
  for (; k > 0 && strchr(label, '|'); k--) label = strchr(label, '|') + 1;
  (void)snprintf(text, AMBULO__PARAMETER_TEXT, "%.*s%s%s", (int)strcspn(label, "|"), label,
                 of[0] ? " " : "", of);
}

void ambulo__parameters_of_members(ambulo__parameters *p, const ambulo__structure *s, void *item,
                                   const char *path, const char *of, ambulo__idle_number *idle) {
  char label[AMBULO__PARAMETER_TEXT], index[16] = "";
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    double *at = (double *)(void *)((char *)item + m->at);
    if (!m->label || m->type > AMBULO__FILE_ANGLE) continue;
    for (int k = 0; k < m->count; k++) {
      if (!isfinite(at[k]) || idle(p, item, m, k)) continue;
      ambulo__member_label(m, k, of, label);
      if (m->count > 1) (void)snprintf(index, sizeof index, "[%d]", k);
      ambulo__parameter_add(p, m->quantity, &at[k], label, "%s%s%s%s", path, path[0] ? "." : "",
                            m->key, m->count > 1 ? index : "");
      int is_length = (m->flags & AMBULO__BODY_LENGTH) != 0;
      double longer = p->problem->keys.written_for ? p->problem->keys.longer : 1.0;
      double size = is_length ? longer : 1.0;
      if (m->low < m->high) ambulo__parameter_within(p, m->low * size, m->high * size);
      ambulo__parameter_sized(p, m->quantity == AMBULO__LOADING_RATE ? 1.0 / sqrt(longer) : size);
    }
  }
}

int ambulo__parameter_partner(const ambulo_problem *problem, int i, double *sign) {
  const ambulo_coordinate *c = &problem->model->coordinates[i];
  *sign = c->mirror_sign;
  if (problem->definition.ends != AMBULO_ENDS_MIRRORED) return -1;
  return c->mirror == i && c->mirror_sign > 0.0 ? -1 : c->mirror;
}

void ambulo__parameters_clear(ambulo__parameters *p) {
  ambulo__free(&p->allocator, p->list);
  ambulo__free(&p->allocator, p->address);
  clear_variant(&p->variant);
  *p = (ambulo__parameters){.count = 0};
}

ambulo__parameter *ambulo__parameters_find(const ambulo__parameters *p, const char *name) {
  for (int i = 0; i < p->count; i++)
    if (strcmp(p->list[i].name, name) == 0) return &p->list[i];
  return NULL;
}

void ambulo__parameter_set(ambulo__parameters *p, const ambulo__parameter *parameter,
                           double value) {
  for (int i = 0; i < parameter->addresses; i++) {
    const ambulo__address *m = &p->address[parameter->address + i];
    *m->at = m->sign * value;
  }
}

/* ---------------------------------------------------------------------- units */

double ambulo__parameter_unit(const ambulo_problem *problem, const ambulo__parameter *p) {
  const ambulo__model_units *units = &problem->model->units;
  int of_model = strncmp(p->name, "model.", 6) == 0;
  int turns = p->quantity == AMBULO__ANGLE || p->quantity == AMBULO__TURNING_SPEED ||
              p->quantity == AMBULO__TURNING_JOLT;
  if (!problem->keys.file) return 1.0;
  if (!of_model) return p->size * (turns ? problem->keys.radians : 1.0);
  if (turns) return units->angle;
  if (p->quantity == AMBULO__RATIO) return p->size; /* a drive's */
  if (p->quantity == AMBULO__TORQUE) return units->moment;
  return p->quantity == AMBULO__FORCE ? units->force : units->length;
}

/* ---------------------------------------------------------------------- steps */

#define DEGREE 0.017453292519943295

/* a change that a person can picture, in the unit of the quantity (of a ratio: share of the value),
 * and in words */
static const struct {
  double step;
  const char *more;
} changes[] = {
    [AMBULO__STEP_LENGTH] = {0.01, "1 cm more"},
    [AMBULO__SHORT_LENGTH] = {0.001, "1 mm more"},
    [AMBULO__ANGLE] = {DEGREE, "1 degree more"},
    [AMBULO__SMALL_ANGLE] = {0.1 * DEGREE, "0.1 degrees more"},
    [AMBULO__TIME] = {0.01, "10 ms more"},
    [AMBULO__SPEED] = {0.1, "0.1 m/s more"},
    [AMBULO__TURNING_SPEED] = {0.1, "0.1 rad/s more"},
    [AMBULO__MASS] = {1.0, "1 kg more"},
    [AMBULO__TORQUE] = {1.0, "1 N m more"},
    [AMBULO__FORCE] = {10.0, "10 N more"},
    [AMBULO__BODY_WEIGHT] = {0.01, "0.01 body weights more"},
    [AMBULO__TURNING_JOLT] = {1.0, "1 rad/s^2 more"},
    [AMBULO__JOLT] = {0.1, "0.1 m/s^2 more"},
    [AMBULO__LOADING_RATE] = {1.0, "1 body weight/s more"},
    [AMBULO__STRIDE_SHARE] = {0.01, "1 % of the stride later"},
    [AMBULO__EVENT_TIME] = {0.01, "10 ms later"},
    [AMBULO__TURNING_STIFF] = {1.0, "1 N m/rad more"},
    [AMBULO__STIFF] = {10.0, "10 N/m more"},
    [AMBULO__RATIO] = {0.01, "1 % more"},
};

static int is_relative(const ambulo__parameter *p) {
  return p->quantity == AMBULO__RATIO && p->value != 0.0;
}

double ambulo__parameter_step(const ambulo__parameter *p) {
  return changes[p->quantity].step * (is_relative(p) ? fabs(p->value) : 1.0);
}

const char *ambulo__parameter_more(const ambulo__parameter *p) {
  int is_share = p->quantity == AMBULO__RATIO && !is_relative(p);
  return is_share ? "0.01 more" : changes[p->quantity].more;
}
