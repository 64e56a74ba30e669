/* method/objective_scale.c - the curvature of the objective along accelerations, for its scale
 * (metric.h). */
#include "method/metric.h"
#include "method/parameters.h"
#include "problem/callbacks.h"

static const double pi = 3.14159265358979323846;

/* |dy / dqdd|^2 of a channel, for a motion with the period of the slowest: half a wave within the
 * duration, w = pi / T, along which q = qdd / w^2 and qd = qdd / w. For a torque dy / dqdd is a row
 * of the mass matrix; what it depends on q and qd is left out, which counts as little as gravity
 * beside inertia. */
static double acceleration_slope(const ambulo_workspace *workspace, int node, int channel) {
  const ambulo_problem *p = workspace->problem;
  int d = p->coordinates, output = channel - ambulo__channel_outputs(&p->channels);
  double w = pi / p->definition.duration, by_rate = 1.0 / (w * w), by_value = by_rate * by_rate;
  if (output < 0) return channel / d == 0 ? by_value : channel / d == 1 ? by_rate : 1.0;
  const double *slope = workspace->motion_scratch;
  double value = 0.0, rate = 0.0, acceleration = 0.0;
  ambulo__output_gradient(workspace, node, output, workspace->motion_scratch);
  for (int i = 0; i < d; i++) {
    value += slope[i] * slope[i];
    rate += slope[d + i] * slope[d + i];
    acceleration += slope[2 * d + i] * slope[2 * d + i];
  }
  if (output < d + 6) return acceleration;
  return by_value * value + by_rate * rate + acceleration;
}

/* of the terms of the caller */
static double user_acceleration_curvature(const ambulo__metric *metric,
                                          const ambulo_workspace *workspace, int node) {
  const ambulo_problem *p = metric->problem;
  const int all = workspace->channel_count;
  double *one = metric->probe, *scratch = one + all, sum = 0.0;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    int kind = 0;
    if (!ambulo__metric_is_users(term)) continue;
    ambulo__user_term_curvature(workspace, term, node, scratch, one, &kind);
    for (int c = 0; c < all; c++) {
      if (one[c] == 0.0) continue;
      double curvature = kind > 0 ? one[c] : one[c] * one[c];
      sum +=
          term->weight * p->quadrature[node] * curvature * acceleration_slope(workspace, node, c);
    }
  }
  return sum;
}

/* curvature of the objective along accelerations, one node, summed over coordinates */
static double acceleration_curvature(const ambulo__metric *metric,
                                     const ambulo_workspace *workspace, int node) {
  const ambulo_problem *p = metric->problem;
  ambulo__term_context context = ambulo__term_context_of(workspace);
  double sum = 0.0;
  for (int c = 0; c < metric->channels; c++)
    sum += ambulo__metric_curvature(workspace, node, metric->channel[c]) *
           acceleration_slope(workspace, node, metric->channel[c]);
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!ambulo__metric_is_composite(term)) continue;
    double weight = term->weight * ambulo__term_quadrature(p, term, node);
    int forms = ambulo__term_forms(term, &context, node);
    for (int j = 0; j < forms; j++) {
      ambulo__form form;
      ambulo__term_form(term, &context, node, j, &form);
      double curvature = weight * ambulo__term_residual_from(term, 0.0, form.u).curvature;
      for (int c = 0; c < form.count; c++)
        sum += curvature * form.slope[c] * form.slope[c] *
               acceleration_slope(workspace, node + form.ahead[c], form.channel[c]);
    }
  }
  if (metric->users > 0) sum += user_acceleration_curvature(metric, workspace, node);
  return sum;
}

double ambulo__metric_objective_scale(const ambulo__metric *metric,
                                      const ambulo_workspace *workspace) {
  const ambulo_problem *p = metric->problem;
  double sum = 0.0;
  for (int k = 0; k < p->nodes; k++) sum += acceleration_curvature(metric, workspace, k);
  double mean = sum / (p->definition.duration * (double)p->coordinates);
  return mean > 0.0 ? AMBULO__REFERENCE_CURVATURE / mean : 0.0;
}
