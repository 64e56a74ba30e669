/* What a worker says is taken in whole, up to a limit, whatever the disk has room for; and a worker
 * that says much is never stopped by a full pipe. */
#include "study/batch.h"
#include "support/fake_batch.h"
#include "support/messages.h"

static void say(int end, const char *text) {
  assert_int_equal(write(end, text, strlen(text)), strlen(text));
}

static void words_are_kept(void **state) {
  ambulo__worker_log log;
  const char *path = scratch_path(state, "a.log");
  int end = ambulo__worker_log_open(&log, NULL);
  assert_true(end > 2 && log.file > 2);
  assert_true((fcntl(end, F_GETFD) & FD_CLOEXEC) && (fcntl(log.file, F_GETFD) & FD_CLOEXEC));
  assert_int_equal(ambulo__worker_log_read(&log), 0); /* nothing yet: does not wait */
  assert_int_equal(ambulo__worker_log_write(&log, path, NULL), AMBULO_OK);
  assert_int_equal(access(path, F_OK), -1);
  say(end, "one\n");
  assert_int_equal(ambulo__worker_log_read(&log), 0);
  say(end, "two\n");
  close(end);
  assert_int_equal(ambulo__worker_log_read(&log), 0);
  assert_string_equal(ambulo__text_data(&log.text), "one\ntwo\n");
  assert_int_equal(ambulo__worker_log_write(&log, path, NULL), AMBULO_OK);
  char *text = read_whole(path);
  assert_string_equal(text, "one\ntwo\n");
  free(text);
  ambulo__worker_log_close(&log);
  assert_int_equal(ambulo__worker_log_read(&log), 0); /* closed: nothing more */
}

static void many_words_end_at_a_megabyte(void **state) {
  (void)state;
  ambulo__worker_log log;
  char line[1024];
  memset(line, 'x', sizeof line);
  int end = ambulo__worker_log_open(&log, NULL);
  for (int i = 0; i < 1100; i++) {
    assert_int_equal(write(end, line, sizeof line), sizeof line);
    assert_int_equal(ambulo__worker_log_read(&log), 0);
  }
  assert_int_equal(log.text.length, 1 << 20);
  close(end);
  ambulo__worker_log_close(&log);
}

/* a batch of one worker, a script */
static ambulo_status run_script(void **state, const char *script, ambulo_diagnostics *list) {
  fake_batch b = {.state = state};
  (void)snprintf(b.folder, sizeof b.folder, "%s/b", (const char *)*state);
  scratch_write(scratch_path(state, "worker"), script);
  assert_int_equal(chmod(scratch_path(state, "worker"), 0700), 0);
  assert_int_equal(
      sweep_load(state, "axes:\n  - {key: time.duration, name: T, values: [1]}\n", NULL, &b.sweep),
      AMBULO_OK);
  ambulo_status status = fake_batch_run(&b, NULL, list);
  fake_batch_close(&b);
  return status;
}

/* no byte fits into a file: the worker's words are in the message all the same */
static void words_survive_a_full_disk(void **state) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      run_script(state,
                 "#!/bin/sh\nulimit -f 0; trap '' XFSZ\n"
                 "echo 'x/b: error[E_IO]: cannot write: the disk is full' >&2\nexit 4\n",
                 list),
      AMBULO_E_IO);
  assert_int_equal(ambulo_diagnostics_error_count(list), 1);
  assert_non_null(
      strstr(ambulo_diagnostics_get(list, 0)->message, "x/b: cannot write: the disk is full"));
  ambulo_diagnostics_free(list);
}

static void much_is_said_and_the_case_ends(void **state) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      run_script(state, "#!/bin/sh\nhead -c 300000 /dev/zero | tr '\\0' x >&2\nexit 3\n", list),
      AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_error_count(list), 0);
  ambulo_diagnostics_free(list);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(words_are_kept), TEST(many_words_end_at_a_megabyte),
                                     TEST(words_survive_a_full_disk),
                                     TEST(much_is_said_and_the_case_ends)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
