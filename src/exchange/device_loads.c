/* exchange/device_loads.c - a device as a force and a torque on each of its two bodies (loads.h).
 *
 * Between two points the tension E pulls each of them towards the other. At a joint, a coordinate i
 * of a body whose joint has axes z_1 .. z_n of its kind, n <= 3: the torque (of a slider: force)
 *
 *     t = E w_i,   w_i . z_j = 1 for j = i, 0 for the others, w_i in their span
 *
 * on the body and -t on its parent have the generalized forces t . z_j: E at i and nothing at the
 * others of that joint; above it they cancel. With b, c the other axes (c = z_i x b where there are
 * two), w_i = b x c / (z_i . (b x c)). A force goes through the point that the joint's hinges
 * share, behind its sliders.
 */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "exchange/loads.h"

static const ambulo__export_body *body_of(const ambulo__bodies *bodies, int coordinate) {
  for (int b = 0; b < bodies->count; b++)
    for (int i = 0; i < bodies->list[b].joints; i++)
      if (bodies->list[b].coordinate[i] == coordinate) return &bodies->list[b];
  return NULL;
}

int ambulo__device_end(const ambulo__bodies *bodies, const ambulo_device *device, int end) {
  if (device->coordinate < 0) {
    int link = device->link[end];
    return link < 0 ? -1 : bodies->body_of[link];
  }
  const ambulo__export_body *body = body_of(bodies, device->coordinate);
  if (!body) return -1;
  return end ? body->parent : (int)(body - bodies->list);
}

/* z of the frame before the joint of a coordinate */
static void axis_of(const ambulo_model *model, const double *frames, int coordinate,
                    double axis[3]) {
  int link = 0;
  while (model->links[link].coordinate != coordinate) link++;
  int parent = model->links[link].parent;
  for (int i = 0; i < 3; i++)
    axis[i] = parent < 0 ? (double)(i == 2) : frames[12 * (size_t)parent + 4 * (size_t)i + 2];
}

/* w_i */
static void dual_axis(const ambulo__bodies *bodies, const ambulo__export_body *body, int coordinate,
                      const double *frames, double out[3]) {
  const ambulo_model *model = bodies->model;
  double axis[3], other[2][3], cross[3];
  int others = 0;
  axis_of(model, frames, coordinate, axis);
  for (int i = 0; i < body->joints; i++) {
    int c = body->coordinate[i];
    if (c != coordinate && model->coordinates[c].type == model->coordinates[coordinate].type)
      axis_of(model, frames, c, other[others++]);
  }
  memcpy(out, axis, sizeof axis);
  if (others == 0) return;
  if (others == 1) ambulo__cross(axis, other[0], other[1]);
  ambulo__cross(other[0], other[1], cross);
  double along = ambulo__dot(axis, cross);
  for (int i = 0; i < 3; i++) out[i] = cross[i] / along;
}

/* where the hinges of a body's joint meet */
static void center_of(const ambulo__bodies *bodies, const ambulo__export_body *body,
                      const double *frames, double point[3]) {
  ambulo__rigid back = ambulo__rigid_inverse(&body->after);
  double local[3];
  const double *f = frames + 12 * (size_t)body->link;
  const ambulo__rigid *place = &bodies->place[body->link];
  for (int i = 0; i < 3; i++) back.p[i] -= place->p[i];
  ambulo__rigid_back(place, back.p, local);
  for (int i = 0; i < 3; i++) point[i] = ambulo__dot(f + 4 * i, local) + f[4 * i + 3];
}

static void place_of(const double *frames, int link, const double local[3], double point[3]) {
  memcpy(point, local, 3 * sizeof *point);
  if (link < 0) return;
  const double *f = frames + 12 * (size_t)link;
  for (int i = 0; i < 3; i++) point[i] = ambulo__dot(f + 4 * i, local) + f[4 * i + 3];
}

static void pull(const ambulo_device *device, int end, const double *frames, double effort,
                 double force[3], double point[3]) {
  double other[3], length = 0.0;
  place_of(frames, device->link[end], device->position[end], point);
  place_of(frames, device->link[!end], device->position[!end], other);
  for (int i = 0; i < 3; i++) length += (other[i] - point[i]) * (other[i] - point[i]);
  for (int i = 0; i < 3; i++) force[i] = effort * (other[i] - point[i]) / sqrt(length);
}

void ambulo__device_load(const ambulo__bodies *bodies, const ambulo_device *device, int end,
                         const double *frames, double effort, double force[3], double point[3],
                         double torque[3]) {
  static const double none[3] = {0.0, 0.0, 0.0};
  memcpy(force, none, sizeof none);
  memcpy(torque, none, sizeof none);
  if (device->coordinate < 0) {
    pull(device, end, frames, effort, force, point);
    return;
  }
  const ambulo__export_body *body = body_of(bodies, device->coordinate);
  double axis[3], size = end ? -effort : effort;
  int turns = bodies->model->coordinates[device->coordinate].type == AMBULO_REVOLUTE;
  dual_axis(bodies, body, device->coordinate, frames, axis);
  center_of(bodies, body, frames, point);
  for (int i = 0; i < 3; i++) *(turns ? torque + i : force + i) = size * axis[i];
}
