/* solver/session.c - one call: its options, the points it came by, their audit.
 *
 * The result's numbers are those of the audit (solver/audit.c). A point that holds its rows and is
 * not shown to be optimal is the next start: AUGLAG begins afresh there, in turns with the penalty
 * that keeps to the rows and with the weak one of a start from anywhere, which lets go of them for
 * a while and often leads into a better valley. The best point is kept. */
#include "solver/session.h"

#include "base/alloc.h"
#include "base/arithmetic.h"
#include "base/sized.h"
#include "method/pipeline.h"
#include "method/point.h"
#include "problem/definition.h"
#include "solver/dense.h"
#include "solver/explain.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* -------------------------------------------------------------------- options */

void ambulo_problem_options_fill(const ambulo_problem *problem, ambulo_options *filled,
                                 size_t size) {
  ambulo_options usual =
      problem->file_options.size != 0 ? problem->file_options : ambulo_options_default();
  usual.size = size;
  ambulo__sized_fill(filled, size, &usual, sizeof usual);
}

ambulo_status ambulo__options_own(const ambulo_problem *problem, const ambulo_options *given,
                                  ambulo_diagnostics *diagnostics, ambulo_options *own) {
  *own = given ? ambulo_options_default() : ambulo_problem_options(problem);
  if (ambulo__sized_take(own, sizeof *own, given) && own->size == sizeof *own)
    return ambulo__option_ranges_check(own, diagnostics);
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "solver options did not come from ambulo_options_default()");
}

/* ----------------------------------------------------------------- candidates */

/* relative change of the objective that rows which hold better may cost beside the start */
static const double start_advantage = 1e-6;

/* of the allocator: the engine's own memory may be another meanwhile (method/near.c) */
ambulo_status ambulo__candidates_create(ambulo__candidates *c, ambulo__engine *e) {
  c->n = e->setup->n;
  c->tolerance = e->run->options->feasibility_tolerance;
  c->start.x = ambulo__alloc(&e->pool.allocator, 2 * (size_t)c->n, sizeof *c->start.x);
  if (!c->start.x) return AMBULO_E_MEMORY;
  c->found.x = c->start.x + c->n;
  c->start.violation = c->start.objective = c->found.violation = c->found.objective = HUGE_VAL;
  return AMBULO_OK;
}

double ambulo__violation_at(ambulo__engine *e, const double *x) {
  if (ambulo__evaluate(e->workspace, x)) return HUGE_VAL;
  double error = ambulo__engine_equality_error(e);
  return ambulo__worse(error, ambulo__engine_excess(e, e->measured.excess));
}

/* x is one point of several, measured at the workspace */
static void keep(ambulo__candidate *c, const ambulo__engine *e, const double *x, double violation) {
  memcpy(c->x, x, (size_t)e->setup->n * sizeof *x);
  c->violation = violation;
  c->objective = e->workspace->objective;
}

void ambulo__candidates_offer_start(ambulo__candidates *c, ambulo__engine *e, const double *x) {
  double violation = ambulo__violation_at(e, x);
  if (violation < HUGE_VAL) keep(&c->start, e, x, violation);
}

void ambulo__candidates_offer(ambulo__candidates *c, ambulo__engine *e, const double *x) {
  double violation = ambulo__violation_at(e, x), objective = e->workspace->objective;
  int valid = violation <= c->tolerance, was = c->found.violation <= c->tolerance;
  if (!(violation < HUGE_VAL)) return;
  if (valid && was ? objective < c->found.objective : violation < c->found.violation)
    keep(&c->found, e, x, violation);
}

int ambulo__candidates_solved(const ambulo__candidates *c) {
  return c->found.violation <= c->tolerance;
}

int ambulo__candidates_take(const ambulo__candidates *c, double *x) {
  const ambulo__candidate *start = &c->start, *found = &c->found;
  double slack = start_advantage * fabs(start->objective);
  int valid = start->violation <= c->tolerance;
  if (start->violation <= found->violation) slack = 0.0;
  int start_wins =
      valid && (!ambulo__candidates_solved(c) || start->objective < found->objective - slack);
  const ambulo__candidate *best = start_wins ? start : found;
  if (best->violation < HUGE_VAL) memcpy(x, best->x, (size_t)c->n * sizeof *x);
  return start_wins;
}

