/* mechanics/kernel_world.h - motion and loads of the subtrees in world axes, where the Jacobians
 * are taken, one block of time nodes.
 *
 * Down the tree, with z the joint's axis, p the parent frame and r the constant offset between
 * the origins (in world axes), frame by frame:
 *   w     = w_p + z qd                                       angular velocity
 *   alpha = alpha_p + z qdd + w_p x z qd                     angular acceleration
 *   Omega r = alpha x r + w x (w x r)                        acceleration of a fixed r
 *   o     = o_p + r,      a = a_p + Omega_p r                origin (revolute)
 *   o     = o_p + z q,    a = a_p + Omega_p z q + 2 w_p x z qd + z qdd      (prismatic)
 * The world's a is -gravity, so that weight needs no term of its own. Then for every body, c the
 * vector from the origin to its centre of mass and I its inertia about it, in world axes:
 *   F = m (a + Omega c),  L = I w,  H = I alpha + w x L                     (15')
 * and up the tree the load of each subtree: moment N about the world origin, force F:
 *   N = sum (o + c) x F + H                                         (10) in world axes
 * The load of the whole tree is the root wrench. The velocities of the origins, v = v_p + w_p x r
 * or v_p + w_p x z q + z qd, and the composite inertias of the subtrees are those of
 * kernel_jacobian.h.
 */
#ifndef AMBULO_MECHANICS_KERNEL_WORLD_H
#define AMBULO_MECHANICS_KERNEL_WORLD_H

#include <math.h>

#include "mechanics/kernel_ground.h"
#include "mechanics/kernel_sincos.h"

/* The inertia of a subtree, by vectors. */
enum {
  composite_first = 0,
  composite_momentum = three,
  composite_inertia = 2 * three,
  composite_coriolis = 4 * three,
  composite_vectors = 7
};

static __attribute__((noinline)) void libm_angles(const ambulo__steps *steps, const double *q,
                                                  double *scratch) {
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__angle_step *step = &steps->angles[i];
    for (int lane = 0; lane < AMBULO__WIDTH; lane++) {
      double angle = step->sign * (q[step->input + lane] + step->shift);
      scratch[step->output + lane] = sin(angle);
      scratch[step->output + AMBULO__LANES + lane] = cos(angle);
    }
  }
}

/* Whether all angles are within the range of sincos_wide. The sum of the magnitudes is what is
 * compared to the limit: a NaN or an infinity shows, too. */
static int angles_inside(const ambulo__steps *steps, const double *q) {
  wide total = {0};
  for (int i = 0; i < steps->angle_count; i++) {
    total += magnitude(load(q + steps->angles[i].input) + steps->angles[i].shift);
  }
  int inside = 1;
  for (int lane = 0; lane < AMBULO__WIDTH; lane++) inside &= total[lane] <= AMBULO__SINCOS_LIMIT;
  return inside;
}

static void world_frame(const ambulo__plan *plan, double *scratch) {
  const ambulo__frame *world = &plan->frames[0];
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < 3; i++) {
    double *column = scratch + world->column_at[i];
    store3(column, zero);
    store(column + i * AMBULO__LANES, spread(1));
  }
  store3(scratch + world->rate_at, zero);
  store3(scratch + world->rate_at + three, zero);
  store3(scratch + world->place_at, zero);
  store3(scratch + world->velocity_at, zero);
  store3(scratch + world->place_at + three,
         (wide3){spread(-plan->gravity[0]), spread(-plan->gravity[1]), spread(-plan->gravity[2])});
}

AMBULO__INLINE void world_turn(const ambulo__turn_step *step, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = step->first; i < 3; i++) {
    const double column[3] = {step->turn[i], step->turn[3 + i], step->turn[6 + i]};
    store3(scratch + step->to[i], add_rotated(zero, scratch, step->from, column));
  }
}

/* Orientations and their rates; sines and cosines from the table that libm_angles has made, or
 * on the way. */
