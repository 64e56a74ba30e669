/* mechanics/kernel_jacobian.h - Jacobians of all outputs in closed form, after kernel_world.h.
 *
 * Derivation (the result is that of Carpentier & Mansard, RSS 2018, and Singh, Russell & Wensing,
 * RA-L 2022; here from mass points). A step of q_i moves a point r of the subtree by dr/dq_i =
 * S_i(r) = s + z x r; kernel_world.h gives S_i and its derivatives. For any motion r(t) of a
 * mechanism d rdd/dqdd = dr/dq, d rdd/dqd = 2 d/dt (dr/dq), d rdd/dq = d2/dt2 (dr/dq); here
 *   d rdd/dqdd = S(r),  d rdd/dqd = 2 Sd(r) + 2 z x rd,  d rdd/dq = Sdd(r) + 2 zd x rd + z x rdd
 * Summed over the mass points with their moments r x, where a field (z, s) gives the wrench
 *   I(z, s) = (I z + h x s, m s + z x h),   h = sum m r,  I the inertia about the origin,
 * 2 z x rd gives B(z) = 2 (E z, z x P),   P = sum m rd, K = sum m rd r^T, E = tr(K) 1 - K,
 * and z x rdd together with the change of r in r x m (rdd - g) gives S x* f, f = (N, F) the force
 * of the subtree (the origin's acceleration less g stands for it in Sdd: that turns z x rdd into
 * z x (rdd - g)):
 *   t1 = df/dqdd = I(S)
 *   t2 = df/dqd  = I(2 Sd) + B(z)
 *   t3 = df/dq   = I(Sdd) + B(zd) + S x* f,   S x* f = (z x N + s x F, z x F)
 * These are the columns of the root wrench. A step of joint i changes tau of an ancestor j, whose
 * S_j stays, by S_j . t. A step of the ancestor j moves, turns and accelerates the subtree of i by
 * the same three fields, but S_i turns along with it and S x* f drops out; what is left is turned
 * over to act on the fields of j, with t4 = E^T z_i + P x s_i:
 *   dtau_j/dq_i = S_j . t3,                   dtau_j/dqd_i = S_j . t2,           j above i
 *   dtau_i/dq_j = t4 . 2 zd_j + t1 . Sdd_j,   dtau_i/dqd_j = 2 t4 . z_j + t1 . 2 Sd_j,
 *   dtau_i/dqdd_j = dtau_j/dqdd_i = t1 . S_j,                                    j above or = i
 * E, P, h, I are sums over the subtree (kernel_subtree.h). Point p:  dp/dq_j = s_j + z_j x p.
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_H

#include "mechanics/kernel_world.h"

/* A step of its own keeps its constants in registers; inlined together they would not fit. */
#define AMBULO__STEP static __attribute__((noinline))

/* Change of the subtree's force with q, qd, qdd of its joint, and t4. */
typedef struct subtree_changes {
  wide_pair q, qd, qdd;
  wide3 turned;
} subtree_changes;

AMBULO__INLINE wide_pair change_by_qdd(wide mass, const double *subtree, const double *motion) {
  wide_pair s = load_pair(motion), t;
  wide3 h = load3(subtree + subtree_first);
  t.angular = add_cross3(multiply6(load6(subtree + subtree_inertia), s.angular), h, s.linear);
  t.linear = add_cross3(scale3(mass, s.linear), s.angular, h);
  return t;
}

AMBULO__INLINE wide_pair change_by_qd(wide mass, const double *subtree, const double *motion) {
  wide_pair sd = load_pair(motion + 2 * three), t;
  wide3 h = load3(subtree + subtree_first), z2 = scale3(spread(2), load3(motion));
  t.angular = multiply6(load6(subtree + subtree_inertia), sd.angular);
  t.angular = add_multiply33(t.angular, load33(subtree + subtree_coriolis), z2);
  t.angular = add_cross3(t.angular, h, sd.linear);
  t.linear = add_cross3(scale3(mass, sd.linear), sd.angular, h);
  t.linear = add_cross3(t.linear, z2, load3(subtree + subtree_momentum));
  return t;
}

AMBULO__INLINE wide_pair change_by_q(wide mass, const double *subtree, const double *motion) {
  wide_pair s = load_pair(motion), sdd = load_pair(motion + 4 * three), t;
  wide_pair f = load_pair(subtree + subtree_load);
  wide3 h = load3(subtree + subtree_first), zd2 = load3(motion + 2 * three);
  t.angular = multiply6(load6(subtree + subtree_inertia), sdd.angular);
  t.angular = add_multiply33(t.angular, load33(subtree + subtree_coriolis), zd2);
  t.angular = add_cross3(add_cross3(t.angular, h, sdd.linear), s.angular, f.angular);
  t.angular = add_cross3(t.angular, s.linear, f.linear);
  t.linear = add_cross3(scale3(mass, sdd.linear), sdd.angular, h);
  t.linear = add_cross3(t.linear, zd2, load3(subtree + subtree_momentum));
  t.linear = add_cross3(t.linear, s.angular, f.linear);
  return t;
}

