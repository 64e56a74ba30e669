/* show/scene_surroundings.c - what a body stands on, avoids, reaches for, wears and carries
 * (scene.h). */
#include "show/scene.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "contact/contacts.h"
#include "show/gait_surroundings.h"
#include "show/gait_svg.h"

enum { CONTACT_SAMPLES = 2400 }; /* of a stride of 1.2 s: .5 ms */

/* -------------------------------------------------------------------- ground */

static void surface(ambulo__json *json, const ambulo__surface *p) {
  ambulo__json_open(json, NULL, '{');
  ambulo__json_number(json, "from", p->from);
  ambulo__json_number(json, "to", p->to);
  ambulo__json_number(json, "at", p->at);
  ambulo__json_number(json, "height", p->height);
  ambulo__json_number(json, "slope", p->slope);
  ambulo__json_close(json, '}');
}

static ambulo_status ground(ambulo__json *json, const ambulo__stride *s) {
  ambulo__gait_ground soil;
  ambulo_status status = ambulo__gait_ground_create(s->problem, &s->allocator, &soil);
  if (status) return status;
  ambulo__json_open(json, "ground", '{');
  ambulo__json_integer(json, "is_there", s->model->foot_count > 0);
  ambulo__json_number(json, "slope", ambulo__ground_slope(s->model));
  ambulo__json_open(json, "surfaces", '[');
  for (int i = 0; i < soil.count; i++) surface(json, &soil.surface[i]);
  ambulo__json_close(json, ']');
  ambulo__json_close(json, '}');
  ambulo__gait_ground_free(&soil);
  return AMBULO_OK;
}

/* ------------------------------------------------------- obstacles and places */

static void obstacle(ambulo__json *json, const ambulo__stride *s, int i) {
  const ambulo_problem_definition *d = &s->problem->definition;
  ambulo__solid solid = ambulo__solid_of_obstacle(d, i);
  double place[3];
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "name", d->obstacles[i].name);
  if (solid.kind == AMBULO__SOLID_CAPSULE) {
    ambulo__json_text(json, "shape", "capsule");
    for (int e = 0; e < 2; e++) {
      ambulo__scene_place(s->model, d->ground_height, solid.ends[e], place);
      ambulo__scene_json_place(json, e ? "to" : "from", place);
    }
    ambulo__json_number(json, "radius", solid.radius);
  } else {
    ambulo__json_text(json, "shape", "box");
    ambulo__scene_place(s->model, d->ground_height, solid.center, place);
    ambulo__scene_json_place(json, "center", place);
    ambulo__scene_json_place(json, "half_size", solid.half);
    ambulo__json_number(json, "heading", d->obstacles[i].heading);
  }
  ambulo__json_close(json, '}');
}

static void places(ambulo__json *json, const ambulo__stride *s) {
  const ambulo_problem_definition *d = &s->problem->definition;
  ambulo__json_open(json, "places", '[');
  for (int i = 0; i < d->reach_count; i++) {
    const ambulo_reach *reach = &d->reaches[i];
    if (reach->is_relative) continue;
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "point", s->model->points[reach->point].name);
    ambulo__scene_json_place(json, "at", reach->place);
    ambulo__json_number(json, "from", reach->from);
    ambulo__json_number(json, "to", fmin(reach->to, s->duration));
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
}

/* ------------------------------------------------------------------ contacts */

/* the corners of the surface that a patch rests on, as it is shown at time t */
static void rest(ambulo__json *json, const ambulo__stride *s, int patch,
                 const ambulo_contact *contact, double t) {
  ambulo__contact_frame f = ambulo__contact_frame_of(&s->problem->definition, contact);
  const double *half = s->model->patches[patch].size;
  int mirrored = s->mirrored && t > ambulo_problem_duration(s->problem);
  ambulo__json_open(json, "surface", '[');
  for (int corner = 0; corner < 4; corner++) {
    double ahead = corner == 0 || corner == 3 ? half[0] : -half[0], world[3], place[3];
    double aside = corner < 2 ? half[1] : -half[1];
    for (int i = 0; i < 3; i++) world[i] = f.origin[i] + ahead * f.forward[i] + aside * f.left[i];
    if (mirrored) ambulo__stride_mirror_place(s, world);
    ambulo__scene_place(s->model, s->problem->definition.ground_height, world, place);
    ambulo__scene_json_place(json, NULL, place);
  }
  ambulo__json_close(json, ']');
}

static void span(ambulo__json *json, const ambulo__stride *s, int effector,
                 const ambulo_contact *contact, double from, double to) {
  int patch = ambulo__effector_patch(s->model, effector);
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "name", ambulo__effector_name(s->model, effector));
  ambulo__json_text(json, "mode", ambulo__mode_of(contact->mode)->word);
  ambulo__json_number(json, "from", from);
  ambulo__json_number(json, "to", to);
  if (patch >= 0) rest(json, s, patch, contact, 0.5 * (from + to));
  ambulo__json_close(json, '}');
}

