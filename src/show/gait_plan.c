/* show/gait_plan.c - a motion that turns, seen from above.
 *
 * Forward is to the right, left is up the page, both to one scale: footprints where the contacts
 * are, along their headings, and the way of the pelvis with bars across it, from hip to hip.
 */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "show/gait_svg.h"
#include "show/skeleton.h"
#include "show/svg.h"

#include <math.h>

enum { BARS = 12, PRINT = 12 };

static const double turns_by = 0.02;    /* rad, from one foothold of a foot to the next */
static const double edge = 0.12;        /* m around what is drawn */
static const double hips = 0.14;        /* m, half a bar */
static const double planar_half = 0.04; /* m, half the width of a foot without one */
static const double largest = 260.0, most_height = 280.0; /* px per m; px */
static const double heading_room = 26.0;                  /* px */

/* of a sole from the heel centre, by its length and half its width */
static const double outline[PRINT][2] = {{-0.14, 0.0}, {-0.1, 0.5},   {0.1, 0.66},  {0.45, 0.62},
                                         {0.7, 1.0},   {0.95, 0.6},   {1.0, 0.0},   {0.95, -0.6},
                                         {0.7, -1.0},  {0.45, -0.62}, {0.1, -0.66}, {-0.1, -0.5}};

typedef struct plan {
  const ambulo__stride *stride;
  const ambulo__panel *panel;
  ambulo__skeleton skeleton;    /* its pose: the last one */
  double to_left[3];            /* of the world */
  int root;                     /* the first body that weighs */
  double across[3];             /* to its left at q = 0, in its frame */
  double from, to, right, left; /* what there is along forward and to the left, m */
  double scale;                 /* px per m */
} plan;

int ambulo__gait_turns(const ambulo_problem *problem) {
  const ambulo_problem_definition *d = &problem->definition;
  for (int i = 0; i < d->contact_count; i++)
    for (int k = 0; k < i; k++)
      if (d->contacts[i].foot >= 0 && d->contacts[i].foot == d->contacts[k].foot &&
          fabs(d->contacts[i].heading - d->contacts[k].heading) > turns_by)
        return 1;
  return 0;
}

/* ------------------------------------------------------------------- places */

static void print_corner(const plan *p, const ambulo_contact *c, int corner, double at[2]) {
  const ambulo_model *m = p->stride->model;
  ambulo__foot_outline o = ambulo__foot_outline_of(m, c->foot);
  double half = 0.0;
  for (int i = 0; i < o.count; i++) half = fmax(half, fabs(o.place[i][1]));
  if (!(half > 0.0)) half = planar_half;
  double ahead = ambulo__foot_reach(m, c->foot) * outline[corner][0];
  double beside = half * outline[corner][1];
  at[0] = c->place[0] + cos(c->heading) * ahead - sin(c->heading) * beside;
  at[1] = c->place[1] + sin(c->heading) * ahead + cos(c->heading) * beside;
}

/* one print for all contacts on a foothold */
static int is_first_there(const ambulo_problem_definition *d, int i) {
  const ambulo_contact *c = &d->contacts[i];
  if (c->foot < 0) return 0;
  for (int k = 0; k < i; k++) {
    const ambulo_contact *o = &d->contacts[k];
    if (o->foot == c->foot && o->place[0] == c->place[0] && o->place[1] == c->place[1]) return 0;
  }
  return 1;
}

/* `aside` m to the left of the middle of the root's body at a sample */
static void root_place(plan *p, int sample, double aside, double at[2]) {
  const ambulo__stride *s = p->stride;
  double local[3], world[3];
  for (int k = 0; k < 3; k++) local[k] = aside * p->across[k];
  ambulo__pose_at(&p->skeleton.pose, s->q + (size_t)sample * (size_t)s->coordinates);
  ambulo__pose_point(&p->skeleton.pose, p->root, local, world);
  at[0] = ambulo__dot(s->model->forward, world);
  at[1] = ambulo__dot(p->to_left, world);
}

static void find_root(plan *p, double *q) {
  const ambulo_model *m = p->stride->model;
  ambulo__cross(m->up, m->forward, p->to_left);
  while (p->root + 1 < m->link_count && !(m->links[p->root].mass > 0.0)) p->root++;
  for (int c = 0; c < m->coordinate_count; c++) q[c] = 0.0;
  ambulo__pose_at(&p->skeleton.pose, q);
  const double *f = p->skeleton.pose.frames + 12 * (size_t)p->root;
  for (int c = 0; c < 3; c++)
    for (int r = 0; r < 3; r++) p->across[c] += f[4 * r + c] * p->to_left[r];
}

static void widen(plan *p, const double at[2]) {
  if (!isfinite(at[0] + at[1])) return;
  p->from = fmin(p->from, at[0] - edge);
  p->to = fmax(p->to, at[0] + edge);
  p->right = fmin(p->right, at[1] - edge);
  p->left = fmax(p->left, at[1] + edge);
}

