/* mechanics/kernel_reverse.h - gradient of a weighted sum of the outputs, after the forward pass.
 *
 * Weights y on tau, (eta_0, u_0) on root moment and force, pi on points. By virtual work,
 *   sum y tau + eta_0 . M + u_0 . F = sum over bodies of  ubar . F_b + eta . H_b,
 * where (eta, u) is the virtual motion that the weights impose on the tree:
 *   eta = eta_p + z y,   u = u_p + eta_p x r (+ z y if prismatic),   ubar = u + eta x c.
 * So the adjoint of the pass up the tree is this pass down; and the adjoints of eta and u at a
 * frame are the subtree's moment t about the frame's origin and its force F, which the forward
 * pass left behind. With x' the adjoint of x, what remains is the adjoint of the pass down.
 *
 * With ground reaction (kernel_ground.h) the loads are those that the ground's wrenches leave, and
 * (eta_0, u_0) contains what reaches the tree through these wrenches. The wrench of a foot is held
 * about the world origin: o' += F_foot x eta at the foot's frame.
 *
 * Rotations: turning a frame by d turns each vector v fixed in it by d x v, so that instead of the
 * adjoints of nine direction cosines one vector  rho = sum v x v'  is carried. An expression of
 * vectors alone does not change if all of them turn together; hence the inertia gives
 * rho -= eta x eta' + alpha x alpha' + w x w'.
 *   body:      b = m ubar,  a' += b,  Omega' += b c^T,  c' = Omega^T b + F x eta,  rho += c x c'
 *              alpha' += I eta,  w' += L x eta + I (eta x w)
 *   Omega:     alpha' += axial(Omega' - Omega'^T),  w' += (Omega' + Omega'^T) w - 2 tr(Omega') w
 *   revolute:  from w' and alpha' of the frame,  g = w' + alpha' x w_p
 *              q' = z . rho,  qd' = z . g,  qdd' = z . alpha',  z' = g qd + alpha' qdd + t y
 *              rho_p = rho + z x z',  w_p' = w' + z x alpha' qd
 *   offset r:  r' = Omega_p^T a' + F x eta_p + o',  rho += r x r',  Omega_p' += a' r^T
 *   prismatic: r' as above with r = z q,  v = 2 a' x w
 *              q' = z . r',  qd' = z . v,  qdd' = z . a',  z' = r' q + v qd + a' qdd + F y
 *              rho_p = rho + z x z',  w' += 2 z x a' qd
 * kappa = w' - alpha' x w is the same on both sides of a revolute joint and is what is stored;
 * then g = kappa + alpha' x (w + w_p). Stored per chain: rho, kappa, alpha', o', a' (o' of points
 * alone).
 */
#ifndef AMBULO_MECHANICS_KERNEL_REVERSE_H
#define AMBULO_MECHANICS_KERNEL_REVERSE_H

#include "mechanics/kernel_forward.h"

enum {
  adjoint_rho = 0,
  adjoint_kappa = three,
  adjoint_alpha = 2 * three,
  adjoint_origin = 3 * three,
  adjoint_acceleration = 4 * three
};

/* First contributions to a frame's adjoints: those of its body. */
AMBULO__INLINE void reverse_body(const ambulo__plan *plan, int f, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  const ambulo__frame *frame = &plan->frames[f];
  const ambulo__body *body = &plan->body[frame->body];
  const double *at = scratch + body->at;
  double *adjoint = scratch + frame->adjoint_at;
  double *spin_adjoint = scratch + frame->spin_adjoint_at;
  wide3 eta = load3(scratch + frame->virtual_at), u = load3(scratch + frame->slide_at);
  wide3 c = load3(at), force = load3(at + three), momentum = load3(at + 3 * three);
  wide3 b = scale3(spread(body->mass), add_cross3(u, eta, c));
  wide3 c_adjoint =
      add_multiply33_transposed(cross3(force, eta), load33(scratch + frame->spin_at), b);
  wide3 rho = cross3(c, c_adjoint);
  wide33 spin = {zero, zero, zero};
  if (!frame->starts_spin_adjoint) spin = load33(spin_adjoint);
  store33(spin_adjoint, add_outer(spin, b, c));
  wide3 w = load3(scratch + frame->rate_at), alpha = load3(scratch + frame->rate_at + three);
  wide6 inertia = load6(at + 4 * three);
  wide3 alpha_adjoint = multiply6(inertia, eta);
  wide3 w_adjoint = add_cross3(multiply6(inertia, cross3(eta, w)), momentum, eta);
  rho = add_cross3(rho, load3(at + 2 * three), eta);
  rho = add_cross3(rho, alpha_adjoint, alpha);
  rho = add_cross3(rho, w_adjoint, w);
  store3(adjoint + adjoint_rho, rho);
  store3(adjoint + adjoint_kappa, add_cross3(w_adjoint, w, alpha_adjoint));
  store3(adjoint + adjoint_alpha, alpha_adjoint);
  store3(adjoint + adjoint_origin, zero);
  store3(adjoint + adjoint_acceleration, b);
}

