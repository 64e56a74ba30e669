/* show/gait_strip.c - figures of a motion side by side.
 *
 * Figure k at time t_k is drawn at
 *
 *     X = x(t_k) + s (f . r - f . r_ref(0) - v t_k),    Y = ground - s (n . r - h)
 *
 * with s the scale (px per metre), r_ref a point that moves with the whole body, v its mean
 * speed along f: the true place, with the walking direction stretched by the constant factor
 * that spreads the figures over the time axis. Where the ground is not level each figure stands on
 * the piece of it that is below it, and among the pieces of obstacles beside it.
 *
 * On a slope alpha the world's axes stay with the ground, and gravity is turned. The picture turns
 * each figure back by alpha about the place where it stands, and lets these places rise: the ground
 * is one line of the true slope, and down the page is down.
 */
#include <math.h>
#include <string.h>

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "show/gait_surroundings.h"
#include "show/gait_svg.h"
#include "show/skeleton.h"
#include "show/svg.h"

enum { MOST_FIGURES = 15, FEWEST_FIGURES = 9, FEWEST_SCENES = 7, EXTENT_SAMPLES = 61 };

static const double degrees = 57.295779513082321;
static const double head_room = 14.0;                  /* px above the figures */
static const double soil_depth = 15.0, slot_gap = 3.0; /* px */
static const double before = 70.0, after = 80.0;       /* px: ground beside the panel */
static const double steepest = 1.0;                    /* rad: beyond, it is drawn level */
static const double around = 0.3; /* m: ground before and behind a figure that is always shown */
static const double side_room =
    78.0; /* px beside the first and the last figure, within the margins */
static const double figure_room = 108.0; /* of a foot that reaches into them */
static const double most_stretch = 5.0;  /* beyond, figures are just one beside the other */

typedef struct strip {
  const ambulo__panel *panel;
  const ambulo_model *model;
  ambulo__skeleton skeleton;
  ambulo__gait_ground soil;
  ambulo__held_places held;
  ambulo__worn_list worn;
  int reference;       /* link whose parent's origin moves with the body */
  double speed, start; /* of the reference along forward, m/s, m */
  double ground;       /* m */
  double left, right;  /* extent of the figures about the reference line, m */
  double reach;        /* how far to either side of one that stands things are drawn, m */
  double low, high;    /* above the ground, m */
  double scale;        /* px per m */
  double slope;        /* of the ground as it is drawn, rad */
  double base;         /* y of the ground at t = 0, px */
  int figures;
} strip;

static double reference_place(const strip *s) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  double world[3];
  int link = s->reference >= 0 ? s->model->links[s->reference].parent : -1;
  ambulo__pose_point(&s->skeleton.pose, link, origin, world);
  return ambulo__dot(s->model->forward, world);
}

/* (forward of the moving reference line, height) of a bone's end, m */
static void flat_point(const strip *s, const ambulo__bone *bone, int end, double t, double at[2]) {
  double world[3];
  ambulo__pose_point(&s->skeleton.pose, bone->link[end], bone->at[end], world);
  at[0] = ambulo__dot(s->model->forward, world) - s->start - s->speed * t;
  at[1] = ambulo__dot(s->model->up, world) - s->ground;
}

static void find_reference(strip *s, const ambulo__stride *stride) {
  s->reference = -1;
  for (int i = 0; i < s->model->link_count && s->reference < 0; i++) {
    if (s->model->links[i].mass > 0.0) s->reference = i;
  }
  size_t last = (size_t)(stride->samples - 1) * (size_t)stride->coordinates;
  ambulo__pose_at(&s->skeleton.pose, stride->q);
  s->start = reference_place(s);
  ambulo__pose_at(&s->skeleton.pose, stride->q + last);
  double end = reference_place(s);
  s->speed = (end - s->start) / stride->duration;
  if (!isfinite(s->speed) || !isfinite(s->start)) s->speed = s->start = 0.0;
}

