/* contact/load_motion.c - see path.h. */
#include "contact/devices.h"

#include "base/lanes.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/* a = a b, rows of 3 x 4 */
static void follow(double a[12], const double b[12]) {
  for (int r = 0; r < 3; r++) {
    double *row = a + 4 * r, x = row[0], y = row[1], z = row[2];
    for (int c = 0; c < 4; c++)
      row[c] = x * b[c] + y * b[4 + c] + z * b[8 + c] + (c == 3 ? row[3] : 0.0);
  }
}

/* a = a Rot_z(angle) Trans_z(offset) */
static void follow_joint(double a[12], double angle, double offset) {
  double c = cos(angle), s = sin(angle);
  for (int r = 0; r < 3; r++) {
    double *row = a + 4 * r, x = row[0], y = row[1];
    row[0] = c * x + s * y;
    row[1] = c * y - s * x;
    row[3] += row[2] * offset;
  }
}

/* a = a Trans_x(a) Rot_x(alpha) */
static void follow_rest(double a[12], const ambulo_link *link) {
  double c = cos(link->alpha), s = sin(link->alpha);
  const double rest[12] = {1, 0, 0, link->a, 0, c, -s, 0, 0, s, c, 0};
  follow(a, rest);
}

static int depth_of(const ambulo_model *model, int link) {
  int depth = 0;
  for (; link >= 0; link = ambulo_model_link(model, link)->parent) depth++;
  return depth;
}

int ambulo__path_common(const ambulo_model *model, const int link[2]) {
  int a = link[0], b = link[1];
  while (a != b) {
    int deeper_a = depth_of(model, a) >= depth_of(model, b);
    int *deeper = deeper_a ? &a : &b;
    *deeper = ambulo_model_link(model, *deeper)->parent;
  }
  return a;
}

static int moves(const ambulo_link *link) {
  return link->type != AMBULO_FIXED;
}

/* the link of the path at `depth` */
static int link_at(const ambulo_model *model, int link, int depth) {
  for (int at = depth_of(model, link); at > depth; at--)
    link = ambulo_model_link(model, link)->parent;
  return link;
}

ambulo_status ambulo__path_create(const ambulo_model *model, int common, int link,
                                  const double position[3], const ambulo_allocator *allocator,
                                  ambulo__device_path *path) {
  int first = depth_of(model, common) + 1, last = depth_of(model, link), count = 0;
  const double place[12] = {1, 0, 0, position[0], 0, 1, 0, position[1], 0, 0, 1, position[2]};
  for (int depth = first; depth <= last; depth++)
    count += moves(ambulo_model_link(model, link_at(model, link, depth)));
  *path = (ambulo__device_path){.joints =
                                    ambulo__alloc(allocator, (size_t)count, sizeof *path->joints)};
  if (!path->joints) return AMBULO_E_MEMORY;
  double *frame = path->start;
  memcpy(frame, identity, sizeof identity);
  for (int depth = first; depth <= last; depth++) {
    const int index = link_at(model, link, depth);
    const ambulo_link *next = ambulo_model_link(model, index);
    if (moves(next)) {
      ambulo__path_joint *joint = &path->joints[path->count++];
      *joint = (ambulo__path_joint){.coordinate = ambulo__moved_by(model, index),
                                    .turns = next->type == AMBULO_REVOLUTE,
                                    .angle = next->theta,
                                    .offset = next->d};
      if (next->coupled_to >= 0) joint->coupling = &model->couplings[index];
      frame = joint->after;
      memcpy(frame, identity, sizeof identity);
    } else {
      follow_joint(frame, next->theta, next->d);
    }
    follow_rest(frame, next);
  }
  follow(frame, place);
  return AMBULO_OK;
}

void ambulo__path_free(const ambulo_allocator *allocator, ambulo__device_path *path) {
  ambulo__free(allocator, path->joints);
}

double ambulo__path_value(const ambulo__path_joint *joint, double q,
                          double slope[AMBULO__COUPLING_SLOPES]) {
  if (joint->coupling) return ambulo__coupling_value(joint->coupling, q, slope);
  if (slope) {
    slope[0] = 1.0;
    slope[1] = slope[2] = 0.0;
  }
  return q;
}

void ambulo__path_follow(double frame[12], const ambulo__path_joint *joint, double q) {
  follow_joint(frame, joint->angle + (joint->turns ? q : 0.0),
               joint->offset + (joint->turns ? 0.0 : q));
  follow(frame, joint->after);
}

