/* mechanics/kernel_contacts.h - the wrenches of the ground and of other surfaces on any contacts.
 *
 * The bodies' loads sum up to the root wrench (M, F) about the world origin that the surroundings
 * must supply. K contacts at p_c with weights w_c share it as a weighted inverse of the grasp map
 * does: of all forces f_c and moments m_c about p_c that sum up to it, those that
 *   minimise  sum f_c . A_c^-1 f_c + m_c . B_c^-1 m_c,
 *   A_c = w_c (1 + g e e^T),  g = 1 / epsilon^2 - 1,  B_c = w_c l^2,  e = r_c / |r_c|,
 *   r_c = c - p_c, with the centre of mass c: forces like to point at it.
 * The answer does not change if all weights are scaled, so that they sum up to 1 here. It also does
 * not depend on the point x about which moments are balanced; with x the weighted mean of p_c and
 * d_c = p_c - x, sum w_c d_c = 0 (but for rounding, which G has too). A contact that stands alone
 * has d = 0 and takes the wrench as it is, and far from the world origin nothing is lost to
 * rounding. With k_c = g w_c / r_c^2 and the line of a contact h_c = (d_c x r_c, r_c), the
 * stationary point of the Lagrangian with multipliers y = (eta, v) on the sums of moments and
 * forces is
 *   f_c = w_c u_c + k_c (r_c . u_c) r_c,   m_c = w_c l^2 eta,   u_c = v + eta x d_c,
 *   G y = (M - x x F, F),   G = diag(l^2 1 + sum w_c (d_c^2 1 - d_c d_c^T), 1) + sum k_c h_c h_c^T
 * (no square root is needed). G is positive definite as it stands for any weights, zeros too:
 * blocks of 3 are eliminated, those by symmetric factors L D L^T. Where no weight is left (flight),
 * all w_c and k_c are zero, and so are the wrenches. W_c = (m_c + p_c x f_c, f_c), about the world
 * origin.
 *
 * Adjoints; x' is the adjoint of x. Weights on tau give the link of a contact a virtual motion
 * V_c = (beta, s) about the world origin, and tau has -V_c . W_c. With those on the rows of f_c and
 * m_c,
 *   a_c = f_c' - (s + beta x p_c),   b_c = m_c' - beta,
 *   t = sum (d_c x A_c a_c + w_c l^2 b_c,  A_c a_c),   z = (zeta, s_z) = G^-1 t,
 * for G is symmetric: z is the adjoint of (M - x x F, F), thus zeta that of M and s_z + x x zeta
 * that of F. A change of A_c changes f_c by dA_c u_c, and what these changes miss of the sums is
 * made good through y:  sum a_c . dA_c u_c + t . dy = sum (a_c - s_z - zeta x d_c) . dA_c u_c.
 * With a = a_c - s_z - zeta x d_c, dA u = k (r (dr . u) + dr (r . u) - 2 r (r . u) (r . dr) / r^2)
 * and dr = dc,
 *   c' = weight on c + sum k ((r . u) a + (r . a) u - 2 (r . u) (r . a) r / r^2).
 */
#ifndef AMBULO_MECHANICS_KERNEL_CONTACTS_H
#define AMBULO_MECHANICS_KERNEL_CONTACTS_H

#include "mechanics/kernel_wide.h"

/* L D L^T of a symmetric matrix: 1 / D on the diagonal, L with the corner of its inverse. With the
 * leading minors n_1 = xx, n_2 and n_3, D is n_1, n_2 / n_1, n_3 / n_2, all by one division: of
 * three that wait for each other most of the time would be lost. n_3 stands here times n_1. */
AMBULO__INLINE wide6 factor6(wide6 a) {
  wide second = a.xx * a.yy - rounded(a.xy * a.xy), across = a.xx * a.yz - rounded(a.xy * a.xz);
  wide third = second * (a.xx * a.zz - rounded(a.xz * a.xz)) - across * across;
  wide both = a.xx * second, inverse = 1 / (both * third);
  wide6 f;
  f.xx = second * third * inverse;
  f.zz = both * both * inverse;
  inverse = a.xx * third * inverse;
  f.yy = a.xx * inverse;
  f.yz = across * inverse;
  f.xy = a.xy * f.xx;
  f.xz = f.xy * f.yz - a.xz * f.xx;
  return f;
}

