/* mechanics/kernel_local_points.h - positions of points in world axes, and the gradient of their
 * weighted sum, for the kernels that work in the frames' own axes.
 *
 * Only frames down to a point are placed, with ground reaction to a body, too: R = (x, y, z) the
 * columns of a frame's orientation, o its origin. A revolute joint mixes two columns; o += R r with
 * the constant offset r, o += z q if prismatic; a point at r stands at o + R r.
 *
 * A weight pi acts like a force at its point. With P the sum of pi and M that of p x pi over the
 * points beyond a joint with axis z through o,
 *   q' += z . (M - o x P)  or  z . P.
 * The points of one frame add  sum p x pi = o x P + x x A_x + y x A_y + z x A_z,
 * A_i = sum r_i pi.
 *
 * The first mass moment of all bodies, sum m_i (o_i + R_i c_i): as long as the origin of a child is
 * fixed in its parent, at r_j, the masses beyond it can stand there,
 *   b_i = m_i c_i + sum over the children j that turn of (mass of j and beyond) r_j
 * is constant in frame i (the barycentric vectors of Wittenburg 1977), and the moment is the sum of
 * all R_i b_i. The mass m beyond a slider, as far as the next sliders, adds m o with the slider's
 * origin; to its parent's b it does not count. A weight G on the moment acts like a couple R_i b_i
 * x G on each frame, and like m G at o.
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

/* Across a joint. */
AMBULO__INLINE local_place place_joint(const ambulo__local_step *step, local_place p, int shows,
                                       double *at) {
  wide s = load(at + local_angle), c = load(at + local_angle + AMBULO__LANES);
  if (step->joint < AMBULO__SLIDES) {
    turn_columns(step, &p, s, c);
  } else {
    wide3 axis = slide_axis(step, &p);
    p.o = axpy3(p.o, s, axis);
    if (shows & ambulo__shows_axis) store3(at + local_axis, axis);
  }
  return p;
}

AMBULO__INLINE void show_place(int shows, const local_place *p, double *at) {
  if (shows & ambulo__shows_x) store3(at + local_columns, p->x);
  if (shows & ambulo__shows_y) store3(at + local_columns + three, p->y);
  if (shows & ambulo__shows_z) store3(at + local_columns + 2 * three, p->z);
  if (shows & ambulo__shows_origin) store3(at + local_origin, p->o);
}

/* (W.C): sum + R b */
AMBULO__INLINE wide3 add_barycentric(const ambulo__local_step *step, const local_place *p,
                                     wide3 sum) {
  if (step->weighs & 1) sum = axpy3(sum, spread(step->moment[0]), p->x);
  if (step->weighs & 2) sum = axpy3(sum, spread(step->moment[1]), p->y);
  if (step->weighs & 4) sum = axpy3(sum, spread(step->moment[2]), p->z);
  return sum;
}

/* Over all bodies: first mass moment, and their loads about the world origin. */
typedef struct local_sums {
  wide3 first;
  wide_pair load;
} local_sums;

/* Adds the load of a frame's body, n + o x f and f in world axes. */
AMBULO__INLINE wide_pair add_load(wide_pair sum, const local_place *p, const double *load_at) {
  wide3 n = load3(load_at), f = load3(load_at + three);
  f = axpy3(axpy3(scale3(f.x, p->x), f.y, p->y), f.z, p->z);
  sum.angular = axpy3(axpy3(axpy3(sum.angular, n.x, p->x), n.y, p->y), n.z, p->z);
  return (wide_pair){add_cross3(sum.angular, p->o, f), add3(sum.linear, f)};
}

/* Places what is read of the frames. Returns sums with ground reaction only; `grounded` and `keep`
 * are known when this is compiled. */
AMBULO__INLINE local_sums local_places(const ambulo__plan *plan, int keep, int grounded,
                                       double *out, double *scratch) {
  const wide zero = {0}, one = spread(1);
  local_sums sums = {spread3(plan->local.fixed_moment), {{zero, zero, zero}, {zero, zero, zero}}};
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
    double *at = scratch + step->at;
    int shows = keep ? step->keeps : step->shows;
    p = place_joint(step, p, shows, at);
    if (shows & ambulo__shows_place) show_place(shows, &p, at);
    if (shows & ambulo__shows_points) places_of_points(&plan->steps, step->group, &p, out);
    if (!grounded) continue;
    if (shows & ambulo__shows_body) sums.load = add_load(sums.load, &p, at + local_load);
    if (shows & ambulo__shows_mass) {
      sums.first = add_barycentric(step, &p, sums.first);
      if (step->weighs & 8) sums.first = axpy3(sums.first, spread(step->anchored), p.o);
    }
  }
  return sums;
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

/* What acts on the body like weights on points (kernel_local_contacts.h). */
typedef struct local_pulls {
  wide3 center;                              /* on the centre of mass, over the mass: G */
  wide_pair floating;                        /* on the joints that carry the whole body */
  wide_pair contacts[AMBULO__MOST_CONTACTS]; /* on the joints that carry a contact */
} local_pulls;

/* R b, from what local_places has stored. */
AMBULO__INLINE wide3 stored_barycentric(const ambulo__local_step *step, const double *at) {
  wide3 sum = {{0}, {0}, {0}};
  for (int k = 0; k < 3; k++) {
    if (!(step->weighs >> k & 1)) continue;
    sum = axpy3(sum, spread(step->moment[k]), load3(at + local_columns + k * three));
  }
  return sum;
}

AMBULO__INLINE wide_pair add_pulls(const ambulo__local_step *step, wide_pair sum,
                                   const local_pulls *pulls, const double *at) {
  wide3 g = pulls->center;
  if (step->weighs & 7) sum.angular = add_cross3(sum.angular, stored_barycentric(step, at), g);
  if (step->weighs & 8) {
    wide3 push = scale3(spread(step->anchored), g);
    if (!step->still) sum.angular = add_cross3(sum.angular, load3(at + local_origin), push);
    sum.linear = add3(sum.linear, push);
  }
  if (step->floats) sum = add_pair(pulls->floating, sum);
  for (int f = 0; step->contacts >> f; f++) {
    if (step->contacts >> f & 1) sum = add_pair(pulls->contacts[f], sum);
  }
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
  return pulls ? add_pulls(step, sum, pulls, at) : sum;
}

/* (V): The points' part of gq, which holds the rest already; pulls: NULL without ground reaction.
 */
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
    wide push;
    if (step->joint < AMBULO__SLIDES) {
      if (step->levers) moment = add_cross3(sum.angular, sum.linear, load3(at + local_origin));
      push = step->sign * dot3(load3(at + local_columns + step->joint * three), moment);
    } else {
      push = dot3(load3(at + local_axis), sum.linear);
    }
    store(gq + step->input, load(gq + step->input) + push);
    if (step->carried || step->from_world) continue;
    double *above = scratch + step->above + local_weight;
    store_pair(above, step->first_weight ? sum : add_pair(load_pair(above), sum));
  }
}

#endif
