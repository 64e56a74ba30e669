/* method/metric.c - see metric.h.
 *
 * Each node adds G'G, G the gradients of its residuals times the square root of their
 * curvature: one symmetric rank-k update straight into the band.
 *
 * Where no term has curvature (no objective, or linear terms of the caller) a metric of
 * accelerations stands in, sum_k w_k |qdd_k|^2 times a small factor: steps are then measured by how
 * much they bend the motion.
 */
#include "method/metric.h"
#include "method/parameters.h"
#include "base/worst.h"
#include "nlp/states.h"
#include "nlp/user_term.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static int has_rates(const ambulo_problem *p) {
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (ambulo__term_is_rate(term) && term->weight > 0.0) return 1;
  }
  return 0;
}

/* unknowns from the node's first to the last that its residuals depend on */
static int reach_of(const ambulo_problem *p, int node, int rates) {
  int width = ambulo__node_width(p, node);
  if (!rates || node + 1 == p->nodes) return width;
  int ahead = ambulo__node_first(p, node + 1) - ambulo__node_first(p, node);
  int reach = ahead + ambulo__node_width(p, node + 1);
  return reach > width ? reach : width;
}

int ambulo__metric_diagonals(const ambulo_problem *p) {
  int widest = 1, rates = has_rates(p);
  for (int k = 0; k < p->nodes; k++) {
    int reach = reach_of(p, k, rates);
    if (reach > widest) widest = reach;
  }
  return widest - 1;
}

static int is_curved(const ambulo_problem *p, int channel) {
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    int i = channel % p->coordinates;
    if (!ambulo__term_is_simple(term) || term->weight == 0.0) continue;
    if (ambulo__term_channel(term, &p->channels, i) != channel) continue;
    if (ambulo__term_scale(term, i) != 0.0) return 1;
  }
  return 0;
}

static int is_composite(const ambulo_term *term) {
  return !ambulo__is_user_term(term) && !ambulo__term_is_simple(term) && term->weight > 0.0;
}

static int is_users(const ambulo_term *term) {
  return ambulo__is_user_term(term) && term->weight > 0.0;
}

ambulo_status ambulo__metric_create(const ambulo_problem *p, ambulo__pool *pool,
                                    ambulo__metric *metric) {
  int candidates = 4 * p->coordinates; /* q, qd, qdd, tau */
  ambulo__term_context context = {.model = p->model, .channels = p->channels, .nodes = p->nodes};
  int forms = 0; /* most residuals of a term at one node */
  for (int t = 0; t < p->definition.term_count; t++) {
    int count = ambulo__term_forms(&p->definition.terms[t], &context, 0);
    if (count > forms) forms = count;
  }
  if (forms < p->coordinates) forms = p->coordinates; /* accelerations */
  metric->problem = p;
  metric->channels = metric->composites = metric->users = 0;
  metric->rates = has_rates(p);
  metric->channel = ambulo__pool_ints(pool, (size_t)candidates);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int c = 0; c < candidates; c++) {
    if (is_curved(p, c)) metric->channel[metric->channels++] = c;
  }
  for (int t = 0; t < p->definition.term_count; t++) {
    metric->composites += is_composite(&p->definition.terms[t]);
    metric->users += is_users(&p->definition.terms[t]);
  }
  size_t widest = (size_t)ambulo__metric_diagonals(p) + 1;
  int all = ambulo__channel_count(&p->channels);
  metric->row_capacity = metric->channels + forms * (metric->composites + 1);
  if (metric->users > 0) {
    metric->row_capacity += p->coordinates + all + metric->users;
    metric->probe = ambulo__pool_doubles(pool, (size_t)(6 * all));
  }
  metric->stride = ambulo__whole_tiles((int)widest);
  metric->rows = ambulo__pool_doubles(pool, (size_t)metric->row_capacity * (size_t)metric->stride);
  metric->one = ambulo__pool_doubles(pool, widest);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* curvature of the objective along one channel of one node */