AMBULO__INLINE wide3 solve6(wide6 f, wide3 v) {
  wide y = v.y - f.xy * v.x, z = ((v.z - f.yz * v.y) + f.xz * v.x) * f.zz;
  wide x = v.x * f.xx;
  y = y * f.yy;
  return (wide3){(x - rounded(f.xy * y)) + f.xz * z, y - f.yz * z, z};
}

/* c - M v and c - M^T v */
AMBULO__INLINE wide3 subtract_multiply33(wide3 c, wide33 m, wide3 v) {
  return (wide3){subtract_dot3(c.x, m.x, v), subtract_dot3(c.y, m.y, v),
                 subtract_dot3(c.z, m.z, v)};
}

AMBULO__INLINE wide3 subtract_multiply33_transposed(wide3 c, wide33 m, wide3 v) {
  return axpy3(axpy3(axpy3(c, -v.x, m.x), -v.y, m.y), -v.z, m.z);
}

/* m + a b^T */
AMBULO__INLINE wide33 add_product33(wide33 m, wide3 a, wide3 b) {
  return (wide33){axpy3(m.x, a.x, b), axpy3(m.y, a.y, b), axpy3(m.z, a.z, b)};
}

/* m + s a a^T */
AMBULO__INLINE wide6 add_square6(wide6 m, wide s, wide3 a) {
  wide3 b = scale3(s, a);
  return (wide6){m.xx + a.x * b.x, m.yy + a.y * b.y, m.zz + a.z * b.z,
                 m.xy + a.x * b.y, m.xz + a.x * b.z, m.yz + a.y * b.z};
}

AMBULO__INLINE wide6 scalar6(wide s) {
  const wide zero = {0};
  return (wide6){s, s, s, zero, zero, zero};
}

/* G in blocks, and its factors: `force` and `moment` those of the block of forces and of what is
 * left of that of moments; `mixed` (moments by forces): the block, then times the inverse of that
 * of forces. */
typedef struct contacts_grasp {
  wide6 force, moment;
  wide33 mixed;
} contacts_grasp;

AMBULO__INLINE contacts_grasp grasp_factors(contacts_grasp g) {
  const wide33 c = g.mixed;
  contacts_grasp f = {.force = factor6(g.force)};
  const wide33 t = {solve6(f.force, c.x), solve6(f.force, c.y), solve6(f.force, c.z)};
  const wide6 left = {subtract_dot3(g.moment.xx, t.x, c.x), subtract_dot3(g.moment.yy, t.y, c.y),
                      subtract_dot3(g.moment.zz, t.z, c.z), subtract_dot3(g.moment.xy, t.x, c.y),
                      subtract_dot3(g.moment.xz, t.x, c.z), subtract_dot3(g.moment.yz, t.y, c.z)};
  f.moment = factor6(left);
  f.mixed = t;
  return f;
}

/* G^-1 t */
AMBULO__INLINE wide_pair grasp_solve(const contacts_grasp *f, wide_pair t) {
  wide3 eta = solve6(f->moment, subtract_multiply33(t.angular, f->mixed, t.linear));
  return (wide_pair){eta,
                     subtract_multiply33_transposed(solve6(f->force, t.linear), f->mixed, eta)};
}

AMBULO__INLINE contacts_grasp load_grasp(const double *at) {
  at += contacts_factor;
  return (contacts_grasp){load6(at), load6(at + 2 * three), load33(at + 4 * three)};
}

AMBULO__INLINE void store_grasp(double *at, const contacts_grasp *g) {
  at += contacts_factor;
  store6(at, g->force);
  store6(at + 2 * three, g->moment);
  store33(at + 4 * three, g->mixed);
}

/* g */
AMBULO__INLINE double contacts_preference(const ambulo__plan *plan) {
  return 1 / (plan->slant * plan->slant) - 1;
}

/* Where contact c stands in a block's ground: its weight, then its centre. */
AMBULO__INLINE const double *contact_ground(const double *ground, int c) {
  return ground + three + 4 * c * AMBULO__LANES;
}

AMBULO__INLINE double *contact_at(const ambulo__plan *plan, int c, double *scratch) {
  return scratch + plan->contacts_at + contacts_first + c * contact_slot;
}

AMBULO__INLINE const double *contact_kept(const ambulo__plan *plan, int c, const double *scratch) {
  return scratch + plan->contacts_at + contacts_first + c * contact_slot;
}

