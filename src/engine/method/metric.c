/* method/metric.c - see metric.h.
 *
 * Each node adds G'G, G the gradients of its residuals times the square root of their curvature: by
 * its q, qd and qdd, from where their Gram matrix is spread over its control points
 * (linear/band.h). Residuals of one coordinate's torque and motion are first made one for each
 * coordinate, and a form of its own control points (metric.h). Rates depend on two nodes,
 * and their rows stand on the unknowns of both.
 *
 * Where no term has curvature (no objective, or linear terms of the caller) a metric of
 * accelerations stands in, sum_k w_k |qdd_k|^2 times a small factor: steps are then measured by how
 * much they bend the motion.
 */
#include "method/metric.h"

#include "base/arithmetic.h"
#include "method/parameters.h"
#include "problem/callbacks.h"

#include <math.h>
#include <string.h>

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
    metric->composites += ambulo__metric_is_composite(&p->definition.terms[t]);
    metric->users += ambulo__metric_is_users(&p->definition.terms[t]);
  }
  size_t widest = (size_t)ambulo__metric_diagonals(p) + 1;
  size_t motion = (size_t)(AMBULO__ORDERS * p->coordinates);
  int all = ambulo__channel_count(&p->channels);
  metric->row_capacity = metric->channels + p->coordinates + forms * (metric->composites + 1);
  if (metric->users > 0) {
    metric->row_capacity += p->coordinates + all + metric->users;
    metric->probe = ambulo__pool_doubles(pool, (size_t)(6 * all));
  }
  metric->stride = ambulo__whole_tiles((int)(widest > motion ? widest : motion));
  metric->rows = ambulo__pool_doubles(pool, (size_t)metric->row_capacity * (size_t)metric->stride);
  size_t span = (size_t)ambulo__basis_span(p->basis), form = span * (span + 1) / 2;
  metric->one = ambulo__pool_doubles(pool, widest > form ? widest : form);
  metric->joint = ambulo__pool_blocks(pool, (size_t)p->coordinates, sizeof *metric->joint);
  if (ambulo__channel_slopes_create(p, pool, &metric->slopes)) return AMBULO_E_MEMORY;
  return ambulo__spread_create(pool, p->coordinates, &metric->spread);
}

/* the place of a row of a node, zero */
static double *row_at(const ambulo__metric *metric, int row, int width) {
  double *g = metric->rows + (size_t)row * (size_t)metric->stride;
  memset(g, 0, (size_t)ambulo__whole_tiles(width) * sizeof *g);
  return g;
}

/* adds factor times the slopes of a channel by the q, qd and qdd of its node */
static void add_motion(ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                       int channel, double factor, double *restrict row) {
  const double *restrict slope =
      ambulo__channel_slopes_of(&metric->slopes, workspace, node, channel);
  for (int i = 0; i < AMBULO__ORDERS * metric->problem->coordinates; i++)
    row[i] += factor * slope[i];
}

/* of a rate: at node `at`, by the unknowns from those of `node` on */
static void add_ahead(ambulo__metric *metric, const ambulo_workspace *workspace, int node, int at,
                      int channel, double factor, double *row) {
  const ambulo_problem *p = metric->problem;
  const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[at];
  const int d = p->coordinates;
  const double *restrict slope = ambulo__channel_slopes_of(&metric->slopes, workspace, at, channel);
  double *restrict place = row + ambulo__node_first(p, at) - ambulo__node_first(p, node);
  for (int c = 0; c < point->span; c++, place += d) {
    const double b0 = factor * point->weight[0][c], b1 = factor * point->weight[1][c];
    const double b2 = factor * point->weight[2][c];
    for (int i = 0; i < d; i++)
      place[i] += b0 * slope[i] + b1 * slope[d + i] + b2 * slope[2 * d + i];
  }
}

/* whether a form changes with anything: those of coordinates whose scale is zero do not */
static int has_slope(const ambulo__form *form) {
  for (int c = 0; c < form->count; c++) {
    if (form->slope[c] != 0.0) return 1; /* NaN, too */
  }
  return 0;
}

/* the coordinate that a form is all about, its motion and torque at the node; -1: more */
static int coordinate_of(const ambulo_problem *p, const ambulo__form *form) {
  const int d = p->coordinates, i = form->channel[0] % d;
  for (int c = 0; c < form->count; c++) {
    if (form->ahead[c] || form->channel[c] >= 4 * d || form->channel[c] % d != i) return -1;
  }
  return i;
}

