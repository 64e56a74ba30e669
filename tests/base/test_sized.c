/* Structures of older headers are read as far as they go, and never beyond. */
#include <math.h>
#include <string.h>

#include "ambulo/ambulo.h"
#include "base/alloc.h"
#include "base/sized.h"
#include "support/fail_alloc.h"
#include "support/test.h"

typedef struct whole {
  size_t size;
  int old;
  double grown;
} whole;

static void what_is_older_keeps_what_it_lacks(void **state) {
  (void)state;
  whole own = {sizeof own, 1, 2.5}, older = {offsetof(whole, grown), 7, -3.0};
  assert_true(ambulo__sized_take(&own, sizeof own, &older));
  assert_int_equal(own.size, sizeof own);
  assert_int_equal(own.old, 7);
  assert_true(own.grown == 2.5);
  assert_true(ambulo__sized_take(&own, sizeof own, NULL));
  assert_int_equal(own.old, 7);
}

static void sizes_that_no_header_had_are_refused(void **state) {
  (void)state;
  whole own = {sizeof own, 1, 2.5};
  const size_t wrong[] = {0, sizeof(size_t), sizeof own + 1, (size_t)-1};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    whole given = {wrong[i], 7, 3.0};
    assert_false(ambulo__sized_take(&own, sizeof own, &given));
    assert_int_equal(own.old, 1);
  }
  assert_false(ambulo__sized_item(0, 8));
  assert_false(ambulo__sized_item(9, 8));
  assert_true(ambulo__sized_item(8, 8) && ambulo__sized_item(4, 8));
}

static void a_default_is_written_as_far_as_the_caller_has_room(void **state) {
  (void)state;
  const int usual[2] = {1, 2};
  int room[3] = {9, 9, 9};
  ambulo__sized_fill(room, sizeof room[0], usual, sizeof usual);
  assert_int_equal(room[0], 1);
  assert_int_equal(room[1], 9);
  ambulo__sized_fill(room, sizeof room, usual, sizeof usual); /* a newer header: zeros behind */
  assert_int_equal(room[1], 2);
  assert_int_equal(room[2], 0);
}

static void shorter_items_become_longer(void **state) {
  (void)state;
  enum { OLDER = offsetof(ambulo_parameter, upper) };
  char given[3 * OLDER];
  ambulo_parameter full = {"name", 0.0, 9.0};
  for (int i = 0; i < 3; i++) {
    full.lower = i;
    memcpy(given + i * OLDER, &full, OLDER);
  }
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  ambulo_parameter *own =
      ambulo__sized_items(&hook, given, 3, OLDER, sizeof *own, "ambulo_parameter");
  assert_non_null(own);
  for (int i = 0; i < 3; i++) {
    assert_string_equal(own[i].name, "name");
    assert_true(own[i].lower == i);
    assert_true(isnan(own[i].upper));
  }
  ambulo__free(&hook, own);
  assert_int_equal(memory.live, 0);
  assert_null(ambulo__sized_items(&hook, NULL, 3, OLDER, sizeof *own, "ambulo_parameter"));
  assert_null(ambulo__sized_items(&hook, given, 0, OLDER, sizeof *own, "ambulo_parameter"));
}

/* sizes of parts stay as the caller's headers have them, and nothing is written behind his end */
static void defaults_keep_the_callers_sizes(void **state) {
  (void)state;
  struct {
    ambulo_model_definition older;
    char behind;
  } one;
  memset(&one, 0x5a, sizeof one);
  one.older.link_size = 8;
  size_t bytes = offsetof(ambulo_model_definition, stature);
  assert_int_equal(ambulo_defaults("ambulo_model_definition", &one, bytes), AMBULO_OK);
  assert_int_equal(one.older.size, bytes);
  assert_int_equal(one.older.link_size, 8);
  assert_string_equal(one.older.name, "model");
  assert_true(one.older.gravity[1] == -9.81);
  unsigned char first;
  memcpy(&first, &one.older.stature, 1);
  assert_int_equal(first, 0x5a);
}

static void defaults_of_what_is_no_structure_are_refused(void **state) {
  (void)state;
  ambulo_options options;
  memset(&options, 0x5a, sizeof options);
  const ambulo_options before = options;
  assert_int_equal(ambulo_defaults("ambulo_option", &options, sizeof options), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_defaults(NULL, &options, sizeof options), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_defaults("ambulo_options", NULL, sizeof options), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_defaults("ambulo_options", &options, 4), AMBULO_E_ARGUMENT);
  assert_memory_equal(&options, &before, sizeof options);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_older_keeps_what_it_lacks),
      cmocka_unit_test(sizes_that_no_header_had_are_refused),
      cmocka_unit_test(a_default_is_written_as_far_as_the_caller_has_room),
      cmocka_unit_test(shorter_items_become_longer),
      cmocka_unit_test(defaults_keep_the_callers_sizes),
      cmocka_unit_test(defaults_of_what_is_no_structure_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
