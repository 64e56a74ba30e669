/* mechanics/kernel_local_contacts.h - the contacts' wrenches in the frames' own axes.
 *
 * The loads of the subtrees, which tau is made of, need the contacts' wrenches, and these the root
 * wrench. With ground reaction all limbs are gone down first; then the frames are placed
 * (kernel_local_points.h), and the bodies' loads summed up in world axes to the root wrench, which
 * the contacts share (kernel_contacts.h). A contact's wrench (M_c, F_c) is taken off the load of
 * its frame, at o with the columns R,
 *   n -= R^T (M_c - o x F_c),   f -= R^T F_c,
 * and the pass up the tree gives tau. It ends below the joints that carry the whole body: their
 * load and the contacts' wrenches cancel.
 *
 * Adjoints, with the weights y on tau of the joints that carry contact c: V_c = sum S_i y_i is the
 * virtual motion that they give it (world axes, about the world origin). contacts_adjoints makes of
 * V_c the weights on the root wrench and on the centre of mass, through which W_c depends on the
 * motion. What is left is the turn of the joints' axes against a W_c that stands still. A step of
 * q_j turns each S_i below j, so that, with D_j the part of V_c from the joints below j,
 *   d(- V_c . W_c)/dq_j = S_j . Q(D_j),   Q(e, l) = (M_c x e + F_c x l, F_c x e).
 * The reverse sweep does not know D_j. It has the virtual motion A_j of the frame, from the root
 * down to j, root weights and all, and takes the net load for one that turns with the subtree: its
 * part is -S_j . Q(A_j). Since E_c = A_j + D_j, the virtual motion of the contact with the root
 * weights, is the same for all j, and Q is linear, what is missing is one pair for all the joints
 * that carry c:
 *   q_j' += S_j . Q(E_c).
 * Where tau vanishes the net load is zero, and y does not count.
 *
 * Joints that carry everything have no load left where the contacts bear the
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
#include "mechanics/kernel_local_points.h"

/* (W.4): Takes the wrench w off the load of a contact's frame; bare: it has none yet. */
AMBULO__INLINE void take_off(const ambulo__local_step *step, int bare, wide_pair w,
                             double *scratch) {
  double *at = scratch + step->at;
  wide3 x = load3(at + local_columns), y = load3(at + local_columns + three);
  wide3 z = load3(at + local_columns + 2 * three), f = w.linear;
  wide3 n = add_cross3(w.angular, f, load3(at + local_origin));
  wide_pair sum = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  if (!bare) sum = load_pair(at + local_load);
  wide3 m = sum.angular, g = sum.linear;
  m = (wide3){subtract_dot3(m.x, x, n), subtract_dot3(m.y, y, n), subtract_dot3(m.z, z, n)};
  g = (wide3){subtract_dot3(g.x, x, f), subtract_dot3(g.y, y, f), subtract_dot3(g.z, z, f)};
  store_pair(at + local_load, (wide_pair){m, g});
}

/* Adds the virtual motion by the weights on tau of the joints of a path. */
AMBULO__INLINE wide_pair virtual_of_path(const ambulo__local_plan *local, int path,
                                         const double *weights, wide_pair v,
                                         const double *scratch) {
  const ambulo__pivot *pivot = &local->pivots[local->path[path].first_pivot];
  const ambulo__pivot *last = &local->pivots[local->path[path + 1].first_pivot];
  const ambulo__carrier *carrier = &local->carrier[local->path[path].first_carrier];
  for (; pivot < last; pivot++) {
    wide3 sum = {{0}, {0}, {0}};
    for (const ambulo__carrier *end = carrier + pivot->count; carrier < end; carrier++) {
      wide y = carrier->sign * load(weights + carrier->input);
      sum = axpy3(sum, y, load3(scratch + carrier->axis_at));
    }
    if (pivot->slides) {
      v.linear = add3(v.linear, sum);
    } else {
      v.angular = add3(v.angular, sum);
      v.linear = add_cross3(v.linear, load3(scratch + pivot->origin_at), sum);
    }
  }
  return v;
}

