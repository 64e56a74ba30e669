/* solver/explain.c - why a solve ended without a solution, and all of it in words.
 *
 * Budget: two model steps (elastic.c) for each evaluation of the solve, about as long again as
 * it took, and at least what takes some tenths of a second, so that solves that fail at once are
 * explained too. Steps and not seconds, so that the same problem gets the same explanation on a
 * busy machine; but never past the time limit of the solve.
 */
#include "solver/explain.h"

#include "contact/row_families.h"
#include "contact/schedule.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* relative to a row's size: what is left below it is the end of a search, no conflict */
static const double residue = 1e-6;
static const double steps_per_evaluation = 2.0;
static const double least_work = 3e9, step_overhead = 1e5; /* operations */
static const double on_limit_gap = 1e-4;                   /* relative to the row's size */

void ambulo__explain_line(ambulo__explanation *out, const char *format, ...) {
  if (out->view.line_count >= AMBULO__MOST_LINES) return;
  char *text = out->text[out->view.line_count];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, AMBULO__LINE_SIZE, format, arguments);
  va_end(arguments);
  out->line[out->view.line_count++] = text;
}

/* ----------------------------------------------------------------- no walk */

/* Says so when a gait without flight that failed asks for what is no walk (contact/schedule.h). */

static void explain_speed(const ambulo__task *t, ambulo__explanation *out) {
  double runs = sqrt(AMBULO__RUNNING_FROUDE * t->gravity * t->leg);
  if (t->froude <= AMBULO__RUNNING_FROUDE) return;
  if (t->froude > 1.0) {
    ambulo__explain_line(out,
                         "no walk: a walk at this speed would need a pull of %.3g body weights to "
                         "keep the body on its arc over a straight leg, and gravity gives 1",
                         t->froude);
  } else {
    ambulo__explain_line(out,
                         "hardly a walk: the arc over a straight leg takes %.2g of the body weight "
                         "at this speed",
                         t->froude);
  }
  ambulo__explain_line(out,
                       "  running is how people move so fast, from about %.2g m/s on legs of %.3g "
                       "m (Froude number 0.5); it has flight: gait.phases.toe_off below 0.5",
                       runs, t->leg);
}

static void explain_step(const ambulo__task *t, ambulo__explanation *out) {
  if (t->step <= AMBULO__LONGEST_STEP * t->leg) return;
  ambulo__explain_line(out,
                       "no walk: a walk with these steps would need legs of %.3g m: people's "
                       "longest steps are about %.3g leg lengths, here %.3g m",
                       t->step / AMBULO__LONGEST_STEP, AMBULO__LONGEST_STEP,
                       AMBULO__LONGEST_STEP * t->leg);
}

static void explain_grade(const ambulo_problem_definition *d, const ambulo__task *t,
                          ambulo__explanation *out) {
  const ambulo_ground_reaction *r = &d->ground_reaction;
  if (r->kind == AMBULO_REACTION_NONE || !(fabs(t->grade) > r->friction)) return;
  ambulo__explain_line(out,
                       "no walk: feet slip on a slope of %.3g deg unless friction is %.3g or more; "
                       "it is %.3g",
                       57.29577951308232 * atan(t->grade), fabs(t->grade), r->friction);
}

void ambulo__explain_task(const ambulo_problem *problem, ambulo__explanation *out) {
  const ambulo_problem_definition *d = &problem->definition;
  ambulo__task task = ambulo__task_of(d);
  int before = out->view.line_count;
  ambulo__span flight;
  if (!task.is_gait || ambulo__flight_span(d, &flight)) return;
  explain_speed(&task, out);
  explain_step(&task, out);
  explain_grade(d, &task, out);
  if (out->view.line_count > before && task.speed > 0.0)
    ambulo__explain_line(out,
                         "  asked for: %.3g m/s in steps of %.3g m, %.3g a second, Froude number "
                         "v^2 / (g l) %.3g, step %.3g leg lengths",
                         task.speed, task.step, task.step_time > 0.0 ? 1.0 / task.step_time : 0.0,
                         task.froude, task.step / task.leg);
}

/* ------------------------------------------------------------------- words */

/* One fact a line, with name, time and unit. */

