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
#include "method/engine.h"
#include "method/parameters.h"

#include <math.h>
#include <string.h>

static int direction(ambulo__engine *e, double *d) {
  double begin = ambulo__seconds_now();
  if (ambulo__sparse_rows_fill(&e->rows.equality, e->workspace, 0)) {
    ambulo__run_fault(e->run, &e->workspace->fault);
    return 1;
  }
  int failed = ambulo__engine_fill_metric(e, AMBULO__RESTORE_DAMPING * e->mu);
  if (!failed) failed = ambulo__kkt_factor(&e->kkt, &e->base);
  if (failed && ambulo__kkt_by_row(&e->kkt)) failed = ambulo__kkt_factor(&e->kkt, &e->base);
  if (!failed) {
    for (int i = 0; i < e->equalities; i++) e->h[i] = -e->h[i];
    for (int i = 0; i < e->borders; i++) e->b[i] = -e->b[i];
    memset(e->dual, 0, (size_t)e->equalities * sizeof *e->dual);
    ambulo__kkt_solve(&e->kkt, NULL, e->h, e->b, d, e->dual, NULL);
  }
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return failed;
}

/* x + t d with the largest t, halved while the point is not finite; 0 on success */
static int advance(ambulo__engine *e, const double *d, double *x) {
  double t = ambulo__engine_step_limit(e, d, AMBULO__RESTORE_STEP_CAP);
  memcpy(e->center, x, (size_t)e->n * sizeof *x);
  for (int trial = 0; trial < AMBULO__RESTORE_HALVINGS; trial++) {
    for (int j = 0; j < e->n; j++) x[j] = e->center[j] + t * d[j];
    if (ambulo__evaluate(e->workspace, x) == AMBULO_OK) return 0;
    ambulo__run_fault(e->run, &e->workspace->fault);
    t *= 0.5;
  }
  memcpy(x, e->center, (size_t)e->n * sizeof *x);
  return 1;
}

/* (P.4) Newton steps of least length onto the equalities */
ambulo_status ambulo__restore(ambulo__engine *e, double *x, double *error) {
  double least = HUGE_VAL;
  *error = HUGE_VAL;
  for (int k = 0; k < AMBULO__RESTORE_STEPS; k++) {
    ambulo_status status = ambulo__evaluate_jacobian(e->workspace, x);
    if (status) return status;
    *error = ambulo__engine_equality_error(e);
    if (*error < least) {
      least = *error;
      memcpy(e->previous, x, (size_t)e->n * sizeof *x);
    }
    if (*error < AMBULO__RESTORE_TARGET || ambulo__run_over(e->run)) break;
    if (direction(e, e->step) || advance(e, e->step, x)) break;
  }
  if (least < *error) {
    memcpy(x, e->previous, (size_t)e->n * sizeof *x);
    *error = least;
  }
  return AMBULO_OK;
}
