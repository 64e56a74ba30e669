/* study/front_run.c - a batch whose cases follow from each other's results: a front (front.h).
 *
 * A round asks for all that can be solved at once, and runs the batch with the longer list. What to
 * ask for follows from the points before it alone, so to resume is to repeat: rounds whose records
 * are intact are read, and only the first that is not is run. Neither the number of processes nor
 * an interruption changes what is asked for. */
#include "base/machine.h"
#include "base/sized.h"
#include "study/results.h"

#include <math.h>
#include <string.h>

enum { MOST_SOLVES = 3, MOST_PASSES = 3 };

typedef struct runner {
  ambulo_sweep sweep; /* the caller's, with cases of its own, which grow */
  const char *directory;
  ambulo_batch_options options;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__front front;
  int room;     /* points that fit */
  int known;    /* the first so many points have been read */
  int wish;     /* of the caller: 1, 2: stop */
  int computed; /* of rounds that have ended */
  int seen;     /* done of the round at hand, found finished */
  double begin, seconds_per_case;
  ambulo_batch_progress progress;
} runner;

/* --------------------------------------------------------------------- reading */

/* *known: the case needs no run */
static ambulo_status read_point(runner *r, int k, int *known) {
  const ambulo__sweep_case *one = &r->sweep.cases[k];
  ambulo__finding finding;
  ambulo__record record;
  ambulo__damage damage;
  double seconds = r->options.case_seconds > 0.0 ? r->options.case_seconds : r->sweep.case_seconds;
  int megabytes =
      r->options.case_megabytes > 0 ? r->options.case_megabytes : r->sweep.case_megabytes;
  ambulo_status status = ambulo__record_find(r->directory, one->id, one->key, 1, r->allocator,
                                             &finding, &record, &damage);
  if (status) return status;
  *known = finding == AMBULO__FOUND_INTACT && !ambulo__record_was_cut(&record, seconds, megabytes);
  if (!*known || !record.valid) return AMBULO_OK;
  return ambulo__front_read_point(r->directory, one->id, &r->front, r->allocator, r->diagnostics,
                                  &r->front.point[k]);
}

/* goes on to the first case that is not known */
static ambulo_status read_points(runner *r) {
  int known = 1;
  ambulo_status status = AMBULO_OK;
  while (r->known < r->front.points && known && !status) {
    status = read_point(r, r->known, &known);
    r->known += known && !status;
  }
  return status;
}

/* ---------------------------------------------------------------------- asking */

static ambulo_status append(runner *r, const ambulo__front_request *request) {
  int index = 0;
  ambulo_status status = ambulo__sweep_append_point(&r->sweep, request, r->diagnostics, &index);
  if (status || index < r->front.points) return status;
  ambulo__front_point *p = &r->front.point[r->front.points++];
  memset(p, 0, sizeof *p);
  memcpy(p->weight, request->weight, sizeof p->weight);
  memcpy(p->parent, request->parent, sizeof p->parent);
  p->from = request->from;
  return AMBULO_OK;
}

/* *count of new cases; 0: the front is done */
static ambulo_status ask(runner *r, ambulo__front_request *requests, int *count) {
  int before = r->front.points;
  ambulo_status status =
      ambulo__front_ask(&r->front, r->allocator, requests, r->room - before, count);
  for (int i = 0; i < *count && !status; i++) status = append(r, &requests[i]);
  *count = r->front.points - before;
  return status;
}

/* --------------------------------------------------------------------- running */

static int show(void *user, const ambulo_batch_progress *batch) {
  runner *r = user;
  ambulo_batch_progress p = *batch;
  int fresh = batch->done - batch->resumed, made = r->computed + fresh;
  p.resumed = batch->done - made;
  if (p.cases < r->front.wanted) p.cases = r->front.wanted;
  p.seconds = ambulo__seconds_now() - r->begin;
  p.seconds_left = made > 0 ? p.seconds / made * (p.cases - p.done) : AMBULO_OFF;
  if (isnan(p.worst_violation) || r->progress.worst_violation > p.worst_violation) {
    p.worst_violation = r->progress.worst_violation;
    p.worst = r->progress.worst;
  }
  r->progress = p;
  int wish = r->options.progress ? r->options.progress(r->options.user, &p) : 0;
  if (wish > r->wish) r->wish = wish;
  return r->wish;
}

