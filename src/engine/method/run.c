/* method/run.c - see run.h. */
#include "method/run.h"

#include "base/alloc.h"
#include "method/parameters.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

void ambulo__run_begin(ambulo__run *run, const ambulo_options *options) {
  memset(run, 0, sizeof *run);
  run->options = options;
  run->started = run->polled_at = ambulo__seconds_now();
  run->stage = "set-up";
  run->nlopt.result_name = "";
}

static void stop(ambulo__run *run, ambulo_ending ending) {
  if (run->stopped) return;
  run->stopped = 1;
  run->stopped_at = ambulo__seconds_now();
  run->ending = ending;
}

int ambulo__run_over(ambulo__run *run) {
  const ambulo_options *o = run->options;
  if (run->evaluations >= o->maximum_evaluations) stop(run, AMBULO_ENDING_EVALUATIONS);
  if (o->time_limit > 0.0 && ambulo__seconds_now() - run->started >= o->time_limit)
    stop(run, AMBULO_ENDING_TIME);
  return run->stopped;
}

int ambulo__run_count(ambulo__run *run) {
  run->evaluations++;
  return ambulo__run_poll(run);
}

int ambulo__run_progress(ambulo__run *run, double objective, double violation) {
  const ambulo_options *o = run->options;
  if (!o->progress) return run->stopped;
  ambulo_progress progress = {
      .iteration = run->iterations,
      .evaluations = run->evaluations,
      .objective = objective,
      .violation = violation,
      .seconds = ambulo__seconds_now() - run->started,
      .time_limit = o->time_limit,
      .seconds_left = AMBULO_OFF,
      .stage = run->stage,
      .best = NAN,
      .problem = run->problem,
      .point = run->point,
  };
  if (o->progress(o->user, &progress)) stop(run, AMBULO_ENDING_CALLER);
  return run->stopped;
}

int ambulo__run_iteration(ambulo__run *run, int intervals, double objective, double violation,
                          double gradient) {
  ambulo_iteration iteration = {.iteration = run->iterations,
                                .evaluations = run->evaluations,
                                .intervals = intervals,
                                .objective = objective,
                                .violation = violation,
                                .gradient = gradient,
                                .seconds = ambulo__seconds_now() - run->started};
  ambulo__history_add(run->history, &iteration);
  return ambulo__run_progress(run, objective, violation);
}

const char *ambulo__nlopt_name(int result) {
  const char *name = nlopt_result_to_string((nlopt_result)result);
  return name ? name : "unknown result";
}

void ambulo__run_nlopt(ambulo__run *run, int result, double seconds) {
  run->nlopt.calls++;
  run->nlopt.result = result;
  run->nlopt.result_name = ambulo__nlopt_name(result);
  run->nlopt.seconds += seconds;
}

void ambulo__run_end(ambulo__run *run, ambulo_ending ending) {
  if (!run->stopped) run->ending = ending;
}

void ambulo__run_fault(ambulo__run *run, const ambulo_fault *fault) {
  if (run->faults++ == 0) run->first_fault = *fault;
  if (run->faults_lately++ == 0) run->fault = *fault;
}

void ambulo__run_forgive(ambulo__run *run) {
  run->faults_lately = run->breakdowns = 0;
}

int ambulo__run_poll(ambulo__run *run) {
  if (!run) return 0;
  double now = ambulo__seconds_now();
  if (!run->stopped && now - run->polled_at >= AMBULO__POLL_INTERVAL) {
    run->polled_at = now;
    (void)ambulo__run_progress(run, NAN, NAN);
  }
  return ambulo__run_over(run);
}

static int ask(void *run) {
  return ambulo__run_poll(run);
}

ambulo__poll ambulo__run_poller(ambulo__run *run) {
  return (ambulo__poll){ask, run};
}

int ambulo__run_late(const ambulo__run *run) {
  if (run->ending != AMBULO_ENDING_TIME && run->ending != AMBULO_ENDING_CALLER) return 0;
  double grace = AMBULO__GRACE_SHARE * (run->stopped_at - run->started);
  if (grace < AMBULO__GRACE_LEAST) grace = AMBULO__GRACE_LEAST;
  return run->stopped && ambulo__seconds_now() - run->stopped_at > grace;
}

/*
 * Of each grid there are the iterations whose number on it is a multiple of `every`, and its last
 * one: an iteration that is no multiple gives way to the next of its grid. When the memory is full,
 * `every` doubles, and of each grid every other item goes. What is kept follows from the iterations
 * alone, not from the clock.
 */

enum { LARGEST = 1 << 20 };

ambulo__history *ambulo__history_create(const ambulo_allocator *allocator) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo__history *history = ambulo__alloc(&a, 1, sizeof *history);
  if (!history) return NULL;
  history->shown = (ambulo_history){.items = history->item, .every = 1};
  return history;
}

/* how many of `count` items are left; goes_on: the last grid has a next iteration */
static int thin(ambulo_iteration *item, int count, int goes_on) {
  int kept = 0, place = 0; /* place on its grid */
  for (int i = 0, before = -1; i < count; i++) {
    int intervals = item[i].intervals;
    int is_last = i + 1 < count ? item[i + 1].intervals != intervals : !goes_on;
    place = intervals == before ? place + 1 : 0;
    before = intervals;
    if (place % 2 == 0 || is_last) item[kept++] = item[i];
  }
  return kept;
}

void ambulo__history_add(ambulo__history *history, const ambulo_iteration *iteration) {
  if (!history) return;
  ambulo_history *shown = &history->shown;
  int count = shown->count;
  int goes_on = count > 0 && history->item[count - 1].intervals == iteration->intervals;
  history->number = goes_on ? history->number + 1 : 0;
  if (goes_on && history->passing) count--;
  if (count == AMBULO__HISTORY_MOST) {
    int kept = thin(history->item, count, goes_on);
    if (kept < count && shown->every < LARGEST) shown->every *= 2;
    count = kept < count ? kept : count - 1; /* of more grids than a solve has */
  }
  history->item[count] = *iteration;
  history->passing = history->number % shown->every != 0;
  shown->count = count + 1;
}
