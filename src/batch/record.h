/* batch/record.h - the record of a finished case: DIR/cases/<fan>/<id>.json.
 *
 * Written once, whole, after the case has ended. A case counts as finished only if its record
 * reads well and carries the key of the case (all that its result depends on). */
#ifndef AMBULO_BATCH_RECORD_H
#define AMBULO_BATCH_RECORD_H

#include "base/alloc.h"
#include "base/diagnostics.h"

typedef struct ambulo__record {
  unsigned long long key;
  char state[24];        /* a verdict, or timeout, memory, crashed, invalid, error */
  int valid;             /* 1: optimal or feasible */
  int exit_code, signal; /* -1, 0: as the process ended */
  double seconds;        /* wall time of the last attempt */
  double limit_seconds;  /* limits it ran under; 0: none */
  int limit_megabytes;
  char start[40];             /* id of the case whose solution it began from; "": none */
  unsigned long long origin;  /* hash of that id, and of what that one began from, and so on */
  double violation;           /* worst of the audit; -1: no result */
  unsigned long long summary; /* hash of summary.json; 0: no result folder belongs to it */
} ambulo__record;

typedef enum ambulo__record_found {
  AMBULO__RECORD_ABSENT,
  AMBULO__RECORD_READ,
  AMBULO__RECORD_CORRUPT
} ambulo__record_found;

ambulo__record_found ambulo__record_read(const char *directory, const char *id,
                                         const ambulo_allocator *allocator, ambulo__record *record);
ambulo_status ambulo__record_write(const char *directory, const char *id,
                                   const ambulo__record *record, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics);
/* Fills state, valid, violation and summary from the result folder of a case. 0: there is
 * none, or its summary.json cannot be read. */
int ambulo__record_take_summary(const char *directory, const char *id,
                                const ambulo_allocator *allocator, ambulo__record *record);
/* Whether the result folder still holds the summary that the record speaks of. */
int ambulo__record_summary_intact(const char *directory, const char *id,
                                  const ambulo__record *record, const ambulo_allocator *allocator);
/* Whether it ended for want of time or memory, and there is more of it now (0: no limit). */
int ambulo__record_was_cut(const ambulo__record *record, double seconds, int megabytes);

#endif
