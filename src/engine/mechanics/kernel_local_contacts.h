/* mechanics/kernel_local_contacts.h - the contacts' wrenches in the frames' own axes.
 *
 * As kernel_local_ground.h does with two feet: limbs down, frames placed, bodies' loads summed up,
 * the root wrench shared out (kernel_contacts.h), each contact's wrench W_c taken off the load of
 * its frame, limbs up. The adjoints are those of there, too: with V_c the virtual motion of the
 * joints that carry contact c, root weights and all, q_j' += S_j . Q_c(V_c) for those joints.
 *
 * One thing is new. Joints that carry everything have no load left where the contacts bear the
 * whole wrench, and the sweep up ends below them. Where no contact has weight the load of all of
 * them is the root wrench (M, F), about the world origin. Their tau stays zero and has no adjoint;
 * but a step of theirs turns (M, F), whose weights are the virtual motion A of the root:
 *   q_j' += S_j . (M x A_angular + F x A_linear, F x A_angular)
 * What the bodies hold (ambulo__plan_take_wrench) is in (M, F), and its turn is the caller's
 * affair: with contacts that bear it the bodies' own load and theirs do not cancel, but leave it,
 * and its part of this is taken off again, with contacts or without.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_CONTACTS_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_CONTACTS_H

#include "mechanics/kernel_contacts.h"
#include "mechanics/kernel_local_ground.h"

/* What the contacts do to the loads of the bodies: root wrench, contacts, and their rows. */
AMBULO__INLINE void local_contacts(const ambulo__plan *plan, int keep, const double *ground,
                                   double *out, double *scratch) {
  const ambulo__local_plan *local = &plan->local;
  const local_sums sums = local_places(plan, keep, 1, out, scratch);
  wide_pair w = with_taken(plan, with_fixed_load(plan, sums.load), scratch);
  store_pair(out + plan->coordinates * AMBULO__LANES, w);
  contacts_share_out(plan, ground, keep, w, sums.first, out, scratch);
  for (int c = 0; c < plan->contacts; c++) {
    if (local->foot[c] < 0) continue;
    take_off(&local->steps[local->foot[c]], local->bare[c],
             load_pair(contact_at(plan, c, scratch) + contact_acts), scratch);
  }
}

/* All outputs of a body on two feet, or on contacts. */
AMBULO__INLINE void local_grounded(const ambulo__plan *plan, int keep, const double *q,
                                   const double *qd, const double *qdd, const double *ground,
                                   double *out, double *scratch) {
  const ambulo__limb *limbs = plan->local.limbs;
  if (plan->contacts > 0) contacts_place(plan, ground, scratch);
  for (int i = 0; i < plan->local.limb_count; i++) {
    limb_down(plan, &limbs[i], keep, q, qd, qdd, scratch);
  }
  if (plan->contacts > 0) {
    local_contacts(plan, keep, ground, out, scratch);
  } else {
    local_ground(plan, keep, ground, out, scratch);
  }
  for (int i = 0; i < plan->local.limb_count; i++) {
    limb_up(plan, &limbs[i], keep, q, out, scratch);
  }
  for (int k = 0; k < plan->vanishing; k++) store(out + plan->roots[k], (wide){0});
}

/* (V): Adds M' and F' to *root, the weights on the root wrench. */
static local_pulls local_contact_adjoints(const ambulo__plan *plan, const double *ground,
                                          const double *weights, wide_pair *root,
                                          const double *scratch) {
  const double *at = scratch + plan->ground_at;
  const wide floating = load(at + contacts_floating);
  wide_pair v[AMBULO__MOST_CONTACTS];
  local_pulls pulls;
  virtual_of_feet(plan, weights, v, scratch);
  pulls.center = contacts_adjoints(plan, ground, weights, v, root, scratch);
  pulls.center = scale3(spread(1 / plan->mass), pulls.center);
  for (int c = 0; c < plan->contacts; c++) {
    wide_pair w = load_pair(contact_kept(plan, c, scratch) + contact_acts);
    pulls.feet[c] = turned_against(w, add_pair(v[c], *root));
  }
  wide_pair turned = turned_against(load_pair(at + contacts_wrench), *root);
  pulls.floating = (wide_pair){scale3(floating, turned.angular), scale3(floating, turned.linear)};
  if (plan->taken_at) {
    wide_pair held = turned_against(load_pair(scratch + plan->taken_at), *root);
    pulls.floating = axpy_pair(pulls.floating, spread(-1), held);
  }
  return pulls;
}

#endif
