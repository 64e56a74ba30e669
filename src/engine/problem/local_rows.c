/* problem/local_rows.c - gradients of channels and rows with respect to a node's local unknowns.
 *
 * A node's motion is D^o q_i = sum_c b_o[c] x[(first + c) d + i] (trajectory/basis.h). A
 * channel y with partial derivatives y_q, y_qd, y_qdd therefore has
 *
 *   dy / dx[(first + c) d + i] = b_0[c] y_q[i] + b_1[c] y_qd[i] + b_2[c] y_qdd[i]
 *
 * Local index c * d + i. A row is a sum of channels, and so are its slopes y_q, y_qd and y_qdd.
 */
#include "problem/nlp.h"
#include "problem/callbacks.h"

#include <string.h>

/* adds factor * (slopes of a channel by q, qd and qdd) */
static void add_channel(const ambulo_workspace *workspace, int node, int channel, double factor,
                        double *slopes) {
  int outputs = ambulo__channel_outputs(&workspace->problem->channels);
  if (channel < outputs) {
    slopes[channel] += factor;
  } else {
    ambulo__output_add(workspace, node, channel - outputs, factor, slopes);
  }
}

/* adds the gradient by the control points of what has these slopes */
static void add_motion(const ambulo_problem *p, int node, const double *restrict slopes,
                       double *restrict gradient) {
  const ambulo__basis_point *point = &ambulo__lane_map_points(p->map)[node];
  const int d = p->coordinates;
  for (int c = 0; c < point->span; c++, gradient += d) {
    const double b0 = point->weight[0][c], b1 = point->weight[1][c], b2 = point->weight[2][c];
    for (int i = 0; i < d; i++)
      gradient[i] += b0 * slopes[i] + b1 * slopes[d + i] + b2 * slopes[2 * d + i];
  }
}

static double *no_slopes(const ambulo_workspace *workspace) {
  size_t entries = 3 * (size_t)workspace->problem->coordinates;
  return memset(workspace->motion_scratch, 0, entries * sizeof(double));
}

void ambulo__channel_local_gradient(const ambulo_workspace *workspace, int node, int channel,
                                    double *gradient) {
  const ambulo_problem *p = workspace->problem;
  double *slopes = no_slopes(workspace);
  memset(gradient, 0, (size_t)ambulo__node_width(p, node) * sizeof *gradient);
  add_channel(workspace, node, channel, 1.0, slopes);
  add_motion(p, node, slopes, gradient);
}

/* a row that is a function of its own, times a factor */
static void add_user_row(const ambulo_workspace *workspace, int row, double factor,
                         double *slopes) {
  const double *slope = ambulo__user_slope(workspace, row);
  const ambulo__row_table *table = &workspace->problem->table;
  const ambulo__curved *curved = ambulo__row_curved_of(table, &table->rows[row]);
  int node = table->rows[row].node, channel[AMBULO__CURVED_CHANNELS];
  int count = curved ? ambulo__curved_channels(curved, channel) : 0;
  for (int k = 0; k < count; k++) {
    double by = factor * slope[channel[k]];
    if (by != 0.0) add_channel(workspace, node, channel[k], by, slopes);
  }
  if (curved) return;
  for (int c = 0; c < workspace->channel_count; c++) {
    if (slope[c] != 0.0) add_channel(workspace, node, c, factor * slope[c], slopes);
  }
}

void ambulo__row_slopes(const ambulo_workspace *workspace, int row, double *slopes) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  memset(slopes, 0, 3 * (size_t)p->coordinates * sizeof *slopes);
  if (r->user >= 0) {
    add_user_row(workspace, row, 1.0, slopes);
    return;
  }
  const ambulo__row_term *term = p->table.terms + r->first_term;
  for (int t = 0; t < r->term_count; t++)
    add_channel(workspace, r->node, term[t].channel, term[t].coefficient, slopes);
}

/* (LR) one row, on the unknowns of its node */
void ambulo__row_local_gradient(const ambulo_workspace *workspace, int row, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  int node = p->table.rows[row].node;
  memset(gradient, 0, (size_t)ambulo__node_width(p, node) * sizeof *gradient);
  ambulo__row_slopes(workspace, row, workspace->motion_scratch);
  add_motion(p, node, workspace->motion_scratch, gradient);
}

void ambulo__row_add_gradient(const ambulo_workspace *workspace, int row, double factor,
                              double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  if (r->user >= 0) {
    double *slopes = no_slopes(workspace);
    add_user_row(workspace, row, factor, slopes);
    add_motion(p, r->node, slopes, gradient + ambulo__node_first(p, r->node));
    return;
  }
  const ambulo__row_term *term = p->table.terms + r->first_term;
  for (int t = 0; t < r->term_count; t++) {
    double value = factor * term[t].coefficient;
    if (term[t].node < 0) {
      gradient[term[t].channel] += value;
    } else {
      double *slopes = no_slopes(workspace);
      add_channel(workspace, term[t].node, term[t].channel, value, slopes);
      add_motion(p, term[t].node, slopes, gradient + ambulo__node_first(p, term[t].node));
    }
  }
}

int ambulo__channel_orders(const ambulo_problem *p, int channel) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  ambulo__row_part part[AMBULO__MOST_PARTS];
  int output = channel - ambulo__channel_outputs(&p->channels), first_point = p->coordinates + 6;
  if (output < 0) return channel < p->coordinates ? 1 : 3;
  int is_point = output >= first_point && output < first_point + 3 * p->channels.points;
  if ((p->devices || p->holds) && !is_point) return 3;
  int parts = ambulo__plan_parts(p->plan, output, part);
  for (int k = 0; k < parts; k++) {
    if (pattern.rate_start[part[k].row] >= 0 && !part[k].by_acceleration) return 3;
  }
  return 1;
}