AMBULO__INLINE void world_hinges(const ambulo__steps *steps, const double *q, const double *qd,
                                 const double *qdd, int from_table, double *scratch) {
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__hinge_step *step = &steps->hinges[i];
    if (step->turn >= 0) world_turn(&steps->turns[step->turn], scratch);
    wide s, c;
    if (from_table) {
      s = load(scratch + step->angle);
      c = load(scratch + step->angle + AMBULO__LANES);
    } else {
      sincos_wide(step->sign * (load(q + step->input) + step->shift), &s, &c);
    }
    wide3 u = load3(scratch + step->from[0]), v = load3(scratch + step->from[1]);
    store3(scratch + step->to[0], axpy3(scale3(c, u), s, v));
    store3(scratch + step->to[1], (wide3){c * v.x - s * u.x, c * v.y - s * u.y, c * v.z - s * u.z});
    wide3 z = load3(scratch + step->axis), w = load3(scratch + step->rate_from);
    wide3 turn = scale3(step->sign * load(qd + step->input), z);
    wide3 gain = add_cross3(scale3(step->sign * load(qdd + step->input), z), w, turn);
    store3(scratch + step->rate_to, add3(w, turn));
    store3(scratch + step->rate_to + three, add3(load3(scratch + step->rate_from + three), gain));
  }
  for (int i = steps->late_turn; i < steps->turn_count; i++) {
    world_turn(&steps->turns[i], scratch);
  }
}

/* A vector that turns with a frame: its velocity and acceleration, w x r and alpha x r + w x w x r.
 */
AMBULO__INLINE wide_pair swept(const double *rate, wide3 r) {
  wide3 w = load3(rate), velocity = cross3(w, r);
  return (wide_pair){velocity, add_cross3(cross3(load3(rate + three), r), w, velocity)};
}

/* Origins that move, their accelerations and velocities. What comes from the parent is added last:
 * the next step waits for it. */
static void world_origins(const ambulo__steps *steps, const double *q, const double *qd,
                          const double *qdd, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < steps->origin_count; i++) {
    const ambulo__origin_step *step = &steps->origins[i];
    wide3 r = add_rotated(zero, scratch, step->columns, step->offset), gain = zero, v = zero;
    if (step->prismatic) {
      wide3 z = load3(scratch + step->axis);
      r = axpy3(r, step->sign * load(q + step->input), z);
      v = scale3(step->sign * load(qd + step->input), z);
      gain = scale3(step->sign * load(qdd + step->input), z);
      if (!step->still) {
        wide3 twice = scale3(2 * step->sign * load(qd + step->input), z);
        gain = add_cross3(gain, load3(scratch + step->rate), twice);
      }
    }
    if (!step->still) {
      wide_pair turn = swept(scratch + step->rate, r);
      v = add3(v, turn.angular);
      gain = add3(gain, turn.linear);
    }
    store3(scratch + step->velocity_to, add3(load3(scratch + step->velocity_from), v));
    store3(scratch + step->place_to, add3(load3(scratch + step->place_from), r));
    wide3 a = load3(scratch + step->place_from + three);
    store3(scratch + step->place_to + three, add3(a, gain));
  }
}

/* base 1 + first u u^T + second w w^T, see plan_mass.c. */
AMBULO__INLINE wide6 body_inertia(const ambulo__body *body, const double *scratch) {
  wide3 x = load3(scratch + body->ordered[0]), y = load3(scratch + body->ordered[1]);
  if (!body->diagonal) {
    wide3 z = load3(scratch + body->ordered[2]);
    x = axpy3(axpy3(x, spread(body->lower[0]), y), spread(body->lower[1]), z);
    y = axpy3(y, spread(body->lower[2]), z);
  }
  wide3 u = scale3(spread(body->first), x), w = scale3(spread(body->second), y);
  return (wide6){body->base + u.x * x.x + w.x * y.x,
                 body->base + u.y * x.y + w.y * y.y,
                 body->base + u.z * x.z + w.z * y.z,
                 u.x * x.y + w.x * y.y,
                 u.x * x.z + w.x * y.z,
                 u.y * x.z + w.y * y.z};
}

/* h, P, I and E of a body at x with the velocity v. */
AMBULO__INLINE void body_composite(const ambulo__body *body, wide3 x, wide3 v, wide3 w, wide6 j,
                                   double *out) {
  wide3 h = scale3(spread(body->mass), x);
  wide square = dot3(h, x), trace = dot3(v, h), half = 0.5 * (j.xx + j.yy + j.zz);
  wide6 inertia = {j.xx + square - h.x * x.x, j.yy + square - h.y * x.y, j.zz + square - h.z * x.z,
                   j.xy - h.x * x.y,          j.xz - h.x * x.z,          j.yz - h.y * x.z};
  /* columns of [w x] (half - J), which has no trace; E = (v.h) 1 - v h^T - [w x] (...) */
  wide3 k1 = cross3(w, (wide3){half - j.xx, -j.xy, -j.xz});
  wide3 k2 = cross3(w, (wide3){-j.xy, half - j.yy, -j.yz});
  wide3 k3 = cross3(w, (wide3){-j.xz, -j.yz, half - j.zz});
  wide33 coriolis = {{trace - v.x * h.x - k1.x, -v.x * h.y - k2.x, -v.x * h.z - k3.x},
                     {-v.y * h.x - k1.y, trace - v.y * h.y - k2.y, -v.y * h.z - k3.y},
                     {-v.z * h.x - k1.z, -v.z * h.y - k2.z, trace - v.z * h.z - k3.z}};
  store3(out + composite_first, h);
  store3(out + composite_momentum, scale3(spread(body->mass), v));
  store6(out + composite_inertia, inertia);
  store33(out + composite_coriolis, coriolis);
}

