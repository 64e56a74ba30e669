/* Every step of collecting and verifying a batch fails once: the k-th file operation of
 * each kind, the k-th request for memory. No table says what is not so, and every failure has a
 * message. */
#define _DEFAULT_SOURCE /* syscall */
#include "study/results.h"
#include "support/fault_world.h"

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
  static const char *const names[] = {"results.csv", "results.jsonl"};
  for (int i = 0; i < 2; i++) (void)unlink(in_folder(names[i]));
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

/* ------------------------------------------------------------------- states */

static ambulo_status keep_state(void *user, const ambulo__row *row) {
  char *all = user;
  strcat(strcat(all, row->state), row->valid ? "+ " : " ");
  return AMBULO_OK;
}

/* of another sweep's list the cases are stale or missing; they keep their values of axes */
static void states_of_rows(void **state) {
  const ambulo_allocator plain = ambulo__allocator_or_default(NULL);
  ambulo_sweep *other = NULL;
  ambulo__table table;
  ambulo_batch_census census;
  char states[200] = "";
  assert_int_equal(sweep_load(state,
                              "axes:\n  - {key: model, values: [one.yaml]}\n"
                              "  - {key: time.duration, name: T, values: [1, 2]}\n"
                              "cases:\n  - {set: {time.intervals: 9}}\noutputs: [objective]\n",
                              NULL, &other),
                   AMBULO_OK);
  assert_int_equal(ambulo__study_describe(other, w.folder, &plain, NULL), AMBULO_OK);
  assert_int_equal(ambulo__table_open(w.folder, AMBULO__CELLS, NULL, NULL, &table), AMBULO_OK);
  assert_int_equal(ambulo__table_rows(&table, AMBULO__CELLS, keep_state, states, &census),
                   AMBULO_OK);
  assert_string_equal(states, "optimal+ stale missing ");
  assert_true(census.done == 1 && census.stale == 1 && census.missing == 1 && census.failed == 0);
  assert_string_equal(table.title[1], "T");
  ambulo__table_close(&table);
  ambulo_sweep_free(other);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, open_world, close_world)
  const struct CMUnitTest tests[] = {TEST(files_fail_while_it_collects),
                                     TEST(memory_fails_while_it_collects),
                                     TEST(files_fail_while_it_is_verified),
                                     TEST(memory_fails_while_it_is_verified), TEST(states_of_rows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
