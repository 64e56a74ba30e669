/* mechanics/kernel_local_forward.h - inverse dynamics in the frames' own axes (recursive
 * Newton-Euler; Luh, Walker & Paul 1980, Featherstone 2008).
 *
 * In its own axes a turn about axis k mixes two components of a vector, and inertias are constants
 * most of which vanish. Down the tree, p the parent frame, R the turn of the joint (parent from
 * frame), z its axis, r the constant offset of the origins, Omega r = alpha x r + w x (w x r):
 *   revolute:   w = R^T w_p + z qd,  alpha = R^T alpha_p + w x z qd + z qdd,
 *               a = R^T (a_p + Omega_p r)
 *   prismatic:  w = w_p, alpha = alpha_p,
 *               a = a_p + Omega_p (r + z q) + 2 w x z qd + z qdd
 * For every body, c its centre of mass and I the inertia about it:
 *   F = m (a + Omega c),   H = I alpha + w x I w
 * With a diagonal I, H_x = I_xx alpha_x + (I_zz - I_yy) w_y w_z and so on. Up the tree the load of
 * each subtree about the frame's origin, moment n and force f:
 *   n = sum H + c x F + what comes from the children,  tau = z . n  or  z . f
 *   n_p = R n + (r + z q) x R f,  f_p = R f
 * The world's load is the root wrench. Axes are z = sign e_k. In a frame that does not turn, w and
 * alpha are zero, and a slider along an axis only touches a_k.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_FORWARD_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_FORWARD_H

#include "mechanics/kernel_local_angles.h"
#include "mechanics/kernel_local_axes.h"

AMBULO__INLINE local_state hinge_down(const ambulo__local_step *step, local_state state, int k,
                                      const double *qd, const double *qdd, const double *scratch) {
  const double *at = scratch + step->at;
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  wide rate = step->sign * load(qd + step->input), gain = step->sign * load(qdd + step->input);
  wide3 w = into_frame(cycled(state.w, k), s, c), from = cycled(state.alpha, k);
  wide3 a = into_frame(cycled(state.a, k), s, c);
  /* w is known before alpha */
  wide3 alpha = {c * from.x + (s * from.y + rate * w.y), c * from.y - (s * from.x + rate * w.x),
                 from.z + gain};
  w.z += rate;
  return (local_state){uncycled(w, k), uncycled(alpha, k), uncycled(a, k)};
}

AMBULO__INLINE wide3 slider_down(const ambulo__local_step *step, local_state s, const double *q,
                                 const double *qd, const double *qdd, double *scratch) {
  wide3 z = spread3(step->slide), a = axpy3(s.a, load(qdd + step->input), z);
  double *at = scratch + step->at;
  store(at + local_angle, load(q + step->input));
  if (step->still) return a;
  a = moved_any(a, s.w, s.alpha, scale3(load(q + step->input), z));
  return add_cross3(a, scale3(2 * load(qd + step->input), s.w), z);
}

/* Along axis k, of a frame that does not turn. */
AMBULO__INLINE wide3 straight_down(const ambulo__local_step *step, local_state s, int k,
                                   const double *q, const double *qdd, double *scratch) {
  wide3 a = cycled(s.a, k);
  double *at = scratch + step->at;
  store(at + local_angle, load(q + step->input));
  a.z += step->sign * load(qdd + step->input);
  return uncycled(a, k);
}

AMBULO__INLINE wide3 slide_down(const ambulo__local_step *step, local_state s, const double *q,
                                const double *qd, const double *qdd, double *scratch) {
  switch (step->joint) {
  case AMBULO__SLIDES_X:
    return straight_down(step, s, 0, q, qdd, scratch);
  case AMBULO__SLIDES_Y:
    return straight_down(step, s, 1, q, qdd, scratch);
  case AMBULO__SLIDES_Z:
    return straight_down(step, s, 2, q, qdd, scratch);
  default:
    return slider_down(step, s, q, qd, qdd, scratch);
  }
}

