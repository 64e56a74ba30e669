/* mechanics/kernel_local_points.h - positions of points in world axes, and the gradient of their
 * weighted sum, for the kernels that work in the frames' own axes.
 *
 * Only frames down to a point are placed: R = (x, y, z) the columns of a frame's orientation, o its
 * origin. A revolute joint mixes two columns; o += R r with the constant offset r, o += z q if
 * prismatic; a point at r stands at o + R r.
 *
 * A weight pi acts like a force at its point. With P the sum of pi and M that of p x pi over the
 * points beyond a joint with axis z through o,
 *   q' += z . (M - o x P)  or  z . P.
 * The points of one frame add  sum p x pi = o x P + x x A_x + y x A_y + z x A_z,
 * A_i = sum r_i pi.
 */
#ifndef AMBULO_MECHANICS_KERNEL_LOCAL_POINTS_H
#define AMBULO_MECHANICS_KERNEL_LOCAL_POINTS_H

#include "mechanics/kernel_local_forward.h"

typedef struct local_place {
  wide3 x, y, z, o;
} local_place;

AMBULO__INLINE wide3 place_of(const local_place *p, wide3 o, const double r[3]) {
  return axpy3(axpy3(axpy3(o, spread(r[0]), p->x), spread(r[1]), p->y), spread(r[2]), p->z);
}

AMBULO__INLINE local_place place_load(const double *at) {
  return (local_place){load3(at + local_columns), load3(at + local_columns + three),
                       load3(at + local_columns + 2 * three), load3(at + local_origin)};
}

AMBULO__INLINE void places_of_points(const ambulo__steps *steps, int number, const local_place *p,
                                     double *out) {
  const ambulo__group_step *group = &steps->groups[number];
  for (int i = group->first; i < group->first + group->count; i++) {
    store3(out + steps->points[i].output, place_of(p, p->o, steps->points[i].position));
  }
}

AMBULO__INLINE void mix_columns(wide3 *u, wide3 *v, wide s, wide c) {
  wide3 from = *u;
  *u = axpy3(scale3(c, from), s, *v);
  *v = axpy3(scale3(c, *v), -s, from);
}

/* start + R r, r the offset of the origin */
AMBULO__INLINE wide3 add_offset(const ambulo__local_step *step, const local_place *p, wide3 start) {
  switch (step->offset) {
  case AMBULO__OFFSET_X:
    return axpy3(start, spread(step->length), p->x);
  case AMBULO__OFFSET_Y:
    return axpy3(start, spread(step->length), p->y);
  case AMBULO__OFFSET_Z:
    return axpy3(start, spread(step->length), p->z);
  case AMBULO__OFFSET_ANY:
    return place_of(p, start, step->move);
  default:
    return start;
  }
}

/* The constant turn before an oblique axis. */
AMBULO__INLINE local_place turned_place(const ambulo__local_step *step, const local_place *p) {
  const wide3 zero = {{0}, {0}, {0}};
  const double *t = step->turn, x[3] = {t[0], t[3], t[6]}, y[3] = {t[1], t[4], t[7]};
  const double z[3] = {t[2], t[5], t[8]};
  return (local_place){place_of(p, zero, x), place_of(p, zero, y), place_of(p, zero, z), p->o};
}

/* From the parent to where the joint turns or slides. */
AMBULO__INLINE local_place place_parent(const ambulo__local_step *step, local_place p,
                                        const local_place *world, const double *scratch) {
  if (!step->carried) p = step->from_world ? *world : place_load(scratch + step->above);
  p.o = add_offset(step, &p, p.o);
  return step->turned ? turned_place(step, &p) : p;
}

AMBULO__INLINE wide3 slide_axis(const ambulo__local_step *step, const local_place *p) {
  const wide3 zero = {{0}, {0}, {0}};
  switch (step->joint) {
  case AMBULO__SLIDES_X:
    return scale3(spread(step->sign), p->x);
  case AMBULO__SLIDES_Y:
    return scale3(spread(step->sign), p->y);
  case AMBULO__SLIDES_Z:
    return scale3(spread(step->sign), p->z);
  default:
    return place_of(p, zero, step->slide);
  }
}

/* Across a hinge; returns the column that is its axis. */
AMBULO__INLINE wide3 turn_columns(const ambulo__local_step *step, local_place *p, wide s, wide c) {
  switch (step->joint) {
  case AMBULO__TURNS_X:
    mix_columns(&p->y, &p->z, s, c);
    return p->x;
  case AMBULO__TURNS_Y:
    mix_columns(&p->z, &p->x, s, c);
    return p->y;
  default:
    mix_columns(&p->x, &p->y, s, c);
    return p->z;
  }
}

/* Across a joint; the axis and the origin are stored for the gradient. */
AMBULO__INLINE local_place place_joint(const ambulo__local_step *step, local_place p, int keep,
                                       double *scratch) {
  double *at = scratch + step->at;
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  wide3 axis;
  if (step->joint < AMBULO__SLIDES) {
    axis = turn_columns(step, &p, s, c);
  } else {
    axis = slide_axis(step, &p);
    p.o = axpy3(p.o, s, axis);
  }
  if (keep) store3(at + local_axis, axis);
  if (keep || step->placed) store3(at + local_origin, p.o);
  return p;
}

