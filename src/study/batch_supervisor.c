/* study/batch_supervisor.c - the supervisor: keeps the slots filled, enforces limits, listens to
 * the caller.
 *
 * One thread, one loop: every 2 ms it asks which workers ended, which exceeded their time, and,
 * five times a second, what the caller wants. A case counts once its record is on disk, and is
 * computed again otherwise, so the supervisor may be killed anywhere.
 *
 * Reading order: supervisor.h, supervisor.c, queue.c, listing.h, worker.h, record.h, outcome.c,
 * lock.h, clean.h, machine.h.
 */
#include "study/batch_supervisor.h"
#include "base/sized.h"
#include "base/machine.h"
#include "formats/file_steps.h"
#include "study/case_path.h"
#include "study/batch_clean.h"
#include "study/batch_listing.h"
#include "study/batch_machine.h"
#include "study/batch_worker.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>

enum { MOST_WORKERS = 4096 };
static const double report_seconds = 0.2;

/* -------------------------------------------------------------------- slots */

static ambulo_status make_fan(ambulo__supervisor *batch, const char *id) {
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, "");
  if (!path) return AMBULO_E_MEMORY;
  *strrchr(path, '/') = '\0';
  ambulo_status status = AMBULO_OK;
  if (mkdir(path, 0777) != 0 && errno != EEXIST)
    status = ambulo__io_error(batch->diagnostics, path, "create the folder");
  ambulo__free(batch->allocator, path);
  return status;
}

static ambulo_status start(ambulo__supervisor *batch, ambulo__slot *slot, int index) {
  ambulo_case one;
  ambulo_status status = ambulo_sweep_case(batch->sweep, index, &one);
  if (!status) status = make_fan(batch, one.id);
  if (!status) status = ambulo__clean_result(batch->directory, one.id, batch->allocator);
  if (status) return status;
  int from = ambulo__queue_start_of(batch, index);
  ambulo__worker_job job = {batch->options.program,
                            batch->sweep->base,
                            batch->directory,
                            &one,
                            from < 0 ? NULL : batch->sweep->cases[from].id,
                            batch->case_megabytes};
  status = ambulo__worker_start(&job, batch->allocator, batch->diagnostics, &slot->process);
  if (status) {
    slot->process = 0;
    return status;
  }
  slot->index = index;
  slot->from = from;
  slot->cut = 0;
  slot->begin = ambulo__seconds_now();
  batch->state[index] = AMBULO__CASE_RUNNING;
  batch->progress.running++;
  return AMBULO_OK;
}

static void kill_slot(ambulo__slot *slot, int cut) {
  if (slot->process <= 0 || slot->cut) return;
  slot->cut = cut;
  (void)kill(slot->process, SIGKILL);
}

static ambulo_status take_in(ambulo__supervisor *batch, const ambulo__slot *ended,
                             int wait_status) {
  if (!(WIFEXITED(wait_status) && WEXITSTATUS(wait_status) <= 3))
    ambulo__clean_case(batch->directory, batch->sweep->cases[ended->index].id, (long)ended->process,
                       batch->allocator);
  return ambulo__outcome_record(batch, ended, wait_status);
}

/* Takes in what ended. A slot without a chain starts the next case before the record is
 * flushed, so that processors do not wait for the disk; a chain goes on in its slot. */
static void reap(ambulo__supervisor *batch, ambulo__slot *slot, int stopping) {
  int wait_status = 0;
  pid_t process = waitpid(slot->process, &wait_status, WNOHANG);
  if (process == 0 || (process < 0 && errno == EINTR)) {
    if (batch->case_seconds > 0.0 && ambulo__seconds_now() - slot->begin > batch->case_seconds)
      kill_slot(slot, 1);
    return;
  }
  ambulo__slot ended = *slot;
  slot->process = 0;
  batch->progress.running--;
  int chained = batch->next[ended.index] >= 0;
  int next = stopping || chained ? -1 : ambulo__queue_next(batch);
  ambulo_status status = next >= 0 ? start(batch, slot, next) : AMBULO_OK;
  if (process == ended.process) {
    ambulo_status taken = take_in(batch, &ended, wait_status);
    if (!status) status = taken;
  } else {
    batch->state[ended.index] = AMBULO__CASE_WAITING; /* somebody else waited for it */
  }
  int follower = stopping || status || next >= 0 ? -1 : ambulo__queue_follower(batch, ended.index);
  if (follower >= 0) status = start(batch, slot, follower);
  if (status && !batch->status) batch->status = status;
}

