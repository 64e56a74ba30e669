/* Result folders appear whole or not at all, and replace only earlier results. */
#include "formats/atomic_file.h"

#include <signal.h>
#include <sys/resource.h>

#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char *const result_names[] = {"summary.json", "motion.csv"};
static const ambulo__folder_mark mark = {"summary.json", "{", result_names, 2};

static ambulo__folder *begin(const char *path, const ambulo__folder_mark *known) {
  ambulo__folder *folder = NULL;
  assert_int_equal(ambulo__folder_begin(path, known, NULL, NULL, &folder), AMBULO_OK);
  return folder;
}

static void fill(ambulo__folder *folder, const char *text) {
  size_t length = strlen(text);
  assert_int_equal(ambulo__folder_write(folder, "summary.json", text, length, NULL), AMBULO_OK);
  assert_int_equal(ambulo__folder_write(folder, "motion.csv", "time\n", 5, NULL), AMBULO_OK);
}

/* the one thing in a folder: what is being written, under whatever name */
static void only_entry(const char *folder, char path[SCRATCH_PATH]) {
  DIR *entries = opendir(folder);
  assert_non_null(entries);
  path[0] = '\0';
  for (struct dirent *e; (e = readdir(entries)) != NULL;) {
    if (e->d_name[0] == '.' && strspn(e->d_name, ".") == strlen(e->d_name)) continue;
    assert_int_equal(path[0], '\0');
    assert_true(snprintf(path, SCRATCH_PATH, "%s/%s", folder, e->d_name) < SCRATCH_PATH);
  }
  closedir(entries);
}

static void a_folder_appears_only_on_commit(void **state) {
  const char *path = scratch_path(state, "out");
  ambulo__folder *folder = begin(scratch_path(state, "out//"), NULL);
  fill(folder, "{}");
  assert_int_not_equal(access(path, F_OK), 0);
  assert_int_equal(entries_in(*state), 1);
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  assert_file_equal(scratch_path(state, "out/summary.json"), "{}");
  assert_file_equal(scratch_path(state, "out/motion.csv"), "time\n");
  assert_int_equal(entries_in(*state), 1);
}

static void an_aborted_folder_leaves_nothing(void **state) {
  ambulo__folder *folder = begin(scratch_path(state, "out"), NULL);
  fill(folder, "{}");
  char temporary[SCRATCH_PATH], deeper[SCRATCH_PATH + 8];
  only_entry(*state, temporary);
  snprintf(deeper, sizeof deeper, "%s/deeper", temporary);
  assert_int_equal(mkdir(deeper, 0700), 0);
  ambulo__folder_abort(folder, NULL);
  ambulo__folder_abort(NULL, NULL);
  assert_int_equal(entries_in(*state), 0);
}

/* no part of a file stays in a folder that is committed all the same */
static void a_failed_file_leaves_nothing(void **state) {
  struct rlimit old, small;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
  small = old;
  small.rlim_cur = 4;
  (void)signal(SIGXFSZ, SIG_IGN);
  ambulo__folder *folder = begin(scratch_path(state, "out"), NULL);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  ambulo_status status = ambulo__folder_write(folder, "motion.csv", "time,q\n", 7, NULL);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
  assert_int_equal(status, AMBULO_E_IO);
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  assert_int_equal(entries_in(scratch_path(state, "out")), 0);
}

