/* mechanics/kernel_jacobian_contacts.h - what contacts add to the Jacobians.
 *
 * With t_j the changes of the root wrench (M, F) with q_j, qd_j or qdd_j, which are the columns t3,
 * t2, t1 of kernel_jacobian.h, and W_i the sum of the wrenches of the contacts that joint i
 * carries, dtau_i = [the same as without ground reaction] - (S_j x S_i) . W_i - S_i . dW_i, the
 * second term only for j above i and q: the turn of S_i no longer cancels, since the wrenches of
 * contacts do not turn with the subtree. It reads S_j . (-(S_i x* W_i)), with S x* f as there, and
 * is added to the entry of q_j in the row.
 *
 * The third couples every joint above a contact with all coordinates.
 * In the letters of kernel_contacts.h, f_c = A_c u_c and m_c = w_c l^2 eta change with the
 * multipliers y = (eta, v) and with the centre of mass c, q_c = u_c - 2 (r . u) r / r^2:
 *   df_c = A_c (dv + deta x d_c) + D_c dc,   D_c = k ((r . u) 1 + r q^T),   dm_c = w_c l^2 deta
 *   dy = G^-1 (dM - x x dF - sum d_c x D_c dc,  dF - sum D_c dc)
 * Nine columns, by dM, dF and dc, are solved for once; the rows of f_c and m_c have nine factors
 * each of them. With S_i = (beta, s),
 *   S_i . dW_c = beta . dm_c + (s + beta x p_c) . df_c
 * so that a row of tau above contacts has nine, too, made of theirs with a minus. The centre of
 * mass moves with q_j by dF/dqdd_j over the mass (plan_contacts.c). Only the factors are written:
 * multiplied out the rows would be the larger part of all entries. Who reads a row multiplies them
 * out (problem/row_gradients.c).
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_CONTACTS_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_CONTACTS_H

#include "mechanics/kernel_contacts.h"
#include "mechanics/kernel_jacobian.h"

/* Wrench of the contacts that a joint carries. */
AMBULO__INLINE wide_pair contacts_carried(const ambulo__plan *plan, int carried,
                                          const double *scratch) {
  wide_pair sum = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  for (int c = 0; carried >> c; c++) {
    if (!(carried >> c & 1)) continue;
    sum = add_pair(sum, load_pair(contact_kept(plan, c, scratch) + contact_acts));
  }
  return sum;
}

/* Adds S_j . (-(s x* w)) to the entries of the joints above: the turn of a joint's motion s against
 * the wrench w of the contacts that it carries. Nothing stands yet in the columns of straight
 * joints.
 */
AMBULO__INLINE void contact_turn(const ambulo__change_step *step, const ambulo__pair *pairs,
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

AMBULO__STEP void contact_turns(const ambulo__plan *plan, double *jq, const double *scratch) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_REACTS) continue;
    contact_turn(&plan->steps.changes[k], plan->steps.pairs,
                 contacts_carried(plan, joint->contacts, scratch),
                 load_pair(scratch + joint->motion_at), jq, scratch);
  }
}

/* q_c */
AMBULO__INLINE wide3 contact_slant(const double *at) {
  wide3 r = load3(at + contact_line), u = load3(at + contact_moved);
  return axpy3(u, -2 * dot3(r, u) * load(at + contact_close), r);
}

/* - sum (d x D, D) by component k of c. */
AMBULO__INLINE wide_pair contacts_shift(const ambulo__plan *plan, int k, const double *scratch) {
  wide_pair sum = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  for (int c = 0; c < plan->contacts; c++) {
    const double *at = contact_kept(plan, c, scratch);
    wide3 r = load3(at + contact_line), u = load3(at + contact_moved), q = contact_slant(at);
    wide taste = load(at + contact_taste), of_u = taste * dot3(r, u);
    wide along = taste * (k == 0 ? q.x : k == 1 ? q.y : q.z);
    wide3 column = scale3(along, r);
    if (k == 0) column.x += of_u;
    if (k == 1) column.y += of_u;
    if (k == 2) column.z += of_u;
    sum.linear = sub3(sum.linear, column);
    sum.angular = sub3(sum.angular, cross3(load3(at + contact_arm), column));
  }
  return sum;
}

