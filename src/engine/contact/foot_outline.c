/* contact/foot_outline.c - corners of the flat foot relative to its heel centre.
 *
 * With r a corner and r_h, r_t the centres at q = 0, f and l the forward and left axes,
 * e = (f . (r_t - r_h), l . (r_t - r_h)) and u = e / |e|, the corner stands at
 *
 *     ( u . d,  u_perp . d ),   d = (f . (r - r_h), l . (r - r_h)),  u_perp = (-u_l, u_f)
 */
#include "contact/foot_outline.h"
#include "contact/contact_frame.h"

#include "model/neutral_pose.h"

#include <math.h>

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

ambulo__foot_outline ambulo__foot_outline_of(const ambulo_model *model, int foot) {
  ambulo__foot_outline outline = {.count = 0};
  const ambulo_foot *f = &model->feet[foot];
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
  for (int side = 0; side < 2; side++) add_corner(model, f->toe[side], 0, origin, ahead, &outline);
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
  if (mode == AMBULO_CONTACT_FLAT) return 1;
  return is_heel ? mode == AMBULO_CONTACT_HEEL : mode == AMBULO_CONTACT_TOE;
}

int ambulo__contact_point(const ambulo_problem_definition *d, const ambulo__foot_outline *outline,
                          const ambulo_contact *contact, double place[3]) {
  ambulo__contact_frame frame = ambulo__contact_frame_of(d, contact);
  int on_toes = contact->mode == AMBULO_CONTACT_TOE;
  double ahead = on_toes ? outline->length : 0.0;
  for (int i = 0; i < 3; i++) place[i] = frame.origin[i] + ahead * frame.forward[i];
  if (contact->foot < 0) return d->model->patches[contact->patch].point;
  const ambulo_foot *foot = &d->model->feet[contact->foot];
  return on_toes ? foot->toe_center : foot->heel_center;
}
