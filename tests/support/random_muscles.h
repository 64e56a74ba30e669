/* tests/support/random_muscles.h - limbs with random muscles, and the same cost found another way.
 *
 * The reference is the Lagrangian of one sharing in complex numbers,
 *
 *     sum_i b_i a_i + c_i a_i^2 + sum_j kappa_j e_j^2 + L_j (tau_j - sum_i r_ij F_i - e_j)
 *
 * with the a, e and L of a solution held. By the envelope theorem its derivatives are those of the
 * cost; a complex step takes them to rounding.
 */
#ifndef TESTS_SUPPORT_RANDOM_MUSCLES_H
#define TESTS_SUPPORT_RANDOM_MUSCLES_H

#include <complex.h>

#include "ambulo/muscles.h"
#include "support/random_model.h"
#include "support/test.h"

enum { leg_d = 7, leg_m = 40, leg_terms = 12 }; /* the last coordinate: no muscle spans it */

typedef struct leg {
  ambulo_link links[leg_d];
  ambulo_coordinate coordinates[leg_d];
  ambulo_muscle list[leg_m];
  unsigned char exponents[leg_m][leg_terms][AMBULO_MUSCLE_COORDINATES];
  double length[leg_m][leg_terms];
  char names[leg_d + leg_m][16];
  ambulo_muscles_definition definition;
  ambulo_model *model;
  ambulo_muscles *muscles;
} leg;

static inline void leg_model(leg *l) {
  ambulo_model_definition d = ambulo_model_definition_default();
  for (int i = 0; i < leg_d; i++) {
    snprintf(l->names[i], sizeof l->names[i], "q%d", i);
    l->links[i] = ambulo_link_default();
    l->links[i].name = l->names[i];
    l->links[i].parent = i - 1;
    l->links[i].type = AMBULO_REVOLUTE;
    l->links[i].a = 0.3;
    l->links[i].mass = 10.0;
    l->links[i].inertia[0] = l->links[i].inertia[1] = l->links[i].inertia[2] = 0.1;
    l->coordinates[i] = ambulo_coordinate_default();
    l->coordinates[i].name = l->names[i];
  }
  d.links = l->links;
  d.link_count = leg_d;
  d.coordinates = l->coordinates;
  d.coordinate_count = leg_d;
  d.stature = 1.75;
  assert_int_equal(ambulo_model_create(&d, NULL, NULL, &l->model), AMBULO_OK);
}

/* every third muscle has an elastic tendon at coordinate 4, where it spans it */
static inline void leg_muscle(leg *l, int i, random_source *source) {
  ambulo_muscle *m = &l->list[i];
  *m = ambulo_muscle_default();
  snprintf(l->names[leg_d + i], sizeof l->names[0], "m%d", i);
  m->name = l->names[leg_d + i];
  m->group = i % 2 ? "odd" : "even";
  m->force = random_between(source, 200, 6000);
  m->fiber = random_between(source, 0.04, 0.15);
  m->tendon = random_between(source, 0.05, 0.4);
  m->pennation = random_between(source, 0, 0.5);
  m->fast_fibers = random_between(source, 0.1, 0.9);
  m->coordinate_count = 1 + random_below(source, 4);
  m->term_count = leg_terms;
  m->exponents = (const unsigned char(*)[AMBULO_MUSCLE_COORDINATES])l->exponents[i];
  m->length = l->length[i];
  int first = random_below(source, leg_d - m->coordinate_count);
  for (int k = 0; k < m->coordinate_count; k++) {
    m->coordinates[m->coordinate_count - 1 - k] = first + k; /* falling */
    if (first + k == 4 && i % 3 == 0) m->elastic = 4;
  }
  m->tendon_strain = 0.05;
  for (int t = 0; t < leg_terms; t++) {
    int total = 0;
    for (int k = 0; k < m->coordinate_count; k++) {
      l->exponents[i][t][k] = (unsigned char)(t == 0   ? 0
                                              : t <= 4 ? k == t - 1
                                                       : random_below(source, 3));
      total += l->exponents[i][t][k];
    }
    double size = total == 1 ? 0.05 : 0.01;
    l->length[i][t] = t == 0 ? m->tendon + m->fiber * random_between(source, 0.7, 1.2)
                             : random_between(source, -size, size);
    if (total == 1 && m->elastic >= 0) l->length[i][t] = -fabs(l->length[i][t]);
  }
}

static inline void leg_open(leg *l, uint64_t seed) {
  random_source source = {seed};
  memset(l, 0, sizeof *l);
  leg_model(l);
  l->definition = ambulo_muscles_definition_default();
  for (int i = 0; i < leg_m; i++) leg_muscle(l, i, &source);
  l->definition.muscles = l->list;
  l->definition.muscle_count = leg_m;
  assert_int_equal(ambulo_muscles_create(l->model, &l->definition, NULL, NULL, &l->muscles),
                   AMBULO_OK);
}

static inline void leg_close(leg *l) {
  ambulo_muscles_free(l->muscles);
  ambulo_model_free(l->model);
}

/* ---------------------------------------------------------------- the reference */

typedef struct leg_state {
  double complex q[leg_d], qd[leg_d], tau[leg_d], tau_rate[leg_d];
} leg_state;

