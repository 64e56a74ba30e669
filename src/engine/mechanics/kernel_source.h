/* mechanics/kernel_source.h - one set of kernels.
 *
 * Compiled once for each instruction set by a kernels_*.c file of that name, which defines
 * AMBULO__WIDTH (lanes at a time), AMBULO__KERNELS (symbol of the set) and AMBULO__KERNELS_NAME.
 * A width below AMBULO__LANES goes over the block in parts; scratch and arrays are laid out the
 * same for all widths.
 */
#ifndef AMBULO_MECHANICS_KERNEL_SOURCE_H
#define AMBULO_MECHANICS_KERNEL_SOURCE_H

#include "mechanics/kernel_coupled.h"
#include "mechanics/kernel_drives.h"
#include "mechanics/kernel_jacobian.h"
#include "mechanics/kernel_jacobian_contacts.h"
#include "mechanics/kernel_local_reverse.h"

static const double *lanes_from(const double *ground, int lane) {
  return ground ? ground + lane : NULL;
}

AMBULO__INLINE void local_forward_part(const ambulo__plan *plan, int keep, const double *q,
                                       const double *qd, const double *qdd, const double *ground,
                                       double *out, double *scratch) {
  local_angles(&plan->local, q, scratch);
  local_world(plan, scratch);
  if (plan->contacts > 0) {
    local_grounded(plan, keep, q, qd, qdd, ground, out, scratch);
  } else {
    local_dynamics(plan, keep, q, qd, qdd, out, scratch);
    if (plan->points > 0) local_places(plan, keep, 0, out, scratch);
  }
  drive_torques(plan, qd, qdd, out);
}

static void run_outputs(const ambulo__plan *plan, const double *q, const double *qd,
                        const double *qdd, const double *ground, double *out, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    local_forward_part(plan, 0, q + lane, qd + lane, qdd + lane, lanes_from(ground, lane),
                       out + lane, scratch + lane);
  }
}

static void run_forward(const ambulo__plan *plan, const double *q, const double *qd,
                        const double *qdd, const double *ground, double *out, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    local_forward_part(plan, 1, q + lane, qd + lane, qdd + lane, lanes_from(ground, lane),
                       out + lane, scratch + lane);
  }
}

static void run_reverse(const ambulo__plan *plan, const double *qd, const double *qdd,
                        const double *ground, const double *weights, double *gq, double *gqd,
                        double *gqdd, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    const local_arrays arrays = {qd + lane,  qdd + lane,  weights + lane, gq + lane,
                                 gqd + lane, gqdd + lane, scratch + lane};
    local_reverse_part(plan, lanes_from(ground, lane), &arrays);
    drive_adjoints(plan, qd + lane, weights + lane, gqd + lane, gqdd + lane);
  }
}

static void run_jacobian(const ambulo__plan *plan, const double *q, const double *qd,
                         const double *qdd, const double *ground, double *jq, double *jqd,
                         double *jqdd, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    const world_inputs x = {q + lane, qd + lane, qdd + lane};
    local_angles(&plan->local, x.q, scratch + lane);
    jacobian_part(plan, &x, jq + lane, jqd + lane, jqdd + lane, scratch + lane);
    drive_diagonals(plan, x.qd, jqd + lane, jqdd + lane);
    if (plan->contacts == 0) continue;
    jacobian_contacts_part(plan, ground + lane, jq + lane, scratch + lane);
  }
}

static void outputs(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                    const double *ground, double *out, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  if (!c) {
    run_outputs(plan, q, qd, qdd, ground, out, scratch);
    return;
  }
  const coupled_motion m = coupled_motion_in(plan, scratch);
  coupled_expand(plan, q, qd, qdd, scratch);
  run_outputs(c->open, m.q, m.qd, m.qdd, ground, scratch + c->out_at, scratch + c->open_at);
  coupled_fold_rows(plan, out, scratch);
}

static void forward(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                    const double *ground, double *out, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  if (!c) {
    run_forward(plan, q, qd, qdd, ground, out, scratch);
    return;
  }
  const coupled_motion m = coupled_motion_in(plan, scratch);
  coupled_expand(plan, q, qd, qdd, scratch);
  run_forward(c->open, m.q, m.qd, m.qdd, ground, scratch + c->out_at, scratch + c->open_at);
  coupled_fold_rows(plan, out, scratch);
}

static void reverse(const ambulo__plan *plan, const double *qd, const double *qdd,
                    const double *ground, const double *weights, double *gq, double *gqd,
                    double *gqdd, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  if (!c) {
    run_reverse(plan, qd, qdd, ground, weights, gq, gqd, gqdd, scratch);
    return;
  }
  const coupled_motion m = coupled_motion_in(plan, scratch);
  const int joints = c->joint_count * AMBULO__LANES;
  double *g = scratch + c->gradient_at;
  coupled_weights(plan, weights, scratch);
  run_reverse(c->open, m.qd, m.qdd, ground, scratch + c->weights_at, g, g + joints, g + 2 * joints,
              scratch + c->open_at);
  coupled_fold_gradient(plan, weights, gq, gqd, gqdd, scratch);
}

static void jacobian(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                     const double *ground, double *jq, double *jqd, double *jqdd, double *scratch) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  if (!c) {
    run_jacobian(plan, q, qd, qdd, ground, jq, jqd, jqdd, scratch);
    return;
  }
  const coupled_motion m = coupled_motion_in(plan, scratch);
  const size_t entries = (size_t)(c->open->count + 2 * c->open->dynamic_count) * AMBULO__LANES;
  coupled_expand(plan, q, qd, qdd, scratch);
  run_outputs(c->open, m.q, m.qd, m.qdd, ground, scratch + c->out_at, scratch + c->open_at);
  memset(scratch + c->jq_at, 0, entries * sizeof *scratch);
  run_jacobian(c->open, m.q, m.qd, m.qdd, ground, scratch + c->jq_at, scratch + c->jqd_at,
               scratch + c->jqdd_at, scratch + c->open_at);
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH)
    coupled_entries(plan, jq + lane, jqd + lane, jqdd + lane, scratch + lane);
  if (plan->contacts > 0) coupled_factors(plan, jq, scratch);
}

const ambulo__kernels AMBULO__KERNELS = {AMBULO__KERNELS_NAME, outputs, forward, reverse, jacobian};

#endif
