/* mechanics/kernel_jacobian_ground.h - what ground reaction adds to the Jacobians.
 *
 * With t_j the changes of the root wrench (M, F) with q_j, qd_j or qdd_j, which are the columns t3,
 * t2, t1 of kernel_jacobian.h, and W_i the sum of the feet's wrenches that joint i carries,
 *   dtau_i = [the same as without ground reaction] - (S_j x S_i) . W_i - S_i . dW_i,
 * the second term only for j above i and q: the turn of S_i no longer cancels, since the feet's
 * wrenches do not turn with the subtree. It reads S_j . (-(S_i x* W_i)), with S x* f as there, and
 * is added to the entry of q_j in the row.
 *
 * The third couples every joint above a foot with all coordinates. The split (kernel_ground.h) is
 * linear in (M, F) but for the height z of the centre of mass, so that it is a product of a row
 * that joint i has once, S_i = (beta, s), u = beta x D, foot 0 (foot 1: gain and a_0 a_1 with the
 * opposite sign; both feet: R = S, e = 0):
 *   S_i . dW_i = R_i . (dM, dF) + e_i dz
 *   R = (a beta + gain u x n,   a s + (a_0 a_1 + gain height) u - gain (s . D) n)
 *   e = -gain / z (u . V - F_n s . D)
 * The centre of mass moves with q_j by the linear part of t1_j over the mass m, so that
 * dz = n . dF by qdd_j / m. Feet:
 *   dF_0 = a_0 dF - gain (dF_n - F_n dz / z) D,   dF_1 = dF - dF_0
 *   dT   = (F . dM + M . dF - T dF_n) / F_n,      dT_f = a_f dT
 * Of these products the factors are written: -R_i and -e_i / m for each joint above a foot, and
 * those of the feet (plan_pattern.c). Written out they would be the larger part of all entries; who
 * reads a row multiplies them out (problem/output_gradient.c).
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_GROUND_H

#include "mechanics/kernel_ground.h"
#include "mechanics/kernel_jacobian.h"

/* Wrench of the feet that a joint carries. */
AMBULO__INLINE wide_pair ground_carried(const ambulo__plan *plan, int feet, const double *scratch) {
  const double *at = scratch + plan->ground_at;
  if (feet == 3) return load_pair(at + ground_wrench);
  return load_pair(at + ground_foot + 2 * (feet - 1) * three);
}

/* Adds S_j . (-(s x* w)) to the entries of the joints above: the turn of a joint's motion s against
 * the wrench w of the feet that it carries. Nothing stands yet in the columns of straight joints.
 */
AMBULO__INLINE void ground_turn(const ambulo__change_step *step, const ambulo__pair *pairs,
                                wide_pair w, wide_pair s, double *jq, const double *scratch) {
  const ambulo__pair *pair = pairs + step->first, *last = pair + step->count;
  const ambulo__pair *straight = pair + step->straight;
  const wide_pair turn = {add_cross3(cross3(w.angular, s.angular), w.linear, s.linear),
                          cross3(w.linear, s.angular)};
  double *lower = jq + step->lower;
  for (; pair < straight; pair++, lower += AMBULO__LANES) {
    store(lower, straight_part(pair, turn.linear, scratch));
  }
  for (; pair < last; pair++, lower += AMBULO__LANES) {
    store(lower, add_dot_pair(load(lower), turn, load_pair(scratch + pair->motion)));
  }
}

AMBULO__STEP void ground_turns(const ambulo__plan *plan, double *jq, const double *scratch) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_REACTS) continue;
    ground_turn(&plan->steps.changes[k], plan->steps.pairs,
                ground_carried(plan, joint->feet, scratch), load_pair(scratch + joint->motion_at),
                jq, scratch);
  }
}

/* -R and -e / m of the joints above the feet. */
AMBULO__STEP void ground_factors(const ambulo__plan *plan, const ground_shares *shares, double *jq,
                                 const double *scratch) {
  const ground_shares g = *shares;
  wide_pair w = load_pair(scratch + plan->ground_at + ground_wrench);
  wide3 lever = ground_lever(plan, g.up, w);
  wide normal = dot3(g.up, w.linear), fall = g.gain / (g.height * plan->mass);
  wide slope = g.product + g.gain * plan->ground_height;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_REACTS) continue;
    double *out = jq + joint->factors * AMBULO__LANES;
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
    store3(out, scale3(spread(-1), r.angular));
    store3(out + three, scale3(spread(-1), r.linear));
    store(out + 2 * three, change);
  }
}

/* The feet's factors. */
AMBULO__INLINE void ground_feet(const ambulo__plan *plan, const ground_shares *g, double *jq,
                                const double *scratch) {
  const double *at = scratch + plan->ground_at;
  double *out = jq + plan->foot_factors * AMBULO__LANES;
  wide_pair w = load_pair(at + ground_wrench);
  wide normal = dot3(g->up, w.linear), inverse = 1 / normal;
  wide3 shear = scale3(g->gain, g->apart);
  wide3 moment = axpy3(w.angular, -load(at + ground_twist), g->up);
  store3(out + factor_shear * AMBULO__LANES, shear);
  store3(out + factor_fall * AMBULO__LANES, scale3(normal / (g->height * plan->mass), shear));
  for (int f = 0; f < 2; f++) {
    wide part = g->share[f] * inverse;
    double *twist = out + (factor_twist + 6 * f) * AMBULO__LANES;
    store(out + (factor_share + f) * AMBULO__LANES, g->share[f]);
    store_pair(twist, (wide_pair){scale3(part, w.linear), scale3(part, moment)});
  }
}

/* (W.J): After those of the body in the air, on the same scratch. */
static void jacobian_ground_part(const ambulo__plan *plan, const double *ground, double *jq,
                                 double *scratch) {
  wide_subtree all = {0};
  if (plan->local.limb_count > 0) all = load_subtree(scratch + plan->frames[0].subtree_at);
  ground_divide(plan, ground, with_fixed_load(plan, all.load), all.first, scratch);
  const ground_shares shares =
      ground_load(plan, ground, load(scratch + plan->ground_at + ground_height));
  ground_turns(plan, jq, scratch);
  ground_factors(plan, &shares, jq, scratch);
  ground_feet(plan, &shares, jq, scratch);
}

#endif
