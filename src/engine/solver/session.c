/* solver/session.c - one call: its options, its memory, the points it came by, their audit.
 *
 * The result's numbers are those of the audit (solver/audit.c). A point that holds its rows and is
 * not shown to be optimal is the next start: AUGLAG begins afresh there, in turns with the penalty
 * that keeps to the rows and with the weak one of a start from anywhere, which lets go of them for
 * a while and often leads into a better valley. The best point is kept. */
#include "solver/session.h"

#include "base/alloc.h"
#include "base/arithmetic.h"
#include "base/machine.h"
#include "base/sized.h"
#include "method/metric.h"
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

/* --------------------------------------------------------------------- memory
 * With n unknowns, k diagonals below the main one, m rows, q border rows and J entries in the rows'
 * gradients, what an engine takes (engine.c), in bytes:
 *
 *     8 n (k + 28)       each of three band matrices: metric, whitener, KKT factor
 *     21 J               gradients: value, column, run; slopes by the motion, 3/5 as many
 *     8 n (16 + 12)      vectors, and the mixing of five iterates
 *     8 * 14 m           values, multipliers and marks of rows
 *     8 n (q + 32)       columns of the border, and of rows that come and go (border.h)
 *
 * Meanwhile a coarser grid may be solved (half as much again at the most); afterwards an audit on a
 * finer grid or an explanation (two more bands, all gradients) may follow. The largest counts.
 */

static const double gigabyte = 1073741824.0;
static const double coarse_share = 0.5;
static const double margin = 1.15; /* what is not counted: names, lists, rounding to tiles */

/* columns that a channel depends on at one node, times the control points of the node */
static double columns_of(const ambulo_problem *p, int channel) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(p->plan);
  ambulo__row_part part[AMBULO__MOST_PARTS];
  int output = channel - ambulo__channel_outputs(&p->channels), most = 1;
  if (output < 0) return ambulo__basis_span(p->basis);
  int parts = ambulo__plan_parts(p->plan, output, part);
  for (int k = 0; k < parts; k++) {
    int count = pattern.start[part[k].row + 1] - pattern.start[part[k].row];
    if (count > most) most = count;
  }
  return (double)most * ambulo__basis_span(p->basis);
}

/* entries of the gradients of all rows: of each the widest channel that it looks at */
static double entries_of(const ambulo_problem *p) {
  double sum = 0.0;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    const ambulo__row_term *term = p->table.terms + row->first_term;
    double widest = row->user >= 0 ? ambulo__basis_span(p->basis) * p->coordinates : 1.0;
    for (int t = 0; t < row->term_count; t++) {
      double columns = term[t].node < 0 ? 1.0 : columns_of(p, term[t].channel);
      if (columns > widest) widest = columns;
    }
    sum += row->node < 0 ? 2.0 * widest : widest;
  }
  return sum;
}

ambulo_memory ambulo_problem_memory(const ambulo_problem *p) {
  double n = p->variables, k = ambulo__metric_diagonals(p) + 28.0, word = sizeof(double);
  double entries = 21.0 * entries_of(p), borders = 2.0 * p->coordinates * 3.0;
  double bands = 3.0 * word * n * k, vectors = word * (28.0 * n + 14.0 * p->rows);
  double columns = word * n * (borders + 32.0);
  ambulo_memory memory;
  memory.problem = ambulo__row_bytes(p, p->rows) + 400.0 * p->nodes;
  memory.evaluation = ambulo__workspace_bytes(p, 1);
  double engine = memory.evaluation + bands + entries + vectors + columns;
  double coarse = coarse_share * (engine + memory.problem);
  int samples = ambulo__dense_samples(p, ambulo_options_default().dense_samples);
  double values = ambulo__workspace_bytes(p, 0) - ambulo__slope_bytes(p);
  double dense = samples < 2 ? 0.0 : samples * (memory.problem + values);
  double explanation = 2.0 / 3.0 * bands + entries + columns;
  double after = dense > explanation ? dense : explanation;
  memory.solve = margin * (memory.problem + engine + (coarse > after ? coarse : after));
  return memory;
}

ambulo_status ambulo__solve_check_memory(const ambulo_problem *p, const ambulo_options *o,
                                         ambulo_diagnostics *diagnostics) {
  double most = o->maximum_memory, bytes = ambulo_problem_memory(p).solve;
  const char *what = "solver.maximum_memory";
  if (isnan(most)) {
    most = 1048576.0 * ambulo__free_megabytes();
    what = "free";
  }
  if (most == 0.0 || bytes <= most) return AMBULO_OK;
  return ambulo__error(
      diagnostics, AMBULO_E_LIMIT, ambulo__nowhere,
      "lower trajectory.intervals or time.intervals, or raise solver.maximum_memory",
      "the solve takes about %.3g GB (%d unknowns, %d diagonals, %d rows); expected "
      "at most %.3g GB (%s)",
      bytes / gigabyte, p->variables, ambulo__metric_diagonals(p) + 1, p->rows, most / gigabyte,
      what);
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

/* Why there is no solution, as far as is known. Where the least violated motion holds every row it
 * is a start, and its rows stay held: the solver missed it. */
static ambulo_status explain_or_recover(ambulo__session *s) {
  ambulo_result *r = s->result;
  double *nearest = ambulo__pool_doubles(&s->engine->pool, (size_t)s->engine->setup->n);
  if (!nearest) return AMBULO_E_MEMORY;
  r->ending_code = s->run.ending;
  s->run.stage = "explanation";
  ambulo_status status = ambulo__explain(s->engine, r, nearest);
  const ambulo_explanation *e = ambulo_result_explanation(r);
  if (status || !e || !e->feasible_point || ambulo__is_limit(s->run.ending)) return status;
  if (ambulo__run_over(&s->run)) return AMBULO_OK;
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
