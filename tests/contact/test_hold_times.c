/* Windows of what is held: their ramps, their ends, their events. */
#include "contact/hold_times.h"

#include "contact/phases.h"
#include "support/planar_walker.h"
#include "support/test.h"

static ambulo_hold held(double from, double to) {
  ambulo_hold h = ambulo_hold_default();
  h.name = "box";
  h.hand[0] = 0;
  h.mass = 1;
  h.from = from;
  h.to = to;
  h.ramp = 0.2;
  return h;
}

static void test_a_window(void **state) {
  (void)state;
  ambulo_hold h = held(0.5, 1.5);
  const double times[] = {0, 0.5, 0.55, 0.6, 0.7, 1, 1.3, 1.4, 1.5, 2};
  const double want[] = {0, 0, 0.15625, 0.5, 1, 1, 1, 0.5, 0, 0};
  for (int i = 0; i < 10; i++) assert_close(ambulo__hold_window(&h, 2, times[i]), want[i], 1e-12);
}

/* what is held from the beginning, or to the end, is held whole there */
static void test_open_ends(void **state) {
  (void)state;
  ambulo_hold all = held(0, INFINITY), first = held(-1, 1), last = held(1, 2);
  double time[4];
  for (int i = 0; i <= 20; i++) assert_close(ambulo__hold_window(&all, 2, 0.1 * i), 1, 0);
  assert_int_equal(ambulo__hold_events(&all, 2, time), 0);
  assert_close(ambulo__hold_window(&first, 2, 0), 1, 0);
  assert_close(ambulo__hold_window(&first, 2, 0.9), 0.5, 1e-12);
  assert_int_equal(ambulo__hold_events(&first, 2, time), 2);
  assert_close(time[0], 0.8, 1e-15);
  assert_close(time[1], 1, 0);
  assert_close(ambulo__hold_window(&last, 2, 2), 1, 0);
  assert_int_equal(ambulo__hold_events(&last, 2, time), 2);
  assert_close(time[1], 1.2, 1e-15);
}

/* slopes of the window by the time and by its numbers, against differences */
static void test_slopes(void **state) {
  (void)state;
  const ambulo_hold windows[] = {held(0.5, 1.5), held(-1, 1.5), held(0.5, INFINITY),
                                 held(0.5, 0.93)};
  const double step = 1e-6;
  for (int i = 0; i < 4; i++) {
    for (double t = 0.013; t < 2.0; t += 0.03) {
      ambulo__hold_slopes w = ambulo__hold_slopes_at(&windows[i], 2, t);
      double got[] = {w.by_time, w.by_from, w.by_to, w.by_ramp}, value[2];
      assert_close(w.value, ambulo__hold_window(&windows[i], 2, t), 0);
      for (int number = 0; number < 4; number++) {
        for (int side = 0; side < 2; side++) {
          double by = side ? step : -step;
          ambulo_hold h = windows[i];
          if (number == 1) h.from += by;
          if (number == 2) h.to += by;
          if (number == 3) h.ramp += by;
          value[side] = ambulo__hold_window(&h, 2, number == 0 ? t + by : t);
        }
        assert_close(got[number], (value[1] - value[0]) / (2 * step), 1e-7);
      }
    }
  }
}

/* ends of ramps are nodes of a grid on events, and no knots */
static void test_events_of_the_grid(void **state) {
  (void)state;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = walker_create();
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo_hold h = held(0.5, 1.5);
  ambulo__events events;
  d.model = model;
  d.duration = 2;
  d.holds = &h;
  d.hold_count = 1;
  assert_int_equal(ambulo__events_create(&d, AMBULO__EVENTS_OF_ROWS, &a, &events), AMBULO_OK);
  const double want[] = {0.5, 0.7, 1.3, 1.5};
  assert_int_equal(events.count, 4);
  for (int i = 0; i < 4; i++) assert_close(events.time[i], want[i], 1e-15);
  ambulo__free(&a, events.time);
  assert_int_equal(ambulo__events_create(&d, AMBULO__EVENTS_OF_CONTACTS, &a, &events), AMBULO_OK);
  assert_int_equal(events.count, 0);
  ambulo__free(&a, events.time);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_window), cmocka_unit_test(test_slopes),
                                     cmocka_unit_test(test_open_ends),
                                     cmocka_unit_test(test_events_of_the_grid)};
  return cmocka_run_group_tests_name("gait/hold_times", tests, NULL, NULL);
}
