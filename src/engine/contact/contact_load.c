/* contact/contact_load.c - see stance.h. */
#include "contact/contacts.h"

#include "base/arithmetic.h"
#include "model/model.h"

#include <math.h>

/* without beginning or end where the motion is cut, or the foot is down all the time */
static ambulo__span opened(const ambulo_problem_definition *d, ambulo__span span) {
  if (d->ends == AMBULO_ENDS_FREE) {
    if (span.from <= AMBULO__INSTANT) span.from = -INFINITY;
    if (span.to >= d->duration - AMBULO__INSTANT) span.to = INFINITY;
    return span;
  }
  double stride = (d->ends == AMBULO_ENDS_MIRRORED ? 2.0 : 1.0) * d->duration;
  if (span.to - span.from < stride - AMBULO__INSTANT) return span;
  return (ambulo__span){-INFINITY, INFINITY, -1, -1};
}

/* `other`, of another foot or patch, may hold where the stance begins or ends */
static void meet(ambulo__stance *s, double middle, ambulo__span other) {
  int at_begin = other.from < s->from - AMBULO__INSTANT && other.to > s->from + AMBULO__INSTANT;
  int at_end = other.to > s->to + AMBULO__INSTANT && other.from < s->to - AMBULO__INSTANT;
  double leaves = other.to < s->to ? other.to : middle;
  double comes = other.from > s->from ? other.from : middle;
  if (at_begin && (s->leaves == -INFINITY || leaves < s->leaves)) {
    s->leaves = leaves;
    s->leaves_half_way = !(other.to < s->to);
  }
  if (at_end && (s->comes == INFINITY || comes > s->comes)) {
    s->comes = comes;
    s->comes_half_way = !(other.from > s->from);
  }
}

static int touches(ambulo__span span, double time) {
  return span.from <= time + AMBULO__INSTANT && span.to >= time - AMBULO__INSTANT;
}

static void meet_others(const ambulo_problem_definition *d, int effector, double middle,
                        ambulo__stance *s) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo__span span = ambulo__image_span(d, i, period);
      int other = ambulo__image_effector(d, i, period);
      if (other == effector || (!touches(span, s->from) && !touches(span, s->to))) continue;
      meet(s, middle, opened(d, ambulo__uninterrupted(d, other, AMBULO__ANY_MODE, span)));
    }
  }
}

/* mode of the part that ends where the phase begins, or begins where it ends; -1. A contact
 * that begins with the next period has no length at T. */
static int mode_beside(const ambulo_problem_definition *d, int effector, ambulo__span phase,
                       int after) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo__span s = ambulo__image_span(d, i, period);
      double apart = after ? s.from - phase.to : s.to - phase.from;
      if (ambulo__image_effector(d, i, period) == effector && fabs(apart) <= AMBULO__INSTANT &&
          s.to - s.from > AMBULO__INSTANT)
        return (int)d->contacts[i].mode;
    }
  }
  return -1;
}

ambulo__span ambulo__stance_in(const ambulo_problem_definition *d, const ambulo_contact *contact,
                               int modes) {
  ambulo__span own = {.from = contact->from, .to = contact->to};
  return opened(d, ambulo__uninterrupted(d, ambulo__effector_of(d->model, contact), modes, own));
}

ambulo__stance ambulo__stance_of(const ambulo_problem_definition *d,
                                 const ambulo_contact *contact) {
  int effector = ambulo__effector_of(d->model, contact);
  ambulo__span own = {.from = contact->from, .to = contact->to};
  ambulo__span whole = ambulo__uninterrupted(d, effector, AMBULO__ANY_MODE, own);
  ambulo__span open = opened(d, whole);
  ambulo__stance s = {.from = open.from, .to = open.to, .leaves = -INFINITY, .comes = INFINITY};
  s.phase = ambulo__uninterrupted(d, effector, 1 << contact->mode, own);
  s.before = mode_beside(d, effector, s.phase, 0);
  s.after = mode_beside(d, effector, s.phase, 1);
  meet_others(d, effector, 0.5 * (whole.from + whole.to), &s);
  return s;
}

