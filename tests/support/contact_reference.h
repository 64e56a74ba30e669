/* support/contact_reference.h - the wrenches on contacts (W'), one state at a time.
 *
 * The inverse dynamics without contact gives torques tau0, the root wrench (M, F) about the world
 * origin and the centre of mass c. With weights w_k and centres p_k of the contacts, a point o near
 * them, d_k = p_k - o and e_k = (c - p_k) / |c - p_k|:
 *   A_k = w_k (1 - e e^T + e e^T / epsilon^2),   B_k = w_k l^2 1,   Q_k = [A_k 0; 0 B_k]
 *   J_k = [1 0; [d_k x] 1],   G = sum J_k Q_k J_k^T,   y = G^-1 (F, M - o x F)
 *   (f_k, m_k) = Q_k J_k^T y;   without any weight all are zero
 * A wrench (M, F) on a link below joint i has at it the generalized force beta . M + s . F, where
 * the motion (beta, s) is read off  dA/dq_i A^-1 = [beta x, s],  dA_i/dq_i = A_p T_i'. A contact's
 * wrench about the world origin, (m_k + p_k x f_k, f_k), is taken off the torques of the joints
 * that carry it; those that carry every mass and every contact have none. Written as it stands
 * here, with matrices and Gaussian elimination in complex numbers, to test the lane kernels by
 * complex steps.
 */
#ifndef AMBULO_TESTS_CONTACT_REFERENCE_H
#define AMBULO_TESTS_CONTACT_REFERENCE_H

#include "ambulo/mechanics.h"
#include "mechanics/lagrangian.h"
#include "model/model.h"

#include <math.h>

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

/* Takes the wrench off the torques of every joint from a link to the world. */
static inline void reference_subtract(const ambulo_model *model, const link_state *states, int link,
                                      const reference_wrench *w, scalar *tau) {
  for (; link >= 0; link = model->links[link].parent) {
    int k = ambulo__moved_by(model, link);
    if (k >= 0) tau[k] -= states[link].slope * reference_generalized_force(model, states, link, w);
  }
}

enum { reference_most_contacts = 6 };

typedef struct reference_contacts {
  int count, link[reference_most_contacts];
  scalar moment_arm, slant;
} reference_contacts;

/* x of a x = b, both overwritten; the largest pivot first. */
static inline void reference_solve(scalar a[6][6], scalar b[6]) {
  for (int k = 0; k < 6; k++) {
    int pivot = k;
    for (int i = k + 1; i < 6; i++) {
      if (cabs(a[i][k]) > cabs(a[pivot][k])) pivot = i;
    }
    for (int j = 0; j < 6; j++) {
      scalar swapped = a[k][j];
      a[k][j] = a[pivot][j];
      a[pivot][j] = swapped;
    }
    scalar swapped = b[k];
    b[k] = b[pivot];
    b[pivot] = swapped;
    for (int i = k + 1; i < 6; i++) {
      scalar factor = a[i][k] / a[k][k];
      for (int j = k; j < 6; j++) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int i = 5; i >= 0; i--) {
    for (int j = i + 1; j < 6; j++) b[i] -= a[i][j] * b[j];
    b[i] /= a[i][i];
  }
}

/* J Q (6 x 6, forces first) of a contact; d: its arm about o. */
static inline void reference_grasp(const reference_contacts *contacts, scalar weight,
                                   const scalar p[3], const scalar d[3], const scalar center[3],
                                   scalar j[6][6], scalar q[6][6]) {
  const scalar along = 1 / (contacts->slant * contacts->slant);
  scalar e[3], length = 0;
  for (int i = 0; i < 3; i++) e[i] = center[i] - p[i];
  length = csqrt(reference_dot(e, e));
  for (int i = 0; i < 6; i++) {
    for (int k = 0; k < 6; k++) j[i][k] = i == k, q[i][k] = 0;
  }
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    j[3 + i][v] = d[u];
    j[3 + i][u] = -d[v];
    for (int k = 0; k < 3; k++) {
      scalar ee = e[i] * e[k] / (length * length);
      q[i][k] = weight * ((i == k) - ee + ee * along);
    }
    q[3 + i][3 + i] = weight * contacts->moment_arm * contacts->moment_arm;
  }
}

/* Forces and moments [count][6] of the contacts; ground: o, then weight and centre of each. */
static inline void reference_share(const reference_contacts *contacts, const scalar *ground,
                                   const reference_wrench *root, const scalar center[3],
                                   scalar share[][6]) {
  scalar g[6][6] = {{0}}, y[6], o[3], arm[3];
  scalar j[reference_most_contacts][6][6], q[reference_most_contacts][6][6];
  double total = 0;
  for (int i = 0; i < 3; i++) o[i] = ground[i];
  reference_cross(o, root->force, arm);
  for (int i = 0; i < 3; i++) {
    y[i] = root->force[i];
    y[3 + i] = root->moment[i] - arm[i];
  }
  for (int c = 0; c < contacts->count; c++) {
    const scalar *of = ground + 3 + 4 * c, *p = of + 1;
    scalar d[3] = {p[0] - ground[0], p[1] - ground[1], p[2] - ground[2]};
    total += creal(of[0]);
    reference_grasp(contacts, of[0], p, d, center, j[c], q[c]);
    for (int i = 0; i < 6; i++) {
      for (int k = 0; k < 6; k++) {
        for (int a = 0; a < 6; a++) {
          for (int b = 0; b < 6; b++) g[i][k] += j[c][i][a] * q[c][a][b] * j[c][k][b];
        }
      }
    }
  }
  if (total > 0) reference_solve(g, y);
  for (int c = 0; c < contacts->count; c++) {
    for (int i = 0; i < 6; i++) {
      share[c][i] = 0;
      for (int a = 0; a < 6 && total > 0; a++) {
        for (int b = 0; b < 6; b++) share[c][i] += q[c][i][a] * j[c][b][a] * y[b];
      }
    }
  }
}

