/* gait/contact_load.c - weight, centre, patch and greatest force of a contact (contact_load.h).
 *
 * A stance is the uninterrupted time [b, e] that a foot is down, in a motion that repeats beyond
 * the ends; one that begins at 0 or ends at T of a motion that does not has no beginning or end.
 * S(u) = u^2 (3 - 2 u), u cut to [0, 1].
 *
 * Weight. Over the time that the stance shares with those that were there before it, and with
 * those that stay:
 *
 *     w = S((t - b) / (b' - b)) S((e - t) / (e - e'))
 *     b' = earliest end of the stances of other feet that hold at b (none: no such factor)
 *     e' = latest beginning of those that hold at e
 *
 * A neighbour that outlasts the stance on that side gives half the stance, and a stance of no
 * length (a strike where the motion ends) carries nothing.
 *
 * Centre, ahead of the heel's foothold by x, with L from heel to toe centre (ball):
 *
 *     heel   0          toe   L + a, a = 0.02 m          flat   (L + a) / 2
 *
 * It glides to the flat foot's from the heel's (going down stairs from the toes'), once the foot is
 * flat, until the neighbour has left (b'), and on to the toes' from when the next one is there (e')
 * until the heel rises: each by S, half of the flat time where there is no such event in it. What a
 * single contact carries does not depend on its centre.
 *
 * Greatest normal force, body weights:
 *
 *     min(g(t - b), g(e - t)),   g(s) = rho (s - tau (1 - exp(-s / tau)))
 *
 * with the loading rate rho and tau = 0.01 s over which it sets in: a force that began with its
 * full rate would have a corner, which nodes do not follow and which rings.
 */
#include "gait/contact_load.h"
#include "base/instant.h"
#include "gait/gait.h"
#include "gait/stance.h"
#include "model/model.h"

#include <math.h>

static const double beyond_ball = 0.02; /* m: a */
static const double loading_onset =
    0.01; /* s: tau; rms above 15 Hz .0051 body weights, without .0097 */

/* -------------------------------------------------------------------- slots */

static void add_slot(ambulo__slots *s, int foot, int link, ambulo__foot_part part) {
  int i = s->count++;
  if (i >= AMBULO__MOST_SLOTS) return;
  s->foot[i] = foot;
  s->link[i] = link;
  s->part[i] = (int)part;
}

ambulo__slots ambulo__slots_of(const ambulo_model *m) {
  ambulo__slots s = {.count = 0};
  for (int fore = 0; fore < 2; fore++) {
    for (int f = 0; f < m->foot_count; f++) {
      int heel = m->points[m->feet[f].heel_center].link,
          toe = m->points[m->feet[f].toe_center].link;
      if (!fore) add_slot(&s, f, heel, heel == toe ? AMBULO__WHOLE_FOOT : AMBULO__REAR_FOOT);
      if (fore && heel != toe) add_slot(&s, f, toe, AMBULO__FORE_FOOT);
    }
  }
  if (s.count > AMBULO__MOST_SLOTS) s.count = 0;
  return s;
}

/* -------------------------------------------------------------------- weight */

static double smooth(double u) {
  u = fmin(1.0, fmax(0.0, u));
  return u * u * (3.0 - 2.0 * u);
}

static double ramp(double time, double from, double to) {
  return to - from > AMBULO__INSTANT ? smooth((time - from) / (to - from)) : 1.0;
}

/* a foot that strikes where the motion ends has not begun to carry */
static double weight_of(const ambulo__stance *s, double time) {
  double weight = 1.0;
  if (isfinite(s->leaves))
    weight *= s->leaves - s->from > AMBULO__INSTANT ? ramp(time, s->from, s->leaves) : 0.0;
  if (isfinite(s->comes)) weight *= 1.0 - ramp(time, s->comes, s->to);
  return weight;
}

/* -------------------------------------------------------------------- centre */

/* of a part that comes before or after the flat foot: `mode`, or -1 for none */
static double center_beside(int mode, double toe) {
  if (mode == (int)AMBULO_CONTACT_HEEL) return 0.0;
  return mode == (int)AMBULO_CONTACT_TOE ? toe : 0.5 * toe;
}