/* V of each contact. */
AMBULO__INLINE void virtual_of_contacts(const ambulo__plan *plan, const double *weights,
                                        wide_pair *v, const double *scratch) {
  const wide_pair zero = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  const ambulo__local_plan *local = &plan->local;
  wide_pair along[AMBULO__MOST_PATHS];
  for (int i = 0; i < local->path_count; i++) {
    int above = local->path[i].above;
    along[i] = virtual_of_path(local, i, weights, above < 0 ? zero : along[above], scratch);
  }
  for (int f = 0; f < plan->contacts; f++) {
    v[f] = local->contact_path[f] < 0 ? zero : along[local->contact_path[f]];
  }
}

/* Q(v) */
AMBULO__INLINE wide_pair turned_against(wide_pair w, wide_pair v) {
  return (wide_pair){add_cross3(cross3(w.angular, v.angular), w.linear, v.linear),
                     cross3(w.linear, v.angular)};
}

/* What the contacts do to the loads of the bodies: root wrench, contacts, and their rows. */
AMBULO__INLINE void local_contacts(const ambulo__plan *plan, int keep, const double *ground,
                                   double *out, double *scratch) {
  const ambulo__local_plan *local = &plan->local;
  const local_sums sums = local_places(plan, keep, 1, out, scratch);
  wide_pair w = with_taken(plan, with_fixed_load(plan, sums.load), scratch);
  store_pair(out + plan->coordinates * AMBULO__LANES, w);
  contacts_share_out(plan, ground, keep, w, sums.first, out, scratch);
  for (int c = 0; c < plan->contacts; c++) {
    if (local->contact_step[c] < 0) continue;
    take_off(&local->steps[local->contact_step[c]], local->bare[c],
             load_pair(contact_at(plan, c, scratch) + contact_acts), scratch);
  }
}

/* All outputs of a body on contacts. */
AMBULO__INLINE void local_grounded(const ambulo__plan *plan, int keep, const double *q,
                                   const double *qd, const double *qdd, const double *ground,
                                   double *out, double *scratch) {
  const ambulo__limb *limbs = plan->local.limbs;
  contacts_place(plan, ground, scratch);
  for (int i = 0; i < plan->local.limb_count; i++) {
    limb_down(plan, &limbs[i], keep, q, qd, qdd, scratch);
  }
  local_contacts(plan, keep, ground, out, scratch);
  for (int i = 0; i < plan->local.limb_count; i++) {
    limb_up(plan, &limbs[i], keep, q, out, scratch);
  }
  for (int k = 0; k < plan->vanishing; k++) store(out + plan->roots[k], (wide){0});
}

/* (V): Adds M' and F' to *root, the weights on the root wrench. */
static local_pulls local_contact_adjoints(const ambulo__plan *plan, const double *ground,
                                          const double *weights, wide_pair *root,
                                          const double *scratch) {
  const double *at = scratch + plan->contacts_at;
  const wide floating = load(at + contacts_floating);
  wide_pair v[AMBULO__MOST_CONTACTS];
  local_pulls pulls;
  virtual_of_contacts(plan, weights, v, scratch);
  pulls.center = contacts_adjoints(plan, ground, weights, v, root, scratch);
  pulls.center = scale3(spread(1 / plan->mass), pulls.center);
  for (int c = 0; c < plan->contacts; c++) {
    wide_pair w = load_pair(contact_kept(plan, c, scratch) + contact_acts);
    pulls.contacts[c] = turned_against(w, add_pair(v[c], *root));
  }
  wide_pair turned = turned_against(load_pair(at + contacts_wrench), *root);
  pulls.floating = (wide_pair){scale3(floating, turned.angular), scale3(floating, turned.linear)};
  if (plan->taken_at) {
    wide_pair held = turned_against(load_pair(scratch + plan->taken_at), *root);
    pulls.floating = axpy_pair(pulls.floating, spread(-1), held);
  }
  return pulls;
}

