/* mechanics/kernel_jacobian_ground.h - Jacobians of a plan with ground reaction.
 *
 * With t_j the changes of the root wrench with q_j, qd_j or qdd_j, which are the columns t3, t2, t1
 * of kernel_jacobian.h, and W_i the sum of the feet's wrenches that joint i carries,
 *   dtau_i = [the same as without ground reaction] - (S_j x S_i) . W_i - S_i . dW_i,
 * the second term only for j above i and q: the turn of S_i no longer cancels, since the feet's
 * wrenches do not turn with the subtree. It reads - S_j . (-(S_i x* W_i)), with S x* f as there.
 * The split (kernel_ground.h) is linear in (M, F) but for z, so that S_i . dW_i is one product
 *   S_i . dW_i = R_i . (dM, dF) + e_i dz
 * of a row that joint i has once, S_i = (beta, s), u = beta x D, foot 0 (foot 1: gain and a_0 a_1
 * with the opposite sign; both feet: R = S, e = 0):
 *   R = (a beta + gain u x n,   a s + (a_0 a_1 + gain height) u - gain (s . D) n)
 *   e = -gain / z (u . V - F_n s . D)
 * For i above j or i = j, dtau_i/dq_j = (S_i - R_i) . t_j - e_i dz; for i on another limb
 * -R_i . t_j - e_i dz; for i below j that is added to what the pair of i and j has stored.
 * A joint j that carries the whole body has t1_j = I(S_j) with the inertia of the whole body, etc.,
 * and with R = (rho, sigma), (M, F) the root wrench, m the mass, h, P, E of the whole body
 *   R . t1_j = I(R) . S_j,     R . t2_j = I(R) . 2 Sd_j + 2 b . z_j,     b = E^T rho + P x sigma
 *   R . t3_j = I(R) . Sdd_j + b . 2 zd_j + (M x rho + F x sigma, F x rho) . S_j
 *   dz       = (h x n / m, n) . S_j
 * so that I(R), b etc. are taken off t1_i, t4_i once for all of these j, whose own rows vanish.
 * The centre of mass: c / dq_j is the linear part of t1_j over the mass, dz = n . dc. Feet:
 *   dF_0 = a_0 dF - gain (dF_n - F_n dz / z) D,   dF_1 = dF - dF_0
 *   dT   = (F . dM + M . dF - T dF_n) / F_n,      dT_f = a_f dT
 * Stored per joint with a dense row: S - R, -e / m, -R, -e / m; with it goes m dz = n . t1_j.
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H

#include "mechanics/kernel_jacobian.h"

/* What a column needs of the split. */
typedef struct ground_slopes {
  ground_shares shares;
  wide_pair twist; /* dT = twist . (dM, dF) */
  wide fall;       /* F_n / (m z) */
} ground_slopes;

/* R and e of the joints that carry feet. */
static void ground_reaction_rows(const ambulo__plan *plan, const ground_shares *shares,
                                 double *scratch) {
  const ground_shares g = *shares;
  wide_pair w = load_pair(scratch + plan->ground_at + ground_wrench);
  wide3 lever = ground_lever(plan, g.up, w);
  wide normal = dot3(g.up, w.linear), fall = g.gain / (g.height * plan->mass);
  wide slope = g.product + g.gain * plan->ground_height;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_DENSE) continue;
    double *out = scratch + joint->reaction_at;
    wide_pair s = load_pair(scratch + joint->motion_at), r = s;
    wide change = {0};
    if (joint->feet != 3) {
      double sign = joint->feet == 1 ? 1 : -1;
      wide share = g.share[joint->feet - 1], along = sign * dot3(s.linear, g.apart);
      wide3 u = scale3(spread(sign), cross3(s.angular, g.apart));
      r.angular = axpy3(scale3(share, s.angular), g.gain, cross3(u, g.up));
      r.linear = axpy3(axpy3(scale3(share, s.linear), slope, u), -g.gain * along, g.up);
      change = fall * (dot3(u, lever) - normal * along);
    }
    store_pair(out, (wide_pair){sub3(s.angular, r.angular), sub3(s.linear, r.linear)});
    store(out + 2 * three, change);
    store3(out + 2 * three + AMBULO__LANES, scale3(spread(-1), r.angular));
    store3(out + 3 * three + AMBULO__LANES, scale3(spread(-1), r.linear));
    store(out + 4 * three + AMBULO__LANES, change);
  }
}