/* weight, centre, region of pressure and greatest force of a contact
 * (contact_load.h).
 *
 * A stance is the uninterrupted time [b, e] that a foot or a patch is down, in a motion that
 * repeats beyond the ends; one that begins at 0 or ends at T of a motion that does not has no
 * beginning or end. S(u) = u^2 (3 - 2 u), u cut to [0, 1].
 *
 * Weight. Over the time that the stance shares with those that were there before it, and with
 * those that stay:
 *
 *     w = S((t - b) / (b' - b)) S((e - t) / (e - e'))
 *     b' = earliest end of the stances of other feet and patches that hold at b (none: no such
 * factor) e' = latest beginning of those that hold at e
 *
 * A neighbour that outlasts the stance on that side gives half the stance, and a stance of no
 * length (a strike where the motion ends) carries nothing.
 *
 * Roll r, from 0 on the heel to 1 on the toes. A flat foot is at 1/2; it comes there from where it
 * was, by S, once it is flat and until the neighbour has left (b'), and goes on to where it will be
 * from when the next one is there (e') until it is not flat any more, either over a sixteenth of
 * the flat time at least: else a foot that leaves just after this one has come to be flat has the
 * centre jump while both are loaded. Half of the flat time each where there is no such event in it;
 * a roll from heel to toes without a flat foot is a jump.
 *
 * Centre, ahead of the heel's foothold, with L from heel to toe centre (ball): r (L + a),
 * a = 0.02 m for 1.75 m; of a point foot its point. What a single contact carries does not depend
 * on its centre.
 *
 * A foot with arcs, their centres at h and t where it is flat: h + r (t - h), and where it rolls on
 * one of radius R, where that touches at a usual pitch, with u the part of the time on it that is
 * over: h - R theta, t + R theta,
 *
 *     theta = theta_d (1 - u)^2 if the foot comes down on it, + theta_l u^2 if it leaves from it
 *
 * Were it elsewhere, pressure under the arc would take moments that the law does not give, but for
 * motions that are bent to it: with t + a walks cost 3 % more, and twice the iterations.
 *
 * A foot with a joint between heel and ball has two contacts, which share its weight w: the rear
 * one has w until the foot rolls on from flat to the toes, and passes it away by that S; its centre
 * is at min(r, 1/2) L. The fore one gets w as the foot rolls from the heel to flat; its centre is
 * at L + a. Likewise backwards.
 *
 * A patch does not roll: its centre is its place, and pressure is within its size about that.
 *
 * Greatest normal force, body weights:
 *
 *     g(min(t - b, e - t)),   g(s) = rho (s - tau (1 - exp(-s / tau)))
 *
 * [b, e] now the time that the contact is down, with the loading rate rho and tau = 6.5 ms
 * (for 1.75 m) over which it sets in: a force that began with its full rate would have a corner,
 * which nodes do not follow and which rings.
 */

static const double loading_onset =
    0.0065; /* s: tau; from 0 rms above 15 Hz doubles; with .01 a front foot has .15 of the load at
               2 % of the stride, people .25 */

/* -------------------------------------------------------------------- slots */

static void add_slot(ambulo__slots *s, int effector, int link, ambulo__slot_part part) {
  int i = s->count++;
  if (i >= AMBULO__MOST_SLOTS) return;
  s->effector[i] = effector;
  s->link[i] = link;
  s->part[i] = (int)part;
}

ambulo__slots ambulo__slots_of(const ambulo_problem_definition *d) {
  const ambulo_model *m = d->model;
  ambulo__slots s = {.all_points = m->foot_count > 0};
  for (int fore = 0; fore < 2; fore++) {
    for (int f = 0; f < m->foot_count; f++) {
      int heel = m->points[m->feet[f].heel_center].link,
          toe = m->points[m->feet[f].toe_center].link;
      s.all_points &= ambulo__foot_is_point(&m->feet[f]);
      if (!fore) add_slot(&s, f, heel, heel == toe ? AMBULO__WHOLE_FOOT : AMBULO__REAR_FOOT);
      if (fore && heel != toe) add_slot(&s, f, toe, AMBULO__FORE_FOOT);
    }
  }
  for (int i = 0; i < m->patch_count; i++)
    if (ambulo__patch_is_used(d, i)) {
      add_slot(&s, m->foot_count + i, m->points[m->patches[i].point].link, AMBULO__WHOLE_PATCH);
      s.all_points = 0;
    }
  return s;
}