/* a form of a coordinate, times `root` */
static void add_to_joint(const ambulo_problem *p, const ambulo__form *form, double root,
                         ambulo__joint_squares *joint) {
  double slope[4] = {0.0}; /* by q, qd, qdd, tau */
  for (int c = 0; c < form->count; c++)
    slope[form->channel[c] / p->coordinates] += root * form->slope[c];
  ambulo__joint_squares_add(joint, slope[3], slope);
}

/* Whether row [width] of a form is worth its products: forces of contacts in the air are none. */
static int is_zero(int width, const double *row) {
  for (int j = 0; j < width; j++) {
    if (row[j] != 0.0) return 0;
  }
  return 1;
}

/* a form, times `root`: of a rate by the unknowns from those of `node` on, else by its motion */
static void write_row(ambulo__metric *metric, const ambulo_workspace *workspace,
                      const ambulo__form *form, int node, int rates, double root, double *row) {
  for (int c = 0; c < form->count; c++) {
    int at = node + form->ahead[c];
    double factor = root * form->slope[c];
    if (rates) {
      add_ahead(metric, workspace, node, at, form->channel[c], factor, row);
    } else {
      add_motion(metric, workspace, at, form->channel[c], factor, row);
    }
  }
}

/* Weighted gradients of one composite term's residuals, of `width` numbers, but for those of one
 * coordinate, which are left to its squares; returns the rows used so far. A rate over two nodes is
 * kept whole: split, as 2 a^2 + 2 b^2 >= (a + b)^2, the rate of a force between nodes that stand
 * close would look as stiff as the force itself over the square of their distance, where what both
 * have in common cancels (walk_normal: 1.5 times the evaluations).
 */
static int composite_rows(ambulo__metric *metric, const ambulo_workspace *workspace,
                          const ambulo_term *term, int node, int width, double scale, int count) {
  const ambulo_problem *p = metric->problem;
  ambulo__term_context context = ambulo__term_context_of(workspace);
  int forms = ambulo__term_forms(term, &context, node), rates = ambulo__term_is_rate(term);
  double weight = scale * term->weight * ambulo__term_quadrature(p, term, node);
  for (int j = 0; j < forms && count < metric->row_capacity; j++) {
    ambulo__form form;
    ambulo__term_form(term, &context, node, j, &form);
    if (!has_slope(&form)) continue;
    double curvature = weight * ambulo__term_residual_from(term, 0.0, form.u).curvature;
    double root = sqrt(ambulo__worse(0.0, curvature));
    int i = coordinate_of(p, &form);
    if (i >= 0) {
      add_to_joint(p, &form, root, &metric->joint[i]);
      continue;
    }
    double *row = row_at(metric, count, width);
    write_row(metric, workspace, &form, node, rates, root, row);
    count += !is_zero(width, row);
  }
  return count;
}

/* curvature [channels] of the terms of the caller that are no squares, weighted; of those that are
 * a row each. Returns the rows used so far. */
static int user_rows(ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                     double scale, int count) {
  const ambulo_problem *p = metric->problem;
  const int all = workspace->channel_count, width = AMBULO__ORDERS * p->coordinates;
  double *sum = metric->probe, *one = sum + all, *scratch = one + all;
  memset(sum, 0, (size_t)all * sizeof *sum);
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    double weight = scale * term->weight * p->quadrature[node];
    int kind = 0;
    if (!ambulo__metric_is_users(term)) continue;
    ambulo__user_term_curvature(workspace, term, node, scratch, one, &kind);
    for (int c = 0; kind > 0 && c < all; c++) sum[c] += weight * one[c];
    if (kind > 0) continue;
    double *row = row_at(metric, count++, width);
    for (int c = 0; c < all; c++) {
      if (one[c] != 0.0) add_motion(metric, workspace, node, c, sqrt(weight) * one[c], row);
    }
  }
  for (int c = 0; c < all; c++) {
    if (sum[c] == 0.0) continue;
    add_motion(metric, workspace, node, c, sqrt(sum[c]), row_at(metric, count++, width));
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

/* what is left of the squares of coordinates: rows into G, forms into the band. Returns the rows
 * used so far; *light counts the forms. */
static int joint_rows(ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                      int count, int *light, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[node];
  const int d = p->coordinates;
  for (int i = 0; i < d; i++) {
    const ambulo__joint_squares *joint = &metric->joint[i];
    double *weight = metric->one;
    if (ambulo__joint_squares_light(joint, point, weight)) {
      ambulo__band_add_form(h, ambulo__node_first(p, node) + i, point->span, d, weight);
      ++*light;
    }
    if (joint->tau == 0.0) continue;
    double *row = row_at(metric, count++, AMBULO__ORDERS * d);
    add_motion(metric, workspace, node, ambulo__channel_tau(&p->channels, i), joint->tau, row);
    for (int o = 0; o < AMBULO__ORDERS; o++) row[o * d + i] += joint->motion[o];
  }
  return count;
}

/* rows of all composite terms with or without rates */
static int all_composite_rows(ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                              int rates, int width, double scale, int count) {
  const ambulo_problem *p = metric->problem;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (ambulo__metric_is_composite(term) && ambulo__term_is_rate(term) == rates)
      count = composite_rows(metric, workspace, term, node, width, scale, count);
  }
  return count;
}