/* Wrench of the feet that a joint carries. */
AMBULO__INLINE wide_pair ground_carried(const ambulo__plan *plan, int feet, const double *scratch) {
  const double *at = scratch + plan->ground_at;
  if (feet == 3) return load_pair(at + ground_wrench);
  if (feet) return load_pair(at + ground_foot + 2 * (feet - 1) * three);
  return (wide_pair){{{0}, {0}, {0}}, {{0}, {0}, {0}}};
}

/* -(S x* W), the turn of the feet's wrenches. */
AMBULO__INLINE wide_pair turn_of(wide_pair w, wide_pair s) {
  return (wide_pair){add_cross3(cross3(w.angular, s.angular), w.linear, s.linear),
                     cross3(w.linear, s.angular)};
}

/* What a row of tau meets in the motion of a joint above: t1, t4, and the turn of the wrenches. */
typedef struct row_changes {
  wide_pair force, turn;
  wide3 turned;
} row_changes;

/* Adds -R_i . t_j and -e_i dz of joints j that carry the whole body, `row` = (-R, -e / m). */
AMBULO__INLINE row_changes ground_add_whole(const ambulo__plan *plan, row_changes c,
                                            const double *row, const double *scratch) {
  const double *whole = scratch + plan->frames[plan->whole].composite_at;
  wide mass = spread(plan->mass);
  wide3 h = load3(whole + composite_first), p = load3(whole + composite_momentum);
  wide6 inertia = load6(whole + composite_inertia);
  wide33 e = load33(whole + composite_coriolis);
  wide_pair r = load_pair(row), w = load_pair(scratch + plan->ground_at + ground_wrench);
  wide3 up = scale3(load(row + 2 * three), ground_up(plan));
  c.force.angular = add_cross3(add3(c.force.angular, multiply6(inertia, r.angular)), h, r.linear);
  c.force.linear = add_cross3(axpy3(c.force.linear, mass, r.linear), r.angular, h);
  c.turned = add_multiply33_transposed(add_cross3(c.turned, p, r.linear), e, r.angular);
  c.turn.angular = add_cross3(add_cross3(c.turn.angular, w.angular, r.angular), w.linear, r.linear);
  c.turn.angular = add_cross3(c.turn.angular, h, up);
  c.turn.linear = add_cross3(axpy3(c.turn.linear, mass, up), w.linear, r.angular);
  return c;
}

/* Columns of a row that stand for the joints that carry the whole body. */
AMBULO__INLINE void ground_root_pairs(const ambulo__root_column *roots, int count, int start,
                                      const row_changes *row, double *jq, double *jqd, double *jqdd,
                                      const double *scratch) {
  const row_changes c = *row;
  for (int i = 0; i < count; i++) {
    const double *motion = scratch + roots[i].motion;
    int entry = start + roots[i].column;
    wide_pair s = load_pair(motion);
    if (roots[i].straight) {
      store(jq + entry, dot3(c.turn.linear, s.linear));
      store(jqd + entry, (wide){0});
      store(jqdd + entry, dot3(c.force.linear, s.linear));
      continue;
    }
    wide_pair sd = load_pair(motion + 2 * three), sdd = load_pair(motion + 4 * three);
    wide turned = dot3(c.turned, s.angular);
    store(jq + entry, dot3(c.turned, sd.angular) + dot_pair(c.force, sdd) + dot_pair(c.turn, s));
    store(jqd + entry, 2 * turned + dot_pair(c.force, sd));
    store(jqdd + entry, dot_pair(c.force, s));
  }
}

