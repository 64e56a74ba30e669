/* contact/clearance.c - a foot in the air clears the ground and stays in its track ("clearance").
 *
 * With s from 0 at toe-off to 1 at the next strike (contact/contacts.h) and h the clearance height,
 *
 *     c = h min(1, 4 s, 6 (1 - s))
 *     ball >= c,   heel >= c / 2,   tip >= c where s >= tip_from,   all <= ceiling     m
 *     |yaw|, |roll| <= turn                                                             rad
 *     of a point foot its height >= c alone
 *     heel at most `outward` beside its next foothold, `inward` towards the other foot  m
 *
 * heights above the surface under the swing (contact/contacts.h); yaw, roll and track against
 * its axes. On the way to a higher or lower step (contact/schedule.h) instead, up
 *
 *     to the first edge      above the foothold it leaves; tip and ball behind the riser    m
 *     over the edges         above the plane over them
 *     past the last one      above its next foothold
 *
 * and down the same way back, the heel beyond the riser; all <= the upper foothold + ceiling. What
 * comes before and after an edge both hold where the foot comes to it, which is an event: no point
 * of it is on the other side of an edge without having passed over.
 *
 * A rigid foot turns about its ball at push-off, and its tip dips where people's toes bend:
 * asking the tip to clear at once forces a jump. Likewise where the foot comes down on its toes: on
 * the way down, c falling, the tip has to be over c - D (1 - c / h) only, D how far it is ahead of
 * the ball. The ball is the toe centre, or the corner ahead.
 */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "contact/schedule.h"
#include "model/neutral_pose.h"

#include <math.h>

typedef struct swing {
  const ambulo__gait_context *context;
  int node, foot;
  double phase; /* s */
  int tip;      /* 1: it has to clear */
  ambulo__step_edges edges;
  int climbs;          /* to a higher foothold */
  int part[3];         /* of its way past edges: before the first, over them, past the last */
  double origin, next; /* heights of the foothold that it leaves and of its next one, m */
  ambulo__contact_frame surface;
  ambulo__row_table *table;
} swing;

/* low <= direction . r - origin <= high */
static void point_bounds(const swing *w, int point, const double direction[3], double origin,
                         const char *lower, const char *upper, double low, double high) {
  const ambulo__gait_context *context = w->context;
  ambulo__linear form = {.constant = -origin};
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, point, 0), direction, 1.0);
  ambulo__bounded_name name = {AMBULO__KIND_CLEARANCE, context->model->points[point].name, lower,
                               upper, AMBULO__METRES};
  ambulo__bounded_rows(context, w->node, &name, &form, low, high, w->table);
}

/* of a foot that passes the edges of steps */
static void step_bounds(const swing *w, int point, int clears, double low) {
  const ambulo_model *m = w->context->model;
  const ambulo__step_edges *e = &w->edges;
  int is_heel = point == m->feet[w->foot].heel_center, beside = w->climbs ? 0 : 2;
  if (w->part[beside] && is_heel != w->climbs)
    point_bounds(w, point, e->ahead, e->riser, "behind the edge", "beyond the edge",
                 w->climbs ? -INFINITY : 0.0, w->climbs ? 0.0 : INFINITY);
  if (w->part[0] && clears) point_bounds(w, point, m->up, w->origin, "low", "high", low, INFINITY);
  if (w->part[1])
    point_bounds(w, point, e->above, e->height, "low over the edge", "high", low, INFINITY);
  if (w->part[2] && clears) point_bounds(w, point, m->up, w->next, "low", "high", low, INFINITY);
  point_bounds(w, point, m->up, fmax(w->origin, w->next), "low", "high", -INFINITY,
               w->context->definition->clearance.ceiling);
}

static void height_bounds(const swing *w, int point, int clears, double low) {
  const ambulo__contact_frame *s = &w->surface;
  if (w->edges.count > 0) {
    step_bounds(w, point, clears, low);
  } else if (clears) {
    double origin = 0.0;
    for (int i = 0; i < 3; i++) origin += s->up[i] * s->origin[i];
    point_bounds(w, point, s->up, origin, "low", "high", low,
                 w->context->definition->clearance.ceiling);
  }
}

