/* study/batch_run.c - the supervisor: which case may start next, keeps the slots filled, enforces
 * limits, listens to the caller.
 *
 * One thread, one loop: every 2 ms it asks which workers ended, which exceeded their time, and,
 * five times a second, what the caller wants. A case that continues another waits until that one is
 * done, and is then started in the same slot; so a chain runs in order whatever the number of
 * workers. A shard takes whole chains. */
#ifdef __linux__
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "base/machine.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "study/batch.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

enum { MOST_WORKERS = 4096, TYPICAL_MEGABYTES = 150 /* what a gait needs at most */ };
static const double report_seconds = 0.2;

/* by affinity and control group, at least 1; elsewhere than on Linux only their number is known */
static int usable_processors(void) {
  long online = sysconf(_SC_NPROCESSORS_ONLN);
  int count = online > 0 ? (int)online : 1;
#ifdef __linux__
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0) count = CPU_COUNT(&set);
#endif
  double quota = 0.0, period = 0.0;
  if (ambulo__read_numbers("/sys/fs/cgroup/cpu.max", &quota, &period) == 2 && period > 0.0) {
    int granted = (int)(quota / period + 0.5);
    if (granted < 1) granted = 1;
    if (granted < count) count = granted;
  }
  return count;
}

int ambulo_batch_workers(int workers, int megabytes) {
  int count = workers > 0 ? workers : usable_processors();
  double fit = ambulo__free_megabytes() / (megabytes > 0 ? megabytes : TYPICAL_MEGABYTES);
  if (fit > 0.0 && fit < count) count = fit < 1.0 ? 1 : (int)fit;
  return count;
}

/* -------------------------------------------------------------------- queue */

/* every k-th chain, counted over the whole list, is ours */
static ambulo_status assign(ambulo__supervisor *batch) {
  const ambulo_sweep *s = batch->sweep;
  int *root = ambulo__alloc(batch->allocator, (size_t)s->case_count, sizeof *root), roots = 0;
  if (!root) return AMBULO_E_MEMORY;
  for (int k = 0; k < s->case_count; k++) {
    int previous = s->cases[k].previous;
    root[k] = previous < 0 ? roots++ : root[previous];
    int ours = root[k] % batch->options.shards == batch->options.shard - 1;
    batch->of[k].state = ours ? AMBULO__CASE_WAITING : AMBULO__CASE_ELSEWHERE;
    batch->progress.cases += ours;
    batch->of[k].next = -1;
    if (previous >= 0 && batch->of[previous].next < 0) batch->of[previous].next = k;
  }
  ambulo__free(batch->allocator, root);
  return AMBULO_OK;
}

static int may_start(const ambulo__supervisor *batch, int k) {
  int previous = batch->sweep->cases[k].previous;
  return batch->of[k].state == AMBULO__CASE_WAITING &&
         (previous < 0 || batch->of[previous].state == AMBULO__CASE_DONE);
}

static void report_damage(const ambulo__supervisor *batch, const char *id,
                          const ambulo__damage *damage) {
  char *path = ambulo__case_path(batch->allocator, batch->directory, id, damage->ending);
  ambulo__place place = {path ? path : batch->directory, 0, 0, NULL};
  ambulo__warning(batch->diagnostics, place, NULL, "damaged: %s; the case is computed again",
                  damage->what);
  ambulo__free(batch->allocator, path);
}

/* Takes a waiting case as done when its record is what this run would compute: same key, same
 * origin, limits no tighter than now; and all files of its result are what they were. */
static ambulo_status take_record(ambulo__supervisor *batch, int k) {
  const ambulo__sweep_case *one = &batch->sweep->cases[k];
  ambulo__finding finding;
  ambulo__record record;
  ambulo__damage damage;
  if (batch->of[k].damaged) return AMBULO_OK;
  int verified = k < batch->sweep->trusted;
  ambulo_status status = ambulo__record_find(batch->directory, one->id, one->key, !verified,
                                             batch->allocator, &finding, &record, &damage);
  if (status) return status;
  batch->of[k].damaged = finding == AMBULO__FOUND_DAMAGED;
  if (batch->of[k].damaged) report_damage(batch, one->id, &damage);
  if (finding != AMBULO__FOUND_INTACT || record.origin != ambulo__queue_origin(batch, k) ||
      ambulo__record_was_cut(&record, batch->case_seconds, batch->case_megabytes))
    return AMBULO_OK;
  batch->of[k].state = AMBULO__CASE_DONE;
  batch->of[k].solved = (unsigned char)record.valid;
  batch->of[k].origin = record.origin;
  batch->progress.resumed++;
  ambulo__tally_case(batch, k, &record, NULL);
  return AMBULO_OK;
}