/* Entries in the row and, where that row is sparse, in the column of joint k. */
static void ground_pairs(const ambulo__plan *plan, int k, const subtree_changes *changes,
                         wide_pair carried, double *jq, double *jqd, double *jqdd,
                         const double *scratch) {
  const subtree_changes t = *changes;
  const int dense = plan->joints[k].torque_row == AMBULO__ROW_DENSE;
  const ambulo__ground_pair *pairs = plan->pairs;
  const double *own = scratch + plan->joints[k].motion_at;
  int first = plan->ancestor_start[k], last = plan->ancestor_start[k + 1];
  int start = plan->start[k] * AMBULO__LANES, self = start + (last - first) * AMBULO__LANES;
  wide_pair z = load_pair(own);
  row_changes row = {t.qdd, turn_of(carried, z), t.turned};
  if (dense && plan->vanishing > 0) {
    const double *reaction = scratch + plan->joints[k].reaction_at + 7 * AMBULO__LANES;
    row_changes to_root = ground_add_whole(plan, row, reaction, scratch);
    ground_root_pairs(plan->roots, plan->vanishing, start, &to_root, jq, jqd, jqdd, scratch);
    first += plan->vanishing;
  }
  for (int i = first; i < last; i++) {
    const double *motion = scratch + pairs[i].motion;
    int lower = pairs[i].lower, upper = pairs[i].upper;
    wide_pair s = load_pair(motion);
    wide mass = jacobian_lower(&t, s, motion, lower, jq, jqd);
    store(jqdd + lower, mass);
    if (dense) store(jq + lower, load(jq + lower) + dot_pair(row.turn, s));
    if (upper < 0) continue;
    store(jq + upper, dot_pair(t.q, s));
    store(jqd + upper, dot_pair(t.qd, s));
    store(jqdd + upper, mass);
  }
  if (dense) return;
  store(jq + self, dot_pair(t.q, z));
  store(jqd + self, dot_pair(t.qd, z));
  store(jqdd + self, dot_pair(t.qdd, z));
}

/* Column k of the dense rows. */
AMBULO__INLINE void ground_column(const ambulo__reaction_term *term, int fresh, int count,
                                  const subtree_changes *t, wide rise, double *jq, double *jqd,
                                  double *jqdd, const double *scratch) {
  const wide_pair q = t->q, qd = t->qd, qdd = t->qdd;
  for (int i = 0; i < fresh; i++) {
    int entry = term[i].entry;
    const double *row = scratch + term[i].row_at;
    wide_pair r = load_pair(row);
    store(jq + entry, dot_pair(r, q) + load(row + 2 * three) * rise);
    store(jqd + entry, dot_pair(r, qd));
    store(jqdd + entry, dot_pair(r, qdd));
  }
  for (int i = fresh; i < count; i++) {
    int entry = term[i].entry;
    const double *row = scratch + term[i].row_at;
    wide_pair r = load_pair(row);
    store(jq + entry, load(jq + entry) + dot_pair(r, q) + load(row + 2 * three) * rise);
    store(jqd + entry, load(jqd + entry) + dot_pair(r, qd));
    store(jqdd + entry, load(jqdd + entry) + dot_pair(r, qdd));
  }
}

/* A column of the feet's rows, which are full, of d doubles: `out` is its entry in the first of
 * them, `rise` is m dz. */
AMBULO__INLINE void ground_feet_column(int d, const ground_slopes *slopes, wide_pair t, wide rise,
                                       double *out) {
  const ground_shares *s = &slopes->shares;
  wide shear = s->gain * (dot3(s->up, t.linear) - slopes->fall * rise);
  wide3 first = axpy3(scale3(s->share[0], t.linear), -shear, s->apart);
  wide3 second = sub3(t.linear, first);
  wide twist = dot_pair(slopes->twist, t);
  store(out, first.x);
  store(out + d, first.y);
  store(out + 2 * d, first.z);
  store(out + 3 * d, s->share[0] * twist);
  store(out + 4 * d, second.x);
  store(out + 5 * d, second.y);
  store(out + 6 * d, second.z);
  store(out + 7 * d, s->share[1] * twist);
}

