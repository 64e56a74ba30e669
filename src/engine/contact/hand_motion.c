/* contact/hand_motion.c - see hand_motion.h. */
#include "contact/hand_motion.h"

#include "base/lanes.h"
#include "base/arithmetic.h"

#include <string.h>

ambulo__hand_motion ambulo__hand_motion_in(double *kept, int joints) {
  size_t n = 3 * (size_t)joints;
  double *axis = kept + 9;
  return (ambulo__hand_motion){kept,         kept + 3,     kept + 6,     axis,        axis + n,
                               axis + 2 * n, axis + 3 * n, axis + 4 * n, axis + 5 * n};
}

/* A frame on its way: its place, and the motion of its origin. */
typedef struct moving {
  double frame[12], velocity[3], acceleration[3], rate[3], gain[3];
} moving;

/* v + w x r,  a + alpha x r + w x (w x r) */
static void carry(moving *m, const double from[3]) {
  double r[3], sweep[3];
  for (int k = 0; k < 3; k++) r[k] = m->frame[4 * k + 3] - from[k];
  ambulo__cross(m->rate, r, sweep);
  for (int k = 0; k < 3; k++) m->velocity[k] += sweep[k];
  ambulo__add_cross(m->gain, r, 1.0, m->acceleration);
  ambulo__add_cross(m->rate, sweep, 1.0, m->acceleration);
}

/* across the joint and on to the next one; zd of its axis */
static void cross_joint(moving *m, const ambulo__path_joint *joint, const double z[3],
                        const double zd[3], double q, double qd, double qdd) {
  double from[3];
  for (int k = 0; k < 3; k++) from[k] = m->frame[4 * k + 3];
  ambulo__path_follow(m->frame, joint, q);
  for (int k = 0; k < 3; k++) {
    double turn = joint->turns ? 1.0 : 0.0, slide = 1.0 - turn;
    m->rate[k] += turn * z[k] * qd;
    m->gain[k] += turn * (z[k] * qdd + zd[k] * qd);
    m->velocity[k] += slide * z[k] * qd;
    m->acceleration[k] += slide * (z[k] * qdd + 2.0 * zd[k] * qd);
  }
  carry(m, from);
}

/* J, Jd and Jdd, which hold o, v_o and a_o at first */
static void finish_slopes(int turns, const ambulo__hand_motion *m, int i) {
  const double *z = m->axis + 3 * i, *zd = m->axis_rate + 3 * i, *zdd = m->axis_gain + 3 * i;
  double *j = m->slope + 3 * i, *jd = m->slope_rate + 3 * i, *jdd = m->slope_gain + 3 * i;
  double r[3], v[3], a[3];
  for (int k = 0; k < 3; k++) {
    r[k] = m->place[k] - j[k];
    v[k] = m->velocity[k] - jd[k];
    a[k] = m->acceleration[k] - jdd[k];
  }
  if (!turns) {
    memcpy(j, z, sizeof r);
    memcpy(jd, zd, sizeof r);
    memcpy(jdd, zdd, sizeof r);
    return;
  }
  ambulo__cross(z, r, j);
  ambulo__cross(z, v, jd);
  ambulo__add_cross(zd, r, 1.0, jd);
  ambulo__cross(z, a, jdd);
  ambulo__add_cross(zd, v, 2.0, jdd);
  ambulo__add_cross(zdd, r, 1.0, jdd);
}

/* (H.1) J, Jd, Jdd */
void ambulo__hand_move(const ambulo__device_path *path, const double *q, const double *qd,
                       const double *qdd, const ambulo__hand_motion *motion) {
  moving m = {{0.0}, {0.0}, {0.0}, {0.0}, {0.0}};
  memcpy(m.frame, path->start, sizeof m.frame);
  for (int i = 0; i < path->count; i++) {
    const ambulo__path_joint *joint = &path->joints[i];
    size_t at = (size_t)joint->coordinate * AMBULO__LANES;
    double *z = motion->axis + 3 * i, *zd = motion->axis_rate + 3 * i;
    double *zdd = motion->axis_gain + 3 * i;
    for (int k = 0; k < 3; k++) {
      z[k] = m.frame[4 * k + 2];
      motion->slope[3 * i + k] = m.frame[4 * k + 3];
    }
    memcpy(motion->slope_rate + 3 * i, m.velocity, sizeof m.velocity);
    memcpy(motion->slope_gain + 3 * i, m.acceleration, sizeof m.acceleration);
    ambulo__cross(m.rate, z, zd);
    ambulo__cross(m.gain, z, zdd);
    ambulo__add_cross(m.rate, zd, 1.0, zdd);
    cross_joint(&m, joint, z, zd, q[at], qd[at], qdd[at]);
  }
  for (int k = 0; k < 3; k++) motion->place[k] = m.frame[4 * k + 3];
  memcpy(motion->velocity, m.velocity, sizeof m.velocity);
  memcpy(motion->acceleration, m.acceleration, sizeof m.acceleration);
  for (int i = 0; i < path->count; i++) finish_slopes(path->joints[i].turns, motion, i);
}
