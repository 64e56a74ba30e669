/* solver/run.c - see run.h. */
#include "solver/run.h"

#include <string.h>

void ambulo__run_begin(ambulo__run *run, const ambulo_options *options) {
  memset(run, 0, sizeof *run);
  run->options = options;
  run->started = ambulo__seconds_now();
  run->ending = AMBULO__ENDED_BY_ITSELF;
}

static void stop(ambulo__run *run, ambulo__ending_kind ending) {
  if (run->stopped) return;
  run->stopped = 1;
  run->ending = ending;
}

int ambulo__run_over(ambulo__run *run) {
  const ambulo_options *o = run->options;
  if (run->evaluations >= o->maximum_evaluations) stop(run, AMBULO__ENDED_BY_LIMIT);
  if (o->time_limit > 0.0 && ambulo__seconds_now() - run->started >= o->time_limit)
    stop(run, AMBULO__ENDED_BY_LIMIT);
  return run->stopped;
}

int ambulo__run_count(ambulo__run *run) {
  run->evaluations++;
  return ambulo__run_over(run);
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
      .seconds_left = -1.0,
  };
  if (o->progress(o->user, &progress)) stop(run, AMBULO__ENDED_BY_CALLER);
  return run->stopped;
}