static void an_empty_folder_is_taken(void **state) {
  const char *path = scratch_path(state, "out");
  assert_int_equal(mkdir(path, 0700), 0);
  ambulo__folder *folder = begin(path, NULL);
  fill(folder, "{}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  assert_file_equal(scratch_path(state, "out/summary.json"), "{}");
}

static void earlier_results_are_replaced_only_when_asked(void **state) {
  const char *path = scratch_path(state, "out");
  ambulo__folder *folder = begin(path, NULL);
  fill(folder, "{old}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);

  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  folder = NULL;
  assert_int_equal(ambulo__folder_begin(path, NULL, NULL, list, &folder), AMBULO_E_IO);
  assert_null(folder);
  assert_message(list, 0, "exists and is not empty");
  ambulo_diagnostics_free(list);

  folder = begin(path, &mark);
  fill(folder, "{new}");
  assert_file_equal(scratch_path(state, "out/summary.json"), "{old}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  assert_file_equal(scratch_path(state, "out/summary.json"), "{new}");
  assert_int_equal(entries_in(path), 2);
  assert_int_equal(entries_in(*state), 1);
}

static void folders_that_are_no_results_are_never_replaced(void **state) {
  const char *path = scratch_path(state, "home");
  assert_int_equal(mkdir(path, 0700), 0);
  scratch_write(scratch_path(state, "home/thesis.tex"), "years of work");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__folder *folder = NULL;
  assert_int_equal(ambulo__folder_begin(path, &mark, NULL, list, &folder), AMBULO_E_IO);
  assert_message(list, 0, "holds no 'summary.json'");
  assert_file_equal(scratch_path(state, "home/thesis.tex"), "years of work");
  scratch_write(scratch_path(state, "home/summary.json"), "[\"of another program\"]");
  assert_int_equal(ambulo__folder_begin(path, &mark, NULL, list, &folder), AMBULO_E_IO);
  assert_message(list, 1, "holds no 'summary.json' of ambulo's");
  scratch_write(scratch_path(state, "home/summary.json"), "{}");
  assert_int_equal(ambulo__folder_begin(path, &mark, NULL, list, &folder), AMBULO_E_IO);
  assert_message(list, 2, "also holds 'thesis.tex'");
  assert_int_equal(unlink(scratch_path(state, "home/thesis.tex")), 0);
  assert_int_equal(mkdir(scratch_path(state, "home/photos"), 0700), 0);
  assert_int_equal(ambulo__folder_begin(path, &mark, NULL, list, &folder), AMBULO_E_IO);
  assert_message(list, 3, "also holds 'photos'");
  assert_null(folder);
  assert_int_equal(entries_in(*state), 1);
  ambulo_diagnostics_free(list);
}

static void what_appears_in_the_meantime_is_kept(void **state) {
  const char *path = scratch_path(state, "out");
  ambulo__folder *folder = begin(path, NULL);
  fill(folder, "{}");
  assert_int_equal(mkdir(path, 0700), 0);
  scratch_write(scratch_path(state, "out/other"), "theirs");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_E_IO);
  assert_file_equal(scratch_path(state, "out/other"), "theirs");
  assert_int_equal(entries_in(*state), 1);
}

static void impossible_places_and_names_are_refused(void **state) {
  scratch_write(scratch_path(state, "plain"), "x");
  ambulo__folder *folder = NULL;
  const char *places[3] = {"plain", "plain/out", "missing/out"};
  for (int i = 0; i < 3; i++) {
    const char *path = scratch_path(state, places[i]);
    assert_int_equal(ambulo__folder_begin(path, NULL, NULL, NULL, &folder), AMBULO_E_IO);
    assert_null(folder);
  }
  folder = begin(scratch_path(state, "out"), NULL);
  const char *names[4] = {"", ".", "..", "a/b"};
  for (int i = 0; i < 4; i++) {
    assert_int_equal(ambulo__folder_write(folder, names[i], "x", 1, NULL), AMBULO_E_ARGUMENT);
  }
  ambulo__folder_abort(folder, NULL);
  assert_int_equal(entries_in(*state), 1);
}

static void links_in_an_old_result_are_removed_not_followed(void **state) {
  const char *path = scratch_path(state, "out");
  ambulo__folder *folder = begin(path, NULL);
  fill(folder, "{old}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  scratch_write(scratch_path(state, "precious"), "kept");
  const char *link = scratch_path(state, "out/motion.csv");
  assert_int_equal(unlink(link), 0);
  assert_int_equal(symlink(scratch_path(state, "precious"), link), 0);
  folder = begin(path, &mark);
  fill(folder, "{new}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  assert_file_equal(scratch_path(state, "precious"), "kept");
  assert_int_equal(entries_in(*state), 2);
}

/* the one entry that is there besides */
static void what_cannot_be_removed_is_named(void **state) {
  const char *path = scratch_path(state, "out");
  char deep[SCRATCH_PATH + 64];
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__folder *folder = begin(path, NULL);
  fill(folder, "{old}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  (void)snprintf(deep, sizeof deep, "%s/motion.csv", path);
  assert_int_equal(unlink(deep), 0);
  for (int i = 0; i < 12; i++) { /* deeper than a result */
    assert_int_equal(mkdir(deep, 0700), 0);
    (void)strcat(deep, "/d");
  }
  folder = begin(path, &mark);
  fill(folder, "{new}");
  assert_int_equal(ambulo__folder_commit(folder, list), AMBULO_OK);
  assert_file_equal(scratch_path(state, "out/summary.json"), "{new}");
  assert_int_equal(entries_in(*state), 2);
  assert_int_equal(ambulo_diagnostics_count(list), 1);
  assert_message(list, 0, "out.old-");
  assert_message(list, 0, "warning: the earlier result stays here: it cannot be removed: ");
  ambulo_diagnostics_free(list);
}

/* of this place alone, and of processes that are gone */
static void what_a_killed_run_left_is_named(void **state) {
  static const char *const names[] = {"out.tmp-999999999-0", "out.old-999999999-3",  "out.old-1-0",
                                      "out.tmp-x-0",         "out2.tmp-999999999-0", "out.tmp-9"};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  for (int i = 0; i < 6; i++) assert_int_equal(mkdir(scratch_path(state, names[i]), 0700), 0);
  ambulo__folder *folder = begin(scratch_path(state, "out"), NULL);
  fill(folder, "{}");
  assert_int_equal(ambulo__folder_commit(folder, list), AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_count(list), 2);
  int first = strstr(ambulo_diagnostics_get(list, 0)->message, ".tmp-") == NULL;
  assert_message(list, (size_t)first, "a run that was cut off left 'out.tmp-999999999-0' here");
  assert_message(list, (size_t)!first, "a run that was cut off left 'out.old-999999999-3' here");
  assert_int_equal(entries_in(*state), 7);
  ambulo_diagnostics_free(list);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_open, scratch_close)

/* a result is replaced or stays, and nothing else is left behind */
static void every_failed_allocation_is_survived(void **state) {
  const char *path = scratch_path(state, "out");
  ambulo__folder *folder = begin(path, NULL);
  fill(folder, "{old}");
  assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
  for (long k = 0;; k++) {
    assert_in_range(k, 0, 100);
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    folder = NULL;
    ambulo_status status = ambulo__folder_begin(path, &mark, &hook, NULL, &folder);
    if (!status) status = ambulo__folder_write(folder, "summary.json", "{new}", 5, NULL);
    if (status) {
      ambulo__folder_abort(folder, NULL);
    } else {
      status = ambulo__folder_commit(folder, NULL);
    }
    assert_int_equal(memory.live, 0);
    assert_int_equal(entries_in(*state), 1);
    if (!memory.failed) {
      assert_int_equal(status, AMBULO_OK);
      break;
    }
    if (status) assert_file_equal(scratch_path(state, "out/summary.json"), "{old}");
  }
  assert_file_equal(scratch_path(state, "out/summary.json"), "{new}");
}

/* of what is replaced, with a folder in it, every stream is closed */
static void nothing_is_left_open(void **state) {
  const char *path = scratch_path(state, "out");
  if (access("/proc/self/fd", F_OK) != 0) skip();
  int open_before = entries_in("/proc/self/fd");
  for (int i = 0; i < 3; i++) {
    ambulo__folder *folder = begin(path, &mark);
    fill(folder, "{");
    if (i < 2)
      assert_int_equal(ambulo__folder_commit(folder, NULL), AMBULO_OK);
    else
      ambulo__folder_abort(folder, NULL);
  }
  assert_int_equal(entries_in("/proc/self/fd"), open_before);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      WITH_SCRATCH(a_folder_appears_only_on_commit),
      WITH_SCRATCH(an_aborted_folder_leaves_nothing),
      WITH_SCRATCH(nothing_is_left_open),
      WITH_SCRATCH(a_failed_file_leaves_nothing),
      WITH_SCRATCH(an_empty_folder_is_taken),
      WITH_SCRATCH(earlier_results_are_replaced_only_when_asked),
      WITH_SCRATCH(folders_that_are_no_results_are_never_replaced),
      WITH_SCRATCH(what_appears_in_the_meantime_is_kept),
      WITH_SCRATCH(impossible_places_and_names_are_refused),
      WITH_SCRATCH(links_in_an_old_result_are_removed_not_followed),
      WITH_SCRATCH(what_cannot_be_removed_is_named),
      WITH_SCRATCH(what_a_killed_run_left_is_named),
      WITH_SCRATCH(every_failed_allocation_is_survived),
  };
  return cmocka_run_group_tests_name("base/atomic_folder", tests, NULL, NULL);
}
