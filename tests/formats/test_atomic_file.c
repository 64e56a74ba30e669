/* Files appear whole or not at all; nothing temporary is left. */
#define _GNU_SOURCE
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "support/fail_alloc.h"
#include "support/fail_io.h"
#include "support/messages.h"
#include "support/scratch.h"

#include <errno.h>
#include <signal.h>
#include <sys/resource.h>

static void files_are_created_and_replaced(void **state) {
  const char *path = scratch_path(state, "result.csv");
  assert_int_equal(ambulo__write_file(path, "one", 3, 0, NULL, NULL), AMBULO_OK);
  assert_file_equal(path, "one");
  assert_int_equal(ambulo__write_file(path, "two", 3, 1, NULL, NULL), AMBULO_OK);
  assert_file_equal(path, "two");
  assert_int_equal(ambulo__write_file(path, "", 0, 1, NULL, NULL), AMBULO_OK);
  assert_file_equal(path, "");
  assert_int_equal(entries_in(*state), 1);
}

static void the_umask_decides_on_permissions(void **state) {
  const char *path = scratch_path(state, "f");
  struct stat info;
  mode_t before = umask(027);
  assert_int_equal(ambulo__write_file(path, "x", 1, 0, NULL, NULL), AMBULO_OK);
  umask(before);
  assert_int_equal(stat(path, &info), 0);
  assert_int_equal(info.st_mode & 0777, 0640);
}

static void expect_failure(const char *path, int replace, const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__write_file(path, "new", 3, replace, NULL, list), AMBULO_E_IO);
  assert_message(list, 0, message);
  assert_message(list, 0, path);
  ambulo_diagnostics_free(list);
}

static void existing_files_are_kept_unless_asked(void **state) {
  const char *path = scratch_path(state, "f");
  scratch_write(path, "old");
  expect_failure(path, 0, "exists already");
  assert_file_equal(path, "old");
  assert_int_equal(entries_in(*state), 1);
}

static void impossible_places_are_reported(void **state) {
  expect_failure(*state, 1, "a folder of that name exists");
  expect_failure(scratch_path(state, "missing/f"), 1, "No such file");
  scratch_write(scratch_path(state, "plain"), "");
  expect_failure(scratch_path(state, "plain/f"), 1, "Not a directory");
  assert_int_equal(entries_in(*state), 1);
}

static void a_full_device_is_reported(void **state) {
  (void)state;
  if (access("/dev/full", W_OK) != 0) skip();
  expect_failure("/dev/full", 1, "No space left");
  struct stat info;
  assert_int_equal(stat("/dev/full", &info), 0);
  assert_true(S_ISCHR(info.st_mode));
}

/* a size limit of the process stands for a full disk: the write fails half-way */
static void a_failed_write_keeps_the_old_file_and_leaves_nothing(void **state) {
  const char *path = scratch_path(state, "f");
  scratch_write(path, "old");
  static char large[100000];
  struct rlimit limit, small;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
  small = limit;
  small.rlim_cur = 5000;
  struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
  sigaction(SIGXFSZ, &ignore, &before);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  ambulo_status status = ambulo__write_file(path, large, sizeof large, 1, NULL, NULL);
  setrlimit(RLIMIT_FSIZE, &limit);
  sigaction(SIGXFSZ, &before, NULL);
  assert_int_equal(status, AMBULO_E_IO);
  assert_file_equal(path, "old");
  assert_int_equal(entries_in(*state), 1);
}

static void stale_temporaries_do_not_block(void **state) {
  char name[64];
  snprintf(name, sizeof name, "f.tmp-%ld-0", (long)getpid());
  scratch_write(scratch_path(state, name), "left by a killed process");
  const char *path = scratch_path(state, "f");
  assert_int_equal(ambulo__write_file(path, "new", 3, 0, NULL, NULL), AMBULO_OK);
  assert_file_equal(path, "new");
}

