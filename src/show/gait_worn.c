/* show/gait_worn.c - what a body wears and carries (gait_surroundings.h).
 *
 * A load of m kg is a box half as dense as water, 0.7 : 1 : 1.4 along forward, left and up in the
 * rest pose: a backpack of 16 kg is 0.22 m deep and 0.44 m high.
 *
 *     s = (m / 500 kg/m^3)^(1/3)
 *
 * A device at a joint has cuffs on the two bodies that weigh beside it, toward their centres of
 * mass.
 */
#include "base/arithmetic.h"
#include "contact/devices.h"
#include "show/gait_surroundings.h"
#include "show/svg.h"

#include <math.h>
#include <string.h>

static const double density = 500.0, least = 0.02; /* kg/m^3; of the largest effort */
static const double shape[3] = {0.7, 1.0, 1.4};
static const double cuff_distance = 0.16, hinge_radius = 0.035; /* m */
static const double cuff = 6.0;                                 /* px to either side */

void ambulo__load_half_size(double mass, double half[3]) {
  for (int k = 0; k < 3; k++) half[k] = 0.5 * shape[k] * cbrt(mass / density);
}

int ambulo__worn_acts(const ambulo__stride *stride, int sample, int i) {
  if (i >= stride->devices) return 1;
  double most = 0.0;
  for (int k = 0; k < stride->samples; k++)
    most = fmax(most, fabs(stride->effort[(size_t)k * (size_t)stride->devices + (size_t)i]));
  size_t at = (size_t)sample * (size_t)stride->devices + (size_t)i;
  return most > 0.0 && fabs(stride->effort[at]) >= least * most;
}

/* ------------------------------------------------------------------- marks */

/* R^T (world - o), of a link's frame */
static void into_link(const ambulo__pose *rest, int link, const double world[3], double at[3]) {
  memcpy(at, world, 3 * sizeof *at);
  if (link < 0) return;
  const double *f = rest->frames + 12 * (size_t)link;
  for (int c = 0; c < 3; c++) {
    at[c] = 0.0;
    for (int r = 0; r < 3; r++) at[c] += f[4 * r + c] * (world[r] - f[4 * r + 3]);
  }
}

static int body_before(const ambulo_model *model, int link) {
  while (link >= 0 && !(model->links[link].mass > 0.0)) link = model->links[link].parent;
  return link;
}

static int body_after(const ambulo_model *model, int first) {
  for (int i = first; i < model->link_count; i++) {
    int above = i;
    while (above > first) above = model->links[above].parent;
    if (above == first && model->links[i].mass > 0.0) return i;
  }
  return first;
}

/* from the joint toward the centre of mass of the body, not beyond it */
static void place_cuff(const ambulo__pose *rest, const double joint[3], int link, double at[3]) {
  double center[3], length = 0.0;
  memcpy(center, joint, sizeof center);
  if (link >= 0) ambulo__pose_point(rest, link, rest->model->links[link].com, center);
  for (int k = 0; k < 3; k++) length += (center[k] - joint[k]) * (center[k] - joint[k]);
  double share = fmin(1.0, cuff_distance / fmax(sqrt(length), 1e-9));
  for (int k = 0; k < 3; k++) center[k] = joint[k] + share * (center[k] - joint[k]);
  into_link(rest, link, center, at);
}

/* the joint of a coordinate is at the origin of the link before it */
static void mark_device(const ambulo__pose *rest, const ambulo_device *device, ambulo__worn *mark) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  const ambulo_model *model = rest->model;
  if (device->coordinate < 0) {
    *mark = (ambulo__worn){.kind = AMBULO__WORN_CABLE};
    memcpy(mark->link, device->link, sizeof device->link);
    memcpy(mark->at, device->position, sizeof device->position);
    return;
  }
  int moves = model->coordinate_link[device->coordinate], before = model->links[moves].parent;
  double joint[3];
  ambulo__pose_point(rest, before, origin, joint);
  *mark = (ambulo__worn){.kind = AMBULO__WORN_BRACE,
                         .link = {body_before(model, before), body_after(model, moves), before}};
  for (int end = 0; end < 2; end++) place_cuff(rest, joint, mark->link[end], mark->at[end]);
}

static void mark_load(const ambulo__pose *rest, const ambulo__model_load *load,
                      ambulo__worn *mark) {
  const ambulo_model *model = rest->model;
  const double *ways[3] = {NULL, model->forward, model->up};
  *mark = (ambulo__worn){.kind = AMBULO__WORN_LOAD, .link = {load->link, load->link, load->link}};
  ambulo__load_half_size(load->mass, mark->half);
  memcpy(mark->at[0], load->position, sizeof load->position);
  for (int p = 1; p < 3; p++) {
    double world[3];
    ambulo__pose_point(rest, load->link, load->position, world);
    for (int k = 0; k < 3; k++) world[k] += mark->half[p == 1 ? 0 : 2] * ways[p][k];
    into_link(rest, load->link, world, mark->at[p]);
  }
}

