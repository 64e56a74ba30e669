/* study/fit_run.c - ambulo_fit_run: folder, first solves, search, held-out conditions, results.
 *
 * DIR/fit_inputs.json: hash of what the folder was filled from. DIR/solves: the batch folder of its
 * solves. DIR/fit.json, DIR/fitted.yaml: results. DIR/lock: held while a fit runs in it.
 *
 * At the end the best parameters are solved once more from zero, as `ambulo solve fitted.yaml`
 * does: a fit follows its solutions from neighbour to neighbour, and may have led them into a
 * valley that zero does not find. */
#include "base/machine.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/json_text.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "study/batch.h"
#include "study/fit.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { TRIALS = 4, MOST_WORKERS = 4096, MOST_LOG = 1 << 20 };

static int acceptable(const ambulo_fit_options *o) {
  return o->workers >= 0 && o->workers <= MOST_WORKERS &&
         (isnan(o->case_seconds) || o->case_seconds > 0.0) && o->case_megabytes >= 0 &&
         o->grace >= 0.0;
}

typedef struct run {
  const ambulo_fit *fit;
  const char *directory;
  ambulo_allocator allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__fit_runner runner;
  ambulo__fit_outcome outcome;
} run;

static ambulo_status write_file(const run *r, const char *name, const ambulo__text_buffer *text) {
  char *path = ambulo__join_paths(&r->allocator, r->directory, name, NULL);
  ambulo_status status = path ? ambulo__text_status(text) : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(text), text->length, 1, &r->allocator,
                                r->diagnostics);
  ambulo__free(&r->allocator, path);
  return status;
}

/* ---------------------------------------------------------------------- folder */

/* E_IO where the folder holds anything but what a fit leaves that was stopped before it had written
 * its inputs */
static ambulo_status expect_empty(const run *r) {
  DIR *stream = opendir(r->directory);
  if (!stream) return ambulo__io_error(r->diagnostics, r->directory, "read the folder");
  ambulo_status status = AMBULO_OK;
  const struct dirent *entry;
  while (!status && (errno = 0, entry = readdir(stream))) {
    const char *name = entry->d_name;
    ambulo__place place = {r->directory, 0, 0, NULL};
    if (strcmp(name, ".") != 0 && strcmp(name, "..") != 0 && strcmp(name, "lock") != 0 &&
        strncmp(name, "fit_inputs.json.tmp-", 20) != 0)
      status = ambulo__error(r->diagnostics, AMBULO_E_IO, place, NULL,
                             "the folder holds other files ('%.80s'); expected a new, an empty or "
                             "a fit's folder",
                             name);
  }
  if (!status && errno) status = ambulo__io_error(r->diagnostics, r->directory, "read the folder");
  (void)closedir(stream);
  return status;
}

static ambulo_status make_folder(const run *r) {
  struct stat entry;
  if (mkdir(r->directory, 0777) == 0) return AMBULO_OK;
  if (errno == EEXIST && stat(r->directory, &entry) == 0 && !S_ISDIR(entry.st_mode))
    errno = ENOTDIR;
  return errno == EEXIST ? AMBULO_OK
                         : ambulo__io_error(r->diagnostics, r->directory, "create the folder");
}

/* what the fit and its problem are made of */
static void describe_inputs(const run *r, ambulo__text_buffer *text) {
  ambulo__json json = {text, 0, 1};
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", "ambulo-fit-inputs/2");
  ambulo__json_hash(&json, "hash", ambulo__hash_word(r->fit->hash, r->runner.sweep->base_hash));
  ambulo__json_close(&json, '}');
  ambulo__text_append_char(text, '\n');
}

