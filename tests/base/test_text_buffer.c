/* Text that grows: contents, numbers, sticky failure. */
#include "base/text_buffer.h"
#include "support/fail_alloc.h"
#include "support/test.h"

static void appends_follow_one_another(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_string_equal(ambulo__text_data(&text), "");
  ambulo__text_append(&text, "a=");
  ambulo__text_append_number(&text, 0.1);
  ambulo__text_append_char(&text, ';');
  ambulo__text_append_format(&text, "%s[%d]", "x", 42);
  ambulo__text_append_bytes(&text, "\0end", 4);
  assert_int_equal(text.length, 5 + 1 + 5 + 4);
  assert_memory_equal(ambulo__text_data(&text), "a=0.1;x[42]\0end", 16);
  assert_int_equal(ambulo__text_status(&text), AMBULO_OK);
  ambulo__text_clear(&text);
  assert_int_equal(text.length, 0);
  assert_string_equal(ambulo__text_data(&text), "");
  ambulo__text_append(&text, "anew");
  assert_string_equal(ambulo__text_data(&text), "anew");
  ambulo__text_free(&text);
  ambulo__text_free(&text);
}

static void long_texts_keep_every_byte(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  for (int i = 0; i < 20000; i++) ambulo__text_append_format(&text, "%05d,", i);
  assert_int_equal(text.length, 120000);
  const char *data = ambulo__text_data(&text);
  for (int i = 0; i < 20000; i++) assert_int_equal(atoi(data + 6 * i), i);
  assert_int_equal(strlen(data), 120000);
  ambulo__text_free(&text);
}

/* gives memory `left` times */
static void *stingy_resize(void *user, void *pointer, size_t size) {
  int *left = user;
  if (size == 0) {
    free(pointer);
    return NULL;
  }
  if (*left == 0) return NULL;
  --*left;
  return realloc(pointer, size);
}

static void the_first_failure_sticks(void **state) {
  (void)state;
  int left = 1;
  ambulo_allocator stingy = {stingy_resize, &left};
  ambulo__text_buffer text;
  ambulo__text_init(&text, &stingy);
  ambulo__text_append(&text, "kept");
  for (int i = 0; i < 300; i++) ambulo__text_append(&text, "0123456789");
  size_t length = text.length;
  assert_int_equal(ambulo__text_status(&text), AMBULO_E_MEMORY);
  left = 100;
  ambulo__text_append(&text, "lost");
  assert_int_equal(text.length, length);
  assert_int_equal(ambulo__text_status(&text), AMBULO_E_MEMORY);
  assert_memory_equal(ambulo__text_data(&text), "kept0123", 8);
  ambulo__text_clear(&text);
  ambulo__text_append(&text, "again");
  assert_int_equal(ambulo__text_status(&text), AMBULO_OK);
  ambulo__text_free(&text);
}

/* a label that found no memory makes the picture that lacks it a failure */
static void parts_pass_on_their_failure(void **state) {
  (void)state;
  for (int clear = 0; clear < 2; clear++) {
    fail_alloc memory = fail_alloc_at(-1);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__text_buffer whole, part;
    ambulo__text_init(&whole, &hook);
    ambulo__text_append(&whole, "picture");
    ambulo__text_init_part(&part, &whole);
    ambulo__text_append(&part, "label");
    ambulo__text_clear(&part);
    assert_int_equal(ambulo__text_status(&whole), AMBULO_OK);
    ambulo__text_free(&part);
    assert_int_equal(ambulo__text_status(&whole), AMBULO_OK);
    ambulo__text_init_part(&part, &whole);
    memory.fail_at = 0;
    ambulo__text_append(&part, "label");
    if (clear) ambulo__text_clear(&part);
    ambulo__text_free(&part);
    assert_int_equal(ambulo__text_status(&whole), AMBULO_E_MEMORY);
    ambulo__text_free(&whole);
    assert_int_equal(memory.live, 0);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(appends_follow_one_another),
      cmocka_unit_test(long_texts_keep_every_byte),
      cmocka_unit_test(the_first_failure_sticks),
      cmocka_unit_test(parts_pass_on_their_failure),
  };
  return cmocka_run_group_tests_name("base/text_buffer", tests, NULL, NULL);
}