/* Virtual motion down the tree, and the bodies. */
static void reverse_virtual(const ambulo__plan *plan, const double *weights, wide_pair root,
                            double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  const ambulo__frame *world = &plan->frames[0];
  store3(scratch + world->virtual_at, root.angular);
  store3(scratch + world->slide_at, root.linear);
  if (world->spin_at >= 0) store33(scratch + world->spin_adjoint_at, (wide33){zero, zero, zero});
  for (int i = 0; i < plan->coordinates; i++) {
    const int k = plan->order[i];
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
    wide y = joint->sign * load(weights + k * AMBULO__LANES);
    wide3 z = load3(scratch + joint->axis_at), eta = load3(scratch + parent->virtual_at);
    if (joint->own_origin) {
      wide3 r = sub3(load3(scratch + frame->place_at), load3(scratch + parent->place_at));
      wide3 u = add_cross3(load3(scratch + parent->slide_at), eta, r);
      if (!joint->revolute) u = axpy3(u, y, z);
      store3(scratch + frame->slide_at, u);
    }
    if (joint->revolute) store3(scratch + frame->virtual_at, axpy3(eta, y, z));
    if (frame->body >= 0) {
      reverse_body(plan, k + 1, scratch);
    } else if (frame->starts_spin_adjoint) {
      store33(scratch + frame->spin_adjoint_at, (wide33){zero, zero, zero});
    }
    for (int n = 0; frame->zero_adjoint && n < 5; n++) {
      store3(scratch + frame->adjoint_at + n * three, zero);
    }
  }
}

static void reverse_points(const ambulo__plan *plan, const double *weights, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  weights += (plan->coordinates + 6) * AMBULO__LANES;
  for (int i = 0; i < plan->points; i++) {
    const ambulo__plan_point *point = &plan->point[i];
    const ambulo__frame *frame = &plan->frames[point->frame];
    if (point->frame == 0) continue;
    double *adjoint = scratch + frame->adjoint_at;
    wide3 pi = load3(weights + i * three);
    wide3 r = add_rotated(zero, scratch, frame->column_at, point->position);
    store3(adjoint + adjoint_rho, add_cross3(load3(adjoint + adjoint_rho), r, pi));
    add3_at(adjoint + adjoint_origin, pi);
  }
}

/* The feet's wrenches are held about the world origin, loads about the frames' origins; and the
 * weight pi on the centre of mass is a weight m / (sum m) pi on that of every body. */
static void reverse_ground(const ambulo__plan *plan, wide3 pi, double *scratch) {
  for (int f = 0; f < 2; f++) {
    const ambulo__frame *frame = &plan->frames[plan->foot_frame[f]];
    if (plan->foot_frame[f] == 0) continue;
    wide3 force = load3(scratch + plan->ground_at + ground_foot + (2 * f + 1) * three);
    wide3 eta = load3(scratch + frame->virtual_at);
    add3_at(scratch + frame->adjoint_at + adjoint_origin, cross3(force, eta));
  }
  for (int i = 0; i < plan->bodies; i++) {
    const ambulo__body *body = &plan->body[i];
    double *adjoint = scratch + plan->frames[body->frame].adjoint_at;
    wide3 part = scale3(spread(body->mass / plan->mass), pi), c = load3(scratch + body->at);
    store3(adjoint + adjoint_rho, add_cross3(load3(adjoint + adjoint_rho), c, part));
    add3_at(adjoint + adjoint_origin, part);
  }
}

/* Adjoint of Omega into those of w and alpha. */
AMBULO__INLINE void reverse_spin(const ambulo__frame *frame, double *scratch) {
  double *adjoint = scratch + frame->adjoint_at;
  wide33 m = load33(scratch + frame->spin_adjoint_at);
  wide3 w = load3(scratch + frame->rate_at);
  wide3 alpha = {m.z.y - m.y.z, m.x.z - m.z.x, m.y.x - m.x.y};
  wide xy = m.x.y + m.y.x, xz = m.x.z + m.z.x, yz = m.y.z + m.z.y;
  wide3 w_adjoint = {xy * w.y + xz * w.z - 2 * (m.y.y + m.z.z) * w.x,
                     xy * w.x + yz * w.z - 2 * (m.x.x + m.z.z) * w.y,
                     xz * w.x + yz * w.y - 2 * (m.x.x + m.y.y) * w.z};
  add3_at(adjoint + adjoint_kappa, add_cross3(w_adjoint, w, alpha));
  add3_at(adjoint + adjoint_alpha, alpha);
}