/* y by M, F and c. */
AMBULO__INLINE void contacts_columns(const ambulo__plan *plan, wide_pair *y,
                                     const double *scratch) {
  const double *at = scratch + plan->contacts_at;
  const contacts_grasp g = load_grasp(at);
  const wide zero = {0}, one = spread(1);
  const wide3 none = {zero, zero, zero}, x = load3(at + contacts_middle);
  const wide3 unit[3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  for (int k = 0; k < 3; k++) {
    y[k] = grasp_solve(&g, (wide_pair){unit[k], none});
    y[3 + k] = grasp_solve(&g, (wide_pair){none, unit[k]});
    y[6 + k] = grasp_solve(&g, contacts_shift(plan, k, scratch));
  }
  y[3] = axpy_pair(axpy_pair(y[3], -x.z, y[1]), x.y, y[2]);
  y[4] = axpy_pair(axpy_pair(y[4], -x.x, y[2]), x.z, y[0]);
  y[5] = axpy_pair(axpy_pair(y[5], -x.y, y[0]), x.x, y[1]);
}

/* The factors of a contact's six rows. */
AMBULO__INLINE void contact_factors(const ambulo__plan *plan, int c, const wide_pair *y, double *jq,
                                    const double *scratch) {
  enum { row = AMBULO__CONTACT_FACTORS * AMBULO__LANES };
  const double *at = contact_kept(plan, c, scratch);
  double *out = jq + (plan->contact_factors + 6 * c * AMBULO__CONTACT_FACTORS) * AMBULO__LANES;
  wide3 d = load3(at + contact_arm), r = load3(at + contact_line), q = contact_slant(at);
  wide share = load(at + contact_share), taste = load(at + contact_taste);
  wide spin = share * (plan->moment_arm * plan->moment_arm);
  wide of_u = taste * dot3(r, load3(at + contact_moved));
  const wide slant[3] = {q.x, q.y, q.z};
  for (int k = 0; k < AMBULO__CONTACT_FACTORS; k++, out += AMBULO__LANES) {
    wide3 u = add_cross3(y[k].linear, y[k].angular, d);
    wide along = dot3(r, u);
    if (k >= 6) along += slant[k - 6];
    wide3 f = axpy3(scale3(share, u), taste * along, r), m = scale3(spin, y[k].angular);
    store(out, f.x);
    store(out + row, f.y);
    store(out + 2 * row, f.z);
    store(out + 3 * row, m.x);
    store(out + 4 * row, m.y);
    store(out + 5 * row, m.z);
  }
  out -= 3 * AMBULO__LANES;
  for (int k = 0; k < 3; k++, out += row + AMBULO__LANES) store(out, load(out) + of_u);
}

/* Those of a joint above contacts. */
AMBULO__INLINE void contact_torque(const ambulo__plan *plan, const double *ground,
                                   const ambulo__joint *joint, double *jq, const double *scratch) {
  enum { row = AMBULO__CONTACT_FACTORS * AMBULO__LANES };
  const wide_pair s = load_pair(scratch + joint->motion_at);
  wide sum[AMBULO__CONTACT_FACTORS] = {{0}};
  double *out = jq + joint->factors * AMBULO__LANES;
  for (int c = 0; joint->contacts >> c; c++) {
    if (!(joint->contacts >> c & 1)) continue;
    const double *from = jq + plan->contact_factors * AMBULO__LANES + 6 * c * row;
    wide3 slide = add_cross3(s.linear, s.angular, load3(contact_ground(ground, c) + AMBULO__LANES));
    for (int k = 0; k < AMBULO__CONTACT_FACTORS; k++, from += AMBULO__LANES) {
      wide3 f = {load(from), load(from + row), load(from + 2 * row)};
      wide3 m = {load(from + 3 * row), load(from + 4 * row), load(from + 5 * row)};
      sum[k] = subtract_dot3(subtract_dot3(sum[k], slide, f), s.angular, m);
    }
  }
  for (int k = 0; k < AMBULO__CONTACT_FACTORS; k++) store(out + k * AMBULO__LANES, sum[k]);
}

AMBULO__STEP void contact_torques(const ambulo__plan *plan, const double *ground, double *jq,
                                  const double *scratch) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->torque_row != AMBULO__ROW_REACTS) continue;
    contact_torque(plan, ground, joint, jq, scratch);
  }
}

AMBULO__STEP void contacts_factors(const ambulo__plan *plan, double *jq, const double *scratch) {
  wide_pair y[AMBULO__CONTACT_FACTORS];
  contacts_columns(plan, y, scratch);
  for (int c = 0; c < plan->contacts; c++) contact_factors(plan, c, y, jq, scratch);
}

/* (W'.J): After those of the body in the air, on the same scratch. */
static void jacobian_contacts_part(const ambulo__plan *plan, const double *ground, double *jq,
                                   double *scratch) {
  wide_subtree all = {0};
  if (plan->local.limb_count > 0) all = load_subtree(scratch + plan->frames[0].subtree_at);
  contacts_place(plan, ground, scratch);
  wide_pair w = with_taken(plan, with_fixed_load(plan, all.load), scratch);
  contacts_share_out(plan, ground, 1, w, all.first, NULL, scratch);
  contact_turns(plan, jq, scratch);
  contacts_factors(plan, jq, scratch);
  contact_torques(plan, ground, jq, scratch);
}

#endif
