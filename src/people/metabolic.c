/* people/metabolic.c - see metabolic.h. */
#include "people/metabolic.h"

#include <math.h>

#include "muscle/muscles.h"

double ambulo__force_by_length(double n) {
  static const double b[3][4] = {
      {0.815, 1.055, 0.162, 0.063}, {0.433, 0.717, -0.030, 0.200}, {0.100, 1.000, 0.354, 0.0}};
  double sum = 0.0;
  for (int k = 0; k < 3; k++) {
    double x = (n - b[k][1]) / (b[k][2] + b[k][3] * n);
    sum += b[k][0] * exp(-0.5 * x * x);
  }
  return sum;
}

double ambulo__force_by_speed(double v) {
  double f = -0.318 * asinh(-8.149 * v / ambulo__fastest - 0.374) + 0.886 - 0.01;
  return 0.01 + 0.5 * (f + sqrt(f * f + 4e-4));
}

static double mass_of(const ambulo_muscle *m) {
  return m->force * m->fiber * ambulo__muscle_density / ambulo__muscle_stress;
}

static ambulo__metabolic sum_of(const ambulo_muscle *m, const ambulo__fiber_state *s, double heat) {
  ambulo__metabolic all = {.heat = fmax(heat, mass_of(m)), .work = -s->force * m->fiber * s->speed};
  all.power = fmax(0.0, all.heat + all.work);
  return all;
}

/* (M.8) */
ambulo__metabolic ambulo__bhargava(const ambulo_muscle *m, const ambulo__fiber_state *s) {
  const double quarter = 0.5 * acos(-1.0);
  double by_length = ambulo__force_by_length(s->length), mass = mass_of(m);
  double slow = (1.0 - m->fast_fibers) * sin(quarter * s->activation);
  double fast = m->fast_fibers * (1.0 - cos(quarter * s->activation));
  double isometric = m->force * by_length * s->activation, v = s->speed * m->fiber;
  double alpha = v <= 0.0 ? 0.16 * isometric + 0.18 * s->force : 0.157 * s->force;
  return sum_of(m, s,
                mass * (40.0 * slow + 133.0 * fast + (74.0 * slow + 111.0 * fast) * by_length) -
                    alpha * v);
}

/* (M.8) */
ambulo__metabolic ambulo__umberger(const ambulo_muscle *m, const ambulo__fiber_state *s) {
  const double aerobic = 1.5, fastest = 12.0, slowest = fastest / 2.5, a = s->activation;
  double by_length = s->length > 1.0 ? ambulo__force_by_length(s->length) : 1.0;
  double kept = pow(a, 0.6) * (128.0 * m->fast_fibers + 25.0) * (0.4 + 0.6 * by_length);
  double of_slow = 100.0 / slowest, moved;
  if (s->speed <= 0.0)
    moved = a * a *
            (fmin(100.0, -of_slow * s->speed) * (1.0 - m->fast_fibers) -
             153.0 / fastest * s->speed * m->fast_fibers);
  else
    moved = a * 4.0 * of_slow * s->speed;
  return sum_of(m, s, mass_of(m) * aerobic * (kept + moved * by_length));
}
