/* tests/support/poison.h - what is not finite, put in one place of what an evaluation computes.
 *
 * Of functions of the caller: the value, or one entry of the gradient, at one node, from the n-th
 * call on. Of the mechanics: one output, one entry of the reverse sweep or of the Jacobians, in one
 * lane, by a kernel set around the true one.
 */
#ifndef AMBULO_TESTS_POISON_H
#define AMBULO_TESTS_POISON_H

#include "problem/nlp.h"
#include "support/test.h"

/* ------------------------------------------------- functions of the caller */

typedef struct poison {
  int node;     /* where; -1: nowhere */
  int entry;    /* -1: the value; else a channel, as in contact/rows.h */
  double value; /* NAN or infinite */
  int calls, after;
  int coordinates;
} poison;

/* sum of tau^2, with the gradient that goes with it, but for the poison */
static inline double poisoned_effort(void *user, const ambulo_node_state *state,
                                     ambulo_node_gradient *gradient) {
  poison *p = user;
  double sum = 0.0;
  int here = state->node == p->node && p->calls++ >= p->after;
  for (int i = 0; i < p->coordinates; i++) {
    sum += state->tau[i] * state->tau[i];
    if (gradient) gradient->tau[i] += 2.0 * state->tau[i];
  }
  if (here && p->entry < 0) return p->value;
  if (here && gradient) gradient->q[p->entry] = p->value; /* channels stand side by side */
  return sum;
}

/* ------------------------------------------------------------ the mechanics */

typedef enum poison_array {
  POISON_OUTPUTS,
  POISON_REVERSE,
  POISON_BY_Q,
  POISON_BY_QD,
  POISON_BY_QDD,
  POISON_NOTHING
} poison_array;

/* one thread, one kernel set at a time */
static struct {
  const ambulo__kernels *kernels;
  poison_array array;
  size_t entry;
  int lane;
  double value;
} poisoned;

static inline void poison_drop(poison_array array, double *lanes) {
  if (poisoned.array == array)
    lanes[poisoned.entry * AMBULO__LANES + (size_t)poisoned.lane] = poisoned.value;
}

static inline void poisoned_outputs(const ambulo__plan *plan, const double *q, const double *qd,
                                    const double *qdd, const double *ground, double *out,
                                    double *scratch) {
  poisoned.kernels->outputs(plan, q, qd, qdd, ground, out, scratch);
  poison_drop(POISON_OUTPUTS, out);
}

static inline void poisoned_reverse(const ambulo__plan *plan, const double *qd, const double *qdd,
                                    const double *ground, const double *weights, double *gq,
                                    double *gqd, double *gqdd, double *scratch) {
  poisoned.kernels->reverse(plan, qd, qdd, ground, weights, gq, gqd, gqdd, scratch);
  poison_drop(POISON_REVERSE, gq); /* gq, gqd, gqdd stand side by side in a workspace */
}

static inline void poisoned_jacobian(const ambulo__plan *plan, const double *q, const double *qd,
                                     const double *qdd, const double *ground, double *jq,
                                     double *jqd, double *jqdd, double *scratch) {
  poisoned.kernels->jacobian(plan, q, qd, qdd, ground, jq, jqd, jqdd, scratch);
  poison_drop(POISON_BY_Q, jq);
  poison_drop(POISON_BY_QD, jqd);
  poison_drop(POISON_BY_QDD, jqdd);
}

/* the problem's kernels with the poison; undone by poison_remove */
static inline void poison_mechanics(ambulo_problem *problem, ambulo__kernels *own,
                                    poison_array array, size_t entry, int lane, double value) {
  if (problem->kernels != own) poisoned.kernels = problem->kernels;
  *own = *poisoned.kernels;
  own->outputs = poisoned_outputs;
  own->reverse = poisoned_reverse;
  own->jacobian = poisoned_jacobian;
  poisoned.array = array;
  poisoned.entry = entry;
  poisoned.lane = lane;
  poisoned.value = value;
  problem->kernels = own;
}

static inline void poison_remove(ambulo_problem *problem) {
  problem->kernels = poisoned.kernels;
}

#endif