/* "knee_angle_r lower" */
static const char *name_of(const char *subject, const char *detail, char buffer[96]) {
  const char *space = subject[0] && detail[0] ? " " : "";
  (void)snprintf(buffer, 96, "%s%s%s", subject, space, detail);
  return buffer;
}

static void place(const ambulo_violation *v, char *text, size_t size) {
  char name[96];
  (void)snprintf(text, size, "%.4g %s at %s, t = %.4g s", v->worst, v->unit,
                 name_of(v->subject, v->detail, name), v->time);
}

static void contradictions(ambulo__explanation *out) {
  char where[200];
  for (int i = 0; i < out->view.contradictory_count; i++) {
    const ambulo_violation *v = &out->contradictory[i];
    place(v, where, sizeof where);
    ambulo__explain_line(
        out,
        "contradictory equality: %s (%s) cannot hold together with the equalities before "
        "it",
        v->family, where);
  }
}

/* in conflict: at a minimum of all violations. A search that was cut short shows none. */
static void conflicts(ambulo__explanation *out) {
  char where[200];
  if (out->view.conflict_count == 0) return;
  ambulo__explain_line(out, out->view.confirmed
                                ? "in conflict, where every row gives way a little:"
                                : "still violated, where every row gives way a little:");
  for (int i = 0; i < out->view.conflict_count; i++) {
    place(&out->conflict[i].shared, where, sizeof where);
    ambulo__explain_line(out, "  %s: %s", out->conflict[i].shared.family, where);
  }
}

static void relaxations(ambulo__explanation *out) {
  char where[200];
  int alone = 0;
  for (int i = 0; i < out->view.conflict_count; i++) {
    const ambulo_conflict *c = &out->conflict[i];
    if (c->alone == 0)
      ambulo__explain_line(out, "dropping %s alone did not make the problem feasible",
                           c->shared.family);
    if (c->alone != 1) continue;
    alone++;
    place(&c->relaxation, where, sizeof where);
    ambulo__explain_line(out, "relaxing %s alone is enough: by %s", c->shared.family, where);
    for (int k = 0; k < c->other_count; k++) {
      place(&c->others[k], where, sizeof where);
      ambulo__explain_line(out, "  and %s", where);
    }
  }
  if (out->view.confirmed && out->view.complete && alone == 0 && out->view.conflict_count > 0)
    ambulo__explain_line(out, "no single family of rows is to blame: several have to give way");
}

static void limits(ambulo__explanation *out) {
  char name[96];
  for (int i = 0; i < out->view.on_limit_count; i++) {
    const ambulo_on_limit *l = &out->on_limit[i];
    (void)name_of(l->subject, l->detail, name);
    if (l->from < l->to) {
      ambulo__explain_line(out, "on its limit: %s %s, %.4g %s, t = %.4g to %.4g s (%d nodes)",
                           l->family, name, l->bound, l->unit, l->from, l->to, l->nodes);
    } else {
      ambulo__explain_line(out, "on its limit: %s %s, %.4g %s, t = %.4g s", l->family, name,
                           l->bound, l->unit, l->from);
    }
  }
}

/* a miss that contradicts nothing */
static void near_miss(const ambulo_result *result, ambulo__explanation *out) {
  double left = ambulo__relative(&result->audit.violation);
  if (result->verdict != AMBULO_INFEASIBLE || out->view.confirmed) return;
  if (left <= AMBULO__NEAR_MISS) {
    ambulo__explain_line(out,
                         "not converged: every row holds within %.2g of its size, which is near; "
                         "no rows are known to contradict each other",
                         left);
  } else {
    ambulo__explain_line(out, "not converged: no rows are known to contradict each other");
  }
}

void ambulo__explain_lines(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__explanation *out) {
  char where[200];
  const ambulo_violation *worst = &result->audit.violation;
  place(worst, where, sizeof where);
  ambulo__explain_line(out, "worst row of the point returned: %s, %s", worst->family, where);
  ambulo__explain_task(problem, out);
  contradictions(out);
  near_miss(result, out);
  if (out->view.feasible_point) {
    ambulo__explain_line(
        out, "a motion that satisfies every row at the nodes exists near the point returned: "
             "the solver missed it; allow more time or evaluations, or start from another motion");
    if (!ambulo__is_limit(result->ending_code)) return;
  } else {
    conflicts(out);
    relaxations(out);
    limits(out);
    if (!out->view.complete)
      ambulo__explain_line(out, "cut short by the time limit: not every family could be tried");
  }
  if (!out->suggestion[0]) return;
  ambulo__explain_line(out, "suggestion: %s", out->suggestion);
  for (int i = 0; i < out->view.setting_count; i++)
    ambulo__explain_line(out, "  --set '%s'", out->settings[i]);
}

