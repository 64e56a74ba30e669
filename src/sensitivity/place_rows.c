/* sensitivity/place_rows.c - footholds, height of the ground and tolerances in the rows that hold
 * feet where they are due (gait/ground.c, foot_strike.c, contact_tube.c, clearance.c).
 *
 * Such a row is k + sum_j C_j . r_j >= 0 or = 0 on points r_j of one foot (world axes, m). It asks
 * for them relative to the foothold: to move the foothold and the ground by D is to move the
 * points by -D, whatever the row is about,
 *
 *     dc / d place_f = -C . f,    dc / d place_l = -C . l,    dc / d height = -C . n,    C = sum
 * C_j
 *
 * (directions of a foot have C = 0). Bounds b that widen the room of a row enter as +b:
 *
 *     contact tolerance, ceiling, turn, inward, outward   dc/db = 1
 *     orientation tolerance                               1, of yaw and roll on the toes 2
 *     strike pitch p_0, p_1                               -cos p_0, cos p_1
 *     clearance height H, of a point due at a low = a H   -low / H
 *
 * and a = part(s), half of it of the heel, has times: dc/ds = -H part'(s), s along the swing.
 */
#include "sensitivity/partials.h"
#include "base/vector.h"

#include "gait/gait.h"
#include "gait/loading.h"

#include <math.h>

typedef struct place_row {
  const ambulo__stationary *s;
  const ambulo__table_row *row;
  double pull;     /* -lambda */
  int foot, point; /* of the first term */
  double total[3]; /* C */
  double first[3]; /* of the first point alone */
} place_row;

static int has_point(const ambulo_foot *f, int point) {
  for (int side = 0; side < 2; side++)
    if (f->heel[side] == point || f->toe[side] == point) return 1;
  for (int end = 0; f->has_arcs && end < 2; end++)
    if (f->arc[end] == point) return 1;
  return f->heel_center == point || f->toe_center == point || (f->has_tip && f->tip == point);
}

/* of an arc that rolls: its centre against where the foothold has it */
static int read_arc(place_row *p, const ambulo__arc *arc, int origin) {
  const ambulo_model *model = p->s->problem->model;
  p->point = (arc->center - origin) / 3;
  for (int i = 0; i < 3; i++) p->total[i] = p->first[i] = arc->sign * arc->forward[i];
  for (p->foot = 0; p->foot < model->foot_count; p->foot++)
    if (has_point(&model->feet[p->foot], p->point)) return 1;
  return 0;
}

/* 0 when the row stands on no point of a foot */
static int read_row(place_row *p) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo_model *model = problem->model;
  const ambulo__row_term *term = problem->table.terms + p->row->first_term;
  int origin = ambulo__channel_point(&problem->channels, 0, 0);
  const ambulo__arc *arc = ambulo__row_arc_of(&problem->table, p->row);
  if (arc) return read_arc(p, arc, origin);
  if (p->row->term_count == 0) return 0;
  p->point = (term[0].channel - origin) / 3;
  for (int t = 0; t < p->row->term_count; t++) {
    int axis = (term[t].channel - origin) % 3;
    p->total[axis] += term[t].coefficient;
    if ((term[t].channel - origin) / 3 == p->point) p->first[axis] += term[t].coefficient;
  }
  for (p->foot = 0; p->foot < model->foot_count; p->foot++)
    if (has_point(&model->feet[p->foot], p->point)) return 1;
  return 0;
}

static void add_place(const place_row *p, int contact, ambulo__partials *partials) {
  const ambulo_model *model = p->s->problem->model;
  if (contact < 0) return;
  partials->place[2 * contact] -= p->pull * ambulo__dot(p->total, model->forward);
  partials->place[2 * contact + 1] -= p->pull * ambulo__dot(p->total, model->left);
}

static void add_pitch(const place_row *p, const ambulo_contact *contact,
                      ambulo__partials *partials) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo_problem_definition *d = &problem->definition;
  if (contact->mode == AMBULO_CONTACT_FLAT) partials->orientation_tolerance += p->pull;
  int strikes = contact->mode == AMBULO_CONTACT_HEEL && d->strike_pitch[0] < d->strike_pitch[1] &&
                ambulo__is_strike(d, contact->foot, problem->times, problem->nodes, p->row->node);
  if (!strikes) return;
  int is_upper = ambulo__dot(p->first, problem->model->up) < 0.0;
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
      fabs(ambulo__dot(p->first, model->up)) > fabs(ambulo__dot(p->first, model->left))) {
    add_pitch(p, contact, partials);
  } else {
    partials->orientation_tolerance += p->pull * (contact->mode == AMBULO_CONTACT_TOE ? 2.0 : 1.0);
  }
}

/* low = H' part(s), s = (t - from) / (to - from) of the swing */
static void add_swing(const place_row *p, ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->s->problem->definition;
  ambulo__span air = ambulo__air_span(d, p->foot, p->row->time);
  double length = air.to - air.from, slope;
  if (!(length > 0.0)) return;
  double s = (p->row->time - air.from) / length;
  (void)ambulo__clearance_part(s, &slope);
  int is_heel = p->point == p->s->problem->model->feet[p->foot].heel_center;
  double pull = -p->pull * (is_heel ? 0.5 : 1.0) * d->clearance.height * slope / length;
  partials->node_time[p->row->node] += pull;
  if (air.begins >= 0) partials->contact_time[2 * air.begins + 1] -= pull * (1.0 - s);
  if (air.ends >= 0) partials->contact_time[2 * air.ends] -= pull * s;
}

static void add_clearance(const place_row *p, ambulo__partials *partials) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo_problem_definition *d = &problem->definition;
  double up = ambulo__dot(p->total, problem->model->up),
         left = ambulo__dot(p->total, problem->model->left);
  ambulo_clearance *c = &partials->clearance;
  if (p->row->measure != AMBULO__METRES) {
    c->turn += p->pull;
  } else if (fabs(up) > fabs(left) && up < 0.0) {
    c->ceiling += p->pull;
  } else if (fabs(up) > fabs(left)) {
    double low = -p->row->constant - d->ground_height;
    if (d->clearance.height > 0.0) c->height -= p->pull * low / d->clearance.height;
    add_swing(p, partials);
  } else {
    int is_left;
    int contact = ambulo__swing_track(d, p->foot, p->row->time, &is_left);
    double *room = (left > 0.0) == is_left ? &c->inward : &c->outward;
    *room += p->pull;
    add_place(p, contact, partials);
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
    if (!holds || p.pull == 0.0 || !read_row(&p)) continue;
    partials->ground_height -= p.pull * ambulo__dot(p.total, problem->model->up);
    int active = ambulo__stationary_contacts(s, p.row->node, p.row->before)[p.foot];
    if (kind == AMBULO__KIND_CLEARANCE) {
      add_clearance(&p, partials);
    } else {
      add_place(&p, active, partials);
    }
    if (kind == AMBULO__KIND_CONTACT && active >= 0)
      add_contact(&p, &problem->definition.contacts[active], partials);
  }
}
