/* Points on the trunk of imported persons: the lumbar joint, and the top of the head above it. */
#include "support/walk_case.h"

#include <math.h>

static void above_the_joint(void **state) {
  (void)state;
  import_case c = walk_person();
  int lumbar = ambulo_model_find_point(c.model, "lumbar");
  int top = ambulo_model_find_point(c.model, "head_top");
  assert_true(lumbar >= 0 && top >= 0);
  const ambulo_point *a = ambulo_model_point(c.model, lumbar),
                     *b = ambulo_model_point(c.model, top);
  const ambulo_link *torso = ambulo_model_link(c.model, a->link);
  assert_string_equal(torso->name, "torso");
  assert_int_equal(a->link, b->link);
  for (int i = 0; i < 3; i++) assert_close(a->position[i], 0.0, 1e-15);
  assert_close(b->position[0], torso->com[0], 1e-12);
  assert_close(b->position[1], 2.25 * torso->com[1], 1e-12);
  import_shut(&c);
}

static void not_of_robots(void **state) {
  (void)state;
  import_case c = walk_biped();
  assert_int_equal(ambulo_model_find_point(c.model, "lumbar"), -1);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(above_the_joint),
      cmocka_unit_test(not_of_robots),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
