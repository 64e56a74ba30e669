/* show/scene_body.c - series of whole numbers, and the ends of bones over time (scene.h).
 *
 * Values are rounded before their differences are taken. Adding the differences up then gives the
 * rounded values exactly, however long the series is.
 */
#include "show/scene.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic.h"

static const double largest = 1099511627776.0; /* 2^40: differences of differences fit */

void ambulo__series(ambulo__json *json, const char *key, const double *values, int step, int count,
                    double unit) {
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  long long last = 0, slope = 0;
  ambulo__text_append_char(&line, '[');
  for (int k = 0; k < count; k++) {
    double scaled = round(values[(size_t)k * (size_t)step] / unit);
    long long now = fabs(scaled) <= largest ? (long long)scaled : last;
    long long change = now - last;
    if (k > 0) ambulo__text_append_char(&line, ',');
    ambulo__text_append_number(&line, (double)(k < 2 ? change : change - slope));
    slope = change;
    last = now;
  }
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, key, ambulo__text_data(&line));
  ambulo__text_free(&line);
}

const char *ambulo__scene_side(ambulo__side side) {
  static const char *const words[] = {"middle", "left", "right"};
  return words[side];
}

void ambulo__scene_place(const ambulo_model *model, double ground, const double world[3],
                         double place[3]) {
  place[0] = ambulo__dot(model->forward, world);
  place[1] = ambulo__dot(model->left, world);
  place[2] = ambulo__dot(model->up, world) - ground;
}

void ambulo__scene_json_place(ambulo__json *json, const char *key, const double place[3]) {
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  for (int i = 0; i < 3; i++) {
    double rounded = round(place[i] * 1e4) / 1e4;
    ambulo__text_append(&line, i ? ", " : "[");
    ambulo__text_append_number(&line, isfinite(rounded) ? rounded + 0.0 : 0.0);
  }
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, key, ambulo__text_data(&line));
  ambulo__text_free(&line);
}

ambulo_status ambulo__scene_body_create(const ambulo_model *model, const double *q, int samples,
                                        double ground, const ambulo_allocator *allocator,
                                        ambulo__scene_body *body) {
  *body = (ambulo__scene_body){.allocator = ambulo__allocator_or_default(allocator),
                               .model = model,
                               .samples = samples,
                               .q = q,
                               .ground = ground};
  return ambulo__skeleton_create(model, allocator, &body->skeleton);
}

void ambulo__scene_body_free(ambulo__scene_body *body) {
  if (!body->model) return;
  ambulo__skeleton_free(&body->skeleton);
  ambulo__free(&body->allocator, body->points);
  body->points = NULL;
}

/* -------------------------------------------------------------------- points */

static int grow(ambulo__scene_body *body) {
  int capacity = body->capacity ? 2 * body->capacity : 64;
  ambulo__scene_point *points =
      ambulo__alloc(&body->allocator, (size_t)capacity, sizeof *body->points);
  if (!points) return 0;
  if (body->count) memcpy(points, body->points, (size_t)body->count * sizeof *points);
  ambulo__free(&body->allocator, body->points);
  body->points = points;
  body->capacity = capacity;
  return 1;
}

int ambulo__scene_body_point(ambulo__scene_body *body, int link, const double at[3]) {
  for (int i = 0; i < body->count; i++) {
    const ambulo__scene_point *p = &body->points[i];
    if (p->link == link && p->at[0] == at[0] && p->at[1] == at[1] && p->at[2] == at[2]) return i;
  }
  if (body->failed || (body->count == body->capacity && !grow(body))) {
    body->failed = 1;
    return 0;
  }
  ambulo__scene_point *added = &body->points[body->count];
  added->link = link;
  memcpy(added->at, at, sizeof added->at);
  return body->count++;
}

static void json_points(ambulo__json *json, const char *key, const int *point, int count) {
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, json->text);
  ambulo__text_append_char(&line, '[');
  for (int i = 0; i < count; i++) ambulo__text_append_format(&line, i ? ", %d" : "%d", point[i]);
  ambulo__text_append_char(&line, ']');
  ambulo__json_raw(json, key, ambulo__text_data(&line));
  ambulo__text_free(&line);
}

/* --------------------------------------------------------------------- bones */

