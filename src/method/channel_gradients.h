/* method/channel_gradients.h - gradients of channels at a node and the next, each formed once.
 *
 * Terms of the objective look at the same torques and forces: a torque counts as a share of the
 * strength, in the power and in the rate on either side of the node. Nodes are taken in turn; what
 * was asked for of the next one is still there when it has become the node.
 */
#ifndef AMBULO_METHOD_CHANNEL_GRADIENTS_H
#define AMBULO_METHOD_CHANNEL_GRADIENTS_H

#include "linear/pool.h"
#include "nlp/nlp.h"

typedef struct ambulo__channel_gradients {
  const ambulo_problem *problem;
  int slots, stride;
  int *kept;     /* [2][slots]: the node, plus one, whose gradient stands there; 0: none */
  double *value; /* [2][slots][stride] */
  double *other; /* [stride]: of channels that are not kept */
} ambulo__channel_gradients;

/* widest: unknowns of a node. E_MEMORY. */
ambulo_status ambulo__channel_gradients_create(const ambulo_problem *problem, int widest,
                                               ambulo__pool *pool, ambulo__channel_gradients *g);
/* Forgets all: another point. */
void ambulo__channel_gradients_clear(ambulo__channel_gradients *g);
/* By the unknowns of the node, as ambulo__channel_local_gradient; until the next call, or of
 * torques and forces on contacts until the node after the next is asked for. */
const double *ambulo__channel_gradients_of(ambulo__channel_gradients *g,
                                           const ambulo_workspace *workspace, int node,
                                           int channel);

#endif
