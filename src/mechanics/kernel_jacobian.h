/* mechanics/kernel_jacobian.h - Jacobians of all outputs in closed form, after the forward pass.
 *
 * Derivation (the result is that of Carpentier & Mansard, RSS 2018, and Singh, Russell & Wensing,
 * RA-L 2022; here from mass points). Spatial vectors are referred to the world origin. The unit
 * motion of joint i is the velocity field  s + beta x r,  S_i = (beta, s) = (z, o x z) or (0, z).
 * It is fixed in the parent frame, so with zd = w_p x z, zdd = alpha_p x z + w_p x zd
 *   S  = (z,   o x z),   Sd  = (zd,  od x z + o x zd),
 *   Sdd = (zdd, odd x z + 2 od x zd + o x zdd)     or   (0, z), (0, zd), (0, zdd).
 * A step of q_i moves the subtree by S_i, adds Sd_i to its velocity field and Sdd_i to its
 * acceleration field, the fields being carried along rigidly; a step of qd_i adds S_i to the
 * velocity and 2 Sd_i to the acceleration; a step of qdd_i adds S_i to the acceleration. A field
 * (beta, s) added to the velocity v(r) of a mass point adds 2 beta x v(r) to its acceleration
 * beyond the rigid terms (as in Coriolis' theorem). With the force f = (N, F) of the subtree, its
 * inertia and its momentum P = sum m v, h = sum m r, I = inertia about the origin,
 * K = sum m v r^T, E = tr(K) 1 - K, so that sum m r x (beta x v) = E beta:
 *   t1 = df/dqdd = I(S)                    = (I z + h x s,        m s + z x h)
 *   t2 = df/dqd  = 2 I(Sd) + B(S)          with B(beta, s) = 2 (E beta, beta x P)
 *   t3 = df/dq   = I(Sdd) + B(Sd) + S x* f,  S x* f = (z x N + s x F, z x F)
 * These are the columns of the root wrench. A step of joint i changes tau of an ancestor j by
 * S_j . t; and a step of the ancestor j changes tau_i by the same fields, S_i . (...) turned over:
 *   dtau_j/dq_i = S_j . t3,               dtau_j/dqd_i = S_j . t2,               j above i
 *   dtau_i/dq_j = t4 . 2 zd_j + t1 . Sdd_j,   dtau_i/dqd_j = 2 t4 . z_j + t1 . 2 Sd_j,
 *   dtau_i/dqdd_j = dtau_j/dqdd_i = t1 . S_j,   t4 = E^T z + P x s,              j above or = i
 * (the turn of S_i with a step of q_j cancels against the turn of f). E, P, h, I are sums over
 * the subtree; those of one body with centre of mass x, velocity v, inertia J about x are
 *   h = m x,  P = m v,  I = J + (h.x) 1 - h x^T,  K = v h^T + [w x] (tr(J)/2 1 - J).
 * Point p:  dp/dq_j = s_j + z_j x p.
 * Stored per joint: S, 2 Sd, Sdd; per load: h, P, I, E.
 */
#ifndef AMBULO_MECHANICS_KERNEL_JACOBIAN_H
#define AMBULO_MECHANICS_KERNEL_JACOBIAN_H

#include "mechanics/kernel_forward.h"

enum {
  composite_first = 0,
  composite_momentum = three,
  composite_inertia = 2 * three,
  composite_coriolis = 4 * three
};

/* h, P, I and E of a body. */
AMBULO__INLINE void jacobian_body(const ambulo__plan *plan, const ambulo__frame *frame,
                                  double *scratch) {
  const ambulo__body *body = &plan->body[frame->body];
  double *out = scratch + frame->composite_at;
  wide3 c = load3(scratch + body->at), w = load3(scratch + frame->rate_at);
  wide6 j = load6(scratch + body->at + 4 * three);
  wide3 x = add3(load3(scratch + frame->place_at), c);
  wide3 v = add_cross3(load3(scratch + frame->velocity_at), w, c);
  wide3 h = scale3(spread(body->mass), x);
  wide square = dot3(h, x);
  wide6 inertia = {j.xx + square - h.x * x.x, j.yy + square - h.y * x.y, j.zz + square - h.z * x.z,
                   j.xy - h.x * x.y,          j.xz - h.x * x.z,          j.yz - h.y * x.z};
  wide half = 0.5 * (j.xx + j.yy + j.zz);
  /* columns of [w x] (half - J), which has no trace, then E = (v.h) 1 - v h^T - [w x] (...) */
  wide3 k1 = cross3(w, (wide3){half - j.xx, -j.xy, -j.xz});
  wide3 k2 = cross3(w, (wide3){-j.xy, half - j.yy, -j.yz});
  wide3 k3 = cross3(w, (wide3){-j.xz, -j.yz, half - j.zz});
  wide trace = dot3(v, h);
  wide33 coriolis = {{trace - v.x * h.x - k1.x, -v.x * h.y - k2.x, -v.x * h.z - k3.x},
                     {-v.y * h.x - k1.y, trace - v.y * h.y - k2.y, -v.y * h.z - k3.y},
                     {-v.z * h.x - k1.z, -v.z * h.y - k2.z, trace - v.z * h.z - k3.z}};
  store3(out + composite_first, h);
  store3(out + composite_momentum, scale3(spread(body->mass), v));
  store6(out + composite_inertia, inertia);
  store33(out + composite_coriolis, coriolis);
}