/* E_PROBLEM where the folder is of other inputs */
static ambulo_status compare_inputs(const run *r, const char *path,
                                    const ambulo__text_buffer *inputs) {
  if (ambulo__text_status(inputs)) return AMBULO_E_MEMORY;
  if (ambulo__file_says(path, ambulo__text_data(inputs), inputs->length)) return AMBULO_OK;
  ambulo__place place = {path, 0, 0, NULL};
  return ambulo__error(r->diagnostics, AMBULO_E_PROBLEM, place,
                       "--force continues in it and keeps the solves whose inputs are the same; or "
                       "give another folder",
                       "the fit file, its problem, model or references, or the version of ambulo "
                       "changed since the folder was filled; expected the same inputs");
}

/* Makes DIR the folder of this fit and locks it. One that holds other things is refused, and one of
 * a fit with other inputs unless force = 1. Errors: E_IO, E_PROBLEM, E_MEMORY. */
static ambulo_status prepare_folder(const run *r, int *lock) {
  ambulo_status status = ambulo__expect_path(r->directory, "folder", r->diagnostics);
  if (!status) status = make_folder(r);
  if (status) return status;
  ambulo__text_buffer inputs;
  ambulo__text_init(&inputs, &r->allocator);
  describe_inputs(r, &inputs);
  char *path = ambulo__join_paths(&r->allocator, r->directory, "fit_inputs.json", NULL);
  if (!path) status = AMBULO_E_MEMORY;
  int is_ours = path && ambulo__file_says(path, "\"ambulo-fit-inputs/", 64);
  if (!status && !is_ours) status = expect_empty(r);
  if (!status) status = ambulo__lock_take(r->directory, 1, 1, &r->allocator, r->diagnostics, lock);
  if (!status && is_ours && !r->runner.options->force) status = compare_inputs(r, path, &inputs);
  if (!status) status = write_file(r, "fit_inputs.json", &inputs);
  ambulo__free(&r->allocator, path);
  ambulo__text_free(&inputs);
  return status;
}

/* ---------------------------------------------------------------------- course */

static ambulo_status note(void *user, const ambulo__fit_step *step) {
  run *r = user;
  ambulo__fit_outcome *o = &r->outcome;
  o->entry[o->entries++] = (ambulo__fit_entry){*step, r->runner.sweep->case_count};
  r->runner.progress.iteration = o->entries - 1;
  r->runner.progress.best = step->distance;
  return AMBULO_OK;
}

static ambulo_status refresh(void *user, ambulo__fit_trial *best) {
  run *r = user;
  return ambulo__fit_refresh(&r->runner, best);
}

static ambulo_status evaluate(void *user, const ambulo__fit_trial *from, ambulo__fit_trial *trials,
                              int count) {
  run *r = user;
  return ambulo__fit_evaluate(&r->runner, AMBULO__FIT_FITTED, from, trials, count);
}

/* the first line of what a failed solve said; to be freed; NULL: nothing */
static char *first_words(const run *r, int index) {
  char *text = NULL, *words = NULL;
  size_t length = 0;
  if (index < 0) return NULL;
  char *path =
      ambulo__case_path(&r->allocator, r->runner.solves, r->runner.sweep->cases[index].id, ".log");
  if (path && ambulo__read_file(path, MOST_LOG, &r->allocator, NULL, &text, &length)) text = NULL;
  if (text && text[0]) {
    text[strcspn(text, "\n")] = '\0';
    words = ambulo__strdup(&r->allocator, text);
  }
  ambulo__free(&r->allocator, text);
  ambulo__free(&r->allocator, path);
  return words;
}

