/* Marks that would hide each other stand side by side, near their own place. */
#include "study/plot.h"
#include "support/test.h"

enum { COUNT = 9 };

static void equal_marks_stand_in_a_row(void **state) {
  (void)state;
  ambulo__plot_spot spot[COUNT], *order[COUNT];
  const double room[2] = {20.0, 20.0}, radius = 2.0;
  for (int i = 0; i < COUNT; i++) {
    spot[i] = (ambulo__plot_spot){100.0, 50.0, 0};
    order[i] = &spot[i];
  }
  assert_int_equal(ambulo__plot_spread(order, COUNT, radius, room), 0);
  double sum = 0.0;
  for (int i = 0; i < COUNT; i++) {
    sum += spot[i].x - 100.0;
    assert_true(fabs(spot[i].x - 100.0) <= 4.0 * 4.0 + 1e-9); /* no further than needed */
    for (int k = 0; k < i; k++) assert_true(fabs(spot[i].x - spot[k].x) > 4.0 - 0.01);
  }
  assert_close(sum, 0.0, 1e-9);
}

/* those that hide nobody stay where they are; another place is nobody's neighbour */
static void lonely_marks_stay(void **state) {
  (void)state;
  ambulo__plot_spot spot[] = {
      {100.0, 50.0, 0}, {100.0, 54.1, 0}, {100.0, 58.3, 0}, {100.0, 50.0, 1}};
  ambulo__plot_spot *order[] = {&spot[2], &spot[3], &spot[0], &spot[1]};
  const double room[2] = {20.0, 20.0};
  assert_int_equal(ambulo__plot_spread(order, 4, 2.0, room), 0);
  for (int i = 0; i < 4; i++) assert_true(spot[i].x == 100.0);
}

static void where_there_is_no_room_they_are_counted(void **state) {
  (void)state;
  ambulo__plot_spot spot[COUNT], *order[COUNT];
  const double room[1] = {5.0};
  for (int i = 0; i < COUNT; i++) {
    spot[i] = (ambulo__plot_spot){100.0, 50.0, 0};
    order[i] = &spot[i];
  }
  assert_int_equal(ambulo__plot_spread(order, COUNT, 2.0, room), COUNT - 3);
  for (int i = 0; i < COUNT; i++) assert_true(fabs(spot[i].x - 100.0) <= 5.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equal_marks_stand_in_a_row),
                                     cmocka_unit_test(lonely_marks_stay),
                                     cmocka_unit_test(where_there_is_no_room_they_are_counted)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
