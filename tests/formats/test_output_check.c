/* Outputs do not replace inputs, nor files of somebody else. */
#include "formats/output_check.h"
#include "support/messages.h"
#include "support/scratch.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(only_own_files_are_written_over),
                                     SCRATCH_TEST(the_input_is_known_by_every_name),
                                     SCRATCH_TEST(the_start_of_a_file)};
  return cmocka_run_group_tests_name("base/output_check", tests, NULL, NULL);
}
