/* solver/contact_told.c - what the law that shares the load among contacts is told at a node:
 * their centres and weights, moment arm and slant.
 *
 * A contact's centre p goes with its surface: moved with the origin o, turned about it by theta,
 * p. = theta x (p - o), and ahead along the surface's forward axis by times (contact_times.c).
 */
#include "solver/contact_pull.h"
#include "base/arithmetic.h"
#include "solver/node_forces.h"
#include "solver/sensitivity_surface.h"

#include "contact/loading.h"

/* by the centre of a slot's contact, and by its weight */
static void add_contact(ambulo__node_forces *f, int slot, const ambulo__timed_contact *timed,
                        ambulo__partials *partials) {
  const ambulo__contact_load *load = &timed->load;
  ambulo__surface_pull surface = {{0.0}, {0.0}};
  ambulo__load_pull by = {0.0, 0.0, 0.0, 0.0};
  double arm[3];
  for (int i = 0; i < 3; i++) {
    ambulo__node_forces_clear(f);
    f->place[slot][i] = 1.0;
    surface.origin[i] = ambulo__node_forces_pull(f);
    arm[i] = load->center[i] - load->frame.origin[i];
  }
  ambulo__add_cross(arm, surface.origin, 1.0, surface.turn);
  ambulo__node_forces_clear(f);
  f->load[slot] = 1.0;
  by.weight = ambulo__node_forces_pull(f);
  by.center = ambulo__dot(surface.origin, load->frame.forward);
  partials->ground_height += ambulo__dot(surface.origin, f->s->problem->model->up);
  ambulo__surface_of_contact(f->s, timed->contact, &surface, partials);
  ambulo__partials_of_load(f->s, timed, &by, partials);
}

/* (S.8c) by places, weights, moment arm and slant */
void ambulo__partials_of_told(ambulo__node_forces *f, ambulo__partials *partials) {
  const ambulo_problem *p = f->s->problem;
  const ambulo_problem_definition *d = &p->definition;
  const ambulo__slots slots = ambulo__slots_of(&p->definition);
  ambulo__foot_outline outlines[AMBULO__MOST_SLOTS];
  for (int foot = 0; foot < p->model->foot_count; foot++)
    outlines[foot] = ambulo__foot_outline_of(p->model, foot);
  for (int slot = 0; slot < slots.count; slot++) {
    const ambulo_contact *contact = ambulo__contact_of(d, slots.effector[slot], p->times[f->node]);
    ambulo__timed_contact timed = {.node = f->node, .part = (ambulo__slot_part)slots.part[slot]};
    if (!contact) continue;
    timed.contact = (int)(contact - d->contacts);
    timed.load = ambulo__contact_load_at(d, outlines, &slots, slot, contact, p->times[f->node]);
    if (timed.load.loaded) add_contact(f, slot, &timed, partials);
  }
  ambulo__node_forces_clear(f);
  f->moment_arm = 1.0;
  partials->reaction.moment_arm += ambulo__node_forces_pull(f);
  ambulo__node_forces_clear(f);
  f->slant = 1.0;
  partials->reaction.slant += ambulo__node_forces_pull(f);
}