/* simple terms: each stands on one coordinate */
static void add_simple_terms(const ambulo__metric *metric, const ambulo_workspace *workspace,
                             int node, double scale) {
  const int d = metric->problem->coordinates;
  for (int c = 0; c < metric->channels; c++) {
    int channel = metric->channel[c], order = channel / d;
    double curvature = scale * ambulo__metric_curvature(workspace, node, channel), slope[4] = {0.0};
    if (curvature <= 0.0) continue; /* not NaN, which the factorization meets */
    slope[order] = sqrt(curvature);
    ambulo__joint_squares_add(&metric->joint[channel % d], slope[3], slope);
  }
}

/* returns how many forms have a curvature */
static int add_node(ambulo__metric *metric, const ambulo_workspace *workspace, int node,
                    double scale, ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  int first = ambulo__node_first(p, node), count = 0, light = 0, rates = 0;
  memset(metric->joint, 0, (size_t)p->coordinates * sizeof *metric->joint);
  add_simple_terms(metric, workspace, node, scale);
  count =
      all_composite_rows(metric, workspace, node, 0, AMBULO__ORDERS * p->coordinates, scale, count);
  if (metric->users > 0) count = user_rows(metric, workspace, node, scale, count);
  count = joint_rows(metric, workspace, node, count, &light, h);
  const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[node];
  const double *const b[] = {point->weight[0], point->weight[1], point->weight[2]};
  ambulo__spread_rows(&metric->spread, count, metric->stride, metric->rows, point->span, b, first,
                      h);
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
void ambulo__metric_fill(ambulo__metric *metric, const ambulo_workspace *workspace, double scale,
                         ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  ambulo__band_clear(h);
  ambulo__channel_slopes_clear(&metric->slopes);
  int forms = 0;
  for (int k = 0; k < p->nodes; k++) forms += add_node(metric, workspace, k, scale, h);
  for (int k = 0; k < p->nodes && forms == 0; k++)
    add_accelerations(metric, workspace, k, AMBULO__ACCELERATION_WEIGHT, h);
}

/* (P.2c) sum of -lambda scale d2c/dx2, what the rows stand on taken as linear */
void ambulo__metric_add_bends(ambulo__metric *metric, const ambulo_workspace *workspace,
                              const ambulo__sparse_rows *rows, const double *lambda,
                              ambulo__band *h) {
  const ambulo_problem *p = metric->problem;
  const int width = AMBULO__ORDERS * p->coordinates;
  for (int i = 0; i < rows->count; i++) {
    const ambulo__table_row *row = &p->table.rows[rows->row[i]];
    const ambulo__curved *curved = ambulo__row_curved_of(&p->table, row);
    double multiplier = -lambda[i] * rows->scale[i], bend[2][AMBULO__CURVED_CHANNELS];
    int channel[AMBULO__CURVED_CHANNELS];
    if (!(multiplier > 0.0) || !curved) continue;
    const double *y =
        workspace->channel + ambulo__lane_index(row->node, workspace->channel_count, 0);
    int count = ambulo__curved_curvature(curved, y, AMBULO__LANES, bend);
    int channels = ambulo__curved_channels(curved, channel);
    for (int j = 0; j < count; j++) {
      double *g = row_at(metric, j, width);
      for (int k = 0; k < channels; k++)
        add_motion(metric, workspace, row->node, channel[k], sqrt(multiplier) * bend[j][k], g);
    }
    const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[row->node];
    const double *const b[] = {point->weight[0], point->weight[1], point->weight[2]};
    ambulo__spread_rows(&metric->spread, count, metric->stride, metric->rows, point->span, b,
                        ambulo__node_first(p, row->node), h);
  }
}

void ambulo__metric_accelerations(const ambulo__metric *metric, const ambulo_workspace *workspace,
                                  double weight, ambulo__band *h) {
  ambulo__band_clear(h);
  for (int k = 0; k < metric->problem->nodes; k++)
    add_accelerations(metric, workspace, k, weight, h);
}
