/* method/chart.c - see chart.h */
#include "method/chart.h"
#include "method/augmented.h"
#include "method/engine_point.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/retraction.h"

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
  int n = e->setup->n;
  size_t bytes = (size_t)n * sizeof *w;
  const double *model_step = e->quadratic->total;
  double part = ambulo__step_limit(e->setup, model_step, AMBULO__MODEL_STEP_CAP);
  memcpy(c->origin, w, bytes);
  memset(c->turn, 0, bytes);
  c->stretch = stretch;
  memcpy(c->step, model_step, bytes);
  ambulo__band_upper_multiply(&e->linearized.whitener, c->step);
  for (int j = 0; j < n; j++) c->step[j] *= part;
  memset(c->whitened, 0, bytes);
  ambulo__held_forget(e);
  c->start = ambulo__augmented(e, c->whitened, c->gradient);
  if (!(e->held->trial.value < HUGE_VAL)) return 0;
  double slope = dot(c->gradient, c->step, n), size = dot(c->step, c->step, n);
  if (slope < 0.0) {
    double length = 1.0 / sqrt(-slope * size);
    for (int j = 0; j < n; j++) c->turn[j] = length * c->step[j] - c->gradient[j] / slope;
  } else {
    memset(c->step, 0, bytes);
  }
  return 1;
}

/* by whitened coordinates to by w */
static void turn_gradient(const ambulo__chart *c, int n, double *gradient) {
  double turned = dot(c->step, gradient, n);
  for (int j = 0; j < n; j++) gradient[j] = (gradient[j] + turned * c->turn[j]) / c->stretch;
}

double ambulo__chart_value(ambulo__chart *c, ambulo__engine *e, const double *w, double *gradient) {
  int n = e->setup->n;
  for (int j = 0; j < n; j++) c->whitened[j] = (w[j] - c->origin[j]) / c->stretch;
  double turned = dot(c->turn, c->whitened, n);
  for (int j = 0; j < n; j++) c->whitened[j] += turned * c->step[j];
  double value = ambulo__augmented(e, c->whitened, gradient);
  if (gradient) turn_gradient(c, n, gradient);
  return value;
}

void ambulo__chart_gradient(const ambulo__chart *c, ambulo__engine *e, double scale,
                            const double *p, double *l, double *gradient) {
  int n = e->setup->n;
  if (ambulo__reduced_gradient(e, scale, p, l, gradient)) {
    memset(gradient, 0, (size_t)n * sizeof *gradient);
    return;
  }
  ambulo__band_upper_multiply(&e->linearized.whitener, gradient);
  turn_gradient(c, n, gradient);
}
