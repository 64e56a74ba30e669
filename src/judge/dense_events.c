/* judge/dense_events.c - when the rows of a motion change, and how nodes fall beside that.
 *
 * Rows of a contact stand at nodes with from <= t < to. Between the last of them and `to`, and
 * between `from` and the first of them, nothing holds the contact: these two gaps decide how far it
 * is off, more than the number of nodes does. The tip's clearance begins within a swing
 * (gait/clearance.c) and counts as an event too.
 */
#include "gait/loading.h"
#include "base/instant.h"
#include "judge/dense.h"

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

/* keeps the list rising and without doubles */
static void insert(ambulo__dense_events *events, double time, double duration) {
  if (!(time > AMBULO__INSTANT && time < duration - AMBULO__INSTANT)) return;
  int at = 0;
  while (at < events->count && events->time[at] < time - AMBULO__INSTANT) at++;
  if (at < events->count && events->time[at] <= time + AMBULO__INSTANT) return;
  for (int i = events->count++; i > at; i--) events->time[i] = events->time[i - 1];
  events->time[at] = time;
}

/* where in the swing beside `time` the foot's tip begins to have to clear the ground */
static void insert_tip(const ambulo_problem_definition *d, int foot, double time,
                       ambulo__dense_events *events) {
  if (d->clearance.height < 0.0 || !d->model->feet[foot].has_tip) return;
  ambulo__span air = ambulo__air_span(d, foot, time);
  insert(events, air.from + d->clearance.tip_from * (air.to - air.from), d->duration);
}

ambulo_status ambulo__dense_events_create(const ambulo_problem *p,
                                          const ambulo_allocator *allocator,
                                          ambulo__dense_events *events) {
  const ambulo_problem_definition *d = &p->definition;
  events->count = 0;
  events->time = ambulo__alloc(allocator, 4 * (size_t)d->contact_count, sizeof *events->time);
  if (!events->time) return AMBULO_E_MEMORY;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    insert(events, c->from, d->duration);
    insert(events, c->to, d->duration);
    insert_tip(d, c->foot, c->from, events);
    insert_tip(d, c->foot, c->to, events);
  }
  return AMBULO_OK;
}

int ambulo__dense_near_event(const ambulo__dense_events *events, double time, double duration,
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
