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

/* Virtual motion down the tree. */
static void reverse_virtual(const ambulo__plan *plan, const double *weights, wide_pair root,
                            double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  store3(scratch + plan->frames[0].virtual_at, root.angular);
  store3(scratch + plan->frames[0].slide_at, root.linear);
  wide3 eta = {{0}, {0}, {0}};
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__virtual_step *step = &steps->virtuals[i];
    wide y = step->sign * load(weights + step->input);
    if (!step->carried) eta = load3(scratch + step->from);
    eta = axpy3(eta, y, load3(scratch + step->axis));
    store3(scratch + step->to, eta);
  }
  for (int i = 0; i < steps->origin_count; i++) {
    const ambulo__origin_step *step = &steps->origins[i];
    wide3 r = sub3(load3(scratch + step->place_to), load3(scratch + step->place_from));
    wide3 u = load3(scratch + step->slide_from);
    u = add_cross3(u, load3(scratch + step->virtual_from), r);
    if (step->prismatic) {
      u = axpy3(u, step->sign * load(weights + step->input), load3(scratch + step->axis));
    }
    store3(scratch + step->slide_to, u);
  }
}

static void reverse_zero(const ambulo__steps *steps, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < steps->zero_adjoint_count; i++) {
    for (int k = 0; k < 5; k++) store3(scratch + steps->zero_adjoints[i] + k * three, zero);
  }
  for (int i = 0; i < steps->zero_spin_count; i++) {
    store33(scratch + steps->zero_spins[i], (wide33){zero, zero, zero});
  }
}

/* First contributions to the adjoints of a frame: those of its body. */
static void reverse_bodies(const ambulo__plan *plan, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < plan->bodies; i++) {
    const ambulo__body *body = &plan->body[i];
    const double *at = scratch + body->at;
    double *adjoint = scratch + body->adjoint;
    wide3 eta = load3(scratch + body->turn), c = load3(at), force = load3(at + three);
    wide3 b = add_cross3(load3(scratch + body->slide), eta, c);
    b = scale3(spread(body->mass), b);
    wide3 c_adjoint = cross3(force, eta);
    c_adjoint = add_multiply33_transposed(c_adjoint, load33(scratch + body->spin), b);
    wide3 rho = cross3(c, c_adjoint);
    wide33 spin = {zero, zero, zero};
    if (body->adds_spin) spin = load33(scratch + body->spin_adjoint);
    store33(scratch + body->spin_adjoint, add_outer(spin, b, c));
    wide3 w = load3(scratch + body->rate), alpha = load3(scratch + body->rate + three);
    wide6 inertia = load6(at + 4 * three);
    wide3 alpha_adjoint = multiply6(inertia, eta);
    wide3 w_adjoint = multiply6(inertia, cross3(eta, w));
    w_adjoint = add_cross3(w_adjoint, load3(at + 3 * three), eta);
    rho = add_cross3(rho, load3(at + 2 * three), eta);
    rho = add_cross3(rho, alpha_adjoint, alpha);
    rho = add_cross3(rho, w_adjoint, w);
    store3(adjoint + adjoint_rho, rho);
    store3(adjoint + adjoint_kappa, add_cross3(w_adjoint, w, alpha_adjoint));
    store3(adjoint + adjoint_alpha, alpha_adjoint);
    store3(adjoint + adjoint_origin, zero);
    store3(adjoint + adjoint_acceleration, b);
  }
}