static void widen(strip *s, const double at[2], double radius) {
  if (!isfinite(at[0]) || !isfinite(at[1])) return;
  s->left = fmin(s->left, at[0] - radius);
  s->right = fmax(s->right, at[0] + radius);
  s->low = fmin(s->low, at[1] - radius);
  s->high = fmax(s->high, at[1] + radius);
}

/* the ground from `left` to `right` of the reference line at time t */
static double lowest_ground(const strip *s, double t, double left, double right) {
  double origin = s->start + s->speed * t, lowest = INFINITY;
  for (int i = 0; i < s->soil.count; i++) {
    const ambulo__surface *p = &s->soil.surface[i];
    double from = fmax(p->from, origin + left), to = fmin(p->to, origin + right);
    if (from > to) continue;
    lowest = fmin(lowest, fmin(ambulo__surface_height(p, from), ambulo__surface_height(p, to)));
  }
  return lowest;
}

static void find_extent(strip *s, const ambulo__stride *stride) {
  s->left = s->right = 0.0;
  s->low = s->high = 0.0;
  for (int k = 0; k < stride->samples; k++) {
    ambulo__pose_at(&s->skeleton.pose, stride->q + (size_t)k * (size_t)stride->coordinates);
    s->low = fmin(s->low, lowest_ground(s, stride->times[k], -around, around));
    for (int b = 0; b < s->skeleton.bone_count; b++) {
      const ambulo__bone *bone = &s->skeleton.bones[b];
      for (int end = 0; end < 2; end++) {
        double at[2], c = cos(s->slope), n = sin(s->slope);
        flat_point(s, bone, end, stride->times[k], at);
        const double turned[2] = {c * at[0] - n * at[1], n * at[0] + c * at[1]};
        widen(s, turned, end ? bone->head : 0.0);
      }
    }
  }
  if (s->slope != 0.0) s->low = 0.0; /* there is room where the ground falls */
}

/* 0 where there is none, and where it is too steep to be drawn */
static double drawn_slope(const ambulo_model *model) {
  double slope = model->foot_count ? ambulo__ground_slope(model) : 0.0;
  return fabs(slope) > 1e-3 && fabs(slope) < steepest ? slope : 0.0;
}

/* px that the ground rises along the page */
static double whole_rise(double slope, const ambulo__panel *panel) {
  return fabs(tan(slope)) * (panel->width + before + after);
}

/* figures that walk, and not only stand beside their own later ones */
static int walks(const strip *s) {
  return s->scale * fabs(s->speed) * s->panel->duration > s->panel->width / most_stretch;
}

/* as many figures as stand apart, as large as fits */
static void choose_scale(strip *s, double overlap, double room, int fewest) {
  double height = fmax(s->high - s->low, 0.1), width = fmax(s->right - s->left, 0.05);
  s->scale = (s->panel->height - head_room - whole_rise(s->slope, s->panel)) / height;
  /* the first and the last figure stay on the page */
  if (s->right * s->scale > room) s->scale = room / s->right;
  if (-s->left * s->scale > room) s->scale = room / -s->left;
  double spacing = overlap * width * s->scale;
  s->figures = (int)(s->panel->width / spacing) + 1;
  if (s->figures > MOST_FIGURES) s->figures = MOST_FIGURES;
  if (s->figures < fewest) {
    s->figures = fewest;
    s->scale *= s->panel->width / (double)(fewest - 1) / spacing;
  }
  s->base = s->panel->y + s->panel->height + s->scale * s->low -
            fabs(tan(s->slope)) * (s->slope > 0.0 ? before : s->panel->width + after);
}

/* y of the ground, px */
static double base_at(const strip *s, double x) {
  return s->base - tan(s->slope) * (x - s->panel->x);
}

static void to_page(const strip *s, double t, const double at[2], double page[2]) {
  double x = ambulo__panel_time(s->panel, t);
  page[0] = x + s->scale * at[0];
  page[1] = base_at(s, x) - s->scale * at[1];
}