enum { SECOND_LOOKS = 4 }; /* at a point that holds its rows and is not shown to be optimal */

static ambulo_status check_start(const ambulo__session *s) {
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

/* ---------------------------------------------------------- from start to end */

static void describe(const ambulo__session *s) {
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
  if (s->engine && ambulo__rows_contradict(s->engine->setup->rows, s->problem->rows))
    (void)snprintf(dropped, sizeof dropped, "; of equalities that contradict, the first was kept");
  if (s->nlopt && !run->stopped)
    (void)snprintf(message, sizeof message, " (its last call: %s)", s->nlopt);
  (void)snprintf(r->ending, sizeof r->ending, "%s%s: %s%s; %d iterations, %d evaluations%s%s",
                 s->method, message, ambulo__ending_text(run->ending), limit, run->iterations,
                 run->evaluations, dropped, s->note);
}

static ambulo_status judge(ambulo__session *s) {
  ambulo_result *r = s->result;
  s->run.stage = "audit";
  ambulo_status status = ambulo__audit(s->engine, s->run.options, r);
  if (status) return status;
  ambulo__ending_of_faults(&s->run);
  r->verdict = ambulo__verdict_of(&r->audit, s->run.options, s->run.ending);
  return AMBULO_OK;
}

static ambulo_status look_again(ambulo__session *s) {
  ambulo_result *r = s->result;
  ambulo_status status = AMBULO_OK;
  int able = s->engine->setup->rows->regular, idle = 0;
  for (int k = 0; k < SECOND_LOOKS && !status; k++) {
    double before = r->objective;
    int cut = ambulo__run_over(&s->run) || ambulo__ended_by_cap(&s->run);
    if (!able || cut || r->verdict != AMBULO_FEASIBLE) break;
    status = ambulo__pipeline(s->engine, k % 2 ? AMBULO__FAR : AMBULO__NEAR, r->x);
    if (status && status != AMBULO_E_NUMERIC) return status;
    ambulo__candidates_offer(&s->candidates, s->engine, r->x);
    (void)ambulo__candidates_take(&s->candidates, r->x);
    status = judge(s);
    idle = r->objective < before ? 0 : idle + 1;
    if (idle == 2) break;
  }
  return status;
}

/* A run from the least violated motion, which holds every row: the solver had missed it. */
static ambulo_status recover(ambulo__session *s, double *nearest) {
  ambulo_result *r = s->result;
  ambulo_status status = AMBULO_OK;
  s->run.stage = "solve";
  ambulo__candidates_offer(&s->candidates, s->engine, nearest);
  if (s->engine->setup->rows->regular) {
    status = ambulo__pipeline(s->engine, AMBULO__NEAR, nearest);
    if (status && status != AMBULO_E_NUMERIC) return status;
    ambulo__candidates_offer(&s->candidates, s->engine, nearest);
  }
  (void)ambulo__candidates_take(&s->candidates, r->x);
  status = judge(s);
  if (status || !ambulo_verdict_is_solution(r->verdict)) return status;
  ambulo_allocator a = r->allocator;
  ambulo__free(&a, r->explanation);
  r->explanation = NULL;
  s->note = "; from the motion nearest to where it had stalled that holds every row";
  return look_again(s);
}

/* Why there is no solution, as far as is known. Memory of its own: a run may renew the engine and
 * its pool. */
static ambulo_status explain_or_recover(ambulo__session *s) {
  ambulo_result *r = s->result;
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  double *nearest = ambulo__alloc(&a, (size_t)s->engine->setup->n, sizeof *nearest);
  if (!nearest) return AMBULO_E_MEMORY;
  r->ending_code = s->run.ending;
  s->run.stage = "explanation";
  ambulo_status status = ambulo__explain(s->engine, r, nearest);
  const ambulo_explanation *e = ambulo_result_explanation(r);
  int recovers = !status && e && e->feasible_point && !ambulo__is_limit(s->run.ending) &&
                 !ambulo__run_over(&s->run);
  if (recovers) status = recover(s, nearest);
  ambulo__free(&a, nearest);
  return status;
}

/* the run ended before there was an engine: what the start is */
static ambulo_status finish_unsolved(ambulo__session *s) {
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

/* the point that is returned ends what the solver passed through */
static void end_history(ambulo__session *s) {
  const ambulo_result *r = s->result;
  const ambulo_violation *worst = &r->audit.violation;
  ambulo_iteration end = {.iteration = s->run.iterations,
                          .evaluations = s->run.evaluations,
                          .intervals = s->problem->definition.intervals,
                          .objective = r->objective,
                          .violation = worst->worst / worst->size,
                          .gradient = NAN,
                          .seconds = ambulo__seconds_now() - s->run.started};
  if (r->history->shown.count > 0) ambulo__history_add(r->history, &end);
}

static ambulo_status look_between(ambulo__session *s) {
  int in_time = !ambulo__run_late(&s->run);
  ambulo_status status = ambulo__dense_audit(s->problem, s->run.options->dense_samples, in_time,
                                             s->allocator, s->result);
  if (status) return status;
  return ambulo__dense_advise(s->problem, in_time, s->allocator, s->diagnostics, s->result);
}

ambulo_status ambulo__session_finish(ambulo__session *s) {
  if (!s->engine) return finish_unsolved(s);
  ambulo_result *r = s->result;
  ambulo_status status = judge(s);
  if (!status && s->explains) status = look_again(s);
  if (!status && s->explains) status = explain_or_recover(s);
  if (status) return status;
  ambulo__settle_verdict(&s->run, r);
  end_history(s);
  status = look_between(s);
  if (status) return status;
  r->iterations = s->run.iterations;
  r->evaluations = s->run.evaluations;
  ambulo__report_faults(&s->run, r, s->diagnostics);
  describe(s);
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

ambulo_status ambulo__session_begin(ambulo__session *s, const ambulo_options *options,
                                    const double *start) {
  ambulo_status status = ambulo__solve_check_memory(s->problem, options, s->diagnostics);
  if (status) return status;
  ambulo__run_begin(&s->run, options);
  s->start = start;
  s->from_zero = start == NULL;
  s->method = "not called";
  s->note = "";
  status = ambulo__result_create(s->problem, s->allocator, &s->result);
  if (status) return status;
  s->run.history = s->result->history;
  s->run.history->shown.tolerance = options->feasibility_tolerance;
  ambulo__start_pose(s->problem, s->result->x);
  if (start) memcpy(s->result->x, start, (size_t)s->problem->variables * sizeof *start);
  s->run.problem = s->problem;
  s->run.point = s->result->x;
  status = check_start(s);
  if (status) return status;
  status = ambulo__engine_create(s->problem, s->result->x, s->allocator, &s->run, s->diagnostics,
                                 &s->engine);
  /* stopped during set-up: there is no engine, and nothing is wrong */
  return status == AMBULO_E_LIMIT && s->run.stopped ? AMBULO_OK : status;
}

ambulo_status ambulo__session_end(ambulo__session *s, ambulo_status status,
                                  ambulo_result **result) {
  if (status == AMBULO_E_MEMORY)
    (void)ambulo__error(s->diagnostics, status, ambulo__nowhere, NULL,
                        "cannot allocate memory to solve the problem; it takes about %.3g MB",
                        1e-6 * ambulo_problem_memory(s->problem).solve);
  ambulo__engine_free(s->engine);
  ambulo_allocator a = ambulo__allocator_or_default(s->allocator);
  ambulo__free(&a, s->candidates.start.x);
  if (status) {
    ambulo_result_free(s->result);
    return ambulo__conclude(s->diagnostics, s->errors, status, NULL);
  }
  *result = s->result;
  return AMBULO_OK;
}

ambulo_status ambulo_audit_point(const ambulo_problem *problem, const ambulo_options *options,
                                 const double *x, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_result **result) {
  if (!problem || !x || !result) return AMBULO_E_ARGUMENT;
  ambulo_options own;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &own);
  if (status) return status;
  ambulo__session s = {.problem = problem, .allocator = allocator, .diagnostics = diagnostics};
  s.errors = ambulo_diagnostics_error_count(diagnostics);
  status = ambulo__session_begin(&s, &own, x);
  if (!status) status = ambulo__session_finish(&s);
  if (!status) (void)snprintf(s.result->ending, sizeof s.result->ending, "audit of a given point");
  return ambulo__session_end(&s, status, result);
}