/* (D.4) z x (p - o), z */
void ambulo__path_point(const ambulo__device_path *path, const double *q, double point[3],
                        double *axis, double *slope) {
  double frame[12];
  memcpy(frame, path->start, sizeof frame);
  for (int i = 0; i < path->count; i++) {
    const ambulo__path_joint *joint = &path->joints[i];
    double value = ambulo__path_value(joint, q[joint->coordinate * AMBULO__LANES], NULL);
    for (int k = 0; k < 3; k++) {
      axis[3 * i + k] = frame[4 * k + 2];
      slope[3 * i + k] = frame[4 * k + 3];
    }
    ambulo__path_follow(frame, joint, value);
  }
  for (int k = 0; k < 3; k++) point[k] = frame[4 * k + 3];
  for (int i = 0; i < path->count; i++) {
    double *z = axis + 3 * i, *at = slope + 3 * i;
    double arm[3] = {point[0] - at[0], point[1] - at[1], point[2] - at[2]};
    if (path->joints[i].turns)
      ambulo__cross(z, arm, at);
    else
      memcpy(at, z, 3 * sizeof *at);
  }
}

/* the effort of a device, and its derivatives by everything
 * (ambulo/device.h).
 *
 *     spring     E = -g w H,  H = k h(x + P / k),  x = s - s0
 *                H_s = k h',  dH/dk = h - h' P / k,  dH/ds0 = -k h',  dH/dP = h'
 *     damper     E = -g w c sd
 *     actuator   E = w a
 *
 * One side: h = r(y), or -r(-y). With u = y / b + 1/2, b the smoothing, between 0 and 1
 *
 *     r = b (u^3 - u^4 / 2),   r' = 3 u^2 - 2 u^3,   dr/db = r / b - (y / b) r'
 *
 * so that r = b / 2 = y at u = 1 and r'' is continuous. Where h is straight
 *
 *     H = k x + P,   dH/dk = x
 *
 * without a division: so, too, H is what it tends to as k goes to 0. No pretension leaves no force
 * there, and dH/dk = h(x); a pretension is a constant force, but 0 on the side where a spring of
 * one side has none, since y = P / k is then far on one side of u.
 */

/* H and its derivatives */
typedef struct pull {
  double value, slope, by_stiffness, by_pretension, by_smoothing;
} pull;

static pull straight(double stiffness, double x, double pretension) {
  return (pull){stiffness * x + pretension, stiffness, x, 1.0, 0.0};
}

/* (D.2) */
static pull one_sided(double k, double x, double pretension, double smoothing) {
  double early = 0.0; /* P / k */
  if (pretension != 0.0) early = k > 0.0 ? pretension / k : copysign(HUGE_VAL, pretension);
  double u = (x + early) / smoothing + 0.5;
  if (u <= 0.0) return (pull){0.0, 0.0, 0.0, 0.0, 0.0};
  if (u >= 1.0) return straight(k, x, pretension);
  double value = u * u * u * (1.0 - 0.5 * u), slope = u * u * (3.0 - 2.0 * u);
  return (pull){k * smoothing * value, k * slope, smoothing * value - slope * early, slope,
                k * (value - (u - 0.5) * slope)};
}

static pull pull_of(const ambulo_device *device, double x) {
  double k = device->stiffness, pretension = device->pretension;
  if (device->side == AMBULO_DEVICE_BOTH) return straight(k, x, pretension);
  if (device->side == AMBULO_DEVICE_ABOVE) return one_sided(k, x, pretension, device->smoothing);
  pull turned = one_sided(k, -x, -pretension, device->smoothing);
  return (pull){-turned.value, turned.slope, -turned.by_stiffness, turned.by_pretension,
                -turned.by_smoothing};
}

static ambulo__effort spring(const ambulo_device *device, double along, double factor) {
  double g = device->coordinate >= 0 ? 1.0 : -1.0;
  pull h = pull_of(device, along - device->rest);
  return (ambulo__effort){.value = -g * factor * h.value,
                          .by_along = -g * factor * h.slope,
                          .by_factor = -g * h.value,
                          .by_stiffness = -g * factor * h.by_stiffness,
                          .by_rest = g * factor * h.slope,
                          .by_pretension = -g * factor * h.by_pretension,
                          .by_smoothing = -g * factor * h.by_smoothing};
}

/* (D.1) E */
ambulo__effort ambulo__effort_of(const ambulo_device *device, double along, double rate,
                                 double factor) {
  double g = device->coordinate >= 0 ? 1.0 : -1.0;
  switch (device->kind) {
  case AMBULO_DEVICE_SPRING:
    return spring(device, along, factor);
  case AMBULO_DEVICE_DAMPER:
    return (ambulo__effort){.value = -g * factor * device->damping * rate,
                            .by_rate = -g * factor * device->damping,
                            .by_factor = -g * device->damping * rate,
                            .by_damping = -g * factor * rate};
  case AMBULO_DEVICE_KIND_NOT_SET:
  case AMBULO_DEVICE_ACTUATOR:
    break;
  }
  return (ambulo__effort){
      .value = factor * device->amount, .by_factor = device->amount, .by_amount = factor};
}

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
