/* tests/support/metric_along.h - the curvature that the metric has along a direction. */
#ifndef AMBULO_TESTS_METRIC_ALONG_H
#define AMBULO_TESTS_METRIC_ALONG_H

#include "method/metric.h"
#include "problem/nlp.h"
#include "support/test.h"

/* d'H d at x, found for an objective times 1.7 and divided by it */
static inline double metric_along(ambulo_workspace *w, const double *x, const double *d) {
  const ambulo_problem *p = w->problem;
  const double scale = 1.7;
  ambulo__pool pool;
  ambulo__metric metric;
  ambulo__band h;
  double *hd = calloc((size_t)p->variables, sizeof *hd), sum = 0.0;
  ambulo__pool_init(&pool, NULL);
  assert_int_equal(ambulo__metric_create(p, &pool, &metric), AMBULO_OK);
  assert_int_equal(ambulo__band_create(&pool, p->variables, ambulo__metric_diagonals(p), &h),
                   AMBULO_OK);
  assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
  ambulo__metric_fill(&metric, w, scale, &h);
  ambulo__band_multiply(&h, d, hd);
  for (int j = 0; j < p->variables; j++) sum += d[j] * hd[j];
  ambulo__pool_clear(&pool);
  free(hd);
  return sum / scale;
}

#endif
