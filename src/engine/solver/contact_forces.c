/* solver/contact_forces.c - the tangent of forces where contacts share the load.
 *
 * The wrench W of a contact about the world origin, from its force f and moment m about its centre
 * p, acts on its link; a dot is the change by a number of the problem (contact_split.h):
 *
 *     W. = (m. + p x f. + p. x f, f.),    T. tau_i. = S_i . (load of i). - sum S_i . W.
 */
#include "solver/contact_split.h"
#include "base/arithmetic.h"
#include "solver/node_forces.h"

#include "contact/contact_load.h"

#include <string.h>

/* what the kernels are told of the node, and what follows from the motion */
static ambulo__contact_state state_at(const ambulo__node_forces *f) {
  const ambulo_problem *p = f->s->problem;
  const ambulo__channels *c = &p->channels;
  int entries = ambulo__plan_ground_entries(p->plan);
  const double *lane = p->ground + ambulo__lane_index(f->node, entries, 0);
  ambulo__contact_state state = {.moment_arm = p->definition.ground_reaction.moment_arm,
                                 .slant = p->definition.ground_reaction.slant};
  for (int i = 0; i < 6; i++)
    state.wrench[i] = ambulo__stationary_channel(f->s, f->node, ambulo__channel_moment(c, i));
  for (int i = 0; i < 3; i++)
    state.center[i] = ambulo__stationary_channel(f->s, f->node, ambulo__channel_center(c, i));
  for (int slot = 0; slot < c->slots; slot++) {
    const double *at = lane + (size_t)(3 + 4 * slot) * AMBULO__LANES;
    state.weight[slot] = at[0];
    for (int i = 0; i < 3; i++) state.place[slot][i] = at[(size_t)(1 + i) * AMBULO__LANES];
  }
  return state;
}

/* the torques of the joints that carry the link, by a change of the wrench on it */
static double pull_of_torques(const ambulo__node_forces *f, int link, const double wrench[6]) {
  const ambulo_problem *p = f->s->problem;
  double sum = 0.0;
  for (; link >= 0; link = p->model->links[link].parent) {
    int i = p->model->links[link].coordinate;
    if (i < 0) continue;
    sum -= ambulo__stationary_adjoint(f->s, f->node, ambulo__channel_tau(&p->channels, i)) *
           ambulo__node_forces_joint(f, i, wrench);
  }
  return sum;
}

/* (S.8b) (m. + p x f. + p. x f, f.) */
double ambulo__contact_forces_pull(const ambulo__node_forces *f) {
  const ambulo_problem *p = f->s->problem;
  const ambulo__channels *c = &p->channels;
  const ambulo__slots slots = ambulo__slots_of(&p->definition);
  const ambulo__contact_state state = state_at(f);
  ambulo__contact_state change = {.moment_arm = f->moment_arm, .slant = f->slant};
  double share[AMBULO__MOST_CONTACTS][6], tangent[AMBULO__MOST_CONTACTS][6], sum = 0.0;
  memcpy(change.wrench, f->wrench, sizeof change.wrench);
  memcpy(change.center, f->center, sizeof change.center);
  memcpy(change.place, f->place, sizeof change.place);
  memcpy(change.weight, f->load, sizeof change.weight);
  ambulo__contact_split_tangent(c->slots, &state, &change, share, tangent);
  for (int slot = 0; slot < c->slots; slot++) {
    double wrench[6];
    memcpy(wrench, tangent[slot] + 3, 3 * sizeof *wrench);
    memcpy(wrench + 3, tangent[slot], 3 * sizeof *wrench);
    ambulo__add_cross(state.place[slot], tangent[slot], 1.0, wrench);
    ambulo__add_cross(change.place[slot], share[slot], 1.0, wrench);
    sum += pull_of_torques(f, slots.link[slot], wrench);
    for (int i = 0; i < 6; i++)
      sum += ambulo__stationary_adjoint(f->s, f->node, ambulo__channel_foot_force(c, slot, i)) *
             tangent[slot][i];
  }
  for (int i = 0; i < 3; i++)
    sum += ambulo__stationary_adjoint(f->s, f->node, ambulo__channel_center(c, i)) * f->center[i];
  return sum;
}
