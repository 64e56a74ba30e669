/* solver/variant.c - see variant.h. */
#include "solver/variant.h"

#include "base/diagnostics.h"
#include "contact/schedule.h"
#include "model/conditions.h"
#include "problem/definition.h"

#include <math.h>
#include <string.h>

/* ------------------------------------------------------------------- the copy */

/* arrays of the copy belong to the variant; the definition has them as const */
#define WRITABLE(type, name, member)                                                               \
  type *ambulo__variant_##name(ambulo__variant *v) {                                               \
    union {                                                                                        \
      const type *view;                                                                            \
      type *array;                                                                                 \
    } of = {v->definition.member};                                                                 \
    return of.array;                                                                               \
  }
WRITABLE(ambulo_contact, contacts, contacts)
WRITABLE(ambulo_term, terms, terms)
WRITABLE(ambulo_device, devices, devices)
WRITABLE(ambulo_hold, holds, holds)
WRITABLE(ambulo_obstacle, obstacles, obstacles)
WRITABLE(ambulo_reach, reaches, reaches)
WRITABLE(ambulo_end_value, end_values, end_values)

double *ambulo__variant_array(const double *array) {
  union {
    const double *view;
    double *array;
  } of = {array};
  return of.array;
}

static ambulo__body body_of(const ambulo_model *m) {
  const double *g = m->gravity;
  double along[2] = {0.0, 0.0};
  for (int i = 0; i < 3; i++) {
    along[0] -= g[i] * m->up[i];
    along[1] -= g[i] * m->forward[i];
  }
  ambulo__body body = {.stature = m->stature, .slope = atan2(along[1], along[0])};
  body.mass = m->units.mass == 0.0 || m->units.mass == 1.0 ? m->mass - ambulo__model_load_mass(m)
                                                           : m->units.mass;
  for (int i = 0; i < m->load_count; i++) body.load[i] = m->loads[i].mass;
  return body;
}

/* postures that name no angles rest at 0 */
static ambulo_status fill_rests(ambulo__variant *v) {
  ambulo_term *terms = ambulo__variant_terms(v);
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
  return status ? status : fill_rests(v);
}

void ambulo__variant_clear(ambulo__variant *v) {
  if (!v->origin) return;
  ambulo__free(&v->allocator, v->coordinates);
  ambulo__definition_free(&v->allocator, &v->definition);
  *v = (ambulo__variant){.origin = NULL};
}

/* ------------------------------------------------------------------- the body */

static int limits_moved(const ambulo__variant *v) {
  size_t bytes = (size_t)v->origin->coordinates * sizeof *v->coordinates;
  return memcmp(v->coordinates, v->origin->model->coordinates, bytes) != 0;
}

static int body_moved(const ambulo__variant *v) {
  ambulo__body before = body_of(v->origin->model);
  return memcmp(&before, &v->body, sizeof before) != 0;
}

static void change(const ambulo__variant *v, ambulo_model *m) {
  const ambulo__body before = body_of(v->origin->model), *now = &v->body;
  ambulo__model_load load[AMBULO__MOST_LOADS];
  int loads = m->load_count;
  for (int i = 0; i < m->coordinate_count; i++) {
    memcpy(m->coordinates[i].range, v->coordinates[i].range, 2 * sizeof(double));
    memcpy(m->coordinates[i].speed, v->coordinates[i].speed, 2 * sizeof(double));
    memcpy(m->coordinates[i].torque, v->coordinates[i].torque, 2 * sizeof(double));
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
        ambulo__variant_array(d->terms[t].offset)[i] = copysign(weight, was->offset[i]);
  }
}

/* ends of devices that are points of the model stay them */
static void follow_points(const ambulo__variant *v, ambulo_problem_definition *d) {
  const ambulo_model *m = v->origin->model;
  union {
    const ambulo_device *view;
    ambulo_device *devices;
  } of = {d->devices};
  for (int end = 0; end < 2 * d->device_count; end++) {
    ambulo_device *device = &of.devices[end / 2];
    double *place = device->position[end % 2];
    for (int i = 0; i < m->point_count && device->coordinate < 0; i++)
      if (m->points[i].link == device->link[end % 2] &&
          memcmp(m->points[i].position, place, 3 * sizeof *place) == 0)
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
  const ambulo__body before = body_of(v->origin->model);
  ambulo_problem_definition own = *definition, *d = &own; /* with other contacts, maybe */
  int moved = body_moved(v);
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
  ambulo_problem *made = NULL;
  ambulo_status status =
      ambulo__model_copy(m, m->points, m->point_count, &v->allocator, NULL, &model);
  if (status) return status;
  change(v, model);
  status = ambulo__definition_copy(&v->definition, &v->allocator, &d);
  d.model = model;
  if (!status) status = make(v, &d, diagnostics, checked, &made);
  ambulo__definition_free(&v->allocator, &d);
  if (status) {
    ambulo_model_free(model);
    return status;
  }
  made->owned_model = model;
  *problem = made;
  return AMBULO_OK;
}
