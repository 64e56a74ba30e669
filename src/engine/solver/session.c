/* solver/session.c - see session.h.
 *
 * Whatever happened, the result's numbers are those of the audit (solver/audit.c). A point that
 * satisfies the rows and is not shown to be optimal is the next start: AUGLAG begins afresh there,
 * with the damping and the penalty of a start, and often sees further.
 */
#include "solver/session.h"
#include "solver/audit.h"
#include "solver/dense_audit.h"
#include "solver/ending.h"
#include "solver/explain.h"
#include "solver/verdict.h"
#include "method/pipeline.h"
#include "problem/nlp.h"
#include "solver/solve_memory.h"
#include "solver/options.h"

#include <stdio.h>
#include <string.h>

/* at a point that satisfies the rows and is not shown to be optimal */
enum { SECOND_LOOKS = 3 };

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

/* -------------------------------------------------------------------- ending */

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
  int able = s->engine->setup->rows->regular;
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
  if (status) return status;
  end_history(s);
  status = look_between(s);
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

ambulo_status ambulo__session_begin(ambulo__session *s, const ambulo_options *options,
                                    const double *start) {
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
  s->run.history = s->result->history;
  s->run.history->shown.tolerance = options->feasibility_tolerance;
  ambulo__start_pose(s->problem, s->result->x);
  if (start) memcpy(s->result->x, start, (size_t)s->problem->variables * sizeof *start);
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
  if (status) {
    ambulo_result_free(s->result);
    return ambulo__conclude(s->diagnostics, s->errors, status, NULL);
  }
  *result = s->result;
  return AMBULO_OK;
}
