/* The steps under atomic files: names, complete writes, flushing. */
#include "formats/file_steps.h"
#include "support/scratch.h"

#include <errno.h>

static void siblings_differ_by_process_and_number(void **state) {
  ambulo_allocator memory = ambulo__allocator_or_default(NULL);
  (void)state;
  char want[64], *name = ambulo__sibling_name(&memory, "dir/out", "tmp", 3);
  snprintf(want, sizeof want, "dir/out.tmp-%ld-3", (long)getpid());
  assert_string_equal(name, want);
  free(name);
  name = ambulo__join_path(&memory, "dir", "file");
  assert_string_equal(name, "dir/file");
  free(name);
}

static void writes_are_complete_or_report_why(void **state) {
  const char *path = scratch_path(state, "f");
  int file = open(path, O_WRONLY | O_CREAT, 0600);
  assert_int_equal(ambulo__write_all(file, "abc", 3), 0);
  close(file);
  assert_file_equal(path, "abc");
  file = open("/dev/full", O_WRONLY);
  if (file < 0) skip();
  assert_int_equal(ambulo__write_all(file, "abc", 3), -1);
  assert_int_equal(errno, ENOSPC);
  close(file);
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(siblings_differ_by_process_and_number),
      cmocka_unit_test_setup_teardown(writes_are_complete_or_report_why, scratch_open,
                                      scratch_close),
      cmocka_unit_test(no_memory_of_the_system_is_no_fault_of_the_file),
      cmocka_unit_test(parents_are_found_for_any_kind_of_path),
      cmocka_unit_test_setup_teardown(folders_are_flushed, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests_name("base/file_steps", tests, NULL, NULL);
}
