/* problem/callbacks.h - one node as terms and callbacks see it; objective terms of the caller. */
#ifndef AMBULO_PROBLEM_CALLBACKS_H
#define AMBULO_PROBLEM_CALLBACKS_H

#include "base/machine.h"
#include "problem/nlp.h"

/* Channels of one node, gathered from the lanes: state[channels]. */
void ambulo__node_state_fill(const ambulo_workspace *workspace, int node, double *state);
/* The public view of gathered channels, and of a slope vector of the same shape. */
ambulo_node_state ambulo__node_state_view(const ambulo_problem *problem, int node,
                                          const double *state);
ambulo_node_gradient ambulo__node_gradient_view(const ambulo_problem *problem, double *slope);

/* Slopes [channels] of a user row at the evaluated point. */
static inline const double *ambulo__user_slope(const ambulo_workspace *workspace, int row) {
  return workspace->user_gradient +
         (size_t)workspace->user_slot[row] * (size_t)workspace->channel_count;
}

/* What composite terms read their channels from. */
static inline ambulo__term_context ambulo__term_context_of(const ambulo_workspace *workspace) {
  const ambulo_problem *p = workspace->problem;
  ambulo__term_context context = {p->model,           p->channels, workspace->channel_count,
                                  workspace->channel, p->nodes,    p->times,
                                  p->active,          p->before,   p->definition.ground_height,
                                  workspace->muscles, &p->slots,   p->ground};
  return context;
}

/* Quadrature weight of a term at a node, s: trapezoidal; a rate is constant over the
 * interval that begins at the node. */
static inline double ambulo__term_quadrature(const ambulo_problem *p, const ambulo_term *term,
                                             int node) {
  if (ambulo__term_is_rate(term))
    return node + 1 < p->nodes ? p->times[node + 1] - p->times[node] : 0.0;
  return p->quadrature[node];
}

/* ------------------------------------------------------------ terms of the caller */

/* Value, slope and curvature at a node. * With y the channels of a node [C] (contact/rows.h)
 * and r(y) the caller's function,
 *
 *     AMBULO_USER_TERM     phi = r                 AMBULO_USER_SQUARE   phi = r^2
 */

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
