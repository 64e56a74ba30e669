/* solver/event_times.c - an event of the contacts a little later, on a grid on events.
 *
 * Nodes and knots go along (event_rates.h), control points stay: with a dot for d/de,
 *
 *     q_k. = qd_k t_k. + sum_c (dB_c(t_k) / dknots . knots.) P_c,     qd_k., qdd_k. likewise
 *     dL/de = sum_k (L_q . q_k. + L_qd . qd_k. + L_qdd . qdd_k.)
 *           + sum_k dL/dt_k t_k. + sum over contacts that begin or end there of dL/dfrom, dL/dto
 *           - sum over matching ends of lambda (c + shift) s_o. / s_o
 *
 * Likewise a time of what hands hold, with dL/dfrom, .. of its window (holds.c).
 *
 * L_q .. are adjoints with the mechanics' reverse sweep in them; dL/dt_k, dL/dfrom, dL/dto what
 * terms.c, place_rows.c, force_rows.c and contact_times.c say of quadrature, heights due in the
 * swing, boxes that roll and shares of the load; s_o = 1 / max_c |D^o B_c(0)| (contact/ends.c).
 */
#include "solver/event_rates.h"
#include "solver/partials.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

typedef struct moving_event {
  const ambulo__stationary *s;
  const ambulo__event_map *map;
  double *node_rate, *knot_rate;
} moving_event;

static double pull_of_node(const moving_event *m, int node) {
  const ambulo_problem *p = m->s->problem;
  ambulo__basis_point by;
  double sum = 0.0;
  ambulo__basis_tangent(p->basis, p->times[node], m->node_rate[node], m->knot_rate, &by);
  for (int order = 0; order <= 2; order++) {
    for (int k = 0; k < by.span; k++) {
      const double *x = m->s->workspace->x + (size_t)(by.first + k) * (size_t)p->coordinates;
      double part = 0.0;
      if (by.weight[order][k] == 0.0) continue;
      for (int i = 0; i < p->coordinates; i++)
        part += ambulo__stationary_adjoint(m->s, node, order * p->coordinates + i) * x[i];
      sum += by.weight[order][k] * part;
    }
  }
  return sum;
}

/* s_o. / s_o */
static double end_scale_rate(const moving_event *m, int order) {
  ambulo__basis_point at, by;
  double largest = 0.0, rate = 0.0;
  ambulo__basis_at(m->s->problem->basis, 0.0, &at);
  ambulo__basis_tangent(m->s->problem->basis, 0.0, 0.0, m->knot_rate, &by);
  for (int k = 0; k < at.span && order > 0; k++) {
    double weight = at.weight[order][k];
    if (fabs(weight) <= largest) continue;
    largest = fabs(weight);
    rate = -by.weight[order][at.first + k - by.first] / weight;
  }
  return rate;
}

static double pull_of_ends(const moving_event *m) {
  const ambulo_problem *p = m->s->problem;
  double rate[3], sum = 0.0;
  for (int order = 0; order < 3; order++) rate[order] = end_scale_rate(m, order);
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    if (row->kind != AMBULO__KIND_PERIODIC && row->kind != AMBULO__KIND_MIRRORED) continue;
    int order = p->table.terms[row->first_term].channel / p->coordinates;
    sum -= m->s->multiplier[r] * rate[order] * (m->s->workspace->row_value[r] - row->constant);
  }
  return sum;
}

/* 1 if a node goes past a knot of a cubic, where the jerk jumps */
static int passes_a_knot(const moving_event *m) {
  const ambulo_problem *p = m->s->problem;
  const double *knot = ambulo__basis_breakpoints(p->basis);
  int last = ambulo__basis_intervals(p->basis);
  if (ambulo__basis_degree(p->basis) > 3) return 0;
  for (int node = 1, k = 1; node + 1 < p->nodes; node++) {
    while (k < last && knot[k] < p->times[node] - AMBULO__INSTANT) k++;
    if (k < last && knot[k] <= p->times[node] + AMBULO__INSTANT &&
        fabs(m->node_rate[node] - m->knot_rate[k]) > 1e-9)
      return 1;
  }
  return 0;
}

