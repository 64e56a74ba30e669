/* contact/foot.c - see contact_frame.h.
 *
 * Under a foot in the air, s its share of the way, S(s) = s^2 (3 - 2 s):
 *
 *     p_f, p_l, psi, u   x = (1 - S(s)) x_from + S(s) x_to
 *     p_n                the same with s' = min(1, 2 s) up, max(0, 2 s - 1) down
 */
#include "contact/row_families.h"

#include "base/arithmetic.h"
#include "model/model.h"
#include "model/neutral_pose.h"

#include <math.h>

/* ------------------------------------------------------------- the table of modes */

static const ambulo__mode mode_table[] = {
    [AMBULO_CONTACT_HEEL] = {"heel", "on its heel", {0, 1}, 0},
    [AMBULO_CONTACT_FLAT] = {"flat", "flat", {1, 1}, 0},
    [AMBULO_CONTACT_TOE] = {"toe", "on its toes", {1, 0}, 0},
    [AMBULO_CONTACT_PATCH] = {"patch", "on its patch", {0, 0}, 1},
};

enum { MODE_COUNT = sizeof mode_table / sizeof *mode_table };

const ambulo__mode *ambulo__mode_of(int mode) {
  return mode >= 0 && mode < MODE_COUNT && mode_table[mode].word ? &mode_table[mode] : NULL;
}

static int has_corners(int mode, int toe, int heel) {
  const ambulo__mode *m = ambulo__mode_of(mode);
  return m && !m->is_of_patch && m->corners[0] == toe && m->corners[1] == heel;
}

int ambulo__mode_is_flat(int mode) {
  return has_corners(mode, 1, 1);
}

int ambulo__mode_is_on_toes(int mode) {
  return has_corners(mode, 1, 0);
}

int ambulo__mode_is_on_heel(int mode) {
  return has_corners(mode, 0, 1);
}

int ambulo__mode_is_of_patch(int mode) {
  const ambulo__mode *m = ambulo__mode_of(mode);
  return m && m->is_of_patch;
}

int ambulo__modes_with(int heel) {
  int set = 0;
  for (int mode = 0; mode < MODE_COUNT; mode++)
    if (mode_table[mode].corners[heel]) set |= 1 << mode;
  return set;
}

static const double facing = 0.90630778703664997; /* cosine of 25 degrees */

int ambulo__contact_normal_is_legal(const double normal[3]) {
  double size = sqrt(ambulo__dot(normal, normal));
  return size == 0.0 || (isfinite(size) && normal[2] >= 0.5 * size);
}

int ambulo__contact_is_level(const ambulo_contact *c) {
  return c->heading == 0.0 && c->place[2] == 0.0 && c->normal[0] == 0.0 && c->normal[1] == 0.0;
}

int ambulo__contacts_same_place(const ambulo_contact *one, const ambulo_contact *other) {
  for (int i = 0; i < 3; i++)
    if (one->place[i] != other->place[i] || one->normal[i] != other->normal[i]) return 0;
  return one->heading == other->heading;
}

int ambulo__contacts_are_level(const ambulo_problem_definition *d) {
  for (int i = 0; i < d->contact_count; i++)
    if (d->contacts[i].foot >= 0 && !ambulo__contact_is_level(&d->contacts[i])) return 0;
  return 1;
}

ambulo__contact_frame ambulo__contact_frame_of(const ambulo_problem_definition *d,
                                               const ambulo_contact *c) {
  const ambulo_model *m = d->model;
  ambulo__contact_frame frame;
  double height = d->ground_height + c->place[2], ahead[3], length = 0.0;
  for (int i = 0; i < 3; i++) {
    frame.origin[i] = c->place[0] * m->forward[i] + c->place[1] * m->left[i] + height * m->up[i];
    frame.forward[i] = m->forward[i];
    frame.left[i] = m->left[i];
    frame.up[i] = m->up[i];
  }
  if (c->heading == 0.0 && c->normal[0] == 0.0 && c->normal[1] == 0.0 && c->normal[2] >= 0.0)
    return frame;
  double size = sqrt(ambulo__dot(c->normal, c->normal));
  for (int i = 0; i < 3; i++) {
    ahead[i] = cos(c->heading) * m->forward[i] + sin(c->heading) * m->left[i];
    if (size > 0.0)
      frame.up[i] =
          (c->normal[0] * m->forward[i] + c->normal[1] * m->left[i] + c->normal[2] * m->up[i]) /
          size;
  }
  if (fabs(ambulo__dot(frame.up, ahead)) > facing)
    for (int i = 0; i < 3; i++) ahead[i] = m->up[i];
  ambulo__cross(frame.up, ahead, frame.left);
  length = sqrt(ambulo__dot(frame.left, frame.left));
  for (int i = 0; i < 3; i++) frame.left[i] /= length;
  ambulo__cross(frame.left, frame.up, frame.forward);
  return frame;
}