/* a place of a link (-1: of the world) in the picture; 0: the motion is not finite there */
static int on_page(const strip *s, int link, const double place[3], double t, double page[2]) {
  ambulo__bone bone = {.link = {-1, link}};
  double at[2];
  memcpy(bone.at[1], place, sizeof bone.at[1]);
  flat_point(s, &bone, 1, t, at);
  to_page(s, t, at, page);
  return isfinite(page[0] + page[1]);
}

static void draw_side(const strip *s, double t, ambulo__side side, const char *style,
                      ambulo__text_buffer *text) {
  int begun = 0;
  for (int b = 0; b < s->skeleton.bone_count; b++) {
    const ambulo__bone *bone = &s->skeleton.bones[b];
    if (bone->side != side) continue;
    double from[2], to[2];
    int seen = on_page(s, bone->link[0], bone->at[0], t, from);
    if (!on_page(s, bone->link[1], bone->at[1], t, to) || !seen) continue;
    if (!begun) ambulo__svg_path_begin(text, style);
    begun = 1;
    ambulo__svg_path_move(text, from[0], from[1]);
    ambulo__svg_path_line(text, to[0], to[1]);
  }
  if (begun) ambulo__svg_path_end(text);
}

static void draw_head(const strip *s, double t, ambulo__text_buffer *text) {
  for (int b = 0; b < s->skeleton.bone_count; b++) {
    const ambulo__bone *bone = &s->skeleton.bones[b];
    double center[2];
    if (bone->head > 0.0 && on_page(s, bone->link[1], bone->at[1], t, center))
      ambulo__svg_circle(text, "head", center[0], center[1], s->scale * bone->head);
  }
}

/* what hangs on the world, hangs there: the origin of the first link that moves */
static void draw_pivot(const strip *s, double t, ambulo__text_buffer *text) {
  int link = s->reference >= 0 ? s->model->links[s->reference].parent : -1;
  static const double origin[3] = {0.0, 0.0, 0.0};
  double page[2];
  if (on_page(s, link, origin, t, page)) ambulo__svg_circle(text, "head", page[0], page[1], 4.0);
}

/* a mark under the part of the foot that is on its foothold */
static void draw_contacts(const strip *s, const ambulo__stride *stride, double t,
                          ambulo__text_buffer *text) {
  static const char *const styles[] = {"trunk-mark", "left-mark", "right-mark"};
  for (int f = 0; f < s->model->foot_count; f++) {
    const ambulo_foot *foot = &s->model->feet[f];
    const ambulo_contact *contact = ambulo__stride_contact(stride, f, t);
    if (!contact) continue;
    ambulo_contact_mode mode = contact->mode;
    const ambulo_point *heel = &s->model->points[foot->heel_center];
    const ambulo_point *toe = &s->model->points[foot->toe_center];
    const ambulo_point *ends[2] = {ambulo__mode_is_on_toes(mode) ? toe : heel,
                                   ambulo__mode_is_on_heel(mode) ? heel : toe};
    double page[2][2];
    int seen = on_page(s, ends[0]->link, ends[0]->position, t, page[0]);
    if (!on_page(s, ends[1]->link, ends[1]->position, t, page[1]) || !seen) continue;
    double below = 5.5 + (s->skeleton.side[heel->link] == AMBULO__RIGHT ? 5.0 : 0.0);
    double y[2];
    double level = base_at(s, ambulo__panel_time(s->panel, t));
    for (int e = 0; e < 2; e++) y[e] = below + (s->soil.count ? page[e][1] : level);
    /* a zero-length line with round ends would not be drawn everywhere */
    ambulo__svg_line(text, styles[s->skeleton.side[heel->link]], page[0][0] - 0.5, y[0],
                     page[1][0] + 0.5, y[1]);
  }
}

/* what is beside a figure is drawn as far as halfway to the next, or in its reach */
static ambulo__figure_view view_of(const strip *s, const ambulo__stride *stride, double t) {
  double half = 0.5 * s->panel->width / (double)(s->figures - 1) / s->scale;
  if (!walks(s)) half = s->reach;
  double apart = stride->duration / (double)(stride->samples - 1);
  double x = ambulo__panel_time(s->panel, t);
  return (ambulo__figure_view){s->start + s->speed * t, half, x, base_at(s, x), s->scale, t, apart};
}

