/* problem/gradient.c - gradient of a weighted sum of objective and rows: one reverse sweep.
 *
 * L = s J + sum_r lambda_r c_r. With y the channels and w their adjoints dL/dy, mirrored
 * block by block from evaluate.c:
 *
 *   terms:     w_c(k) += s * weight * w_k phi'(u) scale, which evaluate.c leaves behind for s = 1
 *   rows:      w_c(k) += lambda_r * coefficient          (unknowns: straight into dL/dx)
 *   mechanics: (gq, gqd, gqdd) = reverse sweep of (tau, M, F, points) with their adjoints
 *   basis:     dL/dx = B0' (gq + w_q) + B1' (gqd + w_qd) + B2' (gqdd + w_qdd)
 */
#include "problem/nlp.h"

#include "base/arithmetic.h"
#include "problem/callbacks.h"
#include "problem/hold_wrench.h"

#include <string.h>

static double *weight_at(ambulo_workspace *workspace, int node, int channel) {
  return &workspace->weight[ambulo__lane_index(node, workspace->channel_count, channel)];
}

/* ------------------------------------------------------------ values of terms */

static double user_term_value(ambulo_workspace *workspace, const ambulo_term *term) {
  const ambulo_problem *p = workspace->problem;
  double sum = 0.0;
  for (int k = 0; k < p->nodes; k++)
    sum += p->quadrature[k] * ambulo__user_term_value(workspace, term, k);
  return sum;
}

/* one coordinate of a term, block by block; the padding has weight zero */
static double coordinate_value(const ambulo_workspace *workspace, const ambulo_term *term,
                               double least, int i, double factor, double *slopes) {
  const ambulo_problem *p = workspace->problem;
  double u[AMBULO__LANES], value[AMBULO__LANES], slope[AMBULO__LANES];
  double sum[AMBULO__LANES] = {0.0}, total = 0.0;
  int channel = ambulo__term_channel(term, &p->channels, i);
  for (int k = 0; k < p->nodes; k += AMBULO__LANES) {
    const size_t at = ambulo__lane_index(k, workspace->channel_count, channel);
    double *to = slopes + at;
    ambulo__term_lanes(term, p->lean, p->coordinates, k, p->nodes, i, workspace->channel + at, u);
    ambulo__term_shapes(term, least, u, value, slope);
    for (int l = 0; l < AMBULO__LANES; l++) {
      sum[l] += p->quadrature[k + l] * value[l];
      to[l] += factor * p->quadrature[k + l] * slope[l];
    }
  }
  for (int l = 0; l < AMBULO__LANES; l++) total += sum[l];
  return total;
}

static double simple_term_value(const ambulo_workspace *workspace, const ambulo_term *term,
                                double factor, double *slopes) {
  double sum = 0.0, least = ambulo__term_least(term);
  for (int i = 0; i < workspace->problem->coordinates; i++) {
    double scale = ambulo__term_scale(term, i);
    if (scale != 0.0) sum += coordinate_value(workspace, term, least, i, factor * scale, slopes);
  }
  return sum;
}

static double composite_term_value(const ambulo_workspace *workspace, const ambulo_term *term,
                                   double factor, double *slopes) {
  const ambulo_problem *p = workspace->problem;
  ambulo__term_context context = ambulo__term_context_of(workspace);
  double sum = 0.0, least = ambulo__term_least(term);
  for (int k = 0; k < p->nodes; k++) {
    int count = ambulo__term_forms(term, &context, k);
    double node = 0.0, quadrature = ambulo__term_quadrature(p, term, k);
    for (int j = 0; j < count; j++) {
      ambulo__form form;
      ambulo__term_form(term, &context, k, j, &form);
      if (form.count == 0) continue;
      ambulo__residual phi = ambulo__term_residual_from(term, least, form.u);
      double slope = factor * quadrature * phi.slope;
      for (int c = 0; c < form.count; c++)
        slopes[ambulo__lane_index(k + form.ahead[c], workspace->channel_count, form.channel[c])] +=
            slope * form.slope[c];
      node += phi.value;
    }
    sum += quadrature * node;
  }
  return sum;
}

double ambulo__term_value(ambulo_workspace *workspace, const ambulo_term *term, double factor,
                          double *slopes) {
  if (ambulo__is_user_term(term)) return user_term_value(workspace, term);
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (info->whole) return info->whole(workspace, term, factor, slopes);
  if (ambulo__term_is_simple(term)) return simple_term_value(workspace, term, factor, slopes);
  return composite_term_value(workspace, term, factor, slopes);
}

/* -------------------------------------------------------------------- adjoints */

static void add_user_term(ambulo_workspace *workspace, const ambulo_term *term, double factor) {
  const ambulo_problem *p = workspace->problem;
  int count = workspace->channel_count;
  double *slope = workspace->node_state + count;
  for (int k = 0; k < p->nodes; k++) {
    ambulo__user_term_slope(workspace, term, k, slope);
    for (int c = 0; c < count; c++)
      *weight_at(workspace, k, c) += factor * p->quadrature[k] * slope[c];
  }
}