/* Moment about the frame's origin, and force, of a body on axis k. */
AMBULO__INLINE void body_along(const ambulo__local_step *step, local_state s, int k, double *to) {
  int u = (k + 1) % 3, v = (k + 2) % 3;
  const double *inertia = step->inertia, *difference = step->difference;
  wide3 w = cycled(s.w, k), alpha = cycled(s.alpha, k), a = cycled(s.a, k);
  wide xz = w.x * w.z, yz = w.y * w.z;
  wide m = spread(step->mass), h = spread(step->first_moment[k]), c = spread(step->com[k]);
  wide3 f = {m * a.x + h * (xz + alpha.y), m * a.y + h * (yz - alpha.x),
             m * a.z - h * (w.x * w.x + w.y * w.y)};
  wide3 n = {inertia[u] * alpha.x + difference[u] * yz - c * f.y,
             inertia[v] * alpha.y + difference[v] * xz + c * f.x,
             inertia[k] * alpha.z + difference[k] * (w.x * w.y)};
  store_cycled(to, n, k);
  store_cycled(to + three, f, k);
}

AMBULO__INLINE wide6 constant_inertia(const double *i) {
  return (wide6){spread(i[0]), spread(i[1]), spread(i[2]),
                 spread(i[3]), spread(i[4]), spread(i[5])};
}

AMBULO__INLINE void body_any(const ambulo__local_step *step, local_state s, int diagonal,
                             double *to) {
  const double *i = step->inertia, *d = step->difference;
  wide3 f = moved_any(scale3(spread(step->mass), s.a), s.w, s.alpha, spread3(step->first_moment));
  wide3 n = {i[0] * s.alpha.x + d[0] * (s.w.y * s.w.z), i[1] * s.alpha.y + d[1] * (s.w.z * s.w.x),
             i[2] * s.alpha.z + d[2] * (s.w.x * s.w.y)};
  if (!diagonal) {
    wide6 inertia = constant_inertia(i);
    n = add_cross3(multiply6(inertia, s.alpha), s.w, multiply6(inertia, s.w));
  }
  store3(to, add_cross3(n, spread3(step->com), f));
  store3(to + three, f);
}

AMBULO__INLINE void body_down(const ambulo__local_step *step, local_state s, double *scratch) {
  double *to = scratch + step->at + local_load;
  switch (step->body) {
  case AMBULO__BODY_X:
    body_along(step, s, 0, to);
    break;
  case AMBULO__BODY_Y:
    body_along(step, s, 1, to);
    break;
  case AMBULO__BODY_Z:
    body_along(step, s, 2, to);
    break;
  case AMBULO__BODY_DIAGONAL:
    body_any(step, s, 1, to);
    break;
  case AMBULO__BODY_ANY:
    body_any(step, s, 0, to);
    break;
  default:
    break;
  }
}

AMBULO__INLINE local_state load_motion(const double *at) {
  return (local_state){load3(at + local_rate), load3(at + local_gain), load3(at + local_pull)};
}

/* From the parent to where the joint turns or slides. */
AMBULO__INLINE local_state carried_down(const ambulo__local_step *step, local_state s,
                                        const double *scratch) {
  if (!step->carried) {
    const double *above = scratch + step->above;
    s = load_motion(above);
  }
  s.a = moved_by_offset(step, s);
  if (!step->turned) return s;
  return (local_state){into_turn(step->turn, s.w), into_turn(step->turn, s.alpha),
                       into_turn(step->turn, s.a)};
}

