/* study/fit_solves.c - trials, and their solves as cases of a batch in DIR/solves (fit.h).
 *
 * A round is all that can be solved at once: every condition of every trial of it. Its cases are
 * added to the list of the run and the batch is run again, which finds those before it done. An id
 * is the hash of the case's overrides and start, so a run that is repeated asks for the same cases
 * in the same order and computes only what is not there: to resume is to repeat. A case starts from
 * the solution of the same condition at the trial that the round begins from, which depends neither
 * on the number of workers nor on which of them is first.
 *
 * Solutions that a fit follows are set against those that zero finds by the objective of the inner
 * problem, never by the distance to people: what comes closest to them among several valleys would
 * be a fit of the starts. */
#include "base/machine.h"
#include "formats/paths.h"
#include "people/compare.h"
#include "study/batch.h"
#include "study/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* an objective that is less by this share is better, and no rounding */
static const double least_gain = 1e-4;

/* ---------------------------------------------------------------------- trials */

ambulo__fit_trial *ambulo__fit_trials_make(const ambulo_fit *fit, int count,
                                           const ambulo_allocator *allocator) {
  size_t residuals = (size_t)fit->residuals;
  ambulo__fit_trial *trial =
      ambulo__alloc(allocator, (size_t)count, sizeof *trial + residuals * sizeof *trial->residual);
  if (!trial) return NULL;
  double *residual = (double *)(void *)(trial + count);
  for (int i = 0; i < count; i++) {
    trial[i].residual = residual + (size_t)i * residuals;
    trial[i].distance = trial[i].cost = (double)NAN;
    for (int c = 0; c < AMBULO__FIT_CONDITIONS; c++) {
      trial[i].index[c] = -1;
      trial[i].apart[c] = (double)NAN;
    }
  }
  return trial;
}

void ambulo__fit_trial_copy(const ambulo_fit *fit, const ambulo__fit_trial *from,
                            ambulo__fit_trial *to) {
  double *residual = to->residual;
  memcpy(residual, from->residual, (size_t)fit->residuals * sizeof *residual);
  *to = *from;
  to->residual = residual;
}

double ambulo__fit_cost(const ambulo_fit *fit, const ambulo__fit_trial *trial) {
  double squares = 0.0;
  for (int i = 0; i < fit->parameters; i++) squares += trial->u[i] * trial->u[i];
  return trial->distance + fit->ridge * squares / fit->parameters;
}

/* ------------------------------------------------------------------ open, close */

static ambulo_status allocate(ambulo__fit_runner *r) {
  const ambulo_fit *fit = r->fit;
  int residuals = 1;
  r->points = 1;
  for (int c = 0; c < fit->conditions; c++) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    if (condition->residuals > residuals) residuals = condition->residuals;
    for (int t = 0; t < condition->targets; t++) {
      const ambulo__fit_target *target = &condition->target[t];
      if (target->points > r->points) r->points = target->points;
    }
  }
  r->values = ambulo__alloc(r->allocator, (size_t)r->points, sizeof *r->values);
  r->block = ambulo__alloc(r->allocator, (size_t)residuals, sizeof *r->block);
  return r->values && r->block ? AMBULO_OK : AMBULO_E_MEMORY;
}

ambulo_status ambulo__fit_runner_open(const ambulo_fit *fit, const char *directory,
                                      const ambulo_fit_options *options,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics, ambulo__fit_runner *r) {
  memset(r, 0, sizeof *r);
  r->fit = fit;
  r->options = options;
  r->allocator = allocator;
  r->diagnostics = diagnostics;
  r->begin = ambulo__seconds_now();
  r->progress.first = r->progress.best = (double)NAN;
  r->solves = ambulo__join_paths(allocator, directory, "solves", NULL);
  ambulo_status status = r->solves ? allocate(r) : AMBULO_E_MEMORY;
  if (status) return status;
  status = ambulo__sweep_begin(fit->name, fit->path, fit->problem, ambulo__text_data(&fit->known),
                               allocator, diagnostics, &r->sweep);
  if (status) return status;
  r->sweep->case_seconds = fit->case_seconds;
  r->sweep->case_megabytes = fit->case_megabytes;
  return AMBULO_OK;
}

void ambulo__fit_runner_close(ambulo__fit_runner *r) {
  ambulo__free(r->allocator, r->solves);
  ambulo__free(r->allocator, r->values);
  ambulo__free(r->allocator, r->block);
  ambulo_sweep_free(r->sweep);
  r->sweep = NULL;
}

