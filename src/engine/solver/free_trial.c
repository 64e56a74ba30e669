/* solver/free_trial.c - which numbers of a problem are free, the problem with them elsewhere, and
 * one inner solve of a run over them.
 *
 * The solve starts from the best solution so far, whose control points are those of another
 * duration or of other footholds: the same motion, stretched. Where that leads to no optimal
 * motion, a solve from zero has the last word: a valley may end between the two values.
 */
#include "ambulo/again.h"
#include "base/diagnostics.h"
#include "base/machine.h"
#include "base/sized.h"
#include "solver/free_search.h"
#include "solver/result.h"

#include <math.h>
#include <string.h>

static const double close_to_bound = 1e-6; /* of the width */
static const double least_travel = 1e-9;   /* m: below it nothing is per distance */

/* ----------------------------------------------------------------- problem */

/* One block, freed with the problem: texts stand behind the items. */
struct ambulo__free_section {
  ambulo_parameters parameters;
  ambulo_parameter item[];
};

/* The items are the library's own, of its size: the caller reads the beginning of each. */
void ambulo_problem_parameters_fill(const ambulo_problem *problem, ambulo_parameters *filled) {
  const struct ambulo__free_section *s = ambulo__problem_root(problem)->free;
  if (!s) return;
  ambulo_parameters usual = s->parameters;
  usual.size = filled->size;
  ambulo__sized_fill(filled, filled->size, &usual, sizeof usual);
}

ambulo_status ambulo__free_keep(ambulo_problem *problem, const ambulo_parameters *parameters) {
  size_t count = (size_t)parameters->count, size = count * sizeof(ambulo_parameter);
  for (size_t i = 0; i < count; i++) size += strlen(parameters->items[i].name) + 1;
  struct ambulo__free_section *s = ambulo__alloc(&problem->allocator, sizeof *s + size, 1);
  if (!s) return AMBULO_E_MEMORY;
  s->parameters = *parameters;
  s->parameters.items = s->item;
  char *text = (char *)(s->item + count);
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(parameters->items[i].name) + 1;
    s->item[i] = parameters->items[i];
    s->item[i].name = memcpy(text, parameters->items[i].name, length);
    text += length;
  }
  problem->free = s;
  return AMBULO_OK;
}

/* The problem with the numbers of these names at `values`; it owns its model. E_ARGUMENT: there is
 * no such number. Other errors: as ambulo_problem_create. */
static ambulo_status problem_at(const ambulo_problem *problem, const ambulo_parameters *parameters,
                                const double *values, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, ambulo_problem **at) {
  ambulo__parameters known;
  ambulo_status status = ambulo__parameters_init(problem, allocator, &known);
  for (int i = 0; i < parameters->count && !status; i++) {
    const ambulo__parameter *p = ambulo__parameters_find(&known, parameters->items[i].name);
    if (p)
      ambulo__parameter_set(&known, p, values[i]);
    else
      status = AMBULO_E_ARGUMENT;
  }
  if (!status) status = ambulo__variant_problem(&known.variant, diagnostics, 1, at);
  ambulo__parameters_clear(&known);
  return status;
}

ambulo_status ambulo_problem_at(const ambulo_problem *problem, const double *values,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_problem **at) {
  if (!problem || !values || !at || !ambulo__problem_root(problem)->free) return AMBULO_E_ARGUMENT;
  const ambulo_parameters free = ambulo_problem_parameters(problem);
  return problem_at(problem, &free, values, allocator, diagnostics, at);
}

/* ------------------------------------------------------------------ trials */

static double elapsed(const ambulo__outer *run) {
  return ambulo__seconds_now() - run->started;
}

int ambulo__outer_over(ambulo__outer *run) {
  const ambulo_options *o = &run->options;
  if (run->ending != AMBULO_ENDING_NONE) return 1;
  if (o->time_limit > 0.0 && elapsed(run) >= o->time_limit)
    run->ending = AMBULO_ENDING_TIME;
  else if (run->solves >= run->parameters.maximum_solves)
    run->ending = AMBULO_ENDING_SOLVES;
  return run->ending != AMBULO_ENDING_NONE;
}

