/* problem/row_gradients.c - gradients of channels and rows with respect to a node's local unknowns.
 *
 * A node's motion is D^o q_i = sum_c b_o[c] x[(first + c) d + i] (trajectory/basis.h). A
 * channel y with partial derivatives y_q, y_qd, y_qdd therefore has
 *
 *   dy / dx[(first + c) d + i] = b_0[c] y_q[i] + b_1[c] y_qd[i] + b_2[c] y_qdd[i]
 *
 * Local index c * d + i. A row is a sum of channels, and so are its slopes y_q, y_qd and y_qdd.
 */
#include "mechanics/lane_transpose.h"
#include "problem/callbacks.h"
#include "problem/hold_wrench.h"
#include "problem/nlp.h"

#include <string.h>

/* ------------------------------------------------------------ outputs of the mechanics */

/* Their gradients by a node's q, qd and qdd. A row of the mechanics is a sum of parts
 * (mechanics/plan.h):
 *
 *   y_o[i] = sum_parts factor jq[times] (entry of the part's row in column i, order o)
 *
 * With ground reaction most parts of most rows are rows of the root wrench. Those of a node are
 * put side by side, [order][row][column], once for all that are made of them.
 */

int ambulo__wrench_entries(const ambulo_problem *p) {
  return ambulo__plan_contacts(p->plan) ? 6 * p->coordinates : 0;
}

void ambulo__wrench_gather(ambulo_workspace *workspace, int block) {
  const ambulo_problem *p = workspace->problem;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  const int entries = ambulo__wrench_entries(p), first = block * AMBULO__LANES;
  const int row = p->coordinates, start = pattern.start[row], rates = pattern.rate_start[row];
  const double *jqd = workspace->jqd + ambulo__lane_index(first, pattern.dynamic_count, rates);
  const double *jqdd = workspace->jqdd + ambulo__lane_index(first, pattern.dynamic_count, rates);
  if (entries == 0) return;
  ambulo__lanes_scatter(workspace->wrench[0],
                        workspace->jq + ambulo__lane_index(first, pattern.count, start), entries,
                        first, p->nodes);
  ambulo__lanes_scatter(workspace->wrench[1], jqd, entries, first, p->nodes);
  ambulo__lanes_scatter(workspace->wrench[2], jqdd, entries, first, p->nodes);
}

/* What a row of the mechanics has of the rows of the root wrench. */
typedef struct wrench_factors {
  double moment[3], force[3], by_acceleration[3]; /* the last: of the force by qdd, for q */
} wrench_factors;

/* to += sum of factor[k] times row k of three */
static void add_rows(int d, const double factor[3], const double *rows, double *restrict to) {
  const double *x = rows, *y = rows + d, *z = rows + 2 * d;
  const double a = factor[0], b = factor[1], c = factor[2];
  for (int i = 0; i < d; i++) to[i] += a * x[i] + b * y[i] + c * z[i];
}

static int is_zero(const double v[3]) {
  return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0;
}

static void add_wrench(const ambulo_workspace *workspace, int node, const wrench_factors *f,
                       double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const int d = p->coordinates;
  const size_t at = (size_t)node * (size_t)ambulo__wrench_entries(p);
  for (int o = 0; o < 3; o++) {
    const double *moment = workspace->wrench[o] + at, *force = moment + 3 * d;
    if (!is_zero(f->moment)) add_rows(d, f->moment, moment, gradient + o * d);
    if (!is_zero(f->force)) add_rows(d, f->force, force, gradient + o * d);
  }
  if (is_zero(f->by_acceleration)) return;
  const double *force = workspace->bare_force ? workspace->bare_force + (size_t)node * 3 * (size_t)d
                                              : workspace->wrench[2] + at + 3 * d;
  add_rows(d, f->by_acceleration, force, gradient);
}

