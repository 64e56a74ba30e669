/* method/augmented.c - the function that the inner solver minimizes.
 *
 *     F(w) = f(y) + sum_i ( p_i^2 - lambda_i^2 ) / (2 rho),   p = max(0, lambda + rho v(y)),
 *     y = R(x_k + L^-T w)
 *
 * with R the retraction and L L' the metric of the model step: in w the metric is the
 * identity, which is what every solver starts from. Gradient: with G = grad f + sum p grad v
 * and z of equalities.c (A),  dF/dw = L^-1 H z = L' z.
 *
 * The last point is kept: NLopt asks for values and gradients of objective and constraint
 * separately.
 *
 * A point that cannot be reached, or where something is not finite, gets a value of a bowl above
 * everything seen since the iterate was set, F_max + (1 + |F_max|) (1 + |w|^2): no scale of the
 * objective makes it look like a descent, and its slope sends line searches back.
 */
#include "method/augmented.h"

#include "base/arithmetic.h"
#include "method/equalities.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/point.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__last_point_create(ambulo__engine *e) {
  const ambulo__setup *s = e->setup;
  ambulo__last_point *last = ambulo__pool_blocks(&e->pool, 1, sizeof *last);
  if (!last) return AMBULO_E_MEMORY;
  e->last = last;
  last->w = ambulo__pool_doubles(&e->pool, (size_t)s->n);
  last->gradient = ambulo__pool_doubles(&e->pool, (size_t)s->n);
  ambulo__last_point_forget(e);
  return ambulo__trial_create(s->n, s->inequalities, s->equalities, &e->pool, &last->trial);
}

void ambulo__last_point_forget(ambulo__engine *e) {
  e->last->is_there = 0;
  e->last->ceiling = -HUGE_VAL;
}

/* (P.7): value at w; HUGE_VAL when there is no point */
static void evaluate(ambulo__engine *e, const double *w) {
  const ambulo__setup *s = e->setup;
  const ambulo__iterate *iterate = &e->iterate;
  ambulo__last_point *last = e->last;
  ambulo__trial *trial = &last->trial;
  memcpy(last->w, w, (size_t)s->n * sizeof *w);
  memcpy(trial->x, w, (size_t)s->n * sizeof *w);
  trial->value = HUGE_VAL;
  last->is_there = 1;
  last->has_gradient = 0;
  ambulo__run_count(e->run);
  ambulo__band_backward(&e->linearized.whitener, trial->x);
  for (int j = 0; j < s->n; j++) trial->x[j] += iterate->x[j];
  if (!ambulo__retract(e, trial->x)) return;
  trial->violation = ambulo__engine_excess(e, trial->excess);
  trial->objective = s->objective_scale * e->workspace->objective;
  double sum = 0.0;
  for (int i = 0; i < s->inequalities; i++) {
    double p = ambulo__worse(0.0, iterate->lambda[i] + iterate->rho * trial->excess[i]);
    trial->multiplier[i] = p;
    sum += p * p - iterate->lambda[i] * iterate->lambda[i];
  }
  trial->value = trial->objective + sum / (2.0 * iterate->rho);
  trial->gradient_norm = -1.0;
  if (trial->value < HUGE_VAL && trial->value > last->ceiling) last->ceiling = trial->value;
}

/* gradient at the last point; without one the point is rejected */
static void differentiate(ambulo__engine *e) {
  const ambulo__setup *s = e->setup;
  ambulo__last_point *last = e->last;
  ambulo__trial *trial = &last->trial;
  double sum = 0.0, *l = e->iterate.equality_multiplier;
  last->has_gradient = 1;
  if (ambulo__reduced_gradient(e, s->objective_scale, trial->multiplier, l, last->gradient)) {
    trial->value = HUGE_VAL;
    return;
  }
  memcpy(trial->equality_multiplier, l, (size_t)s->equalities * sizeof *l);
  ambulo__band_upper_multiply(&e->linearized.whitener, last->gradient);
  for (int j = 0; j < s->n; j++) sum += last->gradient[j] * last->gradient[j];
  trial->gradient_norm = sqrt(sum);
  if (!isfinite(sum)) trial->value = HUGE_VAL;
}

/* the bowl: see above */
static double given_up(const ambulo__last_point *last, int n, const double *w, double *gradient) {
  double top = last->ceiling > -HUGE_VAL ? last->ceiling : 0.0;
  double height = 1.0 + fabs(top), sum = 1.0;
  for (int j = 0; j < n; j++) sum += w[j] * w[j];
  for (int j = 0; gradient && j < n; j++) gradient[j] = 2.0 * height * w[j];
  return top + height * sum;
}

/* (P.6) F at y = R(x_k + L^-T w), and its gradient by w */
double ambulo__augmented(ambulo__engine *e, const double *w, double *gradient) {
  ambulo__last_point *last = e->last;
  size_t bytes = (size_t)e->setup->n * sizeof *w;
  int same = last->is_there && memcmp(w, last->w, bytes) == 0;
  if (!same) evaluate(e, w);
  if (last->trial.value < HUGE_VAL && gradient && !last->has_gradient) differentiate(e);
  if (!(last->trial.value < HUGE_VAL)) return given_up(last, e->setup->n, w, gradient);
  if (gradient) memcpy(gradient, last->gradient, bytes);
  return last->trial.value;
}

/* see augmented.h */

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
  ambulo__last_point_forget(e);
  c->start = ambulo__augmented(e, c->whitened, c->gradient);
  if (!(e->last->trial.value < HUGE_VAL)) return 0;
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