ambulo_contact ambulo__contact_between(const ambulo_contact *from, const ambulo_contact *to,
                                       double share) {
  ambulo_contact there = *to;
  double along = ambulo__smooth_step(share), rise = to->place[2] - from->place[2];
  double climb = ambulo__smooth_step(rise > 0.0 ? 2.0 * share : 2.0 * share - 1.0);
  for (int i = 0; i < 2; i++)
    there.place[i] = from->place[i] + along * (to->place[i] - from->place[i]);
  there.place[2] = from->place[2] + climb * rise;
  there.heading = from->heading + along * (to->heading - from->heading);
  for (int i = 0; i < 3; i++) {
    double up = i == 2 ? 1.0 : 0.0; /* a normal of zero is up */
    double a = from->normal[2] > 0.0 ? from->normal[i] : up,
           b = to->normal[2] > 0.0 ? to->normal[i] : up;
    there.normal[i] = a + along * (b - a);
  }
  return there;
}

ambulo__contact_frame ambulo__contact_frame_between(const ambulo_problem_definition *d,
                                                    const ambulo_contact *from,
                                                    const ambulo_contact *to, double share) {
  ambulo_contact there = ambulo__contact_between(from, to, share);
  return ambulo__contact_frame_of(d, &there);
}

double ambulo__contact_frame_along(const ambulo__contact_frame *frame, const double direction[3],
                                   const double point[3]) {
  double sum = 0.0;
  for (int i = 0; i < 3; i++) sum += direction[i] * (point[i] - frame->origin[i]);
  return sum;
}

/* corners of the flat foot relative to its heel centre.
 *
 * With r a corner and r_h, r_t the centres at q = 0, f and l the forward and left axes,
 * e = (f . (r_t - r_h), l . (r_t - r_h)) and u = e / |e|, the corner stands at
 *
 *     ( u . d,  u_perp . d ),   d = (f . (r - r_h), l . (r - r_h)),  u_perp = (-u_l, u_f)
 */

/* point `index` relative to `origin`, along forward and left */
static void project(const ambulo_model *model, int index, const double origin[3], double out[2]) {
  double r[3];
  ambulo__neutral_point(model, index, r);
  out[0] = out[1] = 0.0;
  for (int axis = 0; axis < 3; axis++) {
    out[0] += model->forward[axis] * (r[axis] - origin[axis]);
    out[1] += model->left[axis] * (r[axis] - origin[axis]);
  }
}

static void add_corner(const ambulo_model *model, int index, int is_heel, const double origin[3],
                       const double ahead[2], ambulo__foot_outline *outline) {
  if (index < 0) return;
  double d[2];
  project(model, index, origin, d);
  int c = outline->count++;
  outline->point[c] = index;
  outline->is_heel[c] = is_heel;
  outline->place[c][0] = ahead[0] * d[0] + ahead[1] * d[1];
  outline->place[c][1] = -ahead[1] * d[0] + ahead[0] * d[1];
}

static void add_arcs(const ambulo_model *model, const ambulo_foot *foot, const double origin[3],
                     const double ahead[2], ambulo__foot_outline *outline) {
  outline->has_arcs = foot->has_arcs;
  for (int end = 0; foot->has_arcs && end < 2; end++) {
    double d[2], r[3];
    project(model, foot->arc[end], origin, d);
    ambulo__neutral_point(model, foot->arc[end], r);
    outline->arc[end] = foot->arc[end];
    outline->arc_ahead[end] = ahead[0] * d[0] + ahead[1] * d[1];
    for (int axis = 0; axis < 3; axis++)
      outline->radius[end] += model->up[axis] * (r[axis] - origin[axis]);
  }
}

