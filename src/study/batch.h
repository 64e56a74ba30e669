/* study/batch.h - running the cases of a study: who may, in which process, what became of each.
 *
 * A case counts once its record is on disk, and is computed again otherwise, so a run may be
 * killed anywhere. */
#ifndef AMBULO_STUDY_BATCH_H
#define AMBULO_STUDY_BATCH_H

#include "base/text_buffer.h"
#include "formats/read_file.h"
#include "study/study.h"

#include <sys/types.h>

/* -------------------------------------------------------------- batch_folder.c */

/* Creates DIR and DIR/cases; a folder that holds other things is refused. Errors: E_IO. */
ambulo_status ambulo__batch_make_folders(const char *directory, const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics);
/* Whether the folder, if it is a batch folder already, is that of this sweep: one that holds
 * another list is refused, with what changed, unless force = 1; so is one of another version. A
 * damaged list is a warning: the records carry the keys themselves. Errors: E_IO, E_PROBLEM,
 * E_MEMORY. */
ambulo_status ambulo__batch_check_folder(const ambulo_sweep *sweep, const char *directory,
                                         int force, const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics);

enum { AMBULO__HOLDER_TEXT = 96 };
/* One run, or one run per shard, in a folder at a time. *lock: to be released; accepts -1. Errors:
 * E_IO (cannot be written; held: the message names the holder), E_MEMORY. */
ambulo_status ambulo__lock_take(const char *directory, int shard, int shards,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                int *lock);
void ambulo__lock_release(int lock);
/* Who holds DIR/lock, as far as another process can tell; "" if nobody does. Errors: E_IO,
 * E_MEMORY. */
ambulo_status ambulo__lock_holder(const char *directory, const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics,
                                  char holder[AMBULO__HOLDER_TEXT]);

/* --------------------------------------------------------------- case_record.c */

/* DIR/cases/<last two digits of the id>/<id><ending>: at most 256 neighbours of a million cases
 * share a folder's fan-out, and a listing stays short. NULL: no memory. */
char *ambulo__case_path(const ambulo_allocator *allocator, const char *directory, const char *id,
                        const char *ending);

enum { AMBULO__CASE_FILES = 16, AMBULO__CASE_FILE_NAME = 64, AMBULO__DAMAGE_TEXT = 200 };

typedef struct ambulo__case_file {
  char ending[AMBULO__CASE_FILE_NAME]; /* after the id: "/motion.csv", ".log" */
  char digest[AMBULO__SHA256_TEXT];
} ambulo__case_file;

/* The files of a finished case: those of its result folder, and its log, where it has one. */
typedef struct ambulo__case_files {
  int count;
  ambulo__case_file file[AMBULO__CASE_FILES]; /* sorted by ending */
} ambulo__case_files;
int ambulo__case_files_have(const ambulo__case_files *files, const char *ending);

/* DIR/cases/<fan>/<id>.json, written once, whole, after the case has ended, and sealed
 * (formats/seal.h). */
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
  ambulo__case_files files;
} ambulo__record;

/* A case is finished if its record reads well and carries the key of the case, and all files that
 * it names are what they were. */
typedef enum ambulo__finding {
  AMBULO__FOUND_NOTHING,
  AMBULO__FOUND_STALE,   /* of other inputs, or of another version */
  AMBULO__FOUND_DAMAGED, /* cannot be read, or is not what was written */
  AMBULO__FOUND_INTACT
} ambulo__finding;

typedef struct ambulo__damage {
  char ending[AMBULO__CASE_FILE_NAME]; /* of the file; ".json": the record itself */
  char what[AMBULO__DAMAGE_TEXT];      /* "is not what was written" */
} ambulo__damage;
/* A failure to read a file of the case: E_MEMORY goes on, anything else becomes *damage (its first
 * error's text) and AMBULO_OK. */
ambulo_status ambulo__damage_of(ambulo_status status, const char *ending,
                                const ambulo_diagnostics *reasons, ambulo__damage *damage);

/* Looks at what is on disk about the case of this key; with `files`, also at each file that the
 * record names. *record: of an intact case; *damage: of a damaged one. Only a lack of memory is an
 * error (E_MEMORY): a file that cannot be read is damage. */
ambulo_status ambulo__record_find(const char *directory, const char *id, unsigned long long key,
                                  int files, const ambulo_allocator *allocator,
                                  ambulo__finding *finding, ambulo__record *record,
                                  ambulo__damage *damage);
/* `inputs`: all that it was solved from (formats/inputs.h). */
ambulo_status ambulo__record_write(const char *directory, const char *id,
                                   const ambulo__record *record, const char *inputs,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics);
/* Fills files with what stands there now, and from the result folder state, valid and violation.
 * *taken = 0: there is no result, or it is none of ours. Errors: E_IO, E_LIMIT (more files than a
 * result has), E_MEMORY. */