/* (10 L): Down to a leaf. */
AMBULO__INLINE void limb_down(const ambulo__plan *plan, const ambulo__limb *limb, int keep,
                              const double *q, const double *qd, const double *qdd,
                              double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  local_state s = {zero, zero, scale3(spread(-1), spread3(plan->gravity))};
  const ambulo__local_step *step = &plan->local.steps[limb->first];
  for (const ambulo__local_step *leaf = &plan->local.steps[limb->leaf]; step <= leaf; step++) {
    if (!step->plain) s = carried_down(step, s, scratch);
    switch (step->joint) {
    case AMBULO__TURNS_X:
      s = hinge_down(step, s, 0, qd, qdd, scratch);
      break;
    case AMBULO__TURNS_Y:
      s = hinge_down(step, s, 1, qd, qdd, scratch);
      break;
    case AMBULO__TURNS_Z:
      s = hinge_down(step, s, 2, qd, qdd, scratch);
      break;
    default:
      s.a = slide_down(step, s, q, qd, qdd, scratch);
    }
    if (keep ? step->stored : step->kept) {
      store3(scratch + step->at + local_rate, s.w);
      store3(scratch + step->at + local_gain, s.alpha);
      store3(scratch + step->at + local_pull, s.a);
    }
    body_down(step, s, scratch);
  }
}

/* tau of a hinge, and what the reverse sweep reads; n, f: cycled. */
AMBULO__INLINE void hinge_bears(const ambulo__local_step *step, wide3 n, wide3 f, int k, int keep,
                                double *out, double *at) {
  store(out + step->input, step->sign * n.z);
  if (!keep) return;
  store_across(at + local_moment, n, k);
  store_across(at + local_force, f, k);
}

AMBULO__INLINE wide_pair hinge_up(const ambulo__local_step *step, wide_pair load_of, int k,
                                  int keep, double *out, double *scratch) {
  double *at = scratch + step->at;
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  wide3 n = cycled(load_of.angular, k), f = cycled(load_of.linear, k);
  hinge_bears(step, n, f, k, keep, out, at);
  return (wide_pair){uncycled(from_frame(n, s, c), k), uncycled(from_frame(f, s, c), k)};
}

AMBULO__INLINE wide_pair slider_up(const ambulo__local_step *step, wide_pair load_of, int keep,
                                   const double *q, double *out, double *scratch) {
  wide3 z = spread3(step->slide);
  store(out + step->input, dot3(z, load_of.linear));
  if (keep) store3(scratch + step->at + local_force, load_of.linear);
  load_of.angular = add_cross3(load_of.angular, scale3(load(q + step->input), z), load_of.linear);
  return load_of;
}

AMBULO__INLINE wide_pair straight_up(const ambulo__local_step *step, wide_pair load_of, int k,
                                     int keep, const double *q, double *out, double *scratch) {
  wide3 n = cycled(load_of.angular, k), f = cycled(load_of.linear, k);
  wide r = step->sign * load(q + step->input);
  store(out + step->input, step->sign * f.z);
  if (keep) store_cycled(scratch + step->at + local_force, f, k);
  n.x -= r * f.y;
  n.y += r * f.x;
  return (wide_pair){uncycled(n, k), load_of.linear};
}

AMBULO__INLINE wide_pair slide_up(const ambulo__local_step *step, wide_pair sum, int keep,
                                  const double *q, double *out, double *scratch) {
  switch (step->joint) {
  case AMBULO__SLIDES_X:
    return straight_up(step, sum, 0, keep, q, out, scratch);
  case AMBULO__SLIDES_Y:
    return straight_up(step, sum, 1, keep, q, out, scratch);
  case AMBULO__SLIDES_Z:
    return straight_up(step, sum, 2, keep, q, out, scratch);
  default:
    return slider_up(step, sum, keep, q, out, scratch);
  }
}

