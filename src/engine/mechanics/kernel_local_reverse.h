/* mechanics/kernel_local_reverse.h - gradient of a weighted sum of the outputs, in the frames' own
 * axes, after kernel_local_forward.h on the same scratch.
 *
 * Weights y on tau, (eta_0, u_0) on root moment and force. By virtual work
 *   sum y tau + eta_0 . M + u_0 . F = sum over bodies of  (u + eta x c) . F + eta . H,
 * where (eta, u) is the virtual motion of the frames' origins (kernel_local_virtual.h). x' is the
 * adjoint of x. Those of eta and u are the moment n and the force f of the subtree, which the
 * forward pass has stored. Those of w, alpha and a go up the tree. With b = m (u + eta x c) and
 * Omega'(r, b) the adjoint of b . Omega r = b . (alpha x r) + (b . w) (w . r) - (w . w) (b . r),
 *   alpha' += r x b,   w' += b (w . r) + r (b . w) - 2 w (b . r):
 * body:
 *   a' += b,   (alpha', w') += Omega'(c, b),
 *   alpha' += I eta,   w' += L x eta + I (eta x w),   L = I w,
 *   for a diagonal I, with D = (I_zz - I_yy, I_xx - I_zz, I_yy - I_xx) and e_i = D_i eta_i:
 *   w' += (e_y w_z + e_z w_y, e_x w_z + e_z w_x, e_x w_y + e_y w_x)
 * revolute:
 *   qdd' = z . alpha',   qd' = z . (w' + alpha' x w),
 *   q' = z . (w' x w + alpha' x alpha + a' x a + n x eta + f x u),
 *   w_p' = R (w' + z x alpha' qd),   alpha_p' = R alpha',   a_p' = R a'
 *   q' holds since d(R^T v)/dq = -z x R^T v, at first for the vectors and adjoints before the
 *   terms with qd and qdd: what these terms change in z . (w' x w) and z . (alpha' x alpha)
 *   cancels, and z y does not count along z.
 * offset r:
 *   (alpha_p', w_p') += Omega'(r, a_p')
 * prismatic:
 *   qdd' = z . a',   qd' = 2 z . (a' x w),   w' += 2 qd z x a',
 *   (alpha', w') += Omega'(z q, a'),   q' = z . (Omega^T a' + f x eta),
 *   Omega^T a' = a' x alpha + w (w . a') - a' (w . w)
 * Motions (w, alpha, a) are not read again at every frame: going up, those of a parent follow from
 * the child's, since what a hinge does can be undone,
 *   w_p = R (w - z qd),   alpha_p = R (alpha - w x z qd - z qdd),   a_p = R a - Omega_p r,
 * which costs less than to carry them to and from the second cache in bodies of many limbs. The
 * forward pass stores those of leaves, of forks, and above sliders.
 * Ground reaction: kernel_local_contacts.h.
 * Points: kernel_local_points.h.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_REVERSE_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_REVERSE_H

#include "mechanics/kernel_local_contacts.h"

/* s += Omega'(r, b); s holds the adjoints of w, alpha and a. */
AMBULO__INLINE local_state moved_adjoint_any(local_state s, wide3 w, wide3 r, wide3 b) {
  s.alpha = add_cross3(s.alpha, r, b);
  s.w = axpy3(axpy3(s.w, dot3(w, r), b), dot3(b, w), r);
  s.w = axpy3(s.w, -2 * dot3(b, r), w);
  return s;
}

AMBULO__INLINE local_state moved_adjoint_along(local_state s, wide3 w, int k, double length,
                                               wide3 b) {
  wide3 rate = cycled(s.w, k), gain = cycled(s.alpha, k), g = scale3(spread(length), cycled(b, k));
  w = cycled(w, k);
  wide twice = 2 * g.z;
  gain.x -= g.y;
  gain.y += g.x;
  rate.x = rate.x + g.x * w.z - twice * w.x;
  rate.y = rate.y + g.y * w.z - twice * w.y;
  rate.z = rate.z + g.x * w.x + g.y * w.y;
  return (local_state){uncycled(rate, k), uncycled(gain, k), s.a};
}