/* E_PROBLEM where no condition could be solved; a warning for each that could not */
static ambulo_status check_first(const run *r, const ambulo__fit_trial *first) {
  const ambulo_fit *fit = r->fit;
  int solved = 0;
  for (int c = 0; c < fit->conditions; c++)
    solved += !fit->condition[c].held_out && first->solved[c];
  for (int c = 0; c < fit->conditions; c++) {
    char state[24];
    ambulo__place place = ambulo__yaml_place(fit->condition[c].node);
    if (first->solved[c] || (solved == 0 && fit->condition[c].held_out)) continue;
    ambulo_status status = ambulo__fit_state(&r->runner, first->index[c], state);
    if (status) return status;
    char *words = first_words(r, first->index[c]);
    if (solved == 0)
      status = ambulo__error(r->diagnostics, AMBULO_E_PROBLEM, place, words,
                             "no condition could be solved where the parameters stand; '%s' is %s; "
                             "expected a problem that has solutions",
                             fit->condition[c].name, state);
    else
      ambulo__warning(r->diagnostics, place, words,
                      "condition '%s' has no solution where the parameters stand (%s)",
                      fit->condition[c].name, state);
    ambulo__free(&r->allocator, words);
    if (status) return status;
  }
  return AMBULO_OK;
}

static ambulo_status improve(run *r) {
  ambulo__fit_outcome *o = &r->outcome;
  ambulo__fit_task task = {.fit = r->fit,
                           .allocator = &r->allocator,
                           .evaluate = evaluate,
                           .refresh = refresh,
                           .note = note,
                           .user = r};
  ambulo__fit_trial *first = &o->trial[AMBULO__FIT_FIRST], *best = &o->trial[AMBULO__FIT_BEST];
  first->cost = ambulo__fit_cost(r->fit, first);
  ambulo__fit_trial_copy(r->fit, first, best);
  r->runner.progress.first = first->distance;
  ambulo__fit_step start = {first->distance, first->cost, (double)NAN, 0, "start"};
  (void)note(r, &start);
  return ambulo__fit_search(&task, best, o->sensitivity, &o->ending, &o->stuck);
}

/* held-out conditions at the best parameters, each from where it began; then all from zero, which
 * may be better for a held-out one, too */
static ambulo_status judge(run *r) {
  ambulo__fit_outcome *o = &r->outcome;
  const ambulo__fit_trial *first = &o->trial[AMBULO__FIT_FIRST],
                          *best = &o->trial[AMBULO__FIT_BEST];
  ambulo__fit_trial *apart = &o->trial[AMBULO__FIT_APART], *cold = &o->trial[AMBULO__FIT_COLD];
  memcpy(apart->u, best->u, sizeof best->u);
  memcpy(cold->u, best->u, sizeof best->u);
  (void)snprintf(apart->label, sizeof apart->label, "fitted");
  (void)snprintf(cold->label, sizeof cold->label, "fitted, from zero");
  ambulo_status status = ambulo__fit_evaluate(&r->runner, AMBULO__FIT_HELD_OUT, first, apart, 1);
  if (!status) status = ambulo__fit_evaluate(&r->runner, AMBULO__FIT_FROM_ZERO, NULL, cold, 1);
  if (status || !cold->complete) return status;
  return ambulo__fit_take_better(&r->runner, cold, apart);
}

/* ---------------------------------------------------------------------- results */

static void note_missing_keys(const run *r) {
  for (int i = 0; i < r->fit->parameters; i++) {
    const ambulo__fit_parameter *p = &r->fit->parameter[i];
    for (int k = 0; k < p->keys; k++)
      if (isnan(p->in_file[k]))
        ambulo__note(
            r->diagnostics, ambulo__yaml_place(p->node),
            "only conditions set '%s': fitted.yaml lacks it, the conditions' 'settings' in "
            "fit.json have it",
            p->key[k]);
  }
}

