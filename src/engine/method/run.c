/* method/run.c - see run.h. */
#include "method/run.h"
#include "method/parameters.h"

#include <math.h>
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

void ambulo__run_nlopt(ambulo__run *run, int result, const char *name, double seconds) {
  run->nlopt.calls++;
  run->nlopt.result = result;
  run->nlopt.result_name = name;
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
