/* ambulo/device.h - what a person wears or is tied to: springs, dampers, actuators, clutches.
 *
 * A device acts along one coordinate s of the body: a joint coordinate (rad or m), or the distance
 * (m) between a point of one link and a point of another, from foot to foot too. Its effort E is
 * what it adds: at a joint the torque (N m; N of a slider) along the coordinate, between two points
 * the tension (N) that pulls them together. With g = 1 at a joint and -1 between points its
 * generalized forces are Q_i = g E ds/dq_i, its power on the body is g E sd, and the torques of
 * the person, on which objective and limits stand, are what is left of inverse dynamics:
 *
 *     tau = tau_inverse_dynamics - sum over devices of Q
 *
 *     spring     E = -g w stiffness h(s - rest + pretension / stiffness)
 *     damper     E = -g w damping sd
 *     actuator   E = w amount profile(time, or share of the stride)
 *
 * h(x) = x; of a spring of one side r(x) for AMBULO_DEVICE_ABOVE, -r(-x) for _BELOW, with r(x) = 0
 * below -smoothing / 2, x above smoothing / 2, and r' the smooth step u^2 (3 - 2 u) between them.
 * w = 1; of a clutch the smooth window of its engagement: 0 outside [from, to] of the stride of
 * `foot`, which begins with the foot's strike, and 1 but for a smooth step of length `ramp` at
 * both of its ends. At stiffness 0 E is what it tends to: 0, or with a pretension a constant force
 * (of one side: where that pulls to this side). A spring has no force where its clutch is open, and
 * the value it rests at is the given one, wherever it is engaged.
 *
 * Devices have no mass (a load is `load` of the file), and need nothing from outside the body: the
 * root wrench and the forces of the ground are those of the motion.
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
  AMBULO_DEVICE_SIDE_NOT_SET = 0, /* refused of a spring */
  AMBULO_DEVICE_BOTH,             /* a spring that pulls and pushes */
  AMBULO_DEVICE_ABOVE,            /* acts where its coordinate or length is above the rest only */
  AMBULO_DEVICE_BELOW
} ambulo_device_side;

typedef enum ambulo_device_clock {
  AMBULO_DEVICE_CLOCK_NOT_SET = 0, /* refused of an actuator */
  AMBULO_DEVICE_CONSTANT,          /* the profile is 1 */
  AMBULO_DEVICE_BY_TIME,   /* points at times, s; before the first and after the last their value */
  AMBULO_DEVICE_BY_STRIDE, /* points at shares of the stride of `foot`, 0 to 1, that repeat */
} ambulo_device_clock;

typedef struct ambulo_device {
  ambulo_device_kind kind;
  const char *name;      /* for columns and reports, unique */
  int coordinate;        /* at this coordinate of a joint; -1: between two points */
  int link[2];           /* of them */
  double position[2][3]; /* in the frames of their links, m */
  double stiffness;      /* of a spring, N m/rad or N/m, >= 0; 0: none, but for its pretension */
  double rest,
      pretension; /* rad or m; N m or N, force at rest in the sense of a stretched spring */
  ambulo_device_side side;   /* of a spring */
  double smoothing;          /* > 0 where a spring has one side; rad or m */
  double damping;            /* of a damper, N m s/rad or N s/m, >= 0 */
  double amount;             /* of an actuator; with a profile its factor */
  ambulo_device_clock clock; /* of an actuator */
  const double (*points)[2]; /* [point_count]: time or share of the stride, rising; value */
  int point_count;           /* joined by cubics that stay between their points (pchip) */
  int foot;                  /* whose stride counts; -1: nothing goes by it */
  int clutch;                /* 1: engaged over a part of the stride only */
  int image_of;              /* of a file's `mirror`: the device whose mirror image it is, so that
                                a number of that moves both; -1: it stands for itself */
  double from, to, ramp;     /* of the clutch, shares of the stride; from > to: past its end */
} ambulo_device;

/* Stiffness 0, damping 0, amount 1, both sides, a smoothing of 0.01, no clutch, no place. */
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