/* whichever step fails: a message, the old file or the whole new one, and nothing besides */
static void every_step_may_fail(void **state) {
  const char *path = scratch_path(state, "f");
  int faults = 0;
  for (int at = 0; at < 2 * FAIL_IO_STEPS; at++) {
    int step = at / 2, replace = at % 2;
    for (long k = 0;; k++) {
      assert_in_range(k, 0, 20);
      unlink(path);
      if (replace) scratch_write(path, "old");
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      fail_io_arm(step, k);
      ambulo_status status = ambulo__write_file(path, "new", 3, replace, NULL, list);
      int failed = fail_io_disarm(), there = access(path, F_OK) == 0;
      faults += failed;
      /* closing the folder, when all is flushed, changes nothing any more */
      int told = failed && !(step == FAIL_IO_CLOSE && k == 1);
      assert_int_equal(status, told ? AMBULO_E_IO : AMBULO_OK);
      assert_int_equal(ambulo_diagnostics_error_count(list), told);
      if (told) assert_message(list, 0, "Input/output error");
      char text[8] = "";
      FILE *file = there ? fopen(path, "r") : NULL;
      if (file) text[fread(text, 1, 7, file)] = '\0';
      if (file) fclose(file);
      assert_true(failed || there);
      assert_true(!there || !strcmp(text, "new") || (failed && replace && !strcmp(text, "old")));
      assert_true(there || !replace);
      assert_int_equal(entries_in(*state), there);
      ambulo_diagnostics_free(list);
      if (!failed) break;
    }
  }
  assert_in_range(faults, 12, 30);
}

/* allocations of the writer come after its look at the place: here somebody writes meanwhile */
static void *resize_and_intrude(void *user, void *pointer, size_t size) {
  if (size > 0 && access(user, F_OK) != 0) scratch_write(user, "years of work");
  if (size > 0) return realloc(pointer, size);
  free(pointer);
  return NULL;
}

static void what_appears_in_the_meantime_is_kept(void **state) {
  char path[SCRATCH_PATH + 256];
  snprintf(path, sizeof path, "%s", scratch_path(state, "f"));
  ambulo_allocator intruder = {resize_and_intrude, path};
  assert_int_equal(ambulo__write_file(path, "new", 3, 0, &intruder, NULL), AMBULO_E_IO);
  assert_file_equal(path, "years of work");
  assert_int_equal(entries_in(*state), 1);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, scratch_open, scratch_close)

/* The steps under atomic files: names, complete writes, flushing. */

static void siblings_differ_by_process_and_number(void **state) {
  ambulo_allocator memory = ambulo__allocator_or_default(NULL);
  (void)state;
  char want[64], *name = ambulo__sibling_name(&memory, "dir/out", "tmp", 3);
  snprintf(want, sizeof want, "dir/out.tmp-%ld-3", (long)getpid());
  assert_string_equal(name, want);
  free(name);
}

static void writes_are_complete_or_report_why(void **state) {
  const char *path = scratch_path(state, "f");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int file = open(path, O_WRONLY | O_CREAT, 0600);
  assert_int_equal(ambulo__fill_file(file, path, "abc", 3, 1, list), AMBULO_OK);
  assert_file_equal(path, "abc");
  assert_int_equal(ambulo__fill_file(open("no/such", O_WRONLY), "no/such", "abc", 3, 0, list),
                   AMBULO_E_IO);
  assert_message(list, 0, "no/such: error[E_IO]: cannot open for writing: No such file");
  file = open("/dev/full", O_WRONLY);
  if (file >= 0) {
    assert_int_equal(ambulo__fill_file(file, "/dev/full", "abc", 3, 0, list), AMBULO_E_IO);
    assert_message(list, 1, "cannot write: No space left");
  }
  ambulo_diagnostics_free(list);
}

/* a call of the system that finds no memory is told like one of ours */
static void no_memory_of_the_system_is_no_fault_of_the_file(void **state) {
  (void)state;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  errno = ENOMEM;
  assert_int_equal(ambulo__io_error(list, "f", "read the folder"), AMBULO_E_MEMORY);
  errno = EIO;
  assert_int_equal(ambulo__io_error(list, "f", "read"), AMBULO_E_IO);
  assert_int_equal(ambulo_diagnostics_get(list, 0)->status, AMBULO_E_MEMORY);
  assert_int_equal(ambulo_diagnostics_get(list, 1)->status, AMBULO_E_IO);
  ambulo_diagnostics_free(list);
}

static void parents_are_found_for_any_kind_of_path(void **state) {
  (void)state;
  ambulo_allocator memory = ambulo__allocator_or_default(NULL);
  const char *pairs[4][2] = {{"f", "."}, {"/f", "/"}, {"a/b/f", "a/b"}, {"./f", "."}};
  for (int i = 0; i < 4; i++) {
    char *parent = ambulo__parent_path(&memory, pairs[i][0]);
    assert_string_equal(parent, pairs[i][1]);
    free(parent);
  }
}

static void folders_are_flushed(void **state) {
  assert_int_equal(ambulo__sync_folder(*state), 0);
  assert_int_equal(ambulo__sync_folder("/"), 0);
  assert_int_equal(ambulo__sync_folder(scratch_path(state, "missing")), -1);
  assert_int_equal(errno, ENOENT);
}