static void draw_ground_below(const strip *s, const ambulo__stride *stride, double t,
                              ambulo__text_buffer *text) {
  double half = 0.5 * s->panel->width / (double)(s->figures - 1) - slot_gap;
  double bottom = s->panel->y + s->panel->height + soil_depth;
  ambulo__figure_view view = view_of(s, stride, t);
  ambulo__gait_ground_draw(&s->soil, &view, half, bottom, text);
}

/* level or sloping, but straight */
static void draw_straight_ground(const strip *s, ambulo__text_buffer *text) {
  double x[2] = {s->panel->x - before, s->panel->x + s->panel->width + after};
  double y[2] = {base_at(s, x[0]), base_at(s, x[1])};
  if (s->slope == 0.0) {
    ambulo__svg_rectangle(text, "soil", x[0], y[0], x[1] - x[0], soil_depth);
  } else {
    ambulo__svg_path_begin(text, "soil");
    ambulo__svg_path_move(text, x[0], y[0]);
    ambulo__svg_path_line(text, x[1], y[1]);
    ambulo__svg_path_line(text, x[1], y[1] + soil_depth);
    ambulo__svg_path_line(text, x[0], y[0] + soil_depth);
    ambulo__svg_path_end(text);
  }
  ambulo__svg_line(text, "ground", x[0], y[0], x[1], y[1]);
}

static void draw_figure(strip *s, const ambulo__stride *stride, int k, ambulo__text_buffer *text) {
  double t = stride->times[k];
  const ambulo__pose *pose = &s->skeleton.pose;
  ambulo__figure_view view = view_of(s, stride, t);
  int is_there = isfinite(view.origin);
  if (is_there) ambulo__gait_obstacles_draw(stride->problem, &view, text);
  if (is_there) ambulo__gait_held_draw(stride->problem, &s->held, pose, &view, text);
  ambulo__svg_group_begin(text, "figure");
  ambulo__gait_worn_draw(stride, &s->worn, k, 0, pose, &view, text);
  draw_side(s, t, AMBULO__LEFT, "left", text);
  draw_side(s, t, AMBULO__MIDDLE, "trunk", text);
  draw_head(s, t, text);
  draw_side(s, t, AMBULO__RIGHT, "right", text);
  draw_contacts(s, stride, t, text);
  if (is_there) ambulo__gait_patches_draw(stride, pose, &view, text);
  ambulo__gait_worn_draw(stride, &s->worn, k, 1, pose, &view, text);
  if (!s->model->foot_count) draw_pivot(s, t, text);
  ambulo__svg_group_end(text);
}

/* what stands at time t, turned about where it stands */
static void begin_turned(const strip *s, double t, ambulo__text_buffer *text) {
  double x = ambulo__panel_time(s->panel, t);
  if (s->slope != 0.0)
    ambulo__svg_group_turned(text, "turned", degrees * s->slope, x, base_at(s, x));
}

static void draw_figures(strip *s, const ambulo__stride *stride, ambulo__text_buffer *text) {
  if (s->model->foot_count && !s->soil.count) draw_straight_ground(s, text);
  for (int pass = s->soil.count ? 0 : 1; pass < 2; pass++) {
    for (int k = 0; k < stride->samples; k++) {
      double t = stride->times[k];
      ambulo__pose_at(&s->skeleton.pose, stride->q + (size_t)k * (size_t)stride->coordinates);
      begin_turned(s, t, text);
      if (pass)
        draw_figure(s, stride, k, text);
      else
        draw_ground_below(s, stride, t, text);
      if (s->slope != 0.0) ambulo__svg_group_end(text);
    }
  }
}

