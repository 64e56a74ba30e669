/* contact/device_path.c - see path.h. */
#include "contact/device_path.h"

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
  return link->coordinate >= 0;
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
    const ambulo_link *next = ambulo_model_link(model, link_at(model, link, depth));
    if (moves(next)) {
      ambulo__path_joint *joint = &path->joints[path->count++];
      *joint = (ambulo__path_joint){
          next->coordinate, next->type == AMBULO_REVOLUTE, next->theta, next->d, {0}};
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
    double value = q[joint->coordinate * AMBULO__LANES];
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
