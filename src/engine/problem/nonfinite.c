/* problem/nonfinite.c - where a value or a derivative is not finite (nlp.h).
 *
 * Values: the unknowns, then the rows, then each term node by node, with the channels that the
 * failed evaluation left. Derivatives: the reverse sweep of gradient.c once more, piece by piece;
 * the first adjoint that is not finite stands at a node and a channel. Adjoints that are all
 * finite leave the mechanics, where block by block the lanes tell the node.
 */

#include "problem/callbacks.h"
#include "problem/nlp.h"

#include <math.h>
#include <stdio.h>

static ambulo_fault fault_at(const ambulo_problem *p, ambulo_fault_kind kind, int node,
                             double value) {
  ambulo_fault fault = {.kind = kind,
                        .name = "",
                        .subject = "",
                        .detail = "",
                        .by = "",
                        .of = "",
                        .node = node,
                        .time = node >= 0 ? p->times[node] : 0.0,
                        .value = value};
  return fault;
}

static ambulo_fault term_fault(const ambulo_problem *p, int term, int node, double value) {
  ambulo_fault fault = fault_at(p, AMBULO_FAULT_TERM, node, value);
  fault.name = ambulo_problem_term_name(p, term);
  return fault;
}

static ambulo_fault row_fault(const ambulo_problem *p, int row, double value) {
  const ambulo__table_row *r = &p->table.rows[row];
  ambulo_fault fault = fault_at(p, AMBULO_FAULT_ROW, r->node, value);
  fault.name = r->family;
  fault.subject = r->subject;
  fault.detail = r->detail;
  fault.time = r->time;
  return fault;
}

/* ------------------------------------------------------------------- values */

/* what a term adds up at one node, without its weight */
static double node_value(ambulo_workspace *workspace, const ambulo_term *term, int node) {
  const ambulo_problem *p = workspace->problem;
  double sum = 0.0;
  if (ambulo__is_user_term(term)) return ambulo__user_term_value(workspace, term, node);
  if (ambulo__term_is_simple(term)) {
    for (int i = 0; i < p->coordinates; i++) {
      int channel = ambulo__term_channel(term, &p->channels, i);
      double y = workspace->channel[ambulo__lane_index(node, workspace->channel_count, channel)];
      double scale = ambulo__term_scale(term, i);
      double u = scale * (y - ambulo__term_offset(term, p->lean, p->coordinates, node, i));
      if (scale != 0.0) sum += ambulo__term_residual(term, u).value;
    }
    return sum;
  }
  ambulo__term_context context = ambulo__term_context_of(workspace);
  int forms = ambulo__term_forms(term, &context, node);
  for (int j = 0; j < forms; j++) {
    ambulo__form form;
    ambulo__term_form(term, &context, node, j, &form);
    if (form.count) sum += ambulo__term_residual(term, form.u).value;
  }
  return sum;
}

static ambulo_fault find_value(ambulo_workspace *workspace) {
  const ambulo_problem *p = workspace->problem;
  for (int j = 0; j < p->variables; j++) {
    if (isfinite(workspace->x[j])) continue;
    ambulo_fault fault = fault_at(p, AMBULO_FAULT_UNKNOWN, -1, workspace->x[j]);
    fault.of = ambulo_model_coordinate(p->model, j % p->coordinates)->name;
    return fault;
  }
  for (int r = 0; r < p->rows; r++) {
    if (!isfinite(workspace->row_value[r])) return row_fault(p, r, workspace->row_value[r]);
  }
  for (int t = 0; t < p->definition.term_count; t++) {
    if (isfinite(workspace->term_value[t])) continue;
    for (int k = 0; k < p->nodes; k++) {
      double value = node_value(workspace, &p->definition.terms[t], k);
      if (!isfinite(value)) return term_fault(p, t, k, value);
    }
    return term_fault(p, t, -1, workspace->term_value[t]);
  }
  return fault_at(p, AMBULO_FAULT_SUM, -1, workspace->objective);
}

void ambulo__fault_of_values(ambulo_workspace *workspace) {
  workspace->fault = find_value(workspace);
}

/* -------------------------------------------------------------- derivatives */

