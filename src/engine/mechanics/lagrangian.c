/* mechanics/lagrangian.c - the reference recursion, one state at a time, in complex numbers.
 *
 * Quantities of link i, parent p (world axes unless said otherwise; SI, radians):
 *   T, T', T''  [3][4]  DH transform of the link and its derivatives with respect to q
 *   A, B, C     [3][4]  position matrix and its first and second time derivative
 *   J           [4][4]  pseudo-inertia, integral of r r^T dm in the link frame
 *   D           [4][3]  Eq. (11);  E [4]  Eq. (12)
 * The missing bottom row of T and A is (0 0 0 1), of all others (0 0 0 0).
 *
 *   A_i = A_p T_i                                                                  (4)
 *   B_i = B_p T_i + A_p T_i' qd                                                    (5)
 *   C_i = C_p T_i + 2 B_p T_i' qd + A_p T_i'' qd^2 + A_p T_i' qdd                  (6)
 *   r = A r_i,  rd = B r_i,  rdd = C r_i                                           (7-9)
 *   tau_i = tr[ dA_i/dq D_i ] - g^T dA_i/dq E_i,  dA_i/dq = A_p T_i'               (10)
 *   D_i = J_i C_i^T + sum over children T_c D_c                                    (11)
 *   E_i = m_i r_i + sum over children T_c E_c                                      (12)
 *   tau_i += a_i qdd_i + b_i qd_i + c_i qd_i / sqrt(qd_i^2 + v^2)                  (10 D)
 * The last is what the joint's drive adds (ambulo_coordinate): armature a, damping b, friction c.
 *
 * The root wrench is computed from (7)-(9), not from (10)-(12): with c the centre of mass and
 * K = R S Rdd^T, S the second moment of mass about c, so that the rate of angular momentum is
 * the axial vector of K - K^T,
 *   F = sum m (cdd - g),   M = sum c x m (cdd - g) + axial(K - K^T)                (15')
 *
 * Everything is analytic in q, qd, qdd (no absolute value, no conjugate): a complex step gives
 * derivatives without cancellation.
 */
#include <math.h>
#include <string.h>

#include "ambulo/mechanics.h"
#include "base/sized.h"
#include "mechanics/lagrangian.h"
#include "model/model.h"

/* Scratch: link states, then tau [coordinates], then point positions [points][3]. */
size_t ambulo__lagrangian_scratch_size(const ambulo_model *model) {
  if (!model) return 0;
  return (size_t)model->link_count * sizeof(link_state) +
         ((size_t)model->coordinate_count + 3 * (size_t)model->point_count) * sizeof(scalar);
}

/* out += factor * X Y, all 3x4; y_bottom is the last entry of Y's bottom row. */
static void add_product(matrix *out, scalar factor, const matrix *x, const matrix *y,
                        double y_bottom) {
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 4; j++) {
      scalar sum = j == 3 ? x->e[i][3] * y_bottom : 0;
      for (int k = 0; k < 3; k++) sum += x->e[i][k] * y->e[k][j];
      out->e[i][j] += factor * sum;
    }
  }
}

/* (DH): T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha), and its derivatives with respect to
 * the link's coordinate: by theta for a revolute link, by d for a prismatic one. */
static void transform(const ambulo_link *link, scalar q, link_state *s) {
  scalar theta = link->theta + (link->type == AMBULO_REVOLUTE ? q : 0);
  scalar d = link->d + (link->type == AMBULO_PRISMATIC ? q : 0);
  scalar ct = ccos(theta), st = csin(theta);
  double ca = cos(link->alpha), sa = sin(link->alpha), a = link->a;
  s->t =
      (matrix){{{ct, -st * ca, st * sa, a * ct}, {st, ct * ca, -ct * sa, a * st}, {0, sa, ca, d}}};
  s->t1 = s->t2 = (matrix){{{0}}};
  if (link->type == AMBULO_PRISMATIC) s->t1.e[2][3] = 1;
  if (link->type != AMBULO_REVOLUTE) return;
  for (int j = 0; j < 4; j++) {
    s->t1.e[0][j] = -s->t.e[1][j];
    s->t1.e[1][j] = s->t.e[0][j];
    s->t2.e[0][j] = -s->t.e[0][j];
    s->t2.e[1][j] = -s->t.e[1][j];
  }
}

static scalar component(const double *values, int is_complex, int index) {
  if (is_complex) return values[2 * index] + values[2 * index + 1] * I;
  return values[index];
}

/* A joint's value and rates: those of its coordinate, or, of a coupled one,
 *   theta = f(q),  theta_d = f' qd,  theta_dd = f' qdd + f'' qd^2 */
