/* support/ground_reference.h - the two-step ground reaction, one state at a time.
 *
 * The inverse dynamics without contact gives torques tau0 and the root wrench (M, F) about the
 * world origin. With n the normal, the ground n . r = height, D the nominal centre of pressure of
 * foot 0 less that of foot 1, a_0 + a_1 = 1 and z the height of the centre of mass:
 *   p   = (n x M + height F) / (n . F)                                             (16')
 *   h   = kappa a_0 a_1 (n . F) D / z
 *   F_0 = a_0 F - h,  M_0 = a_0 M + a_0 a_1 D x F - c_0 x h,  c_0 = p + a_1 D
 *   F_1 = a_1 F + h,  M_1 = a_1 M - a_0 a_1 D x F + c_1 x h,  c_1 = p - a_0 D
 *   T_f = n . (M_f - c_f x F_f)
 * A wrench (M, F) on a link below joint i has at it the generalized force beta . M + s . F, where
 * the motion (beta, s) is read off  dA/dq_i A^-1 = [beta x, s],  dA_i/dq_i = A_p T_i'. Hence
 *   tau_i = tau0_i - sum over the feet f below joint i of (beta . M_f + s . F_f)
 * Written as it stands here, in complex numbers, to test the lane kernels by complex steps.
 */
#ifndef AMBULO_TESTS_GROUND_REFERENCE_H
#define AMBULO_TESTS_GROUND_REFERENCE_H

#include "ambulo/mechanics.h"
#include "mechanics/lagrangian.h"
#include "model/model.h"

typedef struct reference_wrench {
  scalar moment[3], force[3];
} reference_wrench;

static inline scalar reference_dot(const scalar a[3], const scalar b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void reference_cross(const scalar a[3], const scalar b[3], scalar out[3]) {
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    out[i] = a[u] * b[v] - a[v] * b[u];
  }
}

static inline void reference_center_of_mass(const ambulo_model *model, const link_state *states,
                                            scalar center[3]) {
  double mass = 0;
  for (int i = 0; i < 3; i++) center[i] = 0;
  for (int l = 0; l < model->link_count; l++) {
    const ambulo_link *link = &model->links[l];
    mass += link->mass;
    for (int i = 0; i < 3; i++) {
      scalar r = states[l].a.e[i][3];
      for (int k = 0; k < 3; k++) r += states[l].a.e[i][k] * link->com[k];
      center[i] += link->mass * r;
    }
  }
  for (int i = 0; i < 3; i++) center[i] /= mass;
}

/* Wrench of foot f about the world origin, and its free moment. */
static inline reference_wrench reference_split(const reference_wrench *root, const scalar up[3],
                                               double height, const double *ground, scalar z,
                                               int foot, scalar *free_moment) {
  double sign = foot ? -1 : 1, a = foot ? 1 - ground[0] : ground[0], product = a * (1 - a);
  scalar normal = reference_dot(up, root->force), d[3], h[3], c[3], lever[3], twist[3], arm[3];
  reference_wrench out;
  reference_cross(up, root->moment, lever);
  for (int i = 0; i < 3; i++) {
    d[i] = ground[1 + i];
    h[i] = sign * ground[4] * product * normal * d[i] / z;
    c[i] = (lever[i] + height * root->force[i]) / normal + sign * (1 - a) * d[i];
  }
  reference_cross(d, root->force, twist);
  reference_cross(c, h, arm);
  for (int i = 0; i < 3; i++) {
    out.force[i] = a * root->force[i] - h[i];
    out.moment[i] = a * root->moment[i] + sign * product * twist[i] - arm[i];
  }
  reference_cross(c, out.force, arm);
  *free_moment = reference_dot(up, out.moment) - reference_dot(up, arm);
  return out;
}

/* beta . M + s . F at the joint of `link`. */
static inline scalar reference_generalized_force(const ambulo_model *model,
                                                 const link_state *states, int link,
                                                 const reference_wrench *w) {
  static const matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  int parent = model->links[link].parent;
  const matrix *p = parent >= 0 ? &states[parent].a : &identity, *a = &states[link].a;
  const matrix *t1 = &states[link].t1;
  scalar step[3][4], turn[3][3], total = 0;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 4; j++) {
      step[i][j] = 0;
      for (int k = 0; k < 3; k++) step[i][j] += p->e[i][k] * t1->e[k][j];
    }
    scalar slide = step[i][3];
    for (int j = 0; j < 3; j++) {
      turn[i][j] = 0;
      for (int k = 0; k < 3; k++) turn[i][j] += step[i][k] * a->e[j][k];
      slide -= turn[i][j] * a->e[j][3];
    }
    total += slide * w->force[i];
  }
  for (int i = 0; i < 3; i++) total += turn[(i + 2) % 3][(i + 1) % 3] * w->moment[i];
  return total;
}

/* Takes the wrench off the torques of every joint from the foot's link to the world. */
static inline void reference_subtract(const ambulo_model *model, const link_state *states, int link,
                                      const reference_wrench *w, scalar *tau) {
  for (; link >= 0; link = model->links[link].parent) {
    int k = model->links[link].coordinate;
    if (k >= 0) tau[k] -= reference_generalized_force(model, states, link, w);
  }
}

/* The output rows of a grounded plan (mechanics/plan.h) for a model with two feet. Everything but
 * `ground` (AMBULO__GROUND_ENTRIES numbers: share of foot 0, D, kappa) is complex, as interleaved
 * pairs: a complex step of a coordinate gives a column of the Jacobian. `scratch` has
 * ambulo_lagrangian_scratch_size(model) bytes. Errors: those of the reference recursion. */
static inline ambulo_status ground_reaction_reference(const ambulo_model *model,
                                                      double ground_height, const double *ground,
                                                      const double *q, const double *qd,
                                                      const double *qdd, double *rows,
                                                      void *scratch) {
  int d = model->coordinate_count, points = 3 * model->point_count;
  ambulo_status status =
      ambulo_lagrangian_inverse_dynamics_complex(model, q, qd, qdd,
                                                 &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                                   .tau = rows,
                                                                   .wrench = rows + 2 * d,
                                                                   .points = rows + 2 * (d + 6)},
                                                 scratch);
  if (status != AMBULO_OK) return status;
  const link_state *states = scratch;
  scalar *out = (scalar *)(void *)rows, *feet = out + d + 6 + points;
  scalar center[3], up[3], z = -ground_height;
  reference_wrench root;
  reference_center_of_mass(model, states, center);
  for (int i = 0; i < 3; i++) {
    up[i] = model->up[i];
    z += up[i] * center[i];
    root.moment[i] = out[d + i];
    root.force[i] = out[d + 3 + i];
    feet[8 + i] = center[i];
  }
  for (int f = 0; f < 2; f++) {
    reference_wrench part =
        reference_split(&root, up, ground_height, ground, z, f, &feet[4 * f + 3]);
    for (int i = 0; i < 3; i++) feet[4 * f + i] = part.force[i];
    reference_subtract(model, states, model->points[model->feet[f].heel_center].link, &part, out);
  }
  return AMBULO_OK;
}

#endif