static void add_ends(const ambulo_model *model, int foot, ambulo__foot_outline *outline) {
  double narrow = INFINITY;
  for (int end = 0; end < 2; end++)
    outline->touch[end] = outline->has_arcs ? outline->arc_ahead[end] : end * outline->length;
  outline->tip = fmax(outline->length, ambulo__foot_reach(model, foot));
  for (int c = 0; c < outline->count; c++) {
    if (outline->place[c][0] < -1e-9) /* rounding apart */
      outline->back = fmin(outline->back, outline->place[c][0]);
    narrow = fmin(narrow, fabs(outline->place[c][1]));
  }
  outline->half_width = isfinite(narrow) ? narrow : 0.0;
}

ambulo__foot_outline ambulo__foot_outline_of(const ambulo_model *model, int foot) {
  const ambulo_foot *f = &model->feet[foot];
  ambulo__foot_outline outline = {.is_point = ambulo__foot_is_point(f)};
  double origin[3], ahead[2];
  ambulo__neutral_point(model, f->heel_center, origin);
  project(model, f->toe_center, origin, ahead);
  outline.length = hypot(ahead[0], ahead[1]);
  outline.moves_sideways = ambulo__link_moves_sideways(model, model->points[f->heel_center].link) ||
                           ambulo__link_moves_sideways(model, model->points[f->toe_center].link);
  if (outline.length > 0.0) {
    ahead[0] /= outline.length;
    ahead[1] /= outline.length;
  } else {
    ahead[0] = 1.0;
  }
  add_arcs(model, f, origin, ahead, &outline);
  for (int side = 0; side < 2; side++) add_corner(model, f->heel[side], 1, origin, ahead, &outline);
  for (int side = 0; side < 2 && !outline.is_point; side++)
    add_corner(model, f->toe[side], 0, origin, ahead, &outline);
  add_ends(model, foot, &outline);
  return outline;
}

double ambulo__foot_reach(const ambulo_model *model, int foot) {
  const ambulo_foot *f = &model->feet[foot];
  double heel[3], reach[2];
  ambulo__neutral_point(model, f->heel_center, heel);
  project(model, f->has_tip ? f->tip : f->toe_center, heel, reach);
  return hypot(reach[0], reach[1]);
}

ambulo__foot_outline *ambulo__foot_outlines(const ambulo_model *model,
                                            const ambulo_allocator *allocator) {
  ambulo__foot_outline *outlines =
      ambulo__alloc(allocator, (size_t)model->foot_count, sizeof *outlines);
  for (int foot = 0; outlines && foot < model->foot_count; foot++) {
    outlines[foot] = ambulo__foot_outline_of(model, foot);
  }
  return outlines;
}

int ambulo__corner_in_contact(ambulo_contact_mode mode, int is_heel) {
  const ambulo__mode *m = ambulo__mode_of((int)mode);
  return m && m->corners[is_heel != 0];
}

int ambulo__contact_point(const ambulo_problem_definition *d, const ambulo__foot_outline *outline,
                          const ambulo_contact *contact, double place[3]) {
  ambulo__contact_frame frame = ambulo__contact_frame_of(d, contact);
  int on_toes = ambulo__mode_is_on_toes(contact->mode);
  double ahead = on_toes ? outline->length : 0.0;
  for (int i = 0; i < 3; i++) place[i] = frame.origin[i] + ahead * frame.forward[i];
  if (contact->foot < 0) return d->model->patches[contact->patch].point;
  const ambulo_foot *foot = &d->model->feet[contact->foot];
  return on_toes ? foot->toe_center : foot->heel_center;
}

double ambulo__foot_length(const ambulo_model *model, int foot) {
  double a[3], b[3], square = 0.0;
  ambulo__neutral_point(model, model->feet[foot].heel_center, a);
  ambulo__neutral_point(model, model->feet[foot].toe_center, b);
  for (int i = 0; i < 3; i++) square += (b[i] - a[i]) * (b[i] - a[i]);
  return sqrt(square);
}
