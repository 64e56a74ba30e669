/* method/chart.c - see chart.h */
#include "method/chart.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

static double dot(const double *a, const double *b, int n) {
  double sum = 0.0;
  for (int j = 0; j < n; j++) sum += a[j] * b[j];
  return sum;
}

ambulo_status ambulo__chart_create(int n, ambulo__pool *pool, ambulo__chart *c) {
  memset(c, 0, sizeof *c);
  double **vectors[] = {&c->origin, &c->step, &c->turn, &c->whitened, &c->gradient};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    *vectors[i] = ambulo__pool_doubles(pool, (size_t)n);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* (P.10) s and a for which NLopt's first step is the model step */
int ambulo__chart_lay(ambulo__chart *c, ambulo__engine *e, const double *w, double stretch) {
  int n = e->n;
  size_t bytes = (size_t)n * sizeof *w;
  double share = ambulo__engine_step_limit(e, e->total, AMBULO__MODEL_STEP_CAP);
  memcpy(c->origin, w, bytes);
  memset(c->turn, 0, bytes);
  c->stretch = stretch;
  ambulo__band_upper_multiply(&e->whitener, e->total);
  for (int j = 0; j < n; j++) c->step[j] = share * e->total[j];
  memset(c->whitened, 0, bytes);
  e->has_held = 0;
  e->ceiling = -HUGE_VAL;
  c->start = ambulo__augmented(e, c->whitened, c->gradient);
  if (!(e->held.value < HUGE_VAL)) return 0;
  double slope = dot(c->gradient, c->step, n), size = dot(c->step, c->step, n);
  double steep = dot(c->gradient, c->gradient, n);
  if (slope < 0.0 && slope * slope > AMBULO__COSINE_LEAST * AMBULO__COSINE_LEAST * steep * size) {
    double share_of_step = 1.0 / sqrt(-slope * size);
    for (int j = 0; j < n; j++) c->turn[j] = share_of_step * c->step[j] - c->gradient[j] / slope;
  } else {
    memset(c->step, 0, bytes);
  }
  return 1;
}

double ambulo__chart_value(ambulo__chart *c, ambulo__engine *e, const double *w, double *gradient) {
  int n = e->n;
  for (int j = 0; j < n; j++) c->whitened[j] = (w[j] - c->origin[j]) / c->stretch;
  double turned = dot(c->turn, c->whitened, n);
  for (int j = 0; j < n; j++) c->whitened[j] += turned * c->step[j];
  double value = ambulo__augmented(e, c->whitened, gradient);
  if (!gradient) return value;
  turned = dot(c->step, gradient, n);
  for (int j = 0; j < n; j++) gradient[j] = (gradient[j] + turned * c->turn[j]) / c->stretch;
  return value;
}
