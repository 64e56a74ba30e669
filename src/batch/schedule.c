/* batch/schedule.c - which case may start next.
 *
 * A case that continues another waits until that one is done, and is then started in the same
 * slot; so a chain runs in order whatever the number of workers. A shard takes whole chains. */
#include "batch/case_path.h"
#include "base/text_hash.h"
#include "batch/run.h"

#include <string.h>

/* every k-th chain, counted over the whole list, is ours */
static ambulo_status assign(ambulo__batch_run *run) {
  const ambulo_sweep *s = run->sweep;
  int *root = ambulo__alloc(run->allocator, (size_t)s->case_count, sizeof *root), roots = 0;
  if (!root) return AMBULO_E_MEMORY;
  for (int k = 0; k < s->case_count; k++) {
    int previous = s->cases[k].previous;
    root[k] = previous < 0 ? roots++ : root[previous];
    int ours = root[k] % run->options.shards == run->options.shard - 1;
    run->state[k] = ours ? AMBULO__CASE_WAITING : AMBULO__CASE_ELSEWHERE;
    run->progress.cases += ours;
    run->next[k] = -1;
    if (previous >= 0 && run->next[previous] < 0) run->next[previous] = k;
  }
  ambulo__free(run->allocator, root);
  return AMBULO_OK;
}

static int may_start(const ambulo__batch_run *run, int k) {
  int previous = run->sweep->cases[k].previous;
  return run->state[k] == AMBULO__CASE_WAITING &&
         (previous < 0 || run->state[previous] == AMBULO__CASE_DONE);
}

static void tell_damage(const ambulo__batch_run *run, const char *id,
                        const ambulo__damage *damage) {
  char *path = ambulo__case_path(run->allocator, run->directory, id, damage->ending);
  ambulo__place place = {path ? path : run->directory, 0, 0, NULL};
  ambulo__warning(run->diagnostics, place, NULL, "damaged: %s; the case is computed again",
                  damage->what);
  ambulo__free(run->allocator, path);
}

/* Takes a waiting case as done when its record is what this run would compute: same key, same
 * origin, limits no tighter than now; and all files of its result are what they were. */
static ambulo_status take_record(ambulo__batch_run *run, int k) {
  const ambulo__sweep_case *one = &run->sweep->cases[k];
  ambulo__finding finding;
  ambulo__record record;
  ambulo__damage damage;
  if (run->damaged[k]) return AMBULO_OK;
  ambulo_status status = ambulo__record_find(run->directory, one->id, one->key, 1, run->allocator,
                                             &finding, &record, &damage);
  if (status) return status;
  run->damaged[k] = finding == AMBULO__FOUND_DAMAGED;
  if (run->damaged[k]) tell_damage(run, one->id, &damage);
  if (finding != AMBULO__FOUND_INTACT || record.origin != ambulo__schedule_origin(run, k) ||
      ambulo__record_was_cut(&record, run->case_seconds, run->case_megabytes))
    return AMBULO_OK;
  run->state[k] = AMBULO__CASE_DONE;
  run->solved[k] = (unsigned char)record.valid;
  run->origin[k] = record.origin;
  run->progress.done++;
  run->progress.resumed++;
  run->progress.failed += !record.valid;
  return AMBULO_OK;
}

ambulo_status ambulo__schedule_open(ambulo__batch_run *run) {
  const ambulo_allocator *a = run->allocator;
  size_t cases = (size_t)run->sweep->case_count;
  run->state = ambulo__alloc(a, cases, 1);
  run->solved = ambulo__alloc(a, cases, 1);
  run->attempts = ambulo__alloc(a, cases, 1);
  run->damaged = ambulo__alloc(a, cases, 1);
  run->origin = ambulo__alloc(a, cases, sizeof *run->origin);
  run->next = ambulo__alloc(a, cases, sizeof *run->next);
  run->slot = ambulo__alloc(a, (size_t)run->workers, sizeof *run->slot);
  if (!run->state || !run->solved || !run->attempts || !run->damaged || !run->origin ||
      !run->next || !run->slot)
    return AMBULO_E_MEMORY;
  ambulo_status status = assign(run);
  for (int k = 0; k < run->sweep->case_count && !status; k++) {
    if (may_start(run, k)) status = take_record(run, k);
  }
  return status;
}

void ambulo__schedule_free(ambulo__batch_run *run) {
  const ambulo_allocator *a = run->allocator;
  ambulo__free(a, run->state);
  ambulo__free(a, run->solved);
  ambulo__free(a, run->attempts);
  ambulo__free(a, run->damaged);
  ambulo__free(a, run->origin);
  ambulo__free(a, run->next);
  ambulo__free(a, run->slot);
}

/* 1: the case has to be computed, and may be now; never after a failure, which is in run->status */
static int is_due(ambulo__batch_run *run, int k) {
  if (run->status || !may_start(run, k)) return 0;
  if (run->sweep->cases[k].previous >= 0) run->status = take_record(run, k);
  return !run->status && run->state[k] == AMBULO__CASE_WAITING;
}

int ambulo__schedule_next(ambulo__batch_run *run) {
  /* once more from the front when all is quiet: a second case may continue the same one */
  for (int pass = 0; pass < 2; pass++) {
    for (; run->cursor < run->sweep->case_count; run->cursor++)
      if (is_due(run, run->cursor)) return run->cursor++;
    if (run->progress.running > 0 || run->status) break;
    run->cursor = 0;
  }
  return -1;
}

int ambulo__schedule_follower(ambulo__batch_run *run, int index) {
  if (run->state[index] == AMBULO__CASE_WAITING) return index; /* to be tried again */
  int next = run->next[index];
  while (next >= 0 && !is_due(run, next)) {
    if (run->state[next] != AMBULO__CASE_DONE) return -1;
    next = run->next[next];
  }
  return next;
}

unsigned long long ambulo__schedule_origin(const ambulo__batch_run *run, int index) {
  int from = ambulo__schedule_start_of(run, index);
  if (from < 0) return 0;
  unsigned long long hash = ambulo__hash_text(AMBULO__HASH_START, run->sweep->cases[from].id);
  return ambulo__hash_word(hash, run->origin[from]);
}

int ambulo__schedule_start_of(const ambulo__batch_run *run, int index) {
  int k = run->sweep->cases[index].previous;
  while (k >= 0 && !run->solved[k]) k = run->sweep->cases[k].previous;
  return k;
}