typedef struct joint_motion {
  scalar q, v, w, slope; /* slope: f' */
} joint_motion;

/* (K.1) */
static joint_motion couple(const ambulo__coupling *coupling, scalar q, scalar v, scalar w) {
  const ambulo__piece *piece = ambulo__coupling_piece(coupling, creal(q));
  const double *c = piece->c;
  scalar t = q - piece->at;
  scalar slope = c[1] + t * (2 * c[2] + t * (3 * c[3] + t * 4 * c[4]));
  scalar bend = 2 * c[2] + t * (6 * c[3] + t * 12 * c[4]);
  scalar value = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4])));
  return (joint_motion){value, slope * v, slope * w + bend * v * v, slope};
}

static joint_motion motion_of(const ambulo_model *model, int link, int is_complex, const double *q,
                              const double *qd, const double *qdd) {
  int k = ambulo__moved_by(model, link);
  if (k < 0) return (joint_motion){0, 0, 0, 0};
  scalar x = component(q, is_complex, k), v = component(qd, is_complex, k);
  scalar w = component(qdd, is_complex, k);
  if (model->links[link].coordinate >= 0) return (joint_motion){x, v, w, 1};
  return couple(&model->couplings[link], x, v, w);
}

/* (4) (5) (6) for all links, parents first. */
static void forward(const ambulo_model *model, int is_complex, const double *q, const double *qd,
                    const double *qdd, link_state *states) {
  static const matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  static const matrix zero = {{{0}}};
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    link_state *s = &states[i];
    const link_state *p = link->parent >= 0 ? &states[link->parent] : NULL;
    const matrix *a = p ? &p->a : &identity, *b = p ? &p->b : &zero, *c = p ? &p->c : &zero;
    joint_motion joint = motion_of(model, i, is_complex, q, qd, qdd);
    scalar v = joint.v, w = joint.w;
    s->slope = joint.slope;
    transform(link, joint.q, s);
    s->a = s->b = s->c = zero;
    add_product(&s->a, 1, a, &s->t, 1); /* (4) */
    add_product(&s->b, 1, b, &s->t, 1); /* (5) */
    add_product(&s->b, v, a, &s->t1, 0);
    add_product(&s->c, 1, c, &s->t, 1); /* (6) */
    add_product(&s->c, 2 * v, b, &s->t1, 0);
    add_product(&s->c, v * v, a, &s->t2, 0);
    add_product(&s->c, w, a, &s->t1, 0);
  }
}

/* Second moment of mass about the centre of mass: S = tr(I)/2 - I. */
static void second_moment(const ambulo_link *link, double s[3][3]) {
  const double *in = link->inertia;
  double half = 0.5 * (in[0] + in[1] + in[2]);
  double m[3][3] = {{half - in[0], -in[3], -in[4]},
                    {-in[3], half - in[1], -in[5]},
                    {-in[4], -in[5], half - in[2]}};
  memcpy(s, m, sizeof m);
}

static void pseudo_inertia(const ambulo_link *link, double j[4][4]) {
  double s[3][3], r[4] = {link->com[0], link->com[1], link->com[2], 1};
  second_moment(link, s);
  for (int a = 0; a < 4; a++) {
    for (int b = 0; b < 4; b++) j[a][b] = link->mass * r[a] * r[b] + (a < 3 && b < 3 ? s[a][b] : 0);
  }
}

/* (11) (12): D and E of the link itself, without the children. */
static void start_backward(const ambulo_link *link, link_state *s) {
  double j[4][4];
  pseudo_inertia(link, j);
  for (int a = 0; a < 4; a++) {
    for (int b = 0; b < 3; b++) {
      s->d[a][b] = 0;
      for (int k = 0; k < 4; k++) s->d[a][b] += j[a][k] * s->c.e[b][k];
    }
    s->e[a] = link->mass * (a < 3 ? link->com[a] : 1);
  }
}

/* (11) (12): Adds T_c D_c and T_c E_c of a child to its parent. */
static void add_to_parent(link_state *p, const link_state *c) {
  for (int i = 0; i < 4; i++) {
    for (int k = 0; k < 4; k++) {
      scalar t = i < 3 ? c->t.e[i][k] : (k == 3);
      for (int j = 0; j < 3; j++) p->d[i][j] += t * c->d[k][j];
      p->e[i] += t * c->e[k];
    }
  }
}

/* (10) */
static scalar joint_force(const ambulo_model *model, const link_state *p, const link_state *s) {
  static const matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  matrix derivative = {{{0}}};
  scalar tau = 0;
  add_product(&derivative, 1, p ? &p->a : &identity, &s->t1, 0);
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 4; k++) {
      tau += derivative.e[i][k] * s->d[k][i];
      tau -= model->gravity[i] * derivative.e[i][k] * s->e[k];
    }
  }
  return tau;
}