/* --------------------------------------------------------------------- solving */

static int is_asked(const ambulo_fit *fit, ambulo__fit_scope scope, int condition) {
  int held_out = fit->condition[condition].held_out;
  if (scope == AMBULO__FIT_FITTED || scope == AMBULO__FIT_FRESH) return !held_out;
  return scope != AMBULO__FIT_HELD_OUT || held_out;
}

/* the case that this one continues; -1: none */
static int start_of(const ambulo_fit *fit, ambulo__fit_scope scope, const ambulo__fit_trial *from,
                    const ambulo__fit_trial *t, int c) {
  int after = fit->condition[c].after;
  if (scope == AMBULO__FIT_FROM_ZERO || scope == AMBULO__FIT_FRESH) return -1;
  if (from) return from->index[c];
  return after >= 0 ? t->index[after] : -1;
}

static ambulo_status ask(ambulo__fit_runner *r, ambulo__fit_scope scope,
                         const ambulo__fit_trial *from, ambulo__fit_trial *t) {
  const ambulo_fit *fit = r->fit;
  ambulo_status status = AMBULO_OK;
  for (int c = 0; c < fit->conditions && !status; c++) {
    const char **overrides = NULL;
    char name[AMBULO__FIT_LABEL + 80];
    int count = 0;
    t->index[c] = -1;
    if (!is_asked(fit, scope, c)) continue;
    (void)snprintf(name, sizeof name, "%s, %s", fit->condition[c].name, t->label);
    status = ambulo__fit_overrides(fit, c, t->u, &overrides, &count);
    if (!status)
      status = ambulo__sweep_append(r->sweep, name, overrides, count,
                                    start_of(fit, scope, from, t, c), r->diagnostics, &t->index[c]);
    ambulo__free(&fit->allocator, (void *)overrides);
  }
  return status;
}

static int show(void *user, const ambulo_batch_progress *batch) {
  ambulo__fit_runner *r = user;
  ambulo_fit_progress *p = &r->progress;
  int fresh = batch->done - batch->resumed, made = r->computed + fresh;
  p->round = batch->done > r->before ? batch->done - r->before : 0;
  p->rounds = batch->cases - r->before;
  p->solves = batch->done;
  p->failed = batch->failed;
  p->resumed = batch->done - made > 0 ? batch->done - made : 0;
  if (p->expected < batch->cases) p->expected = batch->cases;
  p->seconds = ambulo__seconds_now() - r->begin;
  double each = made > 0 ? (r->solving + batch->seconds) / made : -1.0;
  p->seconds_left = each >= 0.0 ? each * (p->expected - p->solves) : AMBULO_OFF;
  int wish = r->options->progress ? r->options->progress(r->options->user, p) : 0;
  if (wish > r->wish) r->wish = wish;
  return r->wish;
}

/* solves what is new in the list */
static ambulo_status solve(ambulo__fit_runner *r) {
  if (r->sweep->case_count == r->before || r->wish) return AMBULO_OK;
  ambulo_batch_options o = ambulo_batch_options_default();
  ambulo_batch_progress end;
  memset(&end, 0, sizeof end);
  o.program = r->options->program;
  o.workers = r->options->workers;
  o.case_seconds = r->options->case_seconds;
  o.case_megabytes = r->options->case_megabytes;
  o.grace = r->options->grace;
  o.force = 1; /* the list grows; whether the inputs are the same is known from the folder */
  o.progress = show;
  o.user = r;
  r->sweep->trusted = r->before;
  ambulo_status status =
      ambulo_batch_run(r->sweep, r->solves, &o, r->allocator, r->diagnostics, &end);
  int fresh = end.done - end.resumed;
  r->computed += fresh;
  if (fresh > 0) r->solving += end.seconds;
  r->before = r->sweep->case_count;
  return status;
}

/* --------------------------------------------------------------------- scoring */

static ambulo_status find_record(const ambulo__fit_runner *r, int index, ambulo__finding *finding,
                                 ambulo__record *record) {
  const ambulo__sweep_case *one = &r->sweep->cases[index];
  ambulo__damage damage;
  return ambulo__record_find(r->solves, one->id, one->key, 0, r->allocator, finding, record,
                             &damage);
}