static void find_extent(plan *p) {
  const ambulo_problem_definition *d = &p->stride->problem->definition;
  double at[2];
  p->from = p->right = INFINITY;
  p->to = p->left = -INFINITY;
  for (int i = 0; i < d->contact_count; i++)
    for (int c = 0; c < PRINT && d->contacts[i].foot >= 0; c++) {
      print_corner(p, &d->contacts[i], c, at);
      widen(p, at);
    }
  for (int k = 0; k < p->stride->samples; k++) {
    root_place(p, k, 0.0, at);
    widen(p, at);
  }
  p->scale =
      fmin(largest, fmin(p->panel->width / (p->to - p->from), most_height / (p->left - p->right)));
}

static ambulo_status open_plan(const ambulo__stride *stride, const ambulo__panel *panel,
                               const ambulo_allocator *allocator, plan *p) {
  *p = (plan){.stride = stride, .panel = panel};
  double *q = ambulo__alloc(allocator, (size_t)stride->coordinates, sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__skeleton_create(stride->model, allocator, &p->skeleton);
  if (!status) {
    find_root(p, q);
    find_extent(p);
  }
  ambulo__free(allocator, q);
  return status;
}

ambulo_status ambulo__gait_plan_height(const ambulo__stride *stride, ambulo__panel *panel) {
  plan p;
  panel->height = 0.0;
  if (!ambulo__gait_turns(stride->problem)) return AMBULO_OK;
  ambulo_status status = open_plan(stride, panel, &stride->allocator, &p);
  if (!status) panel->height = heading_room + p.scale * (p.left - p.right);
  ambulo__skeleton_free(&p.skeleton);
  return status;
}

/* ------------------------------------------------------------------ the page */

/* in the middle of the panel */
static void to_page(const plan *p, const double at[2], double page[2]) {
  double spare = p->panel->width - p->scale * (p->to - p->from);
  page[0] = p->panel->x + 0.5 * spare + p->scale * (at[0] - p->from);
  page[1] = p->panel->y + heading_room + p->scale * (p->left - at[1]);
}

static void draw_prints(const plan *p, ambulo__text_buffer *text) {
  static const char *const styles[] = {"trunk-print", "left-print", "right-print"};
  const ambulo_problem_definition *d = &p->stride->problem->definition;
  const ambulo_model *m = p->stride->model;
  for (int i = 0; i < d->contact_count; i++) {
    if (!is_first_there(d, i)) continue;
    int heel = m->points[m->feet[d->contacts[i].foot].heel_center].link;
    ambulo__svg_path_begin(text, styles[p->skeleton.side[heel]]);
    for (int c = 0; c <= PRINT; c++) {
      double at[2], page[2];
      print_corner(p, &d->contacts[i], c % PRINT, at);
      to_page(p, at, page);
      if (c)
        ambulo__svg_path_line(text, page[0], page[1]);
      else
        ambulo__svg_path_move(text, page[0], page[1]);
    }
    ambulo__svg_path_end(text);
  }
}

static int root_on_page(plan *p, int sample, double aside, double page[2]) {
  double at[2];
  root_place(p, sample, aside, at);
  to_page(p, at, page);
  return isfinite(page[0] + page[1]);
}

static void draw_way(plan *p, ambulo__text_buffer *text) {
  int last = p->stride->samples - 1, begun = 0;
  double page[2], other[2];
  ambulo__svg_path_begin(text, "trunk thin");
  for (int k = 0; k <= last; k++) {
    if (!root_on_page(p, k, 0.0, page)) continue;
    if (begun++)
      ambulo__svg_path_line(text, page[0], page[1]);
    else
      ambulo__svg_path_move(text, page[0], page[1]);
  }
  ambulo__svg_path_end(text);
  for (int bar = 0; bar <= BARS; bar++) {
    int sample = (int)((double)last * bar / BARS + 0.5);
    if (root_on_page(p, sample, hips, page) && root_on_page(p, sample, -hips, other))
      ambulo__svg_line(text, "trunk", page[0], page[1], other[0], other[1]);
  }
}

ambulo_status ambulo__gait_plan(const ambulo__stride *stride, const ambulo__panel *panel,
                                ambulo__text_buffer *text) {
  plan p;
  if (!ambulo__gait_turns(stride->problem)) return AMBULO_OK;
  ambulo_status status = open_plan(stride, panel, &text->allocator, &p);
  if (!status) {
    ambulo__svg_label(text, "panel", panel->x, panel->y + 6.0,
                      "From above: footprints, and the way of the pelvis");
    draw_prints(&p, text);
    draw_way(&p, text);
  }
  ambulo__skeleton_free(&p.skeleton);
  return status;
}