/* The load of a frame's subtree across the frame's joint. */
AMBULO__INLINE wide_pair joint_up(const ambulo__local_step *step, wide_pair sum, int keep,
                                  const double *q, double *out, double *scratch) {
  switch (step->joint) {
  case AMBULO__TURNS_X:
    sum = hinge_up(step, sum, 0, keep, out, scratch);
    break;
  case AMBULO__TURNS_Y:
    sum = hinge_up(step, sum, 1, keep, out, scratch);
    break;
  case AMBULO__TURNS_Z:
    sum = hinge_up(step, sum, 2, keep, out, scratch);
    break;
  default:
    sum = slide_up(step, sum, keep, q, out, scratch);
  }
  if (step->plain) return sum;
  if (step->turned) {
    sum.angular = out_of_turn(step->turn, sum.angular);
    sum.linear = out_of_turn(step->turn, sum.linear);
  }
  sum.angular = levered(step, sum.angular, sum.linear);
  return sum;
}

/* As joint_up, of a hinge whose parent's load is not asked for. */
AMBULO__INLINE void last_hinge_up(const ambulo__local_step *step, wide_pair sum, int keep,
                                  double *out, double *scratch) {
  double *at = scratch + step->at;
  switch (step->joint) {
  case AMBULO__TURNS_X:
    hinge_bears(step, cycled(sum.angular, 0), cycled(sum.linear, 0), 0, keep, out, at);
    break;
  case AMBULO__TURNS_Y:
    hinge_bears(step, cycled(sum.angular, 1), cycled(sum.linear, 1), 1, keep, out, at);
    break;
  default:
    hinge_bears(step, sum.angular, sum.linear, 2, keep, out, at);
  }
}

/* (10 L): Up from the leaf. */
AMBULO__INLINE void limb_up(const ambulo__plan *plan, const ambulo__limb *limb, int keep,
                            const double *q, double *out, double *scratch) {
  wide_pair sum = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  const ambulo__local_step *steps = plan->local.steps, *step = &steps[limb->leaf];
  const ambulo__local_step *top = &steps[limb->rise];
  if (step->loaded) sum = load_pair(scratch + step->at + local_load);
  while (step != top) {
    sum = joint_up(step, sum, keep, q, out, scratch);
    step = &steps[step->parent];
    if (step->loaded) sum = add_pair(load_pair(scratch + step->at + local_load), sum);
  }
  if (limb->ends && step->joint < AMBULO__SLIDES) {
    last_hinge_up(step, sum, keep, out, scratch);
    return;
  }
  sum = joint_up(step, sum, keep, q, out, scratch);
  if (limb->ends) return;
  double *above = scratch + step->above + local_load;
  store_pair(above, limb->fresh ? sum : add_pair(load_pair(above), sum));
}

/* Before the first limb. */
AMBULO__INLINE void local_world(const ambulo__plan *plan, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  double *world = scratch + plan->local.world_at;
  if (!plan->local.branched) return;
  store3(world + local_rate, zero);
  store3(world + local_gain, zero);
  store3(world + local_pull, scale3(spread(-1), spread3(plan->gravity)));
}

AMBULO__INLINE wide_pair with_fixed_load(const ambulo__plan *plan, wide_pair sum) {
  return (wide_pair){add3(sum.angular, spread3(plan->fixed_load)),
                     add3(sum.linear, spread3(plan->fixed_load + 3))};
}

/* tau and the root wrench, without ground reaction; keep: what the reverse sweep reads is stored.
 * Known when this is compiled. */
AMBULO__INLINE void local_dynamics(const ambulo__plan *plan, int keep, const double *q,
                                   const double *qd, const double *qdd, double *out,
                                   double *scratch) {
  for (int i = 0; i < plan->local.limb_count; i++) {
    limb_down(plan, &plan->local.limbs[i], keep, q, qd, qdd, scratch);
    limb_up(plan, &plan->local.limbs[i], keep, q, out, scratch);
  }
  wide_pair sum = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  if (plan->local.limb_count > 0) sum = load_pair(scratch + plan->local.world_at + local_load);
  store_pair(out + plan->coordinates * AMBULO__LANES, with_fixed_load(plan, sum));
}

#endif
