/* solver/dense_grid.c - the same motion and the same rows on a finer grid of time nodes; the rules
 * that it is held against.
 *
 * The finer problem has the trajectory's own grid, hence the same unknowns, and no objective. User
 * rows and terms may count nodes; they are not asked off the nodes. Events are moved with their
 * contacts, except those at 0 and T, which are nodes on every grid.
 */
#include "base/arithmetic.h"
#include "solver/dense.h"

#include <math.h>
#include <string.h>

enum { MOST_INTERVALS = 100000 }; /* of a problem */

static double moved(double time, double shift, double duration) {
  if (time <= AMBULO__INSTANT || time >= duration - AMBULO__INSTANT) return time;
  return time + shift;
}

/* copies of the contacts, moved; NULL without memory */
static ambulo_contact *moved_contacts(const ambulo_problem_definition *d, double shift,
                                      const ambulo_allocator *allocator) {
  ambulo_contact *contacts = ambulo__alloc(allocator, (size_t)d->contact_count, sizeof *contacts);
  for (int i = 0; contacts && i < d->contact_count; i++) {
    contacts[i] = d->contacts[i];
    contacts[i].from = moved(contacts[i].from, shift, d->duration);
    contacts[i].to = moved(contacts[i].to, shift, d->duration);
  }
  return contacts;
}

/* of a grid on events: every interval in `samples` equal ones; NULL without memory */
static double *finer_times(const ambulo_problem *p, int samples,
                           const ambulo_allocator *allocator) {
  int last = p->nodes - 1;
  double *times = ambulo__alloc(allocator, (size_t)last * (size_t)samples + 1, sizeof *times);
  for (int k = 0; times && k < last; k++) {
    double length = p->times[k + 1] - p->times[k];
    for (int i = 0; i < samples; i++) times[k * samples + i] = p->times[k] + length * i / samples;
  }
  if (times) times[last * samples] = p->times[last];
  return times;
}

static ambulo_status create_fine(const ambulo_problem *p, double shift,
                                 ambulo_diagnostics *diagnostics, ambulo__dense *dense) {
  ambulo_problem_definition d = p->definition;
  ambulo_contact *contacts = moved_contacts(&d, shift, &dense->allocator);
  double *times = finer_times(p, dense->samples, &dense->allocator);
  if (!contacts || !times) {
    ambulo__free(&dense->allocator, contacts);
    ambulo__free(&dense->allocator, times);
    return AMBULO_E_MEMORY;
  }
  d.contacts = contacts;
  if (d.grid == AMBULO_GRID_EVENTS) d.node_times = times;
  d.spline_intervals = ambulo__basis_intervals(p->basis);
  if (d.discretization == AMBULO_BSPLINE) d.breakpoints = ambulo__basis_breakpoints(p->basis);
  d.knots = AMBULO_GRID_UNIFORM;
  d.intervals = p->definition.intervals * dense->samples;
  d.terms = NULL;
  d.term_count = 0;
  d.user_rows = NULL;
  d.user_row_count = 0;
  ambulo_status status = ambulo__problem_build(&d, &dense->allocator, diagnostics, &dense->fine);
  ambulo__free(&dense->allocator, contacts);
  ambulo__free(&dense->allocator, times);
  return status;
}

/* rows that are not linear */
static void curved_values(const ambulo_problem *p, ambulo__dense *dense) {
  int channels = ambulo__channel_count(&p->channels);
  for (int o = 0; o < p->row_runs.odd_count; o++) {
    int r = p->row_runs.odd[o];
    const ambulo__curved *row = ambulo__row_curved_of(&p->table, &p->table.rows[r]);
    const double *y =
        dense->channel + (row ? ambulo__lane_index(p->table.rows[r].node, channels, 0) : 0);
    if (row) dense->row_value[r] = ambulo__curved_value(row, y, AMBULO__LANES, NULL);
  }
}

/* as problem/evaluate.c does, without what gradients need */
static ambulo_status evaluate(ambulo__dense *dense, const double *x) {
  const ambulo_problem *p = dense->fine;
  const ambulo_allocator *a = &dense->allocator;
  size_t stride = (size_t)ambulo__channel_count(&p->channels) * AMBULO__LANES;
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  double *scratch = ambulo__alloc_aligned(a, ambulo__plan_scratch(p->plan), sizeof *scratch);
  double *room = ambulo__alloc_aligned(a, ambulo__device_scratch_size(p), sizeof *room);
  dense->channel = ambulo__alloc_aligned(a, stride * (size_t)p->blocks, sizeof *dense->channel);
  dense->row_value = ambulo__alloc_aligned(a, (size_t)p->rows, sizeof *dense->row_value);
  ambulo_status status = AMBULO_E_MEMORY;
  if (scratch && room && dense->channel && dense->row_value) {
    double *c = dense->channel;
    ambulo__lane_map_forward(p->map, x, c, c + d8, c + 2 * d8, NULL, stride);
    for (int b = 0; b < p->blocks; b++, c += stride)
      ambulo__mechanics_block(p, p->ground, p->time_factors, b, c, scratch, room);
    ambulo__row_runs_values(&p->row_runs, dense->channel, dense->row_value);
    curved_values(p, dense);
    status = AMBULO_OK;
  }
  ambulo__free_aligned(a, scratch);
  ambulo__free_aligned(a, room);
  return status;
}

