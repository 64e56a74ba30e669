/* ambulo/device.h - what a person wears or is tied to: springs, dampers, actuators, clutches.
 *
 * A device acts along one coordinate s of the body: a joint coordinate (rad or m), or the distance
 * (m) between a point of one link and a point of another. Its effort E is what it adds. At a joint
 * that is the torque along the coordinate (N m; N at a slider); between two points it is the
 * tension (N) that pulls them together.
 *
 * Let g = 1 at a joint and -1 between points. The generalized forces are Q_i = g E ds/dq_i, and the
 * power on the body is g E sd. Objective and limits act on the torques of the person, which are the
 * rest of inverse dynamics:
 *
 *     tau = tau_inverse_dynamics - sum over devices of Q
 *
 *     spring     E = -g w stiffness h(s - rest + pretension / stiffness)
 *     damper     E = -g w damping sd
 *     actuator   E = w amount profile(time, or share of the stride)
 *
 * Side: h(x) = x for a spring of both sides, r(x) for AMBULO_DEVICE_ABOVE, -r(-x) for _BELOW. Here
 * r(x) = 0 below -smoothing / 2 and x above smoothing / 2; between them r' is the smooth step
 * u^2 (3 - 2 u).
 *
 * Clutch: w = 1 without one. With one, w is a smooth window over the stride of `foot`, which begins
 * with the foot's strike: 0 outside [from, to], 1 inside, with a smooth step of length `ramp` at
 * each end. A spring has no force while its clutch is open. Its rest value is the given one,
 * wherever it is engaged.
 *
 * At stiffness 0, E is its limit: 0, or with a pretension a constant force (for one side: where the
 * force pulls to that side).
 *
 * Devices have no mass (use `load` of a problem file), and need nothing from outside the body: they
 * change neither the root wrench nor the ground's forces.
 */
#ifndef AMBULO_DEVICE_H
#define AMBULO_DEVICE_H

#include "ambulo/model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_device_kind {
  AMBULO_DEVICE_KIND_NOT_SET = 0, /* refused */
  AMBULO_DEVICE_SPRING,
  AMBULO_DEVICE_DAMPER,
  AMBULO_DEVICE_ACTUATOR
} ambulo_device_kind;

typedef enum ambulo_device_side {
  AMBULO_DEVICE_SIDE_NOT_SET = 0, /* refused for a spring */
  AMBULO_DEVICE_BOTH,             /* a spring that pulls and pushes */
  AMBULO_DEVICE_ABOVE,            /* acts only where its coordinate or length is above the rest */
  AMBULO_DEVICE_BELOW
} ambulo_device_side;

typedef enum ambulo_device_clock {
  AMBULO_DEVICE_CLOCK_NOT_SET = 0, /* refused for an actuator */
  AMBULO_DEVICE_CONSTANT,          /* the profile is 1 */
  AMBULO_DEVICE_BY_TIME,   /* points at times, s; constant before the first and after the last */
  AMBULO_DEVICE_BY_STRIDE, /* points at fractions of the stride of `foot`, 0 to 1; repeats */
} ambulo_device_clock;

typedef struct ambulo_device {
  ambulo_device_kind kind;
  const char *name;      /* for columns and reports, unique */
  int coordinate;        /* joint coordinate at which it acts; -1: between two points */
  int link[2];           /* of the two points */
  double position[2][3]; /* of the two points, in the frames of their links, m */
  double stiffness;      /* of a spring, N m/rad or N/m, >= 0; 0: only its pretension */
  double rest,
      pretension; /* rad or m; N m or N: effort at rest, positive as in a stretched spring */
  ambulo_device_side side;   /* of a spring */
  double smoothing;          /* of a spring of one side: > 0, rad or m */
  double damping;            /* of a damper, N m s/rad or N s/m, >= 0 */
  double amount;             /* of an actuator: N m or N; factor of its profile */
  ambulo_device_clock clock; /* of an actuator */
  const double (*points)[2]; /* [point_count]: time (s) or fraction of the stride, rising; value */
  int point_count;           /* joined by monotone cubics (pchip) */
  int foot;                  /* whose stride the clutch or profile follows; -1: none */
  int clutch;                /* 1: engaged during a part of the stride only */
  int alone;             /* 1: nothing else drives its coordinate (of a joint within the body), as
                            of a prosthesis: rows "passive" keep its tau at 0 */
  int image_of;          /* the device whose mirror image this is (`mirror` of a file): a
                            sensitivity of that device moves both; -1: none */
  double from, to, ramp; /* of the clutch, fractions of the stride; from > to: past its end */
} ambulo_device;

/* Stiffness 0, damping 0, amount 1, both sides, smoothing 0.01, no clutch; name and place must be
 * set. */
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_device ambulo_device_default(ambulo_device_kind kind) {
  ambulo_device usual;
  usual.kind = kind;
  ambulo_problem_defaults("ambulo_device", &usual, sizeof usual);
  return usual;
}
#endif

#ifdef __cplusplus
}
#endif
#endif
