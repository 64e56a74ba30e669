/* solver/dense_events.c - how nodes fall beside the times at which rows change
 * (contact/schedule.h).
 *
 * Rows of a contact stand at nodes with from <= t < to. Between the last of them and `to`, and
 * between `from` and the first of them, nothing holds the contact: these two gaps decide how far it
 * is off, more than the number of nodes does. The tip's clearance begins within a swing
 * (contact/clearance.c) and counts as an event too. On a grid on events both gaps are zero.
 */
#include "solver/dense.h"
#include "base/arithmetic.h"

#include <math.h>

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
