/* muscle/kernel_fiber.h - one muscle at one pose: its force as a line in the activation, its cost
 * as a parabola, and what both do when its length or speed changes.
 *
 * With the path's l, g = dl/dq, H = d2l/dq2 and v = g . qd, the tendon's length l_s + D (D and D'
 * given), l_o the optimal length, h = l_o sin alpha and V = 10 l_o/s:
 *
 *     y = l - l_s - D,   w = v - D'
 *     x = .02 l_o + (y + sqrt(y^2 + (.01 l_o)^2)) / 2,   x_y = (1 + y / sqrt(...)) / 2
 *     l_M = sqrt(x^2 + h^2),   cos = x / l_M,   cos_y = h^2 / l_M^3 x_y
 *     v_M = w cos,   n = l_M / l_o,   u = v_M / V
 *     n_y = cos x_y / l_o,   u_y = w cos_y / V,   u_v = cos / V
 *
 *     F = A a + B,   A = F_max f_l(n) f_v(u) cos,   B = F_max f_p(n) cos
 *
 * The metabolic power W = b a + c a^2 (W), mass m, share f of fast fibres, s = smooth max(0, -v_M):
 *
 *     c = m f (133 + 111 f_l),   b = m (1 - f) (40 + 74 f_l) + 1.25 F_max f_l f_v s
 *
 * Derivatives by y (the length) at fixed v, and by v, follow line by line.
 */
#ifndef AMBULO_MUSCLE_KERNEL_FIBER_H
#define AMBULO_MUSCLE_KERNEL_FIBER_H

#include "muscle/kernel_functions.h"
#include "muscle/muscles.h"

enum { fiber_pairs = AMBULO__SPAN * (AMBULO__SPAN + 1) / 2 };

typedef struct fiber {
  wide arm[AMBULO__SPAN];          /* r = -g */
  wide bend[fiber_pairs];          /* H, lower triangle by rows */
  wide active, active_y, active_v; /* A */
  wide passive, passive_y;         /* B */
  wide linear, linear_y, linear_v; /* price of a: metabolic b */
  wide square, square_y;           /* price of a^2 */
  wide length, speed;              /* n, v_M / l_o */
} fiber;

/* a value and its slope */
typedef struct curve {
  wide value, slope;
} curve;

/* sum of three bells b1 exp(-((n - b2) / (b3 + b4 n))^2 / 2) */
AMBULO__INLINE curve force_by_length(wide n) {
  static const double b[3][4] = {
      {0.815, 1.055, 0.162, 0.063}, {0.433, 0.717, -0.030, 0.200}, {0.100, 1.000, 0.354, 0.0}};
  curve f = {spread(0.0), spread(0.0)};
  for (int k = 0; k < 3; k++) {
    wide width = 1.0 / (b[k][2] + b[k][3] * n), x = (n - b[k][1]) * width;
    wide bell = b[k][0] * exponential(-0.5 * x * x);
    f.value += bell;
    f.slope -= bell * x * (width - x * b[k][3] * width);
  }
  return f;
}

/* d1 asinh(d2 u + d3) + d4, which ends smoothly at 0.01 */
AMBULO__INLINE curve force_by_speed(wide u) {
  const double d1 = -0.318, d2 = -8.149, d3 = -0.374, d4 = 0.886, least = 0.01, bend = 0.02;
  wide x = d2 * u + d3, size = absolute(x), hypotenuse = root(x * x + 1.0);
  wide log = logarithm(size + hypotenuse);
  wide f = d1 * choose(below(x, spread(0.0)), -log, log) + (d4 - least);
  wide r = root(f * f + bend * bend);
  return (curve){least + 0.5 * (f + r), 0.5 * (1.0 + f / r) * (d1 * d2) / hypotenuse};
}

/* (M.1): a sum of products of powers, with first and second derivatives */
AMBULO__INLINE wide path_of(const ambulo__strand *s, int span,
                            const wide powers[][3][AMBULO__POWERS], wide *g, wide *h) {
  wide length = spread(0.0);
  for (int t = 0; t < s->terms; t++) {
    const unsigned char *e = s->exponents[t];
    wide p[AMBULO__SPAN], d[AMBULO__SPAN], c = spread(s->coefficients[t]);
    for (int i = 0; i < span; i++) p[i] = powers[s->slots[i]][0][e[i]];
    for (int i = 0; i < span; i++) d[i] = powers[s->slots[i]][1][e[i]];
    wide all = c;
    for (int i = 0; i < span; i++) all *= p[i];
    length += all;
    for (int i = 0; i < span; i++) {
      if (e[i] == 0) continue;
      wide others = c;
      for (int k = 0; k < span; k++)
        if (k != i) others *= p[k];
      g[i] += others * d[i];
      if (e[i] > 1) h[i * (i + 1) / 2 + i] += others * powers[s->slots[i]][2][e[i]];
      for (int k = 0; k < i; k++) {
        if (e[k] == 0) continue;
        wide rest = c * d[i] * d[k];
        for (int o = 0; o < span; o++)
          if (o != i && o != k) rest *= p[o];
        h[i * (i + 1) / 2 + k] += rest;
      }
    }
  }
  return length;
}

