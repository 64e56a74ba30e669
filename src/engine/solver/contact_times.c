/* solver/contact_times.c - weight, centre, patch and greatest force of a contact by the times
 * that they are made of (contact/contact_load.c, in its letters).
 *
 *     S(u), u = (t - a) / (b - a)    dS = S' (dt - (1 - u) da - u db) / (b - a),  S' = 6 u (1 - u)
 *     progress u under the heel      du = (dt - (1 - u) da - u db) / (b - a)
 *     g(s), s = t - b or e - t       dg = g' ds
 *
 * a, b are times at which contacts begin or end, or part of the way between two of these. Of a flat
 * foot that comes from h and goes on to k (0 heel, 1/2 flat or nothing, 1 toes), by S_h once it is
 * flat and by S_k before it is not any more:
 *
 *     roll       r = 1/2 - (1/2 - h) (1 - S_h) + (k - 1/2) S_k
 *     centre     x = r (L + a);  of the rear part min(r, 1/2) L, of the fore part L + a
 *     rear part  w (S_h if h > 1/2) (1 - S_k if k > 1/2)
 *     fore part  w (S_h if h < 1/2) (1 - S_k if k < 1/2)
 *
 * Heel and toes have neither: centres under them stand still.
 */
#include "solver/contact_pull.h"

#include "base/arithmetic.h"
#include "contact/stance.h"

#include <math.h>

/* between two times, `part` of the way from the first to the second */
typedef struct moment {
  double first, second, part;
} moment;

typedef struct timed {
  const ambulo_problem_definition *d;
  ambulo__partials *partials;
  const ambulo__contact_load *load;
  const ambulo_contact *contact;
  ambulo__stance stance;
  ambulo__slot_part part;
  double length, time; /* of the foot, m; of the node */
  int node;
} timed;

static moment at(double time) {
  return (moment){time, time, 0.5};
}

static double value_of(moment m) {
  return m.first + m.part * (m.second - m.first);
}

/* to a contact that begins or ends then, in this or another period */
static void add_time(const timed *t, double time, double pull) {
  double period = t->d->duration;
  if (!isfinite(time)) return;
  for (int i = 0; i < 2 * t->d->contact_count; i++) {
    const ambulo_contact *c = &t->d->contacts[i / 2];
    double since = (i % 2 ? c->to : c->from) - time;
    if (fabs(since - period * round(since / period)) > AMBULO__INSTANT) continue;
    t->partials->contact_time[i] += pull;
    return;
  }
}

static void add_moment(const timed *t, moment m, double pull) {
  add_time(t, m.first, (1.0 - m.part) * pull);
  add_time(t, m.second, m.part * pull);
}

/* of u between two moments */
static void add_progress(const timed *t, moment from, moment to, double pull) {
  double a = value_of(from), b = value_of(to), u = (t->time - a) / (b - a);
  pull /= b - a;
  t->partials->node_time[t->node] += pull;
  add_moment(t, from, -(1.0 - u) * pull);
  add_moment(t, to, -u * pull);
}

/* S(u) between two moments; 1 where there is nothing between them */
static double ramp(const timed *t, moment from, moment to) {
  double a = value_of(from), b = value_of(to);
  return b - a > AMBULO__INSTANT ? ambulo__smooth_step((t->time - a) / (b - a)) : 1.0;
}

static void add_ramp(const timed *t, moment from, moment to, double pull) {
  double a = value_of(from), b = value_of(to), u = (t->time - a) / (b - a);
  if (b - a > AMBULO__INSTANT && u > 0.0 && u < 1.0)
    add_progress(t, from, to, 6.0 * u * (1.0 - u) * pull);
}

/* half of a stance that is cut at 0 or T: that end does not move */
static moment half_of(const timed *t) {
  const ambulo__stance *s = &t->stance;
  return (moment){isfinite(s->from) ? s->from : 0.0, isfinite(s->to) ? s->to : t->d->duration, 0.5};
}

static moment leaves_of(const timed *t) {
  return t->stance.leaves_half_way ? half_of(t) : at(t->stance.leaves);
}

static moment comes_of(const timed *t) {
  return t->stance.comes_half_way ? half_of(t) : at(t->stance.comes);
}

/* ---------------------------------------------------------------------- roll */

/* of a flat foot; S_h, S_k and the moments between which they rise */
typedef struct roll {
  moment from, settled, leaving, to;
  double on, off, before, after; /* h, k */
} roll;

static double place_of(int mode) {
  return mode == (int)AMBULO_CONTACT_HEEL ? 0.0 : mode == (int)AMBULO_CONTACT_TOE ? 1.0 : 0.5;
}

