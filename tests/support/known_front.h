/* tests/support/known_front.h - fronts whose every point is known: a motion is a number s in [0, 1]
 * (or, of three terms, a direction), and to solve is to take the best of very many. */
#ifndef AMBULO_TESTS_KNOWN_FRONT_H
#define AMBULO_TESTS_KNOWN_FRONT_H

#include "study/front.h"
#include "support/test.h"

enum { KNOWN_SAMPLES = 20000, KNOWN_ROOM = 1600 };

typedef struct known_front {
  /* J and R of a motion */
  void (*motion)(double s, double *value, double *rest);
  /* 1: the solve of these weights from zero ends in a valley, at *s */
  int (*valley)(const double *weight, double *s);
  int fails_after; /* points from this one on have no solution; 0: none */
  double unit[AMBULO__FRONT_TERMS];
  ambulo__front front;
  ambulo__front_point points[KNOWN_ROOM];
  ambulo__front_report report;
  int rounds;
} known_front;

/* J_i = unit_i (1 - n_i), n in the positive octant: the best is n_i ~ weight_i unit_i */
static inline void known_sphere(const known_front *k, ambulo__front_point *p) {
  double size = 0.0;
  p->total = 0.0;
  for (int i = 0; i < 3; i++) size += pow(p->weight[i] * k->unit[i], 2.0);
  for (int i = 0; i < 3; i++) {
    p->value[i] = k->unit[i] * (1.0 - p->weight[i] * k->unit[i] / sqrt(size));
    p->total += p->weight[i] * p->value[i];
  }
}

static inline double known_total(const known_front *k, const double *weight, double s,
                                 double *value) {
  double rest = 0.0, total;
  k->motion(s, value, &rest);
  total = rest;
  for (int i = 0; i < 2; i++) {
    value[i] *= k->unit[i];
    total += weight[i] * value[i];
  }
  return total;
}

static inline void known_solve(known_front *k, int index) {
  ambulo__front_point *p = &k->points[index];
  double best = INFINITY, at = 0.0, value[2];
  p->solved = !(k->fails_after > 0 && index >= k->fails_after);
  if (k->front.terms == 3) {
    known_sphere(k, p);
    return;
  }
  for (int i = 0; i <= KNOWN_SAMPLES; i++) {
    double s = (double)i / KNOWN_SAMPLES, total = known_total(k, p->weight, s, value);
    if (total < best) {
      best = total;
      at = s;
    }
  }
  if (k->valley && p->from < 0) (void)k->valley(p->weight, &at);
  p->total = known_total(k, p->weight, at, p->value);
}

/* asks and solves until nothing is asked for */
static inline void known_run(known_front *k, int terms, int wanted) {
  ambulo__front_request requests[KNOWN_ROOM];
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  int count = 1;
  k->front.terms = terms;
  k->front.wanted = wanted;
  k->front.point = k->points;
  if (!(k->front.least > 0.0)) k->front.least = 0.01;
  while (count > 0) {
    assert_int_equal(ambulo__front_ask(&k->front, &a, requests, KNOWN_ROOM / 2, &count), AMBULO_OK);
    k->rounds++;
    for (int i = 0; i < count; i++) {
      ambulo__front_point *p = &k->points[k->front.points];
      memset(p, 0, sizeof *p);
      memcpy(p->weight, requests[i].weight, sizeof p->weight);
      memcpy(p->parent, requests[i].parent, sizeof p->parent);
      p->from = requests[i].from;
      known_solve(k, k->front.points++);
    }
    assert_true(k->front.points < KNOWN_ROOM / 2);
  }
  ambulo__front_judge(&k->front, &k->report);
}

#endif
