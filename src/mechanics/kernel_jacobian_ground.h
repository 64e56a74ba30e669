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
 * -R_i . t_j - e_i dz; for i below j that is added to what the pair of i and j has stored. The t_j
 * are read where they stand, in the rows of the root wrench.
 * A joint j that carries the whole body has t1_j = I(S_j) with the inertia of the whole body, etc.,
 * and with R = (rho, sigma), (M, F) the root wrench, m the mass, h, P, E of the whole body
 *   R . t1_j = I(R) . S_j,     R . t2_j = I(R) . 2 Sd_j + 2 b . z_j,     b = E^T rho + P x sigma
 *   R . t3_j = I(R) . Sdd_j + b . 2 zd_j + (M x rho + F x sigma, F x rho) . S_j
 *   dz       = (h x n / m, n) . S_j
 * so that I(R), b etc. are taken off t1_i, t4_i once for all of these j, whose own rows vanish.
 * The centre of mass: dc / dq_j is the linear part of t1_j over the mass, dz = n . dc. Feet:
 *   dF_0 = a_0 dF - gain (dF_n - F_n dz / z) D,   dF_1 = dF - dF_0 (not stored: plan.h)
 *   dT   = (F . dM + M . dF - T dF_n) / F_n,      dT_f = a_f dT
 * Stored per joint with a dense row: S - R, -e / m, -R, -e / m, t4; -e / m goes with m dz = n .
 * t1_j.
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H

#include "mechanics/kernel_ground.h"
#include "mechanics/kernel_jacobian.h"

/* What a column needs of the split. */
typedef struct ground_slopes {
  ground_shares shares;
  wide_pair twist; /* dT = twist . (dM, dF) */
  wide fall;       /* F_n / (m z) */
} ground_slopes;