static double curvature_of(const ambulo_workspace *workspace, int node, int channel) {
  const ambulo_problem *p = workspace->problem;
  double y = workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
  int i = channel % p->coordinates;
  double sum = 0.0;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!ambulo__term_is_simple(term)) continue;
    if (ambulo__term_channel(term, &p->channels, i) != channel) continue;
    double scale = ambulo__term_scale(term, i);
    double u = scale * (y - ambulo__term_offset(term, p->coordinates, node, i));
    sum += term->weight * scale * scale * ambulo__term_residual(term, u).curvature;
  }
  return sum * p->quadrature[node];
}

/* the place of a row of a node; what lies beyond its width is zero */
static double *row_at(const ambulo__metric *metric, int row, int width) {
  double *g = metric->rows + (size_t)row * (size_t)metric->stride;
  for (int j = width; j < ambulo__whole_tiles(width); j++) g[j] = 0.0;
  return g;
}

/* whether a form changes with anything: those of coordinates whose scale is zero do not */
static int has_slope(const ambulo__form *form) {
  for (int c = 0; c < form->count; c++) {
    if (form->slope[c] != 0.0) return 1; /* NaN, too */
  }
  return 0;
}

/* Weighted gradients of one composite term's residuals in `width` unknowns; returns the rows used
 * so far. One over two nodes is kept whole: split, as 2 a^2 + 2 b^2 >= (a + b)^2, the rate of a
 * force between nodes that stand close would look as stiff as the force itself over the square of
 * their distance, where what both have in common cancels (walk_normal: 1.5 times the evaluations).
 */
static int composite_rows(const ambulo__metric *metric, const ambulo_workspace *workspace,
                          const ambulo_term *term, int node, int width, double scale, int count) {
  const ambulo_problem *p = metric->problem;
  ambulo__term_context context = ambulo__term_context_of(workspace);
  int forms = ambulo__term_forms(term, &context, node);
  double weight = scale * term->weight * ambulo__term_quadrature(p, term, node);
  for (int j = 0; j < forms && count < metric->row_capacity; j++) {
    ambulo__form form;
    ambulo__term_form(term, &context, node, j, &form);
    if (!has_slope(&form)) continue;
    double *row = row_at(metric, count++, width);
    double root = sqrt(ambulo__worse(0.0, weight * ambulo__term_residual(term, form.u).curvature));
    memset(row, 0, (size_t)width * sizeof *row);
    for (int c = 0; c < form.count; c++) {
      int at = node + form.ahead[c];
      double *place = row + ambulo__node_first(p, at) - ambulo__node_first(p, node);
      ambulo__channel_local_gradient(workspace, at, form.channel[c], metric->one);
      for (int i = 0; i < ambulo__node_width(p, at); i++)
        place[i] += root * form.slope[c] * metric->one[i];
    }
  }
  return count;
}

/* curvature [channels] of the terms of the caller that are no squares, weighted; of those that are
 * a row each. Returns the rows used so far. */
static int user_rows(const ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                     double scale, int count) {
  const ambulo_problem *p = metric->problem;
  const int all = workspace->channel_count, width = ambulo__node_width(p, node);
  double *sum = metric->probe, *one = sum + all, *scratch = one + all;
  memset(sum, 0, (size_t)all * sizeof *sum);
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    double weight = scale * term->weight * p->quadrature[node];
    int kind = 0;
    if (!is_users(term)) continue;
    ambulo__user_term_curvature(workspace, term, node, scratch, one, &kind);
    for (int c = 0; kind > 0 && c < all; c++) sum[c] += weight * one[c];
    if (kind > 0) continue;
    double *row = row_at(metric, count++, width);
    memset(row, 0, (size_t)width * sizeof *row);
    for (int c = 0; c < all; c++) {
      if (one[c] == 0.0) continue;
      ambulo__channel_local_gradient(workspace, node, c, metric->one);
      for (int j = 0; j < width; j++) row[j] += sqrt(weight) * one[c] * metric->one[j];
    }
  }
  for (int c = 0; c < all; c++) {
    if (sum[c] == 0.0) continue;
    double *row = row_at(metric, count++, width), root = sqrt(sum[c]);
    ambulo__channel_local_gradient(workspace, node, c, row);
    for (int j = 0; j < width; j++) row[j] *= root;
  }
  return count;
}