int ambulo__outer_bound(const ambulo__outer *run, const double *value, int i) {
  const ambulo_parameter *item = &run->parameters.items[i];
  double slack = close_to_bound * (item->upper - item->lower);
  return value[i] <= item->lower + slack ? -1 : value[i] >= item->upper - slack;
}

void ambulo__outer_drop(ambulo__outer_trial *trial) {
  ambulo_result_free(trial->result);
  ambulo_problem_free(trial->problem);
  ambulo_diagnostics_free(trial->messages);
  trial->result = NULL;
  trial->problem = NULL;
  trial->messages = NULL;
}

/* the caller's callback sees one run */
static int show(void *user, const ambulo_progress *inner) {
  ambulo__outer *run = user;
  ambulo_progress progress = *inner;
  progress.seconds = elapsed(run);
  progress.time_limit = run->options.time_limit;
  progress.solve = run->solves;
  progress.best = run->best.result && isfinite(run->best.objective) ? run->best.objective : NAN;
  if (!run->options.progress || !run->options.progress(run->options.user, &progress)) return 0;
  run->ending = AMBULO_ENDING_CALLER;
  return 1;
}

/* ------------------------------------------------------------------ objective */

static const ambulo_sensitivity *find(const ambulo_sensitivity_list *list, const char *name) {
  for (int i = 0; i < list->count; i++)
    if (strcmp(list->items[i].name, name) == 0) return &list->items[i];
  return NULL;
}

/* a limit that the motion does not touch has no sensitivity; what else has none is at a kink */
static int is_limit(const char *name) {
  return strncmp(name, "model.", 6) == 0;
}

/* dF/dp = (df*_dp - F dD/dp) / D; returns 0 at a kink */
static int take_gradient(const ambulo__outer *run, ambulo__outer_trial *t,
                         const ambulo_sensitivity_list *list) {
  int per_distance = run->parameters.per == AMBULO_PER_DISTANCE;
  for (int i = 0; i < run->parameters.count; i++) {
    const ambulo_sensitivity *s = find(list, run->parameters.items[i].name);
    double travel = s && per_distance ? s->travel : 0.0;
    double sign = t->problem->definition.travel < 0.0 ? -1.0 : 1.0;
    t->gradient[i] = s ? (s->derivative - t->objective * sign * travel) / t->distance : 0.0;
    if (!s && !is_limit(run->parameters.items[i].name)) return 0;
  }
  return 1;
}

