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

/* A link with the constants that it has at q = 0: a coupled joint need not stand at 0 there.
 * followed [coordinates]: what coupled joints follow instead; NULL: zeros. */
static ambulo_link link_at_zero(const ambulo_model *model, int index, const double *followed) {
  ambulo_link link = model->links[index];
  const ambulo__coupling *coupling = &model->couplings[index];
  if (coupling->to < 0) return link;
  double value = ambulo__coupling_value(coupling, followed ? followed[coupling->to] : 0.0, NULL);
  *(link.type == AMBULO_REVOLUTE ? &link.theta : &link.d) += value;
  return link;
}

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
  for (int i = link; i >= 0; i = model->links[i].parent) {
    ambulo_link at = link_at_zero(model, i, NULL);
    to_parent(&at, is_point, v);
  }
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
  if (model->links[link].type == AMBULO_FIXED) return 0;
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

/* what rounds to level is level */
static double slope_of(const ambulo_model *model) {
  static const double least = 1e-12;
  const double *g = model->gravity;
  double up = 0.0, forward = 0.0;
  for (int k = 0; k < 3; k++) {
    up -= g[k] * model->up[k];
    forward -= g[k] * model->forward[k];
  }
  double slope = atan2(forward, up);
  return fabs(slope) > least ? slope : 0.0;
}

/* (13.n) + or - the slope */
double ambulo__lean(const ambulo_model *model, int coordinate) {
  static const double parallel = 1.0 - 1e-9;
  double axis[3], along = 0.0, slope = slope_of(model);
  int own = model->coordinate_link[coordinate];
  if (slope == 0.0 || model->coordinates[coordinate].type != AMBULO_REVOLUTE) return 0.0;
  for (int i = model->links[own].parent; i >= 0; i = model->links[i].parent)
    if (model->links[i].type == AMBULO_REVOLUTE) return 0.0;
  if (!ambulo__carries_whole_body(model, coordinate)) return 0.0;
  ambulo__neutral_axis(model, coordinate, axis);
  for (int k = 0; k < 3; k++) along += axis[k] * model->left[k];
  return fabs(along) > parallel ? copysign(slope, along * slope) : 0.0;
}

int ambulo__carries_whole_body(const ambulo_model *model, int coordinate) {
  for (int l = 0; l < model->link_count; l++) {
    int at = l;
    while (at >= 0 && model->links[at].coordinate != coordinate) at = model->links[at].parent;
    if (at < 0 && model->links[l].mass > 0.0) return 0;
  }
  return 1;
}

/* DH transforms and bodies at q = 0 (segments.h).
 *
 * T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) has, with c, s of theta,
 *
 *         [ c  -s ca   s sa ]           [ a c ]
 *     R = [ s   c ca  -c sa ],      t = [ a s ],      A_i = A_p R,   o_i = o_p + A_p t
 *         [ 0     sa     ca ]           [  d  ]
 *
 * The world's frame has the rows forward, up and left instead of the unit matrix. A body of link i
 * becomes  c = o_i + A_i c_i,  I = A_i I_i A_i'.
 */

static ambulo__segment_frame world_frame(const ambulo_model *model) {
  ambulo__segment_frame world;
  for (int j = 0; j < 3; j++) {
    world.axes[0][j] = model->forward[j];
    world.axes[1][j] = model->up[j];
    world.axes[2][j] = model->left[j];
    world.origin[j] = 0.0;
  }
  return world;
}

/* A v */
static void turn(const ambulo__segment_frame *frame, const double v[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] = frame->axes[i][0] * v[0] + frame->axes[i][1] * v[1] + frame->axes[i][2] * v[2];
}

static void place(const ambulo__segment_frame *frame, const double v[3], double out[3]) {
  turn(frame, v, out);
  for (int i = 0; i < 3; i++) out[i] += frame->origin[i];
}