typedef struct leg_solution {
  double a[leg_m], e[leg_d], L[leg_d]; /* L without what goes through elastic tendons */
} leg_solution;

static inline double complex leg_length(const leg *l, int i, const double complex *q, int by) {
  const ambulo_muscle *m = &l->list[i];
  double complex sum = 0.0;
  for (int t = 0; t < m->term_count; t++) {
    double complex term = m->length[t];
    for (int k = 0; k < m->coordinate_count; k++) {
      int e = m->exponents[t][k], derived = m->coordinates[k] == by;
      if (derived) term *= e;
      for (int p = derived; p < e; p++) term *= q[m->coordinates[k]];
    }
    sum += term;
  }
  return sum;
}

static inline int leg_spans(const ambulo_muscle *m, int c) {
  for (int k = 0; k < m->coordinate_count; k++)
    if (m->coordinates[k] == c) return 1;
  return 0;
}

static inline double leg_elastic_torque(const leg *l) {
  const double complex zero[leg_d] = {0.0};
  double sum = 0.0;
  for (int i = 0; i < leg_m; i++)
    if (l->list[i].elastic >= 0) sum -= l->list[i].force * creal(leg_length(l, i, zero, 4));
  return sum;
}

static inline double complex leg_bell(double complex n) {
  double complex a = (n - 1.055) / (0.162 + 0.063 * n), b = (n - 0.717) / (0.2 * n - 0.03),
                 c = (n - 1.0) / 0.354;
  return 0.815 * cexp(-0.5 * a * a) + 0.433 * cexp(-0.5 * b * b) + 0.1 * cexp(-0.5 * c * c);
}

/* One muscle: what it adds to the Lagrangian; its force. */
static inline double complex leg_part(const leg *l, int i, const leg_state *x,
                                      const leg_solution *s, const ambulo_sharing *prices,
                                      double complex *force) {
  const ambulo_muscle *m = &l->list[i];
  double volume = 0.0, weight = ambulo_model_mass(l->model) * 9.81;
  for (int k = 0; k < leg_m; k++) volume += l->list[k].force * l->list[k].fiber;
  double complex length = leg_length(l, i, x->q, -1), rate = 0.0, arm = 0.0;
  for (int c = 0; c < leg_d; c++) {
    if (!leg_spans(m, c)) continue;
    double complex g = leg_length(l, i, x->q, c);
    rate += g * x->qd[c];
    arm -= g * s->L[c];
  }
  double complex stretch = 0.0, stretch_rate = 0.0;
  if (m->elastic >= 0) {
    double unit = leg_elastic_torque(l);
    double complex t = x->tau[4] / unit, r = csqrt(t * t + 4e-4);
    stretch = m->tendon * m->tendon_strain * (t + r) / 2.0;
    stretch_rate = m->tendon * m->tendon_strain * (1.0 + t / r) / 2.0 * x->tau_rate[4] / unit;
  }
  double lo = m->fiber, h = lo * sin(m->pennation);
  double complex y = length - m->tendon - stretch;
  double complex along = 0.02 * lo + (y + csqrt(y * y + 1e-4 * lo * lo)) / 2.0;
  double complex fiber = csqrt(along * along + h * h), v = (rate - stretch_rate) * along / fiber;
  double complex fl = leg_bell(fiber / lo);
  double complex f = -0.318 * casinh(-8.149 * v / (10.0 * lo) - 0.374) + 0.886 - 0.01;
  double complex fv = 0.01 + (f + csqrt(f * f + 4e-4)) / 2.0;
  double complex fp = cexp(4.0 * ((fiber / lo - 1.0) / m->passive_strain - 1.0));
  double mass = m->force * lo * 1059.7 / 0.6e6;
  double complex shortening = (csqrt(v * v + 1e-4 * lo * lo) - v) / 2.0;
  double per_watt = prices->metabolic / (weight * sqrt(9.81 * 1.75));
  double complex b = per_watt * (mass * (1.0 - m->fast_fibers) * (40.0 + 74.0 * fl) +
                                 1.25 * m->force * fl * fv * shortening);
  double complex c =
      per_watt * mass * m->fast_fibers * (133.0 + 111.0 * fl) +
      prices->activation * (prices->by_volume ? m->force * lo / volume : 1.0 / leg_m);
  *force = m->force * (s->a[i] * fl * fv + fp) * along / fiber;
  return b * s->a[i] + c * s->a[i] * s->a[i] - arm * *force;
}

static inline double complex leg_lagrangian(const leg *l, const leg_state *x, const leg_solution *s,
                                            const ambulo_sharing *prices) {
  double unit = 1e-3 * ambulo_model_mass(l->model) * 9.81 * 1.75;
  double complex sum = 0.0, force;
  for (int i = 0; i < leg_m; i++) sum += leg_part(l, i, x, s, prices, &force);
  for (int c = 0; c < leg_d; c++)
    if (ambulo__muscles_span(l->muscles, c))
      sum += prices->reserve / (unit * unit) * s->e[c] * s->e[c] + s->L[c] * (x->tau[c] - s->e[c]);
  return sum;
}

#endif
