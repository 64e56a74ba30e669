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

static __attribute__((noinline)) void libm_angles(const ambulo__plan *plan, const double *q,
                                                  double *scratch) {
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    double *out = scratch + plan->angle_at + 2 * k * AMBULO__LANES;
    for (int lane = 0; joint->revolute && lane < AMBULO__WIDTH; lane++) {
      double angle = joint->sign * (q[k * AMBULO__LANES + lane] + joint->shift);
      out[lane] = sin(angle);
      out[AMBULO__LANES + lane] = cos(angle);
    }
  }
}

static void forward_angles(const ambulo__plan *plan, const double *q, double *scratch) {
  wide_bits outside = {0};
  double *out = scratch + plan->angle_at;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (!joint->revolute) continue;
    wide sine, cosine, angle = joint->sign * (load(q + k * AMBULO__LANES) + joint->shift);
    outside |= out_of_range(angle);
    sincos_wide(angle, &sine, &cosine);
    store(out + 2 * k * AMBULO__LANES, sine);
    store(out + (2 * k + 1) * AMBULO__LANES, cosine);
  }
  int64_t any = 0;
  for (int lane = 0; lane < AMBULO__WIDTH; lane++) any |= outside[lane];
  if (any) libm_angles(plan, q, scratch);
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

AMBULO__INLINE void forward_turn(const ambulo__joint *joint, const int columns[3],
                                 double *scratch) {
  for (int i = joint->revolute ? 0 : 2; i < 3; i++) {
    const double column[3] = {joint->turn[i], joint->turn[3 + i], joint->turn[6 + i]};
    wide3 sum = {{0}, {0}, {0}};
    store3(scratch + joint->turn_at[i], add_rotated(sum, scratch, columns, column));
  }
}

/* New origin and its acceleration. */
AMBULO__INLINE void forward_origin(const ambulo__plan *plan, int k, const double *q,
                                   const double *qd, const double *qdd, double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *parent = &plan->frames[joint->parent];
  double *place = scratch + plan->frames[k + 1].place_at;
  wide3 o = load3(scratch + parent->place_at), a = load3(scratch + parent->place_at + three);
  wide3 r = {{0}, {0}, {0}};
  if (joint->revolute) {
    r = add_rotated(r, scratch, parent->column_at, joint->offset);
  } else {
    wide3 z = load3(scratch + joint->axis_at);
    wide rate = joint->sign * load(qd + k * AMBULO__LANES);
    r = scale3(joint->sign * load(q + k * AMBULO__LANES), z);
    a = axpy3(a, joint->sign * load(qdd + k * AMBULO__LANES), z);
    if (!joint->still) a = add_cross3(a, load3(scratch + parent->rate_at), scale3(2 * rate, z));
  }
  if (!joint->still) a = add_multiply33(a, load33(scratch + parent->spin_at), r);
  store3(place, add3(o, r));
  store3(place + three, a);
}

AMBULO__INLINE wide33 spin_of(wide3 w, wide3 alpha) {
  wide xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  wide xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return (wide33){{-(yy + zz), xy - alpha.z, xz + alpha.y},
                  {xy + alpha.z, -(xx + zz), yz - alpha.x},
                  {xz - alpha.y, yz + alpha.x, -(xx + yy)}};
}

/* New orientation and its rates. */
AMBULO__INLINE void forward_rotation(const ambulo__plan *plan, int k, const double *qd,
                                     const double *qdd, double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const double *rate_p = scratch + plan->frames[joint->parent].rate_at;
  double *rate = scratch + plan->frames[k + 1].rate_at;
  const double *angle = scratch + plan->angle_at + 2 * k * AMBULO__LANES;
  wide s = load(angle), c = load(angle + AMBULO__LANES);
  wide3 u = load3(scratch + joint->from_at[0]), v = load3(scratch + joint->from_at[1]);
  store3(scratch + joint->to_at[0], axpy3(scale3(c, u), s, v));
  store3(scratch + joint->to_at[1], axpy3(scale3(c, v), -s, u));
  wide3 z = load3(scratch + joint->axis_at), w_p = load3(rate_p);
  wide3 step = scale3(joint->sign * load(qd + k * AMBULO__LANES), z);
  wide3 alpha = axpy3(load3(rate_p + three), joint->sign * load(qdd + k * AMBULO__LANES), z);
  wide3 w = add3(w_p, step);
  alpha = add_cross3(alpha, w_p, step);
  store3(rate, w);
  store3(rate + three, alpha);
  if (joint->new_spin) store33(scratch + plan->frames[k + 1].spin_at, spin_of(w, alpha));
}

