/* exchange/loads.c - see export.h.
 *
 * The torque of a patch at its centre of pressure p is what its force f leaves of its moment about
 * the origin. Inverse dynamics knows feet and hands: with load j of force f_j, point p_j and torque
 * t_j on a link, torques lose (ground_load.h)
 *
 *     z . (t_j + (p_j - o) x f_j)   of hinges,   z . f_j   of sliders between it and the world
 *
 * and of a device at a joint its effort.
 */
#include "exchange/export.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "mechanics/pose.h"
#include "people/ground_load.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct builder {
  ambulo__loads *loads;
  const ambulo__bodies *bodies;
  const ambulo_model *model;
  const ambulo_problem *problem;
  ambulo__source *source;
  ambulo_diagnostics *diagnostics;
  const double *frames; /* [links][12], of the row */
} builder;

static const char *const axes[] = {".x", ".y", ".z"};

int ambulo__has_loads(const ambulo_problem *problem) {
  return problem && ambulo__holds_patches(&problem->definition);
}

/* ------------------------------------------------------------------------- listing */

/* column "kind.name.part" and the like; -1 */
static int column(const builder *b, const char *before, const char *name, const char *after) {
  char label[3 * AMBULO__MOTION_MAX_NAME];
  (void)snprintf(label, sizeof label, "%s%s%s", before, name, after);
  return ambulo__motion_column(b->source->table, label);
}

static ambulo__export_load *add(builder *b, ambulo__load_kind kind, int index, int part, int link,
                                int body) {
  ambulo__export_load *load = &b->loads->list[b->loads->count++];
  *load =
      (ambulo__export_load){.kind = kind, .index = index, .part = part, .link = link, .body = body};
  return load;
}

static void warn_missing(const builder *b, const char *kind, const char *name) {
  ambulo__warning(b->diagnostics, ambulo__nowhere, NULL,
                  "the motion has no columns of %s '%s': it is left out", kind, name);
}

static void name_load(ambulo__export_load *load, const char *name, const char *behind) {
  (void)snprintf(load->name, sizeof load->name, "%s%s%s", name, behind ? "_" : "",
                 behind ? behind : "");
}

static void list_source(builder *b) {
  for (int i = 0; i < b->source->loads; i++) {
    const ambulo__source_load *own = &b->source->load[i];
    ambulo__load_kind kind = own->point < 0 ? AMBULO__LOAD_FOOT : AMBULO__LOAD_HAND;
    name_load(add(b, kind, i, 0, own->link, b->bodies->body_of[own->link]), own->name, NULL);
  }
}

static void list_patches(builder *b) {
  for (int i = 0; i < b->model->patch_count; i++) {
    const ambulo_patch *patch = &b->model->patches[i];
    if (!ambulo__patch_is_used(&b->problem->definition, i)) continue;
    if (column(b, "moment.", patch->name, ".x") < 0) {
      warn_missing(b, "the patch", patch->name);
      continue;
    }
    int link = b->model->points[patch->point].link;
    ambulo__export_load *load = add(b, AMBULO__LOAD_PATCH, i, 0, link, b->bodies->body_of[link]);
    name_load(load, patch->name, NULL);
    for (int k = 0; k < 3; k++) {
      load->column[k] = column(b, "grf.", patch->name, axes[k]);
      load->column[3 + k] = column(b, "cop.", patch->name, axes[k]);
      load->column[6 + k] = column(b, "moment.", patch->name, axes[k]);
    }
  }
}

static void list_device(builder *b, int index) {
  const ambulo_device *device = &b->problem->definition.devices[index];
  int at = column(b, "device.", device->name, ".torque");
  if (at < 0) at = column(b, "device.", device->name, ".force");
  if (at < 0) {
    warn_missing(b, "the device", device->name);
    return;
  }
  for (int end = 0; end < 2; end++) {
    int body = ambulo__device_end(b->bodies, device, end);
    int link = device->coordinate < 0 ? device->link[end] : -1;
    ambulo__export_load *load = add(b, AMBULO__LOAD_DEVICE, index, end, link, body);
    name_load(load, device->name, body < 0 ? "ground" : b->bodies->list[body].name);
    load->column[0] = at;
  }
}