/* S, 2 Sd and Sdd of a joint. */
AMBULO__INLINE void jacobian_joint(const ambulo__plan *plan, int k, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1];
  const double *rate = scratch + plan->frames[joint->parent].rate_at;
  double *out = scratch + joint->motion_at;
  wide3 z = scale3(spread(joint->sign), load3(scratch + joint->axis_at));
  wide3 w = load3(rate), zd = cross3(w, z);
  wide3 zdd = add_cross3(cross3(w, zd), load3(rate + three), z);
  wide_pair s = {zero, z}, sd = {zero, scale3(spread(2), zd)}, sdd = {zero, zdd};
  if (joint->revolute) {
    wide3 o = load3(scratch + frame->place_at), a = load3(scratch + frame->place_at + three);
    wide3 od = load3(scratch + frame->velocity_at);
    wide3 zd2 = scale3(spread(2), zd), od2 = scale3(spread(2), od);
    s = (wide_pair){z, cross3(o, z)};
    sd = (wide_pair){zd2, add_cross3(cross3(od2, z), o, zd2)};
    sdd = (wide_pair){zdd, add_cross3(add_cross3(cross3(a, z), od2, zd), o, zdd)};
  }
  store_pair(out, s);
  store_pair(out + 2 * three, sd);
  store_pair(out + 4 * three, sdd);
}

/* Velocities of the origins, joints' motions and bodies' composites, down the tree. */
static void jacobian_motion(const ambulo__plan *plan, const double *qd, double *scratch) {
  const wide3 zero = {{0}, {0}, {0}};
  store3(scratch + plan->frames[0].velocity_at, zero);
  for (int i = 0; i < plan->coordinates; i++) {
    const int k = plan->order[i];
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1], *parent = &plan->frames[joint->parent];
    if (joint->own_origin) {
      wide3 r = sub3(load3(scratch + frame->place_at), load3(scratch + parent->place_at));
      wide3 v =
          add_cross3(load3(scratch + parent->velocity_at), load3(scratch + parent->rate_at), r);
      wide rate = joint->sign * load(qd + k * AMBULO__LANES);
      if (!joint->revolute) v = axpy3(v, rate, load3(scratch + joint->axis_at));
      store3(scratch + frame->velocity_at, v);
    }
    jacobian_joint(plan, k, scratch);
    if (frame->body >= 0) jacobian_body(plan, frame, scratch);
    for (int n = 0; frame->zero_load && n < 7; n++) {
      store3(scratch + frame->composite_at + n * three, zero);
    }
  }
}

/* Change of the subtree's force with q, qd, qdd of its joint, and t4. */
typedef struct subtree_changes {
  wide_pair q, qd, qdd;
  wide3 turned;
} subtree_changes;

/* f: the force of the subtree's bodies. */
AMBULO__INLINE subtree_changes jacobian_changes(const ambulo__plan *plan, int k, wide_pair f,
                                                const double *scratch) {
  const ambulo__joint *joint = &plan->joints[k];
  const ambulo__frame *frame = &plan->frames[k + 1];
  const double *composite = scratch + frame->composite_at;
  const double *motion = scratch + joint->motion_at;
  wide mass = spread(frame->subtree_mass);
  wide3 h = load3(composite + composite_first), p = load3(composite + composite_momentum);
  wide6 inertia = load6(composite + composite_inertia);
  wide33 e = load33(composite + composite_coriolis);
  wide_pair s = load_pair(motion), sd = load_pair(motion + 2 * three);
  wide_pair sdd = load_pair(motion + 4 * three);
  wide3 z = s.angular, z2 = scale3(spread(2), z);
  subtree_changes t;
  t.qdd.angular = add_cross3(multiply6(inertia, z), h, s.linear);
  t.qdd.linear = add_cross3(scale3(mass, s.linear), z, h);
  t.qd.angular = add_multiply33(multiply6(inertia, sd.angular), e, z2);
  t.qd.angular = add_cross3(t.qd.angular, h, sd.linear);
  t.qd.linear = add_cross3(scale3(mass, sd.linear), sd.angular, h);
  t.qd.linear = add_cross3(t.qd.linear, z2, p);
  t.q.angular = add_multiply33(multiply6(inertia, sdd.angular), e, sd.angular);
  t.q.angular = add_cross3(add_cross3(t.q.angular, h, sdd.linear), z, f.angular);
  t.q.angular = add_cross3(t.q.angular, s.linear, f.linear);
  t.q.linear = add_cross3(scale3(mass, sdd.linear), sdd.angular, h);
  t.q.linear = add_cross3(add_cross3(t.q.linear, sd.angular, p), z, f.linear);
  t.turned = add_multiply33_transposed(cross3(p, s.linear), e, z);
  return t;
}