static ambulo_status value_of(ambulo__outer *run, ambulo__outer_trial *t) {
  ambulo_sensitivity_list *list = NULL;
  int per_distance = run->parameters.per == AMBULO_PER_DISTANCE;
  t->distance = per_distance ? fabs(t->problem->definition.travel) : 1.0;
  if (t->distance < least_travel) return AMBULO_OK;
  const char **names = ambulo__alloc(&run->allocator, (size_t)run->parameters.count, sizeof *names);
  if (!names) return AMBULO_E_MEMORY;
  for (int i = 0; i < run->parameters.count; i++) names[i] = run->parameters.items[i].name;
  ambulo_status status = ambulo__sensitivities_nearly(
      t->problem, t->result, names, run->parameters.count, &run->allocator, &list);
  ambulo__free(&run->allocator, names);
  if (status == AMBULO_E_NUMERIC) return AMBULO_OK;
  if (status) return status;
  t->objective = ambulo_result_objective(t->result) / t->distance;
  if (!take_gradient(run, t, list)) t->objective = HUGE_VAL; /* rejected: no way on from there */
  ambulo_sensitivities_free(list);
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- solving */

static ambulo_status build(ambulo__outer *run, ambulo__outer_trial *t) {
  const ambulo_parameters *p = &run->parameters;
  t->messages = run->diagnostics ? ambulo_diagnostics_create(&run->allocator) : NULL;
  if (run->diagnostics && !t->messages) return AMBULO_E_MEMORY;
  if (p->problem_at)
    return p->problem_at(p->user, t->value, &run->allocator, t->messages, &t->problem);
  return problem_at(run->problem, p, t->value, &run->allocator, t->messages, &t->problem);
}

/* `multipliers`: of the start */
static ambulo_status solve_from(ambulo__outer *run, ambulo__outer_trial *t, const double *start,
                                const ambulo_multipliers *multipliers) {
  ambulo_options options = run->options;
  options.multipliers = multipliers;
  ambulo_result *result = NULL;
  options.progress = show;
  options.user = run;
  if (options.time_limit > 0.0) options.time_limit = fmax(1e-3, options.time_limit - elapsed(run));
  ambulo__diagnostics_clear(t->messages);
  ambulo_status status =
      ambulo_solve(t->problem, &options, start, &run->allocator, t->messages, &result);
  if (status) return status;
  run->evaluations += ambulo_result_evaluations(result);
  ambulo_result_free(t->result);
  t->result = result;
  return AMBULO_OK;
}

static int is_optimal(const ambulo__outer_trial *t) {
  return t->result && ambulo__verdict_at_nodes(ambulo_result_verdict(t->result)) == AMBULO_OPTIMAL;
}

/* a run without an optimal motion yet continues from one that holds */
static int counts(const ambulo__outer *run, const ambulo__outer_trial *t) {
  if (is_optimal(t)) return 1;
  return !is_optimal(&run->best) &&
         ambulo__verdict_at_nodes(ambulo_result_verdict(t->result)) == AMBULO_FEASIBLE;
}

static ambulo_status solve(ambulo__outer *run, ambulo__outer_trial *t) {
  const ambulo__outer_trial *best = &run->best;
  ambulo_multipliers *multipliers = NULL;
  if (!best->result) return solve_from(run, t, run->start, run->options.multipliers);
  ambulo_status status =
      ambulo_multipliers_of(best->problem, best->result, &run->allocator, &multipliers);
  if (!status) status = solve_from(run, t, ambulo_result_x(best->result), multipliers);
  ambulo_multipliers_free(multipliers);
  if (status || is_optimal(t) || ambulo__outer_over(run)) return status;
  return solve_from(run, t, NULL, NULL);
}

/* a failure that is about the values, not about the run */
static int is_about_values(const ambulo__outer *run, ambulo_status status) {
  if (run->solves == 1) return 0;
  return status == AMBULO_E_PROBLEM || status == AMBULO_E_NUMERIC || status == AMBULO_E_SCHEMA ||
         status == AMBULO_E_MODEL;
}

static int same_unknowns(const ambulo__outer *run, const ambulo__outer_trial *t) {
  return ambulo_problem_variable_count(t->problem) == ambulo_problem_variable_count(run->problem);
}

/* by a limit of the run or the caller: it says nothing about the values */
static int was_cut(const ambulo__outer_trial *t) {
  if (!t->result) return 0;
  ambulo_ending ending = ambulo_result_ending_code(t->result);
  return ending == AMBULO_ENDING_TIME || ending == AMBULO_ENDING_CALLER;
}

ambulo_status ambulo__outer_try(ambulo__outer *run) {
  ambulo__outer_trial *t = &run->latest;
  ambulo__outer_drop(t);
  t->objective = HUGE_VAL;
  memset(t->gradient, 0, (size_t)run->parameters.count * sizeof *t->gradient);
  run->solves++;
  ambulo_status status = build(run, t);
  if (!status && !same_unknowns(run, t))
    status = ambulo__error(run->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                           "problem_at made a problem of %d unknowns; expected %d",
                           ambulo_problem_variable_count(t->problem),
                           ambulo_problem_variable_count(run->problem));
  if (!status) status = solve(run, t);
  if (!status && counts(run, t)) status = value_of(run, t);
  if (status && is_about_values(run, status)) status = AMBULO_OK;
  if (!(t->objective < HUGE_VAL) && !was_cut(t)) run->failed++;
  return status;
}
