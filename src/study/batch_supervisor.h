/* study/batch_supervisor.h - the supervisor: which case is next, and what became of the last. */
#ifndef AMBULO_STUDY_BATCH_SUPERVISOR_H
#define AMBULO_STUDY_BATCH_SUPERVISOR_H

#include "base/machine.h"
#include "study/batch_lock.h"
#include "study/case_record.h"
#include "study/sweep.h"

#include <sys/types.h>

typedef enum ambulo__case_state {
  AMBULO__CASE_ELSEWHERE, /* of another shard */
  AMBULO__CASE_WAITING,
  AMBULO__CASE_RUNNING,
  AMBULO__CASE_DONE,
  AMBULO__CASE_GIVEN_UP /* its worker was killed from outside again and again: no record */
} ambulo__case_state;

typedef struct ambulo__slot {
  pid_t process; /* 0: free */
  int index;     /* of the case */
  int from;      /* the case whose solution it starts from; -1: none */
  int cut;       /* 1: killed by us for its time, 2: because the run stops */
  double begin;  /* s */
} ambulo__slot;

typedef struct ambulo__supervisor {
  const ambulo_sweep *sweep;
  const char *directory;
  ambulo_batch_options options;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  unsigned char *state;       /* [cases] ambulo__case_state */
  unsigned char *solved;      /* [cases] 1: has a valid solution */
  unsigned char *attempts;    /* [cases] */
  unsigned char *damaged;     /* [cases] 1: told, and to be computed again */
  unsigned long long *origin; /* [cases] of those that are done: see ambulo__record */
  int *next;                  /* [cases] the case that continues from this one; -1: none */
  ambulo__slot *slot;         /* [workers] */
  int workers, cursor, finished_now;
  double case_seconds, begin;
  int case_megabytes;
  ambulo_batch_progress progress;
  ambulo_status status; /* of the run: E_IO once a worker could not write */
} ambulo__supervisor;

/* supervisor.c: solves the cases of a list that stands, as ambulo_batch_run. */
ambulo_status ambulo__batch_run(const ambulo_sweep *sweep, const char *directory,
                                const ambulo_batch_options *options,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_batch_progress *progress);

/* queue.c: reads the records of this shard's cases and fills the tables. */
ambulo_status ambulo__queue_open(ambulo__supervisor *batch);
void ambulo__queue_free(ambulo__supervisor *batch);
/* The next case that may start, or -1. A case that continues another is taken from its record
 * only once that one is done, since only then it is known what it has to start from. */
int ambulo__queue_next(ambulo__supervisor *batch);
/* The case to go on with in the same slot, or -1. */
int ambulo__queue_follower(ambulo__supervisor *batch, int index);
/* The nearest case before it in its chain with a solution; -1: none. */
int ambulo__queue_start_of(const ambulo__supervisor *batch, int index);
/* Hash of the cases whose solutions lead to this start, one from another; 0: from zero. */
unsigned long long ambulo__queue_origin(const ambulo__supervisor *batch, int index);

/* outcome.c: judges an ended worker and records the case. */
ambulo_status ambulo__outcome_record(ambulo__supervisor *batch, const ambulo__slot *slot,
                                     int wait_status);

#endif
