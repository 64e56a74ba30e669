/* study/case_record.h - the record of a finished case: DIR/cases/<fan>/<id>.json.
 *
 * Written once, whole, after the case has ended, and sealed (formats/seal.h). A case counts as
 * finished only if its record reads well, carries the key of the case (all that its result depends
 * on), and all files that it names are what they were. */
#ifndef AMBULO_STUDY_CASE_RECORD_H
#define AMBULO_STUDY_CASE_RECORD_H

#include "study/case_files.h"

typedef struct ambulo__record {
  unsigned long long key;
  char state[24];        /* a verdict, or timeout, memory, crashed, invalid, error */
  int valid;             /* 1: optimal or feasible */
  int exit_code, signal; /* -1, 0: as the process ended */
  double seconds;        /* wall time of the last attempt */
  double limit_seconds;  /* limits it ran under; 0: none */
  int limit_megabytes;
  char start[40];            /* id of the case whose solution it began from; "": none */
  unsigned long long origin; /* hash of that id, and of what that one began from, and so on */
  double violation;          /* worst of the audit; -1: no result */
  ambulo__case_files files;  /* result folder, where the case has one, and log */
} ambulo__record;

typedef enum ambulo__finding {
  AMBULO__FOUND_NOTHING,
  AMBULO__FOUND_STALE,   /* of other inputs, or written by a version without checksums */
  AMBULO__FOUND_DAMAGED, /* cannot be read, or is not what was written */
  AMBULO__FOUND_INTACT
} ambulo__finding;

/* Looks at what is on disk about the case of this key; with `files`, also at each file that the
 * record names. *record: of an intact case; *damage: of a damaged one. Only a lack of memory is an
 * error (E_MEMORY): a file that cannot be read is damage. */
ambulo_status ambulo__record_find(const char *directory, const char *id, unsigned long long key,
                                  int files, const ambulo_allocator *allocator,
                                  ambulo__finding *finding, ambulo__record *record,
                                  ambulo__damage *damage);
ambulo_status ambulo__record_write(const char *directory, const char *id,
                                   const ambulo__record *record, const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics);
/* Fills files, and from the result folder state, valid and violation. *taken = 0: there is no
 * result, or it is none of ours. Errors: E_IO, E_LIMIT, E_MEMORY. */
ambulo_status ambulo__record_take_result(const char *directory, const char *id,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__record *record,
                                         int *taken);
/* Whether it ended for want of time or memory, and there is more of it now (0: no limit). */
int ambulo__record_was_cut(const ambulo__record *record, double seconds, int megabytes);

#endif
