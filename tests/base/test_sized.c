/* Structures of older headers are read as far as they go, and never beyond. */
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

static void usual(void *item, const void *given) {
  int *pair = item;
  pair[0] = -1;
  pair[1] = 10 * *(const int *)given;
}

static void shorter_items_become_longer(void **state) {
  (void)state;
  const int given[3] = {1, 2, 3};
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator hook = fail_alloc_hook(&memory);
  int *own = ambulo__sized_items(&hook, given, 3, sizeof(int), 2 * sizeof(int), usual);
  assert_non_null(own);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(own[2 * i], i + 1);
    assert_int_equal(own[2 * i + 1], 10 * (i + 1));
  }
  ambulo__free(&hook, own);
  assert_int_equal(memory.live, 0);
  assert_null(ambulo__sized_items(&hook, NULL, 3, sizeof(int), 2 * sizeof(int), usual));
  assert_null(ambulo__sized_items(&hook, given, 0, sizeof(int), 2 * sizeof(int), usual));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(what_is_older_keeps_what_it_lacks),
      cmocka_unit_test(sizes_that_no_header_had_are_refused),
      cmocka_unit_test(a_default_is_written_as_far_as_the_caller_has_room),
      cmocka_unit_test(shorter_items_become_longer)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