const char *ambulo__slot_name(const ambulo_model *m, const ambulo__slots *slots, int slot) {
  int effector = slots->effector[slot], part = slots->part[slot];
  if (part == (int)AMBULO__WHOLE_FOOT || part == (int)AMBULO__WHOLE_PATCH)
    return ambulo__effector_name(m, effector);
  const ambulo_foot *foot = &m->feet[effector];
  int point = part == (int)AMBULO__REAR_FOOT ? foot->heel_center : foot->toe_center;
  return m->points[point].name;
}

/* -------------------------------------------------------------------- weight */

static double ramp(double time, double from, double to) {
  return to - from > AMBULO__INSTANT ? ambulo__smooth_step((time - from) / (to - from)) : 1.0;
}

/* a foot that strikes where the motion ends has not begun to carry */
static double weight_of(const ambulo__stance *s, double time) {
  double weight = 1.0;
  if (isfinite(s->leaves))
    weight *= s->leaves - s->from > AMBULO__INSTANT ? ramp(time, s->from, s->leaves) : 0.0;
  if (isfinite(s->comes)) weight *= 1.0 - ramp(time, s->comes, s->to);
  return weight;
}

/* ---------------------------------------------------------------------- roll */

/* Where between heel (0) and toes (1) a foot is, and what of its weight either part of it has. */
typedef struct roll {
  double along, rear, fore;
} roll;

static double place_of(int mode) {
  return ambulo__mode_is_on_heel(mode) ? 0.0 : ambulo__mode_is_on_toes(mode) ? 1.0 : 0.5;
}

static roll roll_of_flat(const ambulo__stance *stance, double time) {
  ambulo__span flat = stance->phase;
  double middle = 0.5 * (flat.from + flat.to);
  double settled = stance->leaves > flat.from && stance->leaves < flat.to ? stance->leaves : middle;
  double leaving = stance->comes > flat.from && stance->comes < flat.to ? stance->comes : middle;
  double least = (flat.to - flat.from) * AMBULO__SHORTEST_GLIDE;
  settled = fmax(settled, flat.from + least);
  leaving = fmin(leaving, flat.to - least);
  if (leaving < settled) settled = leaving = middle;
  double on = ramp(time, flat.from, settled), off = ramp(time, leaving, flat.to);
  double from = place_of(stance->before), to = place_of(stance->after);
  roll r = {.along = 0.5 - (0.5 - from) * (1.0 - on) + (to - 0.5) * off};
  r.rear = (from > 0.5 ? on : 1.0) * (to > 0.5 ? 1.0 - off : 1.0);
  r.fore = (from < 0.5 ? on : 1.0) * (to < 0.5 ? 1.0 - off : 1.0);
  return r;
}

static roll roll_of(const ambulo_contact *contact, const ambulo__stance *stance, double time) {
  if (ambulo__mode_is_flat(contact->mode)) return roll_of_flat(stance, time);
  double along = place_of((int)contact->mode);
  return (roll){along, 1.0 - along, along};
}

/* ----------------------------------------------------------- where pressure is */

/* on the heel, of the time from strike to foot-flat; else 0 */
static double rolled(const ambulo_contact *contact, const ambulo__stance *stance, double time) {
  double rolling = contact->to - stance->from;
  if (!ambulo__mode_is_on_heel(contact->mode) || !(rolling > 0.0) || isinf(rolling)) return 0.0;
  return (time - stance->from) / rolling;
}

