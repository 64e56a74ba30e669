/* solver/suggest.c - one suggestion, in the words of the problem file.
 *
 * With c the value of the worst row where its family gives way alone (explain.h):
 *
 *   limits       y - lo = c or hi - y = c, c < 0: the bound has to move by -c
 *   end values   y - value = c: the value that can be reached is value + c
 *   ends         travel that can be reached: travel + c
 *   foot strike  footholds are missed by c: the spacing that can be reached while two feet are
 *                down is (place_b + c_b) - (place_a + c_a)
 *
 * These numbers suffice: a point that meets them has been found. Lengths,
 * torques and angles are in SI units and radians, as everywhere in results.
 */
#include "solver/explain.h"

#include "gait/bounds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct wording {
  const ambulo_problem *problem;
  const ambulo__table_row *row;
  double value, give;   /* of the worst row; give = |value| */
  const double *values; /* [rows] */
  char *text;
} wording;

static int is(const wording *w, const char *family) {
  return !strcmp(w->row->family, family);
}

/* what is left of zero after a descent */
static double clean(double value) {
  return fabs(value) < 1e-5 ? 0.0 : value;
}

static double degrees(double angle) {
  return angle * 57.29577951308232;
}

/* " (12 deg)" after angles */
static const char *in_degrees(const wording *w, double angle, char buffer[32]) {
  buffer[0] = '\0';
  if (!strcmp(w->row->unit, "rad")) (void)snprintf(buffer, 32, " (%.3g deg)", degrees(angle));
  return buffer;
}

static void limit(const wording *w, const char *what) {
  char a[32], b[32];
  int upper = !strcmp(w->row->detail, "upper");
  double bound = ambulo__limit_given(w->problem->model, w->row);
  double enough = upper ? bound + w->give : bound - w->give;
  (void)snprintf(
      w->text, AMBULO__LINE_SIZE, "%s the %s %s of %s by %.4g %s: from %.4g%s to %.4g %s%s",
      upper ? "raise" : "lower", w->row->detail, what, w->row->subject, w->give, w->row->unit,
      bound, in_degrees(w, bound, a), enough, w->row->unit, in_degrees(w, enough, b));
}

static void end_value(const wording *w) {
  char a[32], b[32];
  double asked = -w->row->constant, reached = clean(asked + w->value);
  (void)snprintf(
      w->text, AMBULO__LINE_SIZE,
      "ask for another %s %s of %s at t = %.4g s: %.4g %s%s instead of %.4g %s%s, or give "
      "the motion more time",
      is(w, "final_state") ? "final" : "initial", w->row->detail, w->row->subject, w->row->time,
      reached, w->row->unit, in_degrees(w, reached, a), asked, w->row->unit,
      in_degrees(w, asked, b));
}

static void matching_ends(const wording *w) {
  double travel = w->problem->definition.travel;
  if (!strcmp(w->row->detail, "value") && w->row->constant != 0.0) {
    double sign = -w->row->constant / travel;
    (void)snprintf(w->text, AMBULO__LINE_SIZE,
                   "change ends.travel from %.4g m to %.4g m, which the other rows allow (%s)",
                   travel, clean(travel + sign * w->value), w->row->subject);
  } else {
    (void)snprintf(w->text, AMBULO__LINE_SIZE,
                   "the two ends of %s (%s) stay %.4g %s apart: use 'ends: {kind: free}', or drop "
                   "what else fixes its state there",
                   w->row->subject, w->row->detail, w->give, w->row->unit);
  }
}

static void zmp(const wording *w) {
  double margin = w->problem->definition.support_margin;
  if (margin >= w->give) {
    (void)snprintf(w->text, AMBULO__LINE_SIZE,
                   "lower constraints.zmp_margin by %.4g m: from %.4g m to %.4g m (worst: %s at "
                   "t = %.4g s)",
                   w->give, margin, margin - w->give, w->row->detail, w->row->time);
  } else {
    (void)snprintf(w->text, AMBULO__LINE_SIZE,
                   "the zero-moment point leaves the support by %.4g m (%s) at t = %.4g s: give "
                   "the motion more time there, widen the support%s",
                   w->give, w->row->detail, w->row->time,
                   margin > 0.0 ? ", or set constraints.zmp_margin to 0" : "");
  }
}

/* ------------------------------------------------------------------ footholds */

/* how far the point that contact `index` holds stands off its place along forward, at a node;
 * the row belongs to the foot when its subject is a point of the foot's link */