static inline int reference_carries(const ambulo_model *model, int link, int below) {
  while (below > link) below = model->links[below].parent;
  return below == link;
}

/* Whether the joint of a link carries every mass and every contact. */
static inline int reference_carries_all(const ambulo_model *model,
                                        const reference_contacts *contacts, int link) {
  for (int l = 0; l < model->link_count; l++) {
    if (model->links[l].mass > 0 && !reference_carries(model, link, l)) return 0;
  }
  for (int c = 0; c < contacts->count; c++) {
    if (!reference_carries(model, link, contacts->link[c])) return 0;
  }
  return 1;
}

/* The torque of the joint of a link, without contacts: Eq. (10). */
static inline scalar reference_joint_force(const ambulo_model *model, const link_state *states,
                                           int link) {
  static const matrix identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  int parent = model->links[link].parent;
  const matrix *p = parent >= 0 ? &states[parent].a : &identity, *t1 = &states[link].t1;
  scalar tau = 0;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 4; j++) {
      scalar slope = 0;
      for (int k = 0; k < 3; k++) slope += p->e[i][k] * t1->e[k][j];
      tau += slope * (states[link].d[j][i] - model->gravity[i] * states[link].e[j]);
    }
  }
  return tau;
}

/* Takes what joints that carry everything still have off: they have nothing, also in flight. */
static inline void reference_forget(const ambulo_model *model, const reference_contacts *contacts,
                                    const link_state *states, scalar share[][6],
                                    const double *ground, scalar *tau) {
  for (int l = 0; l < model->link_count; l++) {
    int k = ambulo__moved_by(model, l);
    if (k < 0 || !reference_carries_all(model, contacts, l)) continue;
    scalar left = reference_joint_force(model, states, l);
    for (int c = 0; c < contacts->count; c++) {
      const double *p = ground + 4 + 4 * c;
      const scalar at[3] = {p[0], p[1], p[2]};
      reference_wrench w;
      reference_cross(at, share[c], w.moment);
      for (int i = 0; i < 3; i++) {
        w.moment[i] += share[c][3 + i];
        w.force[i] = share[c][i];
      }
      left -= reference_generalized_force(model, states, l, &w);
    }
    tau[k] -= states[l].slope * left;
  }
}

/* Takes (f, m) at p off the torques; f first. */
static inline void reference_take_off(const ambulo_model *model, const link_state *states, int link,
                                      const scalar share[6], const double p[3], scalar *tau) {
  const scalar at[3] = {p[0], p[1], p[2]};
  reference_wrench w;
  reference_cross(at, share, w.moment);
  for (int i = 0; i < 3; i++) {
    w.moment[i] += share[3 + i];
    w.force[i] = share[i];
  }
  reference_subtract(model, states, link, &w, tau);
}

/* The output rows of a plan on contacts (mechanics/plan.h), as ground_reaction_reference. */
static inline ambulo_status contact_reference(const ambulo_model *model,
                                              const reference_contacts *contacts,
                                              const double *ground, const double *q,
                                              const double *qd, const double *qdd, double *rows,
                                              void *scratch) {
  int d = model->coordinate_count, points = 3 * model->point_count;
  ambulo_status status = ambulo__lagrangian(1, model, q, qd, qdd,
                                            &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                              .tau = rows,
                                                              .wrench = rows + 2 * d,
                                                              .points = rows + 2 * (d + 6)},
                                            scratch);
  if (status != AMBULO_OK) return status;
  const link_state *states = scratch;
  scalar *out = (scalar *)(void *)rows, *contact = out + d + 6 + points;
  scalar center[3], share[reference_most_contacts][6], told[3 + 4 * reference_most_contacts];
  reference_wrench root;
  reference_center_of_mass(model, states, center);
  for (int i = 0; i < 3; i++) {
    root.moment[i] = out[d + i];
    root.force[i] = out[d + 3 + i];
    contact[6 * contacts->count + i] = center[i];
  }
  for (int i = 0; i < 3 + 4 * contacts->count; i++) told[i] = ground[i];
  reference_share(contacts, told, &root, center, share);
  for (int c = 0; c < contacts->count; c++) {
    for (int i = 0; i < 6; i++) contact[6 * c + i] = share[c][i];
    reference_take_off(model, states, contacts->link[c], share[c], ground + 4 + 4 * c, out);
  }
  if (model->coupled_count > 0) reference_forget(model, contacts, states, share, ground, out);
  for (int l = 0; l < model->link_count && model->coupled_count == 0; l++) {
    int k = model->links[l].coordinate;
    if (k >= 0 && reference_carries_all(model, contacts, l)) out[k] = 0;
  }
  return AMBULO_OK;
}

#endif