/* Across the offset, into the parent's adjoints; w is the parent's. */
AMBULO__INLINE local_state offset_adjoint(const ambulo__local_step *step, local_state s, wide3 w) {
  switch (step->moving) {
  case AMBULO__OFFSET_X:
    return moved_adjoint_along(s, w, 0, step->length, s.a);
  case AMBULO__OFFSET_Y:
    return moved_adjoint_along(s, w, 1, step->length, s.a);
  case AMBULO__OFFSET_Z:
    return moved_adjoint_along(s, w, 2, step->length, s.a);
  case AMBULO__OFFSET_ANY:
    return moved_adjoint_any(s, w, spread3(step->move), s.a);
  default:
    return s;
  }
}

AMBULO__INLINE local_state body_adjoint_along(const ambulo__local_step *step, local_state s, int k,
                                              wide3 w, const double *scratch) {
  const double *virtual = scratch + step->virtual_at;
  int u = (k + 1) % 3, v = (k + 2) % 3;
  const double *inertia = step->inertia, *difference = step->difference;
  wide3 eta = load_cycled(virtual, k), b = load_cycled(virtual + three, k);
  wide c = spread(step->com[k]), m = spread(step->mass);
  w = cycled(w, k);
  b = (wide3){m * (b.x + c * eta.y), m * (b.y - c * eta.x), m * b.z};
  s = (local_state){cycled(s.w, k), cycled(s.alpha, k), add3(cycled(s.a, k), b)};
  s = moved_adjoint_along(s, w, 2, step->com[k], b);
  wide3 e = {difference[u] * eta.x, difference[v] * eta.y, difference[k] * eta.z};
  s.alpha.x += inertia[u] * eta.x;
  s.alpha.y += inertia[v] * eta.y;
  s.alpha.z += inertia[k] * eta.z;
  s.w.x = s.w.x + e.y * w.z + e.z * w.y;
  s.w.y = s.w.y + e.x * w.z + e.z * w.x;
  s.w.z = s.w.z + e.x * w.y + e.y * w.x;
  return (local_state){uncycled(s.w, k), uncycled(s.alpha, k), uncycled(s.a, k)};
}

AMBULO__INLINE local_state body_adjoint_any(const ambulo__local_step *step, local_state s,
                                            int diagonal, wide3 w, const double *scratch) {
  const double *i = step->inertia, *d = step->difference;
  wide_pair v = load_pair(scratch + step->virtual_at);
  wide3 eta = v.angular;
  wide3 c = spread3(step->com), b = add_cross3(v.linear, eta, c);
  b = scale3(spread(step->mass), b);
  s.a = add3(s.a, b);
  s = moved_adjoint_any(s, w, c, b);
  if (diagonal) {
    wide3 e = {d[0] * eta.x, d[1] * eta.y, d[2] * eta.z};
    s.alpha = add3(s.alpha, (wide3){i[0] * eta.x, i[1] * eta.y, i[2] * eta.z});
    s.w = (wide3){s.w.x + e.y * w.z + e.z * w.y, s.w.y + e.x * w.z + e.z * w.x,
                  s.w.z + e.x * w.y + e.y * w.x};
  } else {
    wide6 inertia = constant_inertia(i);
    s.alpha = add3(s.alpha, multiply6(inertia, eta));
    s.w = add_cross3(s.w, multiply6(inertia, w), eta);
    s.w = add3(s.w, multiply6(inertia, cross3(eta, w)));
  }
  return s;
}

AMBULO__INLINE local_state body_adjoint(const ambulo__local_step *step, local_state s, wide3 w,
                                        const double *scratch) {
  switch (step->body) {
  case AMBULO__BODY_X:
    return body_adjoint_along(step, s, 0, w, scratch);
  case AMBULO__BODY_Y:
    return body_adjoint_along(step, s, 1, w, scratch);
  case AMBULO__BODY_Z:
    return body_adjoint_along(step, s, 2, w, scratch);
  case AMBULO__BODY_DIAGONAL:
    return body_adjoint_any(step, s, 1, w, scratch);
  case AMBULO__BODY_ANY:
    return body_adjoint_any(step, s, 0, w, scratch);
  default:
    return s;
  }
}

/* z . (a' x a), of which only the components across z count; at: of a. */
AMBULO__INLINE wide turned_by(wide sum, wide3 adjoint, const double *at, int k) {
  sum += adjoint.x * load(at + (k + 2) % 3 * AMBULO__LANES);
  return sum - adjoint.y * load(at + (k + 1) % 3 * AMBULO__LANES);
}

