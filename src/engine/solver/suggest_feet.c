/* solver/suggest_feet.c - what helps rows on feet: footholds, contacts, penetration, clearance. */
#include "model/model.h"
#include "solver/explain.h"

#include "contact/contacts.h"

#include <math.h>
#include <string.h>
#include <stdio.h>

static const double widest_contact =
    0.1;                               /* m: the most that constraints.contact_tolerance may be */
static const double widest_turn = 0.5; /* sine: ... and constraints.orientation_tolerance */

/* on the link of its heel or of its toes */
static int is_on_foot(const ambulo_model *model, const ambulo_foot *foot, int point) {
  int link = model->points[point].link;
  return link == model->points[foot->heel_center].link ||
         link == model->points[foot->toe_center].link;
}

/* the foot whose points are those of the row's subject, or that has its name; -1: none */
static int foot_of(const ambulo__advice *a) {
  const ambulo_model *model = a->problem->model;
  int point = ambulo_model_find_point(model, a->row->subject);
  for (int f = 0; f < model->foot_count; f++) {
    if (!strcmp(model->feet[f].name, a->row->subject)) return f;
    if (point >= 0 && is_on_foot(model, &model->feet[f], point)) return f;
  }
  return -1;
}

/* the contact of that foot at the row's node; of two on an event the flat one, which leaves least
 * room; NULL in the air */
static const ambulo_contact *contact_of(const ambulo__advice *a) {
  const ambulo_problem *p = a->problem;
  int foot = foot_of(a);
  if (foot < 0 || a->row->node < 0) return NULL;
  int at = a->row->node * p->model->foot_count + foot, index = p->active[at];
  int before = p->before ? p->before[at] : index;
  if (index < 0 || (before >= 0 && ambulo__mode_is_flat(p->definition.contacts[before].mode)))
    index = before;
  return index < 0 ? NULL : &p->definition.contacts[index];
}

/* ------------------------------------------------------------------ footholds */

/* how far the point that contact `index` holds stands off its place along forward, at a node;
 * the row belongs to the foot when its subject is a point of the foot's link */
static int offset_of(const ambulo__advice *a, int node, int index, double *offset) {
  const ambulo_problem *p = a->problem;
  const ambulo_model *model = p->model;
  const ambulo_foot *foot = &model->feet[p->definition.contacts[index].foot];
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    int is_strike = row->kind == AMBULO__KIND_FOOT_STRIKE && !strcmp(row->detail, "forward");
    if (row->node != node || !is_strike) continue;
    int point = ambulo_model_find_point(model, row->subject);
    if (point < 0 || !is_on_foot(model, foot, point)) continue;
    *offset = a->values[r];
    return 1;
  }
  return 0;
}

/* the pair of contacts, both down at one node, whose spacing is missed most */
static int missed_spacing(const ambulo__advice *a, double *asked, double *reached) {
  const ambulo_problem *p = a->problem;
  int feet = p->model->foot_count;
  double most = 0.0;
  for (int k = 0; k < p->nodes; k++) {
    const int *active = p->active + k * feet;
    for (int i = 0; i < feet; i++) {
      for (int j = 0; j < feet; j++) {
        double from, to;
        if (i == j || active[i] < 0 || active[j] < 0) continue;
        double apart =
            p->definition.contacts[active[j]].place[0] - p->definition.contacts[active[i]].place[0];
        if (apart <= 0.0 || !offset_of(a, k, active[i], &from) ||
            !offset_of(a, k, active[j], &to) || from - to <= most)
          continue;
        most = from - to;
        *asked = apart;
        *reached = apart - most;
      }
    }
  }
  return most > 0.5 * a->give;
}

static void foothold(const ambulo__advice *a) {
  double asked = 0.0, reached = 0.0;
  if (!strcmp(a->row->detail, "forward") && missed_spacing(a, &asked, &reached)) {
    double enough = floor(1000.0 * reached) / 1000.0;
    ambulo__advice_say(a,
                       "the foothold of %s at t = %.4g s is %.2g m beyond reach: shorten the step "
                       "from %.4g m to %.4g m or less",
                       a->row->subject, a->row->time, asked - reached, asked, enough);
    ambulo__advice_set_step(a, enough);
  } else {
    ambulo__advice_say(a,
                       "move the foothold of %s at t = %.4g s %s by %.4g m, or change the time of "
                       "its contact",
                       a->row->subject, a->row->time, a->row->detail, a->value);
  }
}

