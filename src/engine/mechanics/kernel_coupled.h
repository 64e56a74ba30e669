/* mechanics/kernel_coupled.h - coupled joints around the kernels: expand before, fold after.
 *
 * A coupled joint l stands at theta_l = f_l(q_k) and has no coordinate. With ' the derivative by
 * q_k, its motion is
 *
 *     theta = f,   theta_d = f' qd,   theta_dd = f' qdd + f'' qd^2                          (K.1)
 *
 * and by virtual work, the torques of all joints that q_k moves, i its own,
 *
 *     tau_k = tau_i + sum f'_l tau_l                                                       (K.2)
 *
 * The root wrench, points and contacts are those of the joints' motion. By the chain rule a
 * gradient (g, gd, gdd) by the joints' motion becomes one by the coordinates', with w_k the weight
 * of tau_k, which weighs f'_l tau_l too:
 *
 *     gq_k   = g_i + sum [ f' g + f'' qd gd + (f''' qd^2 + f'' qdd) gdd + w_k f'' tau ]_l
 *     gqd_k  = gd_i + sum [ f' gd + 2 f'' qd gdd ]_l                                       (K.3)
 *     gqdd_k = gdd_i + sum [ f' gdd ]_l
 *
 * and an entry (row r, column l) of the Jacobians likewise, times f' where r is the row of a
 * coupled joint; f'' tau_l stands on the diagonal.
 */
#ifndef AMBULO_MECHANICS_KERNEL_COUPLED_H
#define AMBULO_MECHANICS_KERNEL_COUPLED_H

#include <string.h>

#include "mechanics/kernel_wide.h"
#include "mechanics/plan_coupled.h"

enum {
  slope_first = 0,
  slope_second = AMBULO__LANES,
  slope_drift = 2 * AMBULO__LANES,  /* f'' qd */
  slope_double = 3 * AMBULO__LANES, /* 2 f'' qd */
  slope_swing = 4 * AMBULO__LANES   /* f''' qd^2 + f'' qdd */
};

/* The motion of the joints. */
typedef struct coupled_motion {
  double *q, *qd, *qdd;
} coupled_motion;

AMBULO__INLINE coupled_motion coupled_motion_in(const ambulo__plan *plan, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  double *q = scratch + c->motion_at;
  const int joints = c->joint_count * AMBULO__LANES;
  return (coupled_motion){q, q + joints, q + 2 * joints};
}

AMBULO__INLINE const double *coupled_slopes(const struct ambulo__coupled_plan *c, int follower,
                                            const double *scratch) {
  return scratch + c->slopes_at + follower * follower_slopes;
}

/* (K.1) of one coupled joint in one node; to: its place in the motion of the joints. */
static void coupled_follow(const ambulo__follower *follower, double q, double qd, double qdd,
                           const coupled_motion *m, int to, double *slopes) {
  double f[AMBULO__COUPLING_SLOPES];
  m->q[to] = ambulo__coupling_value(&follower->function, q, f);
  m->qd[to] = f[0] * qd;
  m->qdd[to] = f[0] * qdd + f[1] * qd * qd;
  slopes[slope_first] = f[0];
  slopes[slope_second] = f[1];
  slopes[slope_drift] = f[1] * qd;
  slopes[slope_double] = 2 * (f[1] * qd);
  slopes[slope_swing] = f[2] * qd * qd + f[1] * qdd;
}

static void coupled_expand(const ambulo__plan *plan, const double *q, const double *qd,
                           const double *qdd, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  const coupled_motion m = coupled_motion_in(plan, scratch);
  for (int j = 0; j < c->joint_count; j++) {
    const int from = c->coordinate[j] * AMBULO__LANES, to = j * AMBULO__LANES;
    if (c->follower[j] >= 0) {
      double *slopes = scratch + c->slopes_at + c->follower[j] * follower_slopes;
      for (int lane = 0; lane < AMBULO__LANES; lane++)
        coupled_follow(&c->followers[c->follower[j]], q[from + lane], qd[from + lane],
                       qdd[from + lane], &m, to + lane, slopes + lane);
      continue;
    }
    memcpy(m.q + to, q + from, AMBULO__LANES * sizeof *q);
    memcpy(m.qd + to, qd + from, AMBULO__LANES * sizeof *q);
    memcpy(m.qdd + to, qdd + from, AMBULO__LANES * sizeof *q);
  }
}

