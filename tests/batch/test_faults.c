/* Every step of a batch, its table and its drawing fails once: the k-th file operation of each
 * kind, the k-th request for memory. Whatever happens, no table says what is not so, no case counts
 * that is not whole, every failure has a message, and the next run makes all good. */
#define _DEFAULT_SOURCE /* syscall */
#include "ambulo/report.h"
#include "support/fail_alloc.h"
#include "support/fake_batch.h"
#include "support/faulty_files.h"
#include "support/messages.h"

enum { CASES = 3 };

/* two cases in a chain, and one by itself */
static const char study[] = "axes:\n  - {key: time.duration, name: T, values: [1, 2]}\n"
                            "cases:\n  - {set: {time.intervals: 8}}\n"
                            "start_from: neighbour\nalong: T\n"
                            "outputs: [objective, max(tau.pin)]\n";

typedef struct world {
  fake_batch batch;
  const char *folder;
  char *table, *lines, *drawing; /* of an undisturbed run */
} world;

static world w;

static ambulo_status run(const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  return fake_batch_run(&w.batch, allocator, list);
}

static const char *in_folder(const char *name) {
  return fake_batch_path(&w.batch, name);
}

static ambulo_status draw(const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  char *file = NULL;
  ambulo_status status = ambulo_batch_plot(w.folder, "T:objective", NULL, allocator, list, &file);
  ambulo_text_free(file, allocator);
  return status;
}

static int open_world(void **state) {
  if (scratch_open(state) || fake_batch_open(&w.batch, state, study)) return -1;
  w.folder = w.batch.folder;
  if (ambulo_batch_collect(w.folder, NULL, NULL, NULL) || draw(NULL, NULL)) return -1;
  w.table = read_whole(in_folder("results.csv"));
  w.lines = read_whole(in_folder("results.jsonl"));
  w.drawing = read_whole(in_folder("results_T_objective.svg"));
  return 0;
}

static int close_world(void **state) {
  free(w.table);
  free(w.lines);
  free(w.drawing);
  fake_batch_close(&w.batch);
  return scratch_close(state);
}

/* a failure has a message, and short memory is called that */
static void expect_told(ambulo_status status, const ambulo_diagnostics *list) {
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

/* every case that has a record is whole: nothing that a fault left half done counts */
static void expect_no_half_cases(void) {
  ambulo_batch_census census;
  if (access(in_folder("batch.json"), F_OK) || access(in_folder("cases.tsv"), F_OK)) return;
  assert_int_equal(ambulo_batch_verify(w.folder, NULL, NULL, NULL, NULL, &census), AMBULO_OK);
  assert_int_equal(census.corrupt, 0);
  assert_int_equal(census.stale, 0);
  assert_int_equal(census.failed, 0);
}

/* the same command again makes everything good */
static void expect_good_in_the_end(void) {
  ambulo_batch_census census;
  assert_int_equal(run(NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo_batch_collect(w.folder, NULL, NULL, &census), AMBULO_OK);
  assert_int_equal(census.done, CASES);
  char *table = read_whole(in_folder("results.csv")),
       *lines = read_whole(in_folder("results.jsonl"));
  assert_string_equal(table, w.table);
  assert_string_equal(lines, w.lines);
  free(table);
  free(lines);
}

/* -------------------------------------------------------------------- batch */

static void files_fail_while_it_runs(void **state) {
  (void)state;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    long k = 0;
    for (;; k++) {
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      (void)scratch_remove_at(AT_FDCWD, w.folder);
      fault_arm((fault_kind)kind, k);
      ambulo_status status = run(NULL, list);
      int hit = fault_disarm();
      expect_told(status, list);
      ambulo_diagnostics_free(list);
      expect_no_half_cases();
      expect_good_in_the_end();
      if (!hit) break;
    }
    print_message("batch, %s: %ld\n", fault_names[kind], k);
    assert_true(k > 0);
  }
}

/* finished results that cannot be read are computed again, never taken or left out in silence */
static void files_fail_while_it_resumes(void **state) {
  (void)state;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (long k = 0;; k++) {
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      fault_arm((fault_kind)kind, k);
      ambulo_status status = run(NULL, list);
      int hit = fault_disarm();
      expect_told(status, list);
      ambulo_diagnostics_free(list);
      expect_no_half_cases();
      expect_good_in_the_end();
      if (!hit) break;
    }
  }
}

