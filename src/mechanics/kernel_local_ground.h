/* mechanics/kernel_local_ground.h - the feet's wrenches in the frames' own axes.
 *
 * After the pass up the tree, which leaves the loads of the bodies and the root wrench, and after
 * kernel_local_points.h, which gives the centre of mass, the root wrench is split between the
 * feet (kernel_ground.h). A foot's wrench (M_f, F_f) stands still in world axes; about the origin
 * o of a frame with the columns R, in the frame's axes, it is
 *   f = R^T F_f,   n = R^T (M_f - o x F_f),
 * and from a frame to the next it goes as motions do: f as an angular velocity, n as the velocity
 * of the origin, since n about p + r is n - r x f = n + f x r. It is taken off the moment and the
 * force that the joint carries, tau = z . (n_subtree - n)  or  z . (f_subtree - f).
 *
 * Adjoints, with the weights y on tau of the joints that carry foot f: V_f = sum S_i y_i is the
 * virtual motion that they give the foot (world axes, about the world origin). ground_adjoints
 * makes of V_f the weights on the root wrench and on the centre of mass, through which W_f depends
 * on the motion. What is left is the turn of the joints' axes against a W_f that stands still. A
 * step of q_j turns each S_i below j, so that, with D_j the part of V_f from the joints below j,
 *   d(- V_f . W_f)/dq_j = S_j . Q(D_j),   Q(e, l) = (M_f x e + F_f x l, F_f x e).
 * The reverse sweep does not know D_j. It has the virtual motion A_j of the frame, from the root
 * down to j, root weights and all, and takes the net load for one that turns with the subtree: its
 * part is -S_j . Q(A_j). Since E_f = A_j + D_j, the virtual motion of the foot with the root
 * weights, is the same for all j, and Q is linear, what is missing is one pair for all the joints
 * that carry f:
 *   q_j' += S_j . Q(E_f).
 * Where tau vanishes the net load is zero, and y does not count.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_GROUND_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_GROUND_H

#include "mechanics/kernel_ground.h"
#include "mechanics/kernel_local_points.h"

/* A pair that goes as a motion does, across the offset and the constant turn of a joint. */
AMBULO__INLINE wide_pair offset_down(const ambulo__local_step *step, wide_pair v) {
  /* u + eta x r = u - r x eta */
  v.linear = levered(step, v.linear, scale3(spread(-1), v.angular));
  if (step->turned) {
    v = (wide_pair){into_turn(step->turn, v.angular), into_turn(step->turn, v.linear)};
  }
  return v;
}

AMBULO__INLINE void subtract_across(double *at, wide3 v, int k) {
  double *u = at + (k + 1) % 3 * AMBULO__LANES, *w = at + (k + 2) % 3 * AMBULO__LANES;
  store(u, load(u) - v.x);
  store(w, load(w) - v.y);
}

AMBULO__INLINE wide_pair hinge_relief(const ambulo__local_step *step, wide_pair w, int k, int keep,
                                      double *out, double *at) {
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  wide3 f = into_frame(cycled(w.angular, k), s, c), n = into_frame(cycled(w.linear, k), s, c);
  if (keep) {
    subtract_across(at + local_moment, n, k);
    subtract_across(at + local_force, f, k);
  }
  store(out + step->input, load(out + step->input) - step->sign * n.z);
  return (wide_pair){uncycled(f, k), uncycled(n, k)};
}

AMBULO__INLINE wide_pair slider_relief(const ambulo__local_step *step, wide_pair w, int keep,
                                       double *out, double *at) {
  wide3 z = spread3(step->slide);
  w.linear = add_cross3(w.linear, w.angular, scale3(load(at + local_angle), z));
  if (keep) add3_at(at + local_force, scale3(spread(-1), w.angular));
  store(out + step->input, load(out + step->input) - dot3(z, w.angular));
  return w;
}

/* A wrench in the axes of the frame that p places: force, moment about its origin. */
AMBULO__INLINE wide_pair wrench_seen(const local_place *p, wide_pair w) {
  wide3 n = add_cross3(w.angular, w.linear, p->o), f = w.linear;
  return (wide_pair){{dot3(p->x, f), dot3(p->y, f), dot3(p->z, f)},
                     {dot3(p->x, n), dot3(p->y, n), dot3(p->z, n)}};
}

