/* solver/suggest.c - one suggestion (explain.h): limits, ends, tubes, and the choice among rows.
 */
#include "solver/explain.h"

#include "contact/row_families.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double settled = 1e-5; /* of a value: what is left of zero after a descent */
static const double travels = 1e-9; /* m: a row whose two ends are that far apart has the travel */

static double degrees(double angle) {
  return angle * 57.29577951308232;
}

/* " (12 deg)" after angles */
static const char *in_degrees(const ambulo__advice *a, double angle, char buffer[32]) {
  buffer[0] = '\0';
  if (a->row->measure == AMBULO__RADIANS) (void)snprintf(buffer, 32, " (%.3g deg)", degrees(angle));
  return buffer;
}

/* --------------------------------------------------------------------- limits */

/* "model.links[shank_l].coordinate.range=[0, 70]" with one of the two limits of coordinate i
 * replaced; units of the model's file */
static void set_limit(const ambulo__advice *a, int i, const char *key, const double limits[2],
                      int upper, double value, double unit) {
  const ambulo_model *model = a->problem->model;
  char text[2][32];
  if (!(unit > 0.0)) return;
  for (int k = 0; k < 2; k++) {
    double bound = (k == upper ? value : limits[k]) / unit;
    if (isfinite(bound))
      (void)snprintf(text[k], sizeof text[k], "%.6g",
                     k == upper ? ambulo__outward(bound, upper) : bound);
    else
      (void)snprintf(text[k], sizeof text[k], "none");
  }
  ambulo__advice_set(a, "model.links[%s].coordinate.%s=[%s, %s]",
                     model->links[model->coordinate_written[i]].name, key, text[0], text[1]);
}

/* the partner's limit binds in the mirrored half of the stride: both have to move */
static void set_both(const ambulo__advice *a, const char *key, ambulo_limited what, int upper,
                     double value) {
  const ambulo_model *model = a->problem->model;
  int i = ambulo_model_find_coordinate(model, a->row->subject);
  if (i < 0) return;
  const ambulo_coordinate *c = &model->coordinates[i];
  int m = a->problem->definition.ends == AMBULO_ENDS_MIRRORED && c->mirror >= 0 ? c->mirror : i;
  int angle = c->type == AMBULO_REVOLUTE;
  const ambulo__model_units *u = &model->units;
  double unit = angle ? u->angle : u->length;
  if (what == AMBULO_LIMITED_TORQUE) unit = angle ? u->moment : u->force;
  set_limit(a, i, key, ambulo__limits_of(c, what), upper, value, unit);
  if (m == i) return;
  int turned = c->mirror_sign < 0 ? !upper : upper;
  const double *limits = ambulo__limits_of(&model->coordinates[m], what);
  double mirrored = c->mirror_sign < 0 ? -value : value;
  if (turned ? limits[1] < mirrored : limits[0] > mirrored)
    set_limit(a, m, key, limits, turned, mirrored, unit);
}

static void limit(const ambulo__advice *a, ambulo_limited what) {
  static const char *const words[] = {[AMBULO_LIMITED_POSITION] = "end of the range",
                                      [AMBULO_LIMITED_SPEED] = "speed limit",
                                      [AMBULO_LIMITED_TORQUE] = "torque limit"};
  static const char *const keys[] = {[AMBULO_LIMITED_POSITION] = "range",
                                     [AMBULO_LIMITED_SPEED] = "speed",
                                     [AMBULO_LIMITED_TORQUE] = "torque"};
  char from[32], to[32];
  int upper = !strcmp(a->row->detail, "upper");
  double bound = ambulo__limit_given(a->problem->model, a->row);
  double enough = ambulo__outward(upper ? bound + a->room : bound - a->room, upper);
  ambulo__advice_say(a, "%s the %s %s of %s by %.4g %s: from %.4g%s to %.4g %s%s",
                     upper ? "raise" : "lower", a->row->detail, words[what], a->row->subject,
                     a->give, a->row->unit, bound, in_degrees(a, bound, from), enough, a->row->unit,
                     in_degrees(a, enough, to));
  set_both(a, keys[what], what, upper, enough);
}

/* ----------------------------------------------------------------------- ends */