/* to = or += factor from, lane by lane; factor NULL: 1 */
AMBULO__INLINE void coupled_add(double *to, const double *factor, const double *from) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    wide product = load(from + lane);
    if (factor) product *= load(factor + lane);
    store(to + lane, load(to + lane) + product);
  }
}

/* (K.2) */
static void coupled_fold_rows(const ambulo__plan *plan, double *out, const double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  const double *from = scratch + c->out_at;
  const int rows = ambulo__plan_rows(c->open) - c->joint_count;
  for (int j = 0; j < c->joint_count; j++) {
    if (c->follower[j] < 0)
      memcpy(out + c->coordinate[j] * AMBULO__LANES, from + j * AMBULO__LANES,
             AMBULO__LANES * sizeof *out);
  }
  for (int f = 0; f < c->follower_count; f++) {
    const ambulo__follower *follower = &c->followers[f];
    coupled_add(out + follower->coordinate * AMBULO__LANES, coupled_slopes(c, f, scratch),
                from + follower->joint * AMBULO__LANES);
  }
  memcpy(out + plan->coordinates * AMBULO__LANES, from + c->joint_count * AMBULO__LANES,
         (size_t)(rows * AMBULO__LANES) * sizeof *out);
}

/* Weights of the rows of `open`. */
static void coupled_weights(const ambulo__plan *plan, const double *weights, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  double *to = scratch + c->weights_at;
  const int rows = ambulo__plan_rows(c->open) - c->joint_count;
  for (int j = 0; j < c->joint_count; j++) {
    const double *from = weights + c->coordinate[j] * AMBULO__LANES;
    double *own = to + j * AMBULO__LANES;
    if (c->follower[j] < 0) {
      memcpy(own, from, AMBULO__LANES * sizeof *own);
    } else {
      memset(own, 0, AMBULO__LANES * sizeof *own);
      coupled_add(own, coupled_slopes(c, c->follower[j], scratch), from);
    }
  }
  memcpy(to + c->joint_count * AMBULO__LANES, weights + plan->coordinates * AMBULO__LANES,
         (size_t)(rows * AMBULO__LANES) * sizeof *to);
}

/* (K.3) what a coupled joint adds. */
static void coupled_fold_follower(const ambulo__plan *plan, int f, const double *weights,
                                  double *gq, double *gqd, double *gqdd, const double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  const ambulo__follower *follower = &c->followers[f];
  const double *s = coupled_slopes(c, f, scratch);
  const int joints = c->joint_count * AMBULO__LANES, at = follower->joint * AMBULO__LANES;
  const int to = follower->coordinate * AMBULO__LANES;
  const double *g = scratch + c->gradient_at + at, *tau = scratch + c->out_at + at;
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    const double *x = g + lane, *slope = s + lane;
    wide by_q = load(x), by_qd = load(x + joints), by_qdd = load(x + 2 * joints);
    wide first = load(slope + slope_first), weight = load(weights + to + lane);
    wide sum = load(gq + to + lane) + first * by_q;
    sum += load(slope + slope_drift) * by_qd;
    sum += load(slope + slope_swing) * by_qdd;
    sum += weight * (load(slope + slope_second) * load(tau + lane));
    store(gq + to + lane, sum);
    sum = load(gqd + to + lane) + first * by_qd;
    store(gqd + to + lane, sum + load(slope + slope_double) * by_qdd);
    store(gqdd + to + lane, load(gqdd + to + lane) + first * by_qdd);
  }
}

static void coupled_fold_gradient(const ambulo__plan *plan, const double *weights, double *gq,
                                  double *gqd, double *gqdd, const double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  const int joints = c->joint_count * AMBULO__LANES;
  for (int j = 0; j < c->joint_count; j++) {
    const double *g = scratch + c->gradient_at + j * AMBULO__LANES;
    const int to = c->coordinate[j] * AMBULO__LANES;
    if (c->follower[j] >= 0) continue;
    memcpy(gq + to, g, AMBULO__LANES * sizeof *g);
    memcpy(gqd + to, g + joints, AMBULO__LANES * sizeof *g);
    memcpy(gqdd + to, g + 2 * joints, AMBULO__LANES * sizeof *g);
  }
  for (int f = 0; f < c->follower_count; f++)
    coupled_fold_follower(plan, f, weights, gq, gqd, gqdd, scratch);
}

