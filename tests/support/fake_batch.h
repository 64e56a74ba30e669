/* tests/support/fake_batch.h - a batch whose workers are a script that writes a result of three
 * lines in no time. The objective of case n of the list is 1 + n / 1000; or the same of all cases,
 * 1 + FAKE_VALUE behind the point, where the environment has that. Its max(tau.pin) is 7. */
#ifndef AMBULO_TESTS_FAKE_BATCH_H
#define AMBULO_TESTS_FAKE_BATCH_H

#include "support/sweep_files.h"

/* -p: a mkdir outlives a worker that is killed */
static const char fake_worker[] =
    "#!/bin/sh\n"
    "n=${5##*/}; n=${n%%-*}; n=${n#000000}; mkdir -p \"$5\" || exit 4; cd \"$5\" || exit 4\n"
    "echo '{\"verdict\": \"optimal\", \"objective\": {\"total\": 1.'${FAKE_VALUE:-$n}'},"
    " \"audit\": {\"violation\": {\"worst\": 1e-9}}}' >summary.json\n"
    "printf 'time,tau.pin\\n0,1\\n1,7\\n' >motion.csv\n"
    "echo 'ambulo: 1' >solution.yaml\n";

typedef struct fake_batch {
  void **state;
  ambulo_sweep *sweep;
  char folder[SCRATCH_PATH + 8];
} fake_batch;

static inline ambulo_status fake_batch_run(const fake_batch *b, const ambulo_allocator *allocator,
                                           ambulo_diagnostics *list) {
  ambulo_batch_options options = ambulo_batch_options_default();
  options.program = scratch_path(b->state, "worker");
  options.workers = 1;
  options.grace = 0.0;
  return ambulo_batch_run(b->sweep, b->folder, &options, allocator, list, NULL);
}

/* `study`: the sweep file below its head; 0 when the batch has run */
static inline int fake_batch_open(fake_batch *b, void **state, const char *study) {
  memset(b, 0, sizeof *b);
  b->state = state;
  (void)snprintf(b->folder, sizeof b->folder, "%s/b", (const char *)*state);
  scratch_write(scratch_path(state, "worker"), fake_worker);
  if (chmod(scratch_path(state, "worker"), 0700)) return -1;
  return sweep_load(state, study, NULL, &b->sweep) || fake_batch_run(b, NULL, NULL) ? -1 : 0;
}

static inline void fake_batch_close(fake_batch *b) {
  ambulo_sweep_free(b->sweep);
  b->sweep = NULL;
}

static inline const char *fake_batch_path(const fake_batch *b, const char *name) {
  char path[128];
  (void)snprintf(path, sizeof path, "b/%s", name);
  return scratch_path(b->state, path);
}

#endif