/* of a solve that has ended: a record that cannot be read is no failure of the solve */
static ambulo_status expect_record(const ambulo__fit_runner *r, int index, ambulo__finding *finding,
                                   ambulo__record *record) {
  ambulo__place place = {r->solves, 0, 0, NULL};
  ambulo_status status = find_record(r, index, finding, record);
  if (status || *finding != AMBULO__FOUND_DAMAGED) return status;
  return ambulo__error(r->diagnostics, AMBULO_E_IO, place,
                       "what is finished is kept; run the same command again",
                       "the record of case %s cannot be read", r->sweep->cases[index].id);
}

ambulo_status ambulo__fit_state(const ambulo__fit_runner *r, int index, char state[24]) {
  ambulo__finding finding = AMBULO__FOUND_NOTHING;
  ambulo__record record;
  ambulo_status status = AMBULO_OK;
  if (index >= 0) status = find_record(r, index, &finding, &record);
  if (!status)
    (void)snprintf(state, 24, "%s", finding == AMBULO__FOUND_INTACT ? record.state : "missing");
  return status;
}

static ambulo_status lacks_curve(const ambulo__fit_runner *r, const ambulo__fit_condition *c,
                                 const ambulo__fit_target *t, const ambulo__cycle *cycle) {
  ambulo__place place = {cycle->motion_path, 0, 0, NULL};
  return ambulo__error(r->diagnostics, AMBULO_E_PROBLEM, place,
                       "compare.map names the columns of other models; moments and forces need the "
                       "body's mass",
                       "condition '%s': the motion has no curve '%s' (from '%s'); expected every "
                       "curve that 'distance' names",
                       c->name, r->fit->curve[t->curve].curve, t->entry->result);
}

/* blocks and scores of one condition from its motion, or, without one, of a failed solve; sums
 * of what counts */
static ambulo_status score_targets(ambulo__fit_runner *r, int index, ambulo__sampler *motion,
                                   ambulo__fit_trial *trial) {
  const ambulo_fit *fit = r->fit;
  const ambulo__fit_condition *c = &fit->condition[index];
  double sum = 0.0, weights = ambulo__fit_weight(fit, c, 0);
  if (!(weights > 0.0)) weights = ambulo__fit_weight(fit, c, 1);
  for (int k = 0; k < c->targets; k++) {
    const ambulo__fit_target *t = &c->target[k];
    ambulo__fit_score *score = &trial->score[index][t->curve];
    double *block = r->block + t->first, weight = fit->curve[t->curve].weight;
    int found = 0;
    ambulo_status status = AMBULO_OK;
    if (motion)
      status =
          ambulo__sample_curve(motion, t->entry, t->percent, t->points, r->values, NULL, &found);
    if (status) return status;
    if (motion && !found) return lacks_curve(r, c, t, motion->cycle);
    ambulo__fit_residual(fit, t, motion ? r->values : NULL, block, score);
    sum += weight * score->z;
    double factor = sqrt(c->weight * weight / fit->weights);
    for (int i = 0; i < t->count && !c->held_out; i++)
      trial->residual[c->first + t->first + i] = factor * block[i];
  }
  trial->apart[index] = sum / weights;
  if (!c->held_out) trial->distance += c->weight * sum / fit->weights;
  return AMBULO_OK;
}

static ambulo_status read_motion(ambulo__fit_runner *r, int index, ambulo__fit_trial *t) {
  ambulo__cycle cycle;
  memset(&cycle, 0, sizeof cycle);
  /* warnings of the first motions are enough */
  ambulo_diagnostics *list = ambulo_diagnostics_create(r->allocator);
  const char *id = r->sweep->cases[t->index[index]].id;
  char *path = ambulo__case_path(r->allocator, r->solves, id, "");
  ambulo_status status = list && path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    status = ambulo__cycle_open(path, &r->fit->compare, r->allocator, list, &cycle);
    if (!status) {
      ambulo__sampler motion = {.cycle = NULL};
      status = ambulo__sampler_create(&cycle, &r->fit->compare, r->points, &motion);
      if (!status) status = score_targets(r, index, &motion, t);
      ambulo__sampler_free(&motion);
      ambulo__cycle_close(&cycle);
    }
  }
  if (list && (status || !r->warned)) ambulo__diagnostics_append(list, r->diagnostics);
  ambulo_diagnostics_free(list);
  ambulo__free(r->allocator, path);
  return status;
}

