/* method/mirror.c - see mirror.h */
#include "method/mirror.h"

#include <math.h>
#include <string.h>

static const double least_penalty = 1e-6, first_penalty = 10.0; /* NLopt's */
static const double growth = 10.0, enough = 0.5;                /* gam and tau there */
static const double largest_multiplier = 1e20;

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
  wanted = first_penalty < wanted ? first_penalty : wanted;
  m->penalty = m->rows == 0 ? 1.0 : least_penalty > wanted ? least_penalty : wanted;
  m->measure = HUGE_VAL;
  m->updates = 0;
}

/* (P.11) NLopt's rule for mu and rho */
int ambulo__mirror_update(ambulo__mirror *m, const double *row) {
  double before = m->measure;
  m->measure = 0.0;
  for (int i = 0; i < m->rows; i++) {
    double next = m->multiplier[i] + m->penalty * row[i];
    double slack = -m->multiplier[i] / m->penalty;
    double left = fabs(row[i] > slack ? row[i] : slack);
    m->measure = m->measure > left ? m->measure : left;
    m->multiplier[i] = next < 0.0 ? 0.0 : next < largest_multiplier ? next : largest_multiplier;
  }
  m->updates++;
  if (!(m->measure > enough * before)) return 0;
  m->penalty *= growth;
  return 1;
}
