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

/* normal force that a row of pressure counts by, body weights: of the contact's row that says that
 * the ground does not pull */
static double counted_by(const ambulo__advice *a) {
  const ambulo__table_row *rows = a->problem->table.rows;
  for (int r = (int)(a->row - rows); r >= 0; r--)
    if (rows[r].kind == AMBULO__KIND_NORMAL_FORCE && !strcmp(rows[r].detail, "pulls"))
      return a->values[r];
  return 0.0;
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

static void append(char *text, size_t size, const char *name, const double *value, int count) {
  size_t used = strlen(text);
  const char *comma = used ? ", " : "";
  if (isnan(value[0])) return;
  if (count == 2)
    (void)snprintf(text + used, size - used, "%s%s: [%.6g, %.6g]", comma, name, value[0], value[1]);
  else
    (void)snprintf(text + used, size - used, "%s%s: %.6g", comma, name, value[0]);
}

/* the boxes that the problem gives, and those with the side moved that the row is about; on an
 * event those of both its contacts */
static void set_boxes(const ambulo__advice *a, double room) {
  const ambulo_problem_definition *d = &a->problem->definition;
  ambulo_ground_reaction r = d->ground_reaction;
  ambulo_contact_mode mode[2];
  int modes = modes_of(a, mode);
  if (modes == 0) return;
  ambulo__foot_outline outline = ambulo__foot_outline_of(d->model, foot_of(a));
  int front = !strcmp(a->row->detail, "front"), back = !strcmp(a->row->detail, "back");
  for (int i = 0; i < modes && (front || back); i++) {
    double *box = ambulo__mode_is_flat(mode[i])      ? r.flat_pressure
                  : ambulo__mode_is_on_toes(mode[i]) ? r.toe_pressure
                                                     : r.heel_pressure;
    (void)ambulo__pressure_box(d, &outline, mode[i], box);
    box[front] = ambulo__outward(box[front] + (front ? room : -room), front);
  }
  if (!front && !back)
    r.pressure_width = ambulo__outward(ambulo__pressure_side(d, &outline) + room, 1);
  char text[300] = "";
  append(text, sizeof text, "heel", r.heel_pressure, 2);
  if (!isnan(r.heel_pressure[0])) append(text, sizeof text, "roll", &r.heel_roll, 1);
  append(text, sizeof text, "flat", r.flat_pressure, 2);
  append(text, sizeof text, "toe", r.toe_pressure, 2);
  append(text, sizeof text, "width", &r.pressure_width, 1);
  append(text, sizeof text, "arc", &r.arc_pressure, 1);
  ambulo__advice_set(a, "ground_reaction.pressure={%s}", text);
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
