/* tests/support/fit_task.h - a made-up fit for the search: residuals by formula in place of
 * solves.
 *
 * Two parameters u, two conditions of two residuals each, and one that is held out:
 *     r = (10 (u_1 - u_0^2), 1 - u_0, 0.3 (u_0 + u_1 - 2), 0)            Rosenbrock and more
 * or, if `linear`, r = (u_0 + u_1 - 2, 0.1 (u_0 - u_1), 0, 0), divided by `scale`; least, 0, at u =
 * (1, 1). With `guarded` the last one is that of a guard: u_0 at most 0.4, deviation 0.01. What
 * goes wrong is asked for by the members. */
#ifndef AMBULO_TESTS_FIT_TASK_H
#define AMBULO_TESTS_FIT_TASK_H

#include "study/fit.h"
#include "support/fail_alloc.h"
#include "support/test.h"

typedef struct fit_made_up {
  double scale;
  int linear, guarded;
  int fails;   /* condition 1 is solved 1: at the start only; 2: nowhere; 3: where u_0 = 0 */
  int stop_at; /* after so many trials the caller stops; 0: never */
  int evaluated, rounds, refreshed, notes;
  double noted;   /* last cost */
  int dropped;    /* columns, in all */
  double damping; /* of the last candidate */
  fail_alloc memory;
  ambulo_allocator allocator;
  double lower[2], upper[2];
  ambulo__fit_parameter parameter[2];
  ambulo__fit_condition condition[3];
  ambulo__fit_curve curve;
  ambulo__fit_target target;
  ambulo_fit fit;
  ambulo__fit_task task;
} fit_made_up;

static inline void fit_made_up_score(fit_made_up *w, ambulo__fit_trial *t, int is_start) {
  double a = t->u[0], b = t->u[1];
  const double curved[4] = {10.0 * (b - a * a), 1.0 - a, 0.3 * (a + b - 2.0), 0.0};
  const double linear[4] = {a + b - 2.0, 0.1 * (a - b), 0.0, 0.0};
  const double *r = w->linear ? linear : curved;
  int fails = w->fails == 2 || (w->fails == 1 && !is_start) || (w->fails == 3 && a != 0.0);
  double slope, guard = w->guarded ? ambulo__fit_guard(&w->fit, &w->target, a, &slope) : 0.0;
  t->distance = 0.0;
  t->score[1][0].value = a;
  for (int k = 0; k < 4; k++) {
    t->residual[k] = k >= 2 && fails ? 3.0 : r[k] / w->scale + (k == 3 ? guard : 0.0);
    t->distance += t->residual[k] * t->residual[k];
  }
  t->solved[0] = 1;
  t->solved[1] = !fails;
  t->index[0] = t->index[1] = w->evaluated;
  t->index[2] = is_start ? 0 : -1; /* held out: solved at the start only */
  t->solved[2] = is_start ? 1 : 0;
  t->complete = 1;
}

static inline ambulo_status fit_made_up_evaluate(void *user, const ambulo__fit_trial *from,
                                                 ambulo__fit_trial *trials, int count) {
  fit_made_up *w = user;
  assert_non_null(from);
  w->rounds++;
  for (int i = 0; i < count; i++) {
    for (int k = 0; k < 2; k++) assert_true(trials[i].u[k] >= w->lower[k] - 1e-12);
    for (int k = 0; k < 2; k++) assert_true(trials[i].u[k] <= w->upper[k] + 1e-12);
    trials[i].complete = 0;
    if (w->stop_at && w->evaluated >= w->stop_at) continue;
    w->evaluated++;
    (void)sscanf(trials[i].label, "damping %lf", &w->damping);
    fit_made_up_score(w, &trials[i], 0);
  }
  return AMBULO_OK;
}

static inline ambulo_status fit_made_up_refresh(void *user, ambulo__fit_trial *best) {
  fit_made_up *w = user;
  (void)best;
  w->refreshed++;
  return AMBULO_OK;
}

/* the cost never rises */
static inline ambulo_status fit_made_up_note(void *user, const ambulo__fit_step *step) {
  fit_made_up *w = user;
  if (w->notes++ > 0) assert_true(step->cost <= w->noted);
  w->noted = step->cost;
  w->dropped += step->dropped;
  return AMBULO_OK;
}

/* from u = 0; *best is to be freed by free() */
static inline void fit_made_up_open(fit_made_up *w, ambulo__fit_trial **best) {
  w->memory = fail_alloc_at(-1);
  w->allocator = fail_alloc_hook(&w->memory);
  if (w->scale == 0.0) w->scale = 5.0;
  if (w->upper[0] == 0.0) {
    w->lower[0] = w->lower[1] = -8.0;
    w->upper[0] = w->upper[1] = 8.0;
  }
  for (int i = 0; i < 2; i++)
    w->parameter[i] = (ambulo__fit_parameter){.lower = w->lower[i], .upper = w->upper[i]};
  w->curve = (ambulo__fit_curve){.weight = 1.0, .is_guard = 1, .bound = {-(double)INFINITY, 0.4}};
  w->target = (ambulo__fit_target){.first = 1, .count = 1, .sd = 0.01};
  w->condition[1] = (ambulo__fit_condition){
      .weight = 1.0, .first = 2, .residuals = 2, .target = &w->target, .targets = w->guarded};
  w->fit = (ambulo_fit){.parameter = w->parameter,
                        .parameters = 2,
                        .residuals = 4,
                        .weights = 1.0,
                        .cap = 12.0,
                        .curve = &w->curve,
                        .condition = w->condition,
                        .conditions = 3,
                        .curves = 1,
                        .tolerance = 1e-4,
                        .iterations = 40};
  w->task = (ambulo__fit_task){.fit = &w->fit,
                               .allocator = &w->allocator,
                               .evaluate = fit_made_up_evaluate,
                               .refresh = fit_made_up_refresh,
                               .note = fit_made_up_note,
                               .user = w};
  *best = ambulo__fit_trials_make(&w->fit, 1, &w->allocator);
  assert_non_null(*best);
  fit_made_up_score(w, *best, 1);
  (*best)->cost = ambulo__fit_cost(&w->fit, *best);
}

static inline void fit_made_up_close(fit_made_up *w, ambulo__fit_trial *best) {
  w->allocator.resize(w->allocator.user, best, 0);
  assert_int_equal(w->memory.live, 0);
}

#endif
