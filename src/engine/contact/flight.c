/* contact/flight.c - a body that nothing touches ("flight").
 *
 * Without contacts nothing takes the root wrench, the force F and the moment M about the world
 * origin that inverse dynamics asks of the surroundings, so that there is none. With the centre of
 * mass r, W = m g, e the flight tolerance, axes f, l, n:
 *
 *     -e <= a . F / W <= e,                     a = f, l, n      body weights
 *     -e h <= a . (M - r x F) / W <= e h,       a = f, l, n      m, h = 1 m for 1.75 m
 *
 * F / m is the acceleration of the centre of mass less that of gravity, M - r x F the rate of the
 * angular momentum about it: momentum follows gravity, angular momentum is kept. Within a
 * tolerance, because a flight is no spline; equations at every node leave a trajectory no room to
 * find it.
 *
 * An event node between flight and contact belongs to both. The force is zero there, and so is what
 * each contact carries: its own rows would only say the same again, and are left out. Beside it,
 * between the nodes, the contact takes what is left at a point as far below the centre of mass as a
 * leg is long; e is a fifth there, which keeps that under 1 mm of pressure.
 *
 * Planar models have the rows along f and n, and that about l.
 */
#include "contact/flight.h"
#include "base/arithmetic.h"
#include "contact/bounded.h"
#include "contact/effector.h"
#include "contact/loading.h"

#include "model/neutral_pose.h"

#include <math.h>

static const double beside_contact = 0.2; /* of e, at an event node */

double ambulo__flight_arm(const ambulo_model *model) {
  return ambulo__model_size(model);
}

int ambulo__flight_span(const ambulo_problem_definition *d, ambulo__span *span) {
  double time = 0.0, last = -1.0;
  while (time < d->duration - AMBULO__INSTANT && time > last) {
    last = time;
    for (int i = 0; i < d->contact_count; i++) {
      const ambulo_contact *c = &d->contacts[i];
      if (c->from <= time + AMBULO__INSTANT) time = fmax(time, c->to);
    }
  }
  if (time >= d->duration - AMBULO__INSTANT) return 0;
  *span = (ambulo__span){time, d->duration, -1, -1};
  for (int i = 0; i < d->contact_count; i++) {
    double from = d->contacts[i].from;
    if (from > time + AMBULO__INSTANT) span->to = fmin(span->to, from);
  }
  return 1;
}

/* ------------------------------------------------------------------- when */

/* feet: those of a node, or just before it */
static int nothing_holds(const ambulo__gait_context *context, const int *feet, int node,
                         int before) {
  const ambulo_problem_definition *d = context->definition;
  int count = context->model->foot_count;
  double time = context->times[node];
  for (int foot = 0; foot < count; foot++)
    if (feet[node * count + foot] >= 0) return 0;
  for (int e = count; e < ambulo__effector_count(context->model); e++)
    if (before ? ambulo__contact_before(d, e, time) : ambulo__contact_of(d, e, time)) return 0;
  return 1;
}

int ambulo__in_flight(const ambulo__gait_context *context, int node) {
  int last = context->nodes - 1, distinct = ambulo__distinct_nodes(context, AMBULO__OF_FORCES);
  if (nothing_holds(context, context->active, node, 0)) return 1;
  if (!context->before) return 0;
  if (node > 0) return nothing_holds(context, context->before, node, 1);
  return distinct == last && nothing_holds(context, context->before, last, 1);
}

double ambulo__flight_share(const ambulo__gait_context *context, int node) {
  int last = context->nodes - 1;
  int inside = nothing_holds(context, context->active, node, 0);
  if (inside && context->before) {
    int before =
        node == 0 && ambulo__distinct_nodes(context, AMBULO__OF_FORCES) == last ? last : node;
    inside = nothing_holds(context, context->before, before, node > 0 || before > 0);
  }
  return inside ? 1.0 : beside_contact;
}

/* ------------------------------------------------------------------- rows */

typedef struct flight {
  const ambulo__gait_context *context;
  int node;
  double weight, tolerance; /* W, N; e */
  ambulo__row_table *table;
} flight;

static const char subject[] = "body";

static void force_rows(const flight *w, const double axis[3], const char *lower,
                       const char *upper) {
  const ambulo__gait_context *context = w->context;
  ambulo__bounded_name name = {AMBULO__KIND_FLIGHT, subject, lower, upper, AMBULO__BODY_WEIGHTS};
  ambulo__linear form = {.count = 0};
  ambulo__linear_add(&form, ambulo__channel_force(&context->channels, 0), axis, 1.0 / w->weight);
  ambulo__bounded_rows(context, w->node, &name, &form, -w->tolerance, w->tolerance, w->table);
}

static void spin_rows(const flight *w, const double axis[3], const char *lower, const char *upper) {
  const ambulo__channels *channels = &w->context->channels;
  ambulo__spin spin = {.bound = w->tolerance * ambulo__flight_arm(w->context->model),
                       .weight = w->weight,
                       .moment = ambulo__channel_moment(channels, 0),
                       .force = ambulo__channel_force(channels, 0),
                       .center = ambulo__channel_center(channels, 0)};
  for (int i = 0; i < 3; i++) spin.axis[i] = axis[i];
  for (int side = 0; side < 2; side++) {
    spin.sign = side ? -1.0 : 1.0;
    ambulo__row_spin(w->table, AMBULO__KIND_FLIGHT, subject, side ? upper : lower, w->node,
                     w->context->times[w->node], &spin);
  }
}

/* (F.1), (F.2) no force, no moment about the centre of mass */
void ambulo__flight_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_model *m = context->model;
  int spatial = ambulo__model_moves_sideways(m);
  int distinct = ambulo__distinct_nodes(context, AMBULO__OF_FORCES);
  double tolerance = context->definition->ground_reaction.flight_tolerance;
  flight w = {.context = context, .weight = ambulo__model_weight(m), .table = table};
  for (w.node = 0; w.node < distinct; w.node++) {
    if (!ambulo__in_flight(context, w.node)) continue;
    w.tolerance = tolerance * ambulo__flight_share(context, w.node);
    force_rows(&w, m->forward, "pushed backward", "pushed forward");
    if (spatial) force_rows(&w, m->left, "pushed to the right", "pushed to the left");
    force_rows(&w, m->up, "pushed down", "pushed up");
    if (spatial) spin_rows(&w, m->forward, "tipped to the left", "tipped to the right");
    spin_rows(&w, m->left, "tipped backward", "tipped forward");
    if (spatial) spin_rows(&w, m->up, "turned to the right", "turned to the left");
  }
}
