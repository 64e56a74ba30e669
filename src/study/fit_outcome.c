/* study/fit_outcome.c - see outcome.h. */
#include "study/fit_outcome.h"

#include <math.h>

enum { CANDIDATES = 5 }; /* of an iteration: four dampings, and one from zero */

const ambulo__fit_trial *ambulo__fit_after(const ambulo__fit_outcome *o, int condition) {
  return &o->trial[o->fit->condition[condition].held_out ? AMBULO__FIT_APART : AMBULO__FIT_BEST];
}

double ambulo__fit_held_out(const ambulo__fit_outcome *o, int after) {
  double sum = 0.0, weights = 0.0;
  for (int c = 0; c < o->fit->conditions; c++) {
    const ambulo__fit_condition *condition = &o->fit->condition[c];
    const ambulo__fit_trial *t = after ? ambulo__fit_after(o, c) : &o->trial[AMBULO__FIT_FIRST];
    if (!condition->held_out) continue;
    sum += condition->weight * t->apart[c];
    weights += condition->weight;
  }
  return weights > 0.0 ? sum / weights : (double)NAN;
}

int ambulo__fit_bound(const ambulo__fit_outcome *o, int i) {
  const ambulo__fit_parameter *p = &o->fit->parameter[i];
  double u = o->trial[AMBULO__FIT_BEST].u[i], slack = 1e-6 * (p->upper - p->lower);
  if (u <= p->lower + slack) return -1;
  return u >= p->upper - slack;
}

const char *ambulo__fit_ending_name(ambulo_fit_ending ending) {
  switch (ending) {
  case AMBULO_FIT_CONVERGED:
    return "converged";
  case AMBULO_FIT_ITERATIONS:
    return "iterations";
  case AMBULO_FIT_INTERRUPTED:
    return "interrupted";
  case AMBULO_FIT_NOT_RUN:
    return "not_run";
  case AMBULO_FIT_STUCK:
    break;
  }
  return "stuck";
}

int ambulo__fit_expected(const ambulo_fit *fit) {
  int fitted = 0;
  for (int c = 0; c < fit->conditions; c++) fitted += !fit->condition[c].held_out;
  return 3 * fit->conditions - fitted + fit->iterations * (fit->parameters + CANDIDATES) * fitted;
}