static ambulo_status run_list(runner *r, int *fresh) {
  ambulo_batch_options o = r->options;
  ambulo_batch_progress end;
  memset(&end, 0, sizeof end);
  o.force = 1; /* the list grows; whether the inputs are the same was asked before */
  o.progress = show;
  o.user = r;
  r->sweep.trusted = r->known;
  ambulo_status status =
      ambulo__batch_run(&r->sweep, r->directory, &o, r->allocator, r->diagnostics, &end);
  *fresh = end.done - end.resumed;
  r->computed += *fresh;
  return status;
}

/* *ended = 1: nothing is left to ask for; 0: stopped, or a case is abandoned */
static ambulo_status replay(runner *r, ambulo__front_request *requests, int *ended) {
  ambulo_status status = AMBULO_OK;
  int count = 1, fresh = 0;
  *ended = 0;
  while (!status && count > 0) {
    status = ask(r, requests, &count);
    if (!status) status = read_points(r);
    if (status || r->known == r->front.points) continue;
    status = run_list(r, &fresh);
    if (!status) status = read_points(r);
    if (!status && r->known < r->front.points) return AMBULO_OK;
  }
  *ended = !status;
  return status;
}

/* Rounds until nothing is left to ask for; then the whole list once more, which finds all of it
 * done. Where that computes a case again after all (what it starts from has come to another end),
 * the rounds are gone through again. */
static ambulo_status run_rounds(runner *r, ambulo__front_request *requests) {
  ambulo_status status = AMBULO_OK;
  int ended = 1, fresh = 1;
  for (int pass = 0; pass < MOST_PASSES && ended && fresh > 0 && !status; pass++) {
    if (pass > 0) memset(r->front.point, 0, (size_t)r->room * sizeof *r->front.point);
    r->front.points = r->known = 0;
    status = replay(r, requests, &ended);
    if (!status && ended && !r->wish) status = run_list(r, &fresh);
    if (r->wish) break;
  }
  if (ended && !status) r->progress.cases = r->sweep.case_count;
  return status;
}

static ambulo_status run(const ambulo_sweep *sweep, runner *r) {
  r->room = MOST_SOLVES * sweep->front.wanted + AMBULO__FRONT_TERMS * (AMBULO__FRONT_ROUNDS + 1);
  r->front = sweep->front;
  r->front.point = ambulo__alloc(r->allocator, (size_t)r->room, sizeof *r->front.point);
  ambulo__front_request *requests = ambulo__alloc(r->allocator, (size_t)r->room, sizeof *requests);
  ambulo_status status = r->front.point && requests ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__batch_check_folder(sweep, r->directory, r->options.force, r->allocator,
                                        r->diagnostics);
  if (!status) status = run_rounds(r, requests);
  ambulo__free(r->allocator, requests);
  ambulo__free(r->allocator, r->front.point);
  return status;
}

static ambulo_status run_front(const ambulo_sweep *sweep, const char *directory,
                               const ambulo_batch_options *options,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo_batch_progress *progress) {
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  runner r = {.directory = directory,
              .options = *options,
              .allocator = &own,
              .diagnostics = diagnostics,
              .begin = ambulo__seconds_now(),
              .sweep = ambulo__sweep_without_cases(sweep)};
  ambulo__place place = {sweep->path, 0, 0, "front"};
  r.progress.worst_violation = AMBULO_OFF;
  ambulo_status status = AMBULO_OK;
  if (r.options.shards != 1)
    status =
        ambulo__error(diagnostics, AMBULO_E_ARGUMENT, place,
                      "one process fills the folder of a front, with as many workers as you like",
                      "the points of a front follow from each other; expected no shards (got "
                      "%d)",
                      r.options.shards);
  if (!status) status = run(sweep, &r);
  /* names of cases live no longer than the list */
  r.progress.worst = r.progress.last = NULL;
  if (progress) *progress = r.progress;
  ambulo__sweep_free_cases(&r.sweep);
  return ambulo__conclude(diagnostics, errors, status, directory);
}