typedef struct coupled_entry {
  wide q, qd, qdd;
} coupled_entry;

/* (K.3) One entry of `open`, by the motion of the coordinates. */
AMBULO__INLINE coupled_entry coupled_term(const struct ambulo__coupled_plan *c,
                                          const ambulo__fold *fold, const double *scratch) {
  const wide zero = {0};
  coupled_entry e = {load(scratch + c->jq_at + fold->entry), zero, zero};
  if (fold->rate >= 0) {
    e.qd = load(scratch + c->jqd_at + fold->rate);
    e.qdd = load(scratch + c->jqdd_at + fold->mass);
  }
  if (fold->column >= 0) {
    const double *s = coupled_slopes(c, fold->column, scratch);
    const wide first = load(s + slope_first);
    e.q = first * e.q + load(s + slope_drift) * e.qd + load(s + slope_swing) * e.qdd;
    e.qd = first * e.qd + load(s + slope_double) * e.qdd;
    e.qdd = first * e.qdd;
  }
  wide factor = spread(fold->factor);
  if (fold->row >= 0) factor *= load(coupled_slopes(c, fold->row, scratch) + slope_first);
  return (coupled_entry){factor * e.q, factor * e.qd, factor * e.qdd};
}

static void coupled_entries(const ambulo__plan *plan, double *jq, double *jqd, double *jqdd,
                            const double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  for (int e = 0; e < c->entry_count; e++) {
    coupled_entry sum = {{0}, {0}, {0}};
    for (int i = c->fold_start[e]; i < c->fold_start[e + 1]; i++) {
      coupled_entry term = coupled_term(c, &c->folds[i], scratch);
      sum.q += term.q;
      sum.qd += term.qd;
      sum.qdd += term.qdd;
    }
    store(jq + e * AMBULO__LANES, sum.q);
    if (e >= plan->dynamic_count) continue;
    store(jqd + e * AMBULO__LANES, sum.qd);
    if (plan->by_qdd[e] == e) store(jqdd + e * AMBULO__LANES, sum.qdd);
  }
  for (int f = 0; f < c->follower_count; f++) {
    const ambulo__follower *follower = &c->followers[f];
    if (follower->diagonal < 0) continue;
    double *to = jq + follower->diagonal * AMBULO__LANES;
    const double *tau = scratch + c->out_at + follower->joint * AMBULO__LANES;
    const wide bend = load(coupled_slopes(c, f, scratch) + slope_second);
    store(to, load(to) + bend * load(tau));
  }
}

/* The factors of rows that react are sums of those of their joints; contacts have theirs. */
static void coupled_factors(const ambulo__plan *plan, double *jq, const double *scratch) {
  enum { size = AMBULO__CONTACT_FACTORS * AMBULO__LANES };
  const struct ambulo__coupled_plan *c = plan->coupled;
  const double *from = scratch + c->jq_at;
  const size_t reacting = (size_t)(plan->contact_factors - c->entry_count) * AMBULO__LANES;
  memset(jq + (size_t)c->entry_count * AMBULO__LANES, 0, reacting * sizeof *jq);
  for (int j = 0; j < c->joint_count; j++) {
    const ambulo__joint *joint = &c->open->joints[j];
    double *to = jq + plan->joints[c->coordinate[j]].factors * AMBULO__LANES;
    if (joint->torque_row != AMBULO__ROW_REACTS) continue;
    const double *slope =
        c->follower[j] < 0 ? NULL : coupled_slopes(c, c->follower[j], scratch) + slope_first;
    for (int k = 0; k < size; k += AMBULO__LANES)
      coupled_add(to + k, slope, from + joint->factors * AMBULO__LANES + k);
  }
  memcpy(jq + plan->contact_factors * AMBULO__LANES,
         from + c->open->contact_factors * AMBULO__LANES,
         (size_t)(6 * plan->contacts * size) * sizeof *jq);
}

#endif
