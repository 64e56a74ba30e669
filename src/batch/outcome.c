/* batch/outcome.c - what the end of a worker means for its case.
 *
 * Recorded: whatever the case itself brought about (a verdict, invalid input, a crash, its time
 * or memory used up). Not recorded, and tried again: what came from outside (SIGKILL, SIGTERM
 * and their like). What the disk brought about (a folder that cannot be written) ends the run. */
#include "base/read_file.h"
#include "batch/paths.h"
#include "batch/run.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_ATTEMPTS = 20, MOST_LOG_BYTES = 1 << 20, NOT_STARTED = 127, SIGNAL_BASE = 128 };

static int from_outside(int number) {
  return number == SIGKILL || number == SIGTERM || number == SIGINT || number == SIGHUP ||
         number == SIGQUIT;
}

/* first line of the worker's log in the message */
static ambulo_status disk_trouble(ambulo__run *run, const char *id) {
  if (run->status) return run->status; /* said once */
  char *path = ambulo__case_path(run->allocator, run->directory, id, ".log"), *text = NULL;
  size_t length = 0;
  if (path && ambulo__read_file(path, MOST_LOG_BYTES, run->allocator, NULL, &text, &length))
    text = NULL;
  const char *error = text ? strstr(text, "error[") : NULL;
  if (error && strstr(error, "]: ")) error = strstr(error, "]: ") + 3;
  if (!error) error = text && text[0] ? text : "its log is empty";
  ambulo__place place = {run->directory, 0, 0, NULL};
  ambulo_status status = ambulo__error(run->diagnostics, AMBULO_E_IO, place,
                                       "what is finished is kept; run the same command again",
                                       "case %s: %.*s", id, (int)strcspn(error, "\n"), error);
  ambulo__free(run->allocator, text);
  ambulo__free(run->allocator, path);
  return status;
}

static void set_state(ambulo__record *record, const char *state) {
  (void)snprintf(record->state, sizeof record->state, "%s", state);
}

/* a worker that exited; 1: recorded, 0: again, -1: disk */
static int judge_exit(ambulo__run *run, const char *id, int code, ambulo__record *record) {
  record->exit_code = code;
  if (code == 4 || code == NOT_STARTED) return -1;
  if (code > SIGNAL_BASE && from_outside(code - SIGNAL_BASE)) return 0;
  if (code <= 1 && ambulo__record_take_summary(run->directory, id, run->allocator, record))
    return 1;
  if (code == 0) return 0;
  set_state(record, code == 2 || code == 3 ? "invalid" : code == 5 ? "memory" : "error");
  return 1;
}

static int judge(ambulo__run *run, const ambulo__slot *slot, int wait_status,
                 ambulo__record *record) {
  if (WIFEXITED(wait_status))
    return judge_exit(run, run->sweep->cases[slot->index].id, WEXITSTATUS(wait_status), record);
  record->signal = WTERMSIG(wait_status);
  if (slot->cut == 1) {
    set_state(record, "timeout");
    return 1;
  }
  if (from_outside(record->signal)) return 0;
  set_state(record, "crashed");
  return 1;
}

/* an empty log says nothing; one of a case that was solved is kept when it has warnings */
static void drop_empty_log(const ambulo__run *run, const char *id) {
  char *path = ambulo__case_path(run->allocator, run->directory, id, ".log"), *text = NULL;
  size_t length = 0;
  int empty =
      path &&
      ambulo__read_file(path, MOST_LOG_BYTES, run->allocator, NULL, &text, &length) == AMBULO_OK &&
      length == 0;
  if (empty) (void)unlink(path);
  ambulo__free(run->allocator, text);
  ambulo__free(run->allocator, path);
}

static ambulo_status keep(ambulo__run *run, int index, const ambulo__record *record) {
  const ambulo__sweep_case *one = &run->sweep->cases[index];
  ambulo_status status =
      ambulo__record_write(run->directory, one->id, record, run->allocator, run->diagnostics);
  if (status) return status;
  drop_empty_log(run, one->id);
  ambulo_batch_progress *p = &run->progress;
  run->state[index] = AMBULO__CASE_DONE;
  run->solved[index] = (unsigned char)record->valid;
  run->origin[index] = record->origin;
  run->finished_now++;
  p->done++;
  p->failed += !record->valid;
  p->last = one->name;
  (void)snprintf(p->last_state, sizeof p->last_state, "%s", record->state);
  if (record->violation > p->worst_violation) {
    p->worst_violation = record->violation;
    p->worst = one->name;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__outcome_record(ambulo__run *run, const ambulo__slot *slot, int wait_status) {
  const ambulo__sweep_case *one = &run->sweep->cases[slot->index];
  ambulo__record record;
  memset(&record, 0, sizeof record);
  record.key = one->key;
  record.exit_code = -1;
  record.violation = -1.0;
  record.origin = ambulo__schedule_origin(run, slot->index);
  if (slot->from >= 0)
    (void)snprintf(record.start, sizeof record.start, "%s", run->sweep->cases[slot->from].id);
  record.seconds = ambulo__run_clock() - slot->begin;
  record.limit_seconds = run->case_seconds;
  record.limit_megabytes = run->case_megabytes;
  int verdict = judge(run, slot, wait_status, &record);
  if (verdict > 0) return keep(run, slot->index, &record);
  run->state[slot->index] = AMBULO__CASE_WAITING;
  if (verdict < 0) return disk_trouble(run, one->id);
  if (slot->cut == 0 && ++run->attempts[slot->index] == MOST_ATTEMPTS) {
    run->state[slot->index] = AMBULO__CASE_GIVEN_UP;
    ambulo__place place = {run->directory, 0, 0, NULL};
    ambulo__warning(run->diagnostics, place, "is the machine out of memory?",
                    "case %s was killed from outside %d times; left out of this run", one->id,
                    MOST_ATTEMPTS);
  }
  return AMBULO_OK;
}