/* Outputs do not replace inputs, nor files of somebody else. */

static const char own[] = "# ambulo motion; SI units\ntime\n0\n";

static void refused(const char *output, const char *input, const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *inputs[] = {NULL, input};
  assert_int_equal(ambulo__output_check(output, inputs, 2, 0, list), AMBULO_E_IO);
  assert_message(list, 0, message);
  assert_message(list, 0, "--force");
  assert_int_equal(ambulo__output_check(output, inputs, 2, 1, list), AMBULO_OK);
  ambulo_diagnostics_free(list);
}

static void accepted(const char *output) {
  const char *inputs[] = {"no/such/file"};
  assert_int_equal(ambulo__output_check(output, inputs, 1, 0, NULL), AMBULO_OK);
}

static void only_own_files_are_written_over(void **state) {
  const char *path = scratch_path(state, "out.csv");
  accepted(path);
  scratch_write(path, "");
  accepted(path);
  scratch_write(path, own);
  accepted(path);
  scratch_write(path, "# SI units and radians: time s; q rad or m, qd per s\ntime\n");
  accepted(path);
  static const char *const others[] = {"time,x\n", "#", "# ambul", "ambulo: 1\nkind: model\n",
                                       " # ambulo motion\n"};
  for (int i = 0; i < 5; i++) {
    scratch_write(path, others[i]);
    refused(path, NULL, "ambulo did not write it");
  }
  accepted(*state); /* a folder: the writer says what is wrong with it */
  accepted("/dev/null");
  accepted("/dev/full");
}

static void the_input_is_known_by_every_name(void **state) {
  const char *motion = scratch_path(state, "motion.csv"), *hard = scratch_path(state, "hard.csv");
  const char *soft = scratch_path(state, "soft.csv"), *folder = scratch_path(state, "folder");
  scratch_write(motion, own);
  assert_int_equal(link(motion, hard), 0);
  assert_int_equal(symlink(motion, soft), 0);
  assert_int_equal(mkdir(folder, 0700), 0);
  refused(motion, motion, "is the input");
  refused(hard, motion, "is the input");
  refused(soft, motion, motion);
  refused(motion, soft, "is the input");
  refused(scratch_path(state, "folder/../motion.csv"), motion, "is the input");
  accepted(motion);
}

static void the_start_of_a_file(void **state) {
  const char *path = scratch_path(state, "file");
  scratch_write(path, "abcdef");
  assert_true(ambulo__file_says(path, "abc", 3));
  assert_false(ambulo__file_says(path, "bcd", 3));
  assert_true(ambulo__file_says(path, "bcd", 4));
  assert_true(ambulo__file_says(path, "def", 100));
  assert_false(ambulo__file_says(path, "defg", 100));
  assert_false(ambulo__file_says(scratch_path(state, "none"), "abc", 3));
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

/* no block and no open file is left, where memory gives out either */
static void nothing_is_left_open(void **state) {
  const char *path = scratch_path(state, "f");
  int open_before = access("/proc/self/fd", F_OK) == 0 ? entries_in("/proc/self/fd") : 0;
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__write_file(path, "x", 1, 1, &hook, NULL);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_int_equal(entries_in(*state), 0);
  }
  if (open_before) assert_int_equal(entries_in("/proc/self/fd"), open_before);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      WITH_SCRATCH(files_are_created_and_replaced),
      WITH_SCRATCH(the_umask_decides_on_permissions),
      WITH_SCRATCH(existing_files_are_kept_unless_asked),
      WITH_SCRATCH(impossible_places_are_reported),
      WITH_SCRATCH(a_full_device_is_reported),
      WITH_SCRATCH(a_failed_write_keeps_the_old_file_and_leaves_nothing),
      WITH_SCRATCH(every_step_may_fail),
      WITH_SCRATCH(what_appears_in_the_meantime_is_kept),
      WITH_SCRATCH(stale_temporaries_do_not_block),
      WITH_SCRATCH(nothing_is_left_open),
      cmocka_unit_test(siblings_differ_by_process_and_number),
      cmocka_unit_test_setup_teardown(writes_are_complete_or_report_why, scratch_open,
                                      scratch_close),
      cmocka_unit_test(no_memory_of_the_system_is_no_fault_of_the_file),
      cmocka_unit_test(parents_are_found_for_any_kind_of_path),
      cmocka_unit_test_setup_teardown(folders_are_flushed, scratch_open, scratch_close),
      SCRATCH_TEST(only_own_files_are_written_over),
      SCRATCH_TEST(the_input_is_known_by_every_name),
      SCRATCH_TEST(the_start_of_a_file)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
