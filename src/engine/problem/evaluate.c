/* problem/evaluate.c - one point: channels, objective and rows, everything once.
 *
 * Quantities (d coordinates, N + 1 nodes, blocks of 8 nodes):
 *   x         [control_points][d]            unknowns
 *   channel   [blocks][channels][8]          q, qd, qdd, tau, M, F, points (contact/rows.h)
 *   row       c_r = constant + sum coefficient * channel         (Eqs. 14, 17')
 *   objective J = sum_terms weight sum_k w_k sum_i phi(u_ik)      (Eq. 13, trapezoidal w_k)
 *
 * x -> (q, qd, qdd) is linear (trajectory/basis.h), (q, qd, qdd) -> (tau, M, F, points) is
 * the forward recursion, channels -> rows and J is local to a node. Cost O(N).
 *
 * Everything is cached on x: solvers ask for the objective, the constraints and their
 * gradients separately, and SLSQP repeats every third point.
 */
#include "base/arithmetic.h"
#include "problem/callbacks.h"
#include "problem/hold_wrench.h"
#include "problem/nlp.h"

#include <math.h>
#include <string.h>

static double *block_of(const ambulo_workspace *workspace, double *base, int block) {
  return base + (size_t)block * (size_t)workspace->channel_count * AMBULO__LANES;
}

static double channel_at(const ambulo_workspace *workspace, int node, int channel) {
  return workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
}

void ambulo__mechanics_block(const ambulo_problem *p, const double *ground, const double *factors,
                             int block, double *c, double *scratch, double *room) {
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  const double *of_block = ambulo__time_factor_block(p, factors, block);
  ambulo__hold_wrench_begin(p, of_block, c, scratch, room);
  p->kernels->outputs(p->plan, c, c + d8, c + 2 * d8, ambulo__ground_block(p, ground, block),
                      c + 3 * d8, scratch);
  ambulo__hold_wrench_end(p, c, room);
  if (!p->devices) return;
  double *effort = c + (size_t)ambulo__channel_effort(&p->channels, 0) * AMBULO__LANES;
  ambulo__devices_apply(p->devices, c, c + d8, of_block, c + 3 * d8, effort, room);
}

static void compute_channels(ambulo_workspace *workspace, const double *x) {
  const ambulo_problem *p = workspace->problem;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  size_t stride = (size_t)workspace->channel_count * AMBULO__LANES;
  double *c = workspace->channel;
  ambulo__lane_map_forward(p->map, x, c, c + d8, c + 2 * d8, NULL, stride);
  for (int block = 0; block < p->blocks; block++)
    ambulo__mechanics_block(p, p->ground, p->time_factors, block, block_of(workspace, c, block),
                            workspace->scratch, workspace->device_scratch);
}

/* (13) w_k times each term, summed over the nodes; on the way the slopes of all but those of the
 * caller, since whoever asks for a value asks for the gradient next */
static double evaluate_terms(ambulo_workspace *workspace) {
  const ambulo_problem_definition *definition = &workspace->problem->definition;
  size_t lanes = (size_t)workspace->problem->blocks * (size_t)workspace->channel_count;
  double total = 0.0;
  memset(workspace->term_slope, 0, lanes * AMBULO__LANES * sizeof *workspace->term_slope);
  for (int t = 0; t < definition->term_count; t++) {
    const ambulo_term *term = &definition->terms[t];
    double value = ambulo__term_value(workspace, term, term->weight, workspace->term_slope);
    workspace->term_value[t] = term->weight * value;
    total += workspace->term_value[t];
  }
  return total;
}

/* the slopes on its own channels; the others are never looked at (problem/callbacks.h) */
static double curved_row_value(const ambulo_workspace *workspace, const ambulo__curved *row,
                               int node, double *slope) {
  const double *y = workspace->channel + ambulo__lane_index(node, workspace->channel_count, 0);
  int channel[AMBULO__CURVED_CHANNELS], count = ambulo__curved_channels(row, channel);
  for (int k = 0; k < count; k++) slope[channel[k]] = 0.0;
  return ambulo__curved_value(row, y, AMBULO__LANES, slope);
}