static int offset_of(const wording *w, int node, int index, double *offset) {
  const ambulo_problem *p = w->problem;
  const ambulo_model *model = p->model;
  const ambulo_foot *foot = &model->feet[p->definition.contacts[index].foot];
  int link = model->points[foot->heel_center].link;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    int is_strike = !strcmp(row->family, "foot_strike") && !strcmp(row->detail, "forward");
    if (row->node != node || !is_strike) continue;
    int point = ambulo_model_find_point(model, row->subject);
    if (point < 0 || model->points[point].link != link) continue;
    *offset = w->values[r];
    return 1;
  }
  return 0;
}

/* the pair of contacts, both down at one node, whose spacing is missed most */
static int missed_spacing(const wording *w, double *asked, double *reached) {
  const ambulo_problem *p = w->problem;
  int feet = p->model->foot_count;
  double most = 0.0;
  for (int k = 0; k < p->nodes; k++) {
    const int *active = p->active + k * feet;
    for (int a = 0; a < feet; a++) {
      for (int b = 0; b < feet; b++) {
        double from, to;
        if (a == b || active[a] < 0 || active[b] < 0) continue;
        const ambulo_contact *ca = &p->definition.contacts[active[a]];
        const ambulo_contact *cb = &p->definition.contacts[active[b]];
        double apart = cb->place[0] - ca->place[0];
        if (apart <= 0.0 || !offset_of(w, k, active[a], &from) ||
            !offset_of(w, k, active[b], &to) || from - to <= most)
          continue;
        most = from - to;
        *asked = apart;
        *reached = apart - most;
      }
    }
  }
  return most > 0.5 * w->give;
}

static void foothold(const wording *w) {
  double asked = 0.0, reached = 0.0;
  if (!strcmp(w->row->detail, "forward") && missed_spacing(w, &asked, &reached)) {
    (void)snprintf(w->text, AMBULO__LINE_SIZE,
                   "the foothold of %s at t = %.4g s is %.2g m beyond reach: shorten the step "
                   "(gait.step_length, ends.travel) from %.4g m to %.4g m or less",
                   w->row->subject, w->row->time, asked - reached, asked,
                   floor(1000.0 * reached) / 1000.0);
  } else {
    (void)snprintf(w->text, AMBULO__LINE_SIZE,
                   "move the foothold of %s at t = %.4g s %s by %.4g m, or change the time of its "
                   "contact",
                   w->row->subject, w->row->time, w->row->detail, w->value);
  }
}

static void other(const wording *w) {
  (void)snprintf(w->text, AMBULO__LINE_SIZE, "let %s of %s (%s) give way by %.4g %s at t = %.4g s",
                 w->row->family, w->row->subject, w->row->detail, w->give, w->row->unit,
                 w->row->time);
}

/* the rest of the family that has to give way with it */
static void mention_others(const ambulo_conflict *c, char *text) {
  size_t used = strlen(text), room = AMBULO__LINE_SIZE - used;
  if (c->other_count == 0) return;
  const ambulo_violation *v = &c->others[0];
  if (c->other_count == 1) {
    (void)snprintf(text + used, room, "; likewise %s %s by %.4g %s", v->subject, v->detail,
                   v->worst, v->unit);
  } else {
    (void)snprintf(text + used, room, "; likewise the other rows named under %s", c->shared.family);
  }
}

void ambulo__suggest(const ambulo_problem *p, const ambulo__remedy *remedy,
                     ambulo__explanation *out) {
  if (remedy->conflict < 0) return;
  const ambulo__table_row *row = &p->table.rows[remedy->row];
  double value = remedy->value[remedy->row];
  wording w = {p, row, value, fabs(value), remedy->value, out->suggestion};
  if (is(&w, "torque_limit")) {
    limit(&w, "torque limit");
  } else if (is(&w, "speed_limit")) {
    limit(&w, "speed limit");
  } else if (is(&w, "joint_limit")) {
    limit(&w, "end of the range");
  } else if (is(&w, "initial_state") || is(&w, "final_state")) {
    end_value(&w);
  } else if (is(&w, "periodic") || is(&w, "mirrored")) {
    matching_ends(&w);
  } else if (is(&w, "zmp")) {
    zmp(&w);
  } else if (is(&w, "foot_strike")) {
    foothold(&w);
  } else {
    other(&w);
  }
  if (!remedy->single) mention_others(&out->conflict[remedy->conflict], out->suggestion);
}
