/* method/mirror.c - see mirror.h */
#include "method/mirror.h"

#include <math.h>
#include <string.h>

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
