/* SHA-256: the examples of FIPS 180-4 (NIST, "Examples with Intermediate Values", SHA256.pdf) and
 * of the NIST byte-oriented test vectors; any cut of a message gives the same. */
#include "formats/sha256.h"
#include "support/test.h"

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

/* lengths around a block's end, where the padding changes its form; cut at every place */
static void pieces_make_the_same_whole(void **state) {
  (void)state;
  char message[200], whole[AMBULO__SHA256_TEXT], parts[AMBULO__SHA256_TEXT];
  for (size_t i = 0; i < sizeof message; i++) message[i] = (char)(7 * i + 3);
  for (size_t length = 50; length <= 140; length++) {
    ambulo__sha256_of(message, length, whole);
    for (size_t cut = 0; cut <= length; cut += 1 + cut % 3) {
      ambulo__sha256 hash;
      ambulo__sha256_begin(&hash);
      ambulo__sha256_add(&hash, message, cut);
      ambulo__sha256_add(&hash, message + cut, length - cut);
      ambulo__sha256_end(&hash, parts);
      assert_string_equal(parts, whole);
    }
  }
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

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_published_examples), cmocka_unit_test(a_million_letters),
      cmocka_unit_test(pieces_make_the_same_whole), cmocka_unit_test(every_bit_counts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
