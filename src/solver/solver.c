/* solver/solver.c - ambulo_solve: choice of strategy, clock, audit, verdict.
 *
 *   presolve off     NLopt's SLSQP or AUGLAG on the rows as they are     (nlopt_plain.c)
 *   small problems   SLSQP in whitened coordinates                       (nlopt_whitened.c)
 *   otherwise        NLopt's AUGLAG on the equalities' surface           (pipeline.c),
 *                    from coarser grids when it starts at zero           (refine.c)
 *
 * From a start of the caller: a rough one is smoothed first (smooth.c); where it leads to no
 * solution the solver tries its own, zero, before it explains anything; and a result is never worse
 * than a start that was valid: of all points the best is kept (candidates.c).
 *
 * Whatever happened, the result's numbers are those of the audit (audit.c). A point that satisfies
 * the rows and is not shown to be optimal is gone on from: the pipeline starts afresh there, with
 * the damping and the penalty of a start, and often sees further.
 */
#include "judge/audit.h"
#include "solver/better.h"
#include "judge/candidates.h"
#include "judge/dense_audit.h"
#include "judge/ending.h"
#include "judge/explain.h"
#include "method/finisher.h"
#include "solver/memory.h"
#include "method/nlopt_direct.h"
#include "solver/options.h"
#include "method/refine.h"
#include "method/smooth.h"
#include "judge/verdict.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
  SMALL = 60,       /* unknowns: SLSQP first */
  SMALL_ROUNDS = 8, /* of it, before the pipeline takes over what has not settled */
  SECOND_LOOKS = 3  /* at a point that satisfies the rows and is not shown to be optimal */
};
static const double near_rows = 1e-3; /* relative to their sizes */

typedef struct solve {
  const ambulo_problem *problem;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  size_t errors; /* in it before */
  ambulo__run run;
  ambulo__engine *engine;
  ambulo_result *result;
  ambulo__candidates candidates;
  const double *start; /* the caller's; NULL: zero */
  int from_zero, explains;
  const char *method, *nlopt, *note;
} solve;

/* ------------------------------------------------------------------- start */

static ambulo_status check_start(const solve *s) {
  const double *x = s->result->x;
  ambulo_workspace *workspace = NULL;
  ambulo_status status = ambulo__workspace_create_for_values(s->problem, s->allocator, &workspace);
  if (!status && ambulo__evaluate(workspace, x)) {
    char text[AMBULO__FAULT_TEXT];
    ambulo_fault_text(&workspace->fault, text, sizeof text);
    status = ambulo__error(s->diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL,
                           "at the start %s", text);
  }
  ambulo_workspace_free(workspace);
  return status;
}

/* ---------------------------------------------------------------- strategies */

