/* problem/hold_wrench.c - see held.h. */
#include "problem/hold_wrench.h"

#include <string.h>

/* of one lane of a block */
static double *kept_of(const ambulo_problem *p, double *room, int lane) {
  return room + ambulo__devices_scratch(p->devices) +
         (size_t)lane * ambulo__holds_entries(p->holds);
}

static const double *kept_in(const ambulo_problem *p, const double *room, int lane) {
  return room + ambulo__devices_scratch(p->devices) +
         (size_t)lane * ambulo__holds_entries(p->holds);
}

size_t ambulo__device_scratch_size(const ambulo_problem *p) {
  return ambulo__devices_scratch(p->devices) + AMBULO__LANES * ambulo__holds_entries(p->holds);
}

void ambulo__hold_wrench_begin(const ambulo_problem *p, const double *factors,
                               const double *channel, double *scratch, double *room) {
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  if (!p->holds) return;
  const double *window = factors + (size_t)p->channels.devices * AMBULO__LANES;
  double *wrench = p->taken_at ? scratch + p->taken_at : NULL;
  if (wrench) memset(wrench, 0, (size_t)6 * AMBULO__LANES * sizeof *wrench);
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    const double *q = channel + lane;
    double *kept = kept_of(p, room, lane);
    ambulo__holds_keep(p->holds, q, q + d8, q + 2 * d8, window + lane, kept);
    if (wrench) ambulo__holds_add_wrench(p->holds, kept, wrench + lane, AMBULO__LANES);
  }
}

void ambulo__hold_wrench_end(const ambulo_problem *p, double *channel, const double *room) {
  if (!p->holds) return;
  double *tau = channel + (size_t)ambulo__channel_tau(&p->channels, 0) * AMBULO__LANES;
  double *wrench = channel + (size_t)ambulo__channel_moment(&p->channels, 0) * AMBULO__LANES;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    const double *kept = kept_in(p, room, lane);
    ambulo__holds_add_torques(p->holds, kept, tau + lane);
    if (!p->taken_at) ambulo__holds_add_wrench(p->holds, kept, wrench + lane, AMBULO__LANES);
  }
}

void ambulo__hold_wrench_reverse(const ambulo_problem *p, double *weight, const double *scratch,
                                 const double *room) {
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  if (!p->holds) return;
  const double *root =
      p->taken_at ? scratch + p->taken_at + 6 * AMBULO__LANES
                  : weight + (size_t)ambulo__channel_moment(&p->channels, 0) * AMBULO__LANES;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double *q = weight + lane;
    ambulo__hold_adjoints x = {.tau = q + 3 * d8,
                               .coordinate = -1,
                               .q = q,
                               .qd = q + d8,
                               .qdd = q + 2 * d8,
                               .stride = AMBULO__LANES};
    for (int k = 0; k < 6; k++) x.wrench[k] = root[k * AMBULO__LANES + lane];
    ambulo__holds_reverse(p->holds, kept_in(p, room, lane), &x);
  }
}

/* --------------------------------------------------------------- Jacobians */

static double *node_kept(const ambulo_workspace *workspace, int node) {
  return workspace->hold_states + (size_t)node * ambulo__holds_entries(workspace->problem->holds);
}

static void gather_node(ambulo_workspace *workspace, int node) {
  const ambulo_problem *p = workspace->problem;
  const size_t d = (size_t)p->coordinates, at = 6 * d * (size_t)node;
  memcpy(workspace->bare_force + 3 * d * (size_t)node, workspace->wrench[2] + at + 3 * d,
         3 * d * sizeof(double));
  for (int k = 0; k < 6; k++) {
    size_t row = at + (size_t)k * d;
    ambulo__hold_adjoints x = {.coordinate = -1,
                               .q = workspace->wrench[0] + row,
                               .qd = workspace->wrench[1] + row,
                               .qdd = workspace->wrench[2] + row,
                               .stride = 1};
    x.wrench[k] = 1.0;
    ambulo__holds_reverse(p->holds, node_kept(workspace, node), &x);
  }
}

void ambulo__hold_wrench_gather(ambulo_workspace *workspace, int block) {
  const ambulo_problem *p = workspace->problem;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  if (!p->holds) return;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    int node = block * AMBULO__LANES + lane;
    if (node >= p->nodes) return;
    const double *q = workspace->channel + ambulo__lane_index(node, workspace->channel_count, 0);
    const double *window =
        p->time_factors +
        ambulo__lane_index(node, ambulo__time_factor_entries(p), p->channels.devices);
    ambulo__holds_keep(p->holds, q, q + d8, q + 2 * d8, window, node_kept(workspace, node));
    if (ambulo__plan_contacts(p->plan)) gather_node(workspace, node);
  }
}

void ambulo__hold_wrench_add_output(const ambulo_workspace *workspace, int node, int output,
                                    double *gradient) {
  const ambulo_problem *p = workspace->problem;
  const int d = p->coordinates, row = output - d;
  int torque = row < 0, wrench = row >= 0 && row < 6 && !ambulo__plan_contacts(p->plan);
  if (!torque && !wrench) return;
  ambulo__hold_adjoints x = {.coordinate = torque ? output : -1,
                             .q = gradient,
                             .qd = gradient + d,
                             .qdd = gradient + 2 * d,
                             .stride = 1};
  if (wrench) x.wrench[row] = 1.0;
  ambulo__holds_reverse(p->holds, node_kept(workspace, node), &x);
}
