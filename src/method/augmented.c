/* method/augmented.c - the function that the inner solver minimizes.
 *
 *     F(w) = f(y) + sum_i ( p_i^2 - lambda_i^2 ) / (2 rho),   p = max(0, lambda + rho v(y)),
 *     y = R(y_k + L^-T w)
 *
 * with R the retraction and L L' the metric of the model step: in w the metric is the
 * identity, which is what every solver starts from. Gradient: with G = grad f + sum p grad v
 * and z of retraction.c (A),  dF/dw = L^-1 H z = L' z.
 *
 * The last point is held: NLopt asks for values and gradients of objective and constraint
 * separately.
 *
 * A point that cannot be reached, or where something is not finite, gets a value of a bowl above
 * everything seen since the centre was set, F_max + (1 + |F_max|) (1 + |w|^2): no scale of the
 * objective makes it look like a descent, and its slope sends line searches back.
 */
#include "method/engine.h"
#include "base/worst.h"

#include <math.h>
#include <string.h>

void ambulo__trial_copy(const ambulo__engine *e, const ambulo__trial *from, ambulo__trial *to) {
  to->value = from->value;
  to->objective = from->objective;
  to->violation = from->violation;
  to->gradient_norm = from->gradient_norm;
  memcpy(to->x, from->x, (size_t)e->n * sizeof *to->x);
  memcpy(to->excess, from->excess, (size_t)e->inequalities * sizeof *to->excess);
  memcpy(to->multiplier, from->multiplier, (size_t)e->inequalities * sizeof *to->multiplier);
  memcpy(to->equality_multiplier, e->equality_multiplier,
         (size_t)e->equalities * sizeof *to->equality_multiplier);
}

/* (P.7): value at w into engine->held; HUGE_VAL as value when there is no point */
static void evaluate(ambulo__engine *e, const double *w) {
  ambulo__trial *held = &e->held;
  memcpy(e->w, w, (size_t)e->n * sizeof *w);
  memcpy(held->x, w, (size_t)e->n * sizeof *w);
  held->value = HUGE_VAL;
  e->has_held = 1;
  e->has_held_gradient = 0;
  ambulo__run_count(e->run);
  ambulo__band_backward(&e->whitener, held->x);
  for (int j = 0; j < e->n; j++) held->x[j] += e->center[j];
  if (!ambulo__retract(e, held->x)) return;
  held->violation = ambulo__engine_excess(e, held->excess);
  held->objective = e->objective_scale * e->workspace->objective;
  double sum = 0.0;
  for (int i = 0; i < e->inequalities; i++) {
    double p = ambulo__worse(0.0, e->lambda[i] + e->rho * held->excess[i]);
    held->multiplier[i] = p;
    sum += p * p - e->lambda[i] * e->lambda[i];
  }
  held->value = held->objective + sum / (2.0 * e->rho);
  held->gradient_norm = -1.0;
  if (!isfinite(held->value)) held->value = HUGE_VAL;
  if (held->value < HUGE_VAL && held->value > e->ceiling) e->ceiling = held->value;
}

/* gradient at the point held into engine->w_gradient; without one the point is given up */
static void differentiate(ambulo__engine *e) {
  ambulo__trial *held = &e->held;
  double sum = 0.0;
  e->has_held_gradient = 1;
  if (ambulo__reduced_gradient(e, held->multiplier, e->w_gradient)) {
    held->value = HUGE_VAL;
    return;
  }
  ambulo__band_upper_multiply(&e->whitener, e->w_gradient);
  for (int j = 0; j < e->n; j++) sum += e->w_gradient[j] * e->w_gradient[j];
  held->gradient_norm = sqrt(sum);
  if (!isfinite(sum)) held->value = HUGE_VAL;
}

/* the bowl: see above */
static double given_up(const ambulo__engine *e, const double *w, double *gradient) {
  double top = e->ceiling > -HUGE_VAL ? e->ceiling : 0.0, height = 1.0 + fabs(top), sum = 1.0;
  for (int j = 0; j < e->n; j++) sum += w[j] * w[j];
  for (int j = 0; gradient && j < e->n; j++) gradient[j] = 2.0 * height * w[j];
  return top + height * sum;
}

/* (P.6) F at y = R(y_k + L^-T w), and its gradient by w */
double ambulo__augmented(ambulo__engine *e, const double *w, double *gradient) {
  int same = e->has_held && memcmp(w, e->w, (size_t)e->n * sizeof *w) == 0;
  if (!same) evaluate(e, w);
  if (e->held.value < HUGE_VAL && gradient && !e->has_held_gradient) differentiate(e);
  if (!(e->held.value < HUGE_VAL)) return given_up(e, w, gradient);
  if (gradient) memcpy(gradient, e->w_gradient, (size_t)e->n * sizeof *gradient);
  return e->held.value;
}