static double user_row_value(ambulo_workspace *workspace, int row) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__table_row *r = &p->table.rows[row];
  const ambulo__curved *curved = ambulo__row_curved_of(&p->table, r);
  double *slope = workspace->user_gradient +
                  (size_t)workspace->user_slot[row] * (size_t)workspace->channel_count;
  if (curved) return curved_row_value(workspace, curved, r->node, slope);
  memset(slope, 0, (size_t)workspace->channel_count * sizeof *slope);
  const ambulo_user_row *user = &p->definition.user_rows[r->user];
  ambulo__node_state_fill(workspace, r->node, workspace->node_state);
  ambulo_node_state state = ambulo__node_state_view(p, r->node, workspace->node_state);
  ambulo_node_gradient gradient = ambulo__node_gradient_view(p, slope);
  return user->function(user->user, &state, &gradient);
}

/* a row with a term on an unknown */
static double mixed_row_value(const ambulo_workspace *workspace, const ambulo__table_row *row) {
  const ambulo__row_term *term = workspace->problem->table.terms + row->first_term;
  double value = row->constant;
  for (int t = 0; t < row->term_count; t++) {
    double y = term[t].node < 0 ? workspace->x[term[t].channel]
                                : channel_at(workspace, term[t].node, term[t].channel);
    value += term[t].coefficient * y;
  }
  return value;
}

/* (14) (24) every row from the channels of its node */
static void evaluate_rows(ambulo_workspace *workspace) {
  const ambulo_problem *p = workspace->problem;
  const ambulo__row_runs *runs = &p->row_runs;
  ambulo__row_runs_values(runs, workspace->channel, workspace->row_value);
  for (int o = 0; o < runs->odd_count; o++) {
    int r = runs->odd[o];
    const ambulo__table_row *row = &p->table.rows[r];
    if (workspace->leaves_far_out && workspace->far[r]) continue;
    workspace->row_value[r] =
        row->user >= 0 ? user_row_value(workspace, r) : mixed_row_value(workspace, row);
  }
}

ambulo_status ambulo__evaluate(ambulo_workspace *workspace, const double *x) {
  size_t bytes = (size_t)workspace->problem->variables * sizeof *x;
  if (workspace->has_values && memcmp(x, workspace->x, bytes) == 0) return AMBULO_OK;
  double start = ambulo__seconds_now();
  if (x != workspace->x) memcpy(workspace->x, x, bytes);
  workspace->has_values = workspace->has_jacobian = 0;
  compute_channels(workspace, workspace->x);
  workspace->objective = evaluate_terms(workspace);
  evaluate_rows(workspace);
  int finite = ambulo__all_finite(workspace->row_value, (size_t)workspace->problem->rows) &&
               isfinite(workspace->objective);
  if (!finite) ambulo__fault_of_values(workspace);
  workspace->evaluations++;
  workspace->seconds_evaluate += ambulo__seconds_now() - start;
  if (!finite) return AMBULO_E_NUMERIC;
  workspace->has_values = 1;
  return AMBULO_OK;
}

static void keep_devices(ambulo_workspace *workspace) {
  const ambulo_problem *p = workspace->problem;
  size_t entries = ambulo__devices_entries(p->devices);
  for (int k = 0; k < p->nodes; k++) {
    const double *q = workspace->channel + ambulo__lane_index(k, workspace->channel_count, 0);
    ambulo__devices_keep(p->devices, q, q + (size_t)p->coordinates * AMBULO__LANES,
                         p->time_factors + ambulo__lane_index(k, ambulo__time_factor_entries(p), 0),
                         workspace->device_states + (size_t)k * entries);
  }
}