/* Adjoint of r where the origin moves; adds to the adjoint of Omega. */
AMBULO__INLINE wide3 reverse_origin(const ambulo__plan *plan, int k, wide3 r, double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
  const double *adjoint = scratch + frame->adjoint_at;
  wide3 force = load3(scratch + frame->load_at + three);
  wide3 a = load3(adjoint + adjoint_acceleration);
  wide3 r_adjoint =
      add_cross3(load3(adjoint + adjoint_origin), force, load3(scratch + parent->virtual_at));
  if (joint->still) return r_adjoint;
  double *spin_adjoint = scratch + parent->spin_adjoint_at;
  store33(spin_adjoint, add_outer(load33(spin_adjoint), a, r));
  return add_multiply33_transposed(r_adjoint, load33(scratch + parent->spin_at), a);
}

/* What a joint's block works on: its rates and weight, with the sign of the axis. */
typedef struct joint_inputs {
  wide rate, acceleration, weight;
} joint_inputs;

AMBULO__INLINE wide3 reverse_revolute(const ambulo__plan *plan, int k, joint_inputs in, wide out[3],
                                      double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
  const double *adjoint = scratch + frame->adjoint_at;
  wide3 rho = load3(adjoint + adjoint_rho), alpha = load3(adjoint + adjoint_alpha);
  wide3 z = load3(scratch + joint->axis_at);
  wide3 both = add3(load3(scratch + frame->rate_at), load3(scratch + parent->rate_at));
  wide3 g = add_cross3(load3(adjoint + adjoint_kappa), alpha, both);
  out[0] = dot3(z, rho);
  out[1] = dot3(z, g);
  out[2] = dot3(z, alpha);
  wide3 z_adjoint = scale3(in.weight, load3(scratch + frame->moment_at));
  z_adjoint = axpy3(axpy3(z_adjoint, in.rate, g), in.acceleration, alpha);
  rho = add_cross3(rho, z, z_adjoint);
  if (!joint->has_offset) return rho;
  wide3 r = sub3(load3(scratch + frame->place_at), load3(scratch + parent->place_at));
  return add_cross3(rho, r, reverse_origin(plan, k, r, scratch));
}

AMBULO__INLINE wide3 reverse_prismatic(const ambulo__plan *plan, int k, joint_inputs in,
                                       wide out[3], double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
  double *adjoint = scratch + frame->adjoint_at;
  wide3 z = load3(scratch + joint->axis_at), w = load3(scratch + parent->rate_at);
  wide3 a = load3(adjoint + adjoint_acceleration);
  wide3 r = sub3(load3(scratch + frame->place_at), load3(scratch + parent->place_at));
  wide3 r_adjoint = reverse_origin(plan, k, r, scratch);
  wide3 v = scale3(spread(2), cross3(a, w));
  out[0] = dot3(z, r_adjoint);
  out[1] = dot3(z, v);
  out[2] = dot3(z, a);
  wide3 z_adjoint = scale3(in.weight, load3(scratch + frame->load_at + three));
  z_adjoint = axpy3(axpy3(z_adjoint, in.rate, v), in.acceleration, a);
  wide3 kappa = load3(adjoint + adjoint_kappa);
  store3(adjoint + adjoint_kappa, add_cross3(kappa, scale3(2 * in.rate, z), a));
  wide3 rho = add_cross3(load3(adjoint + adjoint_rho), r, r_adjoint);
  return add_cross3(rho, z, z_adjoint);
}

static void reverse_part(const ambulo__plan *plan, const double *qd, const double *qdd,
                         const double *ground, const double *weights, double *gq, double *gqd,
                         double *gqdd, double *scratch) {
  wide_pair root = load_pair(weights + plan->coordinates * AMBULO__LANES);
  wide3 pi = {{0}, {0}, {0}};
  if (plan->grounded) ground_adjoints(plan, ground, weights, &root, &pi, scratch);
  reverse_virtual(plan, weights, root, scratch);
  reverse_points(plan, weights, scratch);
  if (plan->grounded) reverse_ground(plan, pi, scratch);
  for (int i = plan->coordinates - 1; i >= 0; i--) {
    const int k = plan->order[i];
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1];
    double *adjoint = scratch + frame->adjoint_at;
    int at = k * AMBULO__LANES;
    joint_inputs in = {joint->sign * load(qd + at), joint->sign * load(qdd + at),
                       joint->sign * load(weights + at)};
    wide out[3];
    wide3 rho;
    if (joint->new_spin) reverse_spin(frame, scratch);
    if (joint->revolute) {
      rho = reverse_revolute(plan, k, in, out, scratch);
    } else {
      rho = reverse_prismatic(plan, k, in, out, scratch);
    }
    store(gq + at, joint->sign * out[0]);
    store(gqd + at, joint->sign * out[1]);
    store(gqdd + at, joint->sign * out[2]);
    if (joint->own_adjoint) {
      double *above = scratch + plan->frames[joint->parent].adjoint_at;
      add3_at(above + adjoint_rho, rho);
      for (int n = 1; n < 5; n++) add3_at(above + n * three, load3(adjoint + n * three));
    } else {
      store3(adjoint + adjoint_rho, rho);
    }
  }
}

#endif