static ambulo_status score(ambulo__fit_runner *r, ambulo__fit_scope scope, ambulo__fit_trial *t) {
  ambulo_status status = AMBULO_OK;
  t->complete = 1;
  t->distance = 0.0;
  for (int c = 0; c < r->fit->conditions && !status; c++) {
    ambulo__finding finding = AMBULO__FOUND_NOTHING;
    ambulo__record record;
    if (!is_asked(r->fit, scope, c)) continue;
    status = expect_record(r, t->index[c], &finding, &record);
    if (status) break;
    int is_known = finding == AMBULO__FOUND_INTACT;
    if (!is_known && r->wish) {
      t->complete = 0;
      continue;
    }
    t->solved[c] = is_known && record.valid;
    status = t->solved[c] ? read_motion(r, c, t) : score_targets(r, c, NULL, t);
  }
  return status;
}

ambulo_status ambulo__fit_evaluate(ambulo__fit_runner *r, ambulo__fit_scope scope,
                                   const ambulo__fit_trial *from, ambulo__fit_trial *trials,
                                   int count) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < count && !status; i++) status = ask(r, scope, from, &trials[i]);
  if (!status) status = solve(r);
  for (int i = 0; i < count && !status; i++) status = score(r, scope, &trials[i]);
  r->warned = 1;
  return status;
}

/* --------------------------------------------------------------------- refresh */

/* *total: the objective of a case's result; NaN: there is none */
static ambulo_status read_objective(const ambulo__fit_runner *r, int index, double *total) {
  ambulo__yaml *document = NULL;
  char *path =
      ambulo__case_path(r->allocator, r->solves, r->sweep->cases[index].id, "/summary.json");
  *total = (double)NAN;
  if (!path) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__yaml_load(path, r->allocator, r->diagnostics, &document);
  if (!status) {
    const ambulo__yaml_node *objective = ambulo__yaml_get(ambulo__yaml_root(document), "objective");
    *total = ambulo__yaml_number(ambulo__yaml_get(objective, "total"), (double)NAN);
  }
  ambulo__yaml_free(document);
  ambulo__free(r->allocator, path);
  return status;
}

static ambulo_status is_better(const ambulo__fit_runner *r, const ambulo__fit_trial *trial,
                               const ambulo__fit_trial *fresh, int c, int *better) {
  double own = 0.0, other = 0.0;
  *better = 0;
  if (!fresh->solved[c] || fresh->index[c] == trial->index[c]) return AMBULO_OK;
  *better = !trial->solved[c];
  if (*better) return AMBULO_OK;
  ambulo_status status = read_objective(r, trial->index[c], &own);
  if (!status) status = read_objective(r, fresh->index[c], &other);
  *better = !status && other < own - least_gain * fabs(own);
  return status;
}

static void take(const ambulo__fit_runner *r, const ambulo__fit_trial *fresh, int c,
                 ambulo__fit_trial *trial) {
  const ambulo__fit_condition *condition = &r->fit->condition[c];
  size_t first = (size_t)condition->first;
  if (!condition->held_out)
    memcpy(trial->residual + first, fresh->residual + first,
           (size_t)condition->residuals * sizeof *trial->residual);
  memcpy(trial->score[c], fresh->score[c], sizeof trial->score[c]);
  trial->apart[c] = fresh->apart[c];
  trial->index[c] = fresh->index[c];
  trial->solved[c] = fresh->solved[c];
}

ambulo_status ambulo__fit_take_better(const ambulo__fit_runner *r, const ambulo__fit_trial *fresh,
                                      ambulo__fit_trial *trial) {
  ambulo_status status = AMBULO_OK;
  for (int c = 0; c < r->fit->conditions && !status; c++) {
    int better = 0;
    if (trial->index[c] < 0 || fresh->index[c] < 0) continue;
    status = is_better(r, trial, fresh, c, &better);
    if (better) take(r, fresh, c, trial);
  }
  return status;
}

ambulo_status ambulo__fit_refresh(ambulo__fit_runner *r, ambulo__fit_trial *trial) {
  ambulo__fit_trial *fresh = ambulo__fit_trials_make(r->fit, 1, r->allocator);
  if (!fresh) return AMBULO_E_MEMORY;
  memcpy(fresh->u, trial->u, sizeof fresh->u);
  memcpy(fresh->label, "from zero", sizeof "from zero");
  ambulo_status status = ambulo__fit_evaluate(r, AMBULO__FIT_FRESH, NULL, fresh, 1);
  if (!status && fresh->complete) status = ambulo__fit_take_better(r, fresh, trial);
  trial->distance = 0.0;
  for (int k = 0; k < r->fit->residuals; k++)
    trial->distance += trial->residual[k] * trial->residual[k];
  ambulo__free(r->allocator, fresh);
  return status;
}
