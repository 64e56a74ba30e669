/* solver/sensitivity_surface.c - see surface.h.
 *
 * A row asks for points r_j, forces and moments relative to its surface. To move the surface by D
 * and to turn it about its origin o by theta is to move and turn all these the other way round:
 * with C_j = dc/dr_j, C_f = dc/df,
 *
 *     dc/dD = -sum C_j,     dc/dtheta = -sum (r_j - o) x C_j - sum f x C_f
 *
 * With the axes f, l, u of the surface (contact/contact_frame.h), the unit vector h ahead (at the
 * heading psi) and k = |u x h|, a change of the normal v and of psi turns the surface by
 *
 *     theta = u x u. + omega u,   omega = -f . (u. x h + u x h.) / k,   u. = v. / |v|
 *
 * for l stays across: l. . f = -omega. The part of v. along u turns nothing: u x u = 0, f . l = 0.
 */
#include "solver/sensitivity_surface.h"
#include "base/arithmetic.h"

#include "contact/gait.h"
#include "contact/swing.h"

#include <math.h>
#include <string.h>

/* --------------------------------------------------------------------- a row */

static void add_to(ambulo__row_vectors *v, int channel, int start, double coefficient) {
  int axis = (channel - start) % 3, first = channel - axis, i = 0;
  while (i < v->count && v->first[i] != first) i++;
  if (i == AMBULO__ROW_VECTORS) return;
  v->first[i] = first;
  v->coefficient[i][axis] += coefficient;
  if (i == v->count) v->count++;
}

/* its three vectors by themselves, so that slopes need no room for every channel */
static void add_arc(const ambulo__stationary *s, const ambulo__table_row *row,
                    const ambulo__arc *arc, int start, ambulo__row_vectors *v) {
  int channel[AMBULO__ARC_CHANNELS], count = ambulo__arc_channels(arc, channel);
  double y[AMBULO__ARC_CHANNELS], slope[AMBULO__ARC_CHANNELS] = {0.0};
  ambulo__arc own = *arc;
  own.center = 0;
  if (arc->force < 0) {
    own.heel = 3;
    own.toe = 6;
  } else {
    own.force = 3;
    own.moment = 6;
  }
  for (int i = 0; i < count; i++) y[i] = ambulo__stationary_channel(s, row->node, channel[i]);
  (void)ambulo__arc_value(&own, y, 1, slope);
  for (int i = 0; i < count; i++) add_to(v, channel[i], start, slope[i]);
}

ambulo__row_vectors ambulo__row_vectors_of(const ambulo__stationary *s,
                                           const ambulo__table_row *row) {
  const ambulo_problem *p = s->problem;
  ambulo__row_vectors v = {.count = 0};
  int start = ambulo__channel_moment(&p->channels, 0);
  const ambulo__arc *arc = ambulo__row_arc_of(&p->table, row);
  if (arc) add_arc(s, row, arc, start, &v);
  for (int t = 0; t < row->term_count; t++) {
    const ambulo__row_term *term = &p->table.terms[row->first_term + t];
    add_to(&v, term->channel, start, term->coefficient);
  }
  return v;
}

/* (S.15) -sum C, -sum (r - o) x C - sum f x C */
ambulo__surface_pull ambulo__surface_pull_of(const ambulo__stationary *s,
                                             const ambulo__table_row *row, double pull,
                                             const double origin[3]) {
  const ambulo__channels *c = &s->problem->channels;
  ambulo__surface_pull by = {{0.0}, {0.0}};
  ambulo__row_vectors v = ambulo__row_vectors_of(s, row);
  for (int k = 0; k < v.count; k++) {
    double at[3];
    int is_point = v.first[k] < ambulo__channel_point(c, c->points, 0);
    for (int i = 0; i < 3; i++) {
      at[i] = ambulo__stationary_channel(s, row->node, v.first[k] + i);
      if (is_point) at[i] -= origin[i];
      if (is_point) by.origin[i] -= pull * v.coefficient[k][i];
    }
    ambulo__add_cross(at, v.coefficient[k], -pull, by.turn);
  }
  return by;
}

/* ----------------------------------------------------------------- a contact */

typedef struct contact_pull {
  double place[3], heading, normal[3];
} contact_pull;

/* omega of a change of u x h */
static double swerve(const ambulo__contact_frame *frame, const double up[3], const double ahead[3],
                     const double up_rate[3], const double ahead_rate[3]) {
  double across[3] = {0.0}, moved[3] = {0.0};
  ambulo__add_cross(up, ahead, 1.0, across);
  ambulo__add_cross(up_rate, ahead, 1.0, moved);
  ambulo__add_cross(up, ahead_rate, 1.0, moved);
  return -ambulo__dot(frame->forward, moved) / sqrt(ambulo__dot(across, across));
}

