/* tests/support/fault_world.h - a small batch, finished, with its table, for tests
 * in which steps of it fail. */
#ifndef AMBULO_TESTS_FAULT_WORLD_H
#define AMBULO_TESTS_FAULT_WORLD_H

#include "ambulo/tools/report.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/fake_batch.h"
#include "support/faulty_files.h"
#include "support/messages.h"

enum { CASES = 3 };

/* two cases in a chain, and one by itself */
static const char study[] = "axes:\n  - {key: model, values: [one.yaml]}\n"
                            "  - {key: time.duration, name: T, values: [1, 2]}\n"
                            "cases:\n  - {set: {time.intervals: 8}}\n"
                            "start_from: neighbour\nalong: T\n"
                            "outputs: [objective, max(tau.pin)]\n";

typedef struct world {
  fake_batch batch;
  const char *folder;
  char *table, *lines; /* of an undisturbed run */
} world;

static world w;

static inline ambulo_status run(const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  return fake_batch_run(&w.batch, allocator, list);
}

static inline const char *in_folder(const char *name) {
  return fake_batch_path(&w.batch, name);
}

static inline int open_world(void **state) {
  if (scratch_open(state) || fake_batch_open(&w.batch, state, study)) return -1;
  w.folder = w.batch.folder;
  if (ambulo_batch_collect(w.folder, NULL, NULL, NULL)) return -1;
  w.table = read_whole(in_folder("results.csv"));
  w.lines = read_whole(in_folder("results.jsonl"));
  return 0;
}

static inline int close_world(void **state) {
  free(w.table);
  free(w.lines);
  fake_batch_close(&w.batch);
  return scratch_close(state);
}

/* a failure has a message, and short memory is called that */
static inline void expect_told(ambulo_status status, const ambulo_diagnostics *list) {
  if (status && ambulo_diagnostics_error_count(list) == 0)
    print_error("%s without a message\n", ambulo_status_name(status));
  assert_true(!status || ambulo_diagnostics_error_count(list) > 0);
  for (size_t i = 0; status == AMBULO_E_MEMORY && i < ambulo_diagnostics_count(list); i++) {
    const ambulo_diagnostic *one = ambulo_diagnostics_get(list, i);
    if (one->severity != AMBULO_ERROR) continue;
    if (one->status != status) print_error("short of memory, but: %s\n", one->message);
    assert_int_equal(one->status, status);
  }
}

#endif
