/* cli/watch.h - a solve ends in time, whatever it does.
 *
 * The solver ends by itself within a tenth of a second of its limit or of Ctrl-C, but for places
 * where it cannot look: within one step of NLopt's SLSQP, which takes half a minute for a walk, and
 * in sensitivities. A thread watches. When a limit was met, or a stop was asked for, and the
 * process has worked for another second since, it calls `give_up`, which writes what there is and
 * ends the program. */
#ifndef AMBULO_CLI_WATCH_H
#define AMBULO_CLI_WATCH_H

#include "ambulo/ambulo.h"

#include <pthread.h>

typedef struct ambulo__cli_watch {
  /* Never returns. Meanwhile the program's first thread goes on, until it asks for the watch. */
  void (*give_up)(void *user, const ambulo_progress *last, ambulo_ending ending);
  void *user;
  const ambulo_problem *problem; /* whose points are kept */
  double limit, began;           /* s; off: there is none */
  double stop_seen, work_seen;   /* when a reason to end was first seen; s, and s of work */
  ambulo_progress last;
  double *point;
  int over, threaded;
  pthread_t thread;
  pthread_mutex_t lock;
  pthread_cond_t wake;
} ambulo__cli_watch;

/* From `give_up`, `user`, `problem`, `limit`, all set. Without memory or a thread there is no
 * watch; the solve is as good. */
void ambulo__cli_watch_begin(ambulo__cli_watch *watch);
/* The solve's progress, in its own thread. */
void ambulo__cli_watch_note(ambulo__cli_watch *watch, const ambulo_progress *progress);
/* s since it began. */
double ambulo__cli_watch_seconds(const ambulo__cli_watch *watch);
/* The solve is back. Does not return once `give_up` was called. */
void ambulo__cli_watch_end(ambulo__cli_watch *watch);

#endif