/* R and e of the joints that carry feet. */
AMBULO__STEP void ground_reaction_rows(const ambulo__plan *plan, const ground_shares *shares,
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
  const wide_subtree whole = load_subtree(scratch + plan->frames[0].subtree_at);
  wide mass = spread(plan->mass);
  wide3 h = whole.first, p = whole.momentum;
  wide6 inertia = whole.inertia;
  wide33 e = whole.coriolis;
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

/* Entries of a row in the column of a joint above, whose motion is given. */
AMBULO__INLINE void ground_above(const row_changes *row, const double *motion, double *q,
                                 double *qd, double *qdd) {
  wide_pair s = load_pair(motion), sd = load_pair(motion + 2 * three);
  wide_pair sdd = load_pair(motion + 4 * three);
  wide turned = dot3(row->turned, s.angular);
  wide by_q = add_dot_pair(dot3(row->turned, sd.angular), row->force, sdd);
  store(q, add_dot_pair(by_q, row->turn, s));
  store(qd, add_dot_pair(2 * turned, row->force, sd));
  store(qdd, dot_pair(row->force, s));
}

/* Columns of a row that stand for the joints that carry the whole body. */
AMBULO__INLINE void ground_root_pairs(const ambulo__root_column *roots, int count, int start,
                                      const row_changes *row, double *jq, double *jqd, double *jqdd,
                                      const double *scratch) {
  const row_changes c = *row;
  for (int i = 0; i < count; i++) {
    const double *motion = scratch + roots[i].motion;
    int entry = start + roots[i].column;
    if (roots[i].straight) {
      wide3 s = load3(motion + three);
      store(jq + entry, dot3(c.turn.linear, s));
      store(jqdd + entry, dot3(c.force.linear, s));
    } else {
      ground_above(&c, motion, jq + entry, jqd + entry, jqdd + entry);
    }
  }
}

/* Row and column of a joint that carries no foot; columns only where the row above is sparse. */
AMBULO__INLINE void ground_sparse_pairs(const ambulo__plan *plan, int k, const subtree_changes *t,
                                        double *jq, double *jqd, double *jqdd,
                                        const double *scratch) {
  int first = plan->ancestor_start[k], last = plan->ancestor_start[k + 1];
  int self = (plan->start[k] + last - first) * AMBULO__LANES;
  const double *own = scratch + plan->joints[k].motion_at;
  int straight = first + plan->steps.changes[k].straight;
  for (int i = first; i < straight; i++) {
    const ambulo__ground_pair *pair = &plan->pairs[i];
    wide3 s = load3(scratch + pair->motion + three);
    store(jqdd + pair->mass, dot3(t->qdd.linear, s));
    if (pair->upper < 0) continue;
    store(jq + pair->upper, dot3(t->q.linear, s));
    store(jqd + pair->upper, dot3(t->qd.linear, s));
  }
  for (int i = straight; i < last; i++) {
    const ambulo__ground_pair *pair = &plan->pairs[i];
    const double *motion = scratch + pair->motion;
    int upper = pair->upper;
    wide_pair s = load_pair(motion);
    store(jqdd + pair->mass, jacobian_lower(t, s, motion, pair->lower, jq, jqd));
    if (upper < 0) continue;
    store(jq + upper, dot_pair(t->q, s));
    store(jqd + upper, dot_pair(t->qd, s));
  }
  store(jqdd + self, jacobian_lower(t, load_pair(own), own, self, jq, jqd));
}

/* A column of the root wrench, as jacobian_wrench left it. */
AMBULO__INLINE wide_pair ground_wrench_column(const double *at, int row) {
  return (wide_pair){{load(at), load(at + row), load(at + 2 * row)},
                     {load(at + 3 * row), load(at + 4 * row), load(at + 5 * row)}};
}

/* Changes of a subtree: the column of the root wrench; and the rows without feet. */
AMBULO__STEP void ground_changes(const ambulo__plan *plan, int k, const double *subtree, double *jq,
                                 double *jqd, double *jqdd, double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__change_step *step = &plan->steps.changes[k];
  if (joint->torque_row == AMBULO__ROW_VANISHES && step->is_straight) {
    jacobian_straight(plan, k, subtree, jq, jqdd, scratch);
    return;
  }
  const subtree_changes t = jacobian_changes(plan, k, subtree, jq, jqd, jqdd, scratch);
  if (joint->torque_row == AMBULO__ROW_SPARSE) {
    ground_sparse_pairs(plan, k, &t, jq, jqd, jqdd, scratch);
  } else if (joint->torque_row == AMBULO__ROW_DENSE) {
    store3(scratch + joint->reaction_at + 14 * AMBULO__LANES, t.turned);
  }
}

/* All of them, and the split of what they sum up to. */
static void ground_subtrees(const ambulo__plan *plan, const world_inputs *x, const double *ground,
                            double *jq, double *jqd, double *jqdd, double *scratch) {
  const double *fixed = plan->fixed_load;
  for (int i = 0; i < plan->local.limb_count; i++) {
    const ambulo__limb *limb = &plan->local.limbs[i];
    const double *sum = NULL;
    world_limb(plan, limb, x, scratch);
    for (int k = limb->leaf;; k = plan->local.steps[k].parent) {
      sum = complete_subtree(plan, k, sum, scratch);
      ground_changes(plan, k, sum, jq, jqd, jqdd, scratch);
      if (k == limb->top) break;
    }
    pass_subtree_on(plan, limb->top, sum, scratch);
    jacobian_points(plan, limb, jq, scratch);
  }
  wide_subtree all = {0};
  if (plan->local.limb_count > 0) all = load_subtree(scratch + plan->frames[0].subtree_at);
  all.load.angular = add3(all.load.angular, spread3(fixed));
  all.load.linear = add3(all.load.linear, spread3(fixed + 3));
  ground_divide(plan, ground, all.load, all.first, scratch);
}

/* Entries of the dense rows in the columns of the joints above. */
AMBULO__STEP void ground_rows_above(const ambulo__plan *plan, double *jq, double *jqd, double *jqdd,
                                    const double *scratch) {
  const ambulo__root_column *roots = plan->roots;
  const ambulo__ground_pair *pairs = plan->pairs;
  const int full = plan->coordinates * AMBULO__LANES, vanishing = plan->vanishing;
  const int wrench = plan->start[plan->coordinates] * AMBULO__LANES;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_DENSE) continue;
    const double *reaction = scratch + joint->reaction_at;
    const int first = plan->ancestor_start[k] + vanishing, last = plan->ancestor_start[k + 1];
    wide_pair carried = ground_carried(plan, joint->feet, scratch);
    row_changes row;
    row.force = ground_wrench_column(jqdd + wrench + k * AMBULO__LANES, full);
    row.turn = turn_of(carried, load_pair(scratch + joint->motion_at));
    row.turned = load3(reaction + 14 * AMBULO__LANES);
    for (int i = first; i < last; i++) {
      int lower = pairs[i].lower;
      ground_above(&row, scratch + pairs[i].motion, jq + lower, jqd + lower, jqdd + lower);
    }
    if (vanishing == 0) continue;
    row = ground_add_whole(plan, row, reaction + 7 * AMBULO__LANES, scratch);
    ground_root_pairs(roots, vanishing, plan->start[k] * AMBULO__LANES, &row, jq, jqd, jqdd,
                      scratch);
  }
}

