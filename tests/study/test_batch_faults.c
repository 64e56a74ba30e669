/* Every step of a batch fails once: the k-th file operation of each kind, the k-th request for
 * memory. Whatever happens, no case counts that is not whole, every failure has a message, and the
 * next run makes all good. */
#define _DEFAULT_SOURCE /* syscall */
#include "support/fault_world.h"

/* every case that has a record is whole: nothing that a fault left half done counts */
static void expect_no_half_cases(void) {
  ambulo_batch_census census;
  if (access(in_folder("batch.json"), F_OK) || access(in_folder("cases.tsv"), F_OK)) return;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_batch_verify(w.folder, NULL, NULL, NULL, list, &census);
  if (status) print_error("%s\n", ambulo_diagnostics_get(list, 0)->message);
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  assert_int_equal(census.corrupt, 0);
  assert_int_equal(census.stale, 0);
  assert_int_equal(census.failed, 0);
}

/* the same command again makes everything good */
static void expect_good_in_the_end(void) {
  ambulo_batch_census census;
  assert_int_equal(run(NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo_batch_verify(w.folder, NULL, NULL, NULL, NULL, &census), AMBULO_OK);
  assert_int_equal(census.done, CASES);
}

/* and then the table is that of an undisturbed run */
static void expect_good_table(void) {
  assert_int_equal(ambulo_batch_collect(w.folder, NULL, NULL, NULL), AMBULO_OK);
  char *table = read_whole(in_folder("results.csv"));
  char *lines = read_whole(in_folder("results.jsonl"));
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
    expect_good_table();
    assert_true(k > 0);
  }
}

/* of another shard's lock that cannot be looked for it is not known that there is none */
static void shards_do_not_run_unguarded(void **state) {
  (void)state;
  for (long k = 0;; k++) {
    ambulo_batch_options options = ambulo_batch_options_default();
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    options.program = scratch_path(w.batch.state, "worker");
    options.workers = options.shard = 1;
    options.shards = 2;
    fault_arm(FAULT_OPENDIR, k);
    ambulo_status status = ambulo_batch_run(w.batch.sweep, w.folder, &options, NULL, list, NULL);
    int hit = fault_disarm();
    assert_int_equal(status, hit ? AMBULO_E_IO : AMBULO_OK);
    expect_told(status, list);
    ambulo_diagnostics_free(list);
    if (!hit) break;
    assert_true(k < 20);
  }
}

/* nor is it overlooked that the folder belongs to another sweep */
static void other_inputs_are_refused_whatever_fails(void **state) {
  static const fault_kind kinds[] = {FAULT_OPEN, FAULT_READ, FAULT_STAT, FAULT_OPENDIR};
  fake_batch other = {.state = state};
  memcpy(other.folder, w.folder, strlen(w.folder) + 1);
  assert_int_equal(sweep_load(state, "axes:\n  - {key: time.duration, name: T, values: [3, 4]}\n",
                              NULL, &other.sweep),
                   AMBULO_OK);
  char *mark = read_whole(in_folder("batch.json"));
  for (size_t i = 0; i <= sizeof kinds / sizeof *kinds; i++) {
    for (long k = 0;; k++) {
      int by_memory = i == sizeof kinds / sizeof *kinds;
      fail_alloc memory = fail_alloc_at(by_memory ? k : -1);
      ambulo_allocator hook = fail_alloc_hook(&memory);
      if (!by_memory) fault_arm(kinds[i], k);
      ambulo_status status = fake_batch_run(&other, &hook, NULL);
      int hit = fault_disarm() || memory.failed;
      assert_true(status == AMBULO_E_PROBLEM || (hit && status != AMBULO_OK));
      assert_file_equal(in_folder("batch.json"), mark);
      if (!hit) break;
    }
  }
  free(mark);
  fake_batch_close(&other);
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
  expect_good_table();
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
                                     TEST(shards_do_not_run_unguarded),
                                     TEST(other_inputs_are_refused_whatever_fails),
                                     TEST(files_fail_while_it_resumes),
                                     TEST(memory_fails_while_it_runs),
                                     TEST(files_fail_while_the_sweep_is_read),
                                     TEST(memory_fails_while_the_sweep_is_read)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