/* ---------------------------------------------------------- contradictions */

static void list_contradictions(const ambulo__engine *e, const ambulo_result *result,
                                ambulo__explanation *out) {
  double tolerance = e->run->options->feasibility_tolerance;
  for (int r = 0; r < e->setup->problem->rows; r++) {
    if (e->setup->rows->rank[r] != AMBULO__ROW_CONTRADICTORY) continue;
    ambulo_violation v = ambulo__violation_of(e->setup->problem, r, result->row[r]);
    if (!(ambulo__relative(&v) > tolerance)) continue;
    if (out->view.contradictory_count >= AMBULO__MOST_CONTRADICTIONS) break;
    out->contradictory[out->view.contradictory_count++] = v;
  }
}

/* ----------------------------------------------------------------- on limits */

/* entry of the row's limit, made if need be; NULL when there is no room */
static ambulo_on_limit *entry_of(const ambulo_model *model, const ambulo__table_row *row,
                                 ambulo__explanation *out) {
  for (int i = 0; i < out->view.on_limit_count; i++) {
    if (ambulo__rows_alike(out->on_limit_row[i], row)) return &out->on_limit[i];
  }
  if (out->view.on_limit_count >= AMBULO__MOST_ON_LIMITS) return NULL;
  out->on_limit_row[out->view.on_limit_count] = row;
  ambulo_on_limit *l = &out->on_limit[out->view.on_limit_count++];
  l->family = row->family;
  l->subject = row->subject;
  l->detail = row->detail;
  l->unit = row->unit;
  l->bound = ambulo__limit_given(model, row);
  l->from = l->to = row->time;
  l->nodes = 0;
  return l;
}

/* at the point that the workspace holds */
static void list_on_limits(const ambulo__elastic *e, ambulo__explanation *out) {
  const ambulo_problem *p = e->problem;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    int limited = ambulo__row_kind_entry_of(row->kind)->limited;
    if (row->relation != AMBULO_NOT_NEGATIVE || limited == AMBULO__NOT_LIMITED) continue;
    if (!(e->workspace->row_value[r] <= on_limit_gap * e->size[r])) continue;
    ambulo_on_limit *l = entry_of(p->model, row, out);
    if (!l) continue;
    l->from = fmin(l->from, row->time);
    l->to = fmax(l->to, row->time);
    l->nodes++;
  }
}

/* --------------------------------------------------------------------- all */

/* a model step factors a band matrix */
static double budget_of(const ambulo__elastic *e, const ambulo__run *run) {
  double step = (double)e->n * (double)e->base.kd * (double)e->base.kd + step_overhead;
  return fmax(least_work / step, steps_per_evaluation * (double)run->evaluations);
}

/* Rows that all but hold, under a tolerance tighter than usual, contradict nothing: the tolerance
 * is what the point returned asks for. */
static int explain_residue(const ambulo_result *result, ambulo__explanation *out) {
  double left = ambulo__relative(&result->audit.violation);
  if (!(left <= residue)) return 0;
  double unit = pow(10.0, floor(log10(left)));
  out->view.complete = 1;
  (void)snprintf(out->suggestion, sizeof out->suggestion,
                 "every row holds within %.2g of its size, the nearest that this search came: ask "
                 "for a feasibility tolerance above that",
                 left);
  (void)snprintf(out->setting[0], AMBULO__LINE_SIZE, "solver.feasibility_tolerance=%.0e",
                 2.0 * ceil(left / unit) * unit);
  out->settings[0] = out->setting[0];
  out->view.setting_count = 1;
  return 1;
}

