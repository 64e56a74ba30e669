/* sensitivity/sharing_rows.c - the numbers in the rows of contacts that share the load
 * (gait/sharing.c).
 *
 * With phi = n.f / W of the contact's normal force and the end b of its patch:
 *
 *     loaded too fast   c = most - phi           dc/drate = most / rate
 *                                                dc/d ln T = dmost / d ln T, times as shares of T
 *     friction          c = mu phi -+ e.f / W    dc/dmu = phi
 *     pressure          c = -+ l.m / W -+ b phi  dc/db = -phi behind, phi ahead, 0 at a joint
 *                                                of the toes; dc/dside = phi
 *     under an arc      c = a + (e0 phi -+ phi d), phi d = (-l.m + n.f (p - C)_f) / W:
 *                                                dc/dplace_f = -+ phi
 *     free moment       c = bound -+ n.m / W     dc/dbound = 1
 */
#include "sensitivity/partials.h"

#include "gait/contact_load.h"

#include <string.h>

typedef struct contact_row {
  const ambulo_contact *contact;
  ambulo__contact_load load;
  double pull, phi;
} contact_row;

static void add_normal(const contact_row *c, const ambulo__stationary *s,
                       ambulo__partials *partials) {
  const ambulo_problem_definition *d = &s->problem->definition;
  double rate = d->ground_reaction.loading_rate;
  if (rate > 0.0) partials->reaction.loading_rate += c->pull * c->load.most / rate;
  partials->duration += c->pull * c->load.most_by_time / d->duration;
}

static void add_pressure(const contact_row *c, const char *detail, ambulo__partials *partials) {
  ambulo_ground_reaction *r = &partials->reaction;
  int front = !strcmp(detail, "front");
  double by_end = c->pull * (front ? c->phi : -c->phi);
  if (!front && strcmp(detail, "back") != 0) {
    r->pressure_width += c->pull * c->phi;
    return;
  }
  if (c->load.cut[front]) return;
  if (c->contact->mode == AMBULO_CONTACT_FLAT) {
    r->flat_pressure[front] += by_end;
  } else if (c->contact->mode == AMBULO_CONTACT_TOE) {
    r->toe_pressure[front] += by_end;
  } else {
    r->heel_pressure[front] += by_end;
    if (front) r->heel_roll += by_end * c->load.rolled;
  }
}

int ambulo__sharing_channel(const ambulo_problem *problem, const ambulo__table_row *row) {
  const ambulo__arc *arc = ambulo__row_arc_of(&problem->table, row);
  return arc ? arc->force : problem->table.terms[row->first_term].channel;
}

/* (S.5b) +-phi, most / rate, 1 */
void ambulo__partials_of_sharing(const ambulo__stationary *s, const ambulo__foot_outline *outlines,
                                 const ambulo__table_row *row, double pull, double weight,
                                 ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  const ambulo__channels *channels = &p->channels;
  const ambulo__slots slots = ambulo__slots_of(&p->definition);
  int first = ambulo__channel_foot_force(channels, 0, 0);
  int slot = (ambulo__sharing_channel(p, row) - first) / channels->slot_rows;
  int own = ambulo__stationary_contacts(s, row->node, row->before)[slots.effector[slot]];
  contact_row c = {.contact = &p->definition.contacts[own], .pull = pull};
  c.load = ambulo__contact_load_at(&p->definition, outlines, &slots, slot, c.contact, row->time);
  int force = ambulo__channel_foot_force(channels, slot, 0);
  c.phi = ambulo__stationary_along(s, row->node, force, c.load.frame.up) / weight;
  const ambulo__arc *arc = ambulo__row_arc_of(&p->table, row);
  if (arc) {
    for (int i = 0; i < 2; i++) {
      const double *axis = i ? p->model->left : p->model->forward;
      double along = 0.0;
      for (int k = 0; k < 3; k++) along += arc->forward[k] * axis[k];
      partials->place[2 * own + i] += pull * arc->sign * along * c.phi;
    }
    return;
  }
  switch ((ambulo__row_kind)row->kind) {
  case AMBULO__KIND_NORMAL_FORCE:
    if (strcmp(row->detail, "pulls") != 0) add_normal(&c, s, partials);
    break;
  case AMBULO__KIND_FRICTION:
    partials->reaction.friction += pull * c.phi;
    break;
  case AMBULO__KIND_PRESSURE:
    add_pressure(&c, row->detail, partials);
    break;
  case AMBULO__KIND_FREE_MOMENT:
    partials->reaction.free_moment += pull;
    break;
  default:
    break;
  }
}
