/* method/restore.c - from anywhere to a point that satisfies the equalities.
 *
 * Newton's method for h(x) = 0, C x = b with the step of least length in the metric
 * H_GN + 10 mu I:
 *
 *     minimize d' H d / 2   subject to   J d = -h,   C d = b - C x
 *
 * damped so that no angle changes by more than 0.3 rad at once. The metric makes the motion
 * that it arrives at a smooth one: a step that bends the motion costs torque.
 */
#include "method/restore.h"
#include "method/engine_point.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__restore_create(ambulo__engine *e) {
  ambulo__pool *pool = &e->pool;
  ambulo__restore_scratch *s = ambulo__pool_blocks(pool, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  s->best = ambulo__pool_doubles(pool, (size_t)e->setup->n);
  s->step = ambulo__pool_doubles(pool, (size_t)e->setup->n);
  s->equality = ambulo__pool_doubles(pool, (size_t)e->setup->equalities);
  s->border = ambulo__pool_doubles(pool, (size_t)e->setup->borders);
  s->multiplier = ambulo__pool_doubles(pool, (size_t)e->setup->equalities);
  e->restoring = s;
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* the step of least length from the point held; 1 when it cannot be had */
static int direction(ambulo__engine *e, double *d) {
  ambulo__linearized *at = &e->linearized;
  ambulo__restore_scratch *s = e->restoring;
  int equalities = e->setup->equalities, borders = e->setup->borders;
  double begin = ambulo__seconds_now();
  if (ambulo__sparse_rows_fill(&at->rows.equality, e->workspace, 0)) {
    ambulo__run_fault(e->run, &e->workspace->fault);
    return 1;
  }
  int failed = ambulo__engine_fill_metric(e, AMBULO__RESTORE_DAMPING * e->iterate.mu);
  if (!failed) {
    failed = ambulo__kkt_factor(&at->kkt, &at->base);
    e->run->breakdowns += failed;
  }
  if (!failed) {
    for (int i = 0; i < equalities; i++) s->equality[i] = -e->measured.equality[i];
    for (int i = 0; i < borders; i++) s->border[i] = -e->measured.border[i];
    memset(s->multiplier, 0, (size_t)equalities * sizeof *s->multiplier);
    ambulo__kkt_solve(&at->kkt, NULL, s->equality, s->border, d, s->multiplier, NULL);
  }
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return failed;
}

/* x + t d with the largest t, halved while the point is not finite; 0 on success */
static int advance(ambulo__engine *e, const double *d, double *x) {
  int n = e->setup->n;
  double *from = e->iterate.x, t = ambulo__step_limit(e->setup, d, AMBULO__RESTORE_STEP_CAP);
  memcpy(from, x, (size_t)n * sizeof *x);
  for (int trial = 0; trial < AMBULO__INNER_STEPS; trial++) {
    for (int j = 0; j < n; j++) x[j] = from[j] + t * d[j];
    if (ambulo__evaluate(e->workspace, x) == AMBULO_OK) return 0;
    ambulo__run_fault(e->run, &e->workspace->fault);
    t *= 0.5;
  }
  memcpy(x, from, (size_t)n * sizeof *x);
  return 1;
}

/* (P.4) Newton steps of least length onto the equalities */
ambulo_status ambulo__restore(ambulo__engine *e, double *x, double *error) {
  ambulo__restore_scratch *s = e->restoring;
  size_t bytes = (size_t)e->setup->n * sizeof *x;
  double least = HUGE_VAL;
  *error = HUGE_VAL;
  for (int k = 0; k < AMBULO__RESTORE_STEPS; k++) {
    ambulo_status status = ambulo__evaluate_jacobian(e->workspace, x);
    if (status) return status;
    *error = ambulo__engine_equality_error(e);
    if (*error < least) {
      least = *error;
      memcpy(s->best, x, bytes);
    }
    if (*error < AMBULO__RESTORE_TARGET || ambulo__run_over(e->run)) break;
    if (direction(e, s->step) || advance(e, s->step, x)) break;
  }
  if (least < *error) {
    memcpy(x, s->best, bytes);
    *error = least;
  }
  return AMBULO_OK;
}
