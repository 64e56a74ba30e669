/* Files that something is read from: their lines, what is refused, memory. */
#include "formats/inputs.h"

#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char digest_of_abc[] =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

static ambulo_status take(ambulo__inputs *inputs, const char *path, ambulo_diagnostics *list) {
  char *text = NULL;
  size_t length = 0;
  ambulo_status status = ambulo__inputs_read(inputs, path, 100, NULL, list, &text, &length);
  assert_true(status ? !text : strlen(text) == length);
  free(text);
  return status;
}

static void lines_are_those_of_sha256sum(void **state) {
  char expected[SCRATCH_PATH + 400];
  ambulo__inputs inputs = {.expected = NULL};
  ambulo__text_init(&inputs.read, NULL);
  const char *path = scratch_path(state, "a");
  scratch_write(path, "abc");
  for (int i = 0; i < 2; i++) assert_int_equal(take(&inputs, path, NULL), AMBULO_OK);
  snprintf(expected, sizeof expected, "%s  %s\n", digest_of_abc, path);
  assert_string_equal(ambulo__text_data(&inputs.read), expected);
  ambulo__text_free(&inputs.read);
}

static void other_bytes_are_refused(void **state) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__text_buffer known;
  ambulo__text_init(&known, NULL);
  const char *path = scratch_path(state, "a");
  for (int i = 0; i < 2; i++) {
    ambulo__inputs inputs = {.known = &known};
    ambulo__text_init(&inputs.read, NULL);
    scratch_write(path, i ? "abd" : "abc");
    assert_int_equal(take(&inputs, path, list), i ? AMBULO_E_IO : AMBULO_OK);
    assert_int_equal(inputs.read.length > 0, !i);
    ambulo__text_free(&inputs.read);
  }
  assert_message(list, 0, "a: error[E_IO]: the file changed since the run began");
  assert_message(list, 0, "SHA-256 ba7816bf8f01...");
  ambulo__text_free(&known);
  ambulo_diagnostics_free(list);
}

/* within one reading, too */
static void two_readings_are_one(void **state) {
  ambulo__inputs inputs = {.known = NULL};
  ambulo__text_init(&inputs.read, NULL);
  const char *path = scratch_path(state, "a");
  scratch_write(path, "abc");
  assert_int_equal(take(&inputs, path, NULL), AMBULO_OK);
  scratch_write(path, "ab");
  assert_int_equal(take(&inputs, path, NULL), AMBULO_E_IO);
  ambulo__text_free(&inputs.read);
}

static void only_what_is_expected(void **state) {
  char expected[2 * SCRATCH_PATH];
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  scratch_write(scratch_path(state, "a"), "abc");
  scratch_write(scratch_path(state, "b"), "abc");
  snprintf(expected, sizeof expected, "%s  %s\n", digest_of_abc, scratch_path(state, "a"));
  ambulo__inputs inputs = {.expected = expected};
  ambulo__text_init(&inputs.read, NULL);
  assert_int_equal(take(&inputs, scratch_path(state, "a"), list), AMBULO_OK);
  assert_int_equal(take(&inputs, scratch_path(state, "b"), list), AMBULO_E_IO);
  assert_message(list, 0, "b: error[E_IO]: the file was not there when the run began");
  scratch_write(scratch_path(state, "a"), "abd");
  assert_int_equal(take(&inputs, scratch_path(state, "a"), list), AMBULO_E_IO);
  assert_message(list, 1, "a: error[E_IO]: the file changed");
  ambulo__text_free(&inputs.read);
  ambulo_diagnostics_free(list);
}

/* no path is found as a part of another, or of a checksum */
static void paths_are_whole(void **state) {
  (void)state;
  char lines[400];
  snprintf(lines, sizeof lines, "%s  x/a.yaml\n%s  a.yaml.old\n%s  ad\n", digest_of_abc,
           digest_of_abc, digest_of_abc);
  assert_null(ambulo__inputs_find(lines, "a.yaml"));
  assert_null(ambulo__inputs_find(lines, ""));
  assert_null(ambulo__inputs_find(NULL, "ad"));
  assert_ptr_equal(ambulo__inputs_find(lines, "x/a.yaml"), lines);
  assert_string_equal(ambulo__inputs_find(lines, "ad") + 64, "  ad\n");
}

static void json(void **state) {
  (void)state;
  char lines[200], expected[200];
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__json writer = {&text, 0, 1};
  snprintf(lines, sizeof lines, "%s  a \"b\"\nnonsense\n", digest_of_abc);
  ambulo__json_open(&writer, NULL, '{');
  ambulo__inputs_json("", &writer);
  ambulo__inputs_json(lines, &writer);
  ambulo__json_close(&writer, '}');
  snprintf(expected, sizeof expected, "{\n  \"inputs\": {\n    \"a \\\"b\\\"\": \"%s\"\n  }\n}",
           digest_of_abc);
  assert_non_null(strstr(ambulo__text_data(&text), expected));
  ambulo__text_free(&text);
}

static void memory_may_give_out(void **state) {
  scratch_write(scratch_path(state, "a"), "abc");
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__text_buffer known;
    ambulo__inputs inputs = {.known = &known};
    char *text = NULL;
    size_t length = 0;
    ambulo__text_init(&known, &hook);
    ambulo__text_init(&inputs.read, &hook);
    ambulo_status status =
        ambulo__inputs_read(&inputs, scratch_path(state, "a"), 100, &hook, NULL, &text, &length);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__free(&hook, text);
    ambulo__text_free(&known);
    ambulo__text_free(&inputs.read);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(lines_are_those_of_sha256sum), TEST(other_bytes_are_refused), TEST(two_readings_are_one),
      TEST(only_what_is_expected),        TEST(paths_are_whole),         TEST(json),
      TEST(memory_may_give_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
