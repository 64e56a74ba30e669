/* problem/workspace.c - memory of one evaluation thread; sized once, never grown. */
#include "problem/nlp.h"

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
    w->device_kept = ambulo__alloc_aligned(a, kept, word);
    if (!w->device_kept) return AMBULO_E_MEMORY;
  }
  if (p->holds) {
    size_t nodes = (size_t)p->nodes;
    w->hold_kept = ambulo__alloc_aligned(a, nodes * ambulo__holds_entries(p->holds), word);
    if (!w->hold_kept) return AMBULO_E_MEMORY;
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
  if (p->devices || p->holds) w->device_scratch = ambulo__alloc_aligned(a, ambulo__room(p), word);
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
                       w->device_kept,
                       w->hold_kept,
                       w->bare_force};
  for (size_t i = 0; i < sizeof aligned / sizeof *aligned; i++)
    ambulo__free_aligned(&a, aligned[i]);
  ambulo__free(&a, w->user_slot);
  ambulo__free(&a, w);
}