/* ---------------------------------------------------------------- the loop */

static int ask(ambulo__supervisor *batch, int always) {
  ambulo_batch_progress *p = &batch->progress;
  double now = ambulo__seconds_now() - batch->begin;
  if (!always && now - p->seconds < report_seconds) return 0;
  p->seconds = now;
  p->seconds_left =
      batch->finished_now > 0 ? now / batch->finished_now * (p->cases - p->done) : AMBULO_OFF;
  return batch->options.progress ? batch->options.progress(batch->options.user, p) : 0;
}

static void supervise(ambulo__supervisor *batch) {
  int stop = ask(batch, 1);
  double stopped = 0.0;
  for (;;) {
    for (int i = 0; i < batch->workers; i++) {
      ambulo__slot *slot = &batch->slot[i];
      if (slot->process > 0) reap(batch, slot, stop > 0 || batch->status);
      int index = slot->process > 0 || stop > 0 || batch->status ? -1 : ambulo__queue_next(batch);
      if (index >= 0) batch->status = start(batch, slot, index);
    }
    int wish = ask(batch, 0);
    if (wish > stop) stop = wish;
    if (batch->status && stop < 1) stop = 1;
    if (batch->progress.running == 0 && (stop || batch->progress.done >= batch->progress.cases))
      break;
    if (batch->progress.running == 0 && ambulo__queue_next(batch) < 0) break; /* given up */
    if (batch->progress.running == 0) batch->cursor = 0;
    if (stop && stopped == 0.0) stopped = ambulo__seconds_now();
    int late = stop && ambulo__seconds_now() - stopped > batch->options.grace;
    for (int i = 0; i < batch->workers && (stop > 1 || late); i++) kill_slot(&batch->slot[i], 2);
    struct timespec pause = {0, 2000000};
    (void)nanosleep(&pause, NULL);
  }
  (void)ask(batch, 1);
}

static int acceptable(const ambulo_batch_options *o) {
  return o->shards >= 1 && o->shard >= 1 && o->shard <= o->shards && o->workers >= 0 &&
         o->workers <= MOST_WORKERS && (isnan(o->case_seconds) || o->case_seconds > 0.0) &&
         o->case_megabytes >= 0 && o->grace >= 0.0;
}

static ambulo_status run_locked(ambulo__supervisor *batch) {
  ambulo_status status = ambulo__listing_prepare(
      batch->sweep, batch->directory, batch->options.force, batch->allocator, batch->diagnostics);
  if (status) return status;
  if (batch->options.shards == 1) ambulo__clean_all(batch->directory, batch->allocator);
  batch->begin = ambulo__seconds_now();
  status = ambulo__queue_open(batch);
  if (status) return status;
  supervise(batch);
  return batch->status;
}

ambulo_status ambulo__batch_run(const ambulo_sweep *sweep, const char *directory,
                                const ambulo_batch_options *options,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_batch_progress *progress) {
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  if (!sweep || !directory) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__supervisor batch;
  memset(&batch, 0, sizeof batch);
  if (!AMBULO__OWN(ambulo_batch_options, &batch.options, options)) return AMBULO_E_ARGUMENT;
  if (!acceptable(&batch.options)) return AMBULO_E_ARGUMENT;
  batch.sweep = sweep;
  batch.directory = directory;
  batch.allocator = &own;
  batch.diagnostics = diagnostics;
  batch.case_seconds =
      batch.options.case_seconds > 0.0 ? batch.options.case_seconds : sweep->case_seconds;
  batch.case_megabytes =
      batch.options.case_megabytes > 0 ? batch.options.case_megabytes : sweep->case_megabytes;
  batch.workers = ambulo__worker_count(batch.options.workers, batch.case_megabytes);
  batch.progress.worst_violation = AMBULO_OFF;
  ambulo__lock lock = {-1, -1};
  ambulo_status status = ambulo__expect_path(directory, "batch folder", diagnostics);
  if (!status) status = ambulo__expect_path(batch.options.program, "program", diagnostics);
  if (!status) status = ambulo__batch_make_folders(directory, &own, diagnostics);
  if (!status)
    status = ambulo__lock_take(directory, batch.options.shard, batch.options.shards, &own,
                               diagnostics, &lock);
  if (!status) status = run_locked(&batch);
  ambulo__lock_release(&lock);
  if (progress) *progress = batch.progress;
  ambulo__queue_free(&batch);
  return ambulo__conclude(diagnostics, errors, status, directory);
}
