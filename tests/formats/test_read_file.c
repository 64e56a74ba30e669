/* Reading whole files: what is given, and what is refused without blocking. */
#define _GNU_SOURCE
#include "formats/read_file.h"
#include "support/fail_io.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/test.h"

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

/* SHA-256: the examples of FIPS 180-4 (NIST, "Examples with Intermediate Values", SHA256.pdf) and
 * of the NIST byte-oriented test vectors. */

typedef struct example {
  const char *message, *digest;
} example;

static const example examples[] = {
    {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
    {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
    {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
     "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
    {"abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopqklmnopqr"
     "lmnopqrsmnopqrstnopqrstu",
     "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1"}};

static void the_published_examples(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
    char text[AMBULO__SHA256_TEXT];
    ambulo__sha256_of(examples[i].message, strlen(examples[i].message), text);
    assert_string_equal(text, examples[i].digest);
  }
}

/* the long one: a million times "a" */
static void a_million_letters(void **state) {
  (void)state;
  char *letters = malloc(1000000), text[AMBULO__SHA256_TEXT];
  assert_non_null(letters);
  memset(letters, 'a', 1000000);
  ambulo__sha256_of(letters, 1000000, text);
  free(letters);
  assert_string_equal(text, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/* lengths around the ends of blocks, where the padding changes its form, and of the pieces that are
 * read */
static void files_and_bytes_have_one_digest(void **state) {
  enum { MOST = 2 * 65536 + 1 };
  static const size_t lengths[] = {0, 1, 55, 56, 63, 64, 65, 119, 120, 65535, 65536, 65537, MOST};
  const char *path = scratch_path(state, "file");
  char *text = malloc(MOST + 1), whole[AMBULO__SHA256_TEXT], read[AMBULO__SHA256_TEXT];
  assert_non_null(text);
  for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++) {
    for (size_t i = 0; i < lengths[k]; i++) text[i] = (char)('a' + i % 23);
    text[lengths[k]] = '\0';
    scratch_write(path, text);
    ambulo__sha256_of(text, lengths[k], whole);
    assert_int_equal(ambulo__digest_file(path, NULL, read), AMBULO_OK);
    assert_string_equal(read, whole);
  }
  free(text);
}

/* one bit anywhere makes another digest */
static void every_bit_counts(void **state) {
  (void)state;
  char message[130] = "", first[AMBULO__SHA256_TEXT], other[AMBULO__SHA256_TEXT];
  ambulo__sha256_of(message, sizeof message, first);
  for (size_t i = 0; i < 8 * sizeof message; i++) {
    message[i / 8] = (char)(1 << (i % 8));
    ambulo__sha256_of(message, sizeof message, other);
    assert_string_not_equal(other, first);
    message[i / 8] = 0;
  }
}

/* Sealed objects: what was written holds, and nothing else does. */

static ambulo__text_buffer sealed(const char *text) {
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, NULL);
  ambulo__text_append(&buffer, text);
  ambulo__seal(&buffer);
  assert_int_equal(ambulo__text_status(&buffer), AMBULO_OK);
  return buffer;
}

/* the digest is that of the bytes before it: printf '{\n  "a": 1,\n' | sha256sum */
static void the_last_key_is_the_checksum(void **state) {
  (void)state;
  ambulo__text_buffer text = sealed("{\n  \"a\": 1");
  assert_string_equal(ambulo__text_data(&text),
                      "{\n  \"a\": 1,\n  \"sha256\": "
                      "\"258d97188c1e1b71d2c4210444fd72c3cf58a6d7d799180006273b33f2d1d054\"\n}\n");
  assert_true(ambulo__seal_holds(ambulo__text_data(&text), text.length));
  ambulo__text_free(&text);
}

static void no_change_of_a_byte_holds(void **state) {
  (void)state;
  ambulo__text_buffer text = sealed("{\n  \"state\": \"optimal\",\n  \"valid\": true");
  for (size_t i = 0; i < text.length; i++) {
    for (int bit = 0; bit < 8; bit++) {
      text.data[i] = (char)(text.data[i] ^ (1 << bit));
      assert_false(ambulo__seal_holds(text.data, text.length));
      text.data[i] = (char)(text.data[i] ^ (1 << bit));
    }
  }
  assert_true(ambulo__seal_holds(text.data, text.length));
  ambulo__text_free(&text);
}

static void no_part_of_it_holds(void **state) {
  (void)state;
  ambulo__text_buffer text = sealed("{\n  \"state\": \"optimal\"");
  for (size_t length = 0; length < text.length; length++)
    assert_false(ambulo__seal_holds(text.data, length));
  for (size_t start = 1; start < text.length; start++)
    assert_false(ambulo__seal_holds(text.data + start, text.length - start));
  ambulo__text_append(&text, "\n");
  assert_false(ambulo__seal_holds(text.data, text.length));
  ambulo__text_free(&text);
}

/* The hash of texts. */

/* FNV-1a, the end of each text included, so that "ab", "c" is not "a", "bc" */
static void hashes(void **state) {
  (void)state;
  unsigned long long h = AMBULO__HASH_START;
  assert_true(ambulo__hash_text(h, "") == (AMBULO__HASH_START ^ 0) * 1099511628211ULL);
  assert_true(ambulo__hash_text(ambulo__hash_text(h, "ab"), "c") !=
              ambulo__hash_text(ambulo__hash_text(h, "a"), "bc"));
  assert_true(ambulo__hash_word(h, 1) != ambulo__hash_word(h, 256));
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
      cmocka_unit_test(the_published_examples),
      cmocka_unit_test(a_million_letters),
      cmocka_unit_test_setup_teardown(files_and_bytes_have_one_digest, scratch_open, scratch_close),
      cmocka_unit_test(every_bit_counts),
      cmocka_unit_test(the_last_key_is_the_checksum),
      cmocka_unit_test(no_change_of_a_byte_holds),
      cmocka_unit_test(no_part_of_it_holds),
      cmocka_unit_test(hashes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