static void memory_fails_while_it_runs(void **state) {
  (void)state;
  long k = 0;
  for (;; k += 1 + k / 20) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    if (k % 2) (void)scratch_remove_at(AT_FDCWD, w.folder);
    ambulo_status status = run(&hook, list);
    expect_told(status, list);
    assert_int_equal(memory.live, 0);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_diagnostics_free(list);
    expect_no_half_cases();
    expect_good_in_the_end();
    if (!memory.failed) break;
  }
  print_message("batch, memory: up to %ld\n", k);
}

/* -------------------------------------------------------------------- table */

/* lines of a table: each is that of the undisturbed one, or says that its case is corrupt */
static int corrupt_lines(const char *got, const char *good, const char *mark) {
  int corrupt = 0;
  while (*got && *good) {
    size_t length = strcspn(got, "\n"), want = strcspn(good, "\n");
    if (length != want || memcmp(got, good, length) != 0) {
      char line[512];
      (void)snprintf(line, sizeof line, "%.*s", (int)length, got);
      if (!strstr(line, mark)) print_error("a wrong line: %s\n", line);
      assert_non_null(strstr(line, mark));
      corrupt++;
    }
    got += length + 1;
    good += want + 1;
  }
  assert_int_equal(*got, *good);
  return corrupt;
}

static void remove_tables(void) {
  static const char *const names[] = {"results.csv", "results.jsonl", "results_T_objective.svg"};
  for (int i = 0; i < 3; i++) (void)unlink(in_folder(names[i]));
}

/* after a failure there is no table, or a right one; after none it says what it lacks */
static void expect_true_table(ambulo_status status, const ambulo_batch_census *census) {
  static const char *const names[] = {"results.csv", "results.jsonl"};
  static const char *const marks[] = {",corrupt,", "\"state\": \"corrupt\""};
  for (int i = 0; i < 2; i++) {
    if (access(in_folder(names[i]), F_OK)) {
      assert_true(status != AMBULO_OK);
      continue;
    }
    char *text = read_whole(in_folder(names[i]));
    int corrupt = corrupt_lines(text, i ? w.lines : w.table, marks[i]);
    if (!status) assert_int_equal(corrupt, census->corrupt);
    free(text);
  }
}

static void files_fail_while_it_collects(void **state) {
  (void)state;
  int partial = 0;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (long k = 0;; k++) {
      ambulo_batch_census census;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      remove_tables();
      fault_arm((fault_kind)kind, k);
      ambulo_status status = ambulo_batch_collect(w.folder, NULL, list, &census);
      int hit = fault_disarm();
      expect_told(status, list);
      expect_true_table(status, &census);
      if (!status && census.corrupt > 0) {
        assert_message(list, 0, "damaged: ");
        partial++;
      }
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
  assert_true(partial > CASES);
}

static void memory_fails_while_it_collects(void **state) {
  (void)state;
  for (int only_once = 0; only_once < 2; only_once++) {
    for (long k = 0;; k++) {
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = only_once;
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_batch_census census;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      remove_tables();
      ambulo_status status = ambulo_batch_collect(w.folder, &hook, list, &census);
      assert_int_equal(memory.live, 0);
      expect_told(status, list);
      /* what is lost without memory may be a hint, never a value or a row */
      assert_true(status == AMBULO_E_MEMORY || (!status && census.done == CASES));
      assert_true(status == AMBULO_OK || memory.failed);
      expect_true_table(status, &census);
      ambulo_diagnostics_free(list);
      if (!memory.failed) break;
    }
  }
}

/* ------------------------------------------------------- state, verification */

static void files_fail_while_it_is_verified(void **state) {
  (void)state;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (int verify = 0; verify < 2; verify++) {
      for (long k = 0;; k++) {
        ambulo_batch_census census;
        ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
        fault_arm((fault_kind)kind, k);
        ambulo_status status = verify
                                   ? ambulo_batch_verify(w.folder, NULL, NULL, NULL, list, &census)
                                   : ambulo_batch_status(w.folder, NULL, list, &census);
        int hit = fault_disarm();
        expect_told(status, list);
        if (!status) assert_int_equal(census.done + census.corrupt, CASES);
        if (!status && !hit) assert_int_equal(census.done, CASES);
        ambulo_diagnostics_free(list);
        if (!hit) break;
      }
    }
  }
}

