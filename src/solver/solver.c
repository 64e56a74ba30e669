/* solver/solver.c - ambulo_solve: choice of strategy, clock, audit, verdict.
 *
 *   presolve off     NLopt's SLSQP or AUGLAG on the rows as they are     (nlopt_plain.c)
 *   small problems   SLSQP in whitened coordinates                       (nlopt_whitened.c)
 *   otherwise        the pipeline around NLopt's AUGLAG                  (pipeline.c),
 *                    from coarser grids when it starts at zero           (refine.c)
 *
 * Whatever happened, the result's numbers are those of the audit (audit.c).
 */
#include "solver/audit.h"
#include "solver/dense_audit.h"
#include "solver/explain.h"
#include "solver/finisher.h"
#include "solver/nlopt_direct.h"
#include "solver/options.h"
#include "solver/refine.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SMALL = 60 };                      /* unknowns */
static const double price_of_rows = 1e-5; /* relative change of the objective */
static const ambulo__place nowhere = {NULL, 0, 0, NULL};

typedef struct solve {
  const ambulo_problem *problem;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__run run;
  ambulo__engine *engine;
  ambulo_result *result;
  int from_zero, explains;
  const char *method, *nlopt;
} solve;

/* ------------------------------------------------------------------- start */

/* names the first row that is not finite at x */
static ambulo_status refuse_start(const solve *s, ambulo_workspace *workspace) {
  const ambulo_problem *p = s->problem;
  for (int r = 0; r < p->rows; r++) {
    if (isfinite(workspace->row_value[r])) continue;
    const ambulo__table_row *row = &p->table.rows[r];
    return ambulo__error(s->diagnostics, AMBULO_E_PROBLEM, nowhere, NULL,
                         "at the start %s of %s (%s) at t = %.6g s is not finite", row->family,
                         row->subject, row->detail, row->time);
  }
  return ambulo__error(s->diagnostics, AMBULO_E_PROBLEM, nowhere, NULL,
                       "at the start the objective is not finite");
}

static ambulo_status check_start(const solve *s) {
  const double *x = s->result->x;
  ambulo_workspace *workspace = NULL;
  for (int j = 0; j < s->problem->variables; j++) {
    if (!isfinite(x[j]))
      return ambulo__error(s->diagnostics, AMBULO_E_PROBLEM, nowhere, NULL,
                           "unknown %d of the start is not finite", j);
  }
  ambulo_status status = ambulo_workspace_create(s->problem, s->allocator, &workspace);
  if (!status && ambulo__evaluate(workspace, x)) status = refuse_start(s, workspace);
  ambulo_workspace_free(workspace);
  return status;
}

/* ---------------------------------------------------------------- strategies */

static double violation_at(ambulo__engine *e, const double *x) {
  if (ambulo__evaluate(e->workspace, x)) return HUGE_VAL;
  double error = ambulo__engine_equality_error(e);
  return fmax(error, ambulo__engine_excess(e, e->held.excess));
}

/* the coarse grids led astray: once more from zero; x stays if that is no better */
static ambulo_status solve_again(solve *s, double *x) {
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  size_t n = (size_t)s->problem->variables;
  double *other = ambulo__alloc(&a, n, sizeof *other);
  if (!other) return AMBULO_E_MEMORY;
  double before = violation_at(s->engine, x);
  ambulo_status status = ambulo__pipeline(s->engine, AMBULO__INNER_AUGLAG, 0, other);
  if (!status && violation_at(s->engine, other) < before) memcpy(x, other, n * sizeof *x);
  ambulo__free(&a, other);
  return status;
}

/* what the tolerances leave of a point's faults: below 1 it passes */
static double faults_of(const ambulo_result *r, const ambulo_options *o) {
  double kkt = r->audit.at_lower_bound ? 0.0 : r->audit.kkt;
  return fmax(r->audit.violation.worst / o->feasibility_tolerance, kkt / o->optimality_tolerance);
}