/* ------------------------------------------------------------------- contacts */

static void contact_place(const ambulo__advice *a) {
  double old = a->problem->definition.contact_tolerance;
  double wide = ambulo__outward(old + a->room, 1);
  int is_patch = ambulo__find_patch(a->problem->model, a->row->subject) >= 0;
  ambulo__advice_say(a, "%s at t = %.4g s is %.4g m further %s than its contact lets it: %s%s",
                     a->row->subject, a->row->time, a->give, a->row->detail,
                     is_patch ? "move its place, or change the time of its contact"
                              : "shorten the steps or give them more time",
                     wide <= widest_contact ? ", or let contacts hold within a wider tolerance"
                                            : "");
  if (wide <= widest_contact) ambulo__advice_set(a, "constraints.contact_tolerance=%.6g", wide);
}

static void strike_pitch(const ambulo__advice *a, int low) {
  const double *pitch = a->problem->definition.strike_pitch;
  double radians = a->problem->keys.radians, wide[2] = {pitch[0], pitch[1]};
  double sine = sin(pitch[!low]) + (low ? -a->room : a->room);
  ambulo__advice_say(a, "let the foot strike the ground %s, by %.4g (sine of its pitch)",
                     low ? "flatter" : "steeper", a->give);
  if (!(fabs(sine) < 1.0)) return; /* no pitch has it */
  wide[!low] = asin(sine);
  if (radians > 0.0)
    ambulo__advice_set(a, "constraints.strike_pitch=[%.6g, %.6g]",
                       ambulo__outward(wide[0] / radians, 0),
                       ambulo__outward(wide[1] / radians, 1));
}

static void contact_angle(const ambulo__advice *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  const ambulo_contact *contact = contact_of(a);
  int pitch = !strncmp(a->row->detail, "toes", 4), low = !strcmp(a->row->detail, "toes low");
  int toe = contact && ambulo__mode_is_on_toes(contact->mode);
  double bound = low ? -a->row->constant : a->row->constant;
  if (pitch && d->strike_pitch[0] < d->strike_pitch[1] &&
      fabs(bound - sin(d->strike_pitch[!low])) < 1e-9) {
    strike_pitch(a, low);
    return;
  }
  double wide = ambulo__outward(d->orientation_tolerance + a->room / (toe ? 2.0 : 1.0), 1);
  int fixed = pitch && contact &&
              (!ambulo__mode_is_flat(contact->mode) ||
               fabs(fabs(bound) - d->orientation_tolerance) > 1e-12);
  ambulo__advice_say(a,
                     "the foot %s has to turn further at t = %.4g s than its contact lets it (%s, "
                     "by a sine of %.4g): %s",
                     a->row->subject, a->row->time, a->row->detail, a->give,
                     fixed ? "change the times of its phases, or the length of the steps"
                           : "widen the tolerance of its direction");
  if (!fixed && wide <= widest_turn)
    ambulo__advice_set(a, "constraints.orientation_tolerance=%.6g", wide);
}

static void penetration(const ambulo__advice *a) {
  double wide = ambulo__outward(a->room, 1);
  if (a->row->relation == AMBULO_EQUAL) {
    ambulo__advice_say(a,
                       "%s stays %.4g m %s the ground at t = %.4g s, where its contact holds it: "
                       "let contacts hold within a tolerance, or change the contact's mode or time",
                       a->row->subject, a->give, a->value < 0.0 ? "below" : "above", a->row->time);
    if (wide <= widest_contact) ambulo__advice_set(a, "constraints.contact_tolerance=%.6g", wide);
  } else {
    ambulo__advice_say(a,
                       "%s has to pass %.4g m below the ground at t = %.4g s: give the step more "
                       "time, or widen the ranges of the leg",
                       a->row->subject, a->give, a->row->time);
  }
}

/* ------------------------------------------------------------------ clearance */