/* Mass times the position of the centre of mass, of the frame's body. */
AMBULO__INLINE wide3 first_moment_of(const ambulo__local_step *step, const local_place *p) {
  wide3 sum = scale3(spread(step->mass), p->o);
  switch (step->body) {
  case AMBULO__BODY_X:
    return axpy3(sum, spread(step->first_moment[0]), p->x);
  case AMBULO__BODY_Y:
    return axpy3(sum, spread(step->first_moment[1]), p->y);
  case AMBULO__BODY_Z:
    return axpy3(sum, spread(step->first_moment[2]), p->z);
  default:
    return place_of(p, sum, step->first_moment);
  }
}

/* Returns the first mass moment of the bodies that weigh. */
AMBULO__INLINE wide3 local_places(const ambulo__plan *plan, int keep, double *out,
                                  double *scratch) {
  const wide zero = {0}, one = spread(1);
  wide3 first = {zero, zero, zero};
  const local_place world = {
      {one, zero, zero}, {zero, one, zero}, {zero, zero, one}, {zero, zero, zero}};
  local_place p = world;
  if (plan->local.world_group >= 0) {
    places_of_points(&plan->steps, plan->local.world_group, &world, out);
  }
  const ambulo__local_step *step = plan->local.steps, *end = step + plan->coordinates;
  for (; step < end; step++) {
    if (!step->pointed) continue;
    if (!step->plain) p = place_parent(step, p, &world, scratch);
    p = place_joint(step, p, keep, scratch);
    if (!step->shown) continue;
    if (step->placed) {
      store3(scratch + step->at + local_columns, p.x);
      store3(scratch + step->at + local_columns + three, p.y);
      store3(scratch + step->at + local_columns + 2 * three, p.z);
    }
    if (step->group >= 0) places_of_points(&plan->steps, step->group, &p, out);
    if (step->weighs) {
      wide3 moment = first_moment_of(step, &p);
      if (keep && !step->placed) store3(scratch + step->at + local_first, moment);
      first = add3(first, moment);
    }
  }
  return first;
}

/* Adds M (angular) and P (linear) of a frame's points. */
static wide_pair weights_of_points(const ambulo__steps *steps, int number, wide_pair sum,
                                   const double *weights, const double *at) {
  const wide3 zero = {{0}, {0}, {0}};
  const ambulo__group_step *group = &steps->groups[number];
  local_place p = place_load(at), a = {zero, zero, zero, zero};
  for (int i = group->first; i < group->first + group->count; i++) {
    const double *r = steps->points[i].position;
    wide3 pi = load3(weights + steps->points[i].output);
    a.x = axpy3(a.x, spread(r[0]), pi);
    a.y = axpy3(a.y, spread(r[1]), pi);
    a.z = axpy3(a.z, spread(r[2]), pi);
    a.o = add3(a.o, pi);
  }
  sum.angular = add_cross3(add_cross3(sum.angular, p.x, a.x), p.y, a.y);
  sum.angular = add_cross3(add_cross3(sum.angular, p.z, a.z), p.o, a.o);
  sum.linear = add3(sum.linear, a.o);
  return sum;
}

/* What acts on the body like weights on points (kernel_local_ground.h). */
typedef struct local_pulls {
  wide3 center;      /* on the centre of mass, over the mass */
  wide_pair feet[2]; /* on the joints that carry a foot */
} local_pulls;

AMBULO__INLINE wide_pair add_pulls(const ambulo__local_step *step, wide_pair sum,
                                   const local_pulls *pulls, const double *at) {
  if (step->weighs) {
    local_place p = place_load(at);
    wide3 moment = step->placed ? first_moment_of(step, &p) : load3(at + local_first);
    sum.angular = add_cross3(sum.angular, moment, pulls->center);
    sum.linear = axpy3(sum.linear, spread(step->mass), pulls->center);
  }
  if (step->feet & 1) sum = axpy_pair(pulls->feet[0], spread(1), sum);
  if (step->feet & 2) sum = axpy_pair(pulls->feet[1], spread(1), sum);
  return sum;
}

/* All that acts on the frame and beyond it, M and P; sum: from the step after. */
AMBULO__INLINE wide_pair gathered_weights(const ambulo__plan *plan, const ambulo__local_step *step,
                                          wide_pair sum, const local_pulls *pulls,
                                          const double *weights, const double *scratch) {
  const wide_pair zero = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  const double *at = scratch + step->at;
  if (!step->carries_points) sum = zero;
  if (step->weighted) sum = add_pair(load_pair(at + local_weight), sum);
  if (step->group >= 0) sum = weights_of_points(&plan->steps, step->group, sum, weights, at);
  return add_pulls(step, sum, pulls, at);
}

/* The points' part of gq, which holds the rest already; pulls: read with ground reaction only. */
static void local_point_weights(const ambulo__plan *plan, const local_pulls *pulls,
                                const double *weights, double *gq, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  wide_pair sum = {zero, zero};
  wide3 moment = zero; /* M - o x P */
  const ambulo__local_step *first = plan->local.steps, *step = first + plan->coordinates;
  while (step-- > first) {
    const double *at = scratch + step->at;
    if (!step->pointed) continue;
    if (step->draws) sum = gathered_weights(plan, step, sum, pulls, weights, scratch);
    wide3 z = load3(at + local_axis);
    wide push;
    if (step->joint < AMBULO__SLIDES) {
      if (step->levers) moment = add_cross3(sum.angular, sum.linear, load3(at + local_origin));
      push = step->sign * dot3(z, moment);
    } else {
      push = dot3(z, sum.linear);
    }
    store(gq + step->input, load(gq + step->input) + push);
    if (step->carried || step->from_world) continue;
    double *above = scratch + step->above + local_weight;
    store_pair(above, step->first_weight ? sum : add_pair(load_pair(above), sum));
  }
}

#endif