/* what a problem would have to be named for */
static void warn_unknown(const builder *b) {
  const ambulo__motion *table = b->source->table;
  for (int c = 0; c < table->columns; c++) {
    const char *name = table->names[c];
    int pressed = 0;
    for (int i = 0; i < b->model->patch_count; i++) {
      const char *patch = b->model->patches[i].name;
      pressed |= strncmp(name, "grf.", 4) == 0 && strncmp(name + 4, patch, strlen(patch)) == 0 &&
                 strcmp(name + 4 + strlen(patch), ".x") == 0;
    }
    if (!pressed && strncmp(name, "device.", 7) != 0) continue;
    ambulo__warning(b->diagnostics, ambulo__nowhere,
                    "give the problem instead of the model to export its devices and patches",
                    "the motion has '%s', which is left out without its problem", name);
    return;
  }
}

static ambulo_status list_loads(builder *b) {
  const ambulo_problem_definition *d = b->problem ? &b->problem->definition : NULL;
  size_t most = (size_t)b->source->loads;
  if (d) most += (size_t)b->model->patch_count + 2 * (size_t)d->device_count;
  b->loads->list = ambulo__alloc(&b->loads->allocator, most, sizeof *b->loads->list);
  if (!b->loads->list) return AMBULO_E_MEMORY;
  list_source(b);
  if (!d) {
    warn_unknown(b);
    return AMBULO_OK;
  }
  list_patches(b);
  for (int i = 0; i < d->device_count; i++) list_device(b, i);
  return AMBULO_OK;
}

/* -------------------------------------------------------------------------- values */

static double cell(const builder *b, const ambulo__export_load *load, int k, int part) {
  const ambulo__motion *t = b->source->table;
  return t->values[(size_t)k * (size_t)t->columns + (size_t)load->column[part]];
}

static void copy_source(const builder *b, const ambulo__export_load *load, int k, double *force,
                        double *point, double *torque) {
  const ambulo__source *s = b->source;
  size_t at = 3 * ((size_t)k * (size_t)s->loads + (size_t)load->index);
  memcpy(force, s->force + at, 3 * sizeof *force);
  memcpy(point, s->point + at, 3 * sizeof *point);
  memcpy(torque, s->torque + at, 3 * sizeof *torque);
}

/* torque: the moment about the origin, until each row has a point */
static void fill_patch(const builder *b, const ambulo__export_load *load, int k, double *force,
                       double *point, double *torque) {
  for (int i = 0; i < 3; i++) {
    force[i] = cell(b, load, k, i);
    point[i] = cell(b, load, k, 3 + i);
    torque[i] = cell(b, load, k, 6 + i);
  }
}

static void fill_load(const builder *b, const ambulo__export_load *load, int k, double *force,
                      double *point, double *torque) {
  switch (load->kind) {
  case AMBULO__LOAD_FOOT:
  case AMBULO__LOAD_HAND:
    copy_source(b, load, k, force, point, torque);
    break;
  case AMBULO__LOAD_PATCH:
    fill_patch(b, load, k, force, point, torque);
    break;
  case AMBULO__LOAD_DEVICE:
    ambulo__device_load(b->bodies, &b->problem->definition.devices[load->index], load->part,
                        b->frames, cell(b, load, k, 0), force, point, torque);
  }
}

/* what inverse dynamics did not take off the torques */
static void take_off(const builder *b, const ambulo__export_load *load, int k, const double *force,
                     const double *point, const double *torque) {
  double *tau = b->source->tau + (size_t)k * (size_t)b->source->coordinates, moment[3];
  if (load->kind == AMBULO__LOAD_FOOT || load->kind == AMBULO__LOAD_HAND) return;
  if (load->link < 0) { /* a device at a joint, or at a point of the world */
    int c = load->part == 0 ? b->problem->definition.devices[load->index].coordinate : -1;
    if (c >= 0) tau[c] -= cell(b, load, k, 0);
    return;
  }
  memcpy(moment, torque, sizeof moment);
  if (load->kind == AMBULO__LOAD_DEVICE) ambulo__add_cross(point, force, 1.0, moment);
  ambulo__load_take(b->model, b->frames, load->link,
                    b->source->q + (size_t)k * (size_t)b->source->coordinates, force, moment, tau);
}

/* the torque of a patch at its points, once all rows have one */
static void place_patch(ambulo__loads *l, const double *time, int load) {
  ambulo__fill_points(time, l->rows, l->count, load, l->point);
  for (int k = 0; k < l->rows; k++) {
    size_t at = 3 * ((size_t)k * (size_t)l->count + (size_t)load);
    ambulo__add_cross(l->point + at, l->force + at, -1.0, l->torque + at);
  }
}

