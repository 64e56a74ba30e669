/* contact/phases.c - events, and how intervals are distributed over the phases between them.
 *
 * Phase p lasts d_p of T. Of N intervals it is due N d_p / T. Those due less than the least get the
 * least; the others share what is left in proportion, whole parts first and the rest by largest
 * remainder (of equal ones the earlier phase).
 *
 * Knots: events closer than a fifth of the mean interval count once. A rear foot that leaves .1 ms
 * after the front one has come to be flat would give two knots .1 ms apart: with them six of twenty
 * walks between 1.87 and 1.90 m/s found no solution.
 */
#include "contact/schedule.h"
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/devices.h"

#include "model/model.h"

#include <math.h>
#include <string.h>

/* remainders that are one number but for rounding */
static const double same_remainder = 1e-9;
/* of the mean knot interval: knots that are closer are one */
static const double least_apart = 0.2;

/* ------------------------------------------------------------------- events */

/* keeps the list rising and without doubles */
static void insert(ambulo__events *events, double time, double duration) {
  if (!(time > AMBULO__INSTANT && time < duration - AMBULO__INSTANT)) return;
  int at = 0;
  while (at < events->count && events->time[at] < time - AMBULO__INSTANT) at++;
  if (at < events->count && events->time[at] <= time + AMBULO__INSTANT) return;
  for (int i = events->count++; i > at; i--) events->time[i] = events->time[i - 1];
  events->time[at] = time;
}

double ambulo__tip_time(const ambulo_problem_definition *d, int foot, double time,
                        ambulo__span *air) {
  *air = ambulo__air_span(d, foot, time);
  return air->from + d->clearance.tip_from * (air->to - air->from);
}

int ambulo__edge_times(const ambulo_problem_definition *d, int foot, ambulo__span air,
                       double time[2]) {
  ambulo_contact from = {.foot = foot}, to = from;
  double middle = 0.5 * (air.from + air.to);
  if (!(air.to - air.from > AMBULO__INSTANT) ||
      !ambulo__swing_contacts(d, foot, middle, &from, &to) ||
      ambulo__step_edges_between(d, foot, middle, &from, &to).count == 0)
    return 0;
  for (int last = 0; last < 2; last++) time[last] = ambulo__step_edge_time(air, &from, &to, last);
  return 2;
}

/* where in the swing beside `time` the foot's tip begins to have to clear the ground, and edges */
static void insert_swing(const ambulo_problem_definition *d, int foot, double time,
                         ambulo__events *events) {
  ambulo__span air;
  double tip = ambulo__tip_time(d, foot, time, &air), edge[2];
  if (d->model->feet[foot].has_tip) insert(events, tip, d->duration);
  int edges = ambulo__edge_times(d, foot, air, edge);
  for (int i = 0; i < edges; i++) insert(events, edge[i], d->duration);
}

int ambulo__has_tip_rows(const ambulo_problem_definition *d) {
  int known = d->clearance.height >= 0.0;
  for (int i = 0; known && i < d->contact_count; i++)
    known = ambulo__effector_is_known(d->model, &d->contacts[i]);
  return known;
}

ambulo_status ambulo__events_create(const ambulo_problem_definition *d, ambulo__event_kind kind,
                                    const ambulo_allocator *allocator, ambulo__events *events) {
  events->count = 0;
  size_t most = 8 * (size_t)d->contact_count + 2 * (size_t)d->reach_count;
  most += 4 * (size_t)d->hold_count;
  events->time = ambulo__alloc(allocator, most, sizeof *events->time);
  if (!events->time) return AMBULO_E_MEMORY;
  int swings = kind == AMBULO__EVENTS_OF_ROWS && ambulo__has_tip_rows(d);
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    insert(events, c->from, d->duration);
    insert(events, c->to, d->duration);
    if (!swings || c->foot < 0) continue;
    insert_swing(d, c->foot, c->from, events);
    insert_swing(d, c->foot, c->to, events);
  }
  for (int i = 0; kind == AMBULO__EVENTS_OF_ROWS && i < d->reach_count; i++) {
    insert(events, d->reaches[i].from, d->duration);
    insert(events, d->reaches[i].to, d->duration);
  }
  for (int i = 0; kind == AMBULO__EVENTS_OF_ROWS && i < d->hold_count; i++) {
    double time[4];
    int count = ambulo__hold_events(&d->holds[i], d->duration, time);
    for (int k = 0; k < count; k++) insert(events, time[k], d->duration);
  }
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- grids */

static double phase_begin(const ambulo__events *events, int phase) {
  return phase == 0 ? 0.0 : events->time[phase - 1];
}

static double phase_end(const ambulo__events *events, double duration, int phase) {
  return phase == events->count ? duration : events->time[phase];
}

static double length_of(const ambulo__events *events, double duration, int phase) {
  return phase_end(events, duration, phase) - phase_begin(events, phase);
}

/* phases due less than the least get it, until none is; count[p] = 0: not settled. Returns the
 * intervals left, and in *time the duration of the phases that share them. */
static int settle_short(const ambulo__events *events, double duration, int intervals, int least,
                        int *count, double *time) {
  int left = intervals, settled = 1;
  *time = duration;
  memset(count, 0, ((size_t)events->count + 1) * sizeof *count);
  while (settled) {
    settled = 0;
    for (int p = 0; p <= events->count; p++) {
      double length = length_of(events, duration, p);
      if (count[p] || left * length >= least * *time) continue;
      count[p] = least;
      left -= least;
      *time -= length;
      settled = 1;
    }
  }
  return left;
}