/* Takes the wrench w (world axes) off what the joints of a path carry. */
AMBULO__INLINE void local_relief(const ambulo__plan *plan, int path, wide_pair w, int keep,
                                 double *out, double *scratch) {
  const ambulo__local_plan *local = &plan->local;
  int first = local->carrier_first[path], last = local->carrier_first[path + 1];
  if (first == last) return;
  const ambulo__local_step *top = &local->steps[local->carrier[first]];
  if (top->from_world) {
    w = (wide_pair){w.linear, w.angular};
  } else {
    local_place p = place_load(scratch + top->above);
    w = wrench_seen(&p, w);
  }
  for (int i = first; i < last; i++) {
    const ambulo__local_step *step = &local->steps[local->carrier[i]];
    double *at = scratch + step->at;
    w = offset_down(step, w);
    switch (step->joint) {
    case AMBULO__TURNS_X:
      w = hinge_relief(step, w, 0, keep, out, at);
      break;
    case AMBULO__TURNS_Y:
      w = hinge_relief(step, w, 1, keep, out, at);
      break;
    case AMBULO__TURNS_Z:
      w = hinge_relief(step, w, 2, keep, out, at);
      break;
    default:
      w = slider_relief(step, w, keep, out, at);
    }
  }
}

/* From the root wrench in its rows and the bodies' first mass moment: the split, tau, the rows. */
AMBULO__INLINE void local_ground(const ambulo__plan *plan, const double *ground, wide3 first,
                                 int keep, double *out, double *scratch) {
  const double *at = scratch + plan->ground_at;
  wide_pair w = load_pair(out + plan->coordinates * AMBULO__LANES);
  ground_divide(plan, ground, w, first, scratch);
  for (int k = 0; k < plan->vanishing; k++) store(out + plan->roots[k].column, (wide){0});
  local_relief(plan, 0, w, keep, out, scratch);
  local_relief(plan, 1, load_pair(at + ground_foot), keep, out, scratch);
  local_relief(plan, 2, load_pair(at + ground_foot + 2 * three), keep, out, scratch);
  ground_rows(plan, ground, out, scratch);
}

/* V: virtual motion about the world origin by the weights on tau of the joints of a path. */
AMBULO__INLINE wide_pair virtual_of_path(const ambulo__plan *plan, int path, const double *weights,
                                         wide_pair sum, const double *scratch) {
  const ambulo__local_plan *local = &plan->local;
  for (int i = local->carrier_first[path]; i < local->carrier_first[path + 1]; i++) {
    const ambulo__local_step *step = &local->steps[local->carrier[i]];
    const double *at = scratch + step->at;
    wide3 z = load3(at + local_axis);
    wide y = load(weights + step->input);
    if (step->joint >= AMBULO__SLIDES) {
      sum.linear = axpy3(sum.linear, y, z);
    } else {
      z = scale3(step->sign * y, z);
      sum.angular = add3(sum.angular, z);
      sum.linear = add_cross3(sum.linear, load3(at + local_origin), z);
    }
  }
  return sum;
}

/* Adds M' and F' to *root, the weights on the root wrench. */
static local_pulls local_ground_adjoints(const ambulo__plan *plan, const double *ground,
                                         const double *weights, wide_pair *root,
                                         const double *scratch) {
  const wide_pair zero = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  const double *at = scratch + plan->ground_at + ground_foot;
  wide_pair both = virtual_of_path(plan, 0, weights, zero, scratch);
  const wide_pair foot[2] = {virtual_of_path(plan, 1, weights, both, scratch),
                             virtual_of_path(plan, 2, weights, both, scratch)};
  local_pulls pulls;
  pulls.center = ground_adjoints(plan, ground, weights, foot, root, scratch);
  pulls.center = scale3(spread(1 / plan->mass), pulls.center);
  for (int f = 0; f < 2; f++) {
    wide_pair e = axpy_pair(foot[f], spread(1), *root), w = load_pair(at + 2 * f * three);
    pulls.feet[f].angular = add_cross3(cross3(w.angular, e.angular), w.linear, e.linear);
    pulls.feet[f].linear = cross3(w.linear, e.angular);
  }
  return pulls;
}

#endif
