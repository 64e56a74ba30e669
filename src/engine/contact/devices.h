/* contact/devices.h - the devices of a problem, compiled: their efforts at the nodes, what they add
 * to torques, and their derivatives (ambulo/device.h has the laws).
 *
 * d coordinates, n devices. Of one device s is the coordinate or length that it acts along, sd its
 * rate, E(s, sd) its effort, and g = 1 at a joint, -1 between points. The torques of the person
 * lose Q_i = g E s_i with s_i = ds/dq_i, not zero for the coordinates of its path: one at a joint,
 * between points those that move one of the points but not the other.
 *
 * Derivatives, with s_ij = d2s/dq_i dq_j, sd = sum s_i qd_i, a dot on s_i for sum_j s_ij qd_j:
 *
 *     dQ_i/dq_j  = g ((E_s s_j + E_sd s_j.) s_i + E s_ij),    dQ_i/dqd_j = g E_sd s_i s_j
 *     dE/dq_j    = E_s s_j + E_sd s_j.,                       dE/dqd_j   = E_sd s_j
 *
 * E s_ij is the stiffness that geometry makes of a force. For weights y on the torques and e on the
 * effort, with z = sum y_i s_i the virtual rate of s and c = e - g z,
 *
 *     gq_j  += c (E_s s_j + E_sd s_j.) - g E sum_i y_i s_ij,    gqd_j += c E_sd s_j
 *
 * Time enters through one factor a device, which is told: its window times its profile (told.c).
 *
 * Reading order: devices.h, law.c, path.h, path.c, devices.c; told.h, told.c;
 * mirror_devices.c, device_check.c; what hands hold: hand_motion.h, hand_motion.c, holds.h,
 * holds.c, hold_check.c.
 */
#ifndef AMBULO_CONTACT_DEVICES_H
#define AMBULO_CONTACT_DEVICES_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/lanes.h"

typedef struct ambulo__devices ambulo__devices;

/* Of a checked definition, whose devices must outlive them. *devices is NULL where it has none.
 * E_MEMORY. */
ambulo_status ambulo__devices_create(const ambulo_problem_definition *definition,
                                     const ambulo_allocator *allocator, ambulo__devices **devices);
void ambulo__devices_free(ambulo__devices *devices); /* accepts NULL */

/* Doubles that apply and reverse need to work with; what is kept of a node for its derivatives. */
size_t ambulo__devices_scratch(const ambulo__devices *devices);
size_t ambulo__devices_entries(const ambulo__devices *devices);

/* One block of nodes. q, qd, tau: [d][lanes]; told: [n][lanes]; effort: [n][lanes]. Takes the
 * devices' torques off tau, sets their efforts. */
void ambulo__devices_apply(const ambulo__devices *devices, const double *q, const double *qd,
                           const double *told, double *tau, double *effort, double *scratch);
/* Takes them off tau, and adds to gq and gqd [d][lanes] what weights on what is left and on the
 * efforts come to. */
typedef struct ambulo__device_adjoints {
  const double *tau, *effort; /* [d][lanes], [n][lanes] */
  double *q, *qd;             /* [d][lanes] */
} ambulo__device_adjoints;
void ambulo__devices_reverse(const ambulo__devices *devices, const double *q, const double *qd,
                             const double *told, double *tau,
                             const ambulo__device_adjoints *adjoints, double *scratch);

/* What the derivatives of one node are made of, kept[entries]; arrays as above, from its lane on.
 */
void ambulo__devices_keep(const ambulo__devices *devices, const double *q, const double *qd,
                          const double *told, double *kept);
/* Adds to gradient[2 or more][d], by q and qd, those of tau of a coordinate, of an effort. */
void ambulo__devices_add_torque(const ambulo__devices *devices, const double *kept, int coordinate,
                                double *gradient);
void ambulo__devices_add_effort(const ambulo__devices *devices, const double *kept, int device,
                                double *gradient);

/* One device at one node; arrays as of ambulo__devices_keep. */
typedef struct ambulo__device_state {
  double along, rate; /* s, sd */
  double effort;      /* E */
  double power;       /* g E sd, W, on the body */
} ambulo__device_state;
ambulo__device_state ambulo__device_at(const ambulo__devices *devices, int device, const double *q,
                                       const double *qd, const double *told, double *scratch);

/* z of ambulo__devices_reverse at one node: what a torque of 1 in the sense of the effort moves sum
 * y tau by is -g z. Returns g z; weights on tau [d][lanes] from the node's lane on. */
double ambulo__device_pull(const ambulo__devices *devices, int device, const double *q,
                           const double *tau_weight, double *scratch);

/* 1 where an effort is a torque, in N m; else a force, in N. */
int ambulo__device_turns(const ambulo_model *model, const ambulo_device *device);

/* ------------------------------------------------------------------ the law */

/* E by its members at s, sd and a factor. */
typedef struct ambulo__effort {
  double value, by_along, by_rate;                           /* E, E_s, E_sd */
  double by_factor;                                          /* E / factor */
  double by_stiffness, by_rest, by_pretension, by_smoothing; /* of a spring */
  double by_damping, by_amount;
} ambulo__effort;
ambulo__effort ambulo__effort_of(const ambulo_device *device, double along, double rate,
                                 double factor);

/* ------------------------------------------------------------------- checks */

/* What is wrong with each of them alone. E_PROBLEM. */
ambulo_status ambulo__devices_check(const ambulo_problem_definition *definition,
                                    ambulo_diagnostics *diagnostics);
/* Feet that devices go by strike; of contacts that are valid. E_PROBLEM. */
ambulo_status ambulo__devices_check_strides(const ambulo_problem_definition *definition,
                                            ambulo_diagnostics *diagnostics);
/* With mirrored ends each needs its mirror image among them (it may be its own). E_PROBLEM. */
ambulo_status ambulo__devices_mirror_check(const ambulo_problem_definition *definition,
                                           ambulo_diagnostics *diagnostics);
/* The mirror image of a device on a body that is symmetric, with the name and the points of the
 * device itself. */
ambulo_device ambulo__device_mirrored(const ambulo_model *model, const ambulo_device *device);
/* 1 if a place of one link is the mirror image of a place of another, within 1e-6 m, and moves with
 * the partner. */
int ambulo__places_mirror(const ambulo_model *model, int link, const double position[3],
                          int other_link, const double other[3]);
/* Which device takes the place of one in the mirror image; -1: none. *sign: of its effort and
 * coordinate there. */
int ambulo__device_partner(const ambulo_problem_definition *definition, int device, double *sign);

#endif
