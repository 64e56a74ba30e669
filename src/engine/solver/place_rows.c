/* solver/place_rows.c - footholds, height of the ground and tolerances in the rows that hold
 * feet where they are due (contact/ground.c, foot_strike.c, contact_tube.c, clearance.c).
 *
 * Such a row is k + sum_j C_j . r_j >= 0 or = 0 on points r_j of one foot (world axes, m), or of an
 * arc. It asks for them relative to a surface with the axes f, l, n, that of a contact or between
 * two (surface.c): to move it by D is to move the points by -D, whatever the row is about,
 *
 *     dc / d place_f = -C . f,    dc / d place_l = -C . l,    dc / d height = -C . n,    C = sum
 * C_j
 *
 * (directions of a foot have C = 0). Bounds b that widen the room of a row enter as +b:
 *
 *     contact tolerance, ceiling, turn, inward, outward   dc/db = 1
 *     orientation tolerance                               1, of yaw and roll on the toes 2
 *     strike pitch p_0, p_1                               -cos p_0, cos p_1
 *     clearance height H, of a point due at a low = a H   -a
 *
 * and a = part(s), half of it of the heel, has times: dc/ds = -H part'(s), s along the swing, with
 * which the surface below goes on as well. Edges of steps: step_rows.c. Gaps between feet are on no
 * surface (contact/feet_apart.c): dc/dgap = dc/dD = -1 - c / D (contact/apart.h), and D has a part
 * that goes with the duration.
 */
#include "solver/sensitivity_surface.h"
#include "base/arithmetic.h"
#include "solver/step_rows.h"

#include "contact/gait.h"
#include "contact/bounded.h"
#include "contact/loading.h"
#include "contact/swing.h"

#include <math.h>

typedef struct place_row {
  const ambulo__stationary *s;
  const ambulo__table_row *row;
  double pull;                 /* -lambda */
  int foot, point;             /* of the first term */
  double total[3];             /* C */
  double first[3];             /* of the first point alone */
  ambulo__contact_frame frame; /* of the surface that it is about */
} place_row;

static int has_point(const ambulo_foot *f, int point) {
  for (int side = 0; side < 2; side++)
    if (f->heel[side] == point || f->toe[side] == point) return 1;
  for (int end = 0; f->has_arcs && end < 2; end++)
    if (f->arc[end] == point) return 1;
  return f->heel_center == point || f->toe_center == point || (f->has_tip && f->tip == point);
}

/* 0 when the row stands on no point of a foot */
static int read_row(place_row *p) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo_model *model = problem->model;
  ambulo__row_vectors v = ambulo__row_vectors_of(p->s, p->row);
  if (v.count == 0) return 0;
  p->point = (v.first[0] - ambulo__channel_point(&problem->channels, 0, 0)) / 3;
  for (int k = 0; k < v.count; k++)
    for (int i = 0; i < 3; i++) p->total[i] += v.coefficient[k][i];
  for (int i = 0; i < 3; i++) p->first[i] = v.coefficient[0][i];
  for (p->foot = 0; p->foot < model->foot_count; p->foot++)
    if (has_point(&model->feet[p->foot], p->point)) return 1;
  return 0;
}

static void add_pitch(const place_row *p, const ambulo_contact *contact,
                      ambulo__partials *partials) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo_problem_definition *d = &problem->definition;
  if (contact->mode == AMBULO_CONTACT_FLAT) partials->orientation_tolerance += p->pull;
  if (!ambulo__is_pitched(d, contact, problem->times, problem->nodes, p->row->node)) return;
  int is_upper = ambulo__dot(p->first, p->frame.up) < 0.0;
  double slope = cos(d->strike_pitch[is_upper]);
  partials->strike_pitch[is_upper] += p->pull * (is_upper ? slope : -slope);
}

static void add_contact(const place_row *p, const ambulo_contact *contact,
                        ambulo__partials *partials) {
  const ambulo_model *model = p->s->problem->model;
  if (p->row->measure == AMBULO__METRES) {
    partials->contact_tolerance += p->pull;
    return;
  }
  int from_heel_to_toe = p->point == model->feet[p->foot].toe_center;
  if (from_heel_to_toe &&
      fabs(ambulo__dot(p->first, p->frame.up)) > fabs(ambulo__dot(p->first, p->frame.left))) {
    add_pitch(p, contact, partials);
  } else {
    partials->orientation_tolerance += p->pull * (contact->mode == AMBULO_CONTACT_TOE ? 2.0 : 1.0);
  }
}

/* ------------------------------------------------------------- in the air */

/* dL/ds, s = (t - from) / (to - from) of the swing */
static void add_swing(const place_row *p, double s, const ambulo__span *air, double by_s,
                      ambulo__partials *partials) {
  double pull = by_s / (air->to - air->from);
  partials->node_time[p->row->node] += pull;
  if (air->begins >= 0) partials->contact_time[2 * air->begins + 1] -= pull * (1.0 - s);
  if (air->ends >= 0) partials->contact_time[2 * air->ends] -= pull * s;
}

