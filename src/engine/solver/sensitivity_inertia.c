/* solver/sensitivity_inertia.c - what the bodies weigh, where gravity points, and where the
 * ground's forces act: through torques and forces, at a fixed motion.
 *
 * Torques and the root wrench are linear in masses and in gravity g; the law that
 * contacts share the load with keeps that. With a the acceleration of a point at p, c the centre of
 * mass, m the whole mass:
 *
 *     load m_l at p       force per kg a - g at p,  dc/dm_l = (p - c) / m
 *     all masses alike    dy/d ln m = y of torques, wrench, forces and free moments; c stays. Of
 *                         torques without devices and what hands hold, which do not grow with
 *                         the body (devices.c, holds.c)
 *     bodies alone        d/d ln m_b = d/d ln m - m_l d/dm_l, and likewise of m in rows and terms
 *     slope               force -m_b dg/ds on the centre of each body,
 *                         dg/ds = |g| (sin s n - cos s f)
 *
 * Contacts that share the load: contact_told.c.
 *
 * An offset of a term that is the body weight m g is one of that mass too.
 */
#include "solver/node_forces.h"

#include <math.h>

static double pull_of_load(ambulo__node_forces *f, const ambulo__model_load *load) {
  const ambulo_model *model = f->s->problem->model;
  const ambulo__channels *channels = &f->s->problem->channels;
  double place[3], force[3];
  ambulo__pose_point(&f->pose, load->link, load->position, place);
  ambulo__node_forces_acceleration(f, load->link, place, force);
  for (int i = 0; i < 3; i++) force[i] -= model->gravity[i];
  ambulo__node_forces_clear(f);
  ambulo__node_forces_add(f, load->link, place, force);
  int center = ambulo__channel_center(channels, 0);
  for (int i = 0; channels->slots && i < 3; i++) {
    double c = ambulo__stationary_channel(f->s, f->node, center + i);
    f->center[i] = (place[i] - c) / model->mass;
  }
  return ambulo__node_forces_pull(f);
}

static double pull_of_slope(ambulo__node_forces *f, const double turn[3]) {
  const ambulo_model *model = f->s->problem->model;
  ambulo__node_forces_clear(f);
  for (int b = 0; b < model->link_count; b++) {
    const ambulo_link *link = &model->links[b];
    double place[3], force[3];
    if (link->mass == 0.0) continue;
    ambulo__pose_point(&f->pose, b, link->com, place);
    for (int i = 0; i < 3; i++) force[i] = -link->mass * turn[i];
    ambulo__node_forces_add(f, b, place, force);
  }
  return ambulo__node_forces_pull(f);
}

/* sum w y of everything that is as large as the masses are */
static double pull_of_all(const ambulo__node_forces *f) {
  const ambulo__channels *c = &f->s->problem->channels;
  double sum = 0.0;
  int first = ambulo__channel_tau(c, 0), last = ambulo__channel_point(c, 0, 0);
  for (int pass = 0; pass < 2; pass++) {
    for (int y = first; y < last; y++)
      sum += ambulo__stationary_adjoint(f->s, f->node, y) *
             ambulo__stationary_channel(f->s, f->node, y);
    first = ambulo__channel_foot_force(c, 0, 0);
    last = ambulo__channel_center(c, 0);
  }
  return sum;
}

void ambulo__turn_of_gravity(const ambulo_model *model, double turn[3]) {
  const double *g = model->gravity;
  double up = 0.0, forward = 0.0;
  for (int i = 0; i < 3; i++) {
    up -= g[i] * model->up[i];
    forward -= g[i] * model->forward[i];
  }
  for (int i = 0; i < 3; i++) turn[i] = forward * model->up[i] - up * model->forward[i];
}

int ambulo__offset_is_weight(const ambulo_problem *p, const ambulo_term *term, int i) {
  double weight = ambulo__model_weight(p->model);
  if (!term->offset || term->kind == AMBULO_POSTURE) return 0;
  return fabs(fabs(term->offset[i]) - weight) <= 1e-12 * weight;
}

/* offsets that are the body weight: d offset/d ln m */
static double pull_of_offsets(const ambulo_problem *p, const ambulo__partials *partials) {
  double sum = 0.0;
  size_t d = (size_t)p->coordinates;
  for (int t = 0; t < p->definition.term_count; t++) {
    const ambulo_term *term = &p->definition.terms[t];
    for (size_t i = 0; i < d; i++)
      if (ambulo__offset_is_weight(p, term, (int)i))
        sum += partials->offset[(size_t)t * d + i] * term->offset[i];
  }
  return sum;
}

/* (S.9) a - g at p; y; -m dg/ds */
ambulo_status ambulo__partials_of_inertia(const ambulo__stationary *s, ambulo__pool *pool,
                                          ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  ambulo__node_forces f;
  ambulo_status status = ambulo__node_forces_create(s, pool, &f);
  double turn[3], all = partials->of_others, mass = p->model->mass;
  const ambulo_model *m = p->model;
  if (status) return status;
  ambulo__turn_of_gravity(p->model, turn);
  for (int node = 0; node < p->nodes; node++) {
    ambulo__node_forces_at(&f, node);
    all += pull_of_all(&f);
    partials->slope += pull_of_slope(&f, turn);
    for (int i = 0; i < m->load_count; i++) partials->load[i] += pull_of_load(&f, &m->loads[i]);
    if (p->channels.slots) ambulo__partials_of_told(&f, partials);
  }
  ambulo__node_forces_free(&f);
  partials->log_mass += pull_of_offsets(p, partials);
  partials->body = all;
  for (int i = 0; i < m->load_count; i++) partials->body -= m->loads[i].mass * partials->load[i];
  if (mass > 0.0) {
    partials->body += (mass - ambulo__model_load_mass(m)) / mass * partials->log_mass;
    for (int i = 0; i < m->load_count; i++) partials->load[i] += partials->log_mass / mass;
  }
  return AMBULO_OK;
}
