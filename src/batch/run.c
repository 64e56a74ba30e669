/* batch/run.c - the supervisor: keeps the slots filled, enforces limits, listens to the caller.
 *
 * One thread, one loop: every 2 ms it asks which workers ended, which exceeded their time, and,
 * five times a second, what the caller wants. A case counts once its record is on disk, and is
 * computed again otherwise, so the supervisor may be killed anywhere.
 *
 * Reading order: run.h, run.c, schedule.c, listing.h, worker.h, record.h, outcome.c, lock.h,
 * clean.h, machine.h.
 */
#include "batch/run.h"
#include "base/clock.h"
#include "base/file_steps.h"
#include "batch/case_path.h"
#include "batch/clean.h"
#include "batch/listing.h"
#include "batch/machine.h"
#include "batch/worker.h"

#include <errno.h>
#include <signal.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>

enum { COOKIE = 0x62617463, MOST_WORKERS = 4096 };
static const double report_seconds = 0.2;

ambulo_batch_options ambulo_batch_options_default(void) {
  ambulo_batch_options options;
  memset(&options, 0, sizeof options);
  options.cookie = COOKIE;
  options.shard = options.shards = 1;
  options.grace = 30.0;
  return options;
}

/* -------------------------------------------------------------------- slots */

static ambulo_status make_fan(ambulo__batch_run *run, const char *id) {
  char *path = ambulo__case_path(run->allocator, run->directory, id, "");
  if (!path) return AMBULO_E_MEMORY;
  *strrchr(path, '/') = '\0';
  ambulo_status status = AMBULO_OK;
  if (mkdir(path, 0777) != 0 && errno != EEXIST)
    status = ambulo__io_error(run->diagnostics, path, "create the folder");
  ambulo__free(run->allocator, path);
  return status;
}

static ambulo_status start(ambulo__batch_run *run, ambulo__slot *slot, int index) {
  ambulo_case one;
  ambulo_status status = ambulo_sweep_case(run->sweep, index, &one);
  if (!status) status = make_fan(run, one.id);
  if (!status) status = ambulo__clean_result(run->directory, one.id, run->allocator);
  if (status) return status;
  int from = ambulo__schedule_start_of(run, index);
  ambulo__worker_job job = {run->options.program,
                            run->sweep->base,
                            run->directory,
                            &one,
                            from < 0 ? NULL : run->sweep->cases[from].id,
                            run->case_megabytes};
  status = ambulo__worker_start(&job, run->allocator, run->diagnostics, &slot->process);
  if (status) {
    slot->process = 0;
    return status;
  }
  slot->index = index;
  slot->from = from;
  slot->cut = 0;
  slot->begin = ambulo__seconds_now();
  run->state[index] = AMBULO__CASE_RUNNING;
  run->progress.running++;
  return AMBULO_OK;
}

static void kill_slot(ambulo__slot *slot, int cut) {
  if (slot->process <= 0 || slot->cut) return;
  slot->cut = cut;
  (void)kill(slot->process, SIGKILL);
}

static ambulo_status take_in(ambulo__batch_run *run, const ambulo__slot *ended, int wait_status) {
  if (!(WIFEXITED(wait_status) && WEXITSTATUS(wait_status) <= 3))
    ambulo__clean_case(run->directory, run->sweep->cases[ended->index].id, (long)ended->process,
                       run->allocator);
  return ambulo__outcome_record(run, ended, wait_status);
}

/* Takes in what ended. A slot without a chain starts the next case before the record is
 * flushed, so that processors do not wait for the disk; a chain goes on in its slot. */
static void reap(ambulo__batch_run *run, ambulo__slot *slot, int stopping) {
  int wait_status = 0;
  pid_t process = waitpid(slot->process, &wait_status, WNOHANG);
  if (process == 0 || (process < 0 && errno == EINTR)) {
    if (run->case_seconds > 0.0 && ambulo__seconds_now() - slot->begin > run->case_seconds)
      kill_slot(slot, 1);
    return;
  }
  ambulo__slot ended = *slot;
  slot->process = 0;
  run->progress.running--;
  int chained = run->next[ended.index] >= 0;
  int next = stopping || chained ? -1 : ambulo__schedule_next(run);
  ambulo_status status = next >= 0 ? start(run, slot, next) : AMBULO_OK;
  if (process == ended.process) {
    ambulo_status taken = take_in(run, &ended, wait_status);
    if (!status) status = taken;
  } else {
    run->state[ended.index] = AMBULO__CASE_WAITING; /* somebody else waited for it */
  }
  int follower = stopping || status || next >= 0 ? -1 : ambulo__schedule_follower(run, ended.index);
  if (follower >= 0) status = start(run, slot, follower);
  if (status && !run->status) run->status = status;
}