/* t4 */
AMBULO__INLINE wide3 change_turned(const double *subtree, const double *motion) {
  wide_pair s = load_pair(motion);
  wide3 t = cross3(load3(subtree + subtree_momentum), s.linear);
  return add_multiply33_transposed(t, load33(subtree + subtree_coriolis), s.angular);
}

/* Column of a joint in the Jacobian of the root wrench. */
AMBULO__INLINE void jacobian_wrench(const ambulo__plan *plan, int k, wide_pair t, double *out) {
  int row = plan->coordinates * AMBULO__LANES;
  out += (plan->start[plan->coordinates] + k) * AMBULO__LANES;
  store(out, t.angular.x);
  store(out + row, t.angular.y);
  store(out + 2 * row, t.angular.z);
  store(out + 3 * row, t.linear.x);
  store(out + 4 * row, t.linear.y);
  store(out + 5 * row, t.linear.z);
}

/* All of them, and the columns of the root wrench. What is needed is read again where it is needed:
 * together it would not fit the registers. */
AMBULO__INLINE subtree_changes jacobian_changes(const ambulo__plan *plan, int k,
                                                const double *subtree, double *jq, double *jqd,
                                                double *jqdd, const double *scratch) {
  const ambulo__change_step *step = &plan->steps.changes[k];
  const double *motion = scratch + step->motion;
  wide mass = spread(step->mass);
  subtree_changes t;
  t.q = change_by_q(mass, subtree, motion);
  jacobian_wrench(plan, k, t.q, jq);
  t.qd = change_by_qd(mass, subtree, motion);
  jacobian_wrench(plan, k, t.qd, jqd);
  t.qdd = change_by_qdd(mass, subtree, motion);
  jacobian_wrench(plan, k, t.qdd, jqdd);
  t.turned = change_turned(subtree, motion);
  return t;
}

/* Entries of a joint's row; the mass matrix entry is returned. */
AMBULO__INLINE wide jacobian_lower(const subtree_changes *t, wide_pair s, const double *motion,
                                   int lower, double *jq, double *jqd) {
  wide_pair sd = load_pair(motion + 2 * three), sdd = load_pair(motion + 4 * three);
  wide turned = dot3(t->turned, s.angular);
  store(jq + lower, add_dot_pair(dot3(t->turned, sd.angular), t->qdd, sdd));
  store(jqd + lower, add_dot_pair(2 * turned, t->qdd, sd));
  return dot_pair(t->qdd, s);
}

/* The component of v along the axis of a straight joint. */
AMBULO__INLINE wide straight_part(const ambulo__pair *pair, wide3 v, const double *scratch) {
  switch (pair->axis) {
  case 0:
    return v.x;
  case 1:
    return v.y;
  case 2:
    return v.z;
  default:
    return dot3(v, load3(scratch + pair->motion + three));
  }
}

/* Row and column of a joint in the Jacobians of tau. Straight joints come first among its
 * ancestors: S = (0, s), Sd = Sdd = 0, and what vanishes with them is not written; nor are the rows
 * of the first ancestors that have none. Of the mass matrix the part above the diagonal is
 * written. */
AMBULO__INLINE void jacobian_pairs(const ambulo__change_step *step, const ambulo__pair *pairs,
                                   const subtree_changes *t, int grounded, double *jq, double *jqd,
                                   double *jqdd, const double *scratch) {
  const ambulo__pair *pair = pairs + step->first, *last = pair + step->count;
  const ambulo__pair *straight = pair + step->straight, *rowless = pair + step->rowless;
  int lower = step->lower;
  for (; pair < straight && pair < rowless; pair++, lower += AMBULO__LANES) {
    if (pair->axis < 0) store(jqdd + lower, straight_part(pair, t->qdd.linear, scratch));
  }
  for (; pair < straight; pair++, lower += AMBULO__LANES) {
    store(jqdd + pair->upper, straight_part(pair, t->qdd.linear, scratch));
    store(jq + pair->upper, straight_part(pair, t->q.linear, scratch));
    store(jqd + pair->upper, straight_part(pair, t->qd.linear, scratch));
  }
  for (; grounded && pair < rowless; pair++, lower += AMBULO__LANES) {
    const double *motion = scratch + pair->motion;
    store(jqdd + lower, jacobian_lower(t, load_pair(motion), motion, lower, jq, jqd));
  }
  for (; pair < last; pair++, lower += AMBULO__LANES) {
    const double *motion = scratch + pair->motion;
    wide_pair s = load_pair(motion);
    store(jqdd + pair->upper, jacobian_lower(t, s, motion, lower, jq, jqd));
    store(jq + pair->upper, dot_pair(t->q, s));
    store(jqd + pair->upper, dot_pair(t->qd, s));
  }
  const double *motion = scratch + step->motion;
  store(jqdd + lower, jacobian_lower(t, load_pair(motion), motion, lower, jq, jqd));
}

/* Column of the root wrench for a displacement s along an axis that stands still: no rates, no
 * turning. */