static roll roll_of(const timed *t) {
  const ambulo__stance *s = &t->stance;
  ambulo__span flat = s->phase;
  const double least = AMBULO__SHORTEST_GLIDE;
  moment middle = {flat.from, flat.to, 0.5}, earliest = {flat.from, flat.to, least},
         latest = {flat.from, flat.to, 1.0 - least};
  roll r = {at(flat.from), middle, middle, at(flat.to), 0.0, 0.0, 0.0, 0.0};
  if (s->leaves > flat.from && s->leaves < flat.to) r.settled = leaves_of(t);
  if (s->comes > flat.from && s->comes < flat.to) r.leaving = comes_of(t);
  if (value_of(r.settled) < value_of(earliest)) r.settled = earliest;
  if (value_of(r.leaving) > value_of(latest)) r.leaving = latest;
  if (value_of(r.leaving) < value_of(r.settled)) r.settled = r.leaving = middle;
  r.on = ramp(t, r.from, r.settled);
  r.off = ramp(t, r.leaving, r.to);
  r.before = place_of(s->before);
  r.after = place_of(s->after);
  return r;
}

static void add_roll(const timed *t, const roll *r, double by_on, double by_off) {
  add_ramp(t, r->from, r->settled, by_on);
  add_ramp(t, r->leaving, r->to, by_off);
}

/* the part's share of the weight; adds `pull` times its times */
static double add_part(const timed *t, double pull) {
  double side = t->part == AMBULO__REAR_FOOT ? 1.0 : -1.0;
  if (t->part == AMBULO__WHOLE_FOOT || t->contact->mode != AMBULO_CONTACT_FLAT) return 1.0;
  roll r = roll_of(t);
  int comes = side * (r.before - 0.5) > 0.0, goes = side * (r.after - 0.5) > 0.0;
  double on = comes ? r.on : 1.0, stays = goes ? 1.0 - r.off : 1.0;
  add_roll(t, &r, comes ? pull * stays : 0.0, goes ? -pull * on : 0.0);
  return on * stays;
}

static void add_center(const timed *t, double pull) {
  if (t->contact->mode != AMBULO_CONTACT_FLAT || t->part == AMBULO__FORE_FOOT) return;
  roll r = roll_of(t);
  double reach =
      t->length +
      (t->part == AMBULO__WHOLE_FOOT ? AMBULO__BEYOND_BALL * ambulo__model_size(t->d->model) : 0.0);
  double along = 0.5 - (0.5 - r.before) * (1.0 - r.on) + (r.after - 0.5) * r.off;
  if (t->part == AMBULO__REAR_FOOT && along >= 0.5) return;
  add_roll(t, &r, reach * pull * (0.5 - r.before), reach * pull * (r.after - 0.5));
}

/* -------------------------------------------------------------------- weight */

static void add_weight(const timed *t, double pull) {
  const ambulo__stance *s = &t->stance;
  int has_begin = isfinite(s->leaves), has_end = isfinite(s->comes);
  moment leaves = leaves_of(t), comes = comes_of(t), from = at(s->from), to = at(s->to);
  double rising = has_begin ? ramp(t, from, leaves) : 1.0;
  double falling = has_end ? 1.0 - ramp(t, comes, to) : 1.0;
  double part = add_part(t, pull * rising * falling);
  if (has_begin) add_ramp(t, from, leaves, pull * part * falling);
  if (has_end) add_ramp(t, comes, to, -pull * part * rising);
}

static void add_front(const timed *t, double pull) {
  double rolling = t->contact->to - t->stance.from;
  if (t->contact->mode != AMBULO_CONTACT_HEEL || !(rolling > 0.0 && isfinite(rolling))) return;
  add_progress(t, at(t->stance.from), at(t->contact->to), pull * t->d->ground_reaction.heel_roll);
}

/* s since the contact came down or until it leaves */
static void add_most(const timed *t, double pull) {
  int ends = t->load->until < t->load->since;
  double s = ends ? t->load->until : t->load->since;
  if (!isfinite(s) || s <= 0.0) return;
  double slope = pull * t->load->most_by_time / s;
  t->partials->node_time[t->node] += ends ? -slope : slope;
  add_time(t, ends ? t->time + s : t->time - s, ends ? slope : -slope);
}

/* (S.17) S' (dt - (1 - u) da - u db) / (b - a), g' ds */
void ambulo__partials_of_load(const ambulo__stationary *s, const ambulo__timed_contact *timed_one,
                              const ambulo__load_pull *by, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  const ambulo_contact *c = &p->definition.contacts[timed_one->contact];
  timed t = {.d = &p->definition,
             .partials = partials,
             .load = &timed_one->load,
             .contact = c,
             .part = timed_one->part,
             .length = ambulo__foot_outline_of(p->model, c->foot).length,
             .time = p->times[timed_one->node],
             .node = timed_one->node};
  if (!p->before) return; /* events have no derivative on other grids */
  t.stance = ambulo__stance_of(&p->definition, c);
  if (by->weight != 0.0) add_weight(&t, by->weight);
  if (by->center != 0.0) add_center(&t, by->center);
  if (by->front != 0.0) add_front(&t, by->front);
  if (by->most != 0.0) add_most(&t, by->most);
}