ambulo_status ambulo__queue_open(ambulo__supervisor *batch) {
  const ambulo_allocator *a = batch->allocator;
  batch->of = ambulo__alloc(a, (size_t)batch->sweep->case_count, sizeof *batch->of);
  batch->slot = ambulo__alloc(a, (size_t)batch->workers, sizeof *batch->slot);
  if (!batch->of || !batch->slot) return AMBULO_E_MEMORY;
  ambulo_status status = assign(batch);
  for (int k = 0; k < batch->sweep->case_count && !status; k++)
    if (may_start(batch, k)) status = take_record(batch, k);
  return status;
}

void ambulo__queue_free(ambulo__supervisor *batch) {
  ambulo__free(batch->allocator, batch->of);
  ambulo__free(batch->allocator, batch->slot);
}

/* 1: the case has to be computed, and may be now; never after a failure, which is in batch->status
 */
static int is_due(ambulo__supervisor *batch, int k) {
  if (batch->status || !may_start(batch, k)) return 0;
  if (batch->sweep->cases[k].previous >= 0) batch->status = take_record(batch, k);
  return !batch->status && batch->of[k].state == AMBULO__CASE_WAITING;
}

int ambulo__queue_next(ambulo__supervisor *batch) {
  /* once more from the front when all is quiet: a second case may continue the same one */
  for (int pass = 0; pass < 2; pass++) {
    for (; batch->cursor < batch->sweep->case_count; batch->cursor++)
      if (is_due(batch, batch->cursor)) return batch->cursor++;
    if (batch->progress.running > 0 || batch->status) break;
    batch->cursor = 0;
  }
  return -1;
}

int ambulo__queue_follower(ambulo__supervisor *batch, int index) {
  if (batch->of[index].state == AMBULO__CASE_WAITING) return index; /* to be tried again */
  int next = batch->of[index].next;
  while (next >= 0 && !is_due(batch, next)) {
    if (batch->of[next].state != AMBULO__CASE_DONE) return -1;
    next = batch->of[next].next;
  }
  return next;
}

unsigned long long ambulo__queue_origin(const ambulo__supervisor *batch, int index) {
  int from = ambulo__queue_start_of(batch, index);
  if (from < 0) return 0;
  unsigned long long hash = ambulo__hash_text(AMBULO__HASH_START, batch->sweep->cases[from].id);
  return ambulo__hash_word(hash, batch->of[from].origin);
}

int ambulo__queue_start_of(const ambulo__supervisor *batch, int index) {
  int k = batch->sweep->cases[index].previous;
  while (k >= 0 && !batch->of[k].solved) k = batch->sweep->cases[k].previous;
  return k;
}

/* ---------------------------------------------------------------- the loop */

static ambulo_status start(ambulo__supervisor *batch, ambulo__slot *slot, int index) {
  ambulo__slot started = {.index = index,
                          .from = ambulo__queue_start_of(batch, index),
                          .origin = ambulo__queue_origin(batch, index)};
  ambulo_status status = ambulo__worker_start(batch, &started);
  if (status) return status;
  *slot = started;
  batch->of[index].state = AMBULO__CASE_RUNNING;
  batch->progress.running++;
  return AMBULO_OK;
}

static void kill_slot(ambulo__slot *slot, int cut) {
  if (slot->process <= 0 || slot->cut) return;
  slot->cut = cut;
  (void)kill(slot->process, SIGKILL);
}

/* Takes in what ended. A slot without a chain starts the next case before the record is
 * flushed, so that processors do not wait for the disk; a chain goes on in its slot. */