/* A run that a cap ended shows nothing about the rows. */
static void suggest_cap(const ambulo__run *run, ambulo__explanation *out) {
  const ambulo_options *o = run->options;
  const char *key = run->ending == AMBULO_ENDING_ITERATIONS    ? "maximum_iterations"
                    : run->ending == AMBULO_ENDING_EVALUATIONS ? "maximum_evaluations"
                                                               : "time_limit";
  double cap = run->ending == AMBULO_ENDING_ITERATIONS    ? o->maximum_iterations
               : run->ending == AMBULO_ENDING_EVALUATIONS ? o->maximum_evaluations
                                                          : o->time_limit;
  double least =
      run->ending == AMBULO_ENDING_ITERATIONS    ? ambulo_options_default().maximum_iterations
      : run->ending == AMBULO_ENDING_EVALUATIONS ? ambulo_options_default().maximum_evaluations
                                                 : 0.0;
  double higher = fmin(1e9, cap < least ? least : 2.0 * cap);
  (void)snprintf(out->suggestion, sizeof out->suggestion,
                 "raise the cap that ended the solve, solver.%s, from %.10g to %.10g or more", key,
                 cap, higher);
  (void)snprintf(out->setting[0], AMBULO__LINE_SIZE, "solver.%s=%.10g", key, higher);
  out->settings[0] = out->setting[0];
  out->view.setting_count = 1;
}

/* the point to start from: the result, or zero where that has no finite values */
static ambulo_status start_point(const ambulo__engine *e, const ambulo_result *result, double *x) {
  memcpy(x, result->x, (size_t)e->setup->n * sizeof *x);
  if (ambulo__evaluate(e->workspace, x) == AMBULO_OK) return AMBULO_OK;
  memset(x, 0, (size_t)e->setup->n * sizeof *x);
  return ambulo__evaluate(e->workspace, x);
}

static ambulo_status explain(ambulo__engine *e, const ambulo_result *result, ambulo__pool *pool,
                             ambulo__explanation *out, double *x) {
  ambulo__elastic elastic;
  ambulo__remedy remedy = {.conflict = -1, .row = -1};
  if (explain_residue(result, out)) {
    ambulo__explain_lines(e->setup->problem, result, out);
    return AMBULO_OK;
  }
  list_contradictions(e, result, out);
  out->view.confirmed = out->view.contradictory_count > 0;
  if (ambulo__ended_by_cap(e->run)) suggest_cap(e->run, out);
  if (e->run->ending == AMBULO_ENDING_TIME || e->run->ending == AMBULO_ENDING_CALLER) {
    ambulo__explain_lines(e->setup->problem, result, out); /* no time is left to look further */
    return AMBULO_OK;
  }
  ambulo_status status = start_point(e, result, x);
  if (!status)
    status = ambulo__elastic_create(e->setup->problem, e->workspace, e->run, pool, &elastic);
  if (status == AMBULO_E_MEMORY) return status;
  if (!status) {
    const ambulo__run *run = e->run;
    elastic.deadline = budget_of(&elastic, run);
    if (run->options->time_limit > 0.0)
      elastic.time_limit = run->started + run->options->time_limit;
    status = ambulo__relax(&elastic, e->run->options->feasibility_tolerance, x, pool, out, &remedy);
    if (status) return status;
    list_on_limits(&elastic, out);
    if (out->view.confirmed && !ambulo__ended_by_cap(run))
      ambulo__suggest(e->setup->problem, &remedy, out);
  }
  ambulo__explain_lines(e->setup->problem, result, out);
  return AMBULO_OK;
}

ambulo_status ambulo__explain(ambulo__engine *e, ambulo_result *result, double *nearest) {
  if (result->verdict != AMBULO_INFEASIBLE && result->verdict != AMBULO_LIMIT_REACHED)
    return AMBULO_OK;
  ambulo__pool pool;
  ambulo__explanation *out = ambulo__alloc(&result->allocator, 1, sizeof *out);
  if (!out) return AMBULO_E_MEMORY;
  result->explanation = out; /* from here on the result frees it */
  out->view.contradictory = out->contradictory;
  out->view.conflicts = out->conflict;
  out->view.on_limits = out->on_limit;
  out->view.lines = out->line;
  out->view.suggestion = out->suggestion;
  out->view.settings = out->settings;
  ambulo__pool_init(&pool, &result->allocator);
  ambulo_status status = explain(e, result, &pool, out, nearest);
  ambulo__pool_clear(&pool);
  return status;
}