/* Of a point foot its region. Of the flat foot all from the heel's corners on, but of toes, which
 * bend, only what is next to the ball; on the heel or the toes of a rigid foot the edge over which
 * it turns, and the toes. */
static void box_of_sole(const ambulo_problem_definition *d, const ambulo__foot_outline *outline,
                        ambulo_contact_mode mode, double box[2]) {
  double edge = d->ground_reaction.arc_pressure, beyond = outline->tip - outline->length;
  int on_toes = ambulo__mode_is_on_toes(mode);
  if (outline->is_point) {
    box[0] = -AMBULO__POINT_REGION;
    box[1] = AMBULO__POINT_REGION;
    return;
  }
  box[0] = on_toes ? -edge : outline->back;
  box[1] = on_toes ? beyond : edge;
  if (ambulo__mode_is_flat(mode))
    box[1] = fmin(beyond, AMBULO__BEYOND_BALL * ambulo__model_size(d->model));
}

int ambulo__pressure_box(const ambulo_problem_definition *d, const ambulo__foot_outline *outline,
                         ambulo_contact_mode mode, double box[2]) {
  const ambulo_ground_reaction *r = &d->ground_reaction;
  const double *given = ambulo__mode_is_flat(mode)      ? r->flat_pressure
                        : ambulo__mode_is_on_toes(mode) ? r->toe_pressure
                                                        : r->heel_pressure;
  box[0] = given[0];
  box[1] = given[1];
  if (isnan(given[0])) box_of_sole(d, outline, mode, box);
  return !isnan(given[0]);
}

double ambulo__pressure_side(const ambulo_problem_definition *d,
                             const ambulo__foot_outline *outline) {
  double given = d->ground_reaction.pressure_width;
  double least = outline->is_point ? AMBULO__POINT_REGION : d->ground_reaction.arc_pressure;
  return isnan(given) ? fmax(outline->half_width, least) : given;
}

/* ends along forward, from the heel's foothold */
static void box_of(const ambulo_problem_definition *d, const ambulo__foot_outline *outline,
                   const ambulo_contact *contact, double part_rolled, double box[2]) {
  int given = ambulo__pressure_box(d, outline, contact->mode, box);
  int on_toes = ambulo__mode_is_on_toes(contact->mode),
      on_heel = ambulo__mode_is_on_heel(contact->mode);
  if (on_toes) box[0] += outline->length;
  if (!on_heel) box[1] += outline->length;
  if (on_heel && given) box[1] += d->ground_reaction.heel_roll * part_rolled;
}

/* ---------------------------------------------------------------------- load */

/* modes in which a part is down */
static int modes_of(ambulo__slot_part part) {
  if (part == AMBULO__REAR_FOOT) return ambulo__modes_with(1);
  if (part == AMBULO__FORE_FOOT) return ambulo__modes_with(0);
  return AMBULO__ANY_MODE;
}

/* rad: theta_d, of shipped runs and walks .2 to .45, and theta_l, .6 to 1.1 */
static const double pitch_down = 0.35, pitch_left = 0.9;

/* centre of a foot that rolls on an arc */
static double under_arc(const ambulo__foot_outline *outline, const ambulo_contact *contact,
                        const ambulo__stance *stance, double time) {
  const ambulo__span *phase = &stance->phase;
  int toes = ambulo__mode_is_on_toes(contact->mode), starts = stance->before < 0;
  int cut_before = toes && starts && isinf(stance->from), ends = stance->after < 0;
  int cut_after = toes && ends && isinf(stance->to);
  double length = phase->to - phase->from, pitch = 0.0;
  double over = length > 0.0 ? fmin(1.0, fmax(0.0, (time - phase->from) / length)) : 0.0;
  over = (over + cut_before) / (1.0 + cut_before + cut_after);
  if (starts && !cut_before) pitch += pitch_down * (1.0 - over) * (1.0 - over);
  if (ends && (toes || isfinite(stance->to))) pitch += pitch_left * over * over;
  return outline->arc_ahead[toes] + (toes ? outline->radius[1] : -outline->radius[0]) * pitch;
}

