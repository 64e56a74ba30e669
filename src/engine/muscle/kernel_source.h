/* muscle/kernel_source.h - the sharing of one limb, a block of times at once.
 *
 * Compiled once for each instruction set by a kernels_*.c file of that name, which defines
 * AMBULO__WIDTH (lanes at a time) and AMBULO__SHARE (the set). A lane's result hangs on nothing in
 * the others.
 */
#ifndef AMBULO_MUSCLE_KERNEL_SOURCE_H
#define AMBULO_MUSCLE_KERNEL_SOURCE_H

#include "muscle/kernel_sharing.h"

/* s = smooth max(0, tau / T_0) of an elastic tendon, s' and s'' */
typedef struct stretch {
  wide share, slope, bend, rate;
} stretch;

/* (M.6) */
AMBULO__INLINE stretch stretch_at(const ambulo__muscle_limb *limb, wide tau, wide tau_rate) {
  const double corner = 0.02;
  wide t = tau / limb->elastic_torque, r = root(t * t + corner * corner);
  stretch s = {0.5 * (t + r), 0.5 * (1.0 + t / r), 0.5 * corner * corner / (r * r * r), t};
  s.rate = s.slope * tau_rate / limb->elastic_torque;
  return s;
}

AMBULO__INLINE void powers_of(wide q, wide p[3][AMBULO__POWERS]) {
  p[0][0] = spread(1.0);
  p[1][0] = p[2][0] = p[2][1] = spread(0.0);
  for (int e = 1; e < AMBULO__POWERS; e++) {
    p[0][e] = p[0][e - 1] * q;
    p[1][e] = (double)e * p[0][e - 1];
    if (e > 1) p[2][e] = (double)e * p[1][e - 1];
  }
}

/* by q, qd and the stretch of tendons and its rate */
typedef struct slopes {
  wide q[limb_slots], qd[limb_slots], stretch, stretch_rate;
} slopes;

/* (M.5) */
AMBULO__INLINE void add_slopes(const sharing *x, int muscle, const wide *qd, slopes *by) {
  const ambulo__strand *s = &x->limb->strands[muscle];
  const fiber *f = &x->fibers[muscle];
  const wide a = x->pullings[muscle].a, force = f->active * a + f->passive;
  wide arm = spread(0.0);
  for (int i = 0; i < s->span; i++) arm += x->multiplier[s->slots[i]] * f->arm[i];
  wide by_y = a * (f->linear_y + a * f->square_y) - arm * (a * f->active_y + f->passive_y);
  wide by_v = a * (f->linear_v - arm * f->active_v);
  for (int i = 0; i < s->span; i++) {
    wide turned = spread(0.0), moved = spread(0.0); /* H L, H qd */
    for (int k = 0; k < s->span; k++) {
      wide h = f->bend[i >= k ? i * (i + 1) / 2 + k : k * (k + 1) / 2 + i];
      turned += h * x->multiplier[s->slots[k]];
      moved += h * qd[s->slots[k]];
    }
    by->q[s->slots[i]] += force * turned - by_y * f->arm[i] + by_v * moved;
    by->qd[s->slots[i]] -= by_v * f->arm[i];
  }
  by->stretch -= s->stretch * by_y;
  by->stretch_rate -= s->stretch * by_v;
}

AMBULO__INLINE void store_slopes(const sharing *x, const wide *qd, const stretch *pulled,
                                 wide tau_rate, const ambulo__share_block *b, int lane) {
  const ambulo__muscle_limb *limb = x->limb;
  slopes by = {.stretch = spread(0.0), .stretch_rate = spread(0.0)};
  for (int j = 0; j < limb->coordinate_count; j++) by.q[j] = by.qd[j] = spread(0.0);
  for (int i = 0; i < limb->count; i++) add_slopes(x, i, qd, &by);
  for (int j = 0; j < limb->coordinate_count; j++) {
    wide by_tau = x->multiplier[j], by_rate = spread(0.0);
    if (j == limb->elastic) {
      const double unit = 1.0 / limb->elastic_torque;
      by_tau +=
          unit * (by.stretch * pulled->slope + by.stretch_rate * pulled->bend * tau_rate * unit);
      by_rate = unit * by.stretch_rate * pulled->slope;
    }
    store(b->by_q + j * AMBULO__LANES + lane, by.q[j]);
    store(b->by_qd + j * AMBULO__LANES + lane, by.qd[j]);
    store(b->by_tau + j * AMBULO__LANES + lane, by_tau);
    store(b->by_tau_rate + j * AMBULO__LANES + lane, by_rate);
    store(b->reserve + j * AMBULO__LANES + lane, x->multiplier[j] * (0.5 / x->prices->reserve[j]));
  }
}

