/* method/smooth.c - see smooth.h.
 *
 * A start of the caller may be rough: noise on its control points, a straight line over the index
 * of the control points, a motion from another grid. A hundredth of a radian from one control
 * point to the next is tens of rad/s^2, and torques to match. With x_0 the start, the smoothed one
 * is
 *
 *     minimize  sum_j m |x_j - x_0j|^2 / s_j^2  +  sum_k w_k sum_i |qdd_ik|^2 / a^2
 *
 * m = T/K the time of a control point, w_k the quadrature: the likeliest motion when the start is
 * off by about s (2 cm, 0.02 rad; unknowns that are rates: s sqrt(a / s)) and accelerations are
 * about a = 30 rad/s^2, m/s^2 (those of a swinging leg). It is a low-pass filter without lag, whose
 * amplitude is halved at sqrt(a / s) = 39 rad/s = 6 Hz, where gait data are filtered (Winter 2009).
 *
 * A start that loses no more than half of its squared accelerations is not rough and stays.
 * Otherwise both are carried to the equalities (restore.c), and the one with the lower objective
 * plus penalty on the inequalities is the start: an optimum is not smoothed away.
 */
#include "method/smooth.h"
#include "method/parameters.h"
#include "base/worst.h"

#include <math.h>
#include <string.h>

/* integral of |qdd|^2 / a^2 at the point held */
static double bending(const ambulo__engine *e) {
  const ambulo_workspace *w = e->workspace;
  const ambulo_problem *p = e->problem;
  double sum = 0.0;
  for (int k = 0; k < p->nodes; k++) {
    for (int i = 0; i < p->coordinates; i++) {
      int channel = ambulo__channel_qdd(&p->channels, i);
      double qdd =
          w->channel[ambulo__lane_index(k, w->channel_count, channel)] / AMBULO__ROUGH_ACCELERATION;
      sum += p->quadrature[k] * qdd * qdd;
    }
  }
  return sum;
}

/* the matrix of the quadratic, factored, in engine->base; its diagonal part in engine->step.
 * 1 when it cannot be factored */
static int assemble(ambulo__engine *e) {
  const ambulo_problem *p = e->problem;
  double time = p->definition.duration / (double)ambulo__basis_intervals(p->basis);
  double rate = sqrt(AMBULO__ROUGH_DEVIATION * AMBULO__ROUGH_ACCELERATION);
  ambulo__metric_accelerations(&e->metric, e->workspace,
                               1.0 / (AMBULO__ROUGH_ACCELERATION * AMBULO__ROUGH_ACCELERATION),
                               &e->base);
  for (int j = 0; j < e->n; j++) {
    int is_value = 1;
    (void)ambulo__basis_abscissa(p->basis, j / p->coordinates, &is_value);
    double size = is_value ? AMBULO__ROUGH_DEVIATION : rate;
    e->step[j] = time / (size * size);
    e->base.a[(size_t)j * (size_t)e->base.ld] += e->step[j];
  }
  return ambulo__band_factor(&e->base);
}

/* objective and penalty after x was carried to the equalities; HUGE_VAL when it could not be */
static double merit(ambulo__engine *e, double *x) {
  double error, sum = 0.0;
  if (ambulo__restore(e, x, &error) || ambulo__evaluate(e->workspace, x)) return HUGE_VAL;
  ambulo__engine_excess(e, e->held.excess);
  for (int i = 0; i < e->inequalities; i++) {
    double v = ambulo__worse(0.0, e->held.excess[i]);
    sum += v * v;
  }
  double value = e->objective_scale * e->workspace->objective + 0.5 * AMBULO__PENALTY_START * sum;
  return error <= AMBULO__RESTORED && isfinite(value) ? value : HUGE_VAL;
}

int ambulo__smooth_curve(ambulo__engine *e, const double *x, double *smooth) {
  if (ambulo__evaluate_jacobian(e->workspace, x) || assemble(e)) return 1;
  for (int j = 0; j < e->n; j++) smooth[j] = e->step[j] * x[j];
  ambulo__band_forward(&e->base, smooth);
  ambulo__band_backward(&e->base, smooth);
  return 0;
}

/* (P.2b) the smoothest motion near x */
int ambulo__smooth_start(ambulo__engine *e, double *x) {
  size_t bytes = (size_t)e->n * sizeof *x;
  double *smooth = e->total, *rough = e->iterate;
  if (ambulo__smooth_curve(e, x, smooth)) return 0;
  double before = bending(e);
  if (ambulo__evaluate(e->workspace, smooth) || bending(e) > AMBULO__ROUGH_KEPT * before) return 0;
  memcpy(rough, x, bytes);
  double interval = e->problem->definition.duration / ambulo__basis_intervals(e->problem->basis);
  e->mu = AMBULO__DAMPING_START * interval;
  double of_rough = merit(e, rough), of_smooth = merit(e, smooth);
  if (!(of_smooth < of_rough)) return 0;
  memcpy(x, smooth, bytes);
  return 1;
}
