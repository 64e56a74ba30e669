/* mechanics/kernel_source.h - one set of kernels.
 *
 * Compiled once for each instruction set by a kernels_*.c file of that name, which defines
 * AMBULO__WIDTH (lanes at a time), AMBULO__KERNELS (symbol of the set) and AMBULO__KERNELS_NAME.
 * A width below AMBULO__LANES goes over the block in parts; scratch and arrays are laid out the
 * same for all widths.
 */
#ifndef AMBULO_MECHANICS_KERNEL_SOURCE_H
#define AMBULO_MECHANICS_KERNEL_SOURCE_H

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

static void outputs(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                    const double *ground, double *out, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    local_forward_part(plan, 0, q + lane, qd + lane, qdd + lane, lanes_from(ground, lane),
                       out + lane, scratch + lane);
  }
}

static void forward(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                    const double *ground, double *out, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    local_forward_part(plan, 1, q + lane, qd + lane, qdd + lane, lanes_from(ground, lane),
                       out + lane, scratch + lane);
  }
}

static void reverse(const ambulo__plan *plan, const double *qd, const double *qdd,
                    const double *ground, const double *weights, double *gq, double *gqd,
                    double *gqdd, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    const local_arrays arrays = {qd + lane,  qdd + lane,  weights + lane, gq + lane,
                                 gqd + lane, gqdd + lane, scratch + lane};
    local_reverse_part(plan, lanes_from(ground, lane), &arrays);
    drive_adjoints(plan, qd + lane, weights + lane, gqd + lane, gqdd + lane);
  }
}

static void jacobian(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                     const double *ground, double *jq, double *jqd, double *jqdd, double *scratch) {
  for (int lane = 0; lane < AMBULO__LANES; lane += AMBULO__WIDTH) {
    const world_inputs x = {q + lane, qd + lane, qdd + lane};
    local_angles(&plan->local, x.q, scratch + lane);
    jacobian_part(plan, &x, jq + lane, jqd + lane, jqdd + lane, scratch + lane);
    drive_diagonals(plan, x.qd, jqd + lane, jqdd + lane);
    if (plan->contacts == 0) continue;
    jacobian_contacts_part(plan, ground + lane, jq + lane, scratch + lane);
  }
}

const ambulo__kernels AMBULO__KERNELS = {AMBULO__KERNELS_NAME, outputs, forward, reverse, jacobian};

#endif
