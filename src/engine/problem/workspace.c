/* problem/workspace.c - memory of one evaluation thread: sized once, never grown; and how much a
 * problem takes, before it is taken. */

#include "base/free_memory.h"
#include "problem/nlp.h"

#include <math.h>
#include <stdio.h>

static int user_row_instances(const ambulo_problem *problem) {
  int count = 0;
  for (int r = 0; r < problem->rows; r++) count += problem->table.rows[r].user >= 0;
  return count;
}

/* by far the largest part: the Jacobians of all nodes */
static ambulo_status allocate_jacobians(ambulo_workspace *w, const ambulo_problem *p) {
  const ambulo_allocator *a = &w->allocator;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  size_t block_entries = (size_t)p->blocks * AMBULO__LANES;
  size_t word = sizeof(double);
  w->jq = ambulo__alloc_aligned(a, block_entries * (size_t)pattern.count, word);
  w->jqd = ambulo__alloc_aligned(a, block_entries * (size_t)pattern.dynamic_count, word);
  w->jqdd = ambulo__alloc_aligned(a, block_entries * (size_t)pattern.dynamic_count, word);
  size_t wrench = (size_t)p->nodes * (size_t)ambulo__wrench_entries(p);
  int grounded = wrench > 0, gathered = 0;
  for (int o = 0; o < 3 && grounded; o++) {
    w->wrench[o] = ambulo__alloc_aligned(a, wrench, word);
    gathered += w->wrench[o] != NULL;
  }
  if (p->devices) {
    size_t kept = (size_t)p->nodes * ambulo__devices_entries(p->devices);
    w->device_states = ambulo__alloc_aligned(a, kept, word);
    if (!w->device_states) return AMBULO_E_MEMORY;
  }
  if (p->holds) {
    size_t nodes = (size_t)p->nodes;
    w->hold_states = ambulo__alloc_aligned(a, nodes * ambulo__holds_entries(p->holds), word);
    if (!w->hold_states) return AMBULO_E_MEMORY;
    if (grounded)
      w->bare_force = ambulo__alloc_aligned(a, 3 * nodes * (size_t)p->coordinates, word);
    if (grounded && !w->bare_force) return AMBULO_E_MEMORY;
  }
  int complete = w->jq && w->jqd && w->jqdd && gathered == 3 * grounded;
  return complete ? AMBULO_OK : AMBULO_E_MEMORY;
}

static ambulo_status allocate(ambulo_workspace *w, const ambulo_problem *p) {
  const ambulo_allocator *a = &w->allocator;
  size_t lane_channels = (size_t)p->blocks * (size_t)w->channel_count * AMBULO__LANES;
  size_t instances = (size_t)user_row_instances(p);
  size_t word = sizeof(double);
  w->x = ambulo__alloc_aligned(a, (size_t)p->variables, word);
  w->channel = ambulo__alloc_aligned(a, lane_channels, word);
  w->weight = ambulo__alloc_aligned(a, lane_channels, word);
  w->term_slope = ambulo__alloc_aligned(a, lane_channels, word);
  w->gradient_lanes = ambulo__alloc_aligned(a, 3 * (size_t)p->coordinates * AMBULO__LANES, word);
  w->scratch = ambulo__alloc_aligned(a, ambulo__plan_scratch(p->plan), word);
  w->row_value = ambulo__alloc_aligned(a, (size_t)p->rows, word);
  w->term_value = ambulo__alloc_aligned(a, (size_t)p->definition.term_count, word);
  w->user_gradient = ambulo__alloc_aligned(a, instances * (size_t)w->channel_count, word);
  w->user_slot = ambulo__alloc(a, (size_t)p->rows, sizeof *w->user_slot);
  w->node_state = ambulo__alloc_aligned(a, 2 * (size_t)w->channel_count, word);
  w->motion_scratch = ambulo__alloc_aligned(a, 3 * (size_t)p->coordinates, word);
  w->other_scratch = ambulo__alloc_aligned(a, 3 * (size_t)p->coordinates, word);
  w->fault_scratch = ambulo__alloc_aligned(a, (size_t)p->variables, word);
  if (p->devices || p->holds)
    w->device_scratch = ambulo__alloc_aligned(a, ambulo__device_scratch_size(p), word);
  if ((p->devices || p->holds) && !w->device_scratch) return AMBULO_E_MEMORY;
  int complete = w->x && w->channel && w->weight && w->term_slope && w->gradient_lanes &&
                 w->scratch && w->row_value && w->term_value && w->user_gradient && w->user_slot &&
                 w->node_state && w->motion_scratch && w->other_scratch && w->fault_scratch;
  return complete ? AMBULO_OK : AMBULO_E_MEMORY;
}

ambulo_status ambulo__workspace_create_for_values(const ambulo_problem *problem,
                                                  const ambulo_allocator *allocator,
                                                  ambulo_workspace **workspace) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_workspace *w = ambulo__alloc(&own, 1, sizeof *w);
  if (!w) return AMBULO_E_MEMORY;
  w->allocator = own;
  w->problem = problem;
  w->channel_count = ambulo__channel_count(&problem->channels);
  ambulo_status status = allocate(w, problem);
  if (status) {
    ambulo_workspace_free(w);
    return status;
  }
  int slot = 0;
  for (int r = 0; r < problem->rows; r++) {
    w->user_slot[r] = problem->table.rows[r].user >= 0 ? slot++ : -1;
  }
  *workspace = w;
  return AMBULO_OK;
}