/* whole parts, then one more to the largest remainders */
static void share_rest(const ambulo__events *events, double duration, int left, double time,
                       int *count, double *remainder) {
  int given = 0;
  for (int p = 0; p <= events->count; p++) {
    remainder[p] = -1.0;
    if (count[p]) continue;
    double due = left * length_of(events, duration, p) / time;
    count[p] = (int)floor(due + same_remainder);
    remainder[p] = due - count[p];
    given += count[p];
  }
  for (; given < left; given++) {
    int largest = 0;
    for (int p = 1; p <= events->count; p++) {
      if (remainder[p] > remainder[largest] + same_remainder) largest = p;
    }
    count[largest]++;
    remainder[largest] -= 1.0;
  }
}

/* s in [0, 1] with the spacing at the ends 1 - grade of that without */
static double graded(double grade, double s) {
  const double turn = 6.28318530717958647692;
  return s - grade * sin(turn * s) / turn;
}

ambulo_status ambulo__phase_grid(const ambulo__events *events, double duration, int intervals,
                                 int least, double grade, const ambulo_allocator *allocator,
                                 double *times) {
  size_t phases = (size_t)events->count + 1;
  if ((size_t)intervals < phases * (size_t)least) return AMBULO_E_LIMIT;
  int *count = ambulo__alloc(allocator, phases, sizeof *count);
  double *remainder = ambulo__alloc(allocator, phases, sizeof *remainder), time;
  if (count && remainder) {
    int left = settle_short(events, duration, intervals, least, count, &time), k = 0;
    share_rest(events, duration, left, time, count, remainder);
    for (int p = 0; p <= events->count; p++) {
      double begin = phase_begin(events, p), length = length_of(events, duration, p);
      for (int i = 0; i < count[p]; i++)
        times[k++] = begin + graded(grade, (double)i / count[p]) * length;
    }
    times[k] = duration;
  }
  int failed = !count || !remainder;
  ambulo__free(allocator, count);
  ambulo__free(allocator, remainder);
  return failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* drops what is closer than `least` to what is kept, to 0 or to T */
static void keep_apart(ambulo__events *events, double duration, double least) {
  int kept = 0;
  double last = 0.0;
  for (int i = 0; i < events->count; i++) {
    if (events->time[i] - last < least || duration - events->time[i] < least) continue;
    last = events->time[kept++] = events->time[i];
  }
  events->count = kept;
}

/* Where contacts share the load, what they carry changes within the shortest phase, between one
 * foot's being flat and the other's leaving, as much as within a long one: a phase gets
 * AMBULO__WANTED_NODE_INTERVALS, as long as that is not more than half of all. */
static int least_of(const ambulo_problem_definition *d, int intervals, int phases) {
  int room = intervals / (2 * phases);
  if (d->ground_reaction.kind != AMBULO_REACTION_SHARED || room < AMBULO__LEAST_NODE_INTERVALS)
    return AMBULO__LEAST_NODE_INTERVALS;
  return room < AMBULO__WANTED_NODE_INTERVALS ? room : AMBULO__WANTED_NODE_INTERVALS;
}

static ambulo_status grid_on(const ambulo_problem_definition *d, ambulo__event_kind kind,
                             int intervals, int least, double grade, const char *what,
                             const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                             double *times) {
  ambulo__events events;
  ambulo_status status = ambulo__events_create(d, kind, allocator, &events);
  if (status) return status;
  if (kind == AMBULO__EVENTS_OF_CONTACTS)
    keep_apart(&events, d->duration, least_apart * d->duration / intervals);
  else
    least = least_of(d, intervals, events.count + 1);
  status = ambulo__phase_grid(&events, d->duration, intervals, least, grade, allocator, times);
  if (status == AMBULO_E_LIMIT)
    status = ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "%s.intervals is %d; expected at least %d, %d for each of the %d phases "
                           "between events, or equally spaced %s",
                           what, intervals, least * (events.count + 1), least, events.count + 1,
                           kind == AMBULO__EVENTS_OF_ROWS ? "nodes (grid: uniform)"
                                                          : "knots (knots: uniform)");
  ambulo__free(allocator, events.time);
  return status;
}

/* where contacts share the load their forces begin and end by themselves */
static double grade_of(const ambulo_problem_definition *d) {
  return d->ground_reaction.kind == AMBULO_REACTION_SHARED ? AMBULO__NODE_GRADE : 0.0;
}

ambulo_status ambulo__node_times(const ambulo_problem_definition *d,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 double *times) {
  int n = d->intervals;
  if (d->grid == AMBULO_GRID_EVENTS && !d->node_times)
    return grid_on(d, AMBULO__EVENTS_OF_ROWS, n, AMBULO__LEAST_NODE_INTERVALS, grade_of(d), "time",
                   allocator, diagnostics, times);
  for (int k = 0; k <= n; k++)
    times[k] = d->node_times ? d->node_times[k] : (double)k * d->duration / (double)n;
  return AMBULO_OK;
}

ambulo_status ambulo__knot_times(const ambulo_problem_definition *d, int intervals,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 double *times) {
  return grid_on(d, AMBULO__EVENTS_OF_CONTACTS, intervals, AMBULO__LEAST_KNOT_INTERVALS, 0.0,
                 "trajectory", allocator, diagnostics, times);
}

ambulo_status ambulo__knots_least(const ambulo_problem_definition *d,
                                  const ambulo_allocator *allocator, int *intervals) {
  ambulo__events events;
  *intervals = 1;
  if (d->knots != AMBULO_GRID_EVENTS) return AMBULO_OK;
  ambulo_status status = ambulo__events_create(d, AMBULO__EVENTS_OF_CONTACTS, allocator, &events);
  if (status) return status;
  *intervals = AMBULO__LEAST_KNOT_INTERVALS * (events.count + 1);
  ambulo__free(allocator, events.time);
  return AMBULO_OK;
}