/* rows of C^-1, where C C' is the curvature of the dual at its top */
AMBULO__INLINE void store_rows(sharing *x, const ambulo__share_block *b, int lane) {
  const int n = x->limb->coordinate_count;
  wide inverse[limb_slots][limb_slots];
  factorize(x);
  for (int k = 0; k < n; k++) {
    inverse[k][k] = x->factor[k][k];
    for (int i = k + 1; i < n; i++) {
      wide sum = spread(0.0);
      for (int m = k; m < i; m++) sum += x->factor[i][m] * inverse[m][k];
      inverse[i][k] = -x->factor[i][i] * sum;
    }
  }
  for (int r = 0; r < n; r++)
    for (int c = 0; c <= r; c++)
      store(b->rows + (r * (r + 1) / 2 + c) * AMBULO__LANES + lane, inverse[r][c]);
}

AMBULO__INLINE void share_part(const ambulo__muscle_limb *limb, const ambulo__prices *prices,
                               const ambulo__share_block *b, int lane) {
  const int n = limb->coordinate_count;
  sharing x = {.limb = limb, .prices = prices, .fibers = (fiber *)b->scratch};
  x.pullings = (pulling *)(x.fibers + limb->count);
  x.lines = (line *)(x.pullings + limb->count);
  wide powers[limb_slots][3][AMBULO__POWERS], qd[limb_slots], tau_rate = spread(0.0);
  stretch pulled = {spread(0.0), spread(0.0), spread(0.0), spread(0.0)};
  for (int j = 0; j < n; j++) {
    powers_of(load(b->q + j * AMBULO__LANES + lane), powers[j]);
    qd[j] = load(b->qd + j * AMBULO__LANES + lane);
    x.needed[j] = load(b->tau + j * AMBULO__LANES + lane);
  }
  if (limb->elastic >= 0) {
    tau_rate = load(b->tau_rate + limb->elastic * AMBULO__LANES + lane);
    pulled = stretch_at(limb, x.needed[limb->elastic], tau_rate);
  }
  for (int i = 0; i < limb->count; i++) {
    const ambulo__strand *s = &limb->strands[i];
    fiber *f = &x.fibers[i];
    fiber_at(s, prices, (const wide(*)[3][AMBULO__POWERS])powers, qd, pulled.share, pulled.rate, f);
    for (int k = 0; k < s->span; k++) x.needed[s->slots[k]] -= f->arm[k] * f->passive;
  }
  store(b->steps + lane, climb(&x));
  store(b->cost + lane, cost_of(&x));
  store_slopes(&x, qd, &pulled, tau_rate, b, lane);
  store_rows(&x, b, lane);
  for (int i = 0; i < limb->count; i++) {
    const fiber *f = &x.fibers[i];
    const wide a = x.pullings[i].a;
    store(b->activation + i * AMBULO__LANES + lane, a);
    store(b->force + i * AMBULO__LANES + lane, f->active * a + f->passive);
    store(b->length + i * AMBULO__LANES + lane, f->length);
    store(b->speed + i * AMBULO__LANES + lane, f->speed);
  }
}

static size_t scratch_of(const ambulo__muscle_limb *limb) {
  return (size_t)limb->count * (sizeof(fiber) + sizeof(pulling) + sizeof(line)) / sizeof(double);
}

static void share(const ambulo__muscle_limb *limb, const ambulo__prices *prices,
                  const ambulo__share_block *block) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH)
    share_part(limb, prices, block, lane);
}

const ambulo__share_kernels AMBULO__SHARE = {share, scratch_of};

#endif