ambulo_status ambulo__evaluate_jacobian(ambulo_workspace *workspace, const double *x) {
  ambulo_status status = ambulo__evaluate(workspace, x);
  if (status || workspace->has_jacobian) return status;
  double start = ambulo__seconds_now();
  const ambulo_problem *p = workspace->problem;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  for (int b = 0; b < p->blocks; b++) {
    double *c = block_of(workspace, workspace->channel, b);
    size_t all = (size_t)b * (size_t)pattern.count * AMBULO__LANES;
    size_t dynamic = (size_t)b * (size_t)pattern.dynamic_count * AMBULO__LANES;
    ambulo__hold_wrench_begin(p, ambulo__time_factor_block(p, p->time_factors, b), c,
                              workspace->scratch, workspace->device_scratch);
    p->kernels->jacobian(p->plan, c, c + d8, c + 2 * d8, ambulo__ground_block(p, p->ground, b),
                         workspace->jq + all, workspace->jqd + dynamic, workspace->jqdd + dynamic,
                         workspace->scratch);
    ambulo__wrench_gather(workspace, b);
    ambulo__hold_wrench_gather(workspace, b);
  }
  if (p->devices) keep_devices(workspace);
  workspace->jacobians++;
  workspace->has_jacobian = 1;
  workspace->seconds_evaluate += ambulo__seconds_now() - start;
  return AMBULO_OK;
}

/* --------------------------------------------------------------------- gradient */

/* (L) B_0'g_q + B_1'g_qd + B_2'g_qdd */
ambulo_status ambulo__gradient(ambulo_workspace *workspace, double objective_weight,
                               const double *row_weights, double *gradient) {
  double start = ambulo__seconds_now();
  size_t n = (size_t)workspace->problem->variables;
  ambulo__adjoint_begin(workspace, objective_weight, gradient);
  if (row_weights) ambulo__adjoint_rows(workspace, row_weights, gradient);
  ambulo__adjoint_pull_back(workspace, gradient);
  int finite = ambulo__all_finite(gradient, n);
  if (!finite) ambulo__fault_of_gradient(workspace, objective_weight, row_weights, gradient);
  workspace->seconds_evaluate += ambulo__seconds_now() - start;
  return finite ? AMBULO_OK : AMBULO_E_NUMERIC;
}

ambulo_status ambulo__term_gradient(ambulo_workspace *workspace, int term, double *gradient) {
  ambulo__adjoint_clear(workspace, gradient);
  ambulo__adjoint_term(workspace, term, 1.0);
  ambulo__adjoint_pull_back(workspace, gradient);
  if (ambulo__all_finite(gradient, (size_t)workspace->problem->variables)) return AMBULO_OK;
  ambulo__fault_of_term_gradient(workspace, term, gradient);
  return AMBULO_E_NUMERIC;
}

/* ------------------------------------------------- public names (ambulo/evaluate.h) */

ambulo_status ambulo_problem_evaluate(const ambulo_problem *p, ambulo_workspace *workspace,
                                      const double *x, double *objective, double *terms,
                                      double *rows) {
  if (!p || !workspace || workspace->problem != p || !x) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__evaluate(workspace, x);
  if (status) return status;
  if (objective) *objective = workspace->objective;
  if (terms) memcpy(terms, workspace->term_value, (size_t)p->definition.term_count * sizeof *terms);
  if (rows) memcpy(rows, workspace->row_value, (size_t)p->rows * sizeof *rows);
  return AMBULO_OK;
}

ambulo_status ambulo_problem_gradient(const ambulo_problem *p, ambulo_workspace *workspace,
                                      const double *x, double objective_weight,
                                      const double *row_weights, double *gradient) {
  if (!p || !workspace || workspace->problem != p || !x || !gradient) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__evaluate(workspace, x);
  if (status) return status;
  return ambulo__gradient(workspace, objective_weight, row_weights, gradient);
}

ambulo_status ambulo_problem_row_gradient(const ambulo_problem *p, ambulo_workspace *workspace,
                                          const double *x, int row, double *gradient) {
  if (!p || !workspace || workspace->problem != p || !x || !gradient) return AMBULO_E_ARGUMENT;
  if (row < 0 || row >= p->rows) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__evaluate_jacobian(workspace, x);
  if (status) return status;
  memset(gradient, 0, (size_t)p->variables * sizeof *gradient);
  ambulo__row_add_gradient(workspace, row, 1.0, gradient);
  for (int j = 0; j < p->variables; j++) {
    if (isfinite(gradient[j])) continue;
    ambulo__fault_of_row(workspace, row, j, gradient[j]);
    return AMBULO_E_NUMERIC;
  }
  return AMBULO_OK;
}

const ambulo_fault *ambulo_workspace_fault(const ambulo_workspace *workspace) {
  return &workspace->fault;
}
