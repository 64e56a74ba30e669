/* nlp/local_rows.c - gradients of channels and rows with respect to a node's local unknowns.
 *
 * A node's motion is D^o q_i = sum_c b_o[c] x[(first + c) d + i] (trajectory/basis.h). A
 * channel y with partial derivatives y_q, y_qd, y_qdd therefore has
 *
 *   dy / dx[(first + c) d + i] = b_0[c] y_q[i] + b_1[c] y_qd[i] + b_2[c] y_qdd[i]
 *
 * Local index c * d + i. A row is a sum of channels.
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
  const ambulo__row_table *table = &workspace->problem->table;
  const ambulo__curved *curved = ambulo__row_curved_of(table, &table->rows[row]);
  int node = table->rows[row].node, channel[AMBULO__CURVED_CHANNELS];
  int count = curved ? ambulo__curved_channels(curved, channel) : 0;
  for (int k = 0; k < count; k++) {
    double by = factor * slope[channel[k]];
    if (by != 0.0) add_channel(workspace, node, channel[k], by, gradient);
  }
  if (curved) return;
  for (int c = 0; c < workspace->channel_count; c++) {
    if (slope[c] != 0.0) add_channel(workspace, node, c, factor * slope[c], gradient);
  }
}

/* (LR) one row, on the unknowns of its node */
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
