/* exchange/free_base.c - see free_base.h.
 *
 * Along the links from the world, T(q) = J(z, q) F (bodies.c). With z the joint's axis, R and o the
 * frame before it, r the way of F's origin after the turn, all in the ground's axes:
 *
 *   hinge   w+ = w + z q'      w'+ = w' + z q'' + w x z q'
 *           v+ = v + w+ x r    a+ = a + w'+ x r + w+ x (w+ x r)
 *   slider  s = z q + r        v+ = v + w x s + z q'
 *           a+ = a + w' x s + w x (w x s) + 2 w x z q' + z q''
 */
#include "exchange/free_base.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* v += w x s; a += w' x s + w x (w x s) */
static void carry(ambulo__frame_motion *m, const double s[3]) {
  double turn[3], out[3];
  ambulo__cross(m->spin, s, turn);
  for (int i = 0; i < 3; i++) m->velocity[i] += turn[i];
  ambulo__cross(m->spin, turn, out);
  for (int i = 0; i < 3; i++) m->acceleration[i] += out[i];
  ambulo__cross(m->spin_rate, s, out);
  for (int i = 0; i < 3; i++) m->acceleration[i] += out[i];
}

static void turn_about(ambulo__frame_motion *m, const double z[3], double rate, double second) {
  double gyro[3];
  ambulo__cross(m->spin, z, gyro);
  for (int i = 0; i < 3; i++) {
    m->spin_rate[i] += z[i] * second + gyro[i] * rate;
    m->spin[i] += z[i] * rate;
  }
}

static void slide_along(ambulo__frame_motion *m, const double z[3], double rate, double second) {
  double gyro[3];
  ambulo__cross(m->spin, z, gyro);
  for (int i = 0; i < 3; i++) {
    m->acceleration[i] += z[i] * second + 2.0 * gyro[i] * rate;
    m->velocity[i] += z[i] * rate;
  }
}

static void pass_link(const ambulo_link *link, const double *q, const double *qd, const double *qdd,
                      ambulo__frame_motion *m) {
  static const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1};
  int c = link->coordinate;
  double value = c < 0 ? 0.0 : q[c], s[3];
  int hinge = link->type == AMBULO_REVOLUTE;
  const double p[3] = {link->a, 0.0, link->d + (c >= 0 && !hinge ? value : 0.0)};
  double z[3];
  ambulo__rigid_vector(&m->place, z_axis, z);
  ambulo__rigid turn = ambulo__rigid_turn(z_axis, link->theta + (hinge ? value : 0.0)),
                shift = ambulo__rigid_shift(p), tilt = ambulo__rigid_turn(x_axis, link->alpha);
  ambulo__rigid t = ambulo__rigid_times(&turn, &shift);
  t = ambulo__rigid_times(&t, &tilt);
  ambulo__rigid_vector(&m->place, t.p, s);
  if (c >= 0 && hinge) turn_about(m, z, qd[c], qdd[c]);
  carry(m, s);
  if (c >= 0 && !hinge) slide_along(m, z, qd[c], qdd[c]);
  m->place = ambulo__rigid_times(&m->place, &t);
}

void ambulo__frame_motion_of(const ambulo_model *model, int link, const ambulo__rigid *world,
                             const double *q, const double *qd, const double *qdd,
                             ambulo__frame_motion *motion) {
  if (link < 0) {
    *motion = (ambulo__frame_motion){.place = *world};
    return;
  }
  ambulo__frame_motion_of(model, model->links[link].parent, world, q, qd, qdd, motion);
  pass_link(&model->links[link], q, qd, qdd, motion);
}

/* The largest of the four squares is at least a quarter: nothing is divided by less than 1/2. */
void ambulo__quaternion_of(const double r[3][3], const double *before, double q[4]) {
  double trace = r[0][0] + r[1][1] + r[2][2];
  int most = 3; /* w */
  for (int i = 0; i < 3; i++)
    if (r[i][i] > (most == 3 ? trace : r[most][most])) most = i;
  if (most == 3) {
    q[3] = 1.0 + trace;
    q[0] = r[2][1] - r[1][2];
    q[1] = r[0][2] - r[2][0];
    q[2] = r[1][0] - r[0][1];
  } else {
    int i = most, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
    q[j] = r[j][i] + r[i][j];
    q[k] = r[k][i] + r[i][k];
    q[3] = r[k][j] - r[j][k];
  }
  double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), same = q[3];
  if (before) same = q[0] * before[0] + q[1] * before[1] + q[2] * before[2] + q[3] * before[3];
  if (same < 0.0) size = -size;
  for (int i = 0; i < 4; i++) q[i] /= size;
}
