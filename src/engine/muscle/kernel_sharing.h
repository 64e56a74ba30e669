/* muscle/kernel_sharing.h - the least cost at which muscles supply the torques of a limb.
 *
 * With forces F_i = A_i a_i + B_i, moment arms r_ij, prices b_i, c_i > 0 of a and a^2, and reserves
 * e_j at the price kappa_j,
 *
 *     phi = min over 0 <= a <= 1 of  sum_i b_i a_i + c_i a_i^2 + sum_j kappa_j e_j^2,
 *           e_j = tau_j - sum_i r_ij F_i
 *
 * Its dual in one multiplier L_j for each coordinate has no constraints. With P = tau - sum_i r_i
 * B_i, G_i = r_i A_i and z_i = L . G_i - b_i,
 *
 *     phi = max over L of  L . P - sum_j L_j^2 / (4 kappa_j) - sum_i psi_i(z_i)
 *     psi_i(z) = max over [0, 1] of z a - c_i a^2, taken at a_i = min(1, max(0, z / (2 c_i)))
 *     e_j = L_j / (2 kappa_j)
 *
 * It is concave with curvature 1 / (2 kappa) and more, and quadratic between the kinks where a
 * muscle meets 0 or 1. So Newton's method with an exact line search converges from everywhere and
 * ends after finitely many steps. The slope along a step, h(t), falls and is linear between kinks;
 * its zero is found by Newton's method within a bracket. The search starts where every muscle is
 * taken as half on.
 *
 * Gradients need no derivative of a or L (envelope). With y_i the length and F_i as shared:
 *
 *     dphi/dtau = L
 *     by_y = a (b_y + a c_y) - (L . r_i)(a A_y + B_y),   by_v = a (b_v - (L . r_i) A_v)
 *     dphi/dq   = sum_i F_i H_i L - by_y r_i + by_v H_i qd,   dphi/dqd = -sum_i by_v r_i
 *
 * An elastic tendon has D = l_s strain s(tau_e), s = smooth max(0, T) with T = tau_e / T_0,
 * D' = l_s strain s'(T) tau_e' / T_0. So with S = -sum l_s strain by_y and S' = -sum l_s strain
 * by_v
 *
 *     dphi/dtau_e  += (S s' + S' s'' tau_e' / T_0) / T_0,   dphi/dtau_e' = S' s' / T_0
 */
#ifndef AMBULO_MUSCLE_KERNEL_SHARING_H
#define AMBULO_MUSCLE_KERNEL_SHARING_H

#include "muscle/kernel_fiber.h"

enum { most_steps = 60, most_trials = 40, limb_slots = AMBULO__LIMB_COORDINATES };

/* A muscle in the search: G over its slots, b, a, and on which side of its kinks. */
typedef struct pulling {
  wide pull[AMBULO__SPAN], linear, a, piece;
} pulling;

/* What the line search reads of it: z, its change along the step, 1 / (2 c). */
typedef struct line {
  wide z, dz, half;
} line;

/* what the search holds */
typedef struct sharing {
  const ambulo__muscle_limb *limb;
  const ambulo__prices *prices;
  fiber *fibers; /* [count] */
  pulling *pullings;
  line *lines;
  wide needed[limb_slots];             /* P */
  wide size;                           /* the largest of them */
  wide multiplier[limb_slots];         /* L */
  wide slope[limb_slots];              /* of the dual */
  wide step[limb_slots];               /* of a Newton step */
  wide factor[limb_slots][limb_slots]; /* lower triangle; the diagonal inverted */
} sharing;

AMBULO__INLINE void clear_factor(sharing *x, double share) {
  const int n = x->limb->coordinate_count;
  for (int i = 0; i < n; i++)
    for (int k = 0; k <= i; k++)
      x->factor[i][k] = spread(i == k ? share / x->prices->reserve[i] : 0.0);
}

/* factor += weight G G' of a muscle */
AMBULO__INLINE void add_curvature(sharing *x, const ambulo__strand *s, const wide *pull,
                                  wide weight) {
  for (int i = 0; i < s->span; i++) {
    wide row = weight * pull[i];
    for (int k = 0; k <= i; k++)
      x->factor[s->slots[i]][s->slots[k]] += row * pull[k]; /* slots rise */
  }
}

