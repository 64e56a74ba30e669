/* method/curvature.c - see metric.h: slopes of channels, squares of one coordinate, and the
 * curvature of the objective along accelerations, from which its scale follows. */
#include "method/metric.h"
#include "method/parameters.h"
#include "problem/callbacks.h"

#include <math.h>
#include <string.h>

/* the place of a channel among those that are kept, torques and then forces on contacts; -1: none
 */
static int slot_of(const ambulo__channels *c, int channel) {
  int torque = channel - ambulo__channel_tau(c, 0);
  int force = channel - ambulo__channel_foot_force(c, 0, 0);
  if (torque >= 0 && torque < c->coordinates) return torque;
  if (force < 0 || force >= AMBULO__SLOT_CHANNELS * c->slots || force % AMBULO__SLOT_CHANNELS >= 3)
    return -1;
  return c->coordinates + force / AMBULO__SLOT_CHANNELS * 3 + force % AMBULO__SLOT_CHANNELS;
}

ambulo_status ambulo__channel_slopes_create(const ambulo_problem *p, ambulo__pool *pool,
                                            ambulo__channel_slopes *s) {
  s->problem = p;
  s->slots = p->coordinates + 3 * p->channels.slots;
  s->entries = 3 * p->coordinates;
  size_t slots = 2 * (size_t)s->slots;
  s->kept = ambulo__pool_ints(pool, slots);
  s->value = ambulo__pool_doubles(pool, slots * (size_t)s->entries);
  s->other = ambulo__pool_doubles(pool, (size_t)s->entries);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__channel_slopes_clear(ambulo__channel_slopes *s) {
  memset(s->kept, 0, 2 * (size_t)s->slots * sizeof *s->kept);
}

const double *ambulo__channel_slopes_of(ambulo__channel_slopes *s,
                                        const ambulo_workspace *workspace, int node, int channel) {
  int slot = slot_of(&s->problem->channels, channel);
  int output = channel - ambulo__channel_outputs(&s->problem->channels);
  double *to = s->other;
  if (slot >= 0) {
    int at = (node & 1) * s->slots + slot;
    to = s->value + (size_t)at * (size_t)s->entries;
    if (s->kept[at] == node + 1) return to;
    s->kept[at] = node + 1;
  }
  if (output >= 0) {
    ambulo__output_gradient(workspace, node, output, to);
  } else {
    memset(to, 0, (size_t)s->entries * sizeof *to);
    to[channel] = 1.0;
  }
  return to;
}

/* the curvature of the objective along accelerations, for its scale
 * (metric.h). */

static const double pi = 3.14159265358979323846;

/* ------------------------------------------------------- squares of a coordinate */

static void add_light(ambulo__joint_squares *s, const double m[AMBULO__ORDERS]) {
  for (int a = 0, at = 0; a < AMBULO__ORDERS; a++) {
    for (int b = 0; b <= a; b++) s->light[at++] += m[a] * m[b];
  }
}

void ambulo__joint_squares_add(ambulo__joint_squares *s, double tau,
                               const double motion[AMBULO__ORDERS]) {
  double length = sqrt(s->tau * s->tau + tau * tau), rest[AMBULO__ORDERS], c = 1.0, z = 0.0;
  if (length != 0.0) { /* NaN, too, which the factorization meets */
    c = s->tau / length;
    z = tau / length;
  }
  for (int o = 0; o < AMBULO__ORDERS; o++) {
    rest[o] = c * motion[o] - z * s->motion[o];
    s->motion[o] = c * s->motion[o] + z * motion[o];
  }
  s->tau = length;
  add_light(s, rest);
}

int ambulo__joint_squares_light(const ambulo__joint_squares *s, const ambulo__basis_point *point,
                                double *form) {
  int any = 0, at = 0;
  for (int e = 0; e < AMBULO__ORDERS * (AMBULO__ORDERS + 1) / 2; e++) any |= s->light[e] != 0.0;
  if (!any) return 0;
  const double *l = s->light;
  for (int c = 0; c < point->span; c++) {
    const double q = point->weight[0][c], qd = point->weight[1][c], qdd = point->weight[2][c];
    const double by_q = l[0] * q + l[1] * qd + l[3] * qdd;
    const double by_qd = l[1] * q + l[2] * qd + l[4] * qdd;
    const double by_qdd = l[3] * q + l[4] * qd + l[5] * qdd;
    for (int b = 0; b <= c; b++)
      form[at++] =
          by_q * point->weight[0][b] + by_qd * point->weight[1][b] + by_qdd * point->weight[2][b];
  }
  return 1;
}

/* ----------------------------------------------------- curvature along channels */

int ambulo__metric_is_composite(const ambulo_term *term) {
  return !ambulo__is_user_term(term) && !ambulo__term_is_simple(term) && term->weight > 0.0;
}

int ambulo__metric_is_users(const ambulo_term *term) {
  return ambulo__is_user_term(term) && term->weight > 0.0;
}

double ambulo__metric_curvature(const ambulo_workspace *workspace, int node, int channel) {
  const ambulo_problem *p = workspace->problem;
  double y = workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
  int i = channel % p->coordinates;
  double sum = 0.0;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!ambulo__term_is_simple(term)) continue;
    if (ambulo__term_channel(term, &p->channels, i) != channel) continue;
    double scale = ambulo__term_scale(term, i);
    double u = scale * (y - ambulo__term_offset(term, p->lean, p->coordinates, node, i));
    sum += term->weight * scale * scale * ambulo__term_residual_from(term, 0.0, u).curvature;
  }
  return sum * p->quadrature[node];
}

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
