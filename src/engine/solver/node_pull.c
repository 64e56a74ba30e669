/* solver/node_pull.c - how far the adjoints of a node pull at a tangent: of its torques and
 * its root wrench, and of what is on the ground, by the law that contacts share the load with
 * (contact_forces.c). */
#include "solver/node_forces.h"

/* (S.8) sum w dy/dp of a node */
double ambulo__node_forces_pull(const ambulo__node_forces *f) {
  const ambulo_problem *p = f->s->problem;
  const ambulo__channels *c = &p->channels;
  double sum = 0.0;
  if (c->slots) sum = ambulo__contact_forces_pull(f);
  for (int i = 0; i < p->coordinates; i++)
    sum += ambulo__stationary_adjoint(f->s, f->node, ambulo__channel_tau(c, i)) * f->torque[i];
  for (int i = 0; i < 6; i++)
    sum += ambulo__stationary_adjoint(f->s, f->node, ambulo__channel_moment(c, i)) * f->wrench[i];
  return sum;
}