static ambulo_status write_results(run *r, char **report) {
  ambulo__text_buffer problem, json, table;
  ambulo__text_init(&problem, &r->allocator);
  ambulo__text_init(&json, &r->allocator);
  ambulo__text_init(&table, &r->allocator);
  const double *u = r->outcome.trial[AMBULO__FIT_BEST].u;
  ambulo_status status = ambulo__fitted_problem(r->fit, u, r->directory, r->diagnostics, &problem);
  if (!status) status = ambulo__fit_json(&r->outcome, &json);
  if (!status) ambulo__fit_table(&r->outcome, &table);
  if (!status) status = ambulo__text_status(&table);
  char *copy = status ? NULL : ambulo__strdup(&r->allocator, ambulo__text_data(&table));
  if (!status && !copy) status = AMBULO_E_MEMORY;
  if (!status) status = write_file(r, "fitted.yaml", &problem);
  if (!status) status = write_file(r, "fit.json", &json);
  if (!status) note_missing_keys(r);
  if (!status && report) {
    *report = copy;
    copy = NULL;
  }
  ambulo__free(&r->allocator, copy);
  ambulo__text_free(&problem);
  ambulo__text_free(&json);
  ambulo__text_free(&table);
  return status;
}

/* ------------------------------------------------------------------------- run */

static ambulo_status prepare(run *r) {
  ambulo__fit_outcome *o = &r->outcome;
  o->fit = r->fit;
  o->runner = &r->runner;
  o->stuck = -1;
  for (int i = 0; i < AMBULO__FIT_PARAMETERS; i++) o->sensitivity[i] = (double)NAN;
  o->trial = ambulo__fit_trials_make(r->fit, TRIALS, &r->allocator);
  o->entry = ambulo__alloc(&r->allocator, (size_t)r->fit->iterations + 1, sizeof *o->entry);
  r->runner.progress.iterations = r->fit->iterations;
  r->runner.progress.expected = ambulo__fit_expected(r->fit);
  return o->trial && o->entry ? AMBULO_OK : AMBULO_E_MEMORY;
}

static ambulo_status run_locked(run *r, char **report) {
  ambulo__fit_trial *first = &r->outcome.trial[AMBULO__FIT_FIRST];
  (void)snprintf(first->label, sizeof first->label, "start");
  ambulo_status status = ambulo__fit_evaluate(&r->runner, AMBULO__FIT_ALL, NULL, first, 1);
  if (status) return status;
  if (!first->complete) {
    r->outcome.ending = AMBULO_FIT_INTERRUPTED;
    return AMBULO_OK;
  }
  status = ambulo__fit_refresh(&r->runner, first);
  if (!status) status = check_first(r, first);
  if (!status) status = improve(r);
  if (!status) status = judge(r);
  if (status) return status;
  if (r->runner.wish && !r->outcome.trial[AMBULO__FIT_COLD].complete)
    r->outcome.ending = AMBULO_FIT_INTERRUPTED;
  return write_results(r, report);
}

ambulo_status ambulo_fit_run(const ambulo_fit *fit, const char *directory,
                             const ambulo_fit_options *options, const ambulo_allocator *allocator,
                             ambulo_diagnostics *diagnostics, ambulo_fit_progress *end,
                             char **report) {
  ambulo_fit_options o;
  if (!AMBULO__OWN(ambulo_fit_options, &o, options)) return AMBULO_E_ARGUMENT;
  if (!fit || !directory || !acceptable(&o)) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  run r = {.fit = fit,
           .directory = directory,
           .allocator = ambulo__allocator_or_default(allocator),
           .diagnostics = diagnostics};
  int lock = -1;
  ambulo_status status =
      ambulo__fit_runner_open(fit, directory, &o, &r.allocator, diagnostics, &r.runner);
  if (!status) status = prepare(&r);
  if (!status) status = prepare_folder(&r, &lock);
  if (!status) status = run_locked(&r, report);
  ambulo__lock_release(lock);
  r.runner.progress.seconds = ambulo__seconds_now() - r.runner.begin;
  if (!status) r.runner.progress.ending = r.outcome.ending;
  if (end) *end = r.runner.progress;
  ambulo__free(&r.allocator, r.outcome.trial);
  ambulo__free(&r.allocator, r.outcome.entry);
  ambulo__fit_runner_close(&r.runner);
  return ambulo__conclude(diagnostics, errors, status, directory);
}