/* Row and column of joint k in the Jacobians of tau. */
static void jacobian_pairs(const ambulo__plan *plan, int k, const subtree_changes *changes,
                           double *jq, double *jqd, double *jqdd, const double *scratch) {
  const subtree_changes t = *changes;
  wide3 turned2 = scale3(spread(2), t.turned);
  const int first = plan->ancestor_start[k], count = plan->ancestor_start[k + 1] - first;
  const int *ancestors = plan->ancestor + first, *uppers = plan->upper + first;
  for (int i = 0; i <= count; i++) {
    int j = i < count ? ancestors[i] : k, lower = (plan->start[k] + i) * AMBULO__LANES;
    const double *motion = scratch + plan->joints[j].motion_at;
    wide_pair s = load_pair(motion), sd = load_pair(motion + 2 * three);
    wide_pair sdd = load_pair(motion + 4 * three);
    wide mass = dot_pair(t.qdd, s);
    store(jq + lower, dot3(t.turned, sd.angular) + dot_pair(t.qdd, sdd));
    store(jqd + lower, dot3(turned2, s.angular) + dot_pair(t.qdd, sd));
    store(jqdd + lower, mass);
    if (i == count) break;
    int upper = uppers[i] * AMBULO__LANES;
    store(jq + upper, dot_pair(t.q, s));
    store(jqd + upper, dot_pair(t.qd, s));
    store(jqdd + upper, mass);
  }
}

/* Column of joint k in the Jacobian of the root wrench. */
AMBULO__INLINE void jacobian_wrench(const ambulo__plan *plan, int k, wide_pair t, double *out) {
  const int *start = plan->start + plan->coordinates;
  const wide values[6] = {t.angular.x, t.angular.y, t.angular.z,
                          t.linear.x,  t.linear.y,  t.linear.z};
  for (int i = 0; i < 6; i++) store(out + (start[i] + k) * AMBULO__LANES, values[i]);
}

static void jacobian_points(const ambulo__plan *plan, double *jq, const double *scratch) {
  for (int i = 0; i < plan->points; i++) {
    const ambulo__plan_point *point = &plan->point[i];
    const ambulo__frame *frame = &plan->frames[point->frame];
    const int *start = plan->start + plan->coordinates + 6 + 3 * i;
    wide3 p = load3(scratch + frame->place_at);
    p = add_rotated(p, scratch, frame->column_at, point->position);
    for (int e = 0; e < start[1] - start[0]; e++) {
      const ambulo__joint *joint = &plan->joints[plan->column[start[0] + e]];
      wide_pair s = load_pair(scratch + joint->motion_at);
      wide3 column = s.linear;
      if (joint->revolute) column = add_cross3(column, s.angular, p);
      store(jq + (start[0] + e) * AMBULO__LANES, column.x);
      store(jq + (start[1] + e) * AMBULO__LANES, column.y);
      store(jq + (start[2] + e) * AMBULO__LANES, column.z);
    }
  }
}

/* Adds the composite of joint k's subtree to that of its parent. */
AMBULO__INLINE void jacobian_pass_up(const ambulo__plan *plan, int k, double *scratch) {
  double *above = scratch + plan->frames[plan->joints[k].parent].composite_at;
  const double *below = scratch + plan->frames[k + 1].composite_at;
  for (int n = 0; n < 7; n++) add3_at(above + n * three, load3(below + n * three));
}

static void jacobian_part(const ambulo__plan *plan, const double *qd, double *jq, double *jqd,
                          double *jqdd, double *scratch) {
  jacobian_motion(plan, qd, scratch);
  for (int i = plan->coordinates - 1; i >= 0; i--) {
    const int k = plan->order[i];
    const ambulo__joint *joint = &plan->joints[k];
    const ambulo__frame *frame = &plan->frames[k + 1];
    subtree_changes t = jacobian_changes(plan, k, load_pair(scratch + frame->load_at), scratch);
    jacobian_pairs(plan, k, &t, jq, jqd, jqdd, scratch);
    jacobian_wrench(plan, k, t.q, jq);
    jacobian_wrench(plan, k, t.qd, jqd);
    jacobian_wrench(plan, k, t.qdd, jqdd);
    if (joint->own_load && joint->parent != 0) jacobian_pass_up(plan, k, scratch);
  }
  jacobian_points(plan, jq, scratch);
}

#endif
