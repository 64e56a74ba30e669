/* cli/watch.c - see watch.h.
 *
 * Work is time of the processor: on an idle one a second of it is a second, on a busy one the
 * solver has had the second that it needs to end well. Whatever stands still for ten seconds is
 * ended too. Once give_up was called nobody gets the lock again. The thread of the solve then
 * stops at its next progress, and does not take apart what is being written. */
#include "cli/watch.h"

#include "cli/output.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double most_work = 1.0, most_wait = 10.0; /* s, from a reason to end on */
enum { LOOK_NANOSECONDS = 50000000 };

static double seconds_of(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double ambulo__cli_watch_seconds(const ambulo__cli_watch *w) {
  return seconds_of(CLOCK_MONOTONIC) - w->began;
}

static ambulo_ending reason(const ambulo__cli_watch *w, double now) {
  if (ambulo__cli_stops() > 0) return AMBULO_ENDING_CALLER;
  if (w->limit > 0.0 && now - w->began >= w->limit) return AMBULO_ENDING_TIME;
  return AMBULO_ENDING_NONE;
}

/* with the lock */
static void look(ambulo__cli_watch *w) {
  double now = seconds_of(CLOCK_MONOTONIC), work = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
  ambulo_ending ending = reason(w, now);
  if (!ending) return;
  if (w->stop_seen < 0.0) {
    w->stop_seen = now;
    w->work_seen = work;
  }
  if (work - w->work_seen < most_work && now - w->stop_seen < most_wait) return;
  w->last.seconds = now - w->began;
  w->give_up(w->user, &w->last, ending);
}

static void *watch(void *user) {
  ambulo__cli_watch *w = user;
  pthread_mutex_lock(&w->lock);
  while (!w->over) {
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += LOOK_NANOSECONDS;
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    if (pthread_cond_timedwait(&w->wake, &w->lock, &until) == ETIMEDOUT && !w->over) look(w);
  }
  pthread_mutex_unlock(&w->lock);
  return NULL;
}

void ambulo__cli_watch_begin(ambulo__cli_watch *w) {
  sigset_t all, before;
  w->point = calloc((size_t)ambulo_problem_variable_count(w->problem), sizeof *w->point);
  w->last = (ambulo_progress){.objective = NAN, .violation = NAN, .stage = ""};
  w->began = seconds_of(CLOCK_MONOTONIC);
  w->stop_seen = -1.0;
  w->over = w->threaded = 0;
  if (!w->point) return;
  pthread_mutex_init(&w->lock, NULL);
  pthread_cond_init(&w->wake, NULL);
  sigfillset(&all); /* signals are the first thread's */
  pthread_sigmask(SIG_SETMASK, &all, &before);
  w->threaded = pthread_create(&w->thread, NULL, watch, w) == 0;
  pthread_sigmask(SIG_SETMASK, &before, NULL);
}

/* Points of other grids are left out, and of problems with other numbers; the first of a run over
 * free numbers has those of the file. */
void ambulo__cli_watch_note(ambulo__cli_watch *w, const ambulo_progress *p) {
  if (!w->threaded) return;
  int known = p->problem == w->problem || p->solve == 1;
  pthread_mutex_lock(&w->lock);
  int n = ambulo_problem_variable_count(w->problem);
  if (known && p->point && ambulo_problem_variable_count(p->problem) == n) {
    memcpy(w->point, p->point, (size_t)n * sizeof *w->point);
    w->last.point = w->point;
  }
  w->last.iteration = p->iteration;
  w->last.evaluations = p->evaluations;
  pthread_mutex_unlock(&w->lock);
}

void ambulo__cli_watch_end(ambulo__cli_watch *w) {
  if (w->threaded) {
    pthread_mutex_lock(&w->lock);
    w->over = 1;
    pthread_cond_signal(&w->wake);
    pthread_mutex_unlock(&w->lock);
    pthread_join(w->thread, NULL);
  }
  if (w->point) {
    pthread_mutex_destroy(&w->lock);
    pthread_cond_destroy(&w->wake);
  }
  free(w->point);
  w->point = NULL;
  w->threaded = 0;
}
