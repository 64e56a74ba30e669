/* problem/workspace.c - memory of one evaluation thread: sized once, never grown; and how much a
 * problem takes, before it is taken. */

#include "base/machine.h"
#include "problem/muscle_effort.h"
#include "problem/nlp.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int user_row_instances(const ambulo_problem *problem) {
  int count = 0;
  for (int r = 0; r < problem->rows; r++) count += problem->table.rows[r].user >= 0;
  return count;
}

/* An array of doubles of a workspace, and how many; NONE: the problem has no use for it. */
typedef struct array {
  double **at;
  size_t count;
} array;
enum { NONE = 0, VALUE_ARRAYS = 14, ARRAYS = AMBULO__WORKSPACE_ARRAYS };

/* arrays that values need first; then those of the Jacobians, by far the largest */
static void list_arrays(ambulo_workspace *w, array list[ARRAYS]) {
  const ambulo_problem *p = w->problem;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  size_t d = (size_t)p->coordinates, channels = (size_t)w->channel_count, nodes = (size_t)p->nodes;
  size_t lanes = (size_t)p->blocks * AMBULO__LANES, x = (size_t)p->variables;
  size_t rows = (size_t)p->rows, terms = (size_t)p->definition.term_count;
  size_t instances = (size_t)user_row_instances(p), wrench = (size_t)ambulo__wrench_entries(p);
  size_t entries = (size_t)pattern.count, dynamic = (size_t)pattern.dynamic_count;
  int carries = p->devices || p->holds;
  const array all[ARRAYS] = {
      {&w->x, x + 1},
      {&w->channel, lanes * channels},
      {&w->weight, lanes * channels},
      {&w->term_slope, lanes * channels},
      {&w->gradient_lanes, 3 * d * AMBULO__LANES},
      {&w->scratch, ambulo__plan_scratch(p->plan) + 1},
      {&w->row_value, rows + 1},
      {&w->term_value, terms + 1},
      {&w->user_gradient, instances * channels + 1},
      {&w->node_state, 2 * channels},
      {&w->motion_scratch, 3 * d},
      {&w->other_scratch, 3 * d},
      {&w->fault_scratch, x + 1},
      {&w->device_scratch, carries ? ambulo__device_scratch_size(p) : NONE},
      {&w->jq, lanes * entries},
      {&w->jqd, lanes * dynamic},
      {&w->jqdd, lanes * dynamic},
      {&w->wrench[0], nodes * wrench},
      {&w->wrench[1], nodes * wrench},
      {&w->wrench[2], nodes * wrench},
      {&w->device_states, p->devices ? nodes * ambulo__devices_entries(p->devices) : NONE},
      {&w->hold_states, p->holds ? nodes * ambulo__holds_entries(p->holds) : NONE},
      {&w->bare_force, p->holds && wrench ? 3 * nodes * d : NONE}};
  memcpy(list, all, sizeof all);
}

static ambulo_status allocate(ambulo_workspace *w, int first, int end) {
  array list[ARRAYS];
  list_arrays(w, list);
  for (int i = first; i < end; i++) {
    if (list[i].count == NONE) continue;
    *list[i].at = w->owned[i] = ambulo__alloc_aligned(&w->allocator, list[i].count, sizeof(double));
    if (!w->owned[i]) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
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
  w->user_slot = ambulo__alloc(&own, (size_t)problem->rows, sizeof *w->user_slot);
  w->far = ambulo__alloc(&own, (size_t)problem->rows, sizeof *w->far);
  ambulo_status status = w->user_slot && w->far ? allocate(w, 0, VALUE_ARRAYS) : AMBULO_E_MEMORY;
  if (!status) status = ambulo__muscle_effort_create(problem, &own, &w->muscles);
  if (status) {
    ambulo_workspace_free(w);
    return status;
  }
  int slot = 0;
  for (int r = 0; r < problem->rows; r++)
    w->user_slot[r] = problem->table.rows[r].user >= 0 ? slot++ : -1;
  *workspace = w;
  return AMBULO_OK;
}

ambulo_status ambulo_workspace_create(const ambulo_problem *problem,
                                      const ambulo_allocator *allocator,
                                      ambulo_workspace **workspace) {
  ambulo_workspace *w = NULL;
  if (!problem || !workspace) return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__workspace_create_for_values(problem, allocator, &w);
  if (!status) status = allocate(w, VALUE_ARRAYS, ARRAYS);
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
  for (int i = 0; i < ARRAYS; i++) ambulo__free_aligned(&a, w->owned[i]);
  ambulo__muscle_effort_free(w->muscles);
  ambulo__free(&a, w->user_slot);
  ambulo__free(&a, w->far);
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

/* of capsules, obstacles and cones of friction: those that are not linear */
static double curved_rows(const ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  double per_node = d->collision.pair_count;
  if (d->ground_reaction.friction >= 0.0) per_node += p->channels.slots;
  for (int h = 0; h < d->hold_count; h++)
    per_node += p->model->capsule_count + d->obstacle_count + 1;
  for (int o = 0; o < d->obstacle_count; o++)
    per_node += d->obstacles[o].capsules ? d->obstacles[o].capsule_count : p->model->capsule_count;
  return per_node * p->nodes;
}

double ambulo__slope_bytes(const ambulo_problem *p) {
  return sizeof(double) * curved_rows(p) * ambulo__channel_count(&p->channels);
}

double ambulo__workspace_bytes(const ambulo_problem *p, int with_jacobians) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  double lanes = 8.0 * p->blocks, word = sizeof(double);
  double bytes = 3.0 * lanes * word * ambulo__channel_count(&p->channels);
  bytes += word * (2.0 * p->variables + 1.5 * p->rows);
  bytes += ambulo__slope_bytes(p);
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
  double curved = curved_rows(p) / fmax(1.0, ambulo__rows_at_most(p));
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
  return per_node * p->nodes + curved_rows(p) + points + 6.0 * p->coordinates;
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