static void reap(ambulo__supervisor *batch, ambulo__slot *slot, int stopping) {
  int wait_status = 0;
  pid_t process = waitpid(slot->process, &wait_status, WNOHANG);
  if (process == 0 || (process < 0 && errno == EINTR)) {
    /* a full pipe would stop the worker */
    if (ambulo__worker_log_read(&slot->log) && !batch->status)
      batch->status =
          ambulo__io_error(batch->diagnostics, batch->directory, "read what a worker says");
    if (batch->case_seconds > 0.0 && ambulo__seconds_now() - slot->begin > batch->case_seconds)
      kill_slot(slot, 1);
    return;
  }
  ambulo__slot ended = *slot;
  slot->process = 0;
  batch->progress.running--;
  int chained = batch->of[ended.index].next >= 0;
  int next = stopping || chained ? -1 : ambulo__queue_next(batch);
  ambulo_status status = next >= 0 ? start(batch, slot, next) : AMBULO_OK;
  if (process == ended.process) {
    ambulo_status taken = ambulo__worker_end(batch, &ended, wait_status);
    if (!status) status = taken;
  } else {
    batch->of[ended.index].state = AMBULO__CASE_WAITING; /* somebody else waited for it */
  }
  ambulo__worker_log_close(&ended.log);
  int follower = stopping || status || next >= 0 ? -1 : ambulo__queue_follower(batch, ended.index);
  if (follower >= 0) status = start(batch, slot, follower);
  if (status && !batch->status) batch->status = status;
}

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
    if (batch->progress.running == 0 && ambulo__queue_next(batch) < 0) break; /* abandoned */
    if (batch->progress.running == 0) batch->cursor = 0;
    if (stop && stopped == 0.0) stopped = ambulo__seconds_now();
    int late = stop && ambulo__seconds_now() - stopped > batch->options.grace;
    for (int i = 0; i < batch->workers && (stop > 1 || late); i++) kill_slot(&batch->slot[i], 2);
    struct timespec pause = {0, 2000000};
    (void)nanosleep(&pause, NULL);
  }
  (void)ask(batch, 1);
}

/* what killed workers left half-written, where no other run writes into the folder */
static void clean_all(const char *directory, const ambulo_allocator *a) {
  char *cases = ambulo__join_paths(a, directory, "cases", NULL);
  DIR *stream = cases ? opendir(cases) : NULL;
  for (struct dirent *e = stream ? readdir(stream) : NULL; e; e = readdir(stream)) {
    char *fan = e->d_name[0] == '.' ? NULL : ambulo__join_paths(a, cases, e->d_name, NULL);
    if (fan) ambulo__clean_folder(fan, "");
    ambulo__free(a, fan);
  }
  if (stream) closedir(stream);
  ambulo__free(a, cases);
  ambulo__clean_folder(directory, "");
}

static int acceptable(const ambulo_batch_options *o) {
  return o->shards >= 1 && o->shard >= 1 && o->shard <= o->shards && o->workers >= 0 &&
         o->workers <= MOST_WORKERS && (isnan(o->case_seconds) || o->case_seconds > 0.0) &&
         o->case_megabytes >= 0 && o->grace >= 0.0;
}

static ambulo_status run_locked(ambulo__supervisor *batch) {
  ambulo_status status = ambulo__batch_check_folder(
      batch->sweep, batch->directory, batch->options.force, batch->allocator, batch->diagnostics);
  if (!status)
    status = ambulo__study_describe(batch->sweep, batch->directory, batch->allocator,
                                    batch->diagnostics);
  if (status) return status;
  if (batch->options.shards == 1) clean_all(batch->directory, batch->allocator);
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
  batch.workers = ambulo_batch_workers(batch.options.workers, batch.case_megabytes);
  batch.progress.worst_violation = AMBULO_OFF;
  int lock = -1;
  ambulo_status status = ambulo__expect_path(directory, "batch folder", diagnostics);
  if (!status) status = ambulo__expect_path(batch.options.program, "program", diagnostics);
  if (!status) status = ambulo__batch_make_folders(directory, &own, diagnostics);
  if (!status)
    status = ambulo__lock_take(directory, batch.options.shard, batch.options.shards, &own,
                               diagnostics, &lock);
  if (!status) status = run_locked(&batch);
  ambulo__lock_release(lock);
  if (progress) *progress = batch.progress;
  ambulo__queue_free(&batch);
  return ambulo__conclude(diagnostics, errors, status, directory);
}
