/* export/loads.c - see loads.h.
 *
 * What a hand exerts on what it holds acts on the hand the other way round. The free moment of a
 * patch is about the normal of the contact that it has at the time; in the mirrored half of a
 * stride that is the image of its partner's. Inverse dynamics knows the feet alone: with load j of
 * force f_j, point p_j and torque t_j on a link, torques lose (ground_load.h)
 *
 *     z . (t_j + (p_j - o) x f_j)   of hinges,   z . f_j   of sliders between it and the world
 *
 * and of a device at a joint its effort.
 */
#include "export/loads.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "gait/contact_frame.h"
#include "gait/effector.h"
#include "gait/loading.h"
#include "inverse/ground_load.h"
#include "mechanics/pose.h"

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

const char *ambulo__load_prefix(const ambulo__export_load *load) {
  return load->kind == AMBULO__LOAD_FOOT || load->kind == AMBULO__LOAD_PATCH ? "ground_" : "";
}

int ambulo__has_loads(const ambulo_problem *problem) {
  const ambulo_problem_definition *d = problem ? &problem->definition : NULL;
  return d && (d->hold_count > 0 || ambulo__holds_patches(d));
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

static void tell_missing(const builder *b, const char *kind, const char *name) {
  ambulo__warning(b->diagnostics, ambulo__nowhere, NULL,
                  "the motion says nothing of %s '%s': it is left out", kind, name);
}

static void name_load(ambulo__export_load *load, const char *name, const char *behind) {
  (void)snprintf(load->name, sizeof load->name, "%s%s%s", name, behind ? "_" : "",
                 behind ? behind : "");
}

static void list_feet(builder *b) {
  for (int foot = 0; foot < b->source->feet; foot++) {
    const ambulo_foot *f = &b->model->feet[foot];
    int link = b->model->points[f->heel[0]].link;
    name_load(add(b, AMBULO__LOAD_FOOT, foot, 0, link, b->bodies->body_of[link]), f->name, NULL);
  }
}

static void list_patches(builder *b) {
  for (int i = 0; i < b->model->patch_count; i++) {
    const ambulo_patch *patch = &b->model->patches[i];
    if (!ambulo__patch_is_used(&b->problem->definition, i)) continue;
    if (column(b, "free_moment.", patch->name, "") < 0) {
      tell_missing(b, "the patch", patch->name);
      continue;
    }
    int link = b->model->points[patch->point].link;
    ambulo__export_load *load = add(b, AMBULO__LOAD_PATCH, i, 0, link, b->bodies->body_of[link]);
    name_load(load, patch->name, NULL);
    for (int k = 0; k < 3; k++) {
      load->column[k] = column(b, "grf.", patch->name, axes[k]);
      load->column[3 + k] = column(b, "cop.", patch->name, axes[k]);
    }
    load->column[6] = column(b, "free_moment.", patch->name, "");
  }
}

static void list_hand(builder *b, int index, int hand) {
  const ambulo_hold *hold = &b->problem->definition.holds[index];
  const ambulo_point *point = &b->model->points[hold->hand[hand]];
  char name[2 * AMBULO__LOAD_NAME], part[16];
  (void)snprintf(name, sizeof name, "%s.%s", hold->name, point->name);
  if (column(b, "held.", name, ".force.x") < 0) {
    tell_missing(b, "what hands hold,", hold->name);
    return;
  }
  ambulo__export_load *load =
      add(b, AMBULO__LOAD_HAND, index, hand, point->link, b->bodies->body_of[point->link]);
  name_load(load, hold->name, point->name);
  for (int k = 0; k < 6; k++) {
    (void)snprintf(part, sizeof part, ".%s%s", k < 3 ? "force" : "moment", axes[k % 3]);
    load->column[k] = column(b, "held.", name, part);
  }
}

static void list_device(builder *b, int index) {
  const ambulo_device *device = &b->problem->definition.devices[index];
  int at = column(b, "device.", device->name, ".torque");
  if (at < 0) at = column(b, "device.", device->name, ".force");
  if (at < 0) {
    tell_missing(b, "the device", device->name);
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
static void tell_unknown(const builder *b) {
  const ambulo__motion *table = b->source->table;
  for (int c = 0; c < table->columns; c++) {
    const char *name = table->names[c];
    int pressed = 0;
    for (int i = 0; i < b->model->patch_count; i++) {
      const char *patch = b->model->patches[i].name;
      pressed |= strncmp(name, "grf.", 4) == 0 && strncmp(name + 4, patch, strlen(patch)) == 0 &&
                 strcmp(name + 4 + strlen(patch), ".x") == 0;
    }
    if (!pressed && strncmp(name, "held.", 5) != 0 && strncmp(name, "device.", 7) != 0) continue;
    ambulo__warning(b->diagnostics, ambulo__nowhere,
                    "name the problem in place of its model, and its devices, patches and what "
                    "hands hold are exported, too",
                    "the motion has '%s': without its problem that is left out", name);
    return;
  }
}

static ambulo_status list_loads(builder *b) {
  const ambulo_problem_definition *d = b->problem ? &b->problem->definition : NULL;
  size_t most = (size_t)b->source->feet;
  if (d) most += (size_t)b->model->patch_count + 2 * (size_t)(d->hold_count + d->device_count);
  b->loads->list = ambulo__alloc(&b->loads->allocator, most, sizeof *b->loads->list);
  if (!b->loads->list) return AMBULO_E_MEMORY;
  list_feet(b);
  if (!d) {
    tell_unknown(b);
    return AMBULO_OK;
  }
  list_patches(b);
  for (int i = 0; i < d->hold_count; i++)
    for (int hand = 0; hand < 2 && d->holds[i].hand[hand] >= 0; hand++) list_hand(b, i, hand);
  for (int i = 0; i < d->device_count; i++) list_device(b, i);
  return AMBULO_OK;
}

/* -------------------------------------------------------------------------- values */

static double cell(const builder *b, const ambulo__export_load *load, int k, int part) {
  const ambulo__motion *t = b->source->table;
  return t->values[(size_t)k * (size_t)t->columns + (size_t)load->column[part]];
}

/* normal of the contact that a patch has */
static void patch_normal(const builder *b, int patch, double time, double normal[3]) {
  const ambulo_problem_definition *d = &b->problem->definition;
  int effector = b->model->foot_count + patch;
  int image = d->ends == AMBULO_ENDS_MIRRORED && time > d->duration;
  if (image) effector = ambulo__effector_mirror(b->model, effector);
  const ambulo_contact *contact =
      ambulo__contact_of(d, effector, image ? time - d->duration : time);
  memcpy(normal, b->model->up, 3 * sizeof *normal);
  if (!contact) return;
  ambulo__contact_frame frame = ambulo__contact_frame_of(d, contact);
  double aside = image ? ambulo__dot(frame.up, b->model->left) : 0.0;
  for (int i = 0; i < 3; i++) normal[i] = frame.up[i] - 2.0 * aside * b->model->left[i];
}

static void fill_foot(const builder *b, const ambulo__export_load *load, int k, double *force,
                      double *point, double *torque) {
  const ambulo__source *s = b->source;
  size_t at = (size_t)k * (size_t)s->feet + (size_t)load->index;
  memcpy(force, s->force + 3 * at, 3 * sizeof *force);
  memcpy(point, s->point + 3 * at, 3 * sizeof *point);
  for (int i = 0; i < 3; i++) torque[i] = s->free_moment[at] * b->model->up[i];
}

static void fill_patch(const builder *b, const ambulo__export_load *load, int k, double *force,
                       double *point, double *torque) {
  double normal[3];
  patch_normal(b, load->index, b->source->time[k], normal);
  for (int i = 0; i < 3; i++) {
    force[i] = cell(b, load, k, i);
    point[i] = cell(b, load, k, 3 + i);
    torque[i] = cell(b, load, k, 6) * normal[i];
  }
}

static void fill_hand(const builder *b, const ambulo__export_load *load, int k, double *force,
                      double *point, double *torque) {
  const ambulo_hold *hold = &b->problem->definition.holds[load->index];
  const ambulo_point *hand = &b->model->points[hold->hand[load->part]];
  const double *f = b->frames + 12 * (size_t)hand->link;
  for (int i = 0; i < 3; i++) {
    force[i] = -cell(b, load, k, i);
    torque[i] = -cell(b, load, k, 3 + i);
    point[i] = ambulo__dot(f + 4 * i, hand->position) + f[4 * i + 3];
  }
}

static void fill_load(const builder *b, const ambulo__export_load *load, int k, double *force,
                      double *point, double *torque) {
  switch (load->kind) {
  case AMBULO__LOAD_FOOT:
    fill_foot(b, load, k, force, point, torque);
    break;
  case AMBULO__LOAD_PATCH:
    fill_patch(b, load, k, force, point, torque);
    break;
  case AMBULO__LOAD_HAND:
    fill_hand(b, load, k, force, point, torque);
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
  if (load->kind == AMBULO__LOAD_FOOT) return;
  if (load->link < 0) { /* a device at a joint, or at a point of the world */
    int c = load->kind == AMBULO__LOAD_DEVICE && load->part == 0
                ? b->problem->definition.devices[load->index].coordinate
                : -1;
    if (c >= 0) tau[c] -= cell(b, load, k, 0);
    return;
  }
  if (!isfinite(point[0])) return; /* a patch in the air */
  ambulo__cross(point, force, moment);
  for (int i = 0; i < 3; i++) moment[i] += torque[i];
  ambulo__load_take(b->model, b->frames, load->link, force, moment, tau);
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
    ambulo__fill_points(b->source->time, l->rows, l->count, i, l->point);
  return AMBULO_OK;
}

/* what of the root wrench all loads leave over, about the origin: the largest of all rows */
static void tell_rest(const builder *b) {
  const ambulo__loads *l = b->loads;
  double weight = ambulo__model_weight(b->model), worst[2] = {0.0, 0.0};
  if (!ambulo__has_loads(b->problem) || b->source->feet == 0) return;
  for (int k = 0; k < l->rows; k++) {
    double rest[6];
    memcpy(rest, b->source->wrench + 6 * (size_t)k, sizeof rest);
    for (int i = 0; i < l->count; i++) {
      size_t at = 3 * ((size_t)k * (size_t)l->count + (size_t)i);
      if (l->list[i].kind == AMBULO__LOAD_DEVICE) continue;
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
               "with forces on hands and patches at most %.1e body weights and %.1e body weights m "
               "are left over at the root",
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
  if (!status) tell_rest(&b);
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