/* Eqs. (10)-(12), children first; (K.2) each coupled joint adds f' times its own force. */
static void backward(const ambulo_model *model, link_state *states, scalar *tau) {
  for (int i = 0; i < model->link_count; i++) start_backward(&model->links[i], &states[i]);
  for (int k = 0; k < model->coordinate_count; k++) tau[k] = 0;
  for (int i = model->link_count - 1; i >= 0; i--) {
    const ambulo_link *link = &model->links[i];
    link_state *p = link->parent >= 0 ? &states[link->parent] : NULL;
    int k = ambulo__moved_by(model, i);
    if (k >= 0) tau[k] += states[i].slope * joint_force(model, p, &states[i]);
    if (p) add_to_parent(p, &states[i]);
  }
}

/* (10 D) */
static void add_drives(const ambulo_model *model, int is_complex, const double *qd,
                       const double *qdd, scalar *tau) {
  for (int i = 0; i < model->coordinate_count; i++) {
    const ambulo_coordinate *c = &model->coordinates[i];
    scalar rate = component(qd, is_complex, i);
    double v = ambulo__friction_speed(c);
    tau[i] += c->armature * component(qdd, is_complex, i) + c->damping * rate;
    if (c->friction > 0.0) tau[i] += c->friction * rate / csqrt(rate * rate + v * v);
  }
}

/* (7) (8) (9): X r for a point r of the link frame. */
static void apply(const matrix *x, const double r[3], scalar out[3]) {
  for (int i = 0; i < 3; i++) {
    out[i] = x->e[i][3];
    for (int k = 0; k < 3; k++) out[i] += x->e[i][k] * r[k];
  }
}

/* (15'): one body's part. */
static void add_wrench(const ambulo_model *model, const ambulo_link *link, const link_state *s,
                       scalar wrench[6]) {
  scalar c[3], f[3], k[3][3] = {{0}};
  double m[3][3];
  apply(&s->a, link->com, c);
  apply(&s->c, link->com, f);
  second_moment(link, m);
  for (int i = 0; i < 3; i++) f[i] = link->mass * (f[i] - model->gravity[i]);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      for (int u = 0; u < 3; u++) {
        for (int v = 0; v < 3; v++) k[i][j] += s->a.e[i][u] * m[u][v] * s->c.e[j][v];
      }
    }
  }
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    wrench[i] += c[u] * f[v] - c[v] * f[u] + k[u][v] - k[v][u];
    wrench[3 + i] += f[i];
  }
}

static int all_finite(const scalar *values, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (!isfinite(creal(values[i])) || !isfinite(cimag(values[i]))) return 0;
  }
  return 1;
}

static void copy_out(double *out, int is_complex, const scalar *values, size_t count) {
  if (!out) return;
  for (size_t i = 0; i < count; i++) {
    if (is_complex) {
      out[2 * i] = creal(values[i]);
      out[2 * i + 1] = cimag(values[i]);
    } else {
      out[i] = creal(values[i]);
    }
  }
}

ambulo_status ambulo__lagrangian(int is_complex, const ambulo_model *model, const double *q,
                                 const double *qd, const double *qdd, const ambulo_outputs *outputs,
                                 void *scratch) {
  ambulo_outputs out;
  if (!model || !scratch || !AMBULO__OWN(ambulo_outputs, &out, outputs)) return AMBULO_E_ARGUMENT;
  if (model->coordinate_count > 0 && (!q || !qd || !qdd)) return AMBULO_E_ARGUMENT;
  size_t dofs = (size_t)model->coordinate_count, point_values = 3 * (size_t)model->point_count;
  link_state *states = scratch;
  scalar *forces = (scalar *)(void *)(states + model->link_count), *places = forces + dofs;
  scalar total[6] = {0};
  forward(model, is_complex, q, qd, qdd, states);
  backward(model, states, forces);
  add_drives(model, is_complex, qd, qdd, forces);
  for (int i = 0; i < model->link_count; i++) {
    add_wrench(model, &model->links[i], &states[i], total);
  }
  for (int i = 0; i < model->point_count; i++) {
    apply(&states[model->points[i].link].a, model->points[i].position, places + 3 * i);
  }
  if (!all_finite(forces, dofs + point_values) || !all_finite(total, 6)) {
    return AMBULO_E_NUMERIC;
  }
  copy_out(out.tau, is_complex, forces, dofs);
  copy_out(out.wrench, is_complex, total, 6);
  copy_out(out.points, is_complex, places, point_values);
  return AMBULO_OK;
}
