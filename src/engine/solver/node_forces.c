/* solver/node_forces.c - kinematics of one node, and the loads of joints (node_forces.h).
 *
 * Joint i turns about, or slides along, the z axis of the frame its link hangs on (classical DH
 * parameters): axis z_i through o_i. Down the tree, with r from the parent's origin,
 *
 *     turning   omega = omega_p + z qd,   alpha = alpha_p + z qdd + omega_p x z qd
 *               a = a_p + alpha x r + omega x (omega x r)
 *     sliding   omega, alpha as the parent's;   a = .. + z qdd + 2 omega x z qd
 *
 * A wrench (M, F) on what the joint carries asks S_i . (M, F) of it: z . (M - o x F), or z . F.
 */
#include "solver/node_forces.h"
#include "base/arithmetic.h"

#include <string.h>

ambulo_status ambulo__node_forces_create(const ambulo__stationary *s, ambulo__pool *pool,
                                         ambulo__node_forces *f) {
  size_t d = (size_t)s->problem->coordinates, links = (size_t)s->problem->model->link_count;
  *f = (ambulo__node_forces){.s = s, .q = ambulo__pool_doubles(pool, d)};
  f->qd = ambulo__pool_doubles(pool, d);
  f->qdd = ambulo__pool_doubles(pool, d);
  f->torque = ambulo__pool_doubles(pool, d);
  f->axis = ambulo__pool_doubles(pool, 3 * d);
  f->origin = ambulo__pool_doubles(pool, 3 * d);
  f->omega = ambulo__pool_doubles(pool, 3 * links);
  f->alpha = ambulo__pool_doubles(pool, 3 * links);
  f->acceleration = ambulo__pool_doubles(pool, 3 * links);
  if (pool->failed) return AMBULO_E_MEMORY;
  return ambulo__pose_create(s->problem->model, &pool->allocator, &f->pose);
}

void ambulo__node_forces_free(ambulo__node_forces *f) {
  if (f->pose.model) ambulo__pose_free(&f->pose);
}

static void place_joint(ambulo__node_forces *f, const ambulo_link *link) {
  double *axis = f->axis + 3 * link->coordinate, *origin = f->origin + 3 * link->coordinate;
  for (int i = 0; i < 3; i++) {
    const double *row = f->pose.frames + 12 * (size_t)(link->parent < 0 ? 0 : link->parent) + 4 * i;
    axis[i] = link->parent < 0 ? (i == 2 ? 1.0 : 0.0) : row[2];
    origin[i] = link->parent < 0 ? 0.0 : row[3];
  }
}

/* adds alpha x r + omega x (omega x r) of a link's turning */
static void add_turning(const ambulo__node_forces *f, int link, const double r[3], double out[3]) {
  double tangential[3], velocity[3], inward[3];
  ambulo__cross(f->alpha + 3 * link, r, tangential);
  ambulo__cross(f->omega + 3 * link, r, velocity);
  ambulo__cross(f->omega + 3 * link, velocity, inward);
  for (int i = 0; i < 3; i++) out[i] += tangential[i] + inward[i];
}

static void move_link(ambulo__node_forces *f, int index) {
  static const double still[3] = {0.0, 0.0, 0.0};
  const ambulo_link *link = &f->s->problem->model->links[index];
  const double *parent[3] = {still, still, still}, *frame = f->pose.frames + 12 * (size_t)index;
  double *omega = f->omega + 3 * index, *alpha = f->alpha + 3 * index;
  double *a = f->acceleration + 3 * index, r[3], spin[3] = {0}, turned[3];
  int p = link->parent, i = link->coordinate;
  if (p >= 0) {
    parent[0] = f->omega + 3 * p;
    parent[1] = f->alpha + 3 * p;
    parent[2] = f->acceleration + 3 * p;
  }
  for (int k = 0; k < 3; k++) {
    r[k] = frame[4 * k + 3] - (p >= 0 ? f->pose.frames[12 * p + 4 * k + 3] : 0.0);
    if (i >= 0) spin[k] = f->axis[3 * i + k] * f->qd[i];
  }
  ambulo__cross(parent[0], spin, turned);
  for (int k = 0; k < 3; k++) {
    double drive = i >= 0 ? f->axis[3 * i + k] * f->qdd[i] : 0.0;
    int turns = link->type == AMBULO_REVOLUTE;
    omega[k] = parent[0][k] + (turns ? spin[k] : 0.0);
    alpha[k] = parent[1][k] + (turns ? drive + turned[k] : 0.0);
    a[k] = parent[2][k] + (turns ? 0.0 : drive + 2.0 * turned[k]);
  }
  add_turning(f, index, r, a);
}

