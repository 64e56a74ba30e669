/* Reading whole files: what is given, and what is refused without blocking. */
#define _GNU_SOURCE
#include "formats/read_file.h"
#include "support/fail_io.h"
#include "support/messages.h"
#include "support/scratch.h"

static void bytes_come_back_with_a_terminator(void **state) {
  const char *path = scratch_path(state, "a b \xC3\xA4.txt");
  scratch_write(path, "two\r\nlines");
  char *text = NULL;
  size_t length = 0;
  assert_int_equal(ambulo__read_file(path, 10, NULL, NULL, &text, &length), AMBULO_OK);
  assert_int_equal(length, 10);
  assert_string_equal(text, "two\r\nlines");
  free(text);
}

/* longer than the piece it is read in; of a file that cannot be read there is none */
static void checksums_are_of_the_whole_file(void **state) {
  enum { LENGTH = 200000 };
  char *text = malloc(LENGTH + 1), want[AMBULO__SHA256_TEXT], got[AMBULO__SHA256_TEXT] = "none";
  assert_non_null(text);
  for (int i = 0; i < LENGTH; i++) text[i] = (char)('a' + i % 26);
  text[LENGTH] = '\0';
  const char *path = scratch_path(state, "long");
  scratch_write(path, text);
  ambulo__sha256_of(text, LENGTH, want);
  assert_int_equal(ambulo__digest_file(path, NULL, got), AMBULO_OK);
  assert_string_equal(got, want);
  free(text);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__digest_file(scratch_path(state, "none"), list, got), AMBULO_E_IO);
  assert_message(list, 0, "none: error[E_IO]: cannot open: No such file");
  assert_int_equal(ambulo__digest_file(*state, list, got), AMBULO_E_IO);
  assert_message(list, 1, "not a regular file (it is a folder)");
  assert_string_equal(got, want);
  ambulo_diagnostics_free(list);
}

static void an_empty_file_is_an_empty_text(void **state) {
  const char *path = scratch_path(state, "empty");
  scratch_write(path, "");
  char *text = NULL;
  size_t length = 7;
  assert_int_equal(ambulo__read_file(path, 10, NULL, NULL, &text, &length), AMBULO_OK);
  assert_int_equal(length, 0);
  assert_string_equal(text, "");
  free(text);
}

static void refuse(const char *path, size_t limit, ambulo_status want, const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  char *text = NULL;
  size_t length = 99;
  assert_int_equal(ambulo__read_file(path, limit, NULL, list, &text, &length), want);
  assert_null(text);
  assert_int_equal(length, 99);
  assert_message(list, 0, message);
  assert_message(list, 0, path);
  ambulo_diagnostics_free(list);
}

static void what_is_not_a_readable_file_is_refused(void **state) {
  refuse(scratch_path(state, "missing"), 10, AMBULO_E_IO, "No such file");
  refuse(*state, 10, AMBULO_E_IO, "not a regular file (it is a folder)");
  const char *fifo = scratch_path(state, "fifo");
  assert_int_equal(mkfifo(fifo, 0600), 0);
  refuse(fifo, 10, AMBULO_E_IO, "not a regular file");
  refuse("/dev/zero", 10, AMBULO_E_IO, "not a regular file");
  const char *locked = scratch_path(state, "locked");
  scratch_write(locked, "x");
  assert_int_equal(chmod(locked, 0), 0);
  if (geteuid() != 0) refuse(locked, 10, AMBULO_E_IO, "Permission denied");
}

static void files_beyond_the_limit_are_refused(void **state) {
  const char *path = scratch_path(state, "large");
  scratch_write(path, "12345678901");
  refuse(path, 10, AMBULO_E_LIMIT, "got 11 bytes); expected at most 10");
}

/* no part of a file is taken for the whole */
static void what_cannot_be_read_to_its_end_is_refused(void **state) {
  const char *path = scratch_path(state, "file");
  static const struct {
    int step;
    const char *message;
  } faults[] = {{FAIL_IO_OPEN, "cannot open"},
                {FAIL_IO_FSTAT, "cannot inspect"},
                {FAIL_IO_READ, "cannot read"},
                {FAIL_IO_SHORT_READ, "ended after 0 of 5 bytes"}};
  scratch_write(path, "12345");
  for (int i = 0; i < 4; i++) {
    fail_io_arm(faults[i].step, 0);
    refuse(path, 10, AMBULO_E_IO, faults[i].message);
    assert_true(fail_io_disarm());
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(what_cannot_be_read_to_its_end_is_refused, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(bytes_come_back_with_a_terminator, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(checksums_are_of_the_whole_file, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(an_empty_file_is_an_empty_text, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(what_is_not_a_readable_file_is_refused, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(files_beyond_the_limit_are_refused, scratch_open,
                                      scratch_close),
  };
  return cmocka_run_group_tests_name("base/read_file", tests, NULL, NULL);
}
