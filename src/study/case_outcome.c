/* study/case_outcome.c - what the end of a worker means for its case.
 *
 * Recorded: whatever the case itself brought about (a verdict, invalid input, a crash, its time
 * or memory used up). Not recorded, and tried again: what came from outside (SIGKILL, SIGTERM
 * and their like). What the disk brought about (a folder that cannot be written) ends the run. */
#include "formats/read_file.h"
#include "base/machine.h"
#include "study/case_path.h"
#include "study/batch_supervisor.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_ATTEMPTS = 20, MOST_LOG_BYTES = 1 << 20, NOT_STARTED = 127, SIGNAL_BASE = 128 };

static int from_outside(int number) {
  return number == SIGKILL || number == SIGTERM || number == SIGINT || number == SIGHUP ||
         number == SIGQUIT;
}

/* first line of the worker's log in the message */
static ambulo_status disk_trouble(ambulo__supervisor *batch, const char *id) {
  if (batch->status) return batch->status; /* said once */
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, ".log"), *text = NULL;
  size_t length = 0;
  if (path && ambulo__read_file(path, MOST_LOG_BYTES, batch->allocator, NULL, &text, &length))
    text = NULL;
  const char *error = text ? strstr(text, "error[") : NULL;
  if (error && strstr(error, "]: ")) error = strstr(error, "]: ") + 3;
  if (!error) error = text && text[0] ? text : "its log says nothing";
  ambulo__place place = {batch->directory, 0, 0, NULL};
  ambulo_status status = ambulo__error(batch->diagnostics, AMBULO_E_IO, place,
                                       "what is finished is kept; run the same command again",
                                       "case %s: %.*s", id, (int)strcspn(error, "\n"), error);
  ambulo__free(batch->allocator, text);
  ambulo__free(batch->allocator, path);
  return status;
}

/* what is to become of the case */
typedef enum judgement { RECORDED, AGAIN, DISK } judgement;

/* it ended without a result: what stands there of one does not count, its log does */
static judgement without_result(ambulo__record *record, const char *state) {
  ambulo__case_files *files = &record->files;
  int kept = 0;
  for (int i = 0; i < files->count; i++)
    if (files->file[i].ending[0] != '/') files->file[kept++] = files->file[i];
  files->count = kept;
  record->valid = 0;
  record->violation = -1.0;
  (void)snprintf(record->state, sizeof record->state, "%s", state);
  return RECORDED;
}

/* a worker that exited; `taken`: it left a result */
static judgement judge_exit(int code, int taken, ambulo__record *record) {
  record->exit_code = code;
  if (code == 4 || code == NOT_STARTED) return DISK;
  if (code > SIGNAL_BASE && from_outside(code - SIGNAL_BASE)) return AGAIN;
  if (code <= 1 && taken) return RECORDED;
  if (code == 0) return AGAIN;
  return without_result(record, code == 2 || code == 3 ? "invalid"
                                : code == 5            ? "memory"
                                                       : "error");
}

static judgement judge(const ambulo__slot *slot, int wait_status, int taken,
                       ambulo__record *record) {
  if (WIFEXITED(wait_status)) return judge_exit(WEXITSTATUS(wait_status), taken, record);
  record->signal = WTERMSIG(wait_status);
  if (slot->cut == 1) return without_result(record, "timeout");
  return from_outside(record->signal) ? AGAIN : without_result(record, "crashed");
}

/* an empty log says nothing; one of a case that was solved is kept when it has warnings */
static ambulo_status drop_empty_log(const ambulo__supervisor *batch, const char *id) {
  struct stat entry;
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, ".log");
  if (!path) return AMBULO_E_MEMORY;
  if (stat(path, &entry) == 0 && entry.st_size == 0) (void)unlink(path);
  ambulo__free(batch->allocator, path);
  return AMBULO_OK;
}

static ambulo_status keep(ambulo__supervisor *batch, int index, const ambulo__record *record) {
  const ambulo__sweep_case *one = &batch->sweep->cases[index];
  ambulo_status status =
      ambulo__record_write(batch->directory, one->id, record, batch->allocator, batch->diagnostics);
  if (status) return status;
  ambulo_batch_progress *p = &batch->progress;
  batch->state[index] = AMBULO__CASE_DONE;
  batch->solved[index] = (unsigned char)record->valid;
  batch->origin[index] = record->origin;
  batch->finished_now++;
  p->done++;
  p->failed += !record->valid;
  p->last = one->name;
  (void)snprintf(p->last_state, sizeof p->last_state, "%s", record->state);
  if (record->violation >= 0.0 && !(record->violation <= p->worst_violation)) {
    p->worst_violation = record->violation;
    p->worst = one->name;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__outcome_record(ambulo__supervisor *batch, const ambulo__slot *slot,
                                     int wait_status) {
  const ambulo__sweep_case *one = &batch->sweep->cases[slot->index];
  ambulo__record record;
  memset(&record, 0, sizeof record);
  record.key = one->key;
  record.exit_code = -1;
  record.violation = -1.0;
  record.origin = ambulo__queue_origin(batch, slot->index);
  if (slot->from >= 0)
    (void)snprintf(record.start, sizeof record.start, "%s", batch->sweep->cases[slot->from].id);
  record.seconds = ambulo__seconds_now() - slot->begin;
  record.limit_seconds = batch->case_seconds;
  record.limit_megabytes = batch->case_megabytes;
  int taken = 0;
  batch->state[slot->index] = AMBULO__CASE_WAITING;
  ambulo_status status = drop_empty_log(batch, one->id);
  if (!status)
    status = ambulo__record_take_result(batch->directory, one->id, batch->allocator,
                                        batch->diagnostics, &record, &taken);
  if (status) return status;
  judgement judged = judge(slot, wait_status, taken, &record);
  if (judged == RECORDED) return keep(batch, slot->index, &record);
  if (judged == DISK) return disk_trouble(batch, one->id);
  if (slot->cut == 0 && ++batch->attempts[slot->index] == MOST_ATTEMPTS) {
    batch->state[slot->index] = AMBULO__CASE_GIVEN_UP;
    ambulo__place place = {batch->directory, 0, 0, NULL};
    ambulo__warning(batch->diagnostics, place, "is the machine out of memory?",
                    "case %s was killed from outside %d times; left out of this run", one->id,
                    MOST_ATTEMPTS);
  }
  return AMBULO_OK;
}