/* The root wrench with what the bodies hold. */
AMBULO__INLINE wide_pair with_taken(const ambulo__plan *plan, wide_pair w, const double *scratch) {
  return plan->taken_at ? add_pair(w, load_pair(scratch + plan->taken_at)) : w;
}

/* What does not wait for the motion: x, w, d, and sum w d, which is what rounding leaves of zero.
 * It comes long before the rest, which waits for it no more. */
AMBULO__INLINE void contacts_place(const ambulo__plan *plan, const double *ground,
                                   double *scratch) {
  const wide one = spread(1);
  double *all = scratch + plan->contacts_at;
  wide total = {0};
  wide3 middle = {{0}, {0}, {0}}, o = load3(ground), rest = middle;
  for (int c = 0; c < plan->contacts; c++) total += load(contact_ground(ground, c));
  wide floating = (wide)((wide_bits)one & (wide_bits)(total < spread(1e-300)));
  wide inverse = (one - floating) / (total + floating);
  for (int c = 0; c < plan->contacts; c++) {
    const double *contact = contact_ground(ground, c);
    double *at = contact_at(plan, c, scratch);
    wide w = load(contact) * inverse;
    wide3 d = sub3(load3(contact + AMBULO__LANES), o);
    middle = axpy3(middle, w, d);
    store(at + contact_share, w);
    store3(at + contact_arm, d);
  }
  for (int c = 0; c < plan->contacts; c++) {
    double *at = contact_at(plan, c, scratch);
    wide3 d = sub3(load3(at + contact_arm), middle);
    rest = axpy3(rest, load(at + contact_share), d);
    store3(at + contact_arm, d);
  }
  store(all + contacts_floating, floating);
  store3(all + contacts_middle, add3(o, middle));
  store3(all + contacts_rest, rest);
}

/* G, and what is kept of each contact for it; center: c. */
AMBULO__INLINE contacts_grasp contacts_couple(const ambulo__plan *plan, const double *ground,
                                              wide3 center, double *scratch) {
  const double preference = contacts_preference(plan);
  const wide zero = {0};
  const wide3 rest = load3(scratch + plan->contacts_at + contacts_rest);
  contacts_grasp g = {scalar6(spread(1)),
                      scalar6(spread(plan->moment_arm * plan->moment_arm)),
                      {{zero, -rest.z, rest.y}, {rest.z, zero, -rest.x}, {-rest.y, rest.x, zero}}};
  for (int c = 0; c < plan->contacts; c++) {
    double *at = contact_at(plan, c, scratch);
    wide3 r = sub3(center, load3(contact_ground(ground, c) + AMBULO__LANES));
    wide3 d = load3(at + contact_arm), line = cross3(d, r);
    wide w = load(at + contact_share), close = 1 / (dot3(r, r) + 1e-200);
    wide k = preference * w * close, spin = w * dot3(d, d);
    g.moment = add_square6(g.moment, -w, d);
    g.moment.xx += spin;
    g.moment.yy += spin;
    g.moment.zz += spin;
    g.force = add_square6(g.force, k, r);
    g.moment = add_square6(g.moment, k, line);
    g.mixed = add_product33(g.mixed, line, scale3(k, r));
    store3(at + contact_line, r);
    store(at + contact_taste, k);
    store(at + contact_close, close);
  }
  return g;
}

/* A wrench about the world origin, about x, and a motion the other way round. */
AMBULO__INLINE wide_pair about(wide3 x, wide_pair w) {
  return (wide_pair){sub3(w.angular, cross3(x, w.linear)), w.linear};
}

AMBULO__INLINE wide_pair moved_back_from(wide3 x, wide_pair v) {
  return (wide_pair){v.angular, add_cross3(v.linear, x, v.angular)};
}

/* A_c v */
AMBULO__INLINE wide3 contact_push(const double *at, wide3 v) {
  wide3 r = load3(at + contact_line);
  wide along = load(at + contact_taste) * dot3(r, v);
  return axpy3(scale3(load(at + contact_share), v), along, r);
}

