/* linear/kkt.c - see kkt.h.
 *
 * With a diagonal S > 0, M = H + J'SJ and any l_0, the method of multipliers
 *
 *     M d_i + C' m_i = a + J' (S h - l_i),   C d_i = b,   l_{i+1} = l_i + S (J d_i - h)
 *
 * converges to the solution of (KKT): the error of the multipliers shrinks each pass by
 * 1 / (1 + s) or more, s the smallest eigenvalue of S^1/2 J H^-1 J' S^1/2. With S large three
 * passes reach rounding, and M stays banded and positive definite: a Cholesky factor of the
 * band of H replaces the LU factor of the interleaved, indefinite and wider KKT matrix.
 * Dependent rows do no harm: M does not notice them. Rows that nearly depend on each other
 * make s small: S is then raised for the next factorization.
 *
 * Border rows by their Schur complement (border.h); rows that H gains or loses, a few at a time, by
 * theirs (border.h).
 *
 * Every pass moves d by M^-1 J'(...) only, that is within H^-1 range(J', C'): retractions
 * built from single passes stay on the same curved surface as exact solves would
 * (equalities.c).
 */
#include "linear/kkt.h"
#include "linear/parameters.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__kkt_create(const ambulo__sparse_rows *equality,
                                 const ambulo__sparse_rows *border, int kd, ambulo__pool *pool,
                                 ambulo__kkt *kkt) {
  kkt->stiffness = AMBULO__STIFFNESS_START;
  kkt->most_stiffness = AMBULO__STIFFNESS_LARGEST;
  kkt->equality = equality;
  kkt->n = equality->problem->variables;
  kkt->equalities = equality->count;
  size_t e = (size_t)kkt->equalities;
  ambulo_status status = ambulo__band_create(pool, kkt->n, kd, &kkt->factor);
  if (!status) status = ambulo__border_create(border, pool, &kkt->border);
  if (!status) status = ambulo__update_create(&kkt->factor, &kkt->border, pool, &kkt->update);
  if (status) return status;
  kkt->penalty = ambulo__pool_doubles(pool, e);
  kkt->residual = ambulo__pool_doubles(pool, e);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* S_i: stiffness times the largest curvature of H, for unit |J_i|; where that drowns H (fine grids:
 * the curvature of smooth motions is (T/K)^4 of the largest, and S is on top of it), stiffness
 * times what the diagonal D of H opposes to a change of the row, 1 / (J D^-1 J'): then no unknown's
 * diagonal grows by more than the stiffness. */
static void set_penalties(ambulo__kkt *kkt, const ambulo__band *h) {
  const ambulo__sparse_rows *rows = kkt->equality;
  double largest = ambulo__band_largest(h);
  for (int i = 0; i < kkt->equalities; i++) {
    double length = kkt->by_row ? ambulo__band_row_length(h, rows, i)
                                : ambulo__sparse_rows_norm(rows, i) / sqrt(largest);
    kkt->penalty[i] = length > 0.0 ? kkt->stiffness / (length * length) : 0.0;
  }
}

static int factor(ambulo__kkt *kkt, const ambulo__band *h) {
  ambulo__band_copy(h, &kkt->factor);
  set_penalties(kkt, h);
  for (int i = 0; i < kkt->equalities; i++)
    ambulo__band_add_sparse(&kkt->factor, kkt->equality, i, kkt->penalty[i]);
  if (ambulo__band_factor(&kkt->factor)) return 1;
  /* a border row that the local rows imply would make the complement singular */
  return ambulo__border_factor(&kkt->border, &kkt->factor, NULL, 0.0, AMBULO__BORDER_SHIFT);
}

int ambulo__kkt_factor(ambulo__kkt *kkt, const ambulo__band *h) {
  ambulo__update_clear(&kkt->update);
  while (factor(kkt, h)) { /* H drowned, or is not positive definite */
    if (!kkt->by_row) {
      kkt->by_row = kkt->stiffness <= AMBULO__STIFFNESS_START;
      kkt->stiffness = AMBULO__STIFFNESS_START;
    } else if (kkt->stiffness > AMBULO__STIFFNESS_LEAST) {
      kkt->stiffness = kkt->most_stiffness = AMBULO__STIFFNESS_LEAST;
    } else {
      return 1;
    }
  }
  return 0;
}

int ambulo__kkt_renew(ambulo__kkt *kkt, const ambulo__band *h) {
  return ambulo__update_factor(&kkt->update) ? ambulo__kkt_factor(kkt, h) : 0;
}

void ambulo__kkt_pass(ambulo__kkt *kkt, double *right, const double *b, double *m) {
  const ambulo__border *border = &kkt->border;
  ambulo__band_forward(&kkt->factor, right);
  ambulo__border_eliminate(&kkt->border, b, right);
  ambulo__update_eliminate(&kkt->update, b, right);
  if (m && border->count) memcpy(m, border->rest, (size_t)border->count * sizeof *m);
  ambulo__band_backward(&kkt->factor, right);
}

/* residual = J d - h; returns the size of what is left, relative to the size of the parts */
static double equality_error(ambulo__kkt *kkt, const double *h, const double *d) {
  const ambulo__sparse_rows *rows = kkt->equality;
  double worst = 0.0, size = 0.0;
  for (int i = 0; i < kkt->equalities; i++) {
    double sum = h ? -h[i] : 0.0, parts = fabs(sum);
    for (int e = rows->start[i]; e < rows->start[i + 1]; e++) {
      double part = rows->value[e] * d[rows->column[e]];
      sum += part;
      parts += fabs(part);
    }
    kkt->residual[i] = sum;
    worst = ambulo__worse(worst, fabs(sum));
    size = ambulo__worse(size, parts);
  }
  return size == 0.0 ? 0.0 : worst / size;
}

/* (P.3) passes of the method of multipliers */
void ambulo__kkt_solve(ambulo__kkt *kkt, const double *a, const double *h, const double *b,
                       double *d, double *l, double *m) {
  size_t n = (size_t)kkt->n;
  double before = HUGE_VAL, error = 0.0;
  for (int pass = 0; pass < AMBULO__KKT_PASSES; pass++) {
    for (int i = 0; i < kkt->equalities; i++)
      kkt->residual[i] = (h ? kkt->penalty[i] * h[i] : 0.0) - l[i];
    if (a) {
      memcpy(d, a, n * sizeof *d);
    } else {
      memset(d, 0, n * sizeof *d);
    }
    ambulo__sparse_rows_add_transpose(kkt->equality, 1.0, kkt->residual, d);
    ambulo__kkt_pass(kkt, d, b, m);
    error = equality_error(kkt, h, d);
    for (int i = 0; i < kkt->equalities; i++) l[i] += kkt->penalty[i] * kkt->residual[i];
    if (error <= AMBULO__ROUNDING || !(error <= AMBULO__KKT_PROGRESS * before)) break;
    before = error;
  }
  if (error > AMBULO__KKT_SLOW) {
    kkt->stiffness = fmin(kkt->most_stiffness, AMBULO__STIFFNESS_FACTOR * kkt->stiffness);
    kkt->update.full = 1; /* which takes a factor */
  }
}

/* ------------------------------------------------------------------- mixing
 *
 * Images g_j = G(y_j) with residuals r_j (Anderson 1965; Walker & Ni 2011): with
 * differences to the newest pair, minimize |r - sum_i c_i (r - r_i)| over c and return
 * g - sum_i c_i (g - g_i). For a linear map this is GMRES without its factorization; the
 * few normal equations are regularized and solved by Cholesky.
 */

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