AMBULO__INLINE void jacobian_straight(const ambulo__plan *plan, int k, const double *subtree,
                                      double *jq, double *jqdd, const double *scratch) {
  const ambulo__change_step *step = &plan->steps.changes[k];
  const int row = plan->coordinates * AMBULO__LANES;
  double *moment = jq + (plan->start[plan->coordinates] + k) * AMBULO__LANES;
  wide3 s = load3(scratch + step->motion + three), h = load3(subtree + subtree_first);
  wide3 turn = cross3(s, load3(subtree + subtree_load + three));
  store(moment, turn.x);
  store(moment + row, turn.y);
  store(moment + 2 * row, turn.z);
  jacobian_wrench(plan, k, (wide_pair){cross3(h, s), scale3(spread(step->mass), s)}, jqdd);
}

/* Its row and column of tau: all joints above are straight, too. Those that have no rows of their
 * own do not have its column either. */
AMBULO__INLINE void straight_pairs(const ambulo__change_step *step, const ambulo__pair *pairs,
                                   double *jqdd, const double *scratch) {
  wide3 force = scale3(spread(step->mass), load3(scratch + step->motion + three));
  int lower = step->lower;
  if (step->is_rowless) return;
  for (int i = 0; i < step->count; i++, lower += AMBULO__LANES) {
    const ambulo__pair *pair = &pairs[step->first + i];
    int entry = i < step->rowless ? lower : pair->upper;
    if (i >= step->rowless || pair->axis < 0) {
      store(jqdd + entry, straight_part(pair, force, scratch));
    }
  }
  store(jqdd + lower, spread(step->mass));
}

/* Rows of a point at p, which the joints of a chain move. */
AMBULO__INLINE void jacobian_point(const int *chain, int count, wide3 p, double *out,
                                   const double *scratch) {
  const size_t row = (size_t)count * AMBULO__LANES;
  for (const int *last = chain + count; chain < last; chain++, out += AMBULO__LANES) {
    wide_pair s = load_pair(scratch + *chain);
    wide3 column = add_cross3(s.linear, s.angular, p);
    store(out, column.x);
    store(out + row, column.y);
    store(out + 2 * row, column.z);
  }
}

/* Points on the frames of a limb. */
static void jacobian_points(const ambulo__plan *plan, const ambulo__limb *limb, double *jq,
                            const double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  const double *places = scratch + plan->positions_at;
  for (int k = limb->first; k <= limb->leaf; k++) {
    if (plan->local.steps[k].group < 0) continue;
    const ambulo__group_step *group = &steps->groups[plan->local.steps[k].group];
    for (int i = group->first; i < group->first + group->count; i++) {
      jacobian_point(steps->chains + group->chain, group->chain_count, load3(places + i * three),
                     jq + steps->points[i].entry, scratch);
    }
  }
}

/* Row and column of a joint whose subtree is known. */
AMBULO__INLINE void jacobian_column(const ambulo__plan *plan, int k, const double *subtree,
                                    int grounded, double *jq, double *jqd, double *jqdd,
                                    const double *scratch) {
  const ambulo__change_step *step = &plan->steps.changes[k];
  const ambulo__pair *pairs = plan->steps.pairs;
  if (step->is_straight) {
    jacobian_straight(plan, k, subtree, jq, jqdd, scratch);
    straight_pairs(step, pairs, jqdd, scratch);
    return;
  }
  const subtree_changes t = jacobian_changes(plan, k, subtree, jq, jqd, jqdd, scratch);
  if (grounded && step->is_rowless) return;
  jacobian_pairs(step, pairs, &t, grounded, jq, jqd, jqdd, scratch);
}

AMBULO__STEP void column_in_air(const ambulo__plan *plan, int k, const double *subtree, double *jq,
                                double *jqd, double *jqdd, const double *scratch) {
  jacobian_column(plan, k, subtree, 0, jq, jqd, jqdd, scratch);
}

AMBULO__STEP void column_on_ground(const ambulo__plan *plan, int k, const double *subtree,
                                   double *jq, double *jqd, double *jqdd, const double *scratch) {
  jacobian_column(plan, k, subtree, 1, jq, jqd, jqdd, scratch);
}

/* (J) all Jacobians of a part of the tree */
static void jacobian_part(const ambulo__plan *plan, const world_inputs *x, double *jq, double *jqd,
                          double *jqdd, double *scratch) {
  for (int i = 0; i < plan->local.limb_count; i++) {
    const ambulo__limb *limb = &plan->local.limbs[i];
    const double *sum = NULL;
    world_limb(plan, limb, x, scratch);
    for (int k = limb->leaf;; k = plan->local.steps[k].parent) {
      sum = complete_subtree(plan, k, sum, scratch);
      if (plan->contacts > 0) {
        column_on_ground(plan, k, sum, jq, jqd, jqdd, scratch);
      } else {
        column_in_air(plan, k, sum, jq, jqd, jqdd, scratch);
      }
      if (k == limb->top) break;
    }
    pass_subtree_on(plan, limb->top, sum, scratch);
    jacobian_points(plan, limb, jq, scratch);
  }
}

#endif
