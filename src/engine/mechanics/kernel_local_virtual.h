/* mechanics/kernel_local_virtual.h - virtual motion of the frames by the weights on their torques.
 *
 * Weights y on tau, (eta_0, u_0) on root moment and force. The virtual motion of the frames'
 * origins goes down the tree as motions do:
 *   revolute:   eta = R^T eta_p + z y,  u = R^T (u_p + eta_p x r)
 *   prismatic:  eta = eta_p,            u = u_p + eta_p x (r + z q) + z y
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_VIRTUAL_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_VIRTUAL_H

#include "mechanics/kernel_local_contacts.h"

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