/* Force and moment that move each body, the first part of its frame's load, and its inertia. */
static void world_bodies(const ambulo__plan *plan, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < plan->bodies; i++) {
    const ambulo__body *body = &plan->body[i];
    const double *place = scratch + body->place;
    wide3 w = load3(scratch + body->rate), alpha = load3(scratch + body->rate + three);
    wide3 c = add_rotated(zero, scratch, body->columns, body->com), x = add3(load3(place), c);
    wide_pair turn = swept(scratch + body->rate, c);
    wide3 v = add3(load3(scratch + body->velocity), turn.angular);
    wide3 force = scale3(spread(body->mass), add3(load3(place + three), turn.linear));
    wide6 inertia = body_inertia(body, scratch);
    wide3 rate = add_cross3(multiply6(inertia, alpha), w, multiply6(inertia, w));
    store3(scratch + body->load, add_cross3(rate, x, force));
    store3(scratch + body->load + three, force);
    body_composite(body, x, v, w, inertia, scratch + body->composite);
  }
}

AMBULO__INLINE void zero_vectors(double *at, int count) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int n = 0; n < count; n++) store3(at + n * three, zero);
}

/* `count` vectors of each subtree, added to its parent's. A sum that the next step goes on with
 * stays in registers: memory would make it wait. */
AMBULO__INLINE void sum_up(const ambulo__add_step *steps, int step_count, int count,
                           double *scratch) {
  wide3 sum[composite_vectors] = {{{0}, {0}, {0}}};
  for (int i = 0; i < step_count; i++) {
    double *to = scratch + steps[i].to;
    const double *from = scratch + steps[i].from;
    if (!steps[i].carried) {
      for (int n = 0; n < count; n++) sum[n] = load3(from + n * three);
    }
    for (int n = 0; n < count; n++) {
      sum[n] = add3(load3(to + n * three), sum[n]);
      store3(to + n * three, sum[n]);
    }
  }
}

static void world_sums(const ambulo__plan *plan, double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  double *root = scratch + plan->frames[0].load_at;
  for (int i = 0; i < 6; i++) store(root + i * AMBULO__LANES, spread(plan->fixed_load[i]));
  for (int i = 0; i < steps->zero_load_count; i++) zero_vectors(scratch + steps->zero_loads[i], 2);
  for (int i = 0; i < steps->zero_composite_count; i++) {
    zero_vectors(scratch + steps->zero_composites[i], composite_vectors);
  }
  sum_up(steps->loads, steps->load_count, 2, scratch);
  sum_up(steps->composites, steps->composite_count, composite_vectors, scratch);
}

/* Positions of the points, to their rows or, packed, one after the other in
 * order of groups. */
AMBULO__INLINE void world_positions(const ambulo__steps *steps, double *out, int packed,
                                    const double *scratch) {
  for (int g = 0; g < steps->group_count; g++) {
    const ambulo__group_step *group = &steps->groups[g];
    wide3 o = load3(scratch + group->place), x = load3(scratch + group->columns[0]);
    wide3 y = load3(scratch + group->columns[1]), z = load3(scratch + group->columns[2]);
    for (int i = group->first; i < group->first + group->count; i++) {
      const ambulo__point_step *point = &steps->points[i];
      const double *r = point->position;
      wide3 p = axpy3(axpy3(axpy3(o, spread(r[0]), x), spread(r[1]), y), spread(r[2]), z);
      store3(out + (packed ? i * three : point->output), p);
    }
  }
}

/* Motion of the frames, the loads and composite inertias of their subtrees. */
static void world_part(const ambulo__plan *plan, const double *q, const double *qd,
                       const double *qdd, const double *ground, double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  world_frame(plan, scratch);
  if (angles_inside(steps, q)) {
    world_hinges(steps, q, qd, qdd, 0, scratch);
  } else {
    libm_angles(steps, q, scratch);
    world_hinges(steps, q, qd, qdd, 1, scratch);
  }
  world_origins(steps, q, qd, qdd, scratch);
  world_bodies(plan, scratch);
  world_sums(plan, scratch);
  if (plan->grounded) ground_split(plan, ground, scratch);
}

#endif