/* The same; a in cyclic order. */
AMBULO__INLINE wide turned_with(wide sum, wide3 adjoint, wide3 a) {
  return sum + adjoint.x * a.y - adjoint.y * a.x;
}

AMBULO__INLINE local_state hinge_adjoint(const ambulo__local_step *step, local_state state, int k,
                                         local_state *motion, const local_arrays *x) {
  const double *at = x->scratch + step->at;
  int u = (k + 1) % 3 * AMBULO__LANES, v = (k + 2) % 3 * AMBULO__LANES;
  wide3 w = cycled(state.w, k), alpha = cycled(state.alpha, k), a = cycled(state.a, k);
  wide3 mw = cycled(motion->w, k), gain = cycled(motion->alpha, k), pull = cycled(motion->a, k);
  wide rate = step->sign * load(x->qd + step->input), zero = {0};
  wide turned = turned_with(zero, w, mw), other = zero;
  turned = turned_with(turned, alpha, gain);
  turned = turned_with(turned, a, pull);
  if (!step->vanishes) {
    wide3 n = {load(at + local_moment + u), load(at + local_moment + v), zero};
    wide3 f = {load(at + local_force + u), load(at + local_force + v), zero};
    const double *virtual = x->scratch + step->virtual_at;
    other = turned_by(turned_by(other, n, virtual, k), f, virtual + three, k);
  }
  store(x->gq + step->input, step->sign * (turned + other));
  store(x->gqd + step->input, step->sign * turned_with(w.z, alpha, mw));
  store(x->gqdd + step->input, step->sign * alpha.z);
  w.x -= rate * alpha.y;
  w.y += rate * alpha.x;
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  if (step->unwinds) {
    gain.x -= rate * mw.y;
    gain.y += rate * mw.x;
    gain.z -= step->sign * load(x->qdd + step->input);
    motion->alpha = uncycled(from_frame(gain, s, c), k);
    motion->a = uncycled(from_frame(pull, s, c), k);
  }
  mw.z -= rate;
  motion->w = uncycled(from_frame(mw, s, c), k);
  return (local_state){uncycled(from_frame(w, s, c), k), uncycled(from_frame(alpha, s, c), k),
                       uncycled(from_frame(a, s, c), k)};
}

AMBULO__INLINE local_state slider_adjoint(const ambulo__local_step *step, local_state s,
                                          const local_state *motion, const local_arrays *x) {
  const double *at = x->scratch + step->at;
  wide3 z = spread3(step->slide);
  wide drift = {0};
  wide3 push = {drift, drift, drift};
  if (!step->vanishes) push = cross3(load3(at + local_force), load3(x->scratch + step->virtual_at));
  if (!step->still) {
    wide3 w = motion->w, twice = scale3(2 * load(x->qd + step->input), z);
    drift = 2 * dot3(z, cross3(s.a, w));
    push = add_cross3(push, s.a, motion->alpha);
    push = axpy3(axpy3(push, dot3(w, s.a), w), -dot3(w, w), s.a);
    s.w = add_cross3(s.w, twice, s.a);
    s = moved_adjoint_any(s, w, scale3(load(at + local_angle), z), s.a);
  }
  store(x->gq + step->input, dot3(z, push));
  store(x->gqd + step->input, drift);
  store(x->gqdd + step->input, dot3(z, s.a));
  return s;
}

/* The adjoints of w and alpha of a frame that does not turn are not read. */
AMBULO__INLINE local_state straight_adjoint(const ambulo__local_step *step, local_state s, int k,
                                            const local_arrays *x) {
  const double *at = x->scratch + step->at;
  const wide zero = {0};
  wide push = zero;
  if (!step->vanishes) {
    wide3 f = load_cycled(at + local_force, k);
    push = turned_by(zero, f, x->scratch + step->virtual_at, k);
  }
  store(x->gq + step->input, step->sign * push);
  store(x->gqd + step->input, zero);
  store(x->gqdd + step->input, step->sign * cycled(s.a, k).z);
  return s;
}

AMBULO__INLINE local_state slide_adjoint(const ambulo__local_step *step, local_state s,
                                         const local_state *motion, const local_arrays *x) {
  switch (step->joint) {
  case AMBULO__SLIDES_X:
    return straight_adjoint(step, s, 0, x);
  case AMBULO__SLIDES_Y:
    return straight_adjoint(step, s, 1, x);
  case AMBULO__SLIDES_Z:
    return straight_adjoint(step, s, 2, x);
  default:
    return slider_adjoint(step, s, motion, x);
  }
}