/* how far the drawing departs from the truth */
static void caption(const strip *s, ambulo__text_buffer *text) {
  double true_width = s->scale * fabs(s->speed) * s->panel->duration;
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, text);
  if (walks(s)) {
    ambulo__text_append(&label, "side view, walking direction stretched ");
    ambulo__label_number(&label, s->panel->width / true_width, 1);
    ambulo__text_append(&label, "\xc3\x97");
  } else {
    ambulo__text_append(&label, "side view, one figure beside the other in time");
  }
  double slope = degrees * ambulo__ground_slope(s->model);
  if (s->model->foot_count && fabs(slope) > 0.05) {
    ambulo__text_append(&label, slope > 0.0 ? ", uphill " : ", downhill ");
    ambulo__label_number(&label, fabs(slope), 1);
    ambulo__text_append(&label, s->slope != 0.0 ? "\xc2\xb0" : "\xc2\xb0 (drawn level)");
  }
  ambulo__svg_label(text, "end", s->panel->x + s->panel->width + 80.0, s->panel->y - 23.0,
                    ambulo__text_data(&label));
  ambulo__text_free(&label);
}

static ambulo_status measure(const ambulo_problem *problem, const double *x,
                             const ambulo__panel *panel, const ambulo_allocator *allocator,
                             strip *s) {
  ambulo__stride dense = {.samples = 0};
  s->panel = panel;
  s->model = ambulo_problem_model(problem);
  s->ground = problem->definition.ground_height;
  s->slope = drawn_slope(s->model);
  ambulo_status status = ambulo__skeleton_create(s->model, allocator, &s->skeleton);
  if (!status) status = ambulo__gait_ground_create(problem, allocator, &s->soil);
  if (!status) status = ambulo__stride_create(problem, x, EXTENT_SAMPLES, allocator, &dense);
  if (status) return status;
  find_reference(s, &dense);
  find_extent(s, &dense);
  s->reach = fmax(-s->left, s->right) + around;
  /* part of a figure's width that its neighbour leaves it: legs may cross, an arm stands free */
  double overlap = s->soil.count ? 1.0 : s->model->foot_count ? 0.56 : 1.08;
  choose_scale(s, overlap, s->model->foot_count ? figure_room : side_room, FEWEST_FIGURES);
  if (!walks(s) && ambulo__obstacles_widen(problem, s->start, s->reach, &s->left, &s->right))
    choose_scale(s, 1.0, side_room,
                 FEWEST_SCENES); /* what stands beside a figure is beside no other */
  ambulo__stride_free(&dense);
  return AMBULO_OK;
}

ambulo_status ambulo__gait_strip_height(const ambulo_problem *problem, const double *x,
                                        const ambulo_allocator *allocator, ambulo__panel *panel) {
  strip s = {.panel = NULL};
  double rise = whole_rise(drawn_slope(ambulo_problem_model(problem)), panel);
  panel->height += rise;
  ambulo_status status = measure(problem, x, panel, allocator, &s);
  if (!status) panel->height = s.scale * fmax(s.high - s.low, 0.1) + head_room + rise;
  ambulo__gait_ground_free(&s.soil);
  ambulo__skeleton_free(&s.skeleton);
  return status;
}

ambulo_status ambulo__gait_strip(const ambulo_problem *problem, const double *x,
                                 const ambulo__panel *panel, ambulo__text_buffer *text) {
  strip s = {.panel = NULL};
  ambulo__stride shown = {.samples = 0};
  ambulo_status status = measure(problem, x, panel, &text->allocator, &s);
  if (!status) status = ambulo__held_places_create(problem, x, &text->allocator, &s.held);
  if (!status) status = ambulo__stride_create(problem, x, s.figures, &text->allocator, &shown);
  if (!status) status = ambulo__worn_create(&shown, &text->allocator, &s.worn);
  if (!status) {
    draw_figures(&s, &shown, text);
    caption(&s, text);
  }
  ambulo__worn_free(&s.worn);
  ambulo__stride_free(&shown);
  ambulo__free(&text->allocator, s.held.place);
  ambulo__gait_ground_free(&s.soil);
  ambulo__skeleton_free(&s.skeleton);
  return status;
}