ambulo_status ambulo_workspace_create(const ambulo_problem *problem,
                                      const ambulo_allocator *allocator,
                                      ambulo_workspace **workspace) {
  ambulo_workspace *w = NULL;
  if (!problem || !workspace) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__workspace_create_for_values(problem, allocator, &w);
  if (!status) status = allocate_jacobians(w, problem);
  if (status) {
    ambulo_workspace_free(w);
    return status;
  }
  *workspace = w;
  return AMBULO_OK;
}

void ambulo_workspace_free(ambulo_workspace *w) {
  if (!w) return;
  ambulo_allocator a = w->allocator;
  double *aligned[] = {w->x,
                       w->channel,
                       w->weight,
                       w->term_slope,
                       w->gradient_lanes,
                       w->scratch,
                       w->jq,
                       w->jqd,
                       w->jqdd,
                       w->row_value,
                       w->term_value,
                       w->user_gradient,
                       w->node_state,
                       w->motion_scratch,
                       w->other_scratch,
                       w->fault_scratch,
                       w->wrench[0],
                       w->wrench[1],
                       w->wrench[2],
                       w->device_scratch,
                       w->device_states,
                       w->hold_states,
                       w->bare_force};
  for (size_t i = 0; i < sizeof aligned / sizeof *aligned; i++)
    ambulo__free_aligned(&a, aligned[i]);
  ambulo__free(&a, w->user_slot);
  ambulo__free(&a, w);
}

/* -------------------------------------------------------------------- predictions */

/* With d coordinates, C channels, E entries of the Jacobian's pattern (D of them dynamic) and N + 1
 * nodes in blocks of 8:
 *
 *     values      8 B a channel and node, three times (channels, their adjoints, slopes of terms)
 *     Jacobians   8 B (E + 2 D) a node, and 3 x 48 d B with ground reaction; what devices keep
 *     scratch     of inverse dynamics in one block of nodes, once
 *     a row       its table (names, time, terms), its place in the runs, its value
 */

enum { MOST_ROWS = 50000000 };

static const double terms_of_a_row = 3.5; /* of walks; 1 of limits, 6 of centres of pressure */
static const double growth = 1.5;         /* arrays that double are filled to 3/4 on average */

/* of capsules and obstacles */
static double solid_rows(const ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  double per_node = d->collision.pair_count;
  for (int o = 0; o < d->obstacle_count; o++)
    per_node += d->obstacles[o].capsules ? d->obstacles[o].capsule_count : p->model->capsule_count;
  return per_node * p->nodes;
}

double ambulo__workspace_bytes(const ambulo_problem *p, int with_jacobians) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  double lanes = 8.0 * p->blocks, word = sizeof(double);
  double bytes = 3.0 * lanes * word * ambulo__channel_count(&p->channels);
  bytes += word * (2.0 * p->variables + 1.5 * p->rows);
  bytes += word * solid_rows(p) * ambulo__channel_count(&p->channels);
  bytes += word * (double)ambulo__plan_scratch(p->plan);
  if (!with_jacobians) return bytes;
  bytes += lanes * word * (pattern.count + 2.0 * pattern.dynamic_count);
  bytes += word * p->nodes * (double)ambulo__devices_entries(p->devices);
  bytes += word * p->nodes * (double)ambulo__holds_entries(p->holds);
  if (p->holds) bytes += 3.0 * word * p->nodes * p->coordinates;
  return bytes + 3.0 * word * p->nodes * ambulo__wrench_entries(p);
}

double ambulo__row_bytes(const ambulo_problem *p, double rows) {
  double row = sizeof(ambulo__table_row) + terms_of_a_row * sizeof(ambulo__row_term);
  double runs = sizeof(double) + terms_of_a_row * (sizeof(double) + sizeof(int));
  double curved = solid_rows(p) / fmax(1.0, ambulo__rows_at_most(p));
  row += curved * sizeof(ambulo__curved);
  return rows * (growth * row + runs + sizeof(double));
}

double ambulo__rows_at_most(const ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  double limits = 2.0 * (d->joint_limits != AMBULO_LIMIT_OFF) + 2.0 * (d->speed_limits != 0) +
                  2.0 * (d->torque_limits != 0);
  double per_node =
      limits * p->coordinates + 2.0 * d->tube_count * p->coordinates + d->user_row_count;
  /* contacts, clearance, pressure and friction of a foot; support, friction and moments of all */
  per_node += 24.0 * ambulo_model_foot_count(p->model) + 16.0;
  per_node += 18.0 * ambulo_model_patch_count(p->model) + 6.0 * d->reach_count;
  double points = d->joint_limits == AMBULO_LIMIT_CONTROL_POINTS ? 2.0 * p->variables : 0.0;
  return per_node * p->nodes + solid_rows(p) + points + 6.0 * p->coordinates;
}

ambulo_status ambulo__check_memory(const ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const double gigabyte = 1073741824.0;
  double rows = ambulo__rows_at_most(p), free_bytes = 1048576.0 * ambulo__free_megabytes();
  double bytes = ambulo__row_bytes(p, rows) + ambulo__workspace_bytes(p, 0);
  if (rows <= MOST_ROWS && (free_bytes == 0.0 || bytes <= free_bytes)) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_LIMIT, ambulo__nowhere,
                       "lower time.intervals or trajectory.intervals",
                       "the problem is too large: %d time nodes and %d unknowns of %d coordinates, "
                       "up to %.3g million rows, %.3g GB before any solve (%.3g GB are free); "
                       "expected at most %d million rows, and memory for them",
                       p->nodes, p->variables, p->coordinates, 1e-6 * rows, bytes / gigabyte,
                       free_bytes / gigabyte, MOST_ROWS / 1000000);
}