/* Adjoints of a frame into those of its parent. */
AMBULO__INLINE local_state joint_adjoint(const ambulo__local_step *step, local_state s,
                                         local_state *motion, const local_arrays *x) {
  switch (step->joint) {
  case AMBULO__TURNS_X:
    s = hinge_adjoint(step, s, 0, motion, x);
    break;
  case AMBULO__TURNS_Y:
    s = hinge_adjoint(step, s, 1, motion, x);
    break;
  case AMBULO__TURNS_Z:
    s = hinge_adjoint(step, s, 2, motion, x);
    break;
  default:
    s = slide_adjoint(step, s, motion, x);
  }
  if (step->plain) return s;
  if (step->turned) {
    s = (local_state){out_of_turn(step->turn, s.w), out_of_turn(step->turn, s.alpha),
                      out_of_turn(step->turn, s.a)};
    motion->w = out_of_turn(step->turn, motion->w);
    motion->alpha = out_of_turn(step->turn, motion->alpha);
    motion->a = out_of_turn(step->turn, motion->a);
  }
  if (step->unwinds) motion->a = moved_back(step, *motion);
  return offset_adjoint(step, s, motion->w);
}

AMBULO__INLINE local_state add_stored(local_state s, const double *at) {
  return (local_state){add3(s.w, load3(at)), add3(s.alpha, load3(at + three)),
                       add3(s.a, load3(at + 2 * three))};
}

/* Leaves the adjoints to a parent that is not the step before; the world's are not asked for. */
AMBULO__INLINE void leave_adjoints(const ambulo__local_step *step, local_state s,
                                   const local_arrays *x) {
  if (step->from_world) return;
  double *above = x->scratch + step->above + local_adjoint;
  if (!step->first_adjoint) s = add_stored(s, above);
  store3(above, s.w);
  store3(above + three, s.alpha);
  store3(above + 2 * three, s.a);
}

/* (V): Adjoints of the steps from `last` up to `first`. */
AMBULO__INLINE void limb_adjoints(const ambulo__local_plan *local, int first, int last,
                                  const local_arrays *x) {
  const local_state zero = {{{0}, {0}, {0}}, {{0}, {0}, {0}}, {{0}, {0}, {0}}};
  local_state s = zero, motion = zero;
  const ambulo__local_step *end = &local->steps[first];
  for (const ambulo__local_step *step = &local->steps[last]; step >= end; step--) {
    if (step->kept) s = add_stored(s, x->scratch + step->at + local_adjoint);
    if (step->stored) motion = load_motion(x->scratch + step->at);
    s = joint_adjoint(step, body_adjoint(step, s, motion.w, x->scratch), &motion, x);
    if (step->carried) continue;
    leave_adjoints(step, s, x);
    s = zero;
  }
}

/* The last limb first: of what the pass before has stored, that is what is still at hand. The
 * stems, on which other limbs stand, go before. */
static void local_adjoints(const ambulo__plan *plan, wide_pair root, const local_arrays *x) {
  const ambulo__local_plan *local = &plan->local;
  if (local->branched) store_pair(x->scratch + local->world_at + local_turn, root);
  for (int i = 0; i < local->limb_count; i++) {
    virtual_motions(local, local->limbs[i].first, local->limbs[i].stem, root, x);
  }
  for (int i = local->limb_count - 1; i >= 0; i--) {
    const ambulo__limb *limb = &local->limbs[i];
    virtual_motions(local, limb->stem + 1, limb->leaf, root, x);
    limb_adjoints(local, limb->first, limb->leaf, x);
  }
}

static void local_reverse_part(const ambulo__plan *plan, const double *ground,
                               const local_arrays *x) {
  wide_pair root = load_pair(x->weights + plan->coordinates * AMBULO__LANES);
  local_pulls pulls, *acting = NULL;
  if (plan->contacts > 0) {
    pulls = local_contact_adjoints(plan, ground, x->weights, &root, x->scratch);
    acting = &pulls;
  }
  if (plan->taken_at) store_pair(x->scratch + plan->taken_at + 2 * three, root);
  local_adjoints(plan, root, x);
  if (plan->points == 0 && !acting) return;
  local_point_weights(plan, acting, x->weights, x->gq, x->scratch);
}

#endif