AMBULO__INLINE void factorize(sharing *x) {
  const int n = x->limb->coordinate_count;
  for (int k = 0; k < n; k++) {
    for (int j = 0; j < k; j++) x->factor[k][k] -= x->factor[k][j] * x->factor[k][j];
    x->factor[k][k] = 1.0 / root(x->factor[k][k]);
    for (int i = k + 1; i < n; i++) {
      for (int j = 0; j < k; j++) x->factor[i][k] -= x->factor[i][j] * x->factor[k][j];
      x->factor[i][k] *= x->factor[k][k];
    }
  }
}

AMBULO__INLINE void solve_factor(const sharing *x, wide *v) {
  const int n = x->limb->coordinate_count;
  for (int i = 0; i < n; i++) {
    for (int k = 0; k < i; k++) v[i] -= x->factor[i][k] * v[k];
    v[i] *= x->factor[i][i];
  }
  for (int i = n - 1; i >= 0; i--) {
    for (int k = i + 1; k < n; k++) v[i] -= x->factor[k][i] * v[k];
    v[i] *= x->factor[i][i];
  }
}

AMBULO__INLINE wide along_pull(const ambulo__strand *s, const wide *pull, const wide *v) {
  wide sum = pull[0] * v[s->slots[0]];
  for (int i = 1; i < s->span; i++) sum += pull[i] * v[s->slots[i]];
  return sum;
}

/* activation at z; *inside: where it follows z */
AMBULO__INLINE wide activation_at(wide z, wide half, wide_bits *inside) {
  wide free = z * half, a = smaller(larger(free, spread(0.0)), spread(1.0));
  *inside = ~(below(free, spread(0.0)) | below(spread(1.0), free));
  return a;
}

AMBULO__INLINE void start(sharing *x) {
  const ambulo__muscle_limb *limb = x->limb;
  const int n = limb->coordinate_count;
  x->size = spread(0.0);
  for (int j = 0; j < n; j++) x->size = larger(x->size, absolute(x->needed[j]));
  clear_factor(x, 0.5);
  for (int i = 0; i < limb->count; i++) {
    const ambulo__strand *s = &limb->strands[i];
    const fiber *f = &x->fibers[i];
    pulling *p = &x->pullings[i];
    for (int k = 0; k < s->span; k++) p->pull[k] = f->arm[k] * f->active;
    p->linear = f->linear;
    p->piece = spread(-1.0);
    x->lines[i].half = 0.5 / f->square;
    add_curvature(x, s, p->pull, 0.5 * x->lines[i].half);
  }
  factorize(x);
  for (int j = 0; j < n; j++) x->multiplier[j] = x->needed[j];
  solve_factor(x, x->multiplier);
}

/* Slope and curvature of the dual at L; the lanes in which a muscle has passed a kink since the
 * last look. */
AMBULO__INLINE wide_bits look(sharing *x) {
  const ambulo__muscle_limb *limb = x->limb;
  const double enough = 1e-10;
  wide_bits passed = {0};
  clear_factor(x, 0.5);
  for (int j = 0; j < limb->coordinate_count; j++)
    x->slope[j] = x->needed[j] - x->multiplier[j] * (0.5 / x->prices->reserve[j]);
  for (int i = 0; i < limb->count; i++) {
    const ambulo__strand *s = &limb->strands[i];
    pulling *p = &x->pullings[i];
    line *l = &x->lines[i];
    wide_bits inside;
    l->z = along_pull(s, p->pull, x->multiplier) - p->linear;
    p->a = activation_at(l->z, l->half, &inside);
    wide piece = choose(inside, spread(0.5), p->a);
    passed |= below(piece, p->piece) | below(p->piece, piece);
    p->piece = piece;
    add_curvature(x, s, p->pull, choose(inside, l->half, spread(0.0)));
    for (int k = 0; k < s->span; k++) x->slope[s->slots[k]] -= p->a * p->pull[k];
  }
  for (int j = 0; j < limb->coordinate_count; j++)
    passed |= below(enough * x->size, absolute(x->slope[j]));
  return passed;
}