/* q, qd and qdd of a coordinate depend on the control points of that coordinate alone */
static void add_light(const ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                      int channel, double curvature, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  int d = p->coordinates, i = channel % d, width = ambulo__node_width(p, node);
  ambulo__channel_local_gradient(workspace, node, channel, metric->one);
  ambulo__band_add_outer(h, ambulo__node_first(p, node) + i, (width - i + d - 1) / d, d, curvature,
                         metric->one + i);
}

/* rows of all composite terms with or without rates */
static int all_composite_rows(const ambulo__metric *metric, const ambulo_workspace *workspace,
                              int node, int rates, int width, double scale, int count) {
  const ambulo_problem *p = metric->problem;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (is_composite(term) && ambulo__term_is_rate(term) == rates)
      count = composite_rows(metric, workspace, term, node, width, scale, count);
  }
  return count;
}

/* returns how many forms have a curvature */
static int add_node(const ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                    double scale, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  int first = ambulo__node_first(p, node), width = ambulo__node_width(p, node);
  int count = 0, light = 0, rates = 0;
  for (int c = 0; c < metric->channels; c++) {
    double curvature = scale * curvature_of(workspace, node, metric->channel[c]);
    if (curvature <= 0.0) continue; /* not NaN, which the factorization meets */
    if (metric->channel[c] < ambulo__channel_outputs(&p->channels)) {
      add_light(metric, workspace, node, metric->channel[c], curvature, h);
      light++;
      continue;
    }
    double *row = row_at(metric, count++, width), root = sqrt(curvature);
    ambulo__channel_local_gradient(workspace, node, metric->channel[c], row);
    for (int j = 0; j < width; j++) row[j] *= root;
  }
  count = all_composite_rows(metric, workspace, node, 0, width, scale, count);
  if (metric->users > 0) count = user_rows(metric, workspace, node, scale, count);
  ambulo__band_add_rows(h, first, width, count, metric->stride, metric->rows);
  if (metric->rates) {
    int reach = reach_of(p, node, 1);
    rates = all_composite_rows(metric, workspace, node, 1, reach, scale, 0);
    ambulo__band_add_rows(h, first, reach, rates, metric->stride, metric->rows);
  }
  return count + light + rates;
}

static void add_accelerations(const ambulo__metric *metric, const ambulo_workspace *workspace,
                              int node, double weight, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  for (int i = 0; i < p->coordinates; i++)
    add_light(metric, workspace, node, ambulo__channel_qdd(&p->channels, i),
              weight * p->quadrature[node], h);
}

/* (GN) (P.2) sum of curvature g g' over nodes and residuals */
void ambulo__metric_fill(const ambulo__metric *metric, const ambulo_workspace *workspace,
                         double scale, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  ambulo__band_clear(h);
  int forms = 0;
  for (int k = 0; k < p->nodes; k++) forms += add_node(metric, workspace, k, scale, h);
  for (int k = 0; k < p->nodes && forms == 0; k++)
    add_accelerations(metric, workspace, k, AMBULO__ACCELERATION_WEIGHT, h);
}

void ambulo__metric_accelerations(const ambulo__metric *metric, const ambulo_workspace *workspace,
                                  double weight, ambulo__band *h) {
  ambulo__band_clear(h);
  for (int k = 0; k < metric->problem->nodes; k++)
    add_accelerations(metric, workspace, k, weight, h);
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
    if (!is_users(term)) continue;
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
    sum += curvature_of(workspace, node, metric->channel[c]) *
           acceleration_slope(workspace, node, metric->channel[c]);
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!is_composite(term)) continue;
    double weight = term->weight * ambulo__term_quadrature(p, term, node);
    int forms = ambulo__term_forms(term, &context, node);
    for (int j = 0; j < forms; j++) {
      ambulo__form form;
      ambulo__term_form(term, &context, node, j, &form);
      double curvature = weight * ambulo__term_residual(term, form.u).curvature;
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