/* What the multipliers y make of a contact: its wrench, and its rows; keep: u. */
AMBULO__INLINE void contact_share_of(const ambulo__plan *plan, const double *ground, int c,
                                     int keep, wide_pair y, double *out, double *scratch) {
  double *at = contact_at(plan, c, scratch);
  wide3 p = load3(contact_ground(ground, c) + AMBULO__LANES);
  wide3 u = add_cross3(y.linear, y.angular, load3(at + contact_arm));
  wide3 f = contact_push(at, u);
  wide3 m = scale3(load(at + contact_share) * (plan->moment_arm * plan->moment_arm), y.angular);
  store_pair(at + contact_acts, (wide_pair){add_cross3(m, p, f), f});
  if (keep) store3(at + contact_moved, u);
  if (!out) return;
  out += (ambulo__plan_first_contact_row(plan) + 6 * c) * AMBULO__LANES;
  store3(out, f);
  store3(out + three, m);
}

/* (W'): Shares the root wrench w out, after contacts_place; first: the bodies' first mass moment,
 * what is fixed left out; out: rows of the contacts and of the centre of mass, or NULL. */
AMBULO__INLINE void contacts_share_out(const ambulo__plan *plan, const double *ground, int keep,
                                       wide_pair w, wide3 first, double *out, double *scratch) {
  double *at = scratch + plan->contacts_at;
  wide3 center = add3(first, spread3(plan->fixed_first));
  center = scale3(spread(1 / plan->mass), center);
  const contacts_grasp g = grasp_factors(contacts_couple(plan, ground, center, scratch));
  const wide_pair y = grasp_solve(&g, about(load3(at + contacts_middle), w));
  for (int c = 0; c < plan->contacts; c++) {
    contact_share_of(plan, ground, c, keep, y, out, scratch);
  }
  if (out) {
    store3(out + (ambulo__plan_first_contact_row(plan) + 6 * plan->contacts) * AMBULO__LANES,
           center);
  }
  if (!keep) return;
  store_pair(at + contacts_wrench, w);
  store_grasp(at, &g);
}

/* a_c, and its part in t; v: V_c. */
AMBULO__INLINE wide3 contact_asks(const ambulo__plan *plan, const double *ground, int c,
                                  const double *weights, wide_pair v, wide_pair *t,
                                  const double *scratch) {
  const double *at = contact_kept(plan, c, scratch);
  const double *row = weights + (ambulo__plan_first_contact_row(plan) + 6 * c) * AMBULO__LANES;
  wide3 p = load3(contact_ground(ground, c) + AMBULO__LANES);
  wide3 a = add_cross3(sub3(load3(row), v.linear), p, v.angular);
  wide3 b = sub3(load3(row + three), v.angular), push = contact_push(at, a);
  wide spin = load(at + contact_share) * (plan->moment_arm * plan->moment_arm);
  t->angular = axpy3(add_cross3(t->angular, load3(at + contact_arm), push), spin, b);
  t->linear = add3(t->linear, push);
  return a;
}

/* The part of a contact in c'; a: without z's part. */
AMBULO__INLINE wide3 contact_pulls(const double *at, wide3 a, wide_pair z, wide3 pull) {
  wide3 r = load3(at + contact_line), u = load3(at + contact_moved);
  a = sub3(a, add_cross3(z.linear, z.angular, load3(at + contact_arm)));
  wide taste = load(at + contact_taste), of_u = taste * dot3(r, u), of_a = dot3(r, a);
  pull = axpy3(axpy3(pull, of_u, a), taste * of_a, u);
  return axpy3(pull, -2 * (of_u * of_a) * load(at + contact_close), r);
}

/* (W'.V): Adds M' and F' to *root, the weights on the root wrench; v: V of each contact. Returns
 * c'. */
AMBULO__INLINE wide3 contacts_adjoints(const ambulo__plan *plan, const double *ground,
                                       const double *weights, const wide_pair *v, wide_pair *root,
                                       const double *scratch) {
  const double *at = scratch + plan->contacts_at;
  int last = ambulo__plan_first_contact_row(plan) + 6 * plan->contacts;
  wide_pair t = {{{0}, {0}, {0}}, {{0}, {0}, {0}}};
  wide3 a[AMBULO__MOST_CONTACTS], pull = load3(weights + last * AMBULO__LANES);
  for (int c = 0; c < plan->contacts; c++) {
    a[c] = contact_asks(plan, ground, c, weights, v[c], &t, scratch);
  }
  const contacts_grasp g = load_grasp(at);
  const wide_pair z = grasp_solve(&g, t);
  for (int c = 0; c < plan->contacts; c++) {
    pull = contact_pulls(contact_kept(plan, c, scratch), a[c], z, pull);
  }
  *root = add_pair(*root, moved_back_from(load3(at + contacts_middle), z));
  return pull;
}

#endif
