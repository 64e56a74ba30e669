/* solver/attempts.c - a solve from one start: which method, and which point is the best.
 *
 *   usually          NLopt's AUGLAG on the equalities' surface           (method/pipeline.c),
 *                    from coarser grids when it starts at zero           (method/refine.c)
 *   slsqp            NLopt's SLSQP on every row: asked for, or for rows
 *                    that span the grid                                  (method/slsqp.c)
 *
 * From a start of the caller: a rough one is smoothed first (method/pipeline.c). With multipliers
 * it is the solution of a problem beside this one: the rows are balanced and R begins as near a
 * solution, and where it misses narrowly, once more as from a point that nearly holds its rows.
 * Where the start leads to no solution the solver tries its own, zero, before it explains anything.
 * A result is never worse than a start that was valid: of all points the best is kept (session.c).
 */
#include "solver/session.h"

#include "base/diagnostics.h"
#include "base/machine.h"
#include "contact/row_families.h"
#include "method/multipliers.h"
#include "method/pipeline.h"
#include "method/refine.h"
#include "method/slsqp.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double near_rows = 1e-3; /* relative to their sizes */

/* ------------------------------------------------------------------- one start */

/* the coarse grids led astray: once more from zero; x stays if that is no better */
static ambulo_status solve_again(ambulo__session *s, double *x) {
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  size_t n = (size_t)s->problem->variables;
  double *other = ambulo__alloc(&a, n, sizeof *other);
  if (!other) return AMBULO_E_MEMORY;
  ambulo__start_pose(s->problem, other);
  ambulo_ending before = s->run.ending;
  double violation = ambulo__violation_at(s->engine, x);
  ambulo_status status = ambulo__pipeline(s->engine, AMBULO__FAR, other);
  if (!status && ambulo__violation_at(s->engine, other) < violation) {
    memcpy(x, other, n * sizeof *x);
  } else {
    ambulo__run_end(&s->run, before);
  }
  ambulo__free(&a, other);
  return status;
}

static ambulo__stage stage_of(ambulo__session *s, const double *x) {
  if (s->beside && s->engine->iterate.carried_objective >= 0.0) return AMBULO__BESIDE;
  int near = !s->from_zero && ambulo__violation_at(s->engine, x) <= near_rows;
  return near ? AMBULO__NEAR : AMBULO__FAR;
}

static ambulo_status solve_by_pipeline(ambulo__session *s) {
  const ambulo_options *o = s->run.options;
  double *x = s->result->x;
  int levels = 0;
  ambulo_status status = AMBULO_OK;
  s->method = "NLopt's AUGLAG with LBFGS";
  s->run.stage = "coarse grids";
  if (s->from_zero && o->continuation) status = ambulo__refine(s->engine, s->allocator, x, &levels);
  if (s->beside) ambulo__multipliers_transfer(o->multipliers, s->engine);
  s->run.stage = "solve";
  if (!status) status = ambulo__pipeline(s->engine, stage_of(s, x), x);
  if (!status && levels > 0 && !s->run.stopped &&
      !(ambulo__violation_at(s->engine, x) <= o->feasibility_tolerance))
    status = solve_again(s, x);
  return status;
}

static ambulo_status solve_problem(ambulo__session *s) {
  s->nlopt = NULL;
  if (s->run.options->algorithm != AMBULO_SLSQP && s->engine->setup->rows->regular)
    return solve_by_pipeline(s);
  s->method = "NLopt's SLSQP, whitened";
  return ambulo__solve_slsqp(s->engine, s->diagnostics, s->result->x, &s->nlopt);
}

/* an attempt from where result->x stands; what it finds joins the candidates */
static ambulo_status attempt(ambulo__session *s) {
  ambulo_status status = solve_problem(s);
  if (status == AMBULO_E_NUMERIC) status = AMBULO_OK; /* the audit tells */
  if (!status) ambulo__candidates_offer(&s->candidates, s->engine, s->result->x);
  return status;
}

/* beside a solution: the rows nearly hold, and another penalty may do */
static int missed_narrowly(ambulo__session *s) {
  return s->beside && s->candidates.found.violation <= near_rows &&
         !ambulo__candidates_solved(&s->candidates) && !ambulo__run_over(&s->run);
}

/* from zero; or from the caller's start, and from zero when that leads nowhere */
static ambulo_status search(ambulo__session *s) {
  double *x = s->result->x;
  ambulo_status status = ambulo__candidates_create(&s->candidates, s->engine);
  if (status) return status;
  if (s->start) {
    int smoothed = 0;
    ambulo__candidates_offer_start(&s->candidates, s->engine, x);
    status = ambulo__smooth_start(s->engine, x, &smoothed);
  }
  s->beside = s->start && s->run.options->multipliers;
  if (!status) status = attempt(s);
  if (!status && missed_narrowly(s)) {
    s->beside = 0;
    status = attempt(s);
  }
  if (status) return status;
  s->beside = 0;
  if (s->start && !ambulo__candidates_solved(&s->candidates) && !ambulo__run_over(&s->run)) {
    ambulo__start_pose(s->problem, x);
    s->from_zero = 1;
    s->note = "; from zero, since the given start led to no solution";
    status = attempt(s);
    if (status) return status;
  }
  if (ambulo__candidates_take(&s->candidates, x))
    s->note = "; what it found was worse than the given start, which is returned";
  return AMBULO_OK;
}

ambulo_status ambulo__solve_once(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *start, int explains,
                                 const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                 ambulo_result **result) {
  ambulo__session s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.errors = ambulo_diagnostics_error_count(diagnostics);
  s.explains = explains;
  ambulo_status status = ambulo__session_begin(&s, options, start);
  if (!status && s.engine) status = search(&s);
  if (!status) status = ambulo__session_finish(&s);
  return ambulo__session_end(&s, status, result);
}
