/* people/strikes.c - see strikes.h. */
#include "people/strikes.h"
#include "base/instant.h"

#include <math.h>

/* a contact of `foot` that lasts until `time`; one that only begins there is the next strike */
static int ends_at(const ambulo_problem *problem, int foot, double time) {
  for (int i = 0; i < ambulo_problem_contact_count(problem); i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    if (c->foot == foot && fabs(c->to - time) <= AMBULO__INSTANT &&
        c->from < time - AMBULO__INSTANT)
      return 1;
  }
  return 0;
}

static int begins_loaded(const ambulo_problem *problem, int foot) {
  ambulo_ends ends = ambulo_problem_ends(problem);
  if (ends == AMBULO_ENDS_FREE) return 1;
  if (ends == AMBULO_ENDS_MIRRORED)
    foot = ambulo_model_foot(ambulo_problem_model(problem), foot)->mirror;
  return ends_at(problem, foot, ambulo_problem_duration(problem));
}

/* 1 if the two are one event of a motion that repeats after `period` (0: it does not) */
static int is_same(const ambulo__strike *a, const ambulo__strike *b, double period) {
  double apart = fabs(a->time - b->time);
  return a->foot == b->foot &&
         (apart <= AMBULO__INSTANT || fabs(apart - period) <= AMBULO__INSTANT);
}

/* inserts by time, unless it is there; of one event the earlier time stays */
static void insert(ambulo__strike *strikes, int *count, ambulo__strike one, double period) {
  for (int i = 0; i < *count; i++) {
    if (!is_same(&strikes[i], &one, period)) continue;
    if (strikes[i].time <= one.time + AMBULO__INSTANT) return;
    for (int k = i; k + 1 < *count; k++) strikes[k] = strikes[k + 1];
    --*count;
    break;
  }
  int at = (*count)++;
  for (; at > 0 && strikes[at - 1].time > one.time; at--) strikes[at] = strikes[at - 1];
  strikes[at] = one;
}

int ambulo__most_strikes(const ambulo_problem *problem) {
  return 2 * ambulo_problem_contact_count(problem) + 1;
}

int ambulo__strikes(const ambulo_problem *problem, ambulo__strike *strikes) {
  const ambulo_model *model = ambulo_problem_model(problem);
  double duration = ambulo_problem_duration(problem);
  ambulo_ends ends = ambulo_problem_ends(problem);
  int mirrored = ends == AMBULO_ENDS_MIRRORED, count = 0;
  double period = ends == AMBULO_ENDS_FREE ? 0.0 : (mirrored ? 2.0 : 1.0) * duration;
  for (int i = 0; i < ambulo_problem_contact_count(problem); i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    if (c->foot < 0) continue;
    int follows = c->from <= AMBULO__INSTANT ? begins_loaded(problem, c->foot)
                                             : ends_at(problem, c->foot, c->from);
    if (follows) continue;
    insert(strikes, &count, (ambulo__strike){c->foot, c->from}, period);
    if (!mirrored) continue;
    int mirror = ambulo_model_foot(model, c->foot)->mirror;
    insert(strikes, &count, (ambulo__strike){mirror, c->from + duration}, period);
  }
  return count;
}