ambulo_status ambulo__worn_create(const ambulo__stride *stride, const ambulo_allocator *allocator,
                                  ambulo__worn_list *list) {
  const ambulo_model *model = stride->model;
  ambulo__worn_list l = {.allocator = ambulo__allocator_or_default(allocator)};
  *list = l;
  int count = stride->devices + model->load_count;
  if (count == 0) return AMBULO_OK;
  ambulo__pose rest = {.model = NULL};
  ambulo_status status = ambulo__pose_create(model, allocator, &rest);
  double *q = ambulo__alloc(&l.allocator, (size_t)model->coordinate_count, sizeof *q);
  l.mark = ambulo__alloc(&l.allocator, (size_t)count, sizeof *l.mark);
  if (!q || !l.mark) status = AMBULO_E_MEMORY;
  if (!status) {
    for (int c = 0; c < model->coordinate_count; c++) q[c] = 0.0;
    ambulo__pose_at(&rest, q);
    for (; l.count < stride->devices; l.count++)
      mark_device(&rest, &stride->problem->definition.devices[l.count], &l.mark[l.count]);
    for (; l.count < count; l.count++)
      mark_load(&rest, &model->loads[l.count - stride->devices], &l.mark[l.count]);
    *list = l;
  } else {
    ambulo__free(&l.allocator, l.mark);
  }
  ambulo__free(&l.allocator, q);
  ambulo__pose_free(&rest);
  return status;
}

void ambulo__worn_free(ambulo__worn_list *list) {
  ambulo__free(&list->allocator, list->mark);
  *list = (ambulo__worn_list){.count = 0};
}

/* -------------------------------------------------------------- from the side */

typedef struct side_view {
  const ambulo_model *model;
  const ambulo__pose *pose;
  const ambulo__figure_view *view;
  double ground;
} side_view;

/* 0: the motion is not finite there */
static int on_page(const side_view *s, int link, const double at[3], double page[2]) {
  const ambulo__figure_view *v = s->view;
  double world[3];
  ambulo__pose_point(s->pose, link, at, world);
  page[0] = v->x + v->scale * (ambulo__dot(s->model->forward, world) - v->origin);
  page[1] = v->base - v->scale * (ambulo__dot(s->model->up, world) - s->ground);
  return isfinite(page[0] + page[1]);
}

/* the middle plane of the box, through its front and its top */
static void draw_load(const side_view *s, const ambulo__worn *mark, ambulo__text_buffer *text) {
  static const double corners[4][2] = {{1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}, {-1.0, 1.0}};
  double page[4][2];
  for (int c = 0; c < 4; c++) {
    double at[3];
    for (int k = 0; k < 3; k++)
      at[k] = mark->at[0][k] + corners[c][0] * (mark->at[1][k] - mark->at[0][k]) +
              corners[c][1] * (mark->at[2][k] - mark->at[0][k]);
    if (!on_page(s, mark->link[0], at, page[c])) return;
  }
  ambulo__svg_path_begin(text, "load");
  ambulo__svg_path_move(text, page[0][0], page[0][1]);
  for (int c = 1; c <= 4; c++) ambulo__svg_path_line(text, page[c % 4][0], page[c % 4][1]);
  ambulo__svg_path_end(text);
}

static void draw_cuff(const double end[2], const double hinge[2], const char *style,
                      ambulo__text_buffer *text) {
  double along[2] = {hinge[0] - end[0], hinge[1] - end[1]}, length = hypot(along[0], along[1]);
  if (!(length > 1e-6)) return;
  double x = cuff * along[1] / length, y = cuff * along[0] / length;
  ambulo__svg_line(text, style, end[0] - x, end[1] + y, end[0] + x, end[1] - y);
}

static void draw_hinge(const double at[2], ambulo_device_kind kind, double radius, int acts,
                       ambulo__text_buffer *text) {
  const char *style = acts ? "device" : "device idle";
  if (kind == AMBULO_DEVICE_DAMPER)
    ambulo__svg_rectangle(text, style, at[0] - radius, at[1] - radius, 2.0 * radius, 2.0 * radius);
  else if (kind == AMBULO_DEVICE_ACTUATOR)
    ambulo__svg_circle(text, acts ? "motor" : "motor idle", at[0], at[1], radius);
  else
    ambulo__svg_circle(text, style, at[0], at[1], radius);
}

static void draw_device(const side_view *s, const ambulo__worn *mark, ambulo_device_kind kind,
                        int acts, int ahead, ambulo__text_buffer *text) {
  const char *style = acts ? "device" : "device idle";
  int is_brace = mark->kind == AMBULO__WORN_BRACE;
  double page[3][2];
  for (int p = 0; p < (is_brace ? 3 : 2); p++)
    if (!on_page(s, mark->link[p], mark->at[p], page[p])) return;
  if (ahead && is_brace) {
    for (int end = 0; end < 2; end++) draw_cuff(page[end], page[2], style, text);
    draw_hinge(page[2], kind, s->view->scale * hinge_radius, acts, text);
  } else if (ahead) {
    ambulo__svg_line(text, style, page[0][0], page[0][1], page[1][0], page[1][1]);
  } else if (is_brace) {
    ambulo__svg_path_begin(text, acts ? "brace" : "brace idle");
    ambulo__svg_path_move(text, page[0][0], page[0][1]);
    ambulo__svg_path_line(text, page[2][0], page[2][1]);
    ambulo__svg_path_line(text, page[1][0], page[1][1]);
    ambulo__svg_path_end(text);
  }
}

void ambulo__gait_worn_draw(const ambulo__stride *stride, const ambulo__worn_list *list, int sample,
                            int ahead, const ambulo__pose *pose, const ambulo__figure_view *view,
                            ambulo__text_buffer *text) {
  const ambulo_problem_definition *d = &stride->problem->definition;
  const side_view s = {stride->model, pose, view, d->ground_height};
  for (int i = 0; i < list->count; i++) {
    if (i < stride->devices)
      draw_device(&s, &list->mark[i], d->devices[i].kind, ambulo__worn_acts(stride, sample, i),
                  ahead, text);
    else if (!ahead)
      draw_load(&s, &list->mark[i], text);
  }
}
