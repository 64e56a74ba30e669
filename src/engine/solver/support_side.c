/* solver/support_side.c - one side of a support region when footholds move.
 *
 * Row of a side with inward normal n_s on the zero-moment point z (contact/zmp.c), phi = n.F / m g:
 *
 *     c = phi (n_s . z - n_s . v),   v the corner that lies furthest out: it minimizes n_s . v
 *
 * Side of a box: its direction stays, so that dc/dplace = -phi n_s for the foot of v. Side of a
 * hull from v to w: it turns when one end moves, and the distance of z changes as the line does
 * abreast of z. With t along the side and s = (t . z - t . v) / (t . w - t . v), for places of v
 * and w,
 *
 *     dc/dplace_v = -(1 - s) phi n_s,   dc/dplace_w = -s phi n_s
 *
 * m, along forward and left.
 */
#include "solver/partials.h"

#include <math.h>

static const double on_the_side = 1e-9; /* m */

typedef struct corner {
  int contact;
  double out, along; /* n_s . v, t . v */
} corner;

/* the two ends of the side among the corners of loaded feet; 0 if there is none */
static int find_ends(const ambulo__stationary *s, const ambulo__foot_outline *outlines,
                     const ambulo__support_row *row, corner end[2]) {
  const ambulo_problem *p = s->problem;
  const int *active = ambulo__stationary_contacts(s, row->node, row->before);
  int found = 0;
  for (int foot = 0; foot < p->model->foot_count; foot++) {
    if (active[foot] < 0) continue;
    const ambulo_contact *contact = &p->definition.contacts[active[foot]];
    for (int c = 0; c < outlines[foot].count; c++) {
      if (row->turns && !ambulo__corner_in_contact(contact->mode, outlines[foot].is_heel[c]))
        continue;
      double x = contact->place[0] + outlines[foot].place[c][0];
      double y = contact->place[1] + outlines[foot].place[c][1];
      corner here = {active[foot], row->normal[0] * x + row->normal[1] * y,
                     row->normal[1] * x - row->normal[0] * y};
      int further = !found || here.out < end[0].out - on_the_side;
      if (!further && here.out > end[0].out + on_the_side) continue;
      if (further || here.along < end[0].along) end[0] = here;
      if (further || here.along > end[1].along) end[1] = here;
      found = 1;
    }
  }
  return found;
}

/* (S.4) -(1 - s) phi n_s, -s phi n_s */
void ambulo__support_side(const ambulo__stationary *s, const ambulo__foot_outline *outlines,
                          const ambulo__support_row *row, double pull, ambulo__partials *partials) {
  corner end[2] = {{-1, 0.0, 0.0}, {-1, 0.0, 0.0}};
  if (!find_ends(s, outlines, row, end)) return;
  double share[2] = {row->force, 0.0}, length = end[1].along - end[0].along;
  if (row->turns && length > 0.0) {
    double along = row->normal[1] * row->moment[0] - row->normal[0] * row->moment[1];
    share[1] = (along - row->force * end[0].along) / length;
    share[0] = row->force - share[1];
  }
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < 2; i++)
      partials->place[2 * end[k].contact + i] -= pull * share[k] * row->normal[i];
  }
}