static void name_channel(const ambulo_problem *p, int channel, ambulo_fault *fault) {
  static const char *const orders[] = {"q", "qd", "qdd", "tau"};
  static const char *const wrench[] = {"M x", "M y", "M z", "F x", "F y", "F z"};
  const int d = p->coordinates, point = channel - ambulo__channel_point(&p->channels, 0, 0);
  if (channel < 4 * d) {
    fault->by = orders[channel / d];
    fault->of = ambulo_model_coordinate(p->model, channel % d)->name;
  } else if (point < 0) {
    fault->by = "wrench";
    fault->of = wrench[channel - 4 * d];
  } else if (point < 3 * p->channels.points) {
    fault->by = "points";
    fault->of = ambulo_model_point(p->model, point / 3)->name;
  } else if (channel >= ambulo__channel_effort(&p->channels, 0)) {
    fault->by = "device";
    fault->of = p->definition.devices[channel - ambulo__channel_effort(&p->channels, 0)].name;
  } else {
    fault->by = "reaction";
    fault->of = "ground";
  }
}

/* the first adjoint that is not finite: its node and channel; 0 when there is none */
static int find_adjoint(const ambulo_workspace *workspace, int channels, int *node, int *channel) {
  for (int k = 0; k < workspace->problem->nodes; k++) {
    for (int c = 0; c < channels; c++) {
      if (isfinite(workspace->weight[ambulo__lane_index(k, workspace->channel_count, c)])) continue;
      *node = k;
      *channel = c;
      return 1;
    }
  }
  return 0;
}

static double adjoint_at(const ambulo_workspace *workspace, int node, int channel) {
  return workspace->weight[ambulo__lane_index(node, workspace->channel_count, channel)];
}

/* adjoints are there: does one of them, of a term or of rows, say where? */
static int take_adjoint(ambulo_workspace *workspace, ambulo_fault fault) {
  int channel = 0;
  if (!find_adjoint(workspace, workspace->channel_count, &fault.node, &channel)) return 0;
  fault.time = workspace->problem->times[fault.node];
  fault.value = adjoint_at(workspace, fault.node, channel);
  fault.derivative = 1;
  name_channel(workspace->problem, channel, &fault);
  workspace->fault = fault;
  return 1;
}

static int find_term(ambulo_workspace *workspace, int term, double *scratch) {
  ambulo__adjoint_clear(workspace, scratch);
  ambulo__adjoint_term(workspace, term, 1.0);
  return take_adjoint(workspace, term_fault(workspace->problem, term, -1, NAN));
}

/* the row of the caller at this node whose slopes are not finite; others have constant ones */
static int row_at(const ambulo_workspace *workspace, const double *row_weights, int node) {
  const ambulo_problem *p = workspace->problem;
  for (int r = 0; r < p->rows; r++) {
    if (p->table.rows[r].node != node || row_weights[r] == 0.0) continue;
    if (!isfinite(row_weights[r])) return r;
    if (p->table.rows[r].user < 0) continue;
    const double *slope = ambulo__user_slope(workspace, r);
    for (int c = 0; c < workspace->channel_count; c++) {
      if (!isfinite(slope[c])) return r;
    }
  }
  return -1;
}

static int find_row(ambulo_workspace *workspace, const double *row_weights, double *scratch) {
  ambulo__adjoint_clear(workspace, scratch);
  ambulo__adjoint_rows(workspace, row_weights, scratch);
  int node = 0, channel = 0;
  if (!find_adjoint(workspace, workspace->channel_count, &node, &channel)) return 0;
  int row = row_at(workspace, row_weights, node);
  if (row < 0) return 0;
  return take_adjoint(workspace, row_fault(workspace->problem, row, NAN));
}

/* the reverse sweep of the mechanics, from adjoints that are finite */
static void find_mechanics(ambulo_workspace *workspace) {
  const ambulo_problem *p = workspace->problem;
  for (int block = 0; block < p->blocks; block++) ambulo__adjoint_block(workspace, block);
  int node = 0, channel = 0;
  if (!find_adjoint(workspace, 3 * p->coordinates, &node, &channel)) return;
  workspace->fault =
      fault_at(p, AMBULO_FAULT_MECHANICS, node, adjoint_at(workspace, node, channel));
  workspace->fault.derivative = 1;
  name_channel(p, channel, &workspace->fault);
}

void ambulo__fault_of_curvature(ambulo_workspace *workspace, double value) {
  workspace->fault = fault_at(workspace->problem, AMBULO_FAULT_SUM, -1, value);
  workspace->fault.derivative = 2;
}