static ground_slopes ground_slopes_of(const ambulo__plan *plan, const double *ground,
                                      const double *scratch) {
  const double *at = scratch + plan->ground_at;
  wide_pair w = load_pair(at + ground_wrench);
  ground_slopes slopes = {.shares = ground_load(plan, ground, load(at + ground_height))};
  wide normal = dot3(slopes.shares.up, w.linear), inverse = 1 / normal;
  wide3 moment = axpy3(w.angular, -load(at + ground_twist), slopes.shares.up);
  slopes.twist = (wide_pair){scale3(inverse, w.linear), scale3(inverse, moment)};
  slopes.fall = normal / (slopes.shares.height * plan->mass);
  return slopes;
}

/* What a column has for the root wrench, the feet and the centre of mass. */
typedef struct ground_outputs {
  double *jq, *jqd, *jqdd; /* the arrays */
  int feet, rates, center; /* entries where the feet's rows begin, in jq and jqd, and those of c */
  int row;                 /* doubles in a full row */
  wide inverse_mass;
} ground_outputs;

/* Writes them for the column of joint k; returns m dz. */
AMBULO__INLINE wide ground_outputs_of(const ambulo__plan *plan, const ground_slopes *slopes,
                                      const ground_outputs *to, int k, const subtree_changes *t) {
  const wide none = {0};
  wide rise = dot3(slopes->shares.up, t->qdd.linear);
  wide3 dc = scale3(to->inverse_mass, t->qdd.linear);
  double *center = to->jq + (to->center + k) * AMBULO__LANES;
  jacobian_wrench(plan, k, t->q, to->jq);
  jacobian_wrench(plan, k, t->qd, to->jqd);
  jacobian_wrench(plan, k, t->qdd, to->jqdd);
  ground_feet_column(to->row, slopes, t->q, rise, to->jq + (to->feet + k) * AMBULO__LANES);
  ground_feet_column(to->row, slopes, t->qd, none, to->jqd + (to->rates + k) * AMBULO__LANES);
  ground_feet_column(to->row, slopes, t->qdd, none, to->jqdd + (to->rates + k) * AMBULO__LANES);
  store(center, dc.x);
  store(center + to->row, dc.y);
  store(center + 2 * to->row, dc.z);
  return rise;
}

/* Columns of the joints that carry the whole body. */
static void ground_root_columns(const ambulo__plan *plan, const ground_slopes *slopes,
                                const ground_outputs *to, const double *scratch) {
  wide_pair w = load_pair(scratch + plan->ground_at + ground_wrench);
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_VANISHES) continue;
    subtree_changes t = jacobian_changes(&plan->steps.changes[k], w, scratch);
    ground_outputs_of(plan, slopes, to, k, &t);
  }
}

static void jacobian_ground_part(const ambulo__plan *plan, const double *qd, const double *ground,
                                 double *jq, double *jqd, double *jqdd, double *scratch) {
  const int row = ambulo__plan_first_foot_row(plan), d = plan->coordinates;
  const ground_outputs to = {jq,
                             jqd,
                             jqdd,
                             plan->start[row],
                             plan->rate_start[row],
                             plan->start[row + 8],
                             d * AMBULO__LANES,
                             spread(1 / plan->mass)};
  jacobian_motion(plan, qd, scratch);
  ground_slopes slopes = ground_slopes_of(plan, ground, scratch);
  ground_reaction_rows(plan, &slopes.shares, scratch);
  for (int k = d - 1; k >= 0; k--) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row == AMBULO__ROW_VANISHES) continue;
    wide_pair carried = ground_carried(plan, joint->feet, scratch);
    wide_pair bodies = load_pair(scratch + plan->frames[k + 1].load_at);
    bodies = axpy_pair(bodies, spread(1), carried);
    subtree_changes t = jacobian_changes(&plan->steps.changes[k], bodies, scratch);
    wide rise = ground_outputs_of(plan, &slopes, &to, k, &t);
    ground_pairs(plan, k, &t, carried, jq, jqd, jqdd, scratch);
    ground_column(plan->term + k * plan->dense_count, plan->term_fresh[k], plan->dense_count, &t,
                  rise, jq, jqd, jqdd, scratch);
  }
  ground_root_columns(plan, &slopes, &to, scratch);
  jacobian_points(plan, jq, scratch);
}

#endif
