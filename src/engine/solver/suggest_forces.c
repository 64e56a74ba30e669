/* solver/suggest_forces.c - what helps rows on the ground's force: where it acts, how it points,
 * how large it is. */
#include "solver/explain.h"
#include "contact/contacts.h"

#include <math.h>
#include <string.h>
#include <stdio.h>

static const double steepest = 10.0; /* most that ground_reaction.friction may be */
static const double least_pressing =
    0.02; /* body weights: less of a contact's force tells nothing of a centre of pressure */
static const double fastest = 1e4; /* ... and ground_reaction.loading_rate */

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

/* of all contacts together */
static void least_force(const ambulo__advice *a) {
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

/* c = most - n.f / W: the most is the row's constant, and as large as the rate */
static void loading_rate(const ambulo__advice *a) {
  double rate = a->problem->definition.ground_reaction.loading_rate, most = a->row->constant;
  double enough = most > 0.0 ? ambulo__outward(rate * (1.0 + a->room / most), 1) : HUGE_VAL;
  ambulo__advice_say(a,
                     "%s would have to carry %.4g body weights more at t = %.4g s than its loading "
                     "rate of %.4g body weights/s lets it: give the contact more time, or let it "
                     "be loaded faster",
                     a->row->subject, a->give, a->row->time, rate);
  if (enough <= fastest) ambulo__advice_set(a, "ground_reaction.loading_rate=%.6g", enough);
}

static void normal_force(const ambulo__advice *a) {
  if (!strcmp(a->row->detail, "loaded too fast")) {
    loading_rate(a);
  } else if (!strcmp(a->row->detail, "pulls")) {
    ambulo__advice_say(a,
                       "the ground would have to pull on %s with %.4g body weights at t = %.4g s: "
                       "let it leave earlier or come down later, or give the motion more time",
                       a->row->subject, a->give, a->row->time);
  } else {
    least_force(a);
  }
}

/* N of the contact that a row of friction is about, body weights: its row "pulls" comes before */
static double normal_of(const ambulo__advice *a, int row) {
  const ambulo__table_row *rows = a->problem->table.rows, *cone = &rows[row];
  for (int r = row - 1; r >= 0 && rows[r].node == cone->node; r--) {
    if (rows[r].kind == AMBULO__KIND_NORMAL_FORCE && !strcmp(rows[r].detail, "pulls") &&
        !strcmp(rows[r].subject, cone->subject) && rows[r].before == cone->before)
      return a->values[r];
  }
  return 0.0;
}

/* the friction that all contacts ask for at the point: mu N - |T| = c of each */
static double friction_needed(const ambulo__advice *a, double mu) {
  double needed = mu;
  for (int r = 0; r < a->problem->rows; r++) {
    if (a->problem->table.rows[r].kind != AMBULO__KIND_FRICTION || a->values[r] >= 0.0) continue;
    double normal = normal_of(a, r);
    if (normal > 0.0) needed = fmax(needed, mu - 1.01 * a->values[r] / normal);
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
    ambulo__advice_say(
        a,
        "%s drags with %.4g body weights more than friction holds at t = %.4g s: give "
        "the motion more time",
        a->row->subject, a->give, a->row->time);
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

/* a force is in body weights, a moment about the centre of mass in those times m */
static void flight(const ambulo__advice *a) {
  int is_force = a->row->measure == AMBULO__BODY_WEIGHTS;
  const ambulo__curved *spin = ambulo__row_curved_of(&a->problem->table, a->row);
  double bound = spin ? spin->of.spin.bound : a->row->constant;
  double tolerance = a->problem->definition.ground_reaction.flight_tolerance;
  double enough = ambulo__outward(tolerance * (1.0 + a->room / bound), 1);
  ambulo__advice_say(a,
                     "in flight the %s would have to be %s by %.4g body weights%s more at t = %.4g "
                     "s: give the contacts more time, or let more force be left in flight",
                     a->row->subject, a->row->detail, a->give, is_force ? "" : " m", a->row->time);
  if (enough <= 1.0) ambulo__advice_set(a, "ground_reaction.flight_tolerance=%.6g", enough);
}

/* the foot that the row's contact belongs to; -1 */
static int foot_of(const ambulo__advice *a) {
  const ambulo_model *m = a->problem->model;
  for (int f = 0; f < m->foot_count; f++) {
    const char *const names[] = {m->feet[f].name, m->points[m->feet[f].heel_center].name,
                                 m->points[m->feet[f].toe_center].name};
    for (int i = 0; i < 3; i++)
      if (!strcmp(names[i], a->row->subject)) return f;
  }
  return -1;
}

/* the modes of the row's foot at its node: one, on an event two if it is loaded before and after */
static int modes_of(const ambulo__advice *a, ambulo_contact_mode mode[2]) {
  const ambulo_problem *p = a->problem;
  const int *phase[2] = {p->before, p->active};
  int count = 0, foot = foot_of(a);
  for (int i = 0; i < 2 && foot >= 0 && a->row->node >= 0; i++) {
    int index = phase[i] ? phase[i][a->row->node * p->model->foot_count + foot] : -1;
    if (index < 0) continue;
    ambulo_contact_mode one = p->definition.contacts[index].mode;
    if (count == 0 || mode[0] != one) mode[count++] = one;
  }
  return count;
}

/* normal force that a row of pressure counts by, body weights. Where contacts share the load it is
 * that of the contact: both sides of its box add up to it, times the way between them, and what
 * is allowed on either side. */
static double counted_by(const ambulo__advice *a) {
  const ambulo_problem *p = a->problem;
  const ambulo__row_table *table = &p->table;
  int first = ambulo__channel_foot_force(&p->channels, 0, 0);
  int r = (int)(a->row - table->rows);
  int begins = !strcmp(a->row->detail, "back") || !strcmp(a->row->detail, "right");
  int pair[2] = {r, begins ? r + 1 : r - 1};
  double across[3] = {0.0, 0.0, 0.0}, sum = 0.0;
  for (int i = 0; i < 2; i++) {
    const ambulo__table_row *row = &table->rows[pair[i]];
    const ambulo__arc *arc = ambulo__row_arc_of(table, row);
    if (arc) across[0] += arc->room;
    for (int t = row->first_term; t < row->first_term + row->term_count; t++) {
      int axis = (table->terms[t].channel - first) % AMBULO__SLOT_CHANNELS;
      if (axis < 3) across[axis] += table->terms[t].coefficient * table->weight;
    }
    sum += a->values[pair[i]] - (arc ? arc->slack : row->constant);
  }
  double way = sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
  return way > 0.0 ? sum / way : 0.0;
}

/* a side of a box that ends at the joint of the toes, or under an arc, whatever its box */
static int is_fixed(const ambulo__advice *a) {
  const ambulo_model *m = a->problem->model;
  int foot = foot_of(a);
  if (ambulo__row_arc_of(&a->problem->table, a->row)) return 1;
  if (foot < 0 || !strcmp(m->feet[foot].name, a->row->subject)) return 0;
  int heel = !strcmp(m->points[m->feet[foot].heel_center].name, a->row->subject);
  return !strcmp(a->row->detail, heel ? "front" : "back");
}

/* a box with the side moved that the row is about; on an event those of both its contacts */
static void set_boxes(const ambulo__advice *a, double room) {
  ambulo_ground_reaction r = a->problem->definition.ground_reaction;
  ambulo_contact_mode mode[2];
  int modes = modes_of(a, mode);
  if (modes == 0) return;
  int front = !strcmp(a->row->detail, "front"), back = !strcmp(a->row->detail, "back");
  for (int i = 0; i < modes; i++) {
    double *box = ambulo__mode_is_flat(mode[i])      ? r.flat_pressure
                  : ambulo__mode_is_on_toes(mode[i]) ? r.toe_pressure
                                                     : r.heel_pressure;
    if (front) box[1] = ambulo__outward(box[1] + room, 1);
    if (back) box[0] = ambulo__outward(box[0] - room, 0);
  }
  if (!front && !back) r.pressure_width = ambulo__outward(r.pressure_width + room, 1);
  ambulo__advice_set(a,
                     "ground_reaction.pressure={heel: [%.6g, %.6g], roll: %.6g, flat: [%.6g, "
                     "%.6g], toe: [%.6g, %.6g], width: %.6g}",
                     r.heel_pressure[0], r.heel_pressure[1], r.heel_roll, r.flat_pressure[0],
                     r.flat_pressure[1], r.toe_pressure[0], r.toe_pressure[1], r.pressure_width);
}

static void pressure(const ambulo__advice *a) {
  double force = counted_by(a);
  if (force < least_pressing) {
    ambulo__advice_say(a,
                       "%s would have to carry a moment of %.4g body weights m (%s) with hardly a "
                       "force at t = %.4g s: give the motion more time, or let its contact begin "
                       "later or end earlier",
                       a->row->subject, a->give, a->row->detail, a->row->time);
    return;
  }
  ambulo__advice_say(a, "let the centre of pressure of %s go %.4g m further %s (t = %.4g s)",
                     a->row->subject, a->give / force, a->row->detail, a->row->time);
  if (!is_fixed(a)) set_boxes(a, a->room / force);
}

static void passive(const ambulo__advice *a) {
  ambulo__advice_say(a,
                     "nothing drives %s, which would need %.4g %s at t = %.4g s: give the motion "
                     "more time, or let a device act there",
                     a->row->subject, a->give, a->row->unit, a->row->time);
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
  case AMBULO__KIND_FLIGHT:
    flight(a);
    return 1;
  case AMBULO__KIND_PASSIVE:
    passive(a);
    return 1;
  case AMBULO__KIND_PRESSURE:
    pressure(a);
    return 1;
  default:
    return 0;
  }
}
