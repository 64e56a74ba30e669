/* study/direct_search.c - NLopt's BOBYQA or SBPLX on the cost alone (trial.h): for few parameters,
 * or a cost that is too rough for differences. One trial after the other; each starts from the
 * solutions of the best one so far, so that results depend on nothing but the course itself. */
#include "study/fit_trial.h"

#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <string.h>

static const double least_step = 0.005; /* of a step: less than an inner solve can tell */

typedef struct search {
  const ambulo__fit_task *task;
  ambulo__fit_trial *best, *trial;
  nlopt_opt opt;
  int count, stopped;
  ambulo_status status;
} search;

static double objective(unsigned n, const double *u, double *gradient, void *data) {
  search *s = data;
  (void)gradient;
  if (s->status || s->stopped) return HUGE_VAL;
  for (unsigned i = 0; i < n; i++)
    s->trial->u[i] = fmin(s->task->upper[i], fmax(s->task->lower[i], u[i]));
  (void)snprintf(s->trial->label, sizeof s->trial->label, "evaluation %d", ++s->count);
  s->status = s->task->evaluate(s->task->user, s->best, s->trial, 1);
  s->stopped = !s->status && !s->trial->complete;
  if (s->status || s->stopped) {
    (void)nlopt_force_stop(s->opt);
    return HUGE_VAL;
  }
  double cost = s->trial->cost = ambulo__fit_cost(s->task, s->trial);
  ambulo__fit_step step = {.damping = (double)NAN, .accepted = "none"};
  if (cost < s->best->cost) { /* also with the solutions that zero finds? */
    s->status = s->task->refresh(s->task->user, s->trial);
    cost = s->trial->cost = ambulo__fit_cost(s->task, s->trial);
  }
  if (!s->status && cost < s->best->cost) {
    ambulo__fit_trial_copy(&s->task->sizes, s->trial, s->best);
    step.accepted = "evaluation";
  }
  step.distance = s->best->distance;
  step.cost = s->best->cost;
  if (!s->status) s->status = s->task->note(s->task->user, &step);
  if (s->status) (void)nlopt_force_stop(s->opt);
  return cost;
}

static nlopt_opt create(const search *s, ambulo__fit_method method) {
  const ambulo__fit_task *task = s->task;
  double first[AMBULO__FIT_PARAMETERS]; /* BOBYQA wants twice of it between the bounds */
  for (int i = 0; i < task->sizes.parameters; i++)
    first[i] = fmin(1.0, 0.25 * (task->upper[i] - task->lower[i]));
  nlopt_opt opt = nlopt_create(method == AMBULO__FIT_BOBYQA ? NLOPT_LN_BOBYQA : NLOPT_LN_SBPLX,
                               (unsigned)task->sizes.parameters);
  int failed = !opt || nlopt_set_lower_bounds(opt, task->lower) < 0 ||
               nlopt_set_upper_bounds(opt, task->upper) < 0 ||
               nlopt_set_initial_step(opt, first) < 0 || nlopt_set_xtol_abs1(opt, least_step) < 0 ||
               nlopt_set_ftol_rel(opt, 0.01 * task->tolerance) < 0 ||
               nlopt_set_maxeval(opt, task->iterations) < 0;
  if (!failed) return opt;
  nlopt_destroy(opt);
  return NULL;
}

ambulo_status ambulo__fit_direct_search(const ambulo__fit_task *task, ambulo__fit_method method,
                                        ambulo__fit_trial *best, ambulo_fit_ending *ending) {
  search s = {.task = task, .best = best};
  size_t n = (size_t)task->sizes.parameters;
  double *u = ambulo__alloc(task->allocator, n, sizeof *u), least = 0.0;
  s.trial = ambulo__fit_trials_make(&task->sizes, 1, task->allocator);
  s.opt = create(&s, method);
  ambulo_status status = u && s.trial && s.opt ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    memcpy(u, best->u, n * sizeof *u);
    nlopt_set_min_objective(s.opt, objective, &s);
    nlopt_result result = nlopt_optimize(s.opt, u, &least);
    *ending = s.stopped                         ? AMBULO_FIT_INTERRUPTED
              : result == NLOPT_MAXEVAL_REACHED ? AMBULO_FIT_ITERATIONS
                                                : AMBULO_FIT_CONVERGED;
    if (result == NLOPT_OUT_OF_MEMORY) s.status = AMBULO_E_MEMORY;
    if (result == NLOPT_INVALID_ARGS) s.status = AMBULO_E_INTERNAL;
    status = s.status;
  }
  nlopt_destroy(s.opt);
  ambulo__free(task->allocator, s.trial);
  ambulo__free(task->allocator, u);
  return status;
}
