/* solver/metric.c - see metric.h.
 *
 * Each node adds G'G, G the gradients of its curved channels times the square root of their
 * curvature (objective/term.h): one symmetric rank-k update straight into the band.
 *
 * Where no term has curvature (user terms, or no objective) a metric of accelerations
 * stands in, sum_k w_k |qdd_k|^2 times a small factor: steps are then measured by how much
 * they bend the motion.
 */
#include "solver/metric.h"

#include <math.h>
#include <string.h>

static const double acceleration_weight = 1e-3;
/* mean curvature of an objective along qdd, per second, for which mu and rho were tuned */
static const double reference_curvature = 0.5;

int ambulo__metric_diagonals(const ambulo_problem *p) {
  int widest = 1;
  for (int k = 0; k < p->nodes; k++) {
    if (ambulo__node_width(p, k) > widest) widest = ambulo__node_width(p, k);
  }
  return widest - 1;
}

static int is_curved(const ambulo_problem *p, int channel) {
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    int i = channel % p->coordinates;
    if (term->kind == AMBULO_USER_TERM || term->weight == 0.0) continue;
    if (ambulo__term_channel(term, &p->channels, i) != channel) continue;
    if (ambulo__term_scale(term, i) != 0.0) return 1;
  }
  return 0;
}

ambulo_status ambulo__metric_create(const ambulo_problem *p, ambulo__pool *pool,
                                    ambulo__metric *metric) {
  int candidates = 4 * p->coordinates; /* q, qd, qdd, tau */
  metric->problem = p;
  metric->channels = 0;
  metric->channel = ambulo__pool_ints(pool, (size_t)candidates);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int c = 0; c < candidates; c++) {
    if (is_curved(p, c)) metric->channel[metric->channels++] = c;
  }
  size_t widest = (size_t)ambulo__metric_diagonals(p) + 1;
  size_t rows = metric->channels > p->coordinates ? (size_t)metric->channels
                                                  : (size_t)p->coordinates;
  metric->rows = ambulo__pool_doubles(pool, rows * widest);
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
    if (term->kind == AMBULO_USER_TERM) continue;
    if (ambulo__term_channel(term, &p->channels, i) != channel) continue;
    double scale = ambulo__term_scale(term, i);
    double u = scale * (y - ambulo__term_offset(term, p->coordinates, node, i));
    sum += term->weight * scale * scale * ambulo__term_residual(term, u).curvature;
  }
  return sum * p->quadrature[node];
}

static void add_node(const ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                     double scale, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  int width = ambulo__node_width(p, node), count = 0;
  for (int c = 0; c < metric->channels; c++) {
    double curvature = scale * curvature_of(workspace, node, metric->channel[c]);
    if (!(curvature > 0.0)) continue;
    double *row = metric->rows + (size_t)count++ * (size_t)width, root = sqrt(curvature);
    ambulo__channel_local_gradient(workspace, node, metric->channel[c], row);
    for (int j = 0; j < width; j++) row[j] *= root;
  }
  ambulo__band_add_rows(h, ambulo__node_first(p, node), width, count, metric->rows);
}

static void add_accelerations(const ambulo__metric *metric, const ambulo_workspace *workspace,
                              int node, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  int width = ambulo__node_width(p, node);
  double root = sqrt(acceleration_weight * p->quadrature[node]);
  for (int i = 0; i < p->coordinates; i++) {
    double *row = metric->rows + (size_t)i * (size_t)width;
    ambulo__channel_local_gradient(workspace, node, ambulo__channel_qdd(&p->channels, i), row);
    for (int j = 0; j < width; j++) row[j] *= root;
  }
  ambulo__band_add_rows(h, ambulo__node_first(p, node), width, p->coordinates, metric->rows);
}

void ambulo__metric_fill(const ambulo__metric *metric, const ambulo_workspace *workspace,
                         double scale, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  ambulo__band_clear(h);
  for (int k = 0; k < p->nodes; k++) {
    if (metric->channels > 0) {
      add_node(metric, workspace, k, scale, h);
    } else {
      add_accelerations(metric, workspace, k, h);
    }
  }
}

/* sum over the nodes of curvature * (dy / dqdd_i)^2: the torque's slope is the mass matrix */
static double acceleration_curvature(const ambulo__metric *metric,
                                     const ambulo_workspace *workspace, int node) {
  const ambulo_problem *p = metric->problem;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  double sum = 0.0;
  for (int c = 0; c < metric->channels; c++) {
    int output = metric->channel[c] - ambulo__channel_outputs(&p->channels);
    double curvature = curvature_of(workspace, node, metric->channel[c]);
    if (output < 0) {
      sum += curvature;
      continue;
    }
    for (int e = pattern.start[output]; e < pattern.start[output + 1]; e++) {
      double slope = workspace->jqdd[ambulo__lane_index(node, pattern.dynamic_count, e)];
      sum += curvature * slope * slope;
    }
  }
  return sum;
}

double ambulo__metric_objective_scale(const ambulo__metric *metric,
                                      const ambulo_workspace *workspace) {
  const ambulo_problem *p = metric->problem;
  double sum = 0.0;
  for (int k = 0; k < p->nodes; k++) sum += acceleration_curvature(metric, workspace, k);
  double mean = sum / (p->definition.duration * (double)p->coordinates);
  if (!(mean > 0.0) || !isfinite(mean)) return 1.0;
  return ldexp(1.0, (int)lround(log2(reference_curvature / mean)));
}