void ambulo__node_forces_at(ambulo__node_forces *f, int node) {
  const ambulo_problem *p = f->s->problem;
  f->node = node;
  for (int i = 0; i < p->coordinates; i++) {
    f->q[i] = ambulo__stationary_channel(f->s, node, ambulo__channel_q(&p->channels, i));
    f->qd[i] = ambulo__stationary_channel(f->s, node, ambulo__channel_qd(&p->channels, i));
    f->qdd[i] = ambulo__stationary_channel(f->s, node, ambulo__channel_qdd(&p->channels, i));
  }
  ambulo__pose_at(&f->pose, f->q);
  for (int i = 0; i < p->model->link_count; i++) {
    if (p->model->links[i].coordinate >= 0) place_joint(f, &p->model->links[i]);
    move_link(f, i);
  }
}

void ambulo__node_forces_acceleration(const ambulo__node_forces *f, int link, const double place[3],
                                      double acceleration[3]) {
  double r[3];
  for (int k = 0; k < 3; k++) {
    r[k] = place[k] - f->pose.frames[12 * (size_t)link + 4 * (size_t)k + 3];
    acceleration[k] = f->acceleration[3 * link + k];
  }
  add_turning(f, link, r, acceleration);
}

void ambulo__node_forces_clear(ambulo__node_forces *f) {
  memset(f->torque, 0, (size_t)f->s->problem->coordinates * sizeof *f->torque);
  memset(f->wrench, 0, sizeof f->wrench);
  memset(f->center, 0, sizeof f->center);
  memset(f->place, 0, sizeof f->place);
  memset(f->load, 0, sizeof f->load);
  f->moment_arm = f->slant = 0.0;
}

double ambulo__node_forces_joint(const ambulo__node_forces *f, int i, const double wrench[6]) {
  const double *z = f->axis + 3 * i;
  double about[3], sum = 0.0;
  ambulo__cross(f->origin + 3 * i, wrench + 3, about);
  int turns = f->s->problem->model->coordinates[i].type == AMBULO_REVOLUTE;
  for (int k = 0; k < 3; k++) sum += z[k] * (turns ? wrench[k] - about[k] : wrench[3 + k]);
  return sum;
}

static void add_wrench(ambulo__node_forces *f, int link, const double wrench[6]) {
  for (int k = 0; k < 6; k++) f->wrench[k] += wrench[k];
  for (; link >= 0; link = f->s->problem->model->links[link].parent) {
    int i = f->s->problem->model->links[link].coordinate;
    if (i >= 0) f->torque[i] += ambulo__node_forces_joint(f, i, wrench);
  }
}

/* (S.7) S_i . (p x F, F) of the joints that carry it */
void ambulo__node_forces_add(ambulo__node_forces *f, int link, const double place[3],
                             const double force[3]) {
  double wrench[6];
  ambulo__cross(place, force, wrench);
  memcpy(wrench + 3, force, 3 * sizeof *force);
  add_wrench(f, link, wrench);
}

void ambulo__node_forces_turn(ambulo__node_forces *f, int link, const double moment[3]) {
  const double wrench[6] = {moment[0], moment[1], moment[2], 0.0, 0.0, 0.0};
  add_wrench(f, link, wrench);
}
