/* Problems for robots: they load with their model, and bodies of one shape get the same problem. */
#include "support/walk_case.h"

#include <math.h>

static void print(const ambulo__walker *w, ambulo__text_buffer *text) {
  ambulo__text_init(text, NULL);
  ambulo__walk_of_robot(w, text);
  assert_int_equal(ambulo__text_status(text), AMBULO_OK);
}

/* lengths times two, masses times eight: speed times sqrt(2), times too, torques times sixteen */
static void one_shape(void **state) {
  (void)state;
  import_case c = walk_biped();
  ambulo__walker w;
  ambulo__text_buffer small, large;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &w), AMBULO_OK);
  w.file = "biped.yaml";
  w.speed = 0.5;
  w.step = 0.25;
  print(&w, &small);
  w.leg *= 2.0;
  w.mass *= 8.0;
  print(&w, &large);
  static const struct {
    const char *key;
    double factor;
  } values[] = {{"moment_arm: ", 2},
                {"loading_rate: ", 0.70710678},
                {"contact_tolerance: ", 2},
                {"clearance: {height: ", 2},
                {"torque_squared\n    weight: ", 1.0 / 256},
                {"acceleration\n    weight: ", 4},
                {"base_tx: ", 0.5}};
  for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
    double a = walk_value(ambulo__text_data(&small), values[i].key);
    double b = walk_value(ambulo__text_data(&large), values[i].key);
    assert_close(b / (a * values[i].factor), 1.0, 2e-3); /* four digits are written */
  }
  ambulo__text_free(&small);
  ambulo__text_free(&large);
  ambulo__walker_free(&w);
  import_shut(&c);
}

/* sides that differ: two steps, and ends that repeat */
static void sides_that_differ(void **state) {
  (void)state;
  import_case c = walk_biped();
  ambulo__walker w;
  ambulo__text_buffer text;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &w), AMBULO_OK);
  w.file = "biped.yaml";
  w.speed = 0.5;
  w.step = 0.25;
  w.symmetric = 0;
  print(&w, &text);
  assert_non_null(strstr(ambulo__text_data(&text), "steps: 2"));
  assert_non_null(strstr(ambulo__text_data(&text), "kind: periodic"));
  ambulo__text_free(&text);
  ambulo__walker_free(&w);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(one_shape),
      cmocka_unit_test(sides_that_differ),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