/* low = H' part(s), of a tip less D (1 - part(s)); returns dL/ds */
static double add_low(const place_row *p, double s, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  int is_heel = p->point == p->s->problem->model->feet[p->foot].heel_center;
  double slope, pull = -p->pull * (is_heel ? 0.5 : 1.0);
  partials->clearance.height += pull * ambulo__clearance_part(s, &slope);
  const ambulo_foot *foot = &p->s->problem->model->feet[p->foot];
  int is_tip = foot->has_tip && p->point == foot->tip;
  double drop = is_tip ? ambulo__tip_drop(d, p->foot, p->row->time, s) : 0.0;
  return pull * (d->clearance.height + drop) * slope;
}

/* the bound; returns dL/ds */
static double add_room(const place_row *p, double s, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  double up = ambulo__dot(p->total, p->frame.up), left = ambulo__dot(p->total, p->frame.left);
  ambulo_clearance *c = &partials->clearance;
  if (p->row->measure != AMBULO__METRES) {
    c->turn += p->pull;
  } else if (fabs(up) <= fabs(left)) {
    int is_left;
    (void)ambulo__swing_track(d, p->foot, p->row->time, &is_left);
    double *room = (left > 0.0) == is_left ? &c->inward : &c->outward;
    *room += p->pull;
  } else if (up < 0.0) {
    c->ceiling += p->pull;
  } else {
    return add_low(p, s, partials);
  }
  return 0.0;
}

/* returns dL/ds */
static double add_step(const place_row *p, const ambulo_contact *from, const ambulo_contact *to,
                       const ambulo__step_edges *edges, const ambulo__span *air, double s,
                       ambulo__partials *partials) {
  ambulo__step_row step = {.row = p->row, .from = from, .to = to, .edges = *edges, .pull = p->pull};
  int point = ambulo__channel_point(&p->s->problem->channels, p->point, 0);
  for (int i = 0; i < 3; i++)
    step.point[i] = ambulo__stationary_channel(p->s, p->row->node, point + i);
  step.first_edge = ambulo__step_edge_time(*air, from, to, 0);
  int due = ambulo__partials_of_step(p->s, &step, partials);
  if (due < 0) partials->clearance.ceiling += p->pull;
  return due > 0 ? add_low(p, s, partials) : 0.0;
}

/* over level ground along the track of the next foothold */
static double add_track(place_row *p, double s, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  ambulo_contact to = {.foot = p->foot};
  int is_left, track = ambulo__swing_track(d, p->foot, p->row->time, &is_left);
  if (track >= 0) to.place[1] = d->contacts[track].place[1];
  p->frame = ambulo__contact_frame_of(d, &to);
  ambulo__surface_pull by = ambulo__surface_pull_of(p->s, p->row, p->pull, p->frame.origin);
  partials->ground_height += ambulo__dot(by.origin, d->model->up);
  if (track >= 0) partials->place[2 * track + 1] += ambulo__dot(by.origin, d->model->left);
  return add_room(p, s, partials);
}

/* between two contacts */
static double add_way(place_row *p, const ambulo__span *air, double s, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  ambulo_contact from = {.foot = p->foot}, to = from;
  (void)ambulo__swing_contacts(d, p->foot, p->row->time, &from, &to);
  ambulo__step_edges edges = ambulo__step_edges_between(d, p->foot, p->row->time, &from, &to);
  if (edges.count > 0 && ambulo__is_step_row(p->row))
    return add_step(p, &from, &to, &edges, air, s, partials);
  p->frame = ambulo__contact_frame_between(d, &from, &to, s);
  ambulo__surface_pull by = ambulo__surface_pull_of(p->s, p->row, p->pull, p->frame.origin);
  partials->ground_height += ambulo__dot(by.origin, d->model->up);
  return ambulo__surface_between(p->s, &from, &to, s, &by, partials) + add_room(p, s, partials);
}

/* 1 if the row is one of a gap between feet */
static int add_gap(const place_row *p, ambulo__partials *partials) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo__curved *curved = ambulo__row_curved_of(&problem->table, p->row);
  if (!curved || curved->form != AMBULO__CURVED_APART) return 0;
  double value = p->s->workspace->row_value[p->row - problem->table.rows];
  double by_distance = -p->pull * (1.0 + value / curved->of.apart.distance);
  partials->clearance.feet += by_distance;
  partials->duration +=
      by_distance * ambulo__passing_allowance(&problem->definition) / problem->definition.duration;
  return 1;
}

/* the surface under the swing, as contact/clearance.c has it */
static void add_clearance(place_row *p, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  ambulo__span air = ambulo__air_span(d, p->foot, p->row->time);
  double length = air.to - air.from;
  double s = length > 0.0 ? (p->row->time - air.from) / length : 0.0;
  double by_s =
      ambulo__contacts_are_level(d) ? add_track(p, s, partials) : add_way(p, &air, s, partials);
  if (length > 0.0) add_swing(p, s, &air, by_s, partials);
}

/* -------------------------------------------------------------- on a surface */

/* the contact whose axes a row has: of directions the one that ends at its node, of heights the one
 * that begins there; -1: the foot is in the air */