/* 1 when the audit finds x better than before: fewer faults, and no dearer for it */
static int is_better(const solve *s, const double *before, const double *x) {
  ambulo_result *old = NULL, *new = NULL;
  const ambulo_options *o = s->run.options;
  int better = 0;
  if (!ambulo_audit_point(s->problem, o, before, s->allocator, NULL, &old) &&
      !ambulo_audit_point(s->problem, o, x, s->allocator, NULL, &new)) {
    double allowed = old->objective + price_of_rows * fabs(old->objective);
    better = faults_of(new, o) < faults_of(old, o) &&
             (faults_of(old, o) > 1.0 || new->objective <= allowed);
  }
  ambulo_result_free(old);
  ambulo_result_free(new);
  return better;
}

static ambulo_status finish_by_slsqp(solve *s, double *x) {
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  size_t n = (size_t)s->problem->variables;
  if (n > AMBULO__FINISHER_UNKNOWNS) {
    ambulo__note(s->diagnostics, nowhere, "finisher: slsqp left out: %zu unknowns are more than %d",
                 n, AMBULO__FINISHER_UNKNOWNS);
    return AMBULO_OK;
  }
  double *other = ambulo__alloc(&a, n, sizeof *other);
  if (!other) return AMBULO_E_MEMORY;
  memcpy(other, x, n * sizeof *x);
  const char *message = NULL;
  ambulo_status status = ambulo__finish(s->engine, other, &message);
  if (!status && is_better(s, x, other)) {
    memcpy(x, other, n * sizeof *x);
    s->method = "AUGLAG with LBFGS, whitened, then SLSQP";
    s->nlopt = message;
  }
  ambulo__free(&a, other);
  return status;
}

static ambulo_status solve_by_pipeline(solve *s) {
  double *x = s->result->x;
  int levels = 0;
  ambulo_status status = AMBULO_OK;
  s->method = "AUGLAG with LBFGS, whitened";
  if (s->from_zero && s->run.options->continuation)
    status = ambulo__refine(s->problem, s->allocator, &s->run, x, &levels);
  if (!status) status = ambulo__pipeline(s->engine, AMBULO__INNER_AUGLAG, 0, x);
  if (!status && levels > 0 && !s->run.stopped &&
      !(violation_at(s->engine, x) <= s->run.options->feasibility_tolerance))
    status = solve_again(s, x);
  if (status || s->run.stopped || s->run.options->finisher != AMBULO_FINISHER_SLSQP) return status;
  return finish_by_slsqp(s, x);
}

static ambulo_status solve_small(solve *s, ambulo_algorithm algorithm) {
  s->method = algorithm == AMBULO_SLSQP ? "SLSQP, whitened" : "AUGLAG with LBFGS, all rows";
  return ambulo__solve_whitened(s->engine, algorithm, s->diagnostics, s->result->x, &s->nlopt);
}

static ambulo_status solve_presolved(solve *s) {
  const ambulo_options *o = s->run.options;
  int small = s->problem->variables < SMALL;
  if (o->algorithm == AMBULO_SLSQP) return solve_small(s, AMBULO_SLSQP);
  if (!s->engine->rows.regular) return solve_small(s, AMBULO_AUGLAG);
  if (o->algorithm == AMBULO_AUGLAG || !small) return solve_by_pipeline(s);
  ambulo_status status = solve_small(s, AMBULO_SLSQP);
  if (status || s->run.stopped) return status;
  if (violation_at(s->engine, s->result->x) <= o->feasibility_tolerance) return status;
  return solve_by_pipeline(s);
}

static ambulo_status solve_problem(solve *s) {
  const ambulo_options *o = s->run.options;
  if (o->presolve) return solve_presolved(s);
  ambulo_algorithm algorithm = o->algorithm == AMBULO_AUGLAG ? AMBULO_AUGLAG : AMBULO_SLSQP;
  s->method = algorithm == AMBULO_AUGLAG ? "AUGLAG with LBFGS, plain" : "SLSQP, plain";
  return ambulo__solve_plain(s->engine, algorithm, s->diagnostics, s->result->x, &s->nlopt);
}

/* -------------------------------------------------------------------- ending */