static ambulo_status fill(builder *b) {
  ambulo__loads *l = b->loads;
  ambulo__pose pose = {.model = NULL};
  size_t count = (size_t)l->rows * (size_t)l->count * 3;
  double **const fields[] = {&l->force, &l->point, &l->torque};
  for (int i = 0; i < 3; i++) {
    *fields[i] = ambulo__alloc(&l->allocator, count, sizeof(double));
    if (!*fields[i]) return AMBULO_E_MEMORY;
  }
  ambulo_status status = ambulo__pose_create(b->model, &l->allocator, &pose);
  if (status) return status;
  b->frames = pose.frames;
  for (int k = 0; k < l->rows; k++) {
    ambulo__pose_at(&pose, b->source->q + (size_t)k * (size_t)b->source->coordinates);
    for (int i = 0; i < l->count; i++) {
      size_t at = 3 * ((size_t)k * (size_t)l->count + (size_t)i);
      fill_load(b, &l->list[i], k, l->force + at, l->point + at, l->torque + at);
      take_off(b, &l->list[i], k, l->force + at, l->point + at, l->torque + at);
    }
  }
  ambulo__pose_free(&pose);
  for (int i = 0; i < l->count; i++)
    if (l->list[i].kind == AMBULO__LOAD_PATCH) place_patch(l, b->source->time, i);
  return AMBULO_OK;
}

/* what of the root wrench all loads leave over, about the origin: the largest of all rows */
static void note_rest(const builder *b) {
  const ambulo__loads *l = b->loads;
  double weight = ambulo__model_weight(b->model), worst[2] = {0.0, 0.0};
  if (!ambulo__has_loads(b->problem) || b->source->loads == 0) return;
  for (int k = 0; k < l->rows; k++) {
    double rest[6];
    memcpy(rest, b->source->wrench + 6 * (size_t)k, sizeof rest);
    for (int i = 0; i < l->count; i++) {
      size_t at = 3 * ((size_t)k * (size_t)l->count + (size_t)i);
      if (l->list[i].kind == AMBULO__LOAD_DEVICE || l->list[i].kind == AMBULO__LOAD_HAND) continue;
      for (int a = 0; a < 3; a++) {
        rest[a] -= l->torque[at + (size_t)a];
        rest[3 + a] -= l->force[at + (size_t)a];
      }
      ambulo__add_cross(l->point + at, l->force + at, -1.0, rest);
    }
    worst[0] = fmax(worst[0], sqrt(ambulo__dot(rest + 3, rest + 3)) / weight);
    worst[1] = fmax(worst[1], sqrt(ambulo__dot(rest, rest)) / weight);
  }
  ambulo__note(b->diagnostics, ambulo__nowhere,
               "the residual at the root, with the forces on patches, is at most %.1e body weights "
               "and %.1e body weights m",
               worst[0], worst[1]);
}

ambulo_status ambulo__loads_create(const ambulo__bodies *bodies, const ambulo_problem *problem,
                                   ambulo__source *source, ambulo_diagnostics *diagnostics,
                                   ambulo__loads *loads) {
  ambulo__loads made = {.allocator = bodies->allocator, .rows = source->rows};
  builder b = {.loads = &made,
               .bodies = bodies,
               .model = bodies->model,
               .problem = problem,
               .source = source,
               .diagnostics = diagnostics};
  ambulo_status status = list_loads(&b);
  if (!status) status = fill(&b);
  if (!status) note_rest(&b);
  if (status)
    ambulo__loads_free(&made);
  else
    *loads = made;
  return status;
}

void ambulo__loads_free(ambulo__loads *l) {
  ambulo__free(&l->allocator, l->list);
  ambulo__free(&l->allocator, l->force);
  ambulo__free(&l->allocator, l->point);
  ambulo__free(&l->allocator, l->torque);
  *l = (ambulo__loads){.count = 0};
}

/* ---------------------------------------------------------------------- devices */

/* A device as a force and a torque on each of its two bodies.
 *
 * Between two points the tension E pulls each of them towards the other. At a joint, a coordinate i
 * of a body whose joint has axes z_1 .. z_n of its kind, n <= 3: the torque (of a slider: force)
 *
 *     t = E w_i,   w_i . z_j = 1 for j = i, 0 for the others, w_i in their span
 *
 * on the body and -t on its parent have the generalized forces t . z_j: E at i and nothing at the
 * others of that joint; above it they cancel. With b, c the other axes (c = z_i x b where there are
 * two), w_i = b x c / (z_i . (b x c)). A force goes through the point that the joint's hinges
 * share, behind its sliders.
 */

