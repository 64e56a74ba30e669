/* mechanics/kernel_ground.h - the ground's wrenches on two feet, by the two-step method.
 *
 * Step 1: the bodies' loads sum up to the root wrench (M, F) about the world origin that the
 * ground must supply. Step 2: it is split between the feet 0 and 1 so that each centre of
 * pressure lies under its own foot. With the normal n, the plane n . r = height, shares a_0 and
 * a_1 = 1 - a_0, D the nominal centre of pressure of foot 0 less that of foot 1 (in the plane),
 * c the centre of mass, z = n . c - height, and F_n = n . F:
 *   p   = (n x M + height F) / F_n                          zero-moment point     (16')
 *   h   = kappa a_0 a_1 F_n D / z                           shear: both feet push towards c
 *   F_0 = a_0 F - h,   M_0 = a_0 M + a_0 a_1 D x F - c_0 x h,   c_0 = p + a_1 D
 *   F_1 = a_1 F + h,   M_1 = a_1 M - a_0 a_1 D x F + c_1 x h,   c_1 = p - a_0 D
 * Free moment of foot f: T_f = n . (M_f - c_f x F_f). Since h is parallel to D, F_n cancels from
 * c_f x h, what passes from one foot to the other is one wrench (X, -h), and T_f is a share:
 *   gain = kappa a_0 a_1 / z,   V = n x M + height F,   Y = a_0 a_1 F + gain V
 *   X = D x Y,   h = gain F_n D,   T = M . F / F_n,   T_f = a_f T
 *   (M_0, F_0) = a_0 (M, F) + (X, -h),    (M_1, F_1) = a_1 (M, F) - (X, -h)
 * The torques are tau_i = S_i . (f_i - sum of W_f over the feet f that joint i carries).
 *
 * Adjoints. Weights y on tau give each foot a virtual motion (about the world origin), the sum of
 * S_i y_i over the joints that carry it; W_f has its negative as adjoint (A_f, B_f), plus the
 * weight on F_f. With x' the adjoint of x, theta the sum of a_f times the weight on T_f:
 *   X' = A_0 - A_1,   h' = B_1 - B_0,   Y' = X' x D,   V' = gain Y'
 *   gain' = Y' . V + F_n h' . D,        z' = -gain / z gain',    c' = z' n + weight on c
 *   M' = sum a_f A_f + V' x n + theta F / F_n
 *   F' = sum a_f B_f + a_0 a_1 Y' + height V' + gain h' . D n + theta (M - T n) / F_n
 * M' and F' act like weights on the root wrench; c' is passed on to the bodies.
 */
#ifndef AMBULO_MECHANICS_KERNEL_GROUND_H
#define AMBULO_MECHANICS_KERNEL_GROUND_H

#include "mechanics/kernel_wide.h"

/* At plan->ground_at. */
enum {
  ground_wrench = 0,
  ground_foot = 2 * three,                     /* two wrenches */
  ground_height = 6 * three,                   /* z */
  ground_twist = ground_height + AMBULO__LANES /* T */
};

typedef struct ground_shares {
  wide share[2], product, gain, height;
  wide3 apart, up; /* D, n */
  wide inverse;    /* 1 / z */
} ground_shares;

AMBULO__INLINE wide3 ground_up(const ambulo__plan *plan) {
  return (wide3){spread(plan->up[0]), spread(plan->up[1]), spread(plan->up[2])};
}

AMBULO__INLINE ground_shares ground_load(const ambulo__plan *plan, const double *ground, wide z) {
  wide a = load(ground), b = 1 - a, inverse = 1 / z;
  wide gain = load(ground + 4 * AMBULO__LANES) * (a * b) * inverse;
  return (ground_shares){{a, b},          a * b,  gain, z, load3(ground + AMBULO__LANES),
                         ground_up(plan), inverse};
}

/* V = n x M + height F */
AMBULO__INLINE wide3 ground_lever(const ambulo__plan *plan, wide3 up, wide_pair w) {
  return add_cross3(scale3(spread(plan->ground_height), w.linear), up, w.angular);
}

typedef struct ground_split {
  wide_pair foot[2];
  wide3 center;
  wide height, twist;
} ground_split;

/* (W.1) (W.2): The split of the root wrench w; first: the bodies' first mass moment, what is fixed
 * left out. */
