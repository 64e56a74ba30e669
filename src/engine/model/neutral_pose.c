/* model/neutral_pose.c - DH transforms at q = 0, applied from a link to the world.
 *
 * T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) (ambulo/model.h). A vector v of
 * the link frame reads in the parent frame:
 *
 *     w = Rot_x(alpha) v,  w_x += a (points only)
 *     T v = ( c w_x - s w_y,  s w_x + c w_y,  w_z + d (points only) ),  c, s of theta
 *
 * The joint of a link turns about, or slides along, the z axis of its parent frame.
 */
#include "model/neutral_pose.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static const double parallel_tolerance = 1e-9;

/* (DH): v of the link frame into the parent frame; `is_point` adds the translation */
static void to_parent(const ambulo_link *link, int is_point, double v[3]) {
  double ca = cos(link->alpha), sa = sin(link->alpha);
  double ct = cos(link->theta), st = sin(link->theta);
  double x = v[0] + (is_point ? link->a : 0.0);
  double y = ca * v[1] - sa * v[2];
  double z = sa * v[1] + ca * v[2];
  v[0] = ct * x - st * y;
  v[1] = st * x + ct * y;
  v[2] = z + (is_point ? link->d : 0.0);
}

static void to_world(const ambulo_model *model, int link, int is_point, double v[3]) {
  for (int i = link; i >= 0; i = model->links[i].parent) to_parent(&model->links[i], is_point, v);
}

void ambulo__neutral_points(ambulo_model *model) {
  for (int i = 0; i < model->point_count; i++)
    ambulo__neutral_place(model, model->points[i].link, model->points[i].position,
                          model->neutral + (size_t)(3 * i));
}

void ambulo__neutral_place(const ambulo_model *model, int link, const double local[3],
                           double world[3]) {
  memcpy(world, local, 3 * sizeof *world);
  to_world(model, link, 1, world);
}

void ambulo__neutral_point(const ambulo_model *model, int point, double world[3]) {
  memcpy(world, model->neutral + (size_t)(3 * point), 3 * sizeof *world);
}

void ambulo__neutral_local(const ambulo_model *model, int link, const double world[3],
                           double position[3]) {
  double origin[3] = {0.0, 0.0, 0.0};
  to_world(model, link, 1, origin);
  for (int k = 0; k < 3; k++) {
    double axis[3] = {k == 0, k == 1, k == 2};
    to_world(model, link, 0, axis);
    position[k] = 0.0;
    for (int i = 0; i < 3; i++) position[k] += axis[i] * (world[i] - origin[i]);
  }
}

static void link_axis(const ambulo_model *model, int link, double axis[3]) {
  axis[0] = axis[1] = 0.0;
  axis[2] = 1.0;
  to_world(model, model->links[link].parent, 0, axis);
}

void ambulo__neutral_axis(const ambulo_model *model, int coordinate, double axis[3]) {
  link_axis(model, model->coordinate_link[coordinate], axis);
}

/* does the joint of this one link leave the plane, its ancestors left alone? */
static int joint_moves_sideways(const ambulo_model *model, int link) {
  if (model->links[link].coordinate < 0) return 0;
  double axis[3];
  link_axis(model, link, axis);
  double along = fabs(ambulo__dot(axis, model->left));
  if (model->links[link].type == AMBULO_PRISMATIC) return along > parallel_tolerance;
  return along < 1.0 - parallel_tolerance;
}

int ambulo__link_moves_sideways(const ambulo_model *model, int link) {
  for (int i = link; i >= 0; i = model->links[i].parent) {
    if (joint_moves_sideways(model, i)) return 1;
  }
  return 0;
}

int ambulo__model_moves_sideways(const ambulo_model *model) {
  for (int i = 0; i < model->link_count; i++) {
    if (joint_moves_sideways(model, i)) return 1;
  }
  return 0;
}

int ambulo__is_root_translation(const ambulo_model *model, int coordinate) {
  for (int i = model->coordinate_link[coordinate]; i >= 0; i = model->links[i].parent) {
    if (model->links[i].type == AMBULO_REVOLUTE) return 0;
  }
  return model->coordinates[coordinate].type == AMBULO_PRISMATIC;
}
