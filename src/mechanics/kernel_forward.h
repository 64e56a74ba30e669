/* mechanics/kernel_forward.h - inverse dynamics in world axes, one block of time nodes.
 *
 * Down the tree, with z the joint's axis, p the parent frame and r the constant offset between
 * the origins (in world axes), frame by frame:
 *   w     = w_p + z qd                                       angular velocity
 *   alpha = alpha_p + z qdd + w_p x z qd                     angular acceleration
 *   Omega = [alpha x] + w w^T - (w.w) 1                      so that rdd = Omega r for fixed r
 *   o     = o_p + r,      a = a_p + Omega_p r                origin (revolute)
 *   o     = o_p + z q,    a = a_p + Omega_p z q + 2 w_p x z qd + z qdd      (prismatic)
 * The world's a is -gravity, so that weight needs no term of its own. Then for every body, c the
 * vector from the origin to its centre of mass and I its inertia about it, in world axes:
 *   F = m (a + Omega c),  L = I w,  H = I alpha + w x L                     (15')
 * and up the tree the load of each subtree: moment N about the world origin, force F:
 *   N = sum (o + c) x F + H,   tau = z . (N - o x F)  or  z . F             (10) in world axes
 * The load of the whole tree is the root wrench.
 */
#ifndef AMBULO_MECHANICS_KERNEL_FORWARD_H
#define AMBULO_MECHANICS_KERNEL_FORWARD_H

#include <math.h>

#include "mechanics/kernel_ground.h"
#include "mechanics/kernel_sincos.h"

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

static void forward_world(const ambulo__plan *plan, double *scratch) {
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
  store3(scratch + world->place_at + three,
         (wide3){spread(-plan->gravity[0]), spread(-plan->gravity[1]), spread(-plan->gravity[2])});
  if (world->spin_at >= 0) store33(scratch + world->spin_at, (wide33){zero, zero, zero});
}

AMBULO__INLINE void forward_turn(const ambulo__turn_step *step, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = step->first; i < 3; i++) {
    const double column[3] = {step->turn[i], step->turn[3 + i], step->turn[6 + i]};
    store3(scratch + step->to[i], add_rotated(zero, scratch, step->from, column));
  }
}

/* Orientations and their rates; sines and cosines from the table that libm_angles has made, or
 * on the way. */
AMBULO__INLINE void forward_hinges(const ambulo__steps *steps, const double *q, const double *qd,
                                   const double *qdd, int from_table, double *scratch) {
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__hinge_step *step = &steps->hinges[i];
    if (step->turn >= 0) forward_turn(&steps->turns[step->turn], scratch);
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
    forward_turn(&steps->turns[i], scratch);
  }
}

static void forward_spins(const ambulo__steps *steps, double *scratch) {
  for (int i = 0; i < steps->spin_count; i++) {
    const ambulo__spin_step *step = &steps->spins[i];
    wide3 w = load3(scratch + step->rate), alpha = load3(scratch + step->rate + three);
    wide xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
    wide xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
    wide33 spin = {{-(yy + zz), xy - alpha.z, xz + alpha.y},
                   {xy + alpha.z, -(xx + zz), yz - alpha.x},
                   {xz - alpha.y, yz + alpha.x, -(xx + yy)}};
    store33(scratch + step->spin, spin);
  }
}

/* Origins that move, and their accelerations. What comes from the parent is added last: the next
 * step waits for it. */
static void forward_origins(const ambulo__steps *steps, const double *q, const double *qd,
                            const double *qdd, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < steps->origin_count; i++) {
    const ambulo__origin_step *step = &steps->origins[i];
    wide3 r = add_rotated(zero, scratch, step->columns, step->offset), gain = zero;
    if (step->prismatic) {
      wide3 z = load3(scratch + step->axis);
      r = axpy3(r, step->sign * load(q + step->input), z);
      gain = scale3(step->sign * load(qdd + step->input), z);
      if (!step->still) {
        wide3 twice = scale3(2 * step->sign * load(qd + step->input), z);
        gain = add_cross3(gain, load3(scratch + step->rate), twice);
      }
    }
    if (!step->still) gain = add_multiply33(gain, load33(scratch + step->spin), r);
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

/* Force and moment that move each body; the first part of its frame's load. */
static void forward_bodies(const ambulo__plan *plan, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < plan->bodies; i++) {
    const ambulo__body *body = &plan->body[i];
    double *at = scratch + body->at;
    const double *place = scratch + body->place;
    wide3 w = load3(scratch + body->rate), alpha = load3(scratch + body->rate + three);
    wide3 c = add_rotated(zero, scratch, body->columns, body->com);
    wide3 force = add_multiply33(load3(place + three), load33(scratch + body->spin), c);
    force = scale3(spread(body->mass), force);
    wide6 inertia = body_inertia(body, scratch);
    wide3 momentum = multiply6(inertia, w);
    wide3 rate = add_cross3(multiply6(inertia, alpha), w, momentum);
    store3(at, c);
    store3(at + three, force);
    store3(at + 2 * three, rate);
    store3(at + 3 * three, momentum);
    store6(at + 4 * three, inertia);
    store3(scratch + body->load, add_cross3(rate, add3(load3(place), c), force));
    store3(scratch + body->load + three, force);
  }
}