static void turn_bounds(const swing *w, const ambulo__linear *form, const char *lower,
                        const char *upper) {
  if (form->count == 0) return;
  double turn = w->context->definition->clearance.turn;
  ambulo__bounded_name name = {AMBULO__KIND_CLEARANCE, w->context->model->feet[w->foot].name, lower,
                               upper, AMBULO__RADIANS};
  ambulo__bounded_rows(w->context, w->node, &name, form, -turn, turn, w->table);
}

static int nearest_contact(const ambulo_problem_definition *d, int foot, double time) {
  double nearest = INFINITY;
  int contact = -1;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (c->foot != foot) continue;
    double wait = c->from >= time ? c->from - time : d->duration + time - c->from;
    if (wait >= nearest) continue;
    nearest = wait;
    contact = i;
  }
  return contact;
}

int ambulo__swing_track(const ambulo_problem_definition *d, int foot, double time, int *is_left) {
  int contact = nearest_contact(d, foot, time);
  int other = d->model->foot_count == 2 ? nearest_contact(d, 1 - foot, time) : -1;
  double track = contact < 0 ? 0.0 : d->contacts[contact].place[1];
  *is_left = track >= 0.0;
  if (other >= 0 && d->contacts[other].place[1] != track)
    *is_left = track > d->contacts[other].place[1];
  return contact;
}

static void track_bounds(const swing *w) {
  const ambulo__gait_context *context = w->context;
  const ambulo_problem_definition *d = context->definition;
  const ambulo_clearance *c = &d->clearance;
  int heel = context->model->feet[w->foot].heel_center, is_left;
  int contact = ambulo__swing_track(d, w->foot, context->times[w->node], &is_left);
  if (contact < 0) return;
  const ambulo__contact_frame *s = &w->surface;
  ambulo__linear form = {.constant = 0.0};
  for (int i = 0; i < 3; i++) form.constant -= s->left[i] * s->origin[i];
  ambulo__linear_add(&form, ambulo__channel_point(&context->channels, heel, 0), s->left, 1.0);
  ambulo__bounded_name name = {AMBULO__KIND_CLEARANCE, context->model->points[heel].name,
                               "to the right", "to the left", AMBULO__METRES};
  ambulo__bounded_rows(context, w->node, &name, &form, is_left ? -c->inward : -c->outward,
                       is_left ? c->outward : c->inward, w->table);
}

double ambulo__clearance_part(double s, double *slope) {
  double rise = 4.0 * s, fall = 6.0 * (1.0 - s), part = fmin(1.0, fmin(rise, fall));
  if (slope) *slope = part == rise ? 4.0 : part == fall ? -6.0 : 0.0;
  return fmax(0.0, part);
}

/* the contact with which a swing ends, at the end of a motion that does not repeat, too; -1: none
 */
static int landing_of(const ambulo_problem_definition *d, int foot, ambulo__span air) {
  for (int i = 0; air.ends < 0 && i < d->contact_count; i++)
    if (d->contacts[i].foot == foot && d->contacts[i].from >= air.to - AMBULO__INSTANT) return i;
  return air.ends;
}

double ambulo__tip_drop(const ambulo_problem_definition *d, int foot, double time, double s) {
  ambulo__span air = ambulo__air_span(d, foot, time);
  const ambulo_foot *f = &d->model->feet[foot];
  double slope, tip[3], ball[3], square = 0.0;
  (void)ambulo__clearance_part(s, &slope);
  int lands = air.to - air.from <= AMBULO__INSTANT; /* where the motion ends */
  int landing = landing_of(d, foot, air);
  if ((slope >= 0.0 && !lands) || !f->has_tip || landing < 0) return 0.0;
  if (!ambulo__mode_is_on_toes(d->contacts[landing].mode) || !ambulo__contacts_are_level(d))
    return 0.0;
  ambulo__neutral_point(d->model, f->tip, tip);
  ambulo__neutral_point(d->model, f->toe_center, ball);
  for (int i = 0; i < 3; i++) square += (tip[i] - ball[i]) * (tip[i] - ball[i]);
  return sqrt(square);
}