/* h(t) of the lanes' steps, and its slope */
AMBULO__INLINE wide along_step(const sharing *x, wide t, wide rise, wide bend, wide *falls) {
  wide h = rise - t * bend, slope = -bend;
  for (int i = 0; i < x->limb->count; i++) {
    const line *l = &x->lines[i];
    wide_bits inside;
    wide a = activation_at(l->z + t * l->dz, l->half, &inside);
    h -= a * l->dz;
    slope -= choose(inside, l->half, spread(0.0)) * l->dz * l->dz;
  }
  *falls = slope;
  return h;
}

/* L moves to the top of the dual along the step, in the lanes that go; those that stopped short of
 * a whole step, or went beyond */
AMBULO__INLINE wide_bits move(sharing *x, wide_bits *go) {
  const ambulo__muscle_limb *limb = x->limb;
  const int n = limb->coordinate_count;
  const double nothing = 1e-24; /* of the cost: a muscle that rests on a kink, but for rounding */
  wide rise = spread(0.0), bend = spread(0.0), first = spread(0.0), value = spread(0.0);
  for (int j = 0; j < n; j++) {
    wide weight = spread(0.5 / x->prices->reserve[j]);
    x->step[j] = choose(*go, x->step[j], spread(0.0));
    rise += x->step[j] * (x->needed[j] - x->multiplier[j] * weight);
    bend += x->step[j] * x->step[j] * weight;
    first += x->step[j] * x->slope[j];
    value += absolute(x->multiplier[j] * x->needed[j]);
  }
  *go &= below(nothing * value, first);
  for (int i = 0; i < limb->count; i++)
    x->lines[i].dz = along_pull(&limb->strands[i], x->pullings[i].pull, x->step);
  wide low = spread(0.0), high = spread(1e300), t = spread(1.0), falls;
  for (int k = 0; k < most_trials; k++) {
    wide h = along_step(x, t, rise, bend, &falls);
    wide_bits off = below(1e-3 * first, absolute(h)) & below(spread(0.0), first);
    if (!any(off)) break;
    low = choose(off & below(spread(0.0), h), t, low);
    high = choose(off & below(h, spread(0.0)), t, high);
    wide next = t - h / falls;
    wide middle = choose(below(high, spread(1e299)), 0.5 * (low + high), 2.0 * t);
    next = choose(below(low, next) & below(next, high), next, middle);
    t = choose(off, next, t);
  }
  for (int j = 0; j < n; j++) x->multiplier[j] += t * x->step[j];
  return below(t, spread(1.0)) | below(spread(1.0), t);
}

/* (M.4): to the top of the dual; how many steps each lane took. A whole step that passes no kink
 * ends at the top: the dual is quadratic there. */
AMBULO__INLINE wide climb(sharing *x) {
  const int n = x->limb->coordinate_count;
  wide steps = spread(0.0);
  wide_bits go = ~(wide_bits){0}, partly = go;
  start(x);
  for (int k = 0; k < most_steps; k++) {
    go &= look(x) | partly;
    if (!any(go)) break;
    steps += choose(go, spread(1.0), spread(0.0));
    factorize(x);
    for (int j = 0; j < n; j++) x->step[j] = x->slope[j];
    solve_factor(x, x->step);
    partly = move(x, &go);
  }
  if (any(go)) (void)look(x); /* the factor of the last step gives way to the curvature */
  return steps;
}

AMBULO__INLINE wide cost_of(const sharing *x) {
  wide cost = spread(0.0);
  for (int j = 0; j < x->limb->coordinate_count; j++)
    cost += x->multiplier[j] * (x->needed[j] - x->multiplier[j] * (0.25 / x->prices->reserve[j]));
  for (int i = 0; i < x->limb->count; i++) {
    wide a = x->pullings[i].a;
    cost -= a * (x->lines[i].z - x->fibers[i].square * a);
  }
  return cost;
}

#endif