static void contacts(ambulo__json *json, const ambulo__stride *s) {
  ambulo__json_open(json, "contacts", '[');
  for (int e = 0; e < ambulo__effector_count(s->model); e++) {
    if (!ambulo__gait_shows(s, e)) continue;
    double from = 0.0;
    const ambulo_contact *held = ambulo__stride_contact(s, e, 0.0);
    for (int k = 1; k <= CONTACT_SAMPLES; k++) {
      double t = s->duration * (double)k / (double)CONTACT_SAMPLES;
      const ambulo_contact *now = ambulo__stride_contact(s, e, t);
      if (now == held && k < CONTACT_SAMPLES) continue;
      if (held) span(json, s, e, held, from, t);
      held = now;
      from = t;
    }
  }
  ambulo__json_close(json, ']');
}

ambulo_status ambulo__scene_surroundings(ambulo__json *json, const ambulo__stride *s) {
  ambulo_status status = ground(json, s);
  if (status) return status;
  ambulo__json_open(json, "obstacles", '[');
  for (int i = 0; i < s->problem->definition.obstacle_count; i++) obstacle(json, s, i);
  ambulo__json_close(json, ']');
  places(json, s);
  contacts(json, s);
  return AMBULO_OK;
}

/* ---------------------------------------------------------------------- worn */

static void device(ambulo__json *json, const ambulo__stride *s, int i) {
  const ambulo_device *d = &s->problem->definition.devices[i];
  double unit = d->coordinate < 0 ? AMBULO__SCENE_FORCE : AMBULO__SCENE_TORQUE;
  ambulo__json_text(json, "name", d->name);
  ambulo__json_text(json, "unit", d->coordinate < 0 ? "N" : "N m");
  ambulo__series(json, "effort", s->effort + i, s->devices, s->samples, unit);
}

/* "held": bodies between hands, drawn while they are held */
static void held(ambulo__json *json, const ambulo__stride *s, ambulo__scene_body *body) {
  const ambulo_problem_definition *d = &s->problem->definition;
  ambulo__json_open(json, "held", '[');
  for (int i = 0; i < d->hold_count; i++) {
    const ambulo_hold *hold = &d->holds[i];
    const ambulo_point *hand = &s->model->points[hold->hand[0]];
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "name", hold->name);
    ambulo__json_integer(json, "one", ambulo__scene_body_point(body, hand->link, hand->position));
    if (hold->hand[1] >= 0) hand = &s->model->points[hold->hand[1]];
    ambulo__json_integer(json, "other", ambulo__scene_body_point(body, hand->link, hand->position));
    ambulo__scene_json_place(json, "center", hold->center);
    ambulo__scene_json_place(json, "size", hold->size);
    ambulo__json_number(json, "from", fmax(hold->from, 0.0));
    ambulo__json_number(json, "to", fmin(hold->to, s->duration));
    ambulo__json_number(json, "mass", hold->mass);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
}

static void worn_point(ambulo__json *json, const char *key, const ambulo__worn *mark, int point,
                       ambulo__scene_body *body) {
  ambulo__json_integer(json, key,
                       ambulo__scene_body_point(body, mark->link[point], mark->at[point]));
}

static void load(ambulo__json *json, const ambulo__stride *s, int i, const ambulo__worn *mark,
                 ambulo__scene_body *body) {
  int link = mark->link[0];
  double size[3];
  for (int k = 0; k < 3; k++) size[k] = 2.0 * mark->half[k];
  worn_point(json, "ahead", mark, 1, body);
  worn_point(json, "above", mark, 2, body);
  ambulo__scene_json_place(json, "size", size);
  ambulo__json_text(json, "side",
                    ambulo__scene_side(link < 0 ? AMBULO__MIDDLE : body->skeleton.side[link]));
  ambulo__json_number(json, "mass", s->model->loads[i].mass);
}

ambulo_status ambulo__scene_worn(ambulo__json *json, const ambulo__stride *s,
                                 ambulo__scene_body *body) {
  ambulo__worn_list list;
  ambulo_status status = ambulo__worn_create(s, &body->allocator, &list);
  if (status) return status;
  held(json, s, body);
  ambulo__json_open(json, "worn", '[');
  for (int i = 0; i < list.count; i++) {
    const ambulo__worn *mark = &list.mark[i];
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "kind", i < s->devices ? "device" : "load");
    worn_point(json, "from", mark, 0, body);
    if (i < s->devices) worn_point(json, "to", mark, 1, body);
    if (mark->kind == AMBULO__WORN_BRACE) worn_point(json, "hinge", mark, 2, body);
    if (i < s->devices)
      device(json, s, i);
    else
      load(json, s, i - s->devices, mark, body);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__worn_free(&list);
  return AMBULO_OK;
}
