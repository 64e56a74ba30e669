/* What is packed comes out again, whatever it is, and is small where it repeats itself. */
#include "formats/deflate.h"

#include "support/fail_alloc.h"
#include "support/inflate.h"

#ifdef AMBULO_HAS_ZLIB
enum { compresses = 1 };
#else
enum { compresses = 0 };
#endif

static unsigned long long seed = 88172645463325252ull;
static unsigned any(unsigned below) {
  seed ^= seed << 13;
  seed ^= seed >> 7;
  seed ^= seed << 17;
  return (unsigned)(seed >> 33) % below;
}

/* the length when packed */
static size_t goes_round(const char *bytes, size_t length) {
  ambulo__text_buffer packed;
  size_t size;
  ambulo__text_init(&packed, NULL);
  ambulo__deflate(&packed, bytes, length);
  assert_int_equal(ambulo__text_status(&packed), AMBULO_OK);
  unsigned char *out = unpacked(ambulo__text_data(&packed), packed.length, &size);
  assert_int_equal(size, length);
  assert_memory_equal(out, bytes, length);
  size_t bytes_packed = packed.length;
  free(out);
  ambulo__text_free(&packed);
  return bytes_packed;
}

static void short_ones(void **state) {
  (void)state;
  static const char text[] = "abcabcabcabcab\0\0\0\0\xff\xff";
  for (size_t length = 0; length < sizeof text; length++) (void)goes_round(text, length);
}

/* every length of a match and every distance of the window, with what stands between them */
static void all_lengths_and_distances(void **state) {
  (void)state;
  enum { SIZE = 200000 };
  char *bytes = malloc(SIZE);
  size_t at = 0;
  while (at < 40000) bytes[at++] = (char)any(256);
  while (at < SIZE) {
    size_t distance = 1 + any(at < 34000 ? (unsigned)at : 34000), length = 1 + any(300);
    for (size_t i = 0; i < length && at < SIZE; i++, at++) bytes[at] = bytes[at - distance];
    if (at < SIZE) bytes[at++] = (char)any(256);
  }
  size_t packed = goes_round(bytes, SIZE);
  assert_true(packed < (compresses ? 50000 : SIZE + 100));
  free(bytes);
}

static void repeats_are_small(void **state) {
  (void)state;
  if (!compresses) skip();
  enum { SIZE = 100000 };
  char *bytes = calloc(SIZE, 1);
  assert_true(goes_round(bytes, SIZE) < 300);
  for (size_t i = 0; i < SIZE; i++) bytes[i] = (char)any(256);
  assert_true((double)goes_round(bytes, SIZE) <
              1.02 * (double)SIZE); /* what has no pattern grows little */
  for (size_t i = 0; i < SIZE; i++) bytes[i] = (char)('0' + any(10));
  assert_true((double)goes_round(bytes, SIZE) <
              0.49 * (double)SIZE); /* as zlib; log2(10) / 8 is .415 */
  memcpy(bytes + SIZE / 2, bytes + SIZE / 2 - 30000, 30000);
  size_t again = goes_round(bytes, SIZE);
  assert_true((double)again < 0.49 * (double)(SIZE - 30000) + 600);
  free(bytes);
}

static void memory_may_run_out(void **state) {
  (void)state;
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer packed;
    ambulo__text_init(&packed, &allocator);
    ambulo__deflate(&packed, "abc", 3);
    assert_int_equal(ambulo__text_status(&packed), memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&packed);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(short_ones),
      cmocka_unit_test(all_lengths_and_distances),
      cmocka_unit_test(repeats_are_small),
      cmocka_unit_test(memory_may_run_out),
  };
  return cmocka_run_group_tests_name("format/deflate", tests, NULL, NULL);
}