static void describe(const solve *s) {
  static const char *const reasons[] = {"converged or no progress left", "time or evaluation limit",
                                        "stopped by the caller"};
  ambulo_result *r = s->result;
  const char *reason = s->nlopt && !s->run.stopped ? s->nlopt : reasons[s->run.ending];
  (void)snprintf(r->ending, sizeof r->ending, "NLopt %s: %s after %d evaluations", s->method,
                 reason, s->run.evaluations);
}

/* every family that could not be satisfied, by how much it would have to give */
static void explain(const solve *s) {
  const ambulo_result *r = s->result;
  double tolerance = s->run.options->feasibility_tolerance;
  if (r->verdict != AMBULO_INFEASIBLE) return;
  for (int f = 0; f < r->families; f++) {
    const ambulo_violation *v = &r->family[f];
    if (!(v->worst > tolerance)) continue;
    ambulo__warning(s->diagnostics, nowhere, NULL,
                    "no point was found that satisfies %s: %s (%s) at t = %.6g s is off by %.3g %s",
                    v->family, v->subject, v->detail, v->time, v->worst, v->unit);
  }
}

static int has_time(const solve *s) {
  double limit = s->run.options->time_limit;
  return !(limit > 0.0) || ambulo__seconds_now() - s->run.started < limit;
}

static ambulo_status finish(solve *s) {
  ambulo_result *r = s->result;
  ambulo_status status = ambulo__audit(s->engine, s->run.options, r);
  if (!status)
    status = ambulo__dense_audit(s->problem, s->run.options->dense_samples, has_time(s),
                                 s->allocator, r);
  if (status) return status;
  r->verdict = ambulo__verdict_of(&r->audit, s->run.options, s->run.ending);
  status = ambulo__dense_advise(s->problem, has_time(s), s->allocator, s->diagnostics, r);
  if (status) return status;
  r->iterations = s->run.iterations;
  r->evaluations = s->run.evaluations;
  describe(s);
  if (s->explains) {
    explain(s);
    status = ambulo__explain(s->engine, r);
  }
  if (status) return status;
  ambulo__engine_free(s->engine);
  s->engine = NULL;
  r->timing.evaluate = s->run.seconds_evaluate;
  r->timing.linear_algebra = s->run.seconds_linear;
  r->timing.nlopt = s->run.seconds_nlopt;
  r->timing.total = ambulo__seconds_now() - s->run.started;
  return AMBULO_OK;
}

static ambulo_status begin(solve *s, const ambulo_options *options, const double *start) {
  ambulo_status status = ambulo__options_check(options, s->diagnostics);
  if (status) return status;
  ambulo__run_begin(&s->run, options);
  s->from_zero = start == NULL;
  s->method = "not called";
  status = ambulo__result_create(s->problem, s->allocator, &s->result);
  if (status) return status;
  if (start) memcpy(s->result->x, start, (size_t)s->problem->variables * sizeof *start);
  status = check_start(s);
  if (status) return status;
  return ambulo__engine_create(s->problem, s->result->x, s->allocator, &s->run, s->diagnostics,
                               &s->engine);
}

/* frees what a failed call leaves, hands over the result of a good one */
static ambulo_status end(solve *s, ambulo_status status, ambulo_result **result) {
  ambulo__engine_free(s->engine);
  if (status) {
    ambulo_result_free(s->result);
    return status;
  }
  *result = s->result;
  return AMBULO_OK;
}

ambulo_status ambulo_solve(const ambulo_problem *problem, const ambulo_options *options,
                           const double *start, const ambulo_allocator *allocator,
                           ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own = options ? *options : problem->file_options;
  solve s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.explains = 1;
  ambulo_status status = begin(&s, &own, start);
  if (status) return end(&s, status, result);
  status = solve_problem(&s);
  if (status == AMBULO_E_NUMERIC) status = AMBULO_OK; /* the audit tells */
  if (!status) status = finish(&s);
  return end(&s, status, result);
}

ambulo_status ambulo_audit_point(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *x, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !x || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own = options ? *options : problem->file_options;
  solve s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  ambulo_status status = begin(&s, &own, x);
  if (!status) status = finish(&s);
  if (!status) (void)snprintf(s.result->ending, sizeof s.result->ending, "audit of a given point");
  return end(&s, status, result);
}