/* Two vectors of each subtree, `first` doubles into its place, added to the
 * parent's. A sum that the next step goes on with stays in registers: memory
 * would make it wait. */
AMBULO__INLINE void sum_up(const ambulo__add_step *steps, int count, int first, double *scratch) {
  wide3 a = {{0}, {0}, {0}}, b = a;
  scratch += first;
  for (int i = 0; i < count; i++) {
    double *to = scratch + steps[i].to;
    const double *from = scratch + steps[i].from;
    wide3 above_a = load3(to), above_b = load3(to + three);
    if (!steps[i].carried) {
      a = load3(from);
      b = load3(from + three);
    }
    a = add3(above_a, a);
    b = add3(above_b, b);
    store3(to, a);
    store3(to + three, b);
  }
}

/* Loads up the tree. */
static void forward_loads(const ambulo__plan *plan, double *scratch) {
  double *root = scratch + plan->frames[0].load_at;
  for (int i = 0; i < 6; i++) store(root + i * AMBULO__LANES, spread(plan->fixed_load[i]));
  sum_up(plan->steps.loads, plan->steps.load_count, 0, scratch);
}

/* The forces at the joints, and the root wrench. */
static void forward_forces(const ambulo__plan *plan, double *out, double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  const double *root = scratch + plan->frames[0].load_at;
  for (int i = 0; i < steps->moment_count; i++) {
    const ambulo__moment_step *step = &steps->moments[i];
    wide3 o = load3(scratch + step->place), force = load3(scratch + step->load + three);
    store3(scratch + step->moment, add_cross3(load3(scratch + step->load), force, o));
  }
  for (int i = 0; i < plan->coordinates; i++) {
    const ambulo__push_step *step = &steps->pushes[i];
    wide work = dot3(load3(scratch + step->axis), load3(scratch + step->push));
    store(out + step->output, step->sign * work);
  }
  out += plan->coordinates * AMBULO__LANES;
  store3(out, load3(root));
  store3(out + three, load3(root + three));
}

/* Positions of the points, to their rows or, packed, one after the other in
 * order of groups. */
AMBULO__INLINE void forward_positions(const ambulo__steps *steps, double *out, int packed,
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

/* Motion of the frames, and the loads of their subtrees. */
static void forward_world_part(const ambulo__plan *plan, const double *q, const double *qd,
                               const double *qdd, const double *ground, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  const ambulo__steps *steps = &plan->steps;
  forward_world(plan, scratch);
  if (angles_inside(steps, q)) {
    forward_hinges(steps, q, qd, qdd, 0, scratch);
  } else {
    libm_angles(steps, q, scratch);
    forward_hinges(steps, q, qd, qdd, 1, scratch);
  }
  forward_spins(steps, scratch);
  forward_origins(steps, q, qd, qdd, scratch);
  for (int i = 0; i < steps->zero_load_count; i++) {
    store3(scratch + steps->zero_loads[i], zero);
    store3(scratch + steps->zero_loads[i] + three, zero);
  }
  forward_bodies(plan, scratch);
  if (plan->grounded) ground_split(plan, ground, scratch);
  forward_loads(plan, scratch);
}

static void forward_part(const ambulo__plan *plan, const double *q, const double *qd,
                         const double *qdd, const double *ground, double *out, double *scratch) {
  forward_world_part(plan, q, qd, qdd, ground, scratch);
  forward_forces(plan, out, scratch);
  if (plan->grounded) ground_rows(plan, ground, out, scratch);
  forward_positions(&plan->steps, out, 0, scratch);
}

#endif