AMBULO__INLINE ground_split ground_split_of(const ambulo__plan *plan, const double *ground,
                                            wide_pair w, wide3 first) {
  const double *fixed = plan->fixed_first;
  wide3 c = {first.x + fixed[0], first.y + fixed[1], first.z + fixed[2]};
  c = scale3(spread(1 / plan->mass), c);
  ground_shares s = ground_load(plan, ground, dot3(ground_up(plan), c) - plan->ground_height);
  wide normal = dot3(s.up, w.linear);
  wide3 lever = scale3(s.gain, ground_lever(plan, s.up, w));
  wide_pair passed = {cross3(s.apart, axpy3(lever, s.product, w.linear)),
                      scale3(-s.gain * normal, s.apart)};
  ground_split split = {.center = c, .height = s.height};
  split.twist = dot3(w.angular, w.linear) / normal;
  for (int f = 0; f < 2; f++) {
    split.foot[f] = (wide_pair){scale3(s.share[f], w.angular), scale3(s.share[f], w.linear)};
    split.foot[f] = axpy_pair(split.foot[f], spread(1 - 2 * f), passed);
  }
  return split;
}

AMBULO__INLINE void ground_keep(const ambulo__plan *plan, wide_pair w, const ground_split *split,
                                double *scratch) {
  double *at = scratch + plan->ground_at;
  store_pair(at + ground_wrench, w);
  for (int f = 0; f < 2; f++) store_pair(at + ground_foot + 2 * f * three, split->foot[f]);
  store(at + ground_height, split->height);
  store(at + ground_twist, split->twist);
}

AMBULO__INLINE void ground_divide(const ambulo__plan *plan, const double *ground, wide_pair w,
                                  wide3 first, double *scratch) {
  const ground_split split = ground_split_of(plan, ground, w, first);
  ground_keep(plan, w, &split, scratch);
}

/* (W.3): Outputs: feet, centre of mass. */
AMBULO__INLINE void ground_rows(const ambulo__plan *plan, const double *ground,
                                const ground_split *split, double *out) {
  const wide share[2] = {load(ground), 1 - load(ground)};
  out += ambulo__plan_first_foot_row(plan) * AMBULO__LANES;
  for (int f = 0; f < 2; f++) {
    store3(out, split->foot[f].linear);
    store(out + three, share[f] * split->twist);
    out += three + AMBULO__LANES;
  }
  store3(out, split->center);
}

/* (W.V): Adds M' and F' to *root, the weights on the root wrench; foot: virtual motions of the
 * feet. Returns c'. */
AMBULO__INLINE wide3 ground_adjoints(const ambulo__plan *plan, const double *ground,
                                     const double *weights, const wide_pair foot[2],
                                     wide_pair *root, const double *scratch) {
  const double *at = scratch + plan->ground_at;
  const double *rows = weights + ambulo__plan_first_foot_row(plan) * AMBULO__LANES;
  ground_shares s = ground_load(plan, ground, load(at + ground_height));
  wide_pair w = load_pair(at + ground_wrench), sum = *root;
  wide_pair passed = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  wide theta = {0};
  for (int f = 0; f < 2; f++) {
    const double *row = rows + 4 * f * AMBULO__LANES;
    wide_pair part = {foot[f].angular, sub3(foot[f].linear, load3(row))};
    sum = axpy_pair(sum, -s.share[f], part);
    passed = axpy_pair(passed, spread(f ? 1 : -1), part);
    theta += s.share[f] * load(row + three);
  }
  wide normal = dot3(s.up, w.linear), along = dot3(passed.linear, s.apart);
  wide3 y = cross3(passed.angular, s.apart), v = scale3(s.gain, y);
  wide gain = dot3(y, ground_lever(plan, s.up, w)) - normal * along;
  theta /= normal;
  sum.angular = axpy3(add_cross3(sum.angular, v, s.up), theta, w.linear);
  sum.linear = axpy3(axpy3(sum.linear, s.product, y), spread(plan->ground_height), v);
  sum.linear = axpy3(sum.linear, theta, w.angular);
  sum.linear = axpy3(sum.linear, -(s.gain * along + theta * load(at + ground_twist)), s.up);
  *root = sum;
  return axpy3(load3(rows + 8 * AMBULO__LANES), -(s.gain * s.inverse) * gain, s.up);
}

#endif