int ambulo__dense_samples(const ambulo_problem *p, int samples) {
  int most = MOST_INTERVALS / p->definition.intervals;
  return samples < most ? samples : most;
}

ambulo_status ambulo__dense_open(const ambulo_problem *p, const double *x, int samples,
                                 double shift, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo__dense *dense) {
  memset(dense, 0, sizeof *dense);
  dense->allocator = ambulo__allocator_or_default(allocator);
  dense->problem = p;
  dense->samples = ambulo__dense_samples(p, samples);
  ambulo_status status = create_fine(p, shift, diagnostics, dense);
  if (!status) status = evaluate(dense, x);
  if (status) ambulo__dense_close(dense);
  return status;
}

void ambulo__dense_close(ambulo__dense *dense) {
  const ambulo_allocator *a = &dense->allocator;
  ambulo__free_aligned(a, dense->channel);
  ambulo__free_aligned(a, dense->row_value);
  ambulo_problem_free(dense->fine);
  dense->channel = dense->row_value = NULL;
  dense->fine = NULL;
}

/* ------------------------------------------------------------------ events */

/* How nodes fall beside the times at which rows change (contact/schedule.h).
 *
 * Rows of a contact stand at nodes with from <= t < to. Between the last of them and `to`, and
 * between `from` and the first of them, nothing holds the contact: these two gaps decide how far it
 * is off, more than the number of nodes does. The tip's clearance begins within a swing
 * (contact/clearance.c) and counts as an event too. On a grid on events both gaps are zero.
 */

double ambulo__dense_gap_before(double event, double duration, int intervals) {
  double position = event / duration * intervals, slack = AMBULO__INSTANT / duration * intervals;
  double node = ceil(position - slack) - 1.0;
  return (position - node) * duration / intervals;
}

double ambulo__dense_gap_after(double event, double duration, int intervals) {
  double position = event / duration * intervals, slack = AMBULO__INSTANT / duration * intervals;
  return fmax(0.0, ceil(position - slack) - position) * duration / intervals;
}

int ambulo__dense_near_event(const ambulo__events *events, double time, double duration,
                             int intervals) {
  for (int i = 0; i < events->count; i++) {
    double event = events->time[i];
    double before = ambulo__dense_gap_before(event, duration, intervals);
    double after = ambulo__dense_gap_after(event, duration, intervals);
    if (time >= event - before - AMBULO__INSTANT && time <= event + after + AMBULO__INSTANT)
      return 1;
  }
  return 0;
}

/* both gaps are zero where a node of a grid on events is one */
static int has_node(const ambulo_problem *p, double event) {
  double part;
  int k = ambulo__node_at(p, event, &part);
  return fabs(p->times[k] - event) <= AMBULO__INSTANT ||
         fabs(p->times[k + 1] - event) <= AMBULO__INSTANT;
}

int ambulo__dense_beside_event(const ambulo_problem *p, const ambulo__events *events, double time) {
  const ambulo_problem_definition *d = &p->definition;
  if (d->grid == AMBULO_GRID_UNIFORM)
    return ambulo__dense_near_event(events, time, d->duration, d->intervals);
  for (int i = 0; i < events->count; i++) {
    double part;
    int k = ambulo__node_at(p, events->time[i], &part);
    if (!has_node(p, events->time[i]) && time >= p->times[k] - AMBULO__INSTANT &&
        time <= p->times[k + 1] + AMBULO__INSTANT)
      return 1;
  }
  return 0;
}

/* ------------------------------------------------------------------- rules */

/* Tolerances: 1 mm, 0.005 rad, 0.02 body weights, 2 % of a speed or torque limit. Rows
 * on centres of pressure have the load in them, as (17') counts zero-moment points by the force:
 * 5 cm under 0.4 % of the weight are 0.2 mm.
 *
 * Orders: of what lies between two nodes that both hold a row, and beside events, on the safe side
 * of what bench/bench_dense.c sees on the shipped problems, so that what is predicted from them
 * comes true there (docs/results.md has the measured ones).
 */

#define REMEDY(name) AMBULO__REMEDY_##name