static int contact_of(const place_row *p) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo__gait_context context = {.definition = &problem->definition,
                                        .model = problem->model,
                                        .times = problem->times,
                                        .nodes = problem->nodes,
                                        .active = problem->active,
                                        .before = problem->before};
  int heights = p->row->kind == AMBULO__KIND_GROUND_PENETRATION, contact = -1;
  if (!heights && p->row->measure == AMBULO__METRES)
    return ambulo__stationary_contacts(p->s, p->row->node, p->row->before)[p->foot];
  ambulo__phases_of_foot phases =
      ambulo__phases_at(&context, AMBULO__OF_PLACES, p->row->node, p->foot);
  for (int i = 0; i < phases.count; i++)
    if (phases.contact[i] >= 0 && (heights || contact < 0)) contact = phases.contact[i];
  return contact;
}

/* above the lower one of two contacts (contact/swing.c) */
static void add_below(place_row *p, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  ambulo_contact from = {.foot = p->foot}, to = from;
  const ambulo_contact *below = ambulo__contact_of(d, p->foot, p->row->time);
  if (!below) {
    (void)ambulo__swing_contacts(d, p->foot, p->row->time, &from, &to);
    below = to.place[2] < from.place[2] ? &to : &from;
  }
  p->frame = ambulo__contact_frame_of(d, below);
  ambulo__surface_pull by = ambulo__surface_pull_of(p->s, p->row, p->pull, p->frame.origin);
  partials->ground_height += ambulo__dot(by.origin, d->model->up);
  ambulo__surface_of_image(p->s, below, &by, partials);
  if (below == &from && to.place[2] == from.place[2] && to.from != from.from) {
    ambulo__surface_unclear(p->s, &from, partials); /* which of the two is lower */
    ambulo__surface_unclear(p->s, &to, partials);
  }
}

static void add_surface(place_row *p, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  int contact = contact_of(p);
  if (contact < 0) {
    add_below(p, partials);
    return;
  }
  p->frame = ambulo__contact_frame_of(d, &d->contacts[contact]);
  ambulo__surface_pull by = ambulo__surface_pull_of(p->s, p->row, p->pull, p->frame.origin);
  partials->ground_height += ambulo__dot(by.origin, d->model->up);
  ambulo__surface_of_contact(p->s, contact, &by, partials);
}

/* ------------------------------------------------------- without a solution */

/* a row of a foot in the air that depends on heights: which have no partial */
static void name_row(const place_row *p, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  ambulo_contact from = {.foot = p->foot}, to = from;
  (void)ambulo__swing_contacts(d, p->foot, p->row->time, &from, &to);
  ambulo__step_row step = {.row = p->row, .from = &from, .to = &to};
  step.edges = ambulo__step_edges_between(d, p->foot, p->row->time, &from, &to);
  if (p->row->kind == AMBULO__KIND_CLEARANCE && step.edges.count > 0 &&
      ambulo__is_step_row(p->row)) {
    if (ambulo__step_is_unclear(&step)) ambulo__step_unclear(p->s, &step, partials);
  } else if (from.from != to.from && from.place[2] == to.place[2]) {
    ambulo__surface_unclear(p->s, &from, partials);
    ambulo__surface_unclear(p->s, &to, partials);
  }
}

void ambulo__partials_name_places(const ambulo_problem *problem, ambulo__partials *partials) {
  const ambulo__stationary s = {.problem = problem};
  if (ambulo__contacts_are_level(&problem->definition)) return;
  for (int r = 0; r < problem->rows; r++) {
    place_row p = {.s = &s, .row = &problem->table.rows[r]};
    int kind = p.row->kind;
    if ((kind != AMBULO__KIND_GROUND_PENETRATION && kind != AMBULO__KIND_CLEARANCE) ||
        !read_row(&p) || ambulo__dot(p.total, p.total) == 0.0)
      continue;
    if (kind == AMBULO__KIND_CLEARANCE || contact_of(&p) < 0) name_row(&p, partials);
  }
}

/* (S.2) -C.f, -C.l, -C.n */
void ambulo__partials_of_places(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *problem = s->problem;
  for (int r = 0; r < problem->rows; r++) {
    place_row p = {.s = s, .row = &problem->table.rows[r], .pull = -s->multiplier[r]};
    int kind = p.row->kind;
    int holds = kind == AMBULO__KIND_GROUND_PENETRATION || kind == AMBULO__KIND_FOOT_STRIKE ||
                kind == AMBULO__KIND_CONTACT || kind == AMBULO__KIND_CLEARANCE;
    if (!holds || p.pull == 0.0 || add_gap(&p, partials) || !read_row(&p)) continue;
    if (kind == AMBULO__KIND_CLEARANCE) {
      add_clearance(&p, partials);
      continue;
    }
    add_surface(&p, partials);
    int active = ambulo__stationary_contacts(s, p.row->node, p.row->before)[p.foot];
    if (kind == AMBULO__KIND_CONTACT && active >= 0)
      add_contact(&p, &problem->definition.contacts[active], partials);
  }
}