ambulo_status ambulo_batch_run(const ambulo_sweep *sweep, const char *directory,
                               const ambulo_batch_options *options,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo_batch_progress *progress) {
  ambulo_batch_options own;
  if (!sweep || !directory || !AMBULO__OWN(ambulo_batch_options, &own, options))
    return AMBULO_E_ARGUMENT;
  if (sweep->front.terms > 0)
    return run_front(sweep, directory, &own, allocator, diagnostics, progress);
  return ambulo__batch_run(sweep, directory, options, allocator, diagnostics, progress);
}

/* --------------------------------------------------------- warnings */

/* mean gaps; narrower ones are as even as points can be */
static const double wide = 1.5;

static void warn_of_gap(const ambulo__table *t, const ambulo__front_gap *gap,
                        ambulo_diagnostics *diagnostics) {
  const ambulo__sweep_case *cases = t->study->cases;
  const ambulo__front_point *point = t->front.point;
  ambulo__place place = {t->directory, 0, 0, NULL};
  ambulo__warning(diagnostics, place,
                  "no sum of the terms has its least there: the front is not convex, or straight; "
                  "or its solves fail",
                  "no weights lead between the points '%s' and '%s' (gap of %.1f mean gaps; "
                  "%s %.4g to %.4g)",
                  cases[gap->a].name, cases[gap->b].name, gap->length / t->report.mean,
                  t->front.name[0], point[gap->a].value[0], point[gap->b].value[0]);
}

static ambulo_status warn_of_gaps(const ambulo__table *t, ambulo_diagnostics *diagnostics,
                                  ambulo_front_census *census) {
  const ambulo_allocator *a = &t->study->allocator;
  int gaps = 0;
  ambulo__front_gap *gap = ambulo__alloc(a, (size_t)t->report.on + 1, sizeof *gap);
  if (!gap) return AMBULO_E_MEMORY;
  ambulo__front_gaps(&t->front, gap, &gaps);
  for (int i = 0; i < gaps; i++) {
    if (!gap[i].refused || gap[i].length <= wide * t->report.mean) continue;
    census->refused++;
    warn_of_gap(t, &gap[i], diagnostics);
  }
  ambulo__free(a, gap);
  return AMBULO_OK;
}

ambulo_status ambulo__front_census(const ambulo__table *t, ambulo_diagnostics *diagnostics,
                                   ambulo_front_census *census) {
  const ambulo__front *f = &t->front;
  const ambulo__front_report *report = &t->report;
  ambulo__place place = {t->directory, 0, 0, NULL};
  *census = (ambulo_front_census){.terms = f->terms,
                                  .wanted = f->wanted,
                                  .points = report->on,
                                  .left_out = report->beaten + report->dominated,
                                  .largest_gap = report->largest,
                                  .mean_gap = report->mean};
  for (int i = 0; i < f->terms && i < f->points; i++)
    if (!f->point[i].solved && !t->damage[i].what[0])
      ambulo__warning(diagnostics, place, "a front needs all its ends",
                      "no front: '%s' has no valid solution", t->study->cases[i].name);
  if (report->complete && !report->conflict)
    ambulo__warning(diagnostics, place, NULL,
                    "no front: the terms are not at odds, one motion is best for all");
  return f->terms == 2 && report->on > 1 ? warn_of_gaps(t, diagnostics, census) : AMBULO_OK;
}
