/* The way of a solve in bounded memory: what is left of any number of iterations is told by the
 * header, and by nothing else. */
#include "method/history.h"

#include "support/fail_alloc.h"
#include "support/test.h"

static ambulo_iteration iteration(int number, int intervals) {
  return (ambulo_iteration){.iteration = number, .intervals = intervals, .objective = number};
}

/* `count` iterations on each of `grids` grids */
static ambulo__history *filled(int grids, int count) {
  ambulo__history *h = ambulo__history_create(NULL);
  assert_non_null(h);
  for (int g = 0, n = 1; g < grids; g++)
    for (int i = 0; i < count; i++, n++) {
      ambulo_iteration it = iteration(n, 10 * (g + 1));
      ambulo__history_add(h, &it);
      assert_int_equal(h->shown.items[h->shown.count - 1].iteration, n); /* the newest is there */
    }
  return h;
}

static void few_are_all_there(void **state) {
  (void)state;
  ambulo__history *h = filled(4, 64);
  assert_int_equal(h->shown.count, AMBULO__HISTORY_MOST);
  assert_int_equal(h->shown.every, 1);
  for (int i = 0; i < h->shown.count; i++) assert_int_equal(h->shown.items[i].iteration, i + 1);
  free(h);
  h = ambulo__history_create(NULL);
  assert_int_equal(h->shown.count, 0);
  free(h);
  ambulo_iteration one = iteration(1, 1);
  ambulo__history_add(NULL, &one);
}

/* of each grid: those whose number on it is a multiple, in order, and its last */
static void many_are_thinned(void **state) {
  (void)state;
  static const int cases[][2] = {{1, 257}, {1, 1000}, {3, 150}, {3, 5000},
                                 {7, 333}, {2, 129},  {40, 9}};
  for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
    int grids = cases[c][0], each = cases[c][1], at = 0;
    ambulo__history *h = filled(grids, each);
    int every = h->shown.every;
    assert_true(every > 1 && h->shown.count <= AMBULO__HISTORY_MOST);
    assert_true(h->shown.count > AMBULO__HISTORY_MOST / 2 - 2 * grids);
    for (int g = 0; g < grids; g++)
      for (int i = 0; i < each; i++) {
        if (i % every != 0 && i != each - 1) continue;
        assert_int_equal(h->shown.items[at].iteration, g * each + i + 1);
        assert_int_equal(h->shown.items[at++].intervals, 10 * (g + 1));
      }
    assert_int_equal(at, h->shown.count);
    free(h);
  }
}

static void more_grids_than_room(void **state) {
  (void)state;
  ambulo__history *h = filled(1000, 1);
  assert_int_equal(h->shown.count, AMBULO__HISTORY_MOST);
  assert_int_equal(h->shown.items[0].iteration, 1);
  free(h);
}

static void memory_may_run_out(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(0);
  ambulo_allocator allocator = fail_alloc_hook(&memory);
  assert_null(ambulo__history_create(&allocator));
  assert_int_equal(memory.live, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(few_are_all_there),
      cmocka_unit_test(many_are_thinned),
      cmocka_unit_test(more_grids_than_room),
      cmocka_unit_test(memory_may_run_out),
  };
  return cmocka_run_group_tests_name("method/history", tests, NULL, NULL);
}