static void memory_fails_while_it_is_verified(void **state) {
  (void)state;
  for (int verify = 0; verify < 2; verify++) {
    for (long k = 0;; k++) {
      fail_alloc memory = fail_alloc_at(k);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_batch_census census;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_status status = verify
                                 ? ambulo_batch_verify(w.folder, NULL, NULL, &hook, list, &census)
                                 : ambulo_batch_status(w.folder, &hook, list, &census);
      expect_told(status, list);
      assert_int_equal(memory.live, 0);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
      if (!status) assert_int_equal(census.done, CASES);
      ambulo_diagnostics_free(list);
      if (!memory.failed) break;
    }
  }
}

/* ------------------------------------------------------------------ drawing */

static void expect_true_drawing(ambulo_status status) {
  if (access(in_folder("results_T_objective.svg"), F_OK)) {
    assert_true(status != AMBULO_OK);
    return;
  }
  char *text = read_whole(in_folder("results_T_objective.svg"));
  if (strcmp(text, w.drawing) != 0) assert_non_null(strstr(text, "corrupt"));
  free(text);
}

static void files_fail_while_it_is_drawn(void **state) {
  (void)state;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (long k = 0;; k++) {
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      remove_tables();
      fault_arm((fault_kind)kind, k);
      ambulo_status status = draw(NULL, list);
      int hit = fault_disarm();
      expect_told(status, list);
      expect_true_drawing(status);
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
}

static void memory_fails_while_it_is_drawn(void **state) {
  (void)state;
  for (int only_once = 0; only_once < 2; only_once++) {
    for (long k = 0;; k++) {
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = only_once;
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      remove_tables();
      ambulo_status status = draw(&hook, list);
      expect_told(status, list);
      assert_int_equal(memory.live, 0);
      assert_true(status == AMBULO_OK || (status == AMBULO_E_MEMORY && memory.failed));
      if (!status) {
        char *drawing = read_whole(in_folder("results_T_objective.svg"));
        assert_string_equal(drawing, w.drawing);
        free(drawing);
      }
      ambulo_diagnostics_free(list);
      if (!memory.failed) break;
    }
  }
}

/* -------------------------------------------------------------------- sweep */

static void files_fail_while_the_sweep_is_read(void **state) {
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (long k = 0;; k++) {
      ambulo_sweep *sweep = NULL;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      fault_arm((fault_kind)kind, k);
      ambulo_status status = ambulo_sweep_load(scratch_path(state, "s.yaml"), NULL, list, &sweep);
      int hit = fault_disarm();
      expect_told(status, list);
      ambulo_case one, same;
      for (int i = 0; sweep && i < CASES; i++) {
        assert_int_equal(ambulo_sweep_case(sweep, i, &one), AMBULO_OK);
        assert_int_equal(ambulo_sweep_case(w.batch.sweep, i, &same), AMBULO_OK);
        assert_true(one.key == same.key);
      }
      ambulo_sweep_free(sweep);
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
}

static void memory_fails_while_the_sweep_is_read(void **state) {
  long k = 0, requests = 0;
  for (;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_sweep *sweep = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_status status = ambulo_sweep_load(scratch_path(state, "s.yaml"), &hook, list, &sweep);
    expect_told(status, list);
    if (status != (memory.failed ? AMBULO_E_MEMORY : AMBULO_OK)) {
      print_error("request %ld: %s\n", k, ambulo_status_name(status));
      fail();
    }
    requests = memory.requests;
    ambulo_sweep_free(sweep);
    assert_int_equal(memory.live, 0);
    ambulo_diagnostics_free(list);
    if (!memory.failed) break;
  }
  print_message("sweep, memory: %ld\n", requests);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, open_world, close_world)
  const struct CMUnitTest tests[] = {TEST(files_fail_while_it_runs),
                                     TEST(files_fail_while_it_resumes),
                                     TEST(memory_fails_while_it_runs),
                                     TEST(files_fail_while_it_collects),
                                     TEST(memory_fails_while_it_collects),
                                     TEST(files_fail_while_it_is_verified),
                                     TEST(memory_fails_while_it_is_verified),
                                     TEST(files_fail_while_it_is_drawn),
                                     TEST(memory_fails_while_it_is_drawn),
                                     TEST(files_fail_while_the_sweep_is_read),
                                     TEST(memory_fails_while_the_sweep_is_read)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