ambulo_status ambulo__record_take_result(const char *directory, const char *id,
                                         const ambulo_allocator *allocator,
                                         ambulo_diagnostics *diagnostics, ambulo__record *record,
                                         int *taken);
/* 0: it ended without a result. */
int ambulo__record_has_result(const ambulo__record *record);
/* Whether it ran out of time or memory, and may have more now (0: no limit); or of memory without a
 * limit, which another run may find. */
int ambulo__record_was_cut(const ambulo__record *record, double seconds, int megabytes);

/* ----------------------------------------------------------------- batch_run.c */

typedef enum ambulo__case_state {
  AMBULO__CASE_ELSEWHERE, /* of another shard */
  AMBULO__CASE_WAITING,
  AMBULO__CASE_RUNNING,
  AMBULO__CASE_DONE,
  AMBULO__CASE_GIVEN_UP /* its worker was killed from outside again and again: no record */
} ambulo__case_state;

/* What a run knows of a case. */
typedef struct ambulo__progress {
  unsigned char state;       /* ambulo__case_state */
  unsigned char solved;      /* 1: has a valid solution */
  unsigned char attempts;    /* that were killed from outside */
  unsigned char damaged;     /* 1: reported, and to be computed again */
  int next;                  /* the case that continues from this one; -1: none */
  unsigned long long origin; /* of one that is done: see ambulo__record */
} ambulo__progress;

/* What a worker says, as it comes. */
typedef struct ambulo__worker_log {
  int file; /* of a pipe; 0: closed */
  ambulo__text_buffer text;
} ambulo__worker_log;

/* A worker process. */
typedef struct ambulo__slot {
  pid_t process;             /* 0: free */
  int index;                 /* of the case */
  int from;                  /* the case whose solution it starts from; -1: none */
  unsigned long long origin; /* see ambulo__record */
  int cut;                   /* 1: killed by us for its time, 2: because the run stops */
  double begin;              /* s */
  ambulo__worker_log log;
} ambulo__slot;

typedef struct ambulo__supervisor {
  const ambulo_sweep *sweep;
  const char *directory;
  ambulo_batch_options options;
  const ambulo_allocator *allocator;
  ambulo_diagnostics *diagnostics;
  ambulo__progress *of; /* [cases] */
  ambulo__slot *slot;   /* [workers] */
  int workers, cursor, finished_now;
  double case_seconds, begin;
  int case_megabytes;
  ambulo_batch_progress progress;
  ambulo_status status; /* of the run: E_IO once a worker could not write */
} ambulo__supervisor;

/* Solves the cases of a list that stands, as ambulo_batch_run. */
ambulo_status ambulo__batch_run(const ambulo_sweep *sweep, const char *directory,
                                const ambulo_batch_options *options,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_batch_progress *progress);

/* Reads the records of this shard's cases. */
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

/* --------------------------------------------------------------- batch_tally.c */

/* A case is done: counts its state, and keeps what the first one without a result said. `log`: what
 * its worker said; NULL: as it stands on disk. */
void ambulo__tally_case(ambulo__supervisor *batch, int index, const ambulo__record *record,
                        const char *log);
/* The beginning of the line with a worker's first error; NULL: it has none. */
const char *ambulo__first_error(const char *log);

/* -------------------------------------------------------------- batch_worker.c */

/* Starts `ambulo solve` of the slot's case in a process group of its own, so that Ctrl-C reaches
 * the supervisor alone. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__worker_start(const ambulo__supervisor *batch, ambulo__slot *slot);
/* Judges a worker that has ended, and records the case or has it tried again. What it said is
 * written to DIR/cases/<fan>/<id>.log; its first error ends the run when the disk was at fault. */
ambulo_status ambulo__worker_end(ambulo__supervisor *batch, ambulo__slot *slot, int wait_status);
/* Removes what killed workers left half-written in the folder of this path (formats/atomic_file.h):
 * entries "<name>.tmp-...", "<name>.old-..." whose names begin so. */
void ambulo__clean_folder(const char *path, const char *begin);

/* ---------------------------------------------------------------- worker_log.c */

/* Opens the pipe, and returns the end for the worker, which the caller closes; -1 with errno. */
int ambulo__worker_log_open(ambulo__worker_log *log, const ambulo_allocator *allocator);
/* Takes in what has been said so far, 1 MB at most; 0, or -1 with errno. */
int ambulo__worker_log_read(ambulo__worker_log *log);
/* Writes it to a file; silence writes none. Errors: E_IO, E_MEMORY. */
ambulo_status ambulo__worker_log_write(const ambulo__worker_log *log, const char *path,
                                       ambulo_diagnostics *diagnostics);
void ambulo__worker_log_close(ambulo__worker_log *log);

#endif