/* virtual motion of the frames by the weights on their torques.
 *
 * Weights y on tau, (eta_0, u_0) on root moment and force. The virtual motion of the frames'
 * origins goes down the tree as motions do:
 *   revolute:   eta = R^T eta_p + z y,  u = R^T (u_p + eta_p x r)
 *   prismatic:  eta = eta_p,            u = u_p + eta_p x (r + z q) + z y
 */

/* What goes along through the passes. */
typedef struct local_arrays {
  const double *qd, *qdd, *weights;
  double *gq, *gqd, *gqdd, *scratch;
} local_arrays;

AMBULO__INLINE wide_pair hinge_virtual(const ambulo__local_step *step, wide_pair v, int k,
                                       const local_arrays *x) {
  double *at = x->scratch + step->at;
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  wide3 eta = into_frame(cycled(v.angular, k), s, c), u = into_frame(cycled(v.linear, k), s, c);
  if (!step->vanishes) eta.z += step->sign * load(x->weights + step->input);
  wide_pair moved = {uncycled(eta, k), uncycled(u, k)};
  if (step->kept || step->body != AMBULO__BODY_NONE) {
    store_pair(x->scratch + step->virtual_at, moved);
  } else {
    store_across(x->scratch + step->virtual_at, eta, k);
    store_across(x->scratch + step->virtual_at + three, u, k);
  }
  return moved;
}

AMBULO__INLINE wide_pair slider_virtual(const ambulo__local_step *step, wide_pair v,
                                        const local_arrays *x) {
  wide3 z = spread3(step->slide), r = scale3(load(x->scratch + step->at + local_angle), z);
  v.linear = add_cross3(v.linear, v.angular, r);
  if (!step->vanishes) v.linear = axpy3(v.linear, load(x->weights + step->input), z);
  store_pair(x->scratch + step->virtual_at, v);
  return v;
}

AMBULO__INLINE wide_pair straight_virtual(const ambulo__local_step *step, wide_pair v, int k,
                                          const local_arrays *x) {
  double *at = x->scratch + step->at;
  wide3 eta = cycled(v.angular, k), u = cycled(v.linear, k);
  wide r = step->sign * load(at + local_angle);
  u.x += r * eta.y;
  u.y -= r * eta.x;
  if (!step->vanishes) u.z += step->sign * load(x->weights + step->input);
  v.linear = uncycled(u, k);
  store_pair(x->scratch + step->virtual_at, v);
  return v;
}

AMBULO__INLINE wide_pair slide_virtual(const ambulo__local_step *step, wide_pair v,
                                       const local_arrays *x) {
  switch (step->joint) {
  case AMBULO__SLIDES_X:
    return straight_virtual(step, v, 0, x);
  case AMBULO__SLIDES_Y:
    return straight_virtual(step, v, 1, x);
  case AMBULO__SLIDES_Z:
    return straight_virtual(step, v, 2, x);
  default:
    return slider_virtual(step, v, x);
  }
}

/* Virtual motion of the steps from `first` to `last`. */
AMBULO__INLINE void virtual_motions(const ambulo__local_plan *local, int first, int last,
                                    wide_pair root, const local_arrays *x) {
  wide_pair v = root;
  if (first > last) return;
  const ambulo__local_step *step = &local->steps[first], *end = &local->steps[last];
  if (first > 0 && step->carried) v = load_pair(x->scratch + step->above + local_turn);
  for (; step <= end; step++) {
    if (!step->plain) {
      if (!step->carried) v = load_pair(x->scratch + step->above + local_turn);
      v = offset_down(step, v);
    }
    switch (step->joint) {
    case AMBULO__TURNS_X:
      v = hinge_virtual(step, v, 0, x);
      break;
    case AMBULO__TURNS_Y:
      v = hinge_virtual(step, v, 1, x);
      break;
    case AMBULO__TURNS_Z:
      v = hinge_virtual(step, v, 2, x);
      break;
    default:
      v = slide_virtual(step, v, x);
    }
  }
}

#endif
