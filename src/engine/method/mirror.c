/* method/mirror.c - see mirror.h */
#include "method/mirror.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* of the first step, and of the point that it leads to: what may be rounding. Over all shipped
 * problems it is 1e-7 of the step at most, where that is 1e-9 of the point. */
static const double first_step = 1e-6, rounding = 1e-12;

ambulo_status ambulo__mirror_create(int rows, ambulo__pool *pool, ambulo__mirror *m) {
  memset(m, 0, sizeof *m);
  m->rows = rows;
  m->multiplier = ambulo__pool_doubles(pool, (size_t)rows);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__mirror_start(ambulo__mirror *m, double f, const double *row) {
  double sum = 0.0;
  for (int i = 0; i < m->rows; i++) {
    m->multiplier[i] = 0.0;
    if (row[i] > 0.0) sum += row[i] * row[i];
  }
  double wanted = 2.0 * fabs(f) / sum;
  wanted = AMBULO__NLOPT_FIRST_PENALTY < wanted ? AMBULO__NLOPT_FIRST_PENALTY : wanted;
  m->penalty = m->rows == 0                           ? 1.0
               : AMBULO__NLOPT_LEAST_PENALTY > wanted ? AMBULO__NLOPT_LEAST_PENALTY
                                                      : wanted;
  m->measure = HUGE_VAL;
  m->updates = 0;
}

/* (P.11) NLopt's rule for nu and rho */
int ambulo__mirror_update(ambulo__mirror *m, const double *row) {
  double before = m->measure;
  m->measure = 0.0;
  for (int i = 0; i < m->rows; i++) {
    double next = m->multiplier[i] + m->penalty * row[i];
    double slack = -m->multiplier[i] / m->penalty;
    double left = fabs(row[i] > slack ? row[i] : slack);
    m->measure = m->measure > left ? m->measure : left;
    m->multiplier[i] = next < 0.0                                ? 0.0
                       : next < AMBULO__NLOPT_LARGEST_MULTIPLIER ? next
                                                                 : AMBULO__NLOPT_LARGEST_MULTIPLIER;
  }
  m->updates++;
  if (!(m->measure > AMBULO__NLOPT_ENOUGH * before)) return 0;
  m->penalty *= AMBULO__NLOPT_GROWTH;
  return 1;
}

int ambulo__mirror_pool(const ambulo__mirror *m, double *row, unsigned n, const double *gradient,
                        double *pooled) {
  double largest = 0.0, squares = 0.0;
  int of_all = -1;
  for (int i = 0; i < m->rows; i++) {
    double force = row[i] + m->multiplier[i] / m->penalty;
    if (!(force > 0.0)) continue;
    squares += force * force;
    row[i] = -HUGE_VAL;
    if (!(force > largest)) continue;
    largest = force;
    of_all = i;
  }
  if (of_all < 0) return -1;
  double force = sqrt(squares);
  row[of_all] = force - m->multiplier[of_all] / m->penalty;
  for (unsigned j = 0; j < n; j++) pooled[j] = gradient[j] / (m->penalty * force);
  return of_all;
}

int ambulo__mirror_agrees(unsigned n, const double *from, const double *to,
                          const double *gradient) {
  double missed = 0.0, size = 0.0, place = 0.0;
  for (unsigned j = 0; j < n; j++) {
    double step = to[j] - from[j];
    missed += (step + gradient[j]) * (step + gradient[j]);
    size += gradient[j] * gradient[j];
    place += to[j] * to[j];
  }
  return sqrt(missed) <= first_step * sqrt(size) + rounding * sqrt(place);
}

/* ------------------------------------------------------------------------- memory */

/* glibc keeps freed blocks of up to 1032 bytes for requests of their own size class; larger ones
 * are cut up for whatever comes next. So every block asked for here is larger than that. */
enum { MOST_BLOCKS = 4 };
static const size_t smallest = 4096; /* bytes: more than NLopt's options, and than is cached */

static int can_take(int count, const size_t *doubles) {
  void *block[MOST_BLOCKS];
  int all = 1;
  for (int i = 0; i < count; i++) {
    block[i] = malloc(doubles[i] * sizeof(double) + smallest);
    all = all && block[i];
  }
  for (int i = 0; i < count; i++) free(block[i]);
  return all;
}

int ambulo__nlopt_can_copy(unsigned n) {
  return can_take(4, (const size_t[]){0, n, n, n});
}

int ambulo__nlopt_can_descend(unsigned n, unsigned storage) {
  size_t width = n > storage ? n : storage, rows = storage > 1 ? storage : 1;
  return can_take(3, (const size_t[]){n, n, 4 * (size_t)n + 2 * rows * n + 2 * width});
}
