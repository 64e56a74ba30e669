/* study/batch_tally.c - what became of the cases of a run: how many ended in which state, and what
 * the first one without a result said (batch.h). */
#include "formats/read_file.h"
#include "study/batch.h"

#include <stdio.h>
#include <string.h>

enum { MOST_LOG_BYTES = 2 << 20 };

const char *ambulo__first_error(const char *log) {
  const char *error = strstr(log, "error[");
  while (error && error > log && error[-1] != '\n') error--;
  return error;
}

static void count_state(ambulo_batch_progress *p, const char *state) {
  for (int i = 0; i < AMBULO_BATCH_STATES; i++) {
    ambulo_batch_tally *tally = &p->tally[i];
    if (tally->cases == 0) (void)snprintf(tally->state, sizeof tally->state, "%s", state);
    if (strcmp(tally->state, state) != 0) continue;
    tally->cases++;
    return;
  }
}

/* "case 'fast' (invalid): walk.yaml:3:5: error[E_PROBLEM]: ..." */
static void keep_refusal(ambulo_batch_progress *p, const char *name, const char *state,
                         const char *log) {
  const char *error = ambulo__first_error(log);
  (void)snprintf(p->refusal, sizeof p->refusal, "case '%.80s' (%s)%s%.*s", name, state,
                 error ? ": " : "", error ? (int)strcspn(error, "\n") : 0, error ? error : "");
}

/* what it said in an earlier run; a file that cannot be read says nothing */
static void keep_earlier(ambulo__supervisor *batch, const ambulo__sweep_case *one,
                         const char *state) {
  const ambulo_allocator *a = batch->allocator;
  char *text = NULL, *path = ambulo__case_path(a, batch->directory, one->id, ".log");
  size_t length = 0;
  if (path && ambulo__read_file(path, MOST_LOG_BYTES, a, NULL, &text, &length)) text = NULL;
  keep_refusal(&batch->progress, one->name, state, text ? text : "");
  ambulo__free(a, text);
  ambulo__free(a, path);
}

void ambulo__tally_case(ambulo__supervisor *batch, int index, const ambulo__record *record,
                        const char *log) {
  ambulo_batch_progress *p = &batch->progress;
  const ambulo__sweep_case *one = &batch->sweep->cases[index];
  p->done++;
  p->failed += !record->valid;
  count_state(p, record->state);
  if (ambulo__record_has_result(record)) return;
  p->no_result++;
  if (p->refusal[0]) return;
  if (log)
    keep_refusal(p, one->name, record->state, log);
  else
    keep_earlier(batch, one, record->state);
}
