/* problem/muscle_effort.h - the term muscle_effort: torques of the motion, shared among muscles.
 *
 *     J = weight sum_k w_k sum over limbs phi(q_k, qd_k, tau_k, tau'_k)
 *
 * phi is the least cost of muscle/kernel_sharing.h, whose slopes are exact. tau' moves elastic
 * tendons alone. It is a difference over the nodes next to k that are at least 10 ms away on either
 * side (the first or last one at the ends): beside events nodes are 1 ms apart, and differences of
 * neighbours would make the gradient three times as large.
 *
 *     tau'_k = (tau_b - tau_a) / (t_b - t_a),    dJ/dtau_b += weight w_k phi_tau' / (t_b - t_a)
 *
 * Curvature: phi is convex in tau, with second derivatives A^-1 where A is the curvature of the
 * dual. With A = C C', the rows of C^-1 are slopes g of forms whose squares add up to it; u = 0,
 * and phi'' = 2 of a square asks for g / sqrt 2.
 */
#ifndef AMBULO_PROBLEM_MUSCLE_EFFORT_H
#define AMBULO_PROBLEM_MUSCLE_EFFORT_H

#include "muscle/share.h"
#include "problem/term.h"

/* What a workspace keeps for it. */
typedef struct ambulo__muscle_effort {
  ambulo_allocator allocator;
  ambulo__share *share;
  int nodes, forms; /* forms of a node: coordinates of all limbs */
  int *from, *to;   /* [nodes]: of tau' */
  double *rows;     /* [nodes][forms][AMBULO__LIMB_COORDINATES]: of C^-1, at the last evaluation */
} ambulo__muscle_effort;

/* *effort is NULL of a problem without the term. E_MEMORY. */
ambulo_status ambulo__muscle_effort_create(const struct ambulo_problem *problem,
                                           const ambulo_allocator *allocator,
                                           ambulo__muscle_effort **effort);
void ambulo__muscle_effort_free(ambulo__muscle_effort *effort); /* accepts NULL */

/* Members of the table of kinds (term.h). */
double ambulo__muscle_value(struct ambulo_workspace *workspace, const ambulo_term *term,
                            double factor, double *slopes);
const char *ambulo__muscle_lacks(const ambulo_problem_definition *definition);
int ambulo__muscle_forms(const ambulo_term *term, const ambulo__term_context *context);
void ambulo__muscle_form(const ambulo_term *term, const ambulo__term_context *context, int node,
                         int j, ambulo__form *form);

#endif
