/* problem/memory.c - see memory.h.
 *
 * With d coordinates, C channels, E entries of the Jacobian's pattern (D of them dynamic) and N + 1
 * nodes in blocks of 8:
 *
 *     values      8 B a channel and node, three times (channels, their adjoints, slopes of terms)
 *     Jacobians   8 B (E + 2 D) a node, and 3 x 48 d B with ground reaction; what devices keep
 *     scratch     of inverse dynamics in one block of nodes, once
 *     a row       its table (names, time, terms), its place in the runs, its value
 */
#include "problem/memory.h"
#include "base/free_memory.h"
#include "problem/problem.h"

#include <math.h>
#include <stdio.h>

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
  if (rows <= AMBULO__MOST_ROWS && (free_bytes == 0.0 || bytes <= free_bytes)) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_LIMIT, ambulo__nowhere,
                       "lower time.intervals or trajectory.intervals",
                       "the problem is too large: %d time nodes and %d unknowns of %d coordinates, "
                       "up to %.3g million rows, %.3g GB before any solve (%.3g GB are free); "
                       "expected at most %d million rows, and memory for them",
                       p->nodes, p->variables, p->coordinates, 1e-6 * rows, bytes / gigabyte,
                       free_bytes / gigabyte, AMBULO__MOST_ROWS / 1000000);
}