/* (S.13) L_q . q. + L_qd . qd. + L_qdd . qdd. + dL/dt t. */
static double pull_of_event(const moving_event *m, int event, const ambulo__partials *partials) {
  const ambulo_problem *p = m->s->problem;
  double sum = pull_of_ends(m);
  if (m->map->unclear[event] || passes_a_knot(m)) return (double)NAN;
  for (int node = 0; node < p->nodes; node++)
    sum += pull_of_node(m, node) + partials->node_time[node] * m->node_rate[node];
  for (int c = 0; c < 2 * p->definition.contact_count; c++)
    if (m->map->of_contact[c] == event) sum += partials->contact_time[c];
  return sum;
}

/* `s` without a solution, only its problem: derivatives that there are become 0 */
/* adds to times of what hands hold what goes along with them; NaN: there is none */
static void add_holds(const moving_event *m, int solved, ambulo__partials *partials) {
  const ambulo_problem *p = m->s->problem;
  static const int numbers[] = {AMBULO__HOLD_FROM, AMBULO__HOLD_TO, AMBULO__HOLD_RAMP};
  static const ambulo__hold_time times[] = {AMBULO__TIME_FROM, AMBULO__TIME_TO, AMBULO__TIME_RAMP};
  size_t knots = (size_t)ambulo__basis_intervals(p->basis) + 1;
  memset(m->knot_rate, 0, knots * sizeof *m->knot_rate);
  for (int at = 0; at < 3 * p->definition.hold_count; at++) {
    double *by = partials->hold + (size_t)(at / 3) * AMBULO__HOLD_NUMBERS + numbers[at % 3];
    if (!ambulo__event_hold_rates(m->map, at / 3, times[at % 3], m->node_rate) || passes_a_knot(m))
      *by = (double)NAN;
    for (int node = 0; solved && node < p->nodes; node++)
      *by += pull_of_node(m, node) + partials->node_time[node] * m->node_rate[node];
  }
}

static ambulo_status fill_events(const ambulo__stationary *s, int solved, ambulo__pool *pool,
                                 ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  ambulo__event_map map;
  if (!p->before || p->definition.node_times) return AMBULO_OK;
  ambulo_status status = ambulo__event_map_create(p, pool, &map);
  if (status) return status;
  size_t knots = (size_t)ambulo__basis_intervals(p->basis) + 1;
  moving_event m = {s, &map, ambulo__pool_doubles(pool, (size_t)p->nodes),
                    ambulo__pool_doubles(pool, knots)};
  partials->event = ambulo__pool_doubles(pool, (size_t)map.contacts.count);
  if (pool->failed) return AMBULO_E_MEMORY;
  partials->event_time = map.contacts.time;
  partials->events = map.contacts.count;
  for (int event = 0; event < partials->events; event++) {
    ambulo__event_node_rates(&map, event, m.node_rate);
    ambulo__event_knot_rates(&map, event, m.knot_rate);
    if (solved)
      partials->event[event] = pull_of_event(&m, event, partials);
    else if (map.unclear[event] || passes_a_knot(&m))
      partials->event[event] = (double)NAN;
  }
  add_holds(&m, solved, partials);
  return AMBULO_OK;
}

ambulo_status ambulo__partials_of_events(const ambulo__stationary *s, ambulo__pool *pool,
                                         ambulo__partials *partials) {
  return fill_events(s, 1, pool, partials);
}

ambulo_status ambulo__partials_name_events(const ambulo_problem *problem, ambulo__pool *pool,
                                           ambulo__partials *partials) {
  const ambulo__stationary s = {.problem = problem};
  return fill_events(&s, 0, pool, partials);
}