/* base 1 + first u u^T + second w w^T, see plan_mass.c. */
AMBULO__INLINE wide6 body_inertia(const ambulo__body *body, const ambulo__frame *frame,
                                  const double *scratch) {
  wide3 x = load3(scratch + frame->column_at[body->order[0]]);
  wide3 y = load3(scratch + frame->column_at[body->order[1]]);
  if (!body->diagonal) {
    wide3 z = load3(scratch + frame->column_at[body->order[2]]);
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

/* Force and moment that move the body; the first part of its frame's load. */
AMBULO__INLINE void forward_body(const ambulo__body *body, const ambulo__frame *frame,
                                 double *scratch) {
  double *at = scratch + body->at, *total = scratch + frame->load_at;
  const double *place = scratch + frame->place_at;
  wide3 w = load3(scratch + frame->rate_at), alpha = load3(scratch + frame->rate_at + three);
  wide3 c = {{0}, {0}, {0}};
  c = add_rotated(c, scratch, frame->column_at, body->com);
  wide3 force = add_multiply33(load3(place + three), load33(scratch + frame->spin_at), c);
  force = scale3(spread(body->mass), force);
  wide6 inertia = body_inertia(body, frame, scratch);
  wide3 momentum = multiply6(inertia, w);
  wide3 rate = add_cross3(multiply6(inertia, alpha), w, momentum);
  store3(at, c);
  store3(at + three, force);
  store3(at + 2 * three, rate);
  store3(at + 3 * three, momentum);
  store6(at + 4 * three, inertia);
  store3(total, add_cross3(rate, add3(load3(place), c), force));
  store3(total + three, force);
}

/* Loads up the tree, and the forces at the joints. */
static void forward_loads(const ambulo__plan *plan, double *out, double *scratch) {
  double *root = scratch + plan->frames[0].load_at;
  for (int i = 0; i < 6; i++) store(root + i * AMBULO__LANES, spread(plan->fixed_load[i]));
  for (int i = plan->coordinates - 1; i >= 0; i--) {
    const int k = plan->order[i];
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1];
    const double *total = scratch + frame->load_at;
    wide3 z = load3(scratch + joint->axis_at), push = load3(total + three);
    if (joint->revolute) {
      double *moment = scratch + frame->moment_at;
      if (joint->new_moment) {
        wide3 o = load3(scratch + frame->place_at);
        store3(moment, add_cross3(load3(total), push, o));
      }
      push = load3(moment);
    }
    store(out + k * AMBULO__LANES, joint->sign * dot3(z, push));
    if (!joint->own_load) continue;
    double *above = scratch + plan->frames[joint->parent].load_at;
    add3_at(above, load3(total));
    add3_at(above + three, load3(total + three));
  }
  out += plan->coordinates * AMBULO__LANES;
  store3(out, load3(root));
  store3(out + three, load3(root + three));
}

static void forward_part(const ambulo__plan *plan, const double *q, const double *qd,
                         const double *qdd, const double *ground, double *out, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  forward_angles(plan, q, scratch);
  forward_world(plan, scratch);
  for (int i = 0; i < plan->coordinates; i++) {
    const int k = plan->order[i];
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1];
    if (joint->turned) forward_turn(joint, plan->frames[joint->parent].column_at, scratch);
    if (joint->own_origin) forward_origin(plan, k, q, qd, qdd, scratch);
    if (joint->revolute) forward_rotation(plan, k, qd, qdd, scratch);
    if (frame->body >= 0) forward_body(&plan->body[frame->body], frame, scratch);
    if (!frame->zero_load) continue;
    store3(scratch + frame->load_at, zero);
    store3(scratch + frame->load_at + three, zero);
  }
  if (plan->grounded) ground_split(plan, ground, scratch);
  forward_loads(plan, out, scratch);
  if (plan->grounded) ground_rows(plan, ground, out, scratch);
  out += (plan->coordinates + 6) * AMBULO__LANES;
  for (int i = 0; i < plan->points; i++) {
    const ambulo__plan_point *point = &plan->point[i];
    const ambulo__frame *frame = &plan->frames[point->frame];
    wide3 place = load3(scratch + frame->place_at);
    store3(out + i * three, add_rotated(place, scratch, frame->column_at, point->position));
  }
}

#endif
