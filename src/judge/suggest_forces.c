/* judge/suggest_forces.c - what helps rows on the ground's force: where it acts, how it points,
 * how large it is. */
#include "judge/suggest.h"

#include <math.h>
#include <stdio.h>

static const double steepest = 10.0; /* most that ground_reaction.friction may be */

static void zmp(const ambulo__advice *a) {
  double margin = a->problem->definition.support_margin;
  double enough = ambulo__outward(margin - a->room, 0);
  if (margin >= a->give) {
    ambulo__advice_say(a,
                       "lower the margin of the zero-moment point by %.4g m: from %.4g m to %.4g m "
                       "(worst: %s at t = %.4g s)",
                       a->give, margin, fmax(0.0, enough), a->row->detail, a->row->time);
    ambulo__advice_set(a, "constraints.zmp_margin=%.6g", fmax(0.0, enough));
    return;
  }
  ambulo__advice_say(a,
                     "the zero-moment point leaves the support by %.4g m (%s) at t = %.4g s: give "
                     "the motion more time there, or widen the support%s",
                     a->give, a->row->detail, a->row->time,
                     margin > 0.0 ? "; no margin helps in part" : "");
  if (margin > 0.0) ambulo__advice_set(a, "constraints.zmp_margin=0");
}

static void normal_force(const ambulo__advice *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  double enough = ambulo__outward(d->minimum_force - a->room, 0);
  if (enough < 0.0) {
    ambulo__advice_say(a,
                       "the ground would have to pull with %.4g body weights at t = %.4g s: give "
                       "the motion more time, or shorten the steps",
                       a->give - d->minimum_force, a->row->time);
    return;
  }
  ambulo__advice_say(a,
                     "let the vertical force fall to %.4g body weights instead of %.4g (t = %.4g "
                     "s)",
                     enough, d->minimum_force, a->row->time);
  ambulo__advice_set(
      a, "%s.minimum_force=%.6g",
      d->ground_reaction.kind == AMBULO_REACTION_NONE ? "constraints" : "ground_reaction", enough);
}

/* the friction that every pair of rows, mu n - t and mu n + t, asks for at the point */
static double friction_needed(const ambulo__advice *a, double mu) {
  const ambulo_problem *p = a->problem;
  double needed = mu;
  for (int r = 0; r + 1 < p->rows; r++) {
    const ambulo__table_row *one = &p->table.rows[r], *next = one + 1;
    int pair = one->kind == AMBULO__KIND_FRICTION && next->kind == AMBULO__KIND_FRICTION &&
               one->node == next->node && !strcmp(one->subject, next->subject);
    double least = fmin(a->values[r], a->values[r + 1]), sum = a->values[r] + a->values[r + 1];
    if (pair && least < 0.0 && sum > 0.0) needed = fmax(needed, mu * (1.0 - 2.02 * least / sum));
  }
  return needed;
}

static void friction(const ambulo__advice *a) {
  double mu = a->problem->definition.ground_reaction.friction;
  double needed = ambulo__outward(friction_needed(a, mu), 1);
  if (needed > mu && needed <= steepest) {
    ambulo__advice_say(a,
                       "raise the friction from %.4g to %.4g (worst: %s %s by %.4g body weights at "
                       "t = %.4g s)",
                       mu, needed, a->row->subject, a->row->detail, a->give, a->row->time);
    ambulo__advice_set(a, "ground_reaction.friction=%.6g", needed);
  } else {
    ambulo__advice_say(a,
                       "%s pushes %s by %.4g body weights more than friction holds at t = %.4g s: "
                       "give the motion more time",
                       a->row->subject, a->row->detail, a->give, a->row->time);
  }
}

static void free_moment(const ambulo__advice *a) {
  double bound = a->problem->definition.ground_reaction.free_moment;
  double enough = ambulo__outward(bound + a->room, 1);
  ambulo__advice_say(a,
                     "let the free moment be up to %.4g body weights m instead of %.4g (t = %.4g "
                     "s)",
                     enough, bound, a->row->time);
  if (enough <= 10.0) ambulo__advice_set(a, "ground_reaction.free_moment=%.6g", enough);
}

/* the modes of the row's foot at its node: one, on an event two if it is loaded before and after */
static int modes_of(const ambulo__advice *a, ambulo_contact_mode mode[2]) {
  const ambulo_problem *p = a->problem;
  const int *phase[2] = {p->before, p->active};
  int count = 0;
  for (int f = 0; f < p->model->foot_count && a->row->node >= 0; f++) {
    if (strcmp(p->model->feet[f].name, a->row->subject) != 0) continue;
    for (int i = 0; i < 2; i++) {
      int index = phase[i] ? phase[i][a->row->node * p->model->foot_count + f] : -1;
      if (index < 0) continue;
      ambulo_contact_mode one = p->definition.contacts[index].mode;
      if (count == 0 || mode[0] != one) mode[count++] = one;
    }
  }
  return count;
}

/* a box with the side moved that the row is about; on an event those of both its contacts */
static void pressure(const ambulo__advice *a) {
  ambulo_ground_reaction r = a->problem->definition.ground_reaction;
  ambulo_contact_mode mode[2];
  int modes = modes_of(a, mode);
  ambulo__advice_say(a, "let the centre of pressure of %s go %.4g m further %s (t = %.4g s)",
                     a->row->subject, a->give, a->row->detail, a->row->time);
  if (modes == 0) return;
  int front = !strcmp(a->row->detail, "front"), back = !strcmp(a->row->detail, "back");
  for (int i = 0; i < modes; i++) {
    double *box = mode[i] == AMBULO_CONTACT_FLAT  ? r.flat_pressure
                  : mode[i] == AMBULO_CONTACT_TOE ? r.toe_pressure
                                                  : r.heel_pressure;
    if (front) box[1] = ambulo__outward(box[1] + a->room, 1);
    if (back) box[0] = ambulo__outward(box[0] - a->room, 0);
  }
  if (!front && !back) r.pressure_width = ambulo__outward(r.pressure_width + a->room, 1);
  ambulo__advice_set(a,
                     "ground_reaction.pressure={heel: [%.6g, %.6g], roll: %.6g, flat: [%.6g, "
                     "%.6g], toe: [%.6g, %.6g], width: %.6g}",
                     r.heel_pressure[0], r.heel_pressure[1], r.heel_roll, r.flat_pressure[0],
                     r.flat_pressure[1], r.toe_pressure[0], r.toe_pressure[1], r.pressure_width);
}

int ambulo__advise_forces(const ambulo__advice *a) {
  switch (a->row->kind) {
  case AMBULO__KIND_ZMP:
    zmp(a);
    return 1;
  case AMBULO__KIND_NORMAL_FORCE:
    normal_force(a);
    return 1;
  case AMBULO__KIND_FRICTION:
    friction(a);
    return 1;
  case AMBULO__KIND_FREE_MOMENT:
    free_moment(a);
    return 1;
  case AMBULO__KIND_PRESSURE:
    pressure(a);
    return 1;
  default:
    return 0;
  }
}
