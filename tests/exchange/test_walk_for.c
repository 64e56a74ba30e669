/* ambulo_walk_for: what its options do, and problems that load. */
#include "support/walk_case.h"

#include <math.h>

static char *walk_for(const char *model, double speed, double step) {
  ambulo_walk_options options = ambulo_walk_options_default();
  char *text = NULL;
  options.speed = speed;
  options.step_length = step;
  options.model = "other/biped.yaml";
  assert_int_equal(ambulo_walk_for(model, &options, NULL, NULL, &text), AMBULO_OK);
  return text;
}

/* the ratio of step length and cadence stays, whichever of the two is given */
static void speed_and_step(void **state) {
  import_case c = walk_biped();
  const char *path = scratch_path(state, "biped.yaml");
  scratch_write(path, c.text);
  char *usual = walk_for(path, AMBULO_OFF, AMBULO_OFF), *fast = walk_for(path, 0.8, AMBULO_OFF);
  char *longer = walk_for(path, AMBULO_OFF, 0.4), *both = walk_for(path, 0.8, 0.4);
  double v = walk_value(usual, "\n  speed: "), s = walk_value(usual, "step_length: ");
  assert_close(v, 0.2 * sqrt(9.81 * 0.76), 1e-4);
  assert_close(s, 0.4 * 0.76, 1e-4);
  assert_close(walk_value(fast, "step_length: "), s * sqrt(0.8 / v), 1e-4);
  assert_close(walk_value(longer, "\n  speed: "), v * pow(0.4 / s, 2), 1e-3);
  assert_close(walk_value(both, "\n  speed: "), 0.8, 1e-12);
  assert_close(walk_value(both, "step_length: "), 0.4, 1e-12);
  assert_non_null(strstr(both, "\nmodel: other/biped.yaml\n"));
  ambulo_text_free(usual, NULL);
  ambulo_text_free(fast, NULL);
  ambulo_text_free(longer, NULL);
  ambulo_text_free(both, NULL);
  import_shut(&c);
}

static void problems_load(void **state) {
  import_case c = walk_biped();
  const char *path = scratch_path(state, "biped.yaml");
  scratch_write(path, c.text);
  char *text = NULL;
  assert_int_equal(ambulo_walk_for(path, NULL, NULL, NULL, &text), AMBULO_OK);
  scratch_write(scratch_path(state, "walk.yaml"), text);
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load(scratch_path(state, "walk.yaml"), NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  ambulo_problem_free(problem);
  ambulo_text_free(text, NULL);
  import_shut(&c);
}

static void wrong_arguments(void **state) {
  ambulo_walk_options options = ambulo_walk_options_default();
  char *text = NULL;
  (void)state;
  assert_int_equal(ambulo_walk_for(NULL, NULL, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_walk_for("m.yaml", NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_walk_for("m\n.yaml", NULL, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  options.speed = -1.0;
  assert_int_equal(ambulo_walk_for("m.yaml", &options, NULL, NULL, &text), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_walk_for("none.yaml", NULL, NULL, NULL, &text), AMBULO_E_IO);
  assert_null(text);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(speed_and_step),
      cmocka_unit_test(problems_load),
      cmocka_unit_test(wrong_arguments),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
