/* nlp/states.h - one node as callbacks see it, and the clock. */
#ifndef AMBULO_NLP_STATES_H
#define AMBULO_NLP_STATES_H

#include "nlp/nlp.h"

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

/* Monotonic clock, s. */
double ambulo__seconds_now(void);

#endif