static void end_value(const ambulo__advice *a) {
  char from[32], to[32];
  double asked = -a->row->constant, reached = asked + a->value;
  if (fabs(reached) < settled) reached = 0.0;
  int final = a->row->kind == AMBULO__KIND_FINAL_STATE;
  const char *end = final ? "final" : "initial";
  ambulo__advice_say(a,
                     "ask for another %s %s of %s at t = %.4g s: %.4g %s%s instead of %.4g %s%s, "
                     "or give the motion more time",
                     end, a->row->detail, a->row->subject, a->row->time, reached, a->row->unit,
                     in_degrees(a, reached, from), asked, a->row->unit, in_degrees(a, asked, to));
  const ambulo_model *model = a->problem->model;
  int i = ambulo_model_find_coordinate(model, a->row->subject);
  if (i < 0) return;
  const char *key = !strcmp(a->row->detail, "value")  ? ""
                    : !strcmp(a->row->detail, "rate") ? "_speed"
                                                      : "_acceleration";
  double unit = model->coordinates[i].type == AMBULO_REVOLUTE ? a->problem->keys.radians : 1.0;
  if (unit > 0.0)
    ambulo__advice_set(a, "ends.%s%s.%s=%.7g", end, key, a->row->subject, reached / unit);
}

static void free_ends(const ambulo__advice *a) {
  ambulo__advice_say(a,
                     "the two ends of %s (%s) stay %.4g %s apart: leave the ends free, or drop "
                     "what else fixes its state there",
                     a->row->subject, a->row->detail, a->give, a->row->unit);
  ambulo__advice_set(a, "ends.kind=free");
  if (a->problem->definition.rise != 0.0) ambulo__advice_set(a, "ends.rise=0");
}

static void matching_ends(const ambulo__advice *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  if (strcmp(a->row->detail, "value") != 0 || !(fabs(a->row->constant) > travels)) {
    free_ends(a);
    return;
  }
  double sign = -a->row->constant / d->travel, reached = d->travel + sign * a->value;
  if (fabs(reached) < settled) reached = 0.0;
  if (d->contact_count > 0) {
    ambulo__advice_say(a,
                       "%s gets %.4g m forward where %.4g m are asked for: shorter steps, whose "
                       "footholds go with it, or more time",
                       a->row->subject, reached, d->travel);
    ambulo__advice_set_step(a, reached / fmax(1.0, (double)a->problem->keys.steps));
    return;
  }
  ambulo__advice_say(a, "change the travel from %.4g m to %.4g m, which the other rows allow (%s)",
                     d->travel, reached, a->row->subject);
  ambulo__advice_set(a, "ends.travel=%.7g", reached);
}

/* ----------------------------------------------------------------------- tubes */

static void tube(const ambulo__advice *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  const ambulo_model *model = a->problem->model;
  int i = ambulo_model_find_coordinate(model, a->row->subject), only = -1;
  for (int t = 0; t < d->tube_count && i >= 0; t++) {
    if (isfinite(d->tubes[t].half_width[i])) only = only < 0 ? t : d->tube_count;
  }
  ambulo__advice_say(a,
                     "let %s leave the motion that it follows by %.4g %s more (t = %.4g s), as a "
                     "wider tube does",
                     a->row->subject, a->give, a->row->unit, a->row->time);
  if (only < 0 || only >= d->tube_count) return;
  double unit = model->coordinates[i].type == AMBULO_REVOLUTE ? a->problem->keys.radians : 1.0;
  double width = d->tubes[only].half_width[i] + a->room;
  if (unit > 0.0)
    ambulo__advice_set(a, "constraints.tubes[%d].coordinates.%s=%.6g", only, a->row->subject,
                       ambulo__outward(width / unit, 1));
}

/* ------------------------------------------------------------------------ all */

static void other(const ambulo__advice *a) {
  ambulo__advice_say(a, "let %s of %s (%s) give way by %.4g %s at t = %.4g s", a->row->family,
                     a->row->subject, a->row->detail, a->give, a->row->unit, a->row->time);
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
  double give = fabs(value), room = give + fmax(0.01 * give, 2.0 * AMBULO__HOLDS * row->size);
  ambulo__advice a = {p, row, value, give, room, remedy->value, out};
  const ambulo__row_kind_entry *kind = ambulo__row_kind_entry_of(row->kind);
  if (kind->limited != AMBULO__NOT_LIMITED) {
    limit(&a, (ambulo_limited)kind->limited);
  } else if (kind->place == AMBULO__AT_AN_END) {
    end_value(&a);
  } else if (kind->place == AMBULO__ACROSS_ENDS) {
    matching_ends(&a);
  } else if (row->kind == AMBULO__KIND_TRACKING_TUBE) {
    tube(&a);
  } else if (!ambulo__advise_feet(&a) && !ambulo__advise_forces(&a) && !ambulo__advise_bodies(&a)) {
    other(&a);
  }
  if (!remedy->single) mention_others(&out->conflict[remedy->conflict], out->suggestion);
}
