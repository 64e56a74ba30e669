/* Arrays come back from what the writer made, and from a deflated archive put together here; bytes
 * that are damaged are refused. */
#include "exchange/npz_read.h"

#include "exchange/export.h"
#include "formats/deflate.h"
#include "support/messages.h"
#include "support/test.h"

static const double numbers[6] = {1.5, -2.0, 3e300, 4, 5, 1e-300};

static void make(ambulo__text_buffer *text, const ambulo_allocator *allocator) {
  ambulo__npz npz;
  ambulo__text_init(text, allocator);
  ambulo__npz_begin(&npz, text);
  ambulo__npz_numbers(&npz, "other", numbers, 1, (size_t[]){2});
  ambulo__npz_numbers(&npz, "a", numbers, 2, (size_t[]){2, 3});
  assert_int_equal(ambulo__npz_end(&npz), AMBULO_OK);
}

static void check(const ambulo__text_buffer *text, const char *name, size_t rows, size_t columns) {
  ambulo__npz_array array;
  int found = 0;
  assert_int_equal(ambulo__npz_read(ambulo__text_data(text), text->length, name, "f.npz", NULL,
                                    NULL, &array, &found),
                   AMBULO_OK);
  assert_int_equal(found, 1);
  assert_int_equal(array.rows, rows);
  assert_int_equal(array.columns, columns);
  assert_memory_equal(array.values, numbers, rows * columns * sizeof *numbers);
  free(array.values);
}

static void comes_back(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__npz_array array;
  int found = 1;
  make(&text, NULL);
  check(&text, "other", 2, 1);
  check(&text, "a", 2, 3);
  assert_int_equal(ambulo__npz_read(ambulo__text_data(&text), text.length, "b", "f.npz", NULL, NULL,
                                    &array, &found),
                   AMBULO_OK);
  assert_int_equal(found, 0);
  assert_null(array.values);
  ambulo__text_free(&text);
}

static void put(ambulo__text_buffer *text, unsigned long value, int bytes) {
  for (int i = 0; i < bytes; i++)
    ambulo__text_append_char(text, (char)(unsigned char)(value >> (8 * i) & 0xff));
}

/* one entry a.npy, deflated, as numpy.savez_compressed has it */
static void make_deflated(ambulo__text_buffer *text, const char *head, const void *data,
                          size_t size) {
  ambulo__text_buffer npy, packed;
  ambulo__text_init(text, NULL);
  ambulo__text_init(&npy, NULL);
  ambulo__text_init(&packed, NULL);
  ambulo__text_append_bytes(&npy, "\x93NUMPY\x01\x00", 8);
  put(&npy, strlen(head), 2);
  ambulo__text_append(&npy, head);
  ambulo__text_append_bytes(&npy, data, size);
  ambulo__deflate(&packed, ambulo__text_data(&npy), npy.length);
  for (int part = 0; part < 2; part++) {
    size_t here = text->length;
    put(text, part ? 0x02014b50 : 0x04034b50, 4);
    if (part) put(text, 20, 2);
    put(text, 20, 2);
    put(text, 0, 2);
    put(text, 8, 2);
    put(text, 0, 4);
    put(text, 0, 4);
    put(text, packed.length, 4);
    put(text, npy.length, 4);
    put(text, 5, 2);
    put(text, 0, 2);
    if (part) put(text, 0, 6); /* remark, disk, attributes */
    if (part) put(text, 0, 8);
    ambulo__text_append(text, "a.npy");
    if (!part) ambulo__text_append_bytes(text, ambulo__text_data(&packed), packed.length);
    if (part) {
      size_t end = text->length;
      put(text, 0x06054b50, 4);
      put(text, 0, 4);
      put(text, 1, 2);
      put(text, 1, 2);
      put(text, end - here, 4);
      put(text, here, 4);
      put(text, 0, 2);
    }
  }
  ambulo__text_free(&npy);
  ambulo__text_free(&packed);
}

static void deflated(void **state) {
  (void)state;
#ifndef AMBULO_HAS_ZLIB
  skip();
#endif
  ambulo__text_buffer text;
  make_deflated(&text, "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }\n", numbers,
                sizeof numbers);
  check(&text, "a", 2, 3);
  ambulo__text_free(&text);
  /* by columns */
  static const double turned[6] = {1.5, 4, -2.0, 5, 3e300, 1e-300};
  make_deflated(&text, "{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }\n", turned,
                sizeof turned);
  check(&text, "a", 2, 3);
  ambulo__text_free(&text);
}

static void other_types(void **state) {
  (void)state;
#ifndef AMBULO_HAS_ZLIB
  skip();
#endif
  static const int32_t narrow[2] = {-3, 60};
  static const float single[2] = {0.5F, 120.0F};
  struct {
    const char *head;
    const void *data;
    double first, second;
  } cases[] = {{"{'descr': '<i4', 'fortran_order': False, 'shape': (2,), }\n", narrow, -3, 60},
               {"{'descr': '<f4', 'fortran_order': False, 'shape': (2,), }\n", single, 0.5, 120}};
  for (size_t i = 0; i < 2; i++) {
    ambulo__text_buffer text;
    ambulo__npz_array array;
    int found;
    make_deflated(&text, cases[i].head, cases[i].data, 8);
    assert_int_equal(ambulo__npz_read(ambulo__text_data(&text), text.length, "a", "f.npz", NULL,
                                      NULL, &array, &found),
                     AMBULO_OK);
    assert_close(array.values[0], cases[i].first, 0);
    assert_close(array.values[1], cases[i].second, 0);
    free(array.values);
    ambulo__text_free(&text);
  }
  ambulo__text_buffer text;
  ambulo__npz_array array;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  int found;
  make_deflated(&text, "{'descr': '<U4', 'fortran_order': False, 'shape': (), }\n", "maleabcd", 8);
  assert_int_equal(ambulo__npz_read(ambulo__text_data(&text), text.length, "a", "f.npz", NULL,
                                    messages, &array, &found),
                   AMBULO_E_SCHEMA);
  assert_message(messages, 0, "f.npz: error[E_SCHEMA]: array 'a' is of another kind");
  ambulo__text_free(&text);
  ambulo_diagnostics_free(messages);
}

/* whatever is cut off or changed, there is an answer */
static void damage(void **state) {
  (void)state;
  ambulo__text_buffer text;
  make(&text, NULL);
  char *copy = malloc(text.length);
  assert_non_null(copy);
  for (size_t length = 0; length < text.length; length++) {
    ambulo__npz_array array = {.values = NULL};
    int found = 0;
    memcpy(copy, ambulo__text_data(&text), length);
    assert_int_not_equal(ambulo__npz_read(copy, length, "a", "f.npz", NULL, NULL, &array, &found),
                         AMBULO_OK);
  }
  for (size_t at = 0; at < text.length; at++) {
    ambulo__npz_array array = {.values = NULL};
    int found = 0;
    memcpy(copy, ambulo__text_data(&text), text.length);
    copy[at] = (char)(copy[at] ^ 0x55);
    (void)ambulo__npz_read(copy, text.length, "a", "f.npz", NULL, NULL, &array, &found);
    free(array.values);
  }
  free(copy);
  ambulo__text_free(&text);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(comes_back), cmocka_unit_test(deflated),
                                     cmocka_unit_test(other_types), cmocka_unit_test(damage)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