/* weight, centre and box of the foot become those of the part; returns the centre */
static double narrow(ambulo__slot_part part, roll at, const ambulo__foot_outline *outline,
                     double size, ambulo__contact_load *load) {
  double length = outline->length, *box = load->box;
  double ahead = length + AMBULO__BEYOND_BALL * size;
  if (outline->is_point) return 0.0;
  if (part == AMBULO__WHOLE_FOOT) {
    double arcs[] = {outline->arc_ahead[0], outline->arc_ahead[1] - outline->arc_ahead[0]};
    return outline->has_arcs ? arcs[0] + at.along * arcs[1] : at.along * ahead;
  }
  load->weight *= part == AMBULO__REAR_FOOT ? at.rear : at.fore;
  int end = part == AMBULO__REAR_FOOT; /* the one beside the joint */
  load->cut[end] = end ? box[1] > length : box[0] < length;
  if (load->cut[end]) box[end] = length;
  return end ? fmin(at.along, 0.5) * length : ahead;
}

/* g, and s dg/ds */
static double most_after(double rate, double onset_time, double time, double *by_time) {
  *by_time = 0.0;
  if (isnan(rate) || isinf(time)) return INFINITY;
  time = fmax(0.0, time);
  double onset = expm1(-time / onset_time);
  *by_time = -rate * onset * time;
  return rate * (time + onset_time * onset);
}

/* region, centre and arc of a foot's contact; its weight goes to the part */
static void load_foot(const ambulo_problem_definition *d, const ambulo__foot_outline *outline,
                      const ambulo_contact *contact, const ambulo__stance *stance,
                      ambulo__slot_part part, double time, ambulo__contact_load *load) {
  load->rolled = rolled(contact, stance, time);
  box_of(d, outline, contact, load->rolled, load->box);
  int rolls = outline->has_arcs && !ambulo__mode_is_flat(contact->mode);
  double center =
      narrow(part, roll_of(contact, stance, time), outline, ambulo__model_size(d->model), load);
  if (rolls && part == AMBULO__WHOLE_FOOT) center = under_arc(outline, contact, stance, time);
  for (int i = 0; i < 3; i++) load->center[i] += center * load->frame.forward[i];
  load->box[0] -= center;
  load->box[1] -= center;
  load->side = ambulo__pressure_side(d, outline);
  if (rolls) load->arc = outline->arc[ambulo__mode_is_on_toes(contact->mode)];
}

/* (W.8) the contact of a slot */
ambulo__contact_load ambulo__contact_load_at(const ambulo_problem_definition *d,
                                             const ambulo__foot_outline *outlines,
                                             const ambulo__slots *slots, int slot,
                                             const ambulo_contact *contact, double time) {
  ambulo__contact_load load = {.loaded = 0, .arc = -1};
  int effector = slots->effector[slot], patch = ambulo__effector_patch(d->model, effector);
  ambulo__slot_part part = (ambulo__slot_part)slots->part[slot];
  if (!contact) contact = ambulo__contact_of(d, effector, time);
  if (!contact || !(modes_of(part) & 1 << contact->mode)) return load;
  ambulo__stance stance = ambulo__stance_of(d, contact);
  ambulo__span down = ambulo__stance_in(d, contact, modes_of(part));
  load.loaded = 1;
  load.weight = weight_of(&stance, time);
  load.frame = ambulo__contact_frame_of(d, contact);
  for (int i = 0; i < 3; i++) load.center[i] = load.frame.origin[i];
  if (patch < 0) {
    load_foot(d, &outlines[effector], contact, &stance, part, time, &load);
  } else {
    load.box[1] = d->model->patches[patch].size[0];
    load.box[0] = -load.box[1];
    load.side = d->model->patches[patch].size[1];
  }
  load.since = time - down.from;
  load.until = down.to - time;
  load.most = most_after(d->ground_reaction.loading_rate,
                         loading_onset * sqrt(ambulo__model_size(d->model)),
                         fmin(load.since, load.until), &load.most_by_time);
  return load;
}