static const ambulo__export_body *body_of(const ambulo__bodies *bodies, int coordinate) {
  for (int b = 0; b < bodies->count; b++)
    for (int i = 0; i < bodies->list[b].joints; i++)
      if (bodies->list[b].coordinate[i] == coordinate) return &bodies->list[b];
  return NULL;
}

int ambulo__device_end(const ambulo__bodies *bodies, const ambulo_device *device, int end) {
  if (device->coordinate < 0) {
    int link = device->link[end];
    return link < 0 ? -1 : bodies->body_of[link];
  }
  const ambulo__export_body *body = body_of(bodies, device->coordinate);
  if (!body) return -1;
  return end ? body->parent : (int)(body - bodies->list);
}

/* z of the frame before the joint of a coordinate */
static void axis_of(const ambulo_model *model, const double *frames, int coordinate,
                    double axis[3]) {
  int link = 0;
  while (model->links[link].coordinate != coordinate) link++;
  int parent = model->links[link].parent;
  for (int i = 0; i < 3; i++)
    axis[i] = parent < 0 ? (double)(i == 2) : frames[12 * (size_t)parent + 4 * (size_t)i + 2];
}

/* w_i */
static void dual_axis(const ambulo__bodies *bodies, const ambulo__export_body *body, int coordinate,
                      const double *frames, double out[3]) {
  const ambulo_model *model = bodies->model;
  double axis[3], other[2][3], cross[3];
  int others = 0;
  axis_of(model, frames, coordinate, axis);
  for (int i = 0; i < body->joints; i++) {
    int c = body->coordinate[i];
    if (c >= 0 && c != coordinate &&
        model->coordinates[c].type == model->coordinates[coordinate].type)
      axis_of(model, frames, c, other[others++]);
  }
  memcpy(out, axis, sizeof axis);
  if (others == 0) return;
  if (others == 1) ambulo__cross(axis, other[0], other[1]);
  ambulo__cross(other[0], other[1], cross);
  double along = ambulo__dot(axis, cross);
  for (int i = 0; i < 3; i++) out[i] = cross[i] / along;
}

/* where the hinges of a body's joint meet */
static void center_of(const ambulo__bodies *bodies, const ambulo__export_body *body,
                      const double *frames, double point[3]) {
  ambulo__rigid back = ambulo__rigid_inverse(&body->after);
  double local[3];
  const double *f = frames + 12 * (size_t)body->link;
  const ambulo__rigid *place = &bodies->place[body->link];
  for (int i = 0; i < 3; i++) back.p[i] -= place->p[i];
  ambulo__rigid_back(place, back.p, local);
  for (int i = 0; i < 3; i++) point[i] = ambulo__dot(f + 4 * i, local) + f[4 * i + 3];
}

static void place_of(const double *frames, int link, const double local[3], double point[3]) {
  memcpy(point, local, 3 * sizeof *point);
  if (link < 0) return;
  const double *f = frames + 12 * (size_t)link;
  for (int i = 0; i < 3; i++) point[i] = ambulo__dot(f + 4 * i, local) + f[4 * i + 3];
}

static void pull(const ambulo_device *device, int end, const double *frames, double effort,
                 double force[3], double point[3]) {
  double other[3], length = 0.0;
  place_of(frames, device->link[end], device->position[end], point);
  place_of(frames, device->link[!end], device->position[!end], other);
  for (int i = 0; i < 3; i++) length += (other[i] - point[i]) * (other[i] - point[i]);
  for (int i = 0; i < 3; i++) force[i] = effort * (other[i] - point[i]) / sqrt(length);
}

void ambulo__device_load(const ambulo__bodies *bodies, const ambulo_device *device, int end,
                         const double *frames, double effort, double force[3], double point[3],
                         double torque[3]) {
  static const double none[3] = {0.0, 0.0, 0.0};
  memcpy(force, none, sizeof none);
  memcpy(torque, none, sizeof none);
  if (device->coordinate < 0) {
    pull(device, end, frames, effort, force, point);
    return;
  }
  const ambulo__export_body *body = body_of(bodies, device->coordinate);
  double axis[3], size = end ? -effort : effort;
  int turns = bodies->model->coordinates[device->coordinate].type == AMBULO_REVOLUTE;
  dual_axis(bodies, body, device->coordinate, frames, axis);
  center_of(bodies, body, frames, point);
  for (int i = 0; i < 3; i++) *(turns ? torque + i : force + i) = size * axis[i];
}
