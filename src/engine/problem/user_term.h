/* problem/user_term.h - objective terms of the caller's own: value, slope and curvature at a node.
 *
 * With y the channels of a node [C] (contact/channels.h) and r(y) the caller's function,
 *
 *     AMBULO_USER_TERM     phi = r                 AMBULO_USER_SQUARE   phi = r^2
 */
#ifndef AMBULO_PROBLEM_USER_TERM_H
#define AMBULO_PROBLEM_USER_TERM_H

#include "problem/nlp.h"

static inline int ambulo__is_user_term(const ambulo_term *term) {
  return ambulo__term_has(term, AMBULO__TERM_CALLBACK);
}

/* phi at a node of the point held. */
double ambulo__user_term_value(const ambulo_workspace *workspace, const ambulo_term *term,
                               int node);
/* dphi/dy [C]. Uses workspace->node_state. */
void ambulo__user_term_slope(const ambulo_workspace *workspace, const ambulo_term *term, int node,
                             double *slope);

/* Curvature of phi as a sum of squares of linear forms: sqrt(2) dr/dy [C] of a square, *count = -1;
 * otherwise the diagonal [C] of the second derivatives, estimated and at least 0, *count = C.
 * `scratch` [4 C]. */
void ambulo__user_term_curvature(const ambulo_workspace *workspace, const ambulo_term *term,
                                 int node, double *scratch, double *curvature, int *count);

#endif