static void add_entries(const ambulo_workspace *workspace, int node, int row, double factor,
                        double *gradient) {
  const ambulo_problem *p = workspace->problem;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  const int d = p->coordinates, n = pattern.dynamic_count, start = pattern.start[row];
  const int count = pattern.start[row + 1] - start, rates = pattern.rate_start[row];
  const int *column = pattern.column + start;
  const double *jq = workspace->jq + ambulo__lane_index(node, pattern.count, start);
  for (int e = 0; e < count; e++) gradient[column[e]] += factor * jq[e * AMBULO__LANES];
  if (rates < 0) return;
  const int *by_qdd = pattern.by_qdd + rates;
  const double *jqd = workspace->jqd + ambulo__lane_index(node, n, rates);
  const double *jqdd = workspace->jqdd + ambulo__lane_index(node, n, 0);
  for (int e = 0; e < count; e++) {
    gradient[d + column[e]] += factor * jqd[e * AMBULO__LANES];
    gradient[2 * d + column[e]] += factor * jqdd[by_qdd[e] * AMBULO__LANES];
  }
}

/* Where the factor of a row of the root wrench belongs; NULL: another row. */
static double *wrench_factor(const ambulo_problem *p, const ambulo__row_part *part,
                             wrench_factors *f) {
  int row = part->row - p->coordinates;
  if (row < 0 || row >= 6 || !ambulo__plan_contacts(p->plan)) return NULL;
  if (part->by_acceleration) return &f->by_acceleration[row - 3];
  return row < 3 ? &f->moment[row] : &f->force[row - 3];
}

/* what devices add to the gradient of a torque, or all of that of an effort; 1: the latter */
static int add_devices(const ambulo_workspace *workspace, int node, int output, double *gradient) {
  const ambulo_problem *p = workspace->problem;
  int device = output - ambulo__plan_rows(p->plan);
  const double *kept =
      workspace->device_states + (size_t)node * ambulo__devices_entries(p->devices);
  if (output < p->coordinates) ambulo__devices_add_torque(p->devices, kept, output, gradient);
  if (device >= 0) ambulo__devices_add_effort(p->devices, kept, device, gradient);
  return device >= 0;
}

/* what is not of the bodies alone, times `times`; 1: that is all */
static int add_others(const ambulo_workspace *workspace, int node, int output, double times,
                      double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const int entries = 3 * p->coordinates;
  double *one = workspace->other_scratch;
  int all = 0;
  if (!p->devices && !p->holds) return 0;
  memset(one, 0, (size_t)entries * sizeof *one);
  if (p->devices) all = add_devices(workspace, node, output, one);
  if (p->holds && !all) ambulo__hold_wrench_add_output(workspace, node, output, one);
  for (int e = 0; e < entries; e++) gradient[e] += times * one[e];
  return all;
}

/* adds the gradient [3][d] of an output at a node, times a factor */
static void add_output(const ambulo_workspace *workspace, int node, int output, double times,
                       double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const int entries = ambulo__plan_get_pattern(p->plan).count;
  ambulo__row_part part[AMBULO__MOST_PARTS];
  wrench_factors wrench = {{0.0}, {0.0}, {0.0}};
  if (add_others(workspace, node, output, times, gradient)) return;
  int parts = ambulo__plan_parts(p->plan, output, part), reacts = 0;
  for (int k = 0; k < parts; k++) {
    double factor = times * part[k].factor, *sum = wrench_factor(p, &part[k], &wrench);
    if (part[k].times >= 0) {
      factor *= workspace->jq[ambulo__lane_index(node, entries, part[k].times)];
    }
    if (sum) {
      *sum += factor;
      reacts = 1;
    } else {
      add_entries(workspace, node, part[k].row, factor, gradient);
    }
  }
  if (reacts) add_wrench(workspace, node, &wrench, gradient);
}

void ambulo__output_gradient(const ambulo_workspace *workspace, int node, int output,
                             double *gradient) {
  memset(gradient, 0, 3 * (size_t)workspace->problem->coordinates * sizeof *gradient);
  add_output(workspace, node, output, 1.0, gradient);
}

/* ------------------------------------------------------------------ channels and rows */

/* adds factor * (slopes of a channel by q, qd and qdd) */
static void add_channel(const ambulo_workspace *workspace, int node, int channel, double factor,
                        double *slopes) {
  int outputs = ambulo__channel_outputs(&workspace->problem->channels);
  if (channel < outputs) {
    slopes[channel] += factor;
  } else {
    add_output(workspace, node, channel - outputs, factor, slopes);
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