/* finite parts, but a sum that is not */
static void take_sum(ambulo_workspace *workspace, const double *gradient) {
  const ambulo_problem *p = workspace->problem;
  workspace->fault = fault_at(p, AMBULO_FAULT_SUM, -1, NAN);
  workspace->fault.derivative = 1;
  for (int j = 0; j < p->variables; j++) {
    if (isfinite(gradient[j])) continue;
    workspace->fault.value = gradient[j];
    workspace->fault.by = "unknown";
    workspace->fault.of = ambulo_model_coordinate(p->model, j % p->coordinates)->name;
    return;
  }
}

/* of terms [first, end) and of rows (NULL: none) */
static void find_gradient(ambulo_workspace *workspace, int first, int end, double objective_weight,
                          const double *row_weights, const double *gradient) {
  double *scratch = workspace->fault_scratch;
  take_sum(workspace, gradient);
  for (int t = first; t < end; t++) {
    double weight = workspace->problem->definition.terms[t].weight;
    if (objective_weight * weight != 0.0 && find_term(workspace, t, scratch)) return;
  }
  if (row_weights && find_row(workspace, row_weights, scratch)) return;
  ambulo__adjoint_clear(workspace, scratch);
  for (int t = first; t < end; t++) ambulo__adjoint_term(workspace, t, objective_weight);
  if (row_weights) ambulo__adjoint_rows(workspace, row_weights, scratch);
  find_mechanics(workspace);
}

void ambulo__fault_of_gradient(ambulo_workspace *workspace, double objective_weight,
                               const double *row_weights, const double *gradient) {
  find_gradient(workspace, 0, workspace->problem->definition.term_count, objective_weight,
                row_weights, gradient);
}

void ambulo__fault_of_term_gradient(ambulo_workspace *workspace, int term, const double *gradient) {
  find_gradient(workspace, term, term + 1, 1.0, NULL, gradient);
}

void ambulo__fault_of_row(ambulo_workspace *workspace, int row, int variable, double value) {
  const ambulo_problem *p = workspace->problem;
  ambulo_fault fault = row_fault(p, row, value);
  fault.derivative = 1;
  fault.by = "unknown";
  fault.of = ambulo_model_coordinate(p->model, variable % p->coordinates)->name;
  if (p->table.rows[row].user >= 0) {
    const double *slope = ambulo__user_slope(workspace, row);
    for (int c = workspace->channel_count - 1; c >= 0; c--) {
      if (!isfinite(slope[c])) name_channel(p, c, &fault);
    }
  }
  workspace->fault = fault;
}

/* -------------------------------------------------------------------- words */

static void owner_text(const ambulo_fault *f, char *text, size_t size) {
  switch (f->kind) {
  case AMBULO_FAULT_TERM:
    (void)snprintf(text, size, "objective term '%s'", f->name);
    break;
  case AMBULO_FAULT_ROW:
    (void)snprintf(text, size, "row %s%s%s%s%s%s", f->name, f->subject[0] ? " of " : "", f->subject,
                   f->detail[0] ? " (" : "", f->detail, f->detail[0] ? ")" : "");
    break;
  case AMBULO_FAULT_MECHANICS:
    (void)snprintf(text, size, "the inverse dynamics");
    break;
  case AMBULO_FAULT_UNKNOWN:
    (void)snprintf(text, size, "an unknown of %s", f->of);
    break;
  case AMBULO_FAULT_SUM:
    (void)snprintf(text, size,
                   f->derivative == 2 ? "the objective" : "the objective with its rows");
    break;
  case AMBULO_FAULT_NONE:
    break;
  }
}

void ambulo_fault_text(const ambulo_fault *f, char *buffer, size_t size) {
  char owner[240] = "", by[200] = "", place[64] = "";
  if (!f || f->kind == AMBULO_FAULT_NONE) {
    if (size) (void)snprintf(buffer, size, "every value and derivative is finite");
    return;
  }
  const char *what = f->derivative == 0   ? "value"
                     : f->derivative == 1 ? "derivative"
                                          : "second derivative";
  owner_text(f, owner, sizeof owner);
  if (f->derivative == 1) (void)snprintf(by, sizeof by, " by %s of %s", f->by, f->of);
  if (f->node >= 0) {
    (void)snprintf(place, sizeof place, " at node %d (t = %.6g s)", f->node, f->time);
  } else if (f->kind == AMBULO_FAULT_ROW) {
    (void)snprintf(place, sizeof place, " at t = %.6g s", f->time);
  }
  (void)snprintf(buffer, size, "the %s of %s%s%s is %s", what, owner, by, place,
                 isnan(f->value) ? "not a number" : "infinite");
}
