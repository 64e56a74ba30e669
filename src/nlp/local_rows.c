/* nlp/local_rows.c - gradients of channels and rows with respect to a node's local unknowns.
 *
 * A node's motion is D^o q_i = sum_c b_o[c] x[(first + c) d + i] (trajectory/basis.h). A
 * channel y with partial derivatives y_q, y_qd, y_qdd therefore has
 *
 *   dy / dx[(first + c) d + i] = b_0[c] y_q[i] + b_1[c] y_qd[i] + b_2[c] y_qdd[i]
 *
 * Local index c * d + i. A row is a sum of channels; the Gauss-Newton matrix of a node is
 * sum_channels curvature * g g' with g such a gradient.
 */
#include "nlp/nlp.h"
#include "nlp/states.h"
#include "nlp/user_term.h"

#include <string.h>

/* adds factor * (gradient of q, qd or qdd of coordinate i) */
static void add_motion(const ambulo__basis_point *point, int d, int order, int i, double factor,
                       double *gradient) {
  for (int c = 0; c < point->span; c++) gradient[c * d + i] += factor * point->weight[order][c];
}

/* adds factor * (gradient of mechanics output row `output`) */
static void add_output(const ambulo_workspace *workspace, int node, int output, double factor,
                       double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[node];
  const int d = p->coordinates;
  const double *y = workspace->motion_scratch;
  ambulo__output_gradient(workspace, node, output, workspace->motion_scratch);
  for (int c = 0; c < point->span; c++, gradient += d) {
    const double b0 = factor * point->weight[0][c], b1 = factor * point->weight[1][c];
    const double b2 = factor * point->weight[2][c];
    for (int i = 0; i < d; i++) gradient[i] += b0 * y[i] + b1 * y[d + i] + b2 * y[2 * d + i];
  }
}

static void add_channel(const ambulo_workspace *workspace, int node, int channel, double factor,
                        double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[node];
  int d = p->coordinates, outputs = ambulo__channel_outputs(&p->channels);
  if (channel < outputs) {
    add_motion(point, d, channel / d, channel % d, factor, gradient);
  } else {
    add_output(workspace, node, channel - outputs, factor, gradient);
  }
}

void ambulo__channel_local_gradient(const ambulo_workspace *workspace, int node, int channel,
                                    double *gradient) {
  memset(gradient, 0, (size_t)ambulo__node_width(workspace->problem, node) * sizeof *gradient);
  add_channel(workspace, node, channel, 1.0, gradient);
}

static void add_user_row(const ambulo_workspace *workspace, int row, double factor,
                         double *gradient) {
  const double *slope = ambulo__user_slope(workspace, row);
  int node = workspace->problem->table.rows[row].node;
  for (int c = 0; c < workspace->channel_count; c++) {
    if (slope[c] != 0.0) add_channel(workspace, node, c, factor * slope[c], gradient);
  }
}

void ambulo__row_local_gradient(const ambulo_workspace *workspace, int row, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  memset(gradient, 0, (size_t)ambulo__node_width(p, r->node) * sizeof *gradient);
  if (r->user >= 0) {
    add_user_row(workspace, row, 1.0, gradient);
    return;
  }
  const ambulo__row_term *term = p->table.terms + r->first_term;
  for (int t = 0; t < r->term_count; t++) {
    add_channel(workspace, r->node, term[t].channel, term[t].coefficient, gradient);
  }
}

void ambulo__row_add_gradient(const ambulo_workspace *workspace, int row, double factor,
                              double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  if (r->user >= 0) {
    add_user_row(workspace, row, factor, gradient + ambulo__node_first(p, r->node));
    return;
  }
  const ambulo__row_term *term = p->table.terms + r->first_term;
  for (int t = 0; t < r->term_count; t++) {
    double value = factor * term[t].coefficient;
    if (term[t].node < 0) {
      gradient[term[t].channel] += value;
    } else {
      double *local = gradient + ambulo__node_first(p, term[t].node);
      add_channel(workspace, term[t].node, term[t].channel, value, local);
    }
  }
}

/* --------------------------------------------------------- Gauss-Newton */

/* curvature of the objective along one channel of one node, summed over the terms */
static double channel_curvature(const ambulo_workspace *workspace, int node, int channel, int i) {
  const ambulo_problem *p = workspace->problem;
  double y = workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
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

static void add_outer(int width, double curvature, const double *g, double *local) {
  for (int a = 0; a < width; a++) {
    double factor = curvature * g[a];
    if (factor == 0.0) continue;
    double *row = local + (size_t)a * (size_t)width;
    for (int b = 0; b < width; b++) row[b] += factor * g[b];
  }
}

/* The part of a form that stands on `node`, as a local gradient; 0 if it has none. A form over
 * two nodes is split by 2 a^2 + 2 b^2 >= (a + b)^2, which keeps the matrix local to the node and
 * above the true one. */
static int form_gradient(const ambulo_workspace *workspace, int node, int ahead,
                         const ambulo__form *form, double *g, int *shared) {
  int parts = 0;
  memset(g, 0, (size_t)ambulo__node_width(workspace->problem, node) * sizeof *g);
  *shared = 0;
  for (int c = 0; c < form->count; c++) {
    if (form->ahead[c] != ahead) {
      *shared = 1;
      continue;
    }
    add_channel(workspace, node, form->channel[c], form->slope[c], g);
    parts++;
  }
  return parts;
}

static void add_composite(const ambulo_workspace *workspace, const ambulo_term *term, int node,
                          double *local) {
  const ambulo_problem *p = workspace->problem;
  ambulo__term_frame frame = ambulo__term_frame_of(workspace);
  double *g = workspace->local_scratch;
  int width = ambulo__node_width(p, node), last = term->kind == AMBULO_TORQUE_RATE;
  for (int ahead = 0; ahead <= last; ahead++) {
    int base = node - ahead;
    if (base < 0) continue;
    double weight = term->weight * ambulo__term_quadrature(p, term, base);
    int count = ambulo__term_forms(term, &frame, base), shared = 0;
    for (int j = 0; j < count; j++) {
      ambulo__form form;
      ambulo__term_form(term, &frame, base, j, &form);
      if (!form_gradient(workspace, node, ahead, &form, g, &shared)) continue;
      double curvature = weight * ambulo__term_residual(term, form.u).curvature;
      add_outer(width, shared ? 2.0 * curvature : curvature, g, local);
    }
  }
}

void ambulo__node_gauss_newton(const ambulo_workspace *workspace, int node, double *local) {
  const ambulo_problem *p = workspace->problem;
  double *g = workspace->local_scratch;
  int width = ambulo__node_width(p, node), d = p->coordinates;
  for (int order = 0; order < 4; order++) {
    for (int i = 0; i < d; i++) {
      int channel = order * d + i;
      double curvature = channel_curvature(workspace, node, channel, i);
      if (curvature == 0.0) continue;
      ambulo__channel_local_gradient(workspace, node, channel, g);
      add_outer(width, curvature, g, local);
    }
  }
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    if (!ambulo__is_user_term(term) && !ambulo__term_is_simple(term) && term->weight > 0.0)
      add_composite(workspace, term, node, local);
  }
}