static void swing_rows(const swing *w) {
  const ambulo_clearance *c = &w->context->definition->clearance;
  const ambulo_foot *foot = &w->context->model->feet[w->foot];
  const ambulo__gait_context *context = w->context;
  double part = ambulo__clearance_part(w->phase, NULL), low = c->height * part;
  double drop = ambulo__tip_drop(context->definition, w->foot, context->times[w->node], w->phase);
  ambulo__foot_outline outline = ambulo__foot_outline_of(w->context->model, w->foot);
  if (!outline.is_point) height_bounds(w, foot->heel_center, 1, 0.5 * low);
  height_bounds(w, foot->toe_center, 1, low);
  if (foot->has_tip) height_bounds(w, foot->tip, w->tip, low - drop * (1.0 - part));
  if (!outline.moves_sideways) return;
  if (!outline.is_point) {
    ambulo__linear yaw = ambulo__foot_yaw(w->context, w->foot, w->surface.left);
    ambulo__linear roll = ambulo__foot_roll(w->context, w->foot, w->surface.up);
    turn_bounds(w, &yaw, "turned right", "turned left");
    turn_bounds(w, &roll, "left side low", "left side high");
  }
  track_bounds(w);
}

/* over level ground along the track of the next foothold; else between the contacts */
static void set_surface(swing *w, ambulo__span air, double time) {
  const ambulo_problem_definition *d = w->context->definition;
  ambulo_contact from = {.foot = w->foot}, to = from;
  if (!ambulo__contacts_are_level(d)) {
    (void)ambulo__swing_contacts(d, w->foot, time, &from, &to);
    w->surface = ambulo__contact_frame_between(d, &from, &to, w->phase);
    w->edges = ambulo__step_edges_between(d, w->foot, time, &from, &to);
    w->climbs = to.place[2] > from.place[2];
    w->origin = d->ground_height + from.place[2];
    w->next = d->ground_height + to.place[2];
    double first = ambulo__step_edge_time(air, &from, &to, 0);
    double last = ambulo__step_edge_time(air, &from, &to, 1);
    w->part[0] = time <= first + AMBULO__INSTANT;
    w->part[1] = time >= first - AMBULO__INSTANT && time <= last + AMBULO__INSTANT;
    w->part[2] = time >= last - AMBULO__INSTANT;
    return;
  }
  int is_left, contact = ambulo__swing_track(d, w->foot, time, &is_left);
  if (contact >= 0) to.place[1] = d->contacts[contact].place[1];
  w->surface = ambulo__contact_frame_of(d, &to);
}

/* at a node, up to both ends of the swing */
static swing swing_at(const ambulo__gait_context *context, int node, int foot,
                      ambulo__row_table *table) {
  double time = context->times[node];
  ambulo__span air = ambulo__air_span(context->definition, foot, time);
  double length = air.to - air.from, tip_from = context->definition->clearance.tip_from;
  swing w = {.context = context, .node = node, .foot = foot, .table = table};
  w.phase = length > 0.0 ? (time - air.from) / length : 0.0;
  set_surface(&w, air, time);
  w.tip = time >= air.from + tip_from * length - AMBULO__INSTANT;
  return w;
}

/* (14.e) n.r - h of a foot in the air, at least its clearance */
void ambulo__clearance_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  int feet = context->model->foot_count;
  for (int node = 0; node < context->nodes; node++) {
    for (int foot = 0; foot < feet; foot++) {
      ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_PLACES, node, foot);
      for (int i = 0; i < phases.count; i++) {
        if (phases.contact[i] >= 0) continue;
        swing w = swing_at(context, node, foot, table);
        table->before = ambulo__phase_is_before(context, i);
        swing_rows(&w);
      }
    }
  }
  table->before = 0;
}

