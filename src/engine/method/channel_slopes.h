/* method/channel_slopes.h - slopes of channels at a node and the next, each found once.
 *
 * Terms of the objective look at the same torques and forces: a torque counts as a share of the
 * strength, in the power and in the rate on either side of the node. Nodes are taken in turn; what
 * was asked for of the next one is still there when it has become the node.
 */
#ifndef AMBULO_METHOD_CHANNEL_SLOPES_H
#define AMBULO_METHOD_CHANNEL_SLOPES_H

#include "linear/pool.h"
#include "problem/nlp.h"

typedef struct ambulo__channel_slopes {
  const ambulo_problem *problem;
  int slots, entries;
  int *kept;     /* [2][slots]: the node, plus one, whose slopes stand there; 0: none */
  double *value; /* [2][slots][3 d] */
  double *other; /* [3 d]: of channels that are not kept */
} ambulo__channel_slopes;

/* E_MEMORY. */
ambulo_status ambulo__channel_slopes_create(const ambulo_problem *problem, ambulo__pool *pool,
                                            ambulo__channel_slopes *s);
/* Forgets all: another point. */
void ambulo__channel_slopes_clear(ambulo__channel_slopes *s);
/* [3 d] by the node's q, qd and qdd (ambulo__evaluate_jacobian); until the next call, or of torques
 * and forces on contacts until the node after the next is asked for. */
const double *ambulo__channel_slopes_of(ambulo__channel_slopes *s,
                                        const ambulo_workspace *workspace, int node, int channel);

#endif