/* the coarse grids led astray: once more from zero; x stays if that is no better */
static ambulo_status solve_again(solve *s, double *x) {
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  size_t n = (size_t)s->problem->variables;
  double *other = ambulo__alloc(&a, n, sizeof *other);
  if (!other) return AMBULO_E_MEMORY;
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

static ambulo_status finish_by_slsqp(solve *s, double *x) {
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  size_t n = (size_t)s->problem->variables;
  if (n > AMBULO__FINISHER_UNKNOWNS) {
    ambulo__note(s->diagnostics, ambulo__nowhere,
                 "finisher: slsqp left out: %zu unknowns are more than %d", n,
                 AMBULO__FINISHER_UNKNOWNS);
    return AMBULO_OK;
  }
  double *other = ambulo__alloc(&a, n, sizeof *other);
  if (!other) return AMBULO_E_MEMORY;
  memcpy(other, x, n * sizeof *x);
  const char *message = NULL;
  int better = 0;
  ambulo_status status = ambulo__finish(s->engine, other, &message);
  if (!status)
    status = ambulo__is_better(s->problem, s->run.options, x, other, s->allocator, &better);
  if (better) {
    memcpy(x, other, n * sizeof *x);
    s->method = "NLopt's AUGLAG with LBFGS, then SLSQP";
    s->nlopt = message;
  }
  ambulo__free(&a, other);
  return status;
}

static ambulo__stage stage_of(solve *s, const double *x) {
  int near = !s->from_zero && ambulo__violation_at(s->engine, x) <= near_rows;
  return near ? AMBULO__NEAR : AMBULO__FAR;
}

static ambulo_status solve_by_pipeline(solve *s) {
  const ambulo_options *o = s->run.options;
  double *x = s->result->x;
  int levels = 0;
  ambulo_status status = AMBULO_OK;
  s->method = "NLopt's AUGLAG with LBFGS";
  s->run.stage = "coarse grids";
  if (s->from_zero && o->continuation) status = ambulo__refine(s->engine, s->allocator, x, &levels);
  s->run.stage = "solve";
  if (!status) status = ambulo__pipeline(s->engine, stage_of(s, x), x);
  if (!status && levels > 0 && !s->run.stopped &&
      !(ambulo__violation_at(s->engine, x) <= o->feasibility_tolerance))
    status = solve_again(s, x);
  if (status || s->run.stopped || o->finisher != AMBULO_FINISHER_SLSQP) return status;
  return finish_by_slsqp(s, x);
}

static ambulo_status solve_small(solve *s, ambulo_algorithm algorithm, int most) {
  s->method = algorithm == AMBULO_SLSQP ? "NLopt's SLSQP, whitened"
                                        : "NLopt's AUGLAG with LBFGS, whitened, all rows";
  if (most > s->run.options->maximum_iterations) most = s->run.options->maximum_iterations;
  return ambulo__solve_whitened(s->engine, algorithm, most, s->diagnostics, s->result->x,
                                &s->nlopt);
}

static ambulo_status solve_presolved(solve *s) {
  const ambulo_options *o = s->run.options;
  int small = s->problem->variables < SMALL;
  if (o->algorithm == AMBULO_SLSQP) return solve_small(s, AMBULO_SLSQP, INT_MAX);
  if (!s->engine->rows.regular) return solve_small(s, AMBULO_AUGLAG, INT_MAX);
  if (o->algorithm == AMBULO_AUGLAG || !small) return solve_by_pipeline(s);
  ambulo_status status = solve_small(s, AMBULO_SLSQP, SMALL_ROUNDS);
  if (status || s->run.stopped || s->run.ending == AMBULO_ENDING_SETTLED) return status;
  ambulo__candidates_offer(&s->candidates, s->engine, s->result->x);
  s->nlopt = NULL;
  return solve_by_pipeline(s);
}

static ambulo_status solve_problem(solve *s) {
  const ambulo_options *o = s->run.options;
  s->nlopt = NULL;
  if (o->presolve) return solve_presolved(s);
  ambulo_algorithm algorithm = o->algorithm == AMBULO_AUGLAG ? AMBULO_AUGLAG : AMBULO_SLSQP;
  s->method =
      algorithm == AMBULO_AUGLAG ? "NLopt's AUGLAG with LBFGS, plain" : "NLopt's SLSQP, plain";
  return ambulo__solve_plain(s->engine, algorithm, s->diagnostics, s->result->x, &s->nlopt);
}

/* an attempt from where result->x stands; what it finds joins the candidates */
static ambulo_status attempt(solve *s) {
  ambulo_status status = solve_problem(s);
  if (status == AMBULO_E_NUMERIC) status = AMBULO_OK; /* the audit tells */
  if (!status) ambulo__candidates_offer(&s->candidates, s->engine, s->result->x);
  return status;
}

/* from zero; or from the caller's start, and from zero when that leads nowhere */
static ambulo_status search(solve *s) {
  double *x = s->result->x;
  size_t bytes = (size_t)s->problem->variables * sizeof *x;
  ambulo_status status = ambulo__candidates_create(&s->candidates, s->engine);
  if (status) return status;
  if (s->start) {
    ambulo__candidates_offer_start(&s->candidates, s->engine, x);
    if (s->run.options->presolve) ambulo__smooth_start(s->engine, x);
  }
  status = attempt(s);
  if (status) return status;
  if (s->start && !ambulo__candidates_solved(&s->candidates) && !ambulo__run_over(&s->run)) {
    memset(x, 0, bytes);
    s->from_zero = 1;
    s->note = "; from zero, since the given start led to no solution";
    status = attempt(s);
    if (status) return status;
  }
  if (ambulo__candidates_take(&s->candidates, x))
    s->note = "; what it found was worse than the given start, which is returned";
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- ending */

static void describe(const solve *s) {
  ambulo_result *r = s->result;
  const ambulo__run *run = &s->run;
  char limit[48] = "", message[64] = "", dropped[64] = "";
  r->ending_code = run->ending;
  if (run->ending == AMBULO_ENDING_ITERATIONS)
    (void)snprintf(limit, sizeof limit, " (%d)", run->options->maximum_iterations);
  if (run->ending == AMBULO_ENDING_EVALUATIONS)
    (void)snprintf(limit, sizeof limit, " (%d)", run->options->maximum_evaluations);
  if (run->ending == AMBULO_ENDING_TIME)
    (void)snprintf(limit, sizeof limit, " (%g s)", run->options->time_limit);
  if (s->engine && ambulo__rows_contradict(&s->engine->rows, s->problem->rows))
    (void)snprintf(dropped, sizeof dropped, "; of equalities that contradict, the first was kept");
  if (s->nlopt && !run->stopped)
    (void)snprintf(message, sizeof message, " (its last call: %s)", s->nlopt);
  (void)snprintf(r->ending, sizeof r->ending, "%s%s: %s%s; %d iterations, %d evaluations%s%s",
                 s->method, message, ambulo_ending_text(run->ending), limit, run->iterations,
                 run->evaluations, dropped, s->note);
}

static ambulo_status judge(solve *s) {
  ambulo_result *r = s->result;
  s->run.stage = "audit";
  ambulo_status status = ambulo__audit(s->engine, s->run.options, r);
  if (status) return status;
  ambulo__ending_of_faults(&s->run);
  r->verdict = ambulo__verdict_of(&r->audit, s->run.options, s->run.ending);
  return AMBULO_OK;
}

static ambulo_status look_again(solve *s) {
  ambulo_result *r = s->result;
  ambulo_status status = AMBULO_OK;
  int able = s->run.options->presolve && s->engine->rows.regular;
  for (int k = 0; k < SECOND_LOOKS && !status; k++) {
    double before = r->objective;
    int cut = ambulo__run_over(&s->run) || s->run.ending == AMBULO_ENDING_ITERATIONS;
    if (!able || cut || r->verdict != AMBULO_FEASIBLE) break;
    status = ambulo__pipeline(s->engine, AMBULO__NEAR, r->x);
    if (status && status != AMBULO_E_NUMERIC) return status;
    ambulo__candidates_offer(&s->candidates, s->engine, r->x);
    (void)ambulo__candidates_take(&s->candidates, r->x);
    status = judge(s);
    if (r->objective >= before && r->verdict != AMBULO_OPTIMAL) break;
  }
  return status;
}

/* the run ended before there was an engine: what the start is */
static ambulo_status finish_unsolved(solve *s) {
  ambulo_result *r = s->result;
  ambulo_workspace *workspace = NULL;
  ambulo_status status = ambulo__workspace_create_for_values(s->problem, s->allocator, &workspace);
  if (!status) (void)ambulo__audit_values(workspace, r); /* was finite before */
  ambulo_workspace_free(workspace);
  r->verdict = ambulo__verdict_of(&r->audit, s->run.options, s->run.ending);
  r->evaluations = s->run.evaluations;
  r->timing.total = ambulo__seconds_now() - s->run.started;
  describe(s);
  return status;
}

static ambulo_status look_between(solve *s) {
  int in_time = !ambulo__run_late(&s->run);
  ambulo_status status = ambulo__dense_audit(s->problem, s->run.options->dense_samples, in_time,
                                             s->allocator, s->result);
  if (status) return status;
  return ambulo__dense_advise(s->problem, in_time, s->allocator, s->diagnostics, s->result);
}

static ambulo_status finish(solve *s) {
  if (!s->engine) return finish_unsolved(s);
  ambulo_result *r = s->result;
  ambulo_status status = judge(s);
  if (!status && s->explains) status = look_again(s);
  if (!status) status = look_between(s);
  if (status) return status;
  r->iterations = s->run.iterations;
  r->evaluations = s->run.evaluations;
  ambulo__report_faults(&s->run, r, s->diagnostics);
  describe(s);
  s->run.stage = "explanation";
  if (s->explains) status = ambulo__explain(s->engine, r);
  if (status) return status;
  ambulo__settle_verdict(&s->run, r);
  if (s->explains)
    ambulo__report_families(r, s->run.options->feasibility_tolerance, s->diagnostics);
  ambulo__engine_free(s->engine);
  s->engine = NULL;
  r->timing.evaluate = s->run.seconds_evaluate;
  r->timing.linear_algebra = s->run.seconds_linear;
  r->nlopt = s->run.nlopt;
  r->timing.nlopt = s->run.nlopt.seconds;
  r->timing.total = ambulo__seconds_now() - s->run.started;
  return AMBULO_OK;
}

static ambulo_status begin(solve *s, const ambulo_options *options, const double *start) {
  ambulo_status status = ambulo__options_check(options, s->diagnostics);
  if (status) return status;
  status = ambulo__solve_check_memory(s->problem, options, s->diagnostics);
  if (status) return status;
  ambulo__run_begin(&s->run, options);
  s->start = start;
  s->from_zero = start == NULL;
  s->method = "not called";
  s->note = "";
  status = ambulo__result_create(s->problem, s->allocator, &s->result);
  if (status) return status;
  if (start) memcpy(s->result->x, start, (size_t)s->problem->variables * sizeof *start);
  status = check_start(s);
  if (status) return status;
  status = ambulo__engine_create(s->problem, s->result->x, s->allocator, &s->run, s->diagnostics,
                                 &s->engine);
  /* stopped during set-up: there is no engine, and nothing is wrong */
  return status == AMBULO_E_LIMIT && s->run.stopped ? AMBULO_OK : status;
}

/* frees what a failed call leaves, hands over the result of a good one */
static ambulo_status end(solve *s, ambulo_status status, ambulo_result **result) {
  if (status == AMBULO_E_MEMORY)
    (void)ambulo__error(s->diagnostics, status, ambulo__nowhere, NULL,
                        "cannot allocate memory to solve the problem; it takes about %.3g MB",
                        1e-6 * ambulo_problem_memory(s->problem).solve);
  ambulo__engine_free(s->engine);
  if (status) {
    ambulo_result_free(s->result);
    return ambulo__conclude(s->diagnostics, s->errors, status, NULL);
  }
  *result = s->result;
  return AMBULO_OK;
}

ambulo_status ambulo_solve(const ambulo_problem *problem, const ambulo_options *options,
                           const double *start, const ambulo_allocator *allocator,
                           ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own = options ? *options : ambulo_problem_options(problem);
  solve s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.errors = ambulo_diagnostics_error_count(diagnostics);
  s.explains = 1;
  ambulo_status status = begin(&s, &own, start);
  if (!status && s.engine) status = search(&s);
  if (!status) status = finish(&s);
  return end(&s, status, result);
}

ambulo_status ambulo_audit_point(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *x, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !x || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own = options ? *options : ambulo_problem_options(problem);
  solve s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = begin(&s, &own, x);
  if (!status) status = finish(&s);
  if (!status) (void)snprintf(s.result->ending, sizeof s.result->ending, "audit of a given point");
  return end(&s, status, result);
}