static ambulo__segment_frame frame_of(const ambulo__segment_frame *parent,
                                      const ambulo_link *link) {
  double c = cos(link->theta), s = sin(link->theta);
  double ca = cos(link->alpha), sa = sin(link->alpha);
  const double columns[3][3] = {{c, s, 0.0}, {-s * ca, c * ca, sa}, {s * sa, -c * sa, ca}};
  const double t[3] = {link->a * c, link->a * s, link->d};
  ambulo__segment_frame frame;
  for (int j = 0; j < 3; j++) {
    double axis[3];
    turn(parent, columns[j], axis);
    for (int i = 0; i < 3; i++) frame.axes[i][j] = axis[i];
  }
  place(parent, t, frame.origin);
  return frame;
}

/* the body of a link in the common axes */
static ambulo__part body_of(const ambulo__segment_frame *frame, const ambulo_link *link) {
  static const int entry[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  ambulo__part body = {.mass = link->mass};
  place(frame, link->com, body.com);
  for (int e = 0; e < 6; e++) {
    for (int u = 0; u < 3; u++) {
      for (int v = 0; v < 3; v++) {
        body.inertia[e] +=
            frame->axes[row[e]][u] * link->inertia[entry[u][v]] * frame->axes[column[e]][v];
      }
    }
  }
  return body;
}

void ambulo__segments_at(ambulo__segments *s, const double *followed) {
  const ambulo_model *model = s->model;
  const ambulo__segment_frame world = world_frame(model);
  memset(s->body, 0, ((size_t)model->coordinate_count + 1) * sizeof *s->body);
  s->heaviest[0] = -1;
  for (int c = 0; c < model->coordinate_count; c++) s->heaviest[c + 1] = model->coordinate_link[c];
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link zero = link_at_zero(model, i, followed), *link = &zero;
    s->frame[i] = frame_of(link->parent < 0 ? &world : &s->frame[link->parent], link);
    s->of_link[i] = link->coordinate >= 0 ? link->coordinate + 1
                    : link->parent >= 0   ? s->of_link[link->parent]
                                          : 0;
    if (link->mass == 0.0) continue;
    int segment = s->of_link[i], *heaviest = &s->heaviest[segment];
    if (*heaviest < 0 || link->mass > model->links[*heaviest].mass) *heaviest = i;
    ambulo__part body = body_of(&s->frame[i], link);
    ambulo__part_add(&s->body[segment], &body);
  }
}

ambulo_status ambulo__segments_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                      ambulo__segments *segments) {
  ambulo__segments s = {.allocator = ambulo__allocator_or_default(allocator), .model = model};
  size_t links = (size_t)model->link_count, count = (size_t)model->coordinate_count + 1;
  s.frame = ambulo__alloc(&s.allocator, links, sizeof *s.frame);
  s.of_link = ambulo__alloc(&s.allocator, links, sizeof *s.of_link);
  s.body = ambulo__alloc(&s.allocator, count, sizeof *s.body);
  s.heaviest = ambulo__alloc(&s.allocator, count, sizeof *s.heaviest);
  if (!s.frame || !s.of_link || !s.body || !s.heaviest) {
    ambulo__segments_free(&s);
    return AMBULO_E_MEMORY;
  }
  ambulo__segments_at(&s, NULL);
  *segments = s;
  return AMBULO_OK;
}

void ambulo__segments_free(ambulo__segments *s) {
  ambulo__free(&s->allocator, s->frame);
  ambulo__free(&s->allocator, s->of_link);
  ambulo__free(&s->allocator, s->body);
  ambulo__free(&s->allocator, s->heaviest);
}

int ambulo__segment_parent(const ambulo__segments *s, int coordinate) {
  int parent = s->model->links[s->model->coordinate_link[coordinate]].parent;
  return parent < 0 ? 0 : s->of_link[parent];
}

ambulo__segment_frame ambulo__segment_joint(const ambulo__segments *s, int coordinate) {
  int parent = s->model->links[s->model->coordinate_link[coordinate]].parent;
  return parent < 0 ? world_frame(s->model) : s->frame[parent];
}

void ambulo__segment_point(const ambulo__segments *s, int point, double result[3]) {
  const ambulo_point *p = &s->model->points[point];
  place(&s->frame[p->link], p->position, result);
}
