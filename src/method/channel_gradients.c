/* method/channel_gradients.c - see channel_gradients.h. */
#include "method/channel_gradients.h"

#include <string.h>

/* the place of a channel among those that are kept, torques and then forces on contacts; -1: none
 */
static int slot_of(const ambulo__channels *c, int channel) {
  int torque = channel - ambulo__channel_tau(c, 0);
  int force = channel - ambulo__channel_foot_force(c, 0, 0);
  if (torque >= 0 && torque < c->coordinates) return torque;
  if (force < 0 || force >= c->slot_rows * c->slots || force % c->slot_rows >= 3) return -1;
  return c->coordinates + force / c->slot_rows * 3 + force % c->slot_rows;
}

ambulo_status ambulo__channel_gradients_create(const ambulo_problem *p, int widest,
                                               ambulo__pool *pool, ambulo__channel_gradients *g) {
  g->problem = p;
  g->slots = p->coordinates + 3 * p->channels.slots;
  g->stride = widest;
  size_t slots = 2 * (size_t)g->slots;
  g->kept = ambulo__pool_ints(pool, slots);
  g->value = ambulo__pool_doubles(pool, slots * (size_t)widest);
  g->other = ambulo__pool_doubles(pool, (size_t)widest);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__channel_gradients_clear(ambulo__channel_gradients *g) {
  memset(g->kept, 0, 2 * (size_t)g->slots * sizeof *g->kept);
}

const double *ambulo__channel_gradients_of(ambulo__channel_gradients *g,
                                           const ambulo_workspace *workspace, int node,
                                           int channel) {
  int slot = slot_of(&g->problem->channels, channel);
  double *to = g->other;
  if (slot >= 0) {
    int at = (node & 1) * g->slots + slot;
    to = g->value + (size_t)at * (size_t)g->stride;
    if (g->kept[at] == node + 1) return to;
    g->kept[at] = node + 1;
  }
  ambulo__channel_local_gradient(workspace, node, channel, to);
  return to;
}