static void bone(ambulo__json *json, const char *name, ambulo__side side, const int ends[2],
                 const char *kind, double radius) {
  ambulo__json_open(json, NULL, '{');
  if (name) ambulo__json_text(json, "name", name);
  ambulo__json_text(json, "kind", kind);
  ambulo__json_text(json, "side", ambulo__scene_side(side));
  json_points(json, "points", ends, 2);
  ambulo__json_number(json, "radius", round(radius * 1e4) / 1e4);
  ambulo__json_close(json, '}');
}

static void capsules(ambulo__json *json, ambulo__scene_body *body) {
  const ambulo_model *model = body->model;
  for (int i = 0; i < model->capsule_count; i++) {
    const ambulo_capsule *c = &model->capsules[i];
    int ends[2] = {ambulo__scene_body_point(body, c->link, c->from),
                   ambulo__scene_body_point(body, c->link, c->to)};
    bone(json, c->name, body->skeleton.side[c->link], ends, "capsule", c->radius);
  }
}

static void lines(ambulo__json *json, ambulo__scene_body *body) {
  for (int i = 0; i < body->skeleton.bone_count; i++) {
    const ambulo__bone *b = &body->skeleton.bones[i];
    int ends[2] = {ambulo__scene_body_point(body, b->link[0], b->at[0]),
                   ambulo__scene_body_point(body, b->link[1], b->at[1])};
    bone(json, NULL, b->side, ends, b->head > 0.0 ? "head" : "line", b->head);
  }
}

/* around the sole: heel, toes; the ankle, where the foot's link begins */
static void feet(ambulo__json *json, ambulo__scene_body *body) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  const ambulo_model *model = body->model;
  ambulo__json_open(json, "feet", '[');
  for (int f = 0; f < model->foot_count; f++) {
    const ambulo_foot *foot = &model->feet[f];
    const int corner[4] = {foot->heel[0], foot->heel[1], foot->toe[1], foot->toe[0]};
    int heel = model->points[foot->heel_center].link, sole[4], count = 0;
    for (int i = 0; i < 4; i++) {
      if (corner[i] < 0) continue;
      const ambulo_point *p = &model->points[corner[i]];
      sole[count++] = ambulo__scene_body_point(body, p->link, p->position);
    }
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "name", foot->name);
    ambulo__json_text(json, "side", ambulo__scene_side(body->skeleton.side[heel]));
    json_points(json, "sole", sole, count);
    ambulo__json_integer(json, "ankle", ambulo__scene_body_point(body, heel, origin));
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
}

void ambulo__scene_bones(ambulo__json *json, ambulo__scene_body *body) {
  ambulo__json_open(json, "bones", '[');
  capsules(json, body);
  lines(json, body);
  ambulo__json_close(json, ']');
  feet(json, body);
}

/* -------------------------------------------------------------------- series */

static void three_series(ambulo__json *json, const char *key, const double *place, int step,
                         int samples) {
  ambulo__json_open(json, key, '[');
  for (int i = 0; i < 3; i++)
    ambulo__series(json, NULL, place + i, step, samples, AMBULO__SCENE_LENGTH);
  ambulo__json_close(json, ']');
}

/* of all points and, behind them, the centre of mass: place[samples][count + 1][3] */
static void find_places(ambulo__scene_body *body, double *place) {
  ambulo__pose *pose = &body->skeleton.pose;
  for (int k = 0; k < body->samples; k++) {
    double world[3];
    ambulo__pose_at(pose, body->q + (size_t)k * (size_t)body->model->coordinate_count);
    for (int i = 0; i < body->count; i++, place += 3) {
      ambulo__pose_point(pose, body->points[i].link, body->points[i].at, world);
      ambulo__scene_place(body->model, body->ground, world, place);
    }
    ambulo__pose_center_of_mass(pose, world);
    ambulo__scene_place(body->model, body->ground, world, place);
    place += 3;
  }
}

ambulo_status ambulo__scene_points(ambulo__json *json, ambulo__scene_body *body) {
  int step = 3 * (body->count + 1);
  if (body->failed) return AMBULO_E_MEMORY;
  double *place =
      ambulo__alloc(&body->allocator, (size_t)step * (size_t)body->samples, sizeof *place);
  if (!place) return AMBULO_E_MEMORY;
  find_places(body, place);
  ambulo__json_open(json, "points", '[');
  for (int i = 0; i < body->count; i++)
    three_series(json, NULL, place + 3 * (size_t)i, step, body->samples);
  ambulo__json_close(json, ']');
  three_series(json, "center_of_mass", place + 3 * (size_t)body->count, step, body->samples);
  ambulo__free(&body->allocator, place);
  return AMBULO_OK;
}
