/* show/principal.c - see principal.h. */
#include "show/principal.h"

#include <math.h>

#include "base/lapack.h"

enum { EVERY = 4 };

/* G [n][n], lower triangle */
static ambulo_status products(const ambulo__motions *m, const double *mean,
                              const ambulo_allocator *a, double *g) {
  size_t values = ambulo__motion_values(m), few = (values + EVERY - 1) / EVERY;
  double *row = ambulo__alloc(a, values, sizeof *row);
  double *thin = ambulo__alloc(a, few * (size_t)m->count, sizeof *thin);
  ambulo_status status = row && thin ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; i < m->count && !status; i++) {
    ambulo__motion_row(m, i, row);
    for (size_t k = 0; k < few; k++) thin[(size_t)i * few + k] = row[EVERY * k] - mean[EVERY * k];
  }
  const double one = 1.0, zero = 0.0;
  const int length = (int)few;
  if (!status) dsyrk_("L", "T", &m->count, &length, &one, thin, &length, &zero, g, &m->count);
  ambulo__free(a, thin);
  ambulo__free(a, row);
  return status;
}

/* g becomes its eigenvectors, w their eigenvalues, rising */
static ambulo_status eigenvectors(int n, const ambulo_allocator *a, double *g, double *w) {
  double size;
  int integers, info = 0;
  const int ask = -1;
  dsyevd_("V", "L", &n, g, &n, w, &size, &ask, &integers, &ask, &info);
  if (info != 0) return AMBULO_E_INTERNAL;
  const int length = (int)size;
  double *work = ambulo__alloc(a, (size_t)length, sizeof *work);
  int *more = ambulo__alloc(a, (size_t)integers, sizeof *more);
  ambulo_status status = work && more ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) dsyevd_("V", "L", &n, g, &n, w, work, &length, more, &integers, &info);
  ambulo__free(a, more);
  ambulo__free(a, work);
  return status ? status : info ? AMBULO_E_INTERNAL : AMBULO_OK;
}

ambulo_status ambulo__principal_weights(const ambulo__motions *motions, const double *mean,
                                        const ambulo_allocator *allocator, double *weights,
                                        double *left) {
  int n = motions->count;
  size_t size = (size_t)n;
  double *g = ambulo__alloc(allocator, size * size, sizeof *g);
  double *w = ambulo__alloc(allocator, size, sizeof *w);
  ambulo_status status = g && w ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = products(motions, mean, allocator, g);
  if (!status) status = eigenvectors(n, allocator, g, w);
  double sum = 0.0;
  size_t values = (ambulo__motion_values(motions) + EVERY - 1) / EVERY;
  for (int k = 0; k < n && !status; k++) {
    sum += fmax(w[k], 0.0);
    left[n - 1 - k] = sum / ((double)values * n);
  }
  for (int k = 0; k < n && !status; k++)
    for (int i = 0; i < n; i++)
      weights[(size_t)k * size + (size_t)i] = sqrt(n) * g[(size_t)(n - 1 - k) * size + (size_t)i];
  ambulo__free(allocator, w);
  ambulo__free(allocator, g);
  return status;
}
