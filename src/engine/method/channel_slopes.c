/* method/channel_slopes.c - see channel_slopes.h. */
#include "method/channel_slopes.h"

#include <string.h>

/* the place of a channel among those that are kept, torques and then forces on contacts; -1: none
 */
static int slot_of(const ambulo__channels *c, int channel) {
  int torque = channel - ambulo__channel_tau(c, 0);
  int force = channel - ambulo__channel_foot_force(c, 0, 0);
  if (torque >= 0 && torque < c->coordinates) return torque;
  if (force < 0 || force >= AMBULO__SLOT_CHANNELS * c->slots || force % AMBULO__SLOT_CHANNELS >= 3)
    return -1;
  return c->coordinates + force / AMBULO__SLOT_CHANNELS * 3 + force % AMBULO__SLOT_CHANNELS;
}

ambulo_status ambulo__channel_slopes_create(const ambulo_problem *p, ambulo__pool *pool,
                                            ambulo__channel_slopes *s) {
  s->problem = p;
  s->slots = p->coordinates + 3 * p->channels.slots;
  s->entries = 3 * p->coordinates;
  size_t slots = 2 * (size_t)s->slots;
  s->kept = ambulo__pool_ints(pool, slots);
  s->value = ambulo__pool_doubles(pool, slots * (size_t)s->entries);
  s->other = ambulo__pool_doubles(pool, (size_t)s->entries);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__channel_slopes_clear(ambulo__channel_slopes *s) {
  memset(s->kept, 0, 2 * (size_t)s->slots * sizeof *s->kept);
}

const double *ambulo__channel_slopes_of(ambulo__channel_slopes *s,
                                        const ambulo_workspace *workspace, int node, int channel) {
  int slot = slot_of(&s->problem->channels, channel);
  int output = channel - ambulo__channel_outputs(&s->problem->channels);
  double *to = s->other;
  if (slot >= 0) {
    int at = (node & 1) * s->slots + slot;
    to = s->value + (size_t)at * (size_t)s->entries;
    if (s->kept[at] == node + 1) return to;
    s->kept[at] = node + 1;
  }
  if (output >= 0) {
    ambulo__output_gradient(workspace, node, output, to);
  } else {
    memset(to, 0, (size_t)s->entries * sizeof *to);
    to[channel] = 1.0;
  }
  return to;
}
