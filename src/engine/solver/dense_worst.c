/* solver/dense_worst.c - the worst sample of each rule, by its ratio to the tolerance. */
#include "solver/dense.h"

#include <math.h>
#include <string.h>

typedef struct search {
  const ambulo__dense *dense;
  const ambulo__events *events;
  ambulo__dense_worst *worst;
} search;

/* NaN is worse than any number, and the first one stays */
static int is_worse(double ratio, double than) {
  if (isnan(than)) return 0;
  return isnan(ratio) || ratio > than;
}

static void note(void *user, const ambulo__dense_sample *sample) {
  search *s = user;
  ambulo__dense_entry *entry = &s->worst->entry[sample->rule];
  double ratio = ambulo__dense_ratio(sample);
  if (!entry->present || is_worse(ratio, entry->ratio)) {
    entry->present = 1;
    entry->sample = *sample;
    entry->ratio = ratio;
  }
  if (!is_worse(ratio, entry->between)) return;
  if (ambulo__dense_rule_at(sample->rule)->at_events &&
      ambulo__dense_beside_event(s->dense->problem, s->events, sample->time))
    return;
  entry->between = ratio;
}

/* (A.2) their worst, by family */
void ambulo__dense_worst_of(const ambulo__dense *dense, const ambulo__events *events,
                            ambulo__dense_worst *worst) {
  search s = {dense, events, worst};
  memset(worst, 0, sizeof *worst);
  ambulo__dense_rows(dense, note, &s);
  ambulo__dense_slip(dense, note, &s);
  ambulo__dense_force(dense, note, &s);
}