static const ambulo__dense_rule rules[AMBULO__DENSE_RULES] = {
    /* kind, measure, tolerance; order_alone, order_both, order_landing; of_limit, at_events */
    {AMBULO__KIND_SLIP, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_GROUND_FORCE, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 0, REMEDY(TOLERANCE)},
    {AMBULO__KIND_GROUND_PENETRATION, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_FOOT_STRIKE, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CONTACT, AMBULO__METRES, 0.001, 1.5, 1.5, 2.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CONTACT, AMBULO__RADIANS, 0.005, 1.5, 1.5, 1.5, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CLEARANCE, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_CLEARANCE, AMBULO__RADIANS, 0.005, 1.5, 1.5, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_ZMP, AMBULO__METRES, 0.001, 0.0, 0.0, 1.0, 0, 1, REMEDY(TRANSFER)},
    {AMBULO__KIND_NORMAL_FORCE, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_PRESSURE, AMBULO__METRES, 0.001, 1.0, 0.0, 0.75, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_FRICTION, AMBULO__BODY_WEIGHTS, 0.02, 1.0, 0.0, 1.0, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_FREE_MOMENT, AMBULO__METRES, 0.001, 1.5, 0.0, 1.0, 0, 1, REMEDY(TOLERANCE)},
    {AMBULO__KIND_FLIGHT, AMBULO__BODY_WEIGHTS, 0.001, 1.0, 0.0, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_FLIGHT, AMBULO__METRES, 0.001, 1.0, 0.0, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_JOINT_LIMIT, AMBULO__RADIANS, 0.005, 1.5, 0.0, 1.0, 0, 0, REMEDY(CONTROL_POINTS)},
    {AMBULO__KIND_JOINT_LIMIT, AMBULO__METRES, 0.001, 1.5, 0.0, 1.0, 0, 0, REMEDY(CONTROL_POINTS)},
    {AMBULO__KIND_SPEED_LIMIT, AMBULO__OTHER_MEASURE, 0.02, 1.5, 0.0, 1.0, 1, 0, REMEDY(TOLERANCE)},
    {AMBULO__KIND_TORQUE_LIMIT, AMBULO__OTHER_MEASURE, 0.02, 1.0, 0.0, 1.0, 1, 0,
     REMEDY(TOLERANCE)},
    {AMBULO__KIND_PASSIVE, AMBULO__NEWTON_METRES, 0.01, 1.0, 1.0, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_PASSIVE, AMBULO__NEWTONS, 0.01, 1.0, 1.0, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_COLLISION, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
    {AMBULO__KIND_OBSTACLE, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
    {AMBULO__KIND_REACH, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 1, REMEDY(NONE)},
    {AMBULO__KIND_TRACKING_TUBE, AMBULO__RADIANS, 0.005, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
    {AMBULO__KIND_TRACKING_TUBE, AMBULO__METRES, 0.001, 1.5, 1.5, 1.0, 0, 0, REMEDY(NONE)},
};

const ambulo__dense_rule *ambulo__dense_rule_at(int index) {
  return &rules[index];
}

static int covers(const ambulo__dense_rule *rule, const ambulo__table_row *row) {
  return rule->kind == row->kind &&
         (rule->measure == AMBULO__OTHER_MEASURE || rule->measure == row->measure);
}

int ambulo__dense_rule_of_row(const ambulo__table_row *row) {
  int i = 0;
  while (i < AMBULO__DENSE_RULES && !covers(&rules[i], row)) i++;
  return i < AMBULO__DENSE_RULES ? i : -1;
}

/* of a limit on a quantity that may not be anything but zero */
static double size_of_none(const ambulo_model *model, const ambulo_coordinate *c, int is_torque) {
  if (!is_torque) return 1.0;
  double weight = ambulo__model_weight(model);
  double size = c->type == AMBULO_REVOLUTE ? 0.1 * weight : weight;
  return size > 0.0 ? size : 1.0;
}

double ambulo__dense_limit_size(const ambulo_problem *p, const ambulo__table_row *row) {
  int channel = p->table.terms[row->first_term].channel;
  int is_torque = channel >= ambulo__channel_tau(&p->channels, 0);
  int first =
      is_torque ? ambulo__channel_tau(&p->channels, 0) : ambulo__channel_qd(&p->channels, 0);
  const ambulo_coordinate *c = &p->model->coordinates[channel - first];
  const double *bounds = is_torque ? c->torque : c->speed;
  double size = 0.0;
  for (int i = 0; i < 2; i++) {
    if (isfinite(bounds[i])) size = fmax(size, fabs(bounds[i]));
  }
  return size > 0.0 ? size : size_of_none(p->model, c, is_torque);
}