/* What a column of the root wrench adds to some dense rows. */
typedef struct ground_column {
  wide_pair q, qd, qdd;
  wide rise;
} ground_column;

AMBULO__INLINE void ground_terms(const ground_column *column, const ambulo__reaction_term *term,
                                 const ambulo__reaction_term *last, int fresh, double *jq,
                                 double *jqd, double *jqdd, const double *scratch) {
  const ground_column c = *column;
  for (; term < last; term++) {
    const double *row = scratch + term->row_at;
    double *q = jq + term->entry, *qd = jqd + term->entry, *qdd = jqdd + term->entry;
    wide_pair r = load_pair(row);
    wide by_q = load(row + 2 * three) * c.rise;
    if (!fresh) by_q += load(q);
    store(q, add_dot_pair(by_q, r, c.q));
    store(qd, fresh ? dot_pair(r, c.qd) : add_dot_pair(load(qd), r, c.qd));
    store(qdd, fresh ? dot_pair(r, c.qdd) : add_dot_pair(load(qdd), r, c.qdd));
  }
}

/* What the dense rows have in all columns but those of the joints that carry the whole body. */
AMBULO__STEP void ground_columns(const ambulo__plan *plan, double *jq, double *jqd, double *jqdd,
                                 const double *scratch) {
  const int full = plan->coordinates * AMBULO__LANES, dense = plan->dense_count;
  const int wrench = plan->start[plan->coordinates] * AMBULO__LANES;
  const wide3 up = ground_up(plan);
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__reaction_term *term = plan->term + k * dense, *fresh = term + plan->term_fresh[k];
    const int at = wrench + k * AMBULO__LANES;
    ground_column c;
    if (plan->joints[k].torque_row == AMBULO__ROW_VANISHES) continue;
    c.q = ground_wrench_column(jq + at, full);
    c.qd = ground_wrench_column(jqd + at, full);
    c.qdd = ground_wrench_column(jqdd + at, full);
    c.rise = dot3(up, c.qdd.linear);
    ground_terms(&c, term, fresh, 1, jq, jqd, jqdd, scratch);
    ground_terms(&c, fresh, term + dense, 0, jq, jqd, jqdd, scratch);
  }
}

/* Foot 0's rows and foot 1's free moment from the rows of the root wrench: `wrench` and `out` are
 * the first entries of both. The centre of mass rises by n . t1 / m with q, `masses` is the first
 * entry of t1. */
AMBULO__STEP void ground_feet(const ground_slopes *slopes, int d, const double *wrench,
                              const double *masses, double *out) {
  const ground_slopes g = *slopes;
  const ground_shares *s = &g.shares;
  const int row = d * AMBULO__LANES;
  for (int k = 0; k < d; k++, wrench += AMBULO__LANES, out += AMBULO__LANES) {
    wide_pair t = ground_wrench_column(wrench, row);
    wide shear = dot3(s->up, t.linear), twist = dot_pair(g.twist, t);
    if (masses) {
      const double *force = masses + 3 * row + k * AMBULO__LANES;
      wide3 rise = {load(force), load(force + row), load(force + 2 * row)};
      shear -= g.fall * dot3(s->up, rise);
    }
    wide3 first = axpy3(scale3(s->share[0], t.linear), -s->gain * shear, s->apart);
    store(out, first.x);
    store(out + row, first.y);
    store(out + 2 * row, first.z);
    store(out + 3 * row, s->share[0] * twist);
    store(out + 4 * row, s->share[1] * twist);
  }
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

static void jacobian_ground_part(const ambulo__plan *plan, const world_inputs *x,
                                 const double *ground, double *jq, double *jqd, double *jqdd,
                                 double *scratch) {
  const int row = ambulo__plan_first_foot_row(plan), d = plan->coordinates;
  const int wrench = plan->start[d] * AMBULO__LANES, feet = plan->start[row] * AMBULO__LANES;
  const int rates = plan->rate_start[row] * AMBULO__LANES;
  ground_subtrees(plan, x, ground, jq, jqd, jqdd, scratch);
  const ground_slopes slopes = ground_slopes_of(plan, ground, scratch);
  ground_reaction_rows(plan, &slopes.shares, scratch);
  ground_rows_above(plan, jq, jqd, jqdd, scratch);
  ground_columns(plan, jq, jqd, jqdd, scratch);
  ground_feet(&slopes, d, jq + wrench, jqdd + wrench, jq + feet);
  ground_feet(&slopes, d, jqd + wrench, NULL, jqd + rates);
  ground_feet(&slopes, d, jqdd + wrench, NULL, jqdd + rates);
}

#endif