/* (S.16) by place, heading, normal */
static contact_pull pull_on(const ambulo_problem_definition *d, const ambulo_contact *c,
                            const ambulo__surface_pull *by) {
  static const double still[3] = {0.0, 0.0, 0.0};
  const ambulo_model *m = d->model;
  const double *axes[3] = {m->forward, m->left, m->up};
  ambulo__contact_frame frame = ambulo__contact_frame_of(d, c);
  contact_pull pull = {{0.0}, 0.0, {0.0}};
  double ahead[3], aside[3], size = sqrt(ambulo__dot(c->normal, c->normal)),
                             cosine = cos(c->heading), sine = sin(c->heading);
  for (int i = 0; i < 3; i++) {
    ahead[i] = cosine * m->forward[i] + sine * m->left[i];
    aside[i] = cosine * m->left[i] - sine * m->forward[i];
    pull.place[i] = ambulo__dot(axes[i], by->origin);
  }
  pull.heading = swerve(&frame, frame.up, ahead, still, aside) * ambulo__dot(frame.up, by->turn);
  for (int i = 0; size > 0.0 && i < 3; i++) {
    double rate[3], turn[3] = {0.0};
    for (int k = 0; k < 3; k++) rate[k] = axes[i][k] / size;
    ambulo__add_cross(frame.up, rate, 1.0, turn);
    pull.normal[i] = ambulo__dot(turn, by->turn) +
                     swerve(&frame, frame.up, ahead, rate, still) * ambulo__dot(frame.up, by->turn);
  }
  return pull;
}

static void add_pull(int contact, const contact_pull *pull, double side,
                     ambulo__partials *partials) {
  partials->place[2 * contact] += pull->place[0];
  partials->place[2 * contact + 1] += side * pull->place[1];
  partials->rise[contact] += pull->place[2];
  partials->heading[contact] += side * pull->heading;
  for (int i = 0; i < 3; i++)
    partials->normal[3 * contact + i] += (i == 1 ? side : 1.0) * pull->normal[i];
}

static void add_image(const ambulo__stationary *s, const ambulo_contact *image,
                      const contact_pull *pull, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &s->problem->definition;
  int period, contact = ambulo__swing_source(d, image, &period);
  if (contact < 0) return;
  add_pull(contact, pull, d->ends == AMBULO_ENDS_MIRRORED && period % 2 != 0 ? -1.0 : 1.0,
           partials);
  if (period == 0) return;
  partials->travel += period * pull->place[0];
  partials->end_rise += period * pull->place[2];
}

void ambulo__surface_of_contact(const ambulo__stationary *s, int contact,
                                const ambulo__surface_pull *by, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &s->problem->definition;
  contact_pull pull = pull_on(d, &d->contacts[contact], by);
  add_pull(contact, &pull, 1.0, partials);
}

void ambulo__surface_of_image(const ambulo__stationary *s, const ambulo_contact *image,
                              const ambulo__surface_pull *by, ambulo__partials *partials) {
  contact_pull pull = pull_on(&s->problem->definition, image, by);
  add_image(s, image, &pull, partials);
}

void ambulo__surface_unclear(const ambulo__stationary *s, const ambulo_contact *image,
                             ambulo__partials *partials) {
  int period, contact = ambulo__swing_source(&s->problem->definition, image, &period);
  if (contact < 0) return;
  partials->rise[contact] = (double)NAN;
  if (period != 0) partials->end_rise = (double)NAN;
}

/* S' */
static double steepness(double u) {
  u = fmin(1.0, fmax(0.0, u));
  return 6.0 * u * (1.0 - u);
}

static double given_normal(const ambulo_contact *c, int i) {
  return c->normal[2] > 0.0 ? c->normal[i] : i == 2;
}

double ambulo__surface_between(const ambulo__stationary *s, const ambulo_contact *from,
                               const ambulo_contact *to, double share,
                               const ambulo__surface_pull *by, ambulo__partials *partials) {
  ambulo_contact there = ambulo__contact_between(from, to, share);
  contact_pull pull = pull_on(&s->problem->definition, &there, by), near = pull, far = pull;
  double rise = to->place[2] - from->place[2], early = rise > 0.0 ? 2.0 * share : 2.0 * share - 1.0;
  double along = ambulo__smooth_step(share), climb = ambulo__smooth_step(early);
  double slope = steepness(share), steep = steepness(early);
  double by_share =
      slope * pull.heading * (to->heading - from->heading) + 2.0 * steep * pull.place[2] * rise;
  for (int i = 0; i < 2; i++) by_share += slope * pull.place[i] * (to->place[i] - from->place[i]);
  for (int i = 0; i < 3; i++) {
    double part = i == 2 ? climb : along;
    by_share += slope * pull.normal[i] * (given_normal(to, i) - given_normal(from, i));
    near.place[i] *= 1.0 - part;
    far.place[i] *= part;
    near.normal[i] *= 1.0 - along;
    far.normal[i] *= along;
  }
  near.heading *= 1.0 - along;
  far.heading *= along;
  add_image(s, from, &near, partials);
  add_image(s, to, &far, partials);
  int two = from->from != to->from; /* one alone goes with itself */
  if (two && rise == 0.0 && share > 0.0 && share < 1.0 && pull.place[2] != 0.0) {
    ambulo__surface_unclear(s, from, partials); /* up and down are not the same way */
    ambulo__surface_unclear(s, to, partials);
  }
  return by_share;
}
