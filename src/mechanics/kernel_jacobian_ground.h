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
 * Stored per joint with a dense row: S - R, -e, -R, -e.
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H

#include "mechanics/kernel_jacobian.h"

/* What a column needs of the split. */
typedef struct ground_slopes {
  ground_shares shares;
  wide_pair twist; /* dT = twist . (dM, dF) */
  wide fall;       /* F_n / z */
} ground_slopes;

/* R and e of the joints that carry feet. */
static void ground_reaction_rows(const ambulo__plan *plan, const ground_shares *shares,
                                 double *scratch) {
  const ground_shares g = *shares;
  wide_pair w = load_pair(scratch + plan->ground_at + ground_wrench);
  wide3 lever = ground_lever(plan, g.up, w);
  wide normal = dot3(g.up, w.linear), fall = g.gain / g.height;
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

/* A displacement along an axis that stands still: it adds no rates, and turns nothing. */
AMBULO__INLINE int ground_is_straight(const ambulo__joint *joint) {
  return !joint->revolute && joint->still;
}

/* The changes of kernel_jacobian.h for such a joint. */
AMBULO__INLINE subtree_changes ground_straight_changes(const ambulo__plan *plan, int k, wide_pair f,
                                                       const double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  const ambulo__frame *frame = &plan->frames[k + 1];
  wide3 s = load3(scratch + plan->joints[k].motion_at + three);
  wide3 h = load3(scratch + frame->composite_at + composite_first);
  subtree_changes t = {{zero, zero}, {zero, zero}, {zero, zero}, zero};
  t.q.angular = cross3(s, f.linear);
  t.qdd.angular = cross3(h, s);
  t.qdd.linear = scale3(spread(frame->subtree_mass), s);
  t.turned = cross3(load3(scratch + frame->composite_at + composite_momentum), s);
  return t;
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

/* Adds -R_i . t_j and -e_i dz of joints j that carry the whole body, `row` = (-R, -e). */
AMBULO__INLINE row_changes ground_add_whole(const ambulo__plan *plan, row_changes c,
                                            const double *row, const double *scratch) {
  const double *whole = scratch + plan->frames[plan->whole].composite_at;
  wide mass = spread(plan->mass), change = load(row + 2 * three) / mass;
  wide3 h = load3(whole + composite_first), p = load3(whole + composite_momentum);
  wide6 inertia = load6(whole + composite_inertia);
  wide33 e = load33(whole + composite_coriolis);
  wide_pair r = load_pair(row), w = load_pair(scratch + plan->ground_at + ground_wrench);
  wide3 up = scale3(change, ground_up(plan));
  c.force.angular = add_cross3(add3(c.force.angular, multiply6(inertia, r.angular)), h, r.linear);
  c.force.linear = add_cross3(axpy3(c.force.linear, mass, r.linear), r.angular, h);
  c.turned = add_multiply33_transposed(add_cross3(c.turned, p, r.linear), e, r.angular);
  c.turn.angular = add_cross3(add_cross3(c.turn.angular, w.angular, r.angular), w.linear, r.linear);
  c.turn.angular = add_cross3(c.turn.angular, h, up);
  c.turn.linear = add_cross3(axpy3(c.turn.linear, mass, up), w.linear, r.angular);
  return c;
}

/* Columns of a row that stand for the joints that carry the whole body. */
AMBULO__INLINE void ground_root_pairs(const ambulo__plan *plan, int first, const row_changes *row,
                                      double *jq, double *jqd, double *jqdd,
                                      const double *scratch) {
  const row_changes c = *row;
  wide3 turned2 = scale3(spread(2), c.turned);
  for (int i = first; i < first + plan->vanishing; i++) {
    const ambulo__joint *joint = &plan->joints[plan->ancestor[i]];
    const double *motion = scratch + joint->motion_at;
    int entry = plan->lower[i] * AMBULO__LANES;
    wide_pair s = load_pair(motion);
    if (ground_is_straight(joint)) {
      store(jq + entry, dot3(c.turn.linear, s.linear));
      store(jqd + entry, (wide){0});
      store(jqdd + entry, dot3(c.force.linear, s.linear));
      continue;
    }
    wide_pair sd = load_pair(motion + 2 * three), sdd = load_pair(motion + 4 * three);
    store(jq + entry, dot3(c.turned, sd.angular) + dot_pair(c.force, sdd) + dot_pair(c.turn, s));
    store(jqd + entry, dot3(turned2, s.angular) + dot_pair(c.force, sd));
    store(jqdd + entry, dot_pair(c.force, s));
  }
}

/* Entries in the row and, where that row is sparse, in the column of joint k. */
static void ground_pairs(const ambulo__plan *plan, int k, const subtree_changes *changes,
                         wide_pair carried, double *jq, double *jqd, double *jqdd,
                         const double *scratch) {
  const subtree_changes t = *changes;
  const double *own = scratch + plan->joints[k].motion_at;
  const int dense = plan->joints[k].torque_row == AMBULO__ROW_DENSE;
  int first = plan->ancestor_start[k], last = plan->ancestor_start[k + 1];
  int self = (plan->start[k] + last - first) * AMBULO__LANES;
  wide3 turned2 = scale3(spread(2), t.turned);
  wide_pair z = load_pair(own);
  row_changes row = {t.qdd, turn_of(carried, z), t.turned};
  if (dense && plan->vanishing > 0) {
    const double *reaction = scratch + plan->joints[k].reaction_at + 7 * AMBULO__LANES;
    row_changes to_root = ground_add_whole(plan, row, reaction, scratch);
    ground_root_pairs(plan, first, &to_root, jq, jqd, jqdd, scratch);
    first += plan->vanishing;
  }
  for (int i = first; i < last; i++) {
    const double *motion = scratch + plan->joints[plan->ancestor[i]].motion_at;
    int lower = plan->lower[i] * AMBULO__LANES, upper = plan->upper[i] * AMBULO__LANES;
    wide_pair s = load_pair(motion), sd = load_pair(motion + 2 * three);
    wide_pair sdd = load_pair(motion + 4 * three);
    wide mass = dot_pair(t.qdd, s);
    store(jq + lower, dot3(t.turned, sd.angular) + dot_pair(t.qdd, sdd) + dot_pair(row.turn, s));
    store(jqd + lower, dot3(turned2, s.angular) + dot_pair(t.qdd, sd));
    store(jqdd + lower, mass);
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
static void ground_column(const ambulo__plan *plan, int k, const subtree_changes *changes, wide dz,
                          double *jq, double *jqd, double *jqdd, const double *scratch) {
  const wide_pair q = changes->q, qd = changes->qd, qdd = changes->qdd;
  const ambulo__reaction_term *term = plan->term + (size_t)k * (size_t)plan->dense_count;
  for (int i = 0; i < plan->dense_count; i++) {
    int entry = term[i].entry * AMBULO__LANES;
    const double *row = scratch + term[i].row_at;
    wide_pair r = load_pair(row);
    wide by_q = dot_pair(r, q) + load(row + 2 * three) * dz;
    wide by_qd = dot_pair(r, qd), by_qdd = dot_pair(r, qdd);
    if (i >= plan->term_fresh[k]) {
      by_q += load(jq + entry);
      by_qd += load(jqd + entry);
      by_qdd += load(jqdd + entry);
    }
    store(jq + entry, by_q);
    store(jqd + entry, by_qd);
    store(jqdd + entry, by_qdd);
  }
}

/* A column of the feet's rows, which are full: `out` is its entry in the first of them. */
AMBULO__INLINE void ground_feet_column(const ambulo__plan *plan, const ground_slopes *slopes,
                                       wide_pair t, wide dz, double *out) {
  const ground_shares *s = &slopes->shares;
  const int d = plan->coordinates * AMBULO__LANES;
  wide shear = s->gain * (dot3(s->up, t.linear) - slopes->fall * dz);
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
  slopes.fall = normal / slopes.shares.height;
  return slopes;
}

static void jacobian_ground_part(const ambulo__plan *plan, const double *qd, const double *ground,
                                 double *jq, double *jqd, double *jqdd, double *scratch) {
  const int row = ambulo__plan_first_foot_row(plan), d = plan->coordinates;
  const int feet = plan->start[row], rates = plan->rate_start[row], center = plan->start[row + 8];
  jacobian_motion(plan, qd, scratch);
  ground_slopes slopes = ground_slopes_of(plan, ground, scratch);
  ground_reaction_rows(plan, &slopes.shares, scratch);
  for (int k = d - 1; k >= 0; k--) {
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1];
    wide_pair carried = ground_carried(plan, joint->feet, scratch);
    wide_pair bodies = axpy_pair(load_pair(scratch + frame->load_at), spread(1), carried);
    subtree_changes t = jacobian_changes(&plan->steps.changes[k], bodies, scratch);
    wide3 dc = scale3(spread(1 / plan->mass), t.qdd.linear);
    wide dz = dot3(slopes.shares.up, dc);
    if (joint->torque_row != AMBULO__ROW_VANISHES) {
      ground_pairs(plan, k, &t, carried, jq, jqd, jqdd, scratch);
      ground_column(plan, k, &t, dz, jq, jqd, jqdd, scratch);
    }
    jacobian_wrench(plan, k, t.q, jq);
    jacobian_wrench(plan, k, t.qd, jqd);
    jacobian_wrench(plan, k, t.qdd, jqdd);
    ground_feet_column(plan, &slopes, t.q, dz, jq + (feet + k) * AMBULO__LANES);
    ground_feet_column(plan, &slopes, t.qd, (wide){0}, jqd + (rates + k) * AMBULO__LANES);
    ground_feet_column(plan, &slopes, t.qdd, (wide){0}, jqdd + (rates + k) * AMBULO__LANES);
    store(jq + (center + k) * AMBULO__LANES, dc.x);
    store(jq + (center + d + k) * AMBULO__LANES, dc.y);
    store(jq + (center + 2 * d + k) * AMBULO__LANES, dc.z);
  }
  jacobian_points(plan, jq, scratch);
}

#endif
