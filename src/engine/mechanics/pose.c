/* mechanics/pose.c - see pose.h; velocity of a point, ambulo/mechanics.h.
 *
 * Velocity. A link hands a point x, given in its frame, to its parent as
 *
 *     x' = R(q_i) x + t(q_i),    v' = R(q_i) v + qd_i x'_i,    v = 0 in the link that holds it
 *
 * with x'_i = dx'/dq_i. The joint turns about, or slides along, z of the parent's frame, which
 * passes through its origin. Thus with a = z of a revolute joint, a = 0 of another,
 *
 *     x'_i = a x x' (revolute), z (prismatic), 0 (fixed)
 *
 * On the way from the link to the world each step adds the slopes by its own q_i, and carries those
 * by the coordinates k beyond it:
 *
 *     x'_k = R x_k,    v'_k = R v_k + qd_i a x x'_k,    v'_i = a x v'
 *
 * The last because dR/dq_i = a x R and da/dq_i = 0, and v' holds qd_i x'_i already. Velocity is
 * linear in qd: its slopes by qd are those of x by q.
 *
 * A coupled joint stands at f(q_c) and moves at f' qd_c. So x'_c gains f' x'_i, and v'_c gains
 * f' v'_i + f'' qd_c x'_i, each beside what it has from joints further out that q_c moves too.
 */
#include "mechanics/pose.h"

#include "ambulo/mechanics.h"
#include "base/sized.h"

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
    link_transform(link, ambulo__joint_value(pose->model, i, q, NULL), t);
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

/* ------------------------------------------------------------ velocity of a point */

/* Inputs up to this cannot make results overflow. */
static const double most_input = 1e100;

static int is_usable(const double *x, int count) {
  for (int i = 0; i < count; i++)
    if (!(fabs(x[i]) <= most_input)) return 0; /* also NaN */
  return 1;
}

/* x becomes R x, R of the 3 x 4 rows t; entries are `stride` apart */
static void rotate(const double *t, double *x, int stride) {
  double a = x[0], b = x[stride], c = x[2 * stride];
  for (int r = 0; r < 3; r++) x[r * stride] = t[4 * r] * a + t[4 * r + 1] * b + t[4 * r + 2] * c;
}

/* 1: a link further out on the way to `link` is moved by the same coordinate as link k. */
static int is_carried(const ambulo_model *model, int link, int k) {
  const int c = ambulo__moved_by(model, k);
  if (model->coupled_count == 0) return 0;
  for (; link != k; link = model->links[link].parent)
    if (ambulo__moved_by(model, link) == c) return 1;
  return 0;
}

/* Slopes by the coordinates beyond link i, up to the point's own link, carried to i's parent. turn:
 * rate of a revolute joint. */
static void carry_slopes(const ambulo_model *model, int link, int i, const double *t, double turn,
                         const ambulo_point_motion *to) {
  const int d = model->coordinate_count;
  for (int k = link; k != i; k = model->links[k].parent) {
    const int c = ambulo__moved_by(model, k);
    if (c < 0 || is_carried(model, link, k)) continue;
    double *x = to->position_q + c;
    rotate(t, x, d);
    if (!to->velocity_q) continue;
    double *v = to->velocity_q + c;
    rotate(t, v, d);
    v[0] -= turn * x[d];
    v[d] += turn * x[0];
  }
}

/* A joint as it stands and moves. */
typedef struct passed {
  int turns, coordinate; /* that moves it; -1: none does */
  double rate;           /* f' qd */
  double slope, drift;   /* f', f'' qd */
} passed;

/* x and v from a link's frame to that of its parent, and the slopes by what moves its joint */
static void pass_joint(const passed *joint, int d, const double *t, double x[3], double v[3],
                       const ambulo_point_motion *to) {
  const int turns = joint->turns, c = joint->coordinate;
  rotate(t, x, 1);
  rotate(t, v, 1);
  for (int r = 0; r < 3; r++) x[r] += t[4 * r + 3];
  if (c < 0) return;
  const double by_q[3] = {turns ? -x[1] : 0.0, turns ? x[0] : 0.0, turns ? 0.0 : 1.0};
  for (int r = 0; r < 3; r++) v[r] += joint->rate * by_q[r];
  for (int r = 0; r < 3 && to->position_q; r++) to->position_q[r * d + c] += joint->slope * by_q[r];
  if (!to->velocity_q) return;
  const double turned[3] = {turns ? -v[1] : 0.0, turns ? v[0] : 0.0, 0.0};
  for (int r = 0; r < 3; r++)
    to->velocity_q[c + r * d] += joint->slope * turned[r] + joint->drift * by_q[r];
}

ambulo_status ambulo_model_point_motion(const ambulo_model *model, int link, const double local[3],
                                        const double *q, const double *qd,
                                        const ambulo_point_motion *motion) {
  ambulo_point_motion to;
  if (!model || !local || !motion || link < -1 || link >= model->link_count ||
      !AMBULO__OWN(ambulo_point_motion, &to, motion) || (to.velocity_q && !to.position_q))
    return AMBULO_E_ARGUMENT;
  const int d = model->coordinate_count;
  if (d > 0 && (!q || !qd)) return AMBULO_E_ARGUMENT;
  if (!is_usable(local, 3) || !is_usable(q, d) || !is_usable(qd, d)) return AMBULO_E_NUMERIC;
  const size_t slopes = 3 * (size_t)d;
  if (to.position_q && d > 0) memset(to.position_q, 0, slopes * sizeof(double));
  if (to.velocity_q && d > 0) memset(to.velocity_q, 0, slopes * sizeof(double));
  double x[3] = {local[0], local[1], local[2]}, v[3] = {0.0, 0.0, 0.0};
  for (int i = link; i >= 0; i = model->links[i].parent) {
    const ambulo_link *at = &model->links[i];
    const int c = ambulo__moved_by(model, i);
    double t[12], f[AMBULO__COUPLING_SLOPES];
    link_transform(at, ambulo__joint_value(model, i, q, f), t);
    const double speed = c >= 0 ? qd[c] : 0.0;
    const passed joint = {at->type == AMBULO_REVOLUTE, c, f[0] * speed, f[0], f[1] * speed};
    if (to.position_q) carry_slopes(model, link, i, t, joint.turns ? joint.rate : 0.0, &to);
    pass_joint(&joint, d, t, x, v, &to);
  }
  if (to.position) memcpy(to.position, x, sizeof x);
  if (to.velocity) memcpy(to.velocity, v, sizeof v);
  return AMBULO_OK;
}