void ambulo__adjoint_term(ambulo_workspace *workspace, int t, double objective_weight) {
  const ambulo_term *term = &workspace->problem->definition.terms[t];
  double factor = objective_weight * term->weight;
  if (factor == 0.0) return;
  if (ambulo__is_user_term(term))
    add_user_term(workspace, term, factor);
  else
    (void)ambulo__term_value(workspace, term, factor, workspace->weight);
}

static void add_user_row(ambulo_workspace *workspace, int r, double lambda) {
  const ambulo__row_table *table = &workspace->problem->table;
  const ambulo__curved *curved = ambulo__row_curved_of(table, &table->rows[r]);
  int node = table->rows[r].node, channel[AMBULO__CURVED_CHANNELS];
  int count = curved ? ambulo__curved_channels(curved, channel) : 0;
  const double *slope = ambulo__user_slope(workspace, r);
  for (int k = 0; k < count; k++)
    *weight_at(workspace, node, channel[k]) += lambda * slope[channel[k]];
  if (curved) return;
  for (int c = 0; c < workspace->channel_count; c++) {
    *weight_at(workspace, node, c) += lambda * slope[c];
  }
}

/* a row with a term on an unknown */
static void add_mixed_row(ambulo_workspace *workspace, const ambulo__table_row *row, double lambda,
                          double *gradient) {
  const ambulo__row_term *term = workspace->problem->table.terms + row->first_term;
  for (int t = 0; t < row->term_count; t++) {
    double *adjoint = term[t].node < 0 ? &gradient[term[t].channel]
                                       : weight_at(workspace, term[t].node, term[t].channel);
    *adjoint += lambda * term[t].coefficient;
  }
}

void ambulo__adjoint_rows(ambulo_workspace *workspace, const double *row_weights,
                          double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__row_runs *runs = &p->row_runs;
  ambulo__row_runs_adjoint(runs, row_weights, workspace->weight);
  for (int o = 0; o < runs->odd_count; o++) {
    int r = runs->odd[o];
    if (row_weights[r] == 0.0) continue;
    if (p->table.rows[r].user >= 0) {
      add_user_row(workspace, r, row_weights[r]);
    } else {
      add_mixed_row(workspace, &p->table.rows[r], row_weights[r], gradient);
    }
  }
}

void ambulo__adjoint_block(ambulo_workspace *workspace, int block) {
  const ambulo_problem *p = workspace->problem;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  size_t offset = (size_t)block * (size_t)workspace->channel_count * AMBULO__LANES;
  double *c = workspace->channel + offset, *w = workspace->weight + offset;
  double *g = workspace->gradient_lanes;
  const double *ground = ambulo__ground_block(p, p->ground, block);
  const double *factors = ambulo__time_factor_block(p, p->time_factors, block);
  double *room = workspace->device_scratch;
  ambulo__hold_wrench_begin(p, factors, c, workspace->scratch, room);
  p->kernels->forward(p->plan, c, c + d8, c + 2 * d8, ground, c + 3 * d8, workspace->scratch);
  p->kernels->reverse(p->plan, c + d8, c + 2 * d8, ground, w + 3 * d8, g, g + d8, g + 2 * d8,
                      workspace->scratch);
  for (size_t e = 0; e < 3 * d8; e++) w[e] += g[e];
  ambulo__hold_wrench_end(p, c, room);
  ambulo__hold_wrench_reverse(p, w, workspace->scratch, room);
  if (!p->devices) return;
  const double *effort = w + (size_t)ambulo__channel_effort(&p->channels, 0) * AMBULO__LANES;
  const ambulo__device_adjoints adjoints = {w + 3 * d8, effort, w, w + d8};
  ambulo__devices_reverse(p->devices, c, c + d8, factors, c + 3 * d8, &adjoints, room);
}

void ambulo__adjoint_clear(ambulo_workspace *workspace, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  size_t lanes = (size_t)p->blocks * (size_t)workspace->channel_count * AMBULO__LANES;
  memset(workspace->weight, 0, lanes * sizeof *workspace->weight);
  memset(gradient, 0, (size_t)p->variables * sizeof *gradient);
}

void ambulo__adjoint_begin(ambulo_workspace *workspace, double objective_weight, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  size_t lanes = (size_t)p->blocks * (size_t)workspace->channel_count * AMBULO__LANES;
  const double *restrict slope = workspace->term_slope;
  double *restrict weight = workspace->weight;
  if (objective_weight == 0.0) { /* slopes may not be finite */
    ambulo__adjoint_clear(workspace, gradient);
    return;
  }
  memset(gradient, 0, (size_t)p->variables * sizeof *gradient);
  for (size_t e = 0; e < lanes; e++) weight[e] = objective_weight * slope[e];
  for (int t = 0; t < p->definition.term_count; t++) {
    if (ambulo__is_user_term(&p->definition.terms[t]))
      ambulo__adjoint_term(workspace, t, objective_weight);
  }
}

/* --------------------------------------------------------------------- the sweep */

void ambulo__adjoint_pull_back(ambulo_workspace *workspace, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  size_t stride = (size_t)workspace->channel_count * AMBULO__LANES;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  double *w = workspace->weight;
  for (int block = 0; block < p->blocks; block++) ambulo__adjoint_block(workspace, block);
  ambulo__lane_map_transpose(p->map, w, w + d8, w + 2 * d8, NULL, stride, gradient);
}