/* ---------------------------------------------------------------- the loop */

static int ask(ambulo__batch_run *run, int always) {
  ambulo_batch_progress *p = &run->progress;
  double now = ambulo__seconds_now() - run->begin;
  if (!always && now - p->seconds < report_seconds) return 0;
  p->seconds = now;
  p->seconds_left = run->finished_now > 0 ? now / run->finished_now * (p->cases - p->done) : -1.0;
  return run->options.progress ? run->options.progress(run->options.user, p) : 0;
}

static void supervise(ambulo__batch_run *run) {
  int stop = ask(run, 1);
  double stopped = 0.0;
  for (;;) {
    for (int i = 0; i < run->workers; i++) {
      ambulo__slot *slot = &run->slot[i];
      if (slot->process > 0) reap(run, slot, stop > 0 || run->status);
      int index = slot->process > 0 || stop > 0 || run->status ? -1 : ambulo__schedule_next(run);
      if (index >= 0) run->status = start(run, slot, index);
    }
    int wish = ask(run, 0);
    if (wish > stop) stop = wish;
    if (run->status && stop < 1) stop = 1;
    if (run->progress.running == 0 && (stop || run->progress.done >= run->progress.cases)) break;
    if (run->progress.running == 0 && ambulo__schedule_next(run) < 0) break; /* given up */
    if (run->progress.running == 0) run->cursor = 0;
    if (stop && stopped == 0.0) stopped = ambulo__seconds_now();
    int late = stop && ambulo__seconds_now() - stopped > run->options.grace;
    for (int i = 0; i < run->workers && (stop > 1 || late); i++) kill_slot(&run->slot[i], 2);
    struct timespec pause = {0, 2000000};
    (void)nanosleep(&pause, NULL);
  }
  (void)ask(run, 1);
}

static int acceptable(const ambulo_batch_options *o) {
  return o->cookie == COOKIE && o->shards >= 1 && o->shard >= 1 && o->shard <= o->shards &&
         o->workers >= 0 && o->workers <= MOST_WORKERS && o->case_seconds >= 0.0 &&
         o->case_megabytes >= 0 && o->grace >= 0.0;
}

static ambulo_status run_locked(ambulo__batch_run *run) {
  ambulo_status status = ambulo__listing_prepare(run->sweep, run->directory, run->options.force,
                                                 run->allocator, run->diagnostics);
  if (status) return status;
  if (run->options.shards == 1) ambulo__clean_all(run->directory, run->allocator);
  run->begin = ambulo__seconds_now();
  status = ambulo__schedule_open(run);
  if (status) return status;
  supervise(run);
  return run->status;
}

ambulo_status ambulo_batch_run(const ambulo_sweep *sweep, const char *directory,
                               const ambulo_batch_options *options,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo_batch_progress *progress) {
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  if (!sweep || !directory) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__batch_run run;
  memset(&run, 0, sizeof run);
  run.options = options ? *options : ambulo_batch_options_default();
  if (!acceptable(&run.options)) return AMBULO_E_ARGUMENT;
  run.sweep = sweep;
  run.directory = directory;
  run.allocator = &own;
  run.diagnostics = diagnostics;
  run.case_seconds =
      run.options.case_seconds > 0.0 ? run.options.case_seconds : sweep->case_seconds;
  run.case_megabytes =
      run.options.case_megabytes > 0 ? run.options.case_megabytes : sweep->case_megabytes;
  run.workers = ambulo__worker_count(run.options.workers, run.case_megabytes);
  run.progress.worst_violation = -1.0;
  ambulo__lock lock = {-1, -1};
  ambulo_status status = ambulo__expect_path(directory, "batch folder", diagnostics);
  if (!status) status = ambulo__expect_path(run.options.program, "program", diagnostics);
  if (!status) status = ambulo__batch_make_folders(directory, &own, diagnostics);
  if (!status)
    status = ambulo__lock_take(directory, run.options.shard, run.options.shards, &own, diagnostics,
                               &lock);
  if (!status) status = run_locked(&run);
  ambulo__lock_release(&lock);
  if (progress) *progress = run.progress;
  ambulo__schedule_free(&run);
  return ambulo__conclude(diagnostics, errors, status, directory);
}
