/* solver/explain.c - see explain.h.
 *
 * Budget: two model steps (elastic.h) for each evaluation of the solve, about as long again as
 * it took, and at least what takes some tenths of a second, so that solves that fail at once are
 * explained too. Steps and not seconds, so that the same problem gets the same explanation on a
 * busy machine; but never past the time limit of the solve.
 */
#include "solver/verdict.h"
#include "solver/explain.h"

#include "contact/row_families.h"
#include "solver/audit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* relative to a row's size: what is left below it is the end of a search, no conflict */
static const double residue = 1e-6;
static const double steps_per_evaluation = 2.0;
static const double least_work = 3e9, step_overhead = 1e5; /* operations */
static const double on_limit_gap = 1e-4;                   /* relative to the row's size */

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

/* the point to start from: the result, or zero where that has no finite values */
static ambulo_status start_point(const ambulo__engine *e, const ambulo_result *result, double *x) {
  memcpy(x, result->x, (size_t)e->setup->n * sizeof *x);
  if (ambulo__evaluate(e->workspace, x) == AMBULO_OK) return AMBULO_OK;
  memset(x, 0, (size_t)e->setup->n * sizeof *x);
  return ambulo__evaluate(e->workspace, x);
}

static ambulo_status explain(ambulo__engine *e, const ambulo_result *result, ambulo__pool *pool,
                             ambulo__explanation *out) {
  ambulo__elastic elastic;
  ambulo__remedy remedy = {.conflict = -1, .row = -1};
  double *x = ambulo__pool_doubles(pool, (size_t)e->setup->n);
  if (pool->failed) return AMBULO_E_MEMORY;
  if (explain_residue(result, out)) {
    ambulo__explain_lines(e->setup->problem, result, out);
    return AMBULO_OK;
  }
  list_contradictions(e, result, out);
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
    ambulo__suggest(e->setup->problem, &remedy, out);
  }
  ambulo__explain_lines(e->setup->problem, result, out);
  return AMBULO_OK;
}

ambulo_status ambulo__explain(ambulo__engine *e, ambulo_result *result) {
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
  ambulo_status status = explain(e, result, &pool, out);
  ambulo__pool_clear(&pool);
  return status;
}

const ambulo_explanation *ambulo_result_explanation(const ambulo_result *result) {
  return result->explanation ? &result->explanation->view : NULL;
}
