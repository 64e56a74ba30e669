/* contact/holds.h - what hands hold, compiled: forces at the hands, what they add to torques and to
 * the root wrench, and the derivatives (ambulo/hold.h has the law).
 *
 * f_k and the moment m_k are what hand k exerts, at its point p_k, with J_ki = dp_k/dq_i and the
 * axes z_ki of joints that turn (hand_motion.h); of an inverse dynamics they add
 *
 *     tau_i += sum_k J_ki . f_k + z_ki . m_k          (joints that carry the whole body on contacts
 *     (M, F) += sum_k (p_k x f_k + m_k, f_k)           have tau = 0 and keep it)
 *
 * For weights y on tau and (M', F') on the root wrench, the hands have the virtual motions
 *
 *     u_k = sum_i y_i J_ki + F' + M' x p_k,    t_k = sum_i y_i z_ki + M'
 *
 * and L = sum_k u_k . f_k + t_k . m_k. With U = (u_1 + u_2) / 2, l = u_2 - u_1, T = t_1 + t_2, s =
 * d . d, e = a_2 - a_1, G = w m (a_c - g), mu = o x G, P_d = 1 - d d^T / s, and m_1 = m_2,
 *
 *     L = U . F + w I l . P_d e / s + mu . (d x l) / s + (T . d)(d . mu) / (2 s)
 *
 * so that the adjoints of the middle's acceleration, of e and of d are
 *
 *     b   = (d x l) / s + d (T . d) / (2 s)                      of mu
 *     a_c'= w m (U + b x o)
 *     e'  = w I P_d l / s
 *     d'  = w I (-2 d (l . e) - l (d . e) - e (l . d) + 4 d (l . d)(d . e) / s) / s^2
 *           + l x mu / s - 2 d (mu . (d x l)) / s^2
 *           + (T (d . mu) + mu (T . d)) / (2 s) - d (T . d)(d . mu) / s^2
 *
 * a_k' = a_c' / 2 -+ e' and p_k' = -+ d' + f_k x M'. What is left is that J and z turn: dJ_i/dq_j =
 * z_i x J_j for i above j or j itself, if i turns, and z_j x J_i for i below; dz_i/dq_j = z_j x z_i
 * below. With sums from above to j, O_j = sum y_i z_i, and from below, U_j = sum y_i J_i, Z_j = sum
 * y_i z_i,
 *
 *     q_j'   += a_k' . Jdd_j + p_k' . J_j + f_k . (O_j x J_j + z_j x U_j) + m_k . (z_j x Z_j)
 *     qd_j'  += 2 a_k' . Jd_j,     qdd_j' += a_k' . J_j
 *
 * One hand: F = w (m (a - g) + P) at it, a' = w m u. A row of the Jacobian is a sweep with one
 * weight of 1.
 */
#ifndef AMBULO_CONTACT_HOLDS_H
#define AMBULO_CONTACT_HOLDS_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/lanes.h"
#include "mechanics/plan.h"

typedef struct ambulo__holds ambulo__holds;

/* Of a checked definition, whose holds must outlive them, and the plan of its body. *holds is NULL
 * where it has none. E_MEMORY. */
ambulo_status ambulo__holds_create(const ambulo_problem_definition *definition,
                                   const ambulo__plan *plan, const ambulo_allocator *allocator,
                                   ambulo__holds **holds);
void ambulo__holds_free(ambulo__holds *holds); /* accepts NULL */

/* Doubles that are kept of a node; 0 of NULL. */
size_t ambulo__holds_entries(const ambulo__holds *holds);
/* What all that follows is made of, kept[entries]. q, qd, qdd, told: [...][lanes] from the node's
 * lane on. */
void ambulo__holds_keep(const ambulo__holds *holds, const double *q, const double *qd,
                        const double *qdd, const double *told, double *kept);

/* Adds them to tau [d][lanes] from the node's lane on, and to the root wrench (M, F), whose entries
 * are `stride` apart. */
void ambulo__holds_add_torques(const ambulo__holds *holds, const double *kept, double *tau);
void ambulo__holds_add_wrench(const ambulo__holds *holds, const double *kept, double *wrench,
                              int stride);

/* Weights of a sweep, and where the gradient is added to. */
typedef struct ambulo__hold_adjoints {
  const double *tau;    /* [d][lanes] from the node's lane on, or NULL: */
  int coordinate;       /* then 1 on tau of this one alone; -1: of none */
  double wrench[6];     /* M', F' */
  double *q, *qd, *qdd; /* [d], entries `stride` apart */
  int stride;
} ambulo__hold_adjoints;
void ambulo__holds_reverse(const ambulo__holds *holds, const double *kept,
                           const ambulo__hold_adjoints *adjoints);

/* Of one hold at a node: force and moment that each hand exerts (world axes, moment about the
 * hand's point), power of both on what is held, W, and the window. */
typedef struct ambulo__hold_state {
  double force[2][3], moment[2][3], power, window;
} ambulo__hold_state;
ambulo__hold_state ambulo__hold_at(const ambulo__holds *holds, int hold, const double *kept);

/* What is wrong with each of them. E_PROBLEM. */
ambulo_status ambulo__holds_check(const ambulo_problem_definition *definition,
                                  ambulo_diagnostics *diagnostics);
/* With mirrored ends each is its own mirror image, and held all along. E_PROBLEM. */
ambulo_status ambulo__holds_mirror_check(const ambulo_problem_definition *definition,
                                         ambulo_diagnostics *diagnostics);

#endif
