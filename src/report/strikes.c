/* report/strikes.c - see strikes.h. */
#include "report/strikes.h"

#include <math.h>

static const double together = 1e-9; /* s: contacts that follow each other */

/* a contact of `foot` that lasts until `time`; one that only begins there is the next strike */
static int ends_at(const ambulo_problem *problem, int foot, double time) {
  for (int i = 0; i < ambulo_problem_contact_count(problem); i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    if (c->foot == foot && fabs(c->to - time) <= together && c->from < time - together) return 1;
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

int ambulo__strikes(const ambulo_problem *problem, ambulo__strike *strikes, int capacity) {
  const ambulo_model *model = ambulo_problem_model(problem);
  double duration = ambulo_problem_duration(problem);
  int mirrored = ambulo_problem_ends(problem) == AMBULO_ENDS_MIRRORED, count = 0;
  for (int i = 0; i < ambulo_problem_contact_count(problem); i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    int follows =
        c->from <= together ? begins_loaded(problem, c->foot) : ends_at(problem, c->foot, c->from);
    if (follows) continue;
    if (count < capacity) strikes[count] = (ambulo__strike){c->foot, c->from};
    count++;
    if (!mirrored) continue;
    int mirror = ambulo_model_foot(model, c->foot)->mirror;
    if (count < capacity) strikes[count] = (ambulo__strike){mirror, c->from + duration};
    count++;
  }
  return count;
}
