/* mechanics/pose.c - see pose.h. */
#include "mechanics/pose.h"

#include <math.h>
#include <string.h>

/* The 3 x 4 rows of T(q) = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha). */
static void link_transform(const ambulo_link *link, double q, double t[12]) {
  double theta = link->theta + (link->type == AMBULO_REVOLUTE ? q : 0.0);
  double d = link->d + (link->type == AMBULO_PRISMATIC ? q : 0.0);
  double c = cos(theta), s = sin(theta), ca = cos(link->alpha), sa = sin(link->alpha);
  double rows[12] = {c,       -s * ca,     s * sa, link->a * c, s,  c * ca,
                     -c * sa, link->a * s, 0.0,    sa,          ca, d};
  memcpy(t, rows, sizeof rows);
}

static void multiply(const double *a, const double *b, double *product) {
  for (int r = 0; r < 3; r++) {
    for (int c = 0; c < 4; c++) {
      double sum = c == 3 ? a[4 * r + 3] : 0.0;
      for (int k = 0; k < 3; k++) sum += a[4 * r + k] * b[4 * k + c];
      product[4 * r + c] = sum;
    }
  }
}

/* (4) A_i = A_p T_i */
void ambulo__pose_at(ambulo__pose *pose, const double *q) {
  for (int i = 0; i < pose->model->link_count; i++) {
    const ambulo_link *link = &pose->model->links[i];
    double t[12], *frame = pose->frames + 12 * (size_t)i;
    link_transform(link, link->coordinate >= 0 ? q[link->coordinate] : 0.0, t);
    if (link->parent >= 0) {
      multiply(pose->frames + 12 * (size_t)link->parent, t, frame);
    } else {
      memcpy(frame, t, sizeof t);
    }
  }
}

void ambulo__pose_point(const ambulo__pose *pose, int link, const double local[3],
                        double world[3]) {
  if (link < 0) {
    memcpy(world, local, 3 * sizeof *world);
    return;
  }
  const double *f = pose->frames + 12 * (size_t)link;
  for (int r = 0; r < 3; r++)
    world[r] =
        f[4 * r] * local[0] + f[4 * r + 1] * local[1] + f[4 * r + 2] * local[2] + f[4 * r + 3];
}

void ambulo__pose_center_of_mass(const ambulo__pose *pose, double center[3]) {
  const ambulo_model *model = pose->model;
  for (int i = 0; i < 3; i++) center[i] = 0.0;
  for (int link = 0; link < model->link_count; link++) {
    double at[3], mass = model->links[link].mass;
    ambulo__pose_point(pose, link, model->links[link].com, at);
    for (int i = 0; i < 3; i++) center[i] += mass / model->mass * at[i];
  }
}

ambulo_status ambulo__pose_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                  ambulo__pose *pose) {
  ambulo__pose p = {.allocator = ambulo__allocator_or_default(allocator), .model = model};
  p.frames = ambulo__alloc(&p.allocator, 12 * (size_t)model->link_count, sizeof *p.frames);
  if (!p.frames) return AMBULO_E_MEMORY;
  *pose = p;
  return AMBULO_OK;
}

void ambulo__pose_free(ambulo__pose *pose) {
  ambulo__free(&pose->allocator, pose->frames);
}