static void lower_clearance(const ambulo__advice *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  /* what the row asks for, a share of `height`; over footholds of any height it is not told */
  double low = ambulo__contacts_are_level(d) ? -a->row->constant - d->ground_height : 0.0;
  double height = d->clearance.height;
  if (!(low > 0.0) || a->room >= low) {
    ambulo__advice_say(a,
                       "%s has to pass %.4g m lower at t = %.4g s than the ground and its "
                       "clearance let it: give the step more time",
                       a->row->subject, a->give, a->row->time);
    return;
  }
  double enough = ambulo__outward(height * (1.0 - a->room / low), 0);
  ambulo__advice_say(
      a, "lower the clearance of feet in the air from %.4g m to %.4g m (%s, t = %.4g s)", height,
      enough, a->row->subject, a->row->time);
  ambulo__advice_set(a, "constraints.clearance.height=%.6g", enough);
}

static void widen_clearance(const ambulo__advice *a, const char *what, const char *key,
                            double bound, double most) {
  double enough = ambulo__outward(bound + a->room, 1);
  ambulo__advice_say(a,
                     "let %s of feet in the air be up to %.4g instead of %.4g (%s %s, t = %.4g s)",
                     what, enough, bound, a->row->subject, a->row->detail, a->row->time);
  if (enough <= most) ambulo__advice_set(a, "constraints.clearance.%s=%.6g", key, enough);
}

/* the bound of a row about the track: constant = -place - low, or place + high */
static void widen_track(const ambulo__advice *a) {
  const ambulo_clearance *c = &a->problem->definition.clearance;
  int foot = foot_of(a), left = !strcmp(a->row->detail, "to the left");
  if (foot < 0) return;
  double place = 0.0, nearest = HUGE_VAL, wide[2] = {c->outward, c->inward};
  const ambulo_problem_definition *d = &a->problem->definition;
  for (int i = 0; i < d->contact_count; i++) { /* the place that explains the bound best */
    for (int k = 0; k < 2; k++) {
      double bound = left ? d->contacts[i].place[1] + wide[k] : wide[k] - d->contacts[i].place[1];
      double off = fabs(bound - a->row->constant);
      if (d->contacts[i].foot != foot || off >= nearest) continue;
      nearest = off;
      place = (double)k;
    }
  }
  if (place > 0.5)
    widen_clearance(a, "the way inward", "inward", c->inward, 10.0);
  else
    widen_clearance(a, "the way outward", "outward", c->outward, 10.0);
}

static void narrow_gap(const ambulo__advice *a) {
  const ambulo__curved *row = ambulo__row_curved_of(&a->problem->table, a->row);
  double gap = a->problem->definition.clearance.feet, kept = row->of.apart.distance;
  double missed =
      kept - sqrt(fmax(0.0, kept * (kept - 2.0 * a->room))); /* D - |e|, contact/curved.h */
  double enough = ambulo__outward(gap - missed, 0);
  if (gap < missed) {
    ambulo__advice_say(
        a,
        "%s comes %.4g m too near to the other foot at t = %.4g s: put the footholds "
        "further apart, or let feet in the air leave their track further outward",
        a->row->subject, a->give, a->row->time);
    return;
  }
  ambulo__advice_say(a, "let feet pass each other %.4g m apart instead of %.4g m (%s, t = %.4g s)",
                     enough, gap, a->row->subject, a->row->time);
  ambulo__advice_set(a, "constraints.clearance.feet=%.6g", enough);
}

static void clearance(const ambulo__advice *a) {
  const ambulo_clearance *c = &a->problem->definition.clearance;
  const char *detail = a->row->detail;
  if (!strcmp(detail, "low")) {
    lower_clearance(a);
  } else if (!strcmp(detail, "high")) {
    widen_clearance(a, "the height", "ceiling", c->ceiling, 10.0);
  } else if (!strncmp(detail, "near", 4)) {
    narrow_gap(a);
  } else if (!strncmp(detail, "to the", 6)) {
    widen_track(a);
  } else {
    widen_clearance(a, "the turn (sine)", "turn", c->turn, 1.0);
  }
}

int ambulo__advise_feet(const ambulo__advice *a) {
  switch (a->row->kind) {
  case AMBULO__KIND_FOOT_STRIKE:
    foothold(a);
    return 1;
  case AMBULO__KIND_CONTACT:
    if (a->row->measure == AMBULO__METRES)
      contact_place(a);
    else
      contact_angle(a);
    return 1;
  case AMBULO__KIND_GROUND_PENETRATION:
    penetration(a);
    return 1;
  case AMBULO__KIND_CLEARANCE:
    clearance(a);
    return 1;
  default:
    return 0;
  }
}
