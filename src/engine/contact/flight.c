/* contact/flight.c - a body that nothing touches ("flight").
 *
 * Without contacts nothing takes the root wrench, the force F and the moment M about the world
 * origin that inverse dynamics asks of the surroundings, so that there is none. With the centre of
 * mass r, W = m g, e the flight tolerance, axes f, l, n:
 *
 *     -w <= a . F / W <= w,                     a = f, l, n      body weights
 *     -w h <= a . (M - r x F) / W <= w h,       a = f, l, n      m, h = 1 m for 1.75 m
 *
 * F / m is the acceleration of the centre of mass less that of gravity, M - r x F the rate of the
 * angular momentum about it: momentum follows gravity, angular momentum is kept.
 *
 * A flight is no spline. Accelerations are splines of degree p - 2. Those of a flight that lasts
 * for k intervals have k + p - 2 coefficients, so that they can hold six equations at so many times
 * and at no more. The nodes nearest to such times, the Greville abscissae of that spline on the
 * flight alone, are its nodes of collocation; the first and the last node of the flight are among
 * them. Hence
 *
 *     w = e / 50   at a node of collocation
 *     w = e / 2     at any other
 *
 * F and M - r x F then swing about zero between the nodes of collocation, so that what they do to
 * the momenta cancels: with bounds as wide at all nodes they lean to the side that pays, and
 * angular momentum changes by e h W times the whole flight. e / 2 along each axis keeps the force
 * as a whole, between the nodes too, below e. The first bound is not zero because equations are
 * kept exactly throughout a solve (method/equalities.c), which these are too curved for: runs take
 * three times the iterations, or end nowhere.
 *
 * An event node between flight and contact belongs to both. The force is zero there, and so is what
 * each contact carries: its own rows would only say the same again, and are left out.
 *
 * Planar models have the rows along f and n, and that about l.
 */
#include "contact/row_families.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/rows.h"
#include "model/neutral_pose.h"

#include <math.h>

static const double share_collocated = 0.02, share_between = 0.5; /* w / e */

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

/* ------------------------------------------------------------- collocation */

/* a spline on [from, to]: with these breakpoints inside and knots at both ends degree + 1 times */
typedef struct piece {
  double from, to;
  const double *inside;
  int inside_count, degree;
} piece;

static piece piece_between(const ambulo__basis *basis, double from, double to) {
  const double *breaks = ambulo__basis_breakpoints(basis);
  int count = ambulo__basis_intervals(basis) + 1, first = 0, end;
  while (first < count && breaks[first] <= from + AMBULO__INSTANT) first++;
  end = first;
  while (end < count && breaks[end] < to - AMBULO__INSTANT) end++;
  return (piece){from, to, breaks + first, end - first, ambulo__basis_degree(basis) - 2};
}

static double knot(const piece *p, int i) {
  if (i <= p->degree) return p->from;
  int inside = i - p->degree - 1;
  return inside < p->inside_count ? p->inside[inside] : p->to;
}

/* the mean of the knots that coefficient j stands between */
static double greville(const piece *p, int j) {
  double sum = 0.0;
  for (int k = 1; k <= p->degree; k++) sum += knot(p, j + k);
  return sum / p->degree;
}

int ambulo__is_collocated(const ambulo__gait_context *context, int first, int last, int node) {
  if (ambulo__basis_get_kind(context->basis) != AMBULO__BSPLINE) return 1;
  const double *t = context->times;
  piece p = piece_between(context->basis, t[first], t[last]);
  double from = node == first ? -INFINITY : 0.5 * (t[node - 1] + t[node]);
  double to = node == last ? INFINITY : 0.5 * (t[node] + t[node + 1]);
  for (int j = 0; j < p.inside_count + 1 + p.degree; j++) {
    double time = greville(&p, j);
    if (time > from && time <= to) return 1;
  }
  return 0;
}

double ambulo__flight_room(const ambulo_problem_definition *d, const ambulo__row_table *table,
                           const ambulo__table_row *row) {
  const ambulo__curved *spin = ambulo__row_curved_of(table, row);
  double wide = share_between * d->ground_reaction.flight_tolerance;
  return spin ? wide * ambulo__flight_arm(d->model) - spin->of.spin.bound : wide - row->constant;
}

static double share_at(const ambulo__gait_context *context, int node) {
  int first = node, last = node;
  while (first > 0 && ambulo__in_flight(context, first - 1)) first--;
  while (last + 1 < context->nodes && ambulo__in_flight(context, last + 1)) last++;
  return ambulo__is_collocated(context, first, last, node) ? share_collocated : share_between;
}

/* ------------------------------------------------------------------- rows */

typedef struct flight {
  const ambulo__gait_context *context;
  int node;
  double weight, tolerance; /* W, N; w */
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
    w.tolerance = tolerance * share_at(context, w.node);
    force_rows(&w, m->forward, "pushed backward", "pushed forward");
    if (spatial) force_rows(&w, m->left, "pushed to the right", "pushed to the left");
    force_rows(&w, m->up, "pushed down", "pushed up");
    if (spatial) spin_rows(&w, m->forward, "tipped to the left", "tipped to the right");
    spin_rows(&w, m->left, "tipped backward", "tipped forward");
    if (spatial) spin_rows(&w, m->up, "turned to the right", "turned to the left");
  }
}