/* the same, with a span known when this is compiled */
AMBULO__INLINE wide path_at(const ambulo__strand *s, const wide powers[][3][AMBULO__POWERS],
                            wide *g, wide *h) {
  for (int i = 0; i < AMBULO__SPAN; i++) g[i] = spread(0.0);
  for (int i = 0; i < fiber_pairs; i++) h[i] = spread(0.0);
  switch (s->span) {
  case 1:
    return path_of(s, 1, powers, g, h);
  case 2:
    return path_of(s, 2, powers, g, h);
  case 3:
    return path_of(s, 3, powers, g, h);
  default:
    return path_of(s, 4, powers, g, h);
  }
}

/* geometry of the fibres, as above */
typedef struct pennate {
  wide n, u, n_y, u_y, u_v, cosine, cosine_y, along, rate; /* along: l_M' = v_M; rate: w */
} pennate;

AMBULO__INLINE pennate pennate_at(const ambulo__strand *s, wide y, wide rate) {
  const double lo = s->fiber, least = 0.01 * lo, speed = 1.0 / (ambulo__fastest * lo);
  wide bent = root(y * y + least * least), x = 0.02 * lo + 0.5 * (y + bent);
  wide x_y = 0.5 * (1.0 + y / bent), length = root(x * x + s->height * s->height);
  wide inverse = 1.0 / length, cosine = x * inverse;
  wide cosine_y = s->height * s->height * inverse * inverse * inverse * x_y;
  wide along = rate * cosine;
  return (pennate){length / lo,
                   along * speed,
                   cosine * x_y / lo,
                   rate * cosine_y * speed,
                   cosine * speed,
                   cosine,
                   cosine_y,
                   along,
                   rate};
}

AMBULO__INLINE void set_costs(const ambulo__strand *s, const ambulo__prices *prices,
                              const pennate *p, curve by_length, const wide isometric[3],
                              fiber *f) {
  const double price = prices->metabolic, slow = s->mass * (1.0 - s->fast),
               fast = s->mass * s->fast;
  const double least = 0.01 * s->fiber;
  double weight = prices->by_volume ? s->force * s->fiber / prices->volume : 1.0 / prices->count;
  wide bent = root(p->along * p->along + least * least), shortening = 0.5 * (bent - p->along);
  wide slope = 0.5 * (1.0 - p->along / bent); /* of -v_M */
  wide rise = by_length.slope * p->n_y;       /* of f_l */
  f->square = price * fast * (133.0 + 111.0 * by_length.value) + prices->activation * weight;
  f->square_y = price * fast * 111.0 * rise;
  f->linear = price * (slow * (40.0 + 74.0 * by_length.value) + 1.25 * isometric[0] * shortening);
  f->linear_y =
      price * (slow * 74.0 * rise +
               1.25 * (isometric[1] * shortening - isometric[0] * slope * p->rate * p->cosine_y));
  f->linear_v = price * 1.25 * (isometric[2] * shortening - isometric[0] * slope * p->cosine);
}

/* (M.2) (M.3). stretch, stretch_rate: D / (l_s strain) and its rate */
AMBULO__INLINE void fiber_at(const ambulo__strand *s, const ambulo__prices *prices,
                             const wide powers[][3][AMBULO__POWERS], const wide *qd, wide stretch,
                             wide stretch_rate, fiber *f) {
  wide g[AMBULO__SPAN], length = path_at(s, powers, g, f->bend), rate = spread(0.0);
  for (int i = 0; i < s->span; i++) {
    f->arm[i] = -g[i];
    rate += g[i] * qd[s->slots[i]];
  }
  pennate p =
      pennate_at(s, length - s->tendon - s->stretch * stretch, rate - s->stretch * stretch_rate);
  curve by_length = force_by_length(p.n), by_speed = force_by_speed(p.u);
  wide bears = exponential(4.0 * ((p.n - 1.0) / s->passive_strain - 1.0));
  wide bears_y = 4.0 / s->passive_strain * bears * p.n_y;
  const wide pull[3] = {
      s->force * by_length.value * by_speed.value,
      s->force *
          (by_length.slope * p.n_y * by_speed.value + by_length.value * by_speed.slope * p.u_y),
      s->force * by_length.value * by_speed.slope * p.u_v}; /* along the fibres; by y, by v */
  f->active = pull[0] * p.cosine;
  f->active_y = pull[1] * p.cosine + pull[0] * p.cosine_y;
  f->active_v = pull[2] * p.cosine;
  f->passive = s->force * bears * p.cosine;
  f->passive_y = s->force * (bears_y * p.cosine + bears * p.cosine_y);
  f->length = p.n;
  f->speed = p.along / s->fiber;
  set_costs(s, prices, &p, by_length, pull, f);
}

#endif