static void reverse_points(const ambulo__steps *steps, const double *weights, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int g = 0; g < steps->group_count; g++) {
    const ambulo__group_step *group = &steps->groups[g];
    if (group->adjoint < 0) continue;
    double *adjoint = scratch + group->adjoint;
    wide3 x = load3(scratch + group->columns[0]), y = load3(scratch + group->columns[1]);
    wide3 z = load3(scratch + group->columns[2]);
    wide3 rho = load3(adjoint + adjoint_rho), sum = zero;
    for (int i = group->first; i < group->first + group->count; i++) {
      const double *place = steps->points[i].position;
      wide3 r = axpy3(scale3(spread(place[0]), x), spread(place[1]), y);
      wide3 pi = load3(weights + steps->points[i].output);
      rho = add_cross3(rho, axpy3(r, spread(place[2]), z), pi);
      sum = add3(sum, pi);
    }
    store3(adjoint + adjoint_rho, rho);
    add3_at(adjoint + adjoint_origin, sum);
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

/* A prismatic joint, r' known: its gradient, its part of kappa, and z x z' but
 * for z q x r', which is r x r'. */
AMBULO__INLINE wide3 reverse_prismatic(const ambulo__origin_step *step, wide3 r_adjoint, wide3 a,
                                       const double *qd, const double *qdd, const double *weights,
                                       double *const gradients[3], double *scratch) {
  int at = step->input;
  wide sign = spread(step->sign), rate = sign * load(qd + at);
  wide3 z = load3(scratch + step->axis);
  wide3 v = scale3(spread(2), cross3(a, load3(scratch + step->rate)));
  store(gradients[0] + at, sign * dot3(z, r_adjoint));
  store(gradients[1] + at, sign * dot3(z, v));
  store(gradients[2] + at, sign * dot3(z, a));
  wide3 z_adjoint = scale3(sign * load(weights + at), load3(scratch + step->load + three));
  z_adjoint = axpy3(axpy3(z_adjoint, rate, v), sign * load(qdd + at), a);
  if (!step->still) {
    double *kappa = scratch + step->adjoint_above + adjoint_kappa;
    store3(kappa, add_cross3(load3(kappa), scale3(2 * rate, z), a));
  }
  return cross3(z, z_adjoint);
}

/* Where origins move; what the move adds to rho is stored for later. */
static void reverse_origins(const ambulo__steps *steps, const double *qd, const double *qdd,
                            const double *weights, double *const gradients[3], double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  for (int i = 0; i < steps->origin_count; i++) {
    const ambulo__origin_step *step = &steps->origins[i];
    wide3 r = sub3(load3(scratch + step->place_to), load3(scratch + step->place_from));
    wide3 a = load3(scratch + step->adjoint + adjoint_acceleration), correction = zero;
    wide3 r_adjoint =
        add_cross3(load3(scratch + step->adjoint + adjoint_origin),
                   load3(scratch + step->load + three), load3(scratch + step->virtual_from));
    if (!step->still) {
      double *spin_adjoint = scratch + step->spin_adjoint;
      store33(spin_adjoint, add_outer(load33(spin_adjoint), a, r));
      r_adjoint = add_multiply33_transposed(r_adjoint, load33(scratch + step->spin), a);
    }
    if (step->prismatic) {
      correction = reverse_prismatic(step, r_adjoint, a, qd, qdd, weights, gradients, scratch);
    }
    store3(scratch + step->correction, add_cross3(correction, r, r_adjoint));
  }
}

/* Adjoint of Omega into those of w and alpha. */
static void reverse_spins(const ambulo__steps *steps, double *scratch) {
  for (int i = 0; i < steps->spin_count; i++) {
    const ambulo__spin_step *step = &steps->spins[i];
    double *adjoint = scratch + step->adjoint;
    wide33 m = load33(scratch + step->spin_adjoint);
    wide3 w = load3(scratch + step->rate);
    wide3 alpha = {m.z.y - m.y.z, m.x.z - m.z.x, m.y.x - m.x.y};
    wide xy = m.x.y + m.y.x, xz = m.x.z + m.z.x, yz = m.y.z + m.z.y;
    wide3 w_adjoint = {xy * w.y + xz * w.z - 2 * (m.y.y + m.z.z) * w.x,
                       xy * w.x + yz * w.z - 2 * (m.x.x + m.z.z) * w.y,
                       xz * w.x + yz * w.y - 2 * (m.x.x + m.y.y) * w.z};
    add3_at(adjoint + adjoint_kappa, add_cross3(w_adjoint, w, alpha));
    add3_at(adjoint + adjoint_alpha, alpha);
  }
}

/* Revolute joints: qd', qdd', and the change of rho. */
static void reverse_hinges(const ambulo__steps *steps, const double *qd, const double *qdd,
                           const double *weights, double *const gradients[3], double *scratch) {
  for (int i = 0; i < steps->angle_count; i++) {
    const ambulo__hinge_step *step = &steps->hinges[i];
    int at = step->input;
    wide sign = spread(step->sign);
    wide3 z = load3(scratch + step->axis), alpha = load3(scratch + step->adjoint + adjoint_alpha);
    wide3 both = add3(load3(scratch + step->rate_to), load3(scratch + step->rate_from));
    wide3 g = add_cross3(load3(scratch + step->adjoint + adjoint_kappa), alpha, both);
    store(gradients[1] + at, sign * dot3(z, g));
    store(gradients[2] + at, sign * dot3(z, alpha));
    wide3 z_adjoint = scale3(sign * load(weights + at), load3(scratch + step->moment));
    z_adjoint = axpy3(axpy3(z_adjoint, sign * load(qd + at), g), sign * load(qdd + at), alpha);
    wide3 correction = add_cross3(load3(scratch + step->correction_from), z, z_adjoint);
    store3(scratch + step->correction, correction);
  }
}

/* rho up the tree, and q' of the revolute joints. */
static void reverse_turnings(const ambulo__plan *plan, double *gq, double *scratch) {
  wide3 rho = {{0}, {0}, {0}};
  for (int i = 0; i < plan->coordinates; i++) {
    const ambulo__turning_step *step = &plan->steps.turnings[i];
    wide3 sum = add3(load3(scratch + step->add), load3(scratch + step->correction));
    if (!step->carried) rho = load3(scratch + step->rho);
    if (step->output >= 0) {
      store(gq + step->output, step->sign * dot3(load3(scratch + step->axis), rho));
    }
    rho = add3(sum, rho);
    store3(scratch + step->to, rho);
  }
}

static void reverse_part(const ambulo__plan *plan, const double *qd, const double *qdd,
                         const double *ground, const double *weights, double *gq, double *gqd,
                         double *gqdd, double *scratch) {
  const ambulo__steps *steps = &plan->steps;
  double *const gradients[3] = {gq, gqd, gqdd};
  wide_pair root = load_pair(weights + plan->coordinates * AMBULO__LANES);
  wide3 pi = {{0}, {0}, {0}};
  if (plan->grounded) ground_adjoints(plan, ground, weights, &root, &pi, scratch);
  reverse_virtual(plan, weights, root, scratch);
  reverse_zero(steps, scratch);
  reverse_bodies(plan, scratch);
  reverse_points(steps, weights, scratch);
  if (plan->grounded) reverse_ground(plan, pi, scratch);
  sum_up(steps->adjoints, steps->adjoint_count, adjoint_origin, scratch);
  reverse_origins(steps, qd, qdd, weights, gradients, scratch);
  reverse_spins(steps, scratch);
  sum_up(steps->adjoints, steps->adjoint_count, adjoint_kappa, scratch);
  reverse_hinges(steps, qd, qdd, weights, gradients, scratch);
  reverse_turnings(plan, gq, scratch);
}

#endif