static double flat_center(const ambulo__stance *stance, double toe, double time) {
  ambulo__span flat = stance->phase;
  double middle = 0.5 * (flat.from + flat.to), center = 0.5 * toe;
  double before = center_beside(stance->before, toe), after = center_beside(stance->after, toe);
  double settled = stance->leaves > flat.from && stance->leaves < flat.to ? stance->leaves : middle;
  double leaving = stance->comes > flat.from && stance->comes < flat.to ? stance->comes : middle;
  if (leaving < settled) settled = leaving = middle;
  return before + (center - before) * ramp(time, flat.from, settled) +
         (after - center) * ramp(time, leaving, flat.to);
}

static double center_of(const ambulo_contact *contact, const ambulo__stance *stance, double length,
                        double time) {
  double toe = length + beyond_ball;
  if (contact->mode == AMBULO_CONTACT_HEEL) return 0.0;
  if (contact->mode == AMBULO_CONTACT_TOE) return toe;
  return flat_center(stance, toe, time);
}

/* --------------------------------------------------------------------- patch */

/* ends along forward, from the heel's foothold */
static void patch_of(const ambulo_problem_definition *d, const ambulo_contact *contact,
                     const ambulo__stance *stance, double length, double time, double box[2]) {
  const ambulo_ground_reaction *r = &d->ground_reaction;
  if (contact->mode == AMBULO_CONTACT_FLAT) {
    box[0] = r->flat_pressure[0];
    box[1] = length + r->flat_pressure[1];
  } else if (contact->mode == AMBULO_CONTACT_TOE) {
    box[0] = length + r->toe_pressure[0];
    box[1] = length + r->toe_pressure[1];
  } else {
    double rolling = contact->to - stance->from;
    double progress = rolling > 0.0 && isfinite(rolling) ? (time - stance->from) / rolling : 0.0;
    box[0] = r->heel_pressure[0];
    box[1] = r->heel_pressure[1] + r->heel_roll * progress;
  }
}

/* what of a foot with a joint lies on one side of it; 0: that part is in the air */
static int part_of(ambulo__foot_part part, const ambulo_contact *contact, double length,
                   double box[2], double *center) {
  if (part == AMBULO__WHOLE_FOOT) return 1;
  if (part == AMBULO__REAR_FOOT) {
    if (contact->mode == AMBULO_CONTACT_TOE) return 0;
    box[1] = fmin(box[1], length);
    *center = contact->mode == AMBULO_CONTACT_HEEL ? 0.0 : 0.5 * length;
  } else {
    if (contact->mode == AMBULO_CONTACT_HEEL) return 0;
    box[0] = fmax(box[0], length);
    *center = length + beyond_ball;
  }
  return 1;
}

static double most_after(double rate, double time) {
  if (rate < 0.0 || isinf(time)) return INFINITY;
  time = fmax(0.0, time);
  return rate * (time + loading_onset * expm1(-time / loading_onset));
}

/* (W.8) the contact of a slot */
ambulo__contact_load ambulo__contact_load_at(const ambulo_problem_definition *d,
                                             const ambulo__foot_outline *outlines,
                                             const ambulo__slots *slots, int slot,
                                             const ambulo_contact *contact, double time) {
  ambulo__contact_load load = {.loaded = 0};
  int foot = slots->foot[slot];
  const ambulo_ground_reaction *r = &d->ground_reaction;
  if (!contact) contact = ambulo__contact_of(d, foot, time);
  if (!contact) return load;
  ambulo__stance stance = ambulo__stance_of(d, contact);
  double length = outlines[foot].length, box[2];
  double center = center_of(contact, &stance, length, time);
  patch_of(d, contact, &stance, length, time, box);
  if (!part_of((ambulo__foot_part)slots->part[slot], contact, length, box, &center)) return load;
  load.loaded = 1;
  load.weight = weight_of(&stance, time);
  load.frame = ambulo__contact_frame_of(d, contact);
  for (int i = 0; i < 3; i++)
    load.center[i] = load.frame.origin[i] + center * load.frame.forward[i];
  load.box[0] = box[0] - center;
  load.box[1] = box[1] - center;
  load.side = r->pressure_width;
  load.most = fmin(most_after(r->loading_rate, time - stance.from),
                   most_after(r->loading_rate, stance.to - time));
  return load;
}
