/* linear/mixing.c - see mixing.h.
 *
 * Images g_j = G(y_j) with residuals r_j (Anderson 1965; Walker & Ni 2011): with
 * differences to the newest pair, minimize |r - sum_i c_i (r - r_i)| over c and return
 * g - sum_i c_i (g - g_i). For a linear map this is GMRES without its factorization; the
 * few normal equations are regularized and solved by Cholesky.
 */
#include "linear/mixing.h"
#include "linear/parameters.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__mixing_create(ambulo__pool *pool, int points, int residuals,
                                    ambulo__mixing *m) {
  memset(m, 0, sizeof *m);
  m->points = points;
  m->residuals = residuals;
  for (int i = 0; i < AMBULO__MIXING_DEPTH; i++) {
    m->point[i] = ambulo__pool_doubles(pool, (size_t)points);
    m->residual[i] = ambulo__pool_doubles(pool, (size_t)residuals);
  }
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__mixing_reset(ambulo__mixing *m) {
  m->count = m->next = 0;
}

/* solves the k x k system a c = b, a positive definite; 0 on success */
static int solve(int k, double a[][AMBULO__MIXING_DEPTH], double *b) {
  for (int j = 0; j < k; j++) {
    for (int i = j; i < k; i++) {
      for (int l = 0; l < j; l++) a[i][j] -= a[i][l] * a[j][l];
      if (i == j) {
        if (!(a[j][j] > 0.0)) return 1;
        a[j][j] = sqrt(a[j][j]);
      } else {
        a[i][j] /= a[j][j];
      }
    }
  }
  for (int i = 0; i < k; i++) {
    for (int l = 0; l < i; l++) b[i] -= a[i][l] * b[l];
    b[i] /= a[i][i];
  }
  for (int i = k - 1; i >= 0; i--) {
    for (int l = i + 1; l < k; l++) b[i] -= a[l][i] * b[l];
    b[i] /= a[i][i];
  }
  return 0;
}

/* coefficients c of the older pairs; 0 when they cannot be had */
static int coefficients(const ambulo__mixing *m, const double *r, double *c) {
  double a[AMBULO__MIXING_DEPTH][AMBULO__MIXING_DEPTH] = {{0.0}};
  double trace = 0.0;
  for (int i = 0; i < m->count; i++) {
    c[i] = 0.0;
    for (int e = 0; e < m->residuals; e++) c[i] += (r[e] - m->residual[i][e]) * r[e];
    for (int j = 0; j <= i; j++) {
      for (int e = 0; e < m->residuals; e++)
        a[i][j] += (r[e] - m->residual[i][e]) * (r[e] - m->residual[j][e]);
    }
    trace += a[i][i];
  }
  for (int i = 0; i < m->count; i++) a[i][i] += AMBULO__MIXING_REGULARIZATION * trace;
  return solve(m->count, a, c) == 0;
}

/* (P.8) Anderson mixing */
void ambulo__mixing_apply(ambulo__mixing *m, const double *residual, double *image) {
  double c[AMBULO__MIXING_DEPTH];
  int usable = m->count > 0 && coefficients(m, residual, c);
  int slot = m->next, held = m->count;
  double own = 1.0;
  for (int i = 0; usable && i < held; i++) own -= c[i];
  for (int e = 0; e < m->points; e++) {
    double mixed = own * image[e], plain = image[e];
    for (int i = 0; usable && i < held; i++) mixed += c[i] * m->point[i][e];
    m->point[slot][e] = plain;
    if (usable) image[e] = mixed;
  }
  memcpy(m->residual[slot], residual, (size_t)m->residuals * sizeof *residual);
  m->next = (slot + 1) % AMBULO__MIXING_DEPTH;
  if (m->count < AMBULO__MIXING_DEPTH) m->count++;
}
