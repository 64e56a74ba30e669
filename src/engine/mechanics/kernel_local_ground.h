/* mechanics/kernel_local_ground.h - the feet's wrenches in the frames' own axes.
 *
 * The loads of the subtrees, which tau is made of, need the feet's wrenches, and these the root
 * wrench. With ground reaction all limbs are gone down first; then the frames are placed
 * (kernel_local_points.h), and the bodies' loads summed up in world axes to the root wrench, which
 * is split between the feet (kernel_ground.h). A foot's wrench (M_f, F_f) is taken off the load of
 * its frame, at o with the columns R,
 *   n -= R^T (M_f - o x F_f),   f -= R^T F_f,
 * and the pass up the tree gives tau. It ends below the joints that carry the whole body: their
 * load and the ground's wrench cancel.
 *
 * Adjoints, with the weights y on tau of the joints that carry foot f: V_f = sum S_i y_i is the
 * virtual motion that they give it (world axes, about the world origin). ground_adjoints makes of
 * V_f the weights on the root wrench and on the centre of mass, through which W_f depends on the
 * motion. What is left is the turn of the joints' axes against a W_f that stands still. A step of
 * q_j turns each S_i below j, so that, with D_j the part of V_f from the joints below j,
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

/* (W.4): Takes the wrench w off the load of a foot's frame; bare: it has none yet. */
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

/* What the ground does to the loads of the bodies: root wrench, feet, and their rows. */
AMBULO__INLINE void local_ground(const ambulo__plan *plan, int keep, const double *ground,
                                 double *out, double *scratch) {
  const ambulo__local_plan *local = &plan->local;
  const local_sums sums = local_places(plan, keep, 1, out, scratch);
  wide_pair w = with_fixed_load(plan, sums.load);
  store_pair(out + plan->coordinates * AMBULO__LANES, w);
  const ground_split split = ground_split_of(plan, ground, w, sums.first);
  if (keep) ground_keep(plan, w, &split, scratch);
  ground_rows(plan, ground, &split, out);
  for (int f = 0; f < 2; f++) {
    if (local->foot[f] < 0) continue;
    const ambulo__local_step *step = &local->steps[local->foot[f]];
    take_off(step, local->bare[f], split.foot[f], scratch);
  }
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

/* V of each foot or contact. */
AMBULO__INLINE void virtual_of_feet(const ambulo__plan *plan, const double *weights, wide_pair *v,
                                    const double *scratch) {
  const wide_pair zero = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  const ambulo__local_plan *local = &plan->local;
  wide_pair along[AMBULO__MOST_PATHS];
  for (int i = 0; i < local->path_count; i++) {
    int above = local->path[i].above;
    along[i] = virtual_of_path(local, i, weights, above < 0 ? zero : along[above], scratch);
  }
  for (int f = 0; f < plan->feet; f++) {
    v[f] = local->foot_path[f] < 0 ? zero : along[local->foot_path[f]];
  }
}

/* Q(v) */
AMBULO__INLINE wide_pair turned_against(wide_pair w, wide_pair v) {
  return (wide_pair){add_cross3(cross3(w.angular, v.angular), w.linear, v.linear),
                     cross3(w.linear, v.angular)};
}

/* (V): Adds M' and F' to *root, the weights on the root wrench. */
static local_pulls local_ground_adjoints(const ambulo__plan *plan, const double *ground,
                                         const double *weights, wide_pair *root,
                                         const double *scratch) {
  const double *at = scratch + plan->ground_at + ground_foot;
  wide_pair foot[2];
  local_pulls pulls;
  virtual_of_feet(plan, weights, foot, scratch);
  pulls.center = ground_adjoints(plan, ground, weights, foot, root, scratch);
  pulls.center = scale3(spread(1 / plan->mass), pulls.center);
  for (int f = 0; f < 2; f++) {
    pulls.feet[f] = turned_against(load_pair(at + 2 * f * three), add_pair(foot[f], *root));
  }
  return pulls;
}

#endif
