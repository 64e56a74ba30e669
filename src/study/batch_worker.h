/* study/batch_worker.h - the process of one case: `ambulo solve` with the case's overrides. */
#ifndef AMBULO_STUDY_BATCH_WORKER_H
#define AMBULO_STUDY_BATCH_WORKER_H

#include "ambulo/tools/batch.h"
#include "base/alloc.h"

#include <sys/types.h>

typedef struct ambulo__worker_job {
  const char *program;   /* NULL: /proc/self/exe */
  const char *base;      /* problem file */
  const char *directory; /* of the batch */
  const ambulo_case *one;
  const char *start_id; /* case whose solution it starts from; NULL: zero */
  int megabytes;        /* address space; 0: no limit */
} ambulo__worker_job;

/* Starts the process in a process group of its own, so that Ctrl-C reaches the supervisor
 * alone; what it says goes to DIR/cases/<fan>/<id>.log. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__worker_start(const ambulo__worker_job *job, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, pid_t *process);

#endif
