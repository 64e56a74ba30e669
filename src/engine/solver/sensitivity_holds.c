/* solver/sensitivity_holds.c - the numbers of what hands hold, through its forces.
 *
 * Forces and moments of the hands (ambulo/hold.h) are linear in the mass m, the inertia I and the
 * push P, and all of them in the window w; with the middle's c = (a_1 + a_2) / 2 - g, d = p_2 -
 * p_1, e = a_2 - a_1, s = d . d, for F the sum and mu the moment about the middle:
 *
 *     f = F / 2 -+ ((w I (e - d (d . e) / s) + mu x d) / s),   moments d (d . mu) / (2 s)
 *
 *     mass m            F = w c,  mu = o x w c            center o    mu = o. x w m c
 *     inertia I         w (e - d (d . e) / s)             push P      F = w P.
 *     slope             F = -w m dg/ds,  mu = o x F       window w    L_w = m L_m + I L_I + P . L_P
 *                                                                     of w = 1
 *
 * What such forces and moments pull at is that of any force on a link (node_forces.h). L_w goes to
 * `from`, `to` and `ramp`, to the node's time, and to the duration, of which nodes are fixed shares
 * while the window stays in seconds. Of all masses alike nothing is as large as the body: what the
 * hands hold has w L_w of it.
 */
#include "solver/node_forces.h"

#include "base/arithmetic.h"
#include "contact/hold_times.h"
#include "model/model.h"

/* A hold at a node, and what it asks of the hands. */
typedef struct held {
  ambulo__node_forces *f;
  const ambulo_hold *hold;
  int hands;
  double place[2][3], line[3], apart[3], square; /* p_k, d, e, s */
  double drive[3], center[3];                    /* c, o */
} held;

static held held_at(ambulo__node_forces *f, const ambulo_hold *hold) {
  const ambulo_model *m = f->s->problem->model;
  held h = {.f = f, .hold = hold, .hands = hold->hand[1] >= 0 ? 2 : 1};
  double acceleration[2][3];
  for (int i = 0; i < h.hands; i++) {
    const ambulo_point *point = &m->points[hold->hand[i]];
    ambulo__pose_point(&f->pose, point->link, point->position, h.place[i]);
    ambulo__node_forces_acceleration(f, point->link, h.place[i], acceleration[i]);
    for (int k = 0; k < 3; k++) h.drive[k] += acceleration[i][k] / h.hands;
  }
  for (int k = 0; k < 3; k++) {
    h.drive[k] -= m->gravity[k];
    if (h.hands < 2) continue;
    h.line[k] = h.place[1][k] - h.place[0][k];
    h.apart[k] = acceleration[1][k] - acceleration[0][k];
  }
  h.square = ambulo__dot(h.line, h.line);
  ambulo__along_axes(m, hold->center, h.center);
  return h;
}

/* what F, mu and the inertia, times w, pull at */
static double pull_of(const held *h, const double force[3], const double twist[3], double inertia) {
  const ambulo_problem_definition *d = &h->f->s->problem->definition;
  double couple[3];
  ambulo__node_forces_clear(h->f);
  ambulo__cross(twist, h->line, couple);
  for (int i = 0; i < h->hands; i++) {
    int link = d->model->points[h->hold->hand[i]].link;
    double own[3], moment[3] = {0.0, 0.0, 0.0}, side = i ? 1.0 : -1.0;
    for (int k = 0; k < 3; k++) {
      own[k] = force[k] / h->hands;
      if (h->hands < 2) continue;
      double stretch = ambulo__dot(h->line, h->apart) / h->square;
      own[k] += side * (inertia * (h->apart[k] - stretch * h->line[k]) + couple[k]) / h->square;
      moment[k] = h->line[k] * ambulo__dot(h->line, twist) / (2.0 * h->square);
    }
    ambulo__node_forces_add(h->f, link, h->place[i], own);
    ambulo__node_forces_turn(h->f, link, moment);
  }
  return ambulo__node_forces_pull(h->f);
}

/* a mass of 1 kg with the drive, in a window of 1 */
static double pull_of_mass(const held *h, const double drive[3]) {
  double twist[3];
  ambulo__cross(h->center, drive, twist);
  return pull_of(h, drive, twist, 0.0);
}

/* L_w, and the numbers of the law in a window w */
static double add_law(const held *h, double window, double *by) {
  static const double none[3] = {0.0, 0.0, 0.0};
  const ambulo_hold *hold = h->hold;
  const ambulo_model *m = h->f->s->problem->model;
  double mass = pull_of_mass(h, h->drive), inertia = 0.0, sum = hold->mass * mass;
  if (h->hands == 2) inertia = pull_of(h, none, none, 1.0);
  sum += hold->inertia * inertia;
  by[AMBULO__HOLD_MASS] += window * mass;
  by[AMBULO__HOLD_INERTIA] += window * inertia;
  for (int k = 0; k < 3; k++) {
    double unit[3] = {k == 0, k == 1, k == 2}, axis[3], twist[3];
    ambulo__along_axes(m, unit, axis);
    double push = pull_of(h, axis, none, 0.0);
    sum += hold->force[k] * push;
    by[AMBULO__HOLD_FORCE + k] += window * push;
    if (h->hands < 2) continue;
    ambulo__cross(axis, h->drive, twist);
    by[AMBULO__HOLD_CENTER + k] += window * hold->mass * pull_of(h, none, twist, 0.0);
  }
  return sum;
}

static void add_hold(ambulo__node_forces *f, int i, const double turn[3],
                     ambulo__partials *partials) {
  const ambulo_problem *p = f->s->problem;
  const ambulo_hold *hold = &p->definition.holds[i];
  double duration = p->definition.duration, time = p->times[f->node], against[3];
  ambulo__hold_slopes w = ambulo__hold_slopes_at(hold, duration, time);
  double *by = partials->hold + (size_t)i * AMBULO__HOLD_NUMBERS;
  if (w.value == 0.0) return; /* its slopes are zero, too */
  const held h = held_at(f, hold);
  double pull = add_law(&h, w.value, by);
  by[AMBULO__HOLD_FROM] += pull * w.by_from;
  by[AMBULO__HOLD_TO] += pull * w.by_to;
  by[AMBULO__HOLD_RAMP] += pull * w.by_ramp;
  partials->node_time[f->node] += pull * w.by_time;
  partials->duration += pull * w.by_time * time / duration;
  partials->of_others -= w.value * pull;
  for (int k = 0; k < 3; k++) against[k] = -turn[k];
  partials->slope += w.value * hold->mass * pull_of_mass(&h, against);
}

/* (S.21) L_m, L_I, L_o, L_P, L_w */
ambulo_status ambulo__partials_of_holds(const ambulo__stationary *s, ambulo__pool *pool,
                                        ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  ambulo__node_forces f;
  double turn[3];
  if (p->definition.hold_count == 0) return AMBULO_OK;
  ambulo_status status = ambulo__node_forces_create(s, pool, &f);
  if (status) return status;
  ambulo__turn_of_gravity(p->model, turn);
  for (int node = 0; node < p->nodes; node++) {
    ambulo__node_forces_at(&f, node);
    for (int i = 0; i < p->definition.hold_count; i++) add_hold(&f, i, turn, partials);
  }
  ambulo__node_forces_free(&f);
  return AMBULO_OK;
}
