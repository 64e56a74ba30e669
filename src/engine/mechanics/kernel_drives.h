/* mechanics/kernel_drives.h - what the joints' drives add to tau: rotors, damping, dry friction.
 *
 * A rotor on a gear of ratio n turns n times as fast as its joint; for n much larger than 1 all
 * that the body feels of it is the torque that speeds it up, armature a = n^2 times its inertia.
 * Nothing of it acts elsewhere, hence not on the root wrench: tau_i += a qdd_i + b qd_i + c
 * s(qd_i),   s(x) = x / r,  r = sqrt(x^2 + v^2), s for the sign of the speed, with s' = v^2 / r^3.
 * Of the Jacobians this is the diagonal, dtau_i/dqdd_i += a,   dtau_i/dqd_i += b + c s'(qd_i), and
 * with the weight y on tau_i the gradient has y times these. A root is rounded to the last bit on
 * every instruction set. Coordinates without a drive are not in the list.
 */
#ifndef AMBULO_MECHANICS_KERNEL_DRIVES_H
#define AMBULO_MECHANICS_KERNEL_DRIVES_H

#include "mechanics/kernel_wide.h"

/* (10 D) */
AMBULO__INLINE void drive_torques(const ambulo__plan *plan, const double *qd, const double *qdd,
                                  double *out) {
  const ambulo__drive *drive = plan->drives, *last = drive + plan->drive_count;
  for (; drive < last; drive++) {
    wide x = load(qd + drive->input), tau = load(out + drive->input);
    tau += drive->armature * load(qdd + drive->input);
    tau += drive->damping * x;
    if (drive->friction > 0) tau += drive->friction * x / root(x * x + drive->smoothing);
    store(out + drive->input, tau);
  }
}

/* b + c s' */
AMBULO__INLINE wide drive_slope(const ambulo__drive *drive, const double *qd) {
  wide slope = spread(drive->damping);
  if (drive->friction == 0) return slope;
  wide x = load(qd + drive->input), square = x * x + drive->smoothing;
  return slope + drive->friction * drive->smoothing / (square * root(square));
}

AMBULO__INLINE void drive_adjoints(const ambulo__plan *plan, const double *qd,
                                   const double *weights, double *gqd, double *gqdd) {
  const ambulo__drive *drive = plan->drives, *last = drive + plan->drive_count;
  for (; drive < last; drive++) {
    wide y = load(weights + drive->input);
    store(gqd + drive->input, load(gqd + drive->input) + y * drive_slope(drive, qd));
    store(gqdd + drive->input, load(gqdd + drive->input) + y * drive->armature);
  }
}

AMBULO__INLINE void drive_diagonals(const ambulo__plan *plan, const double *qd, double *jqd,
                                    double *jqdd) {
  const ambulo__drive *drive = plan->drives, *last = drive + plan->drive_count;
  for (; drive < last; drive++) {
    wide slope = drive_slope(drive, qd);
    if (!drive->alone) slope += load(jqd + drive->diagonal);
    store(jqd + drive->diagonal, slope);
    store(jqdd + drive->diagonal, load(jqdd + drive->diagonal) + drive->armature);
  }
}

#endif