/* a foot in the air passes beside the others ("clearance").
 *
 * Seen from above, a foot is what is within half its largest width w of the line from its heel
 * centre to its toe centre: about the sole, whose tip is narrower. While one of two feet is in the
 * air, they keep a gap,
 *
 *     heel and toe centre of either at least D = w_1 + w_2 + feet + m from the line of the other m
 *
 * (contact/curved.h). Lines that do not cross are nearest at an end of one of them: these four rows
 * are the whole distance, and each is smooth where the least of all is not, for feet that pass are
 * next to parallel. Seen from above, since over a foot there is its leg: also where feet are on
 * steps of unlike height they have to pass beside each other.
 *
 * Lines at an angle a that pass at the speed v come nearer between two nodes than at them, by
 * v h tan(a / 2) / 2 where a corner falls in the middle. That is m, with a = .2 rad, v = 5 m/s (a
 * walk's peaks, of 1.75 m; v goes with the root of the stature) and h = T / N; on a fine grid it
 * vanishes, and what is then missed it shows.
 */

static const double passing = 0.25; /* v tan(a / 2) / 2, m/s */

/* m */
static double half_width(const ambulo__foot_outline *outline) {
  double half = 0.0;
  for (int c = 0; c < outline->count; c++) half = fmax(half, fabs(outline->place[c][1]));
  return half;
}

double ambulo__passing_allowance(const ambulo_problem_definition *d) {
  return passing * sqrt(ambulo__model_size(d->model)) * d->duration / d->intervals;
}

/* D; 0 of feet that move in one plane */
static double distance(const ambulo__gait_context *context, int foot, int other) {
  ambulo__foot_outline one = ambulo__foot_outline_of(context->model, foot);
  ambulo__foot_outline two = ambulo__foot_outline_of(context->model, other);
  if (!one.moves_sideways || !two.moves_sideways) return 0.0;
  return half_width(&one) + half_width(&two) + context->definition->clearance.feet +
         ambulo__passing_allowance(context->definition);
}

/* 1 if a foot is in the air at a node, or comes there or leaves there; *before: until it */
static int is_in_the_air(const ambulo__gait_context *context, int node, int foot, int *before) {
  int found = 0;
  ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_PLACES, node, foot);
  for (int i = 0; i < phases.count; i++) {
    if (phases.contact[i] >= 0) continue;
    *before = ambulo__phase_is_before(context, i);
    found = 1;
  }
  return found;
}

/* both ends of `foot` from the line of `other` */
static void end_rows(const ambulo__gait_context *context, int node, int foot, int other,
                     double apart, ambulo__row_table *table) {
  const ambulo_model *m = context->model;
  const ambulo_foot *line = &m->feet[other];
  int end[2] = {m->feet[foot].heel_center, m->feet[foot].toe_center};
  ambulo__apart row = {.distance = apart,
                       .from = ambulo__channel_point(&context->channels, line->heel_center, 0),
                       .to = ambulo__channel_point(&context->channels, line->toe_center, 0)};
  for (int i = 0; i < 3; i++) row.up[i] = m->up[i];
  for (int i = 0; i < 2; i++) {
    row.point = ambulo__channel_point(&context->channels, end[i], 0);
    ambulo__row_apart(table, AMBULO__KIND_CLEARANCE, m->points[end[i]].name, "near the other foot",
                      node, context->times[node], &row);
  }
}

static void pair_rows(const ambulo__gait_context *context, int foot, int other,
                      ambulo__row_table *table) {
  double apart = distance(context, foot, other);
  for (int node = 0; node < context->nodes && apart > 0.0; node++) {
    int before = 0;
    if (!is_in_the_air(context, node, foot, &before) &&
        !is_in_the_air(context, node, other, &before))
      continue;
    table->before = before;
    end_rows(context, node, foot, other, apart, table);
    end_rows(context, node, other, foot, apart, table);
  }
  table->before = 0;
}

/* (14.g) of every pair of feet */
void ambulo__feet_apart_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  if (isnan(context->definition->clearance.feet)) return;
  for (int foot = 0; foot < context->model->foot_count; foot++)
    for (int other = foot + 1; other < context->model->foot_count; other++)
      pair_rows(context, foot, other, table);
}
