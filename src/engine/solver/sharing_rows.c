/* solver/sharing_rows.c - the numbers in the rows of contacts that share the load
 * (contact/sharing.c).
 *
 * With phi = n.f / W of the contact's normal force and the end b of its patch, x its centre, both
 * ahead of the heel's foothold:
 *
 *     loaded too fast   c = most - phi           dc/drate = most / rate
 *                                                dc/d ln T = dmost / d ln T, times as shares of T
 *     friction          c = mu phi -+ e.f / W    dc/dmu = phi
 *     pressure          c = -+ l.m / W -+ (b - x) phi
 *                                                dc/db = -dc/dx = -phi behind, phi ahead; no b at a
 *                                                joint of the toes; dc/dside = phi
 *     under an arc      c = a + (e0 phi -+ phi d)
 *     free moment       c = bound -+ n.m / W     dc/dbound = 1
 *
 * and each by its surface (surface.c), by its times contact_times.c.
 */
#include "solver/contact_pull.h"
#include "base/arithmetic.h"
#include "solver/sensitivity_surface.h"

#include <string.h>

typedef struct contact_row {
  ambulo__timed_contact timed;
  ambulo_contact_mode mode;
  double pull, phi;
} contact_row;

static void add_normal(const contact_row *c, const ambulo__stationary *s, ambulo__load_pull *by,
                       ambulo__partials *partials) {
  const ambulo_problem_definition *d = &s->problem->definition;
  const ambulo__contact_load *load = &c->timed.load;
  double rate = d->ground_reaction.loading_rate;
  if (rate > 0.0) partials->reaction.loading_rate += c->pull * load->most / rate;
  partials->duration += c->pull * load->most_by_time / d->duration;
  by->most += c->pull;
}

static void add_pressure(const contact_row *c, const char *detail, ambulo__load_pull *by,
                         ambulo__partials *partials) {
  ambulo_ground_reaction *r = &partials->reaction;
  int front = !strcmp(detail, "front");
  double by_end = c->pull * (front ? c->phi : -c->phi);
  if (!front && strcmp(detail, "back") != 0) {
    r->pressure_width += c->pull * c->phi;
    return;
  }
  by->center -= by_end;
  if (c->timed.load.cut[front]) return;
  if (c->mode == AMBULO_CONTACT_FLAT) {
    r->flat_pressure[front] += by_end;
  } else if (c->mode == AMBULO_CONTACT_TOE) {
    r->toe_pressure[front] += by_end;
  } else {
    r->heel_pressure[front] += by_end;
    if (front) r->heel_roll += by_end * c->timed.load.rolled;
    if (front) by->front += by_end;
  }
}

int ambulo__sharing_channel(const ambulo_problem *problem, const ambulo__table_row *row) {
  const ambulo__arc *arc = ambulo__row_arc_of(&problem->table, row);
  return arc ? arc->force : problem->table.terms[row->first_term].channel;
}

/* what the row says beside its surface; an arc goes with that altogether */
static void add_numbers(const contact_row *c, const ambulo__stationary *s,
                        const ambulo__table_row *row, ambulo__partials *partials) {
  ambulo__load_pull by = {0.0, 0.0, 0.0, 0.0};
  switch ((ambulo__row_kind)row->kind) {
  case AMBULO__KIND_NORMAL_FORCE:
    if (strcmp(row->detail, "pulls") != 0) add_normal(c, s, &by, partials);
    break;
  case AMBULO__KIND_FRICTION:
    partials->reaction.friction += c->pull * c->phi;
    break;
  case AMBULO__KIND_PRESSURE:
    add_pressure(c, row->detail, &by, partials);
    break;
  case AMBULO__KIND_FREE_MOMENT:
    partials->reaction.free_moment += c->pull;
    break;
  default:
    break;
  }
  ambulo__partials_of_load(s, &c->timed, &by, partials);
}

/* (S.5b) +-phi, most / rate, 1 */
void ambulo__partials_of_sharing(const ambulo__stationary *s, const ambulo__foot_outline *outlines,
                                 const ambulo__table_row *row, double pull, double weight,
                                 ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  const ambulo__channels *channels = &p->channels;
  const ambulo__slots slots = ambulo__slots_of(&p->definition);
  int first = ambulo__channel_foot_force(channels, 0, 0);
  int slot = (ambulo__sharing_channel(p, row) - first) / AMBULO__SLOT_CHANNELS;
  int own = ambulo__stationary_contacts(s, row->node, row->before)[slots.effector[slot]];
  const ambulo_contact *contact = &p->definition.contacts[own];
  contact_row c = {.mode = contact->mode, .pull = pull};
  c.timed = (ambulo__timed_contact){
      .node = row->node, .contact = own, .part = (ambulo__slot_part)slots.part[slot]};
  c.timed.load =
      ambulo__contact_load_at(&p->definition, outlines, &slots, slot, contact, row->time);
  const ambulo__contact_frame *frame = &c.timed.load.frame;
  int force = ambulo__channel_foot_force(channels, slot, 0);
  c.phi = ambulo__stationary_along(s, row->node, force, frame->up) / weight;
  ambulo__surface_pull by = ambulo__surface_pull_of(s, row, pull, frame->origin);
  partials->ground_height += ambulo__dot(by.origin, p->model->up);
  ambulo__surface_of_contact(s, own, &by, partials);
  if (ambulo__row_arc_of(&p->table, row))
    partials->reaction.arc_pressure += pull * c.phi;
  else
    add_numbers(&c, s, row, partials);
}
