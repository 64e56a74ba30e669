/* study/batch_queue.c - which case may start next.
 *
 * A case that continues another waits until that one is done, and is then started in the same
 * slot; so a chain runs in order whatever the number of workers. A shard takes whole chains. */
#include "study/case_path.h"
#include "formats/text_hash.h"
#include "study/batch_supervisor.h"

#include <string.h>

/* every k-th chain, counted over the whole list, is ours */
static ambulo_status assign(ambulo__supervisor *batch) {
  const ambulo_sweep *s = batch->sweep;
  int *root = ambulo__alloc(batch->allocator, (size_t)s->case_count, sizeof *root), roots = 0;
  if (!root) return AMBULO_E_MEMORY;
  for (int k = 0; k < s->case_count; k++) {
    int previous = s->cases[k].previous;
    root[k] = previous < 0 ? roots++ : root[previous];
    int ours = root[k] % batch->options.shards == batch->options.shard - 1;
    batch->state[k] = ours ? AMBULO__CASE_WAITING : AMBULO__CASE_ELSEWHERE;
    batch->progress.cases += ours;
    batch->next[k] = -1;
    if (previous >= 0 && batch->next[previous] < 0) batch->next[previous] = k;
  }
  ambulo__free(batch->allocator, root);
  return AMBULO_OK;
}

static int may_start(const ambulo__supervisor *batch, int k) {
  int previous = batch->sweep->cases[k].previous;
  return batch->state[k] == AMBULO__CASE_WAITING &&
         (previous < 0 || batch->state[previous] == AMBULO__CASE_DONE);
}

static void tell_damage(const ambulo__supervisor *batch, const char *id,
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
  if (batch->damaged[k]) return AMBULO_OK;
  int verified = k < batch->sweep->trusted;
  ambulo_status status = ambulo__record_find(batch->directory, one->id, one->key, !verified,
                                             batch->allocator, &finding, &record, &damage);
  if (status) return status;
  batch->damaged[k] = finding == AMBULO__FOUND_DAMAGED;
  if (batch->damaged[k]) tell_damage(batch, one->id, &damage);
  if (finding != AMBULO__FOUND_INTACT || record.origin != ambulo__queue_origin(batch, k) ||
      ambulo__record_was_cut(&record, batch->case_seconds, batch->case_megabytes))
    return AMBULO_OK;
  batch->state[k] = AMBULO__CASE_DONE;
  batch->solved[k] = (unsigned char)record.valid;
  batch->origin[k] = record.origin;
  batch->progress.done++;
  batch->progress.resumed++;
  batch->progress.failed += !record.valid;
  return AMBULO_OK;
}

ambulo_status ambulo__queue_open(ambulo__supervisor *batch) {
  const ambulo_allocator *a = batch->allocator;
  size_t cases = (size_t)batch->sweep->case_count;
  batch->state = ambulo__alloc(a, cases, 1);
  batch->solved = ambulo__alloc(a, cases, 1);
  batch->attempts = ambulo__alloc(a, cases, 1);
  batch->damaged = ambulo__alloc(a, cases, 1);
  batch->origin = ambulo__alloc(a, cases, sizeof *batch->origin);
  batch->next = ambulo__alloc(a, cases, sizeof *batch->next);
  batch->slot = ambulo__alloc(a, (size_t)batch->workers, sizeof *batch->slot);
  if (!batch->state || !batch->solved || !batch->attempts || !batch->damaged || !batch->origin ||
      !batch->next || !batch->slot)
    return AMBULO_E_MEMORY;
  ambulo_status status = assign(batch);
  for (int k = 0; k < batch->sweep->case_count && !status; k++) {
    if (may_start(batch, k)) status = take_record(batch, k);
  }
  return status;
}

void ambulo__queue_free(ambulo__supervisor *batch) {
  const ambulo_allocator *a = batch->allocator;
  ambulo__free(a, batch->state);
  ambulo__free(a, batch->solved);
  ambulo__free(a, batch->attempts);
  ambulo__free(a, batch->damaged);
  ambulo__free(a, batch->origin);
  ambulo__free(a, batch->next);
  ambulo__free(a, batch->slot);
}

/* 1: the case has to be computed, and may be now; never after a failure, which is in batch->status
 */
static int is_due(ambulo__supervisor *batch, int k) {
  if (batch->status || !may_start(batch, k)) return 0;
  if (batch->sweep->cases[k].previous >= 0) batch->status = take_record(batch, k);
  return !batch->status && batch->state[k] == AMBULO__CASE_WAITING;
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
  if (batch->state[index] == AMBULO__CASE_WAITING) return index; /* to be tried again */
  int next = batch->next[index];
  while (next >= 0 && !is_due(batch, next)) {
    if (batch->state[next] != AMBULO__CASE_DONE) return -1;
    next = batch->next[next];
  }
  return next;
}

unsigned long long ambulo__queue_origin(const ambulo__supervisor *batch, int index) {
  int from = ambulo__queue_start_of(batch, index);
  if (from < 0) return 0;
  unsigned long long hash = ambulo__hash_text(AMBULO__HASH_START, batch->sweep->cases[from].id);
  return ambulo__hash_word(hash, batch->origin[from]);
}

int ambulo__queue_start_of(const ambulo__supervisor *batch, int index) {
  int k = batch->sweep->cases[index].previous;
  while (k >= 0 && !batch->solved[k]) k = batch->sweep->cases[k].previous;
  return k;
}
