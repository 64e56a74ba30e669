/* The archive byte by byte, read back by the formats' own words. */
#include "exchange/export.h"

#include "support/fail_alloc.h"
#include "support/test.h"

static void crc(void **state) {
  (void)state;
  assert_int_equal(ambulo__crc32(0, "123456789", 9), 0xcbf43926); /* the check value of the CRC */
  uint32_t parts = ambulo__crc32(ambulo__crc32(0, "1234", 4), "56789", 5);
  assert_int_equal(parts, 0xcbf43926);
}

static uint32_t number(const char *at, int bytes) {
  uint32_t value = 0;
  for (int i = bytes - 1; i >= 0; i--) value = value << 8 | (unsigned char)at[i];
  return value;
}

/* a member by way of the directory: its .npy */
static const char *member(const ambulo__text_buffer *text, int index, const char *name,
                          uint32_t *size) {
  const char *all = ambulo__text_data(text), *end = all + text->length - 22;
  assert_int_equal(number(end, 4), 0x06054b50);
  assert_int_equal(number(end + 8, 2), number(end + 10, 2));
  const char *at = all + number(end + 16, 4);
  assert_int_equal(number(end + 16, 4) + number(end + 12, 4), text->length - 22);
  for (int i = 0; i < index; i++) at += 46 + number(at + 28, 2);
  assert_int_equal(number(at, 4), 0x02014b50);
  assert_int_equal(number(at + 28, 2), strlen(name));
  assert_memory_equal(at + 46, name, strlen(name));
  const char *local = all + number(at + 42, 4);
  assert_int_equal(number(local, 4), 0x04034b50);
  assert_memory_equal(local + 4, at + 6, 24); /* both say the same */
  assert_memory_equal(local + 30, name, strlen(name));
  *size = number(local + 18, 4);
  assert_int_equal(*size, number(local + 22, 4));
  const char *data = local + 30 + strlen(name);
  assert_int_equal(ambulo__crc32(0, data, *size), number(local + 14, 4));
  return data;
}

static void arrays(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__npz npz;
  static const double values[6] = {1.5, -0.0, 3e300, 4, 5, 1e-320};
  static const char *const words[2] = {"knee", "hip_\xc3\xa9"};
  ambulo__text_init(&text, NULL);
  ambulo__npz_begin(&npz, &text);
  ambulo__npz_numbers(&npz, "q", values, 2, (size_t[]){2, 3});
  ambulo__npz_texts(&npz, "names", words, 2);
  ambulo__npz_numbers(&npz, "none", values, 3, (size_t[]){2, 0, 6});
  assert_int_equal(ambulo__npz_end(&npz), AMBULO_OK);
  uint32_t size = 0;
  const char *npy = member(&text, 0, "q.npy", &size);
  assert_memory_equal(npy, "\x93NUMPY\x01\x00", 8);
  uint32_t header = 10 + number(npy + 8, 2);
  assert_int_equal(header % 64, 0);
  assert_memory_equal(npy + 10, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3, ), }",
                      61);
  assert_int_equal(npy[header - 1], '\n');
  assert_int_equal(size, header + sizeof values);
  uint64_t bits;
  memcpy(&bits, &values[2], 8);
  assert_int_equal(number(npy + header + 16, 4), bits & 0xffffffff);
  assert_int_equal(number(npy + header + 20, 4), bits >> 32);
  npy = member(&text, 1, "names.npy", &size);
  assert_non_null(strstr(npy + 10, "'<U6'"));
  header = 10 + number(npy + 8, 2);
  assert_int_equal(size, header + 2 * 6 * 4);
  assert_int_equal(number(npy + header + 4, 4), 'n');
  assert_int_equal(number(npy + header + 16, 4), 0);
  assert_int_equal(number(npy + header + 24 + 16, 4), '?');
  npy = member(&text, 2, "none.npy", &size);
  assert_int_equal(size, 10 + number(npy + 8, 2));
  ambulo__text_free(&text);
}

static void too_many(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__npz npz;
  ambulo__text_init(&text, NULL);
  ambulo__npz_begin(&npz, &text);
  for (int i = 0; i <= AMBULO__NPZ_ARRAYS; i++)
    ambulo__npz_numbers(&npz, "a", (double[]){1}, 1, (size_t[]){1});
  assert_int_equal(ambulo__npz_end(&npz), AMBULO_E_LIMIT);
  ambulo__text_free(&text);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer text;
    ambulo__npz npz;
    ambulo__text_init(&text, &allocator);
    ambulo__npz_begin(&npz, &text);
    ambulo__npz_numbers(&npz, "a", (double[]){1, 2}, 1, (size_t[]){2});
    assert_int_equal(ambulo__npz_end(&npz), memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&text);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(crc), cmocka_unit_test(arrays),
                                     cmocka_unit_test(too_many),
                                     cmocka_unit_test(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
