/* Problems for persons: the shipped weights under the model's names, and knees of either sign. */
#include "support/walk_case.h"

static char *text_for(const ambulo_model *model) {
  ambulo__walker w;
  ambulo__text_buffer text;
  assert_int_equal(ambulo__walker_measure(model, NULL, NULL, &w), AMBULO_OK);
  assert_true(ambulo__walker_is_person(&w));
  w.file = "walker.yaml";
  w.speed = 1.25;
  w.step = 0.68;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__walk_of_person(&w, "models", NULL, &text), AMBULO_OK);
  char *copy = walk_changed(ambulo__text_data(&text), "\n\n\n", "\n\n\n");
  ambulo__text_free(&text);
  ambulo__walker_free(&w);
  return copy;
}

/* the six numbers of a strength */
static void strength_of(const char *text, const char *name, double value[6]) {
  char key[64];
  (void)snprintf(key, sizeof key, "%s: [", name);
  const char *at = strstr(strstr(text, "strength: {"), key);
  assert_non_null(at);
  at += strlen(key);
  for (int i = 0; i < 6; i++) {
    char *end;
    value[i] = strtod(at, &end);
    at = end + 1;
  }
}

/* a knee that bends to negative angles has the strengths of both directions exchanged, and all else
 * as it was */
static void knees_of_either_sign(void **state) {
  (void)state;
  import_case c = walk_person();
  char *turned = walk_changed(c.text, "axis: [0, 0, -1],\n     coordinate: {name: knee_angle_",
                              "axis: [0, 0, 1],\n     coordinate: {name: knee_angle_");
  char *model_text = walk_changed(turned, "range: [0, 120.000281]", "range: [-120.000281, 0]");
  ambulo_model *negative = walk_model(model_text);
  char *plain = text_for(c.model), *other = text_for(negative);
  double a[6], b[6];
  strength_of(plain, "knee_angle_r", a);
  strength_of(other, "knee_angle_r", b);
  assert_true(a[0] > 2.0 * a[3]); /* the fitted price of bending is low */
  assert_close(a[0], b[3], 1e-12);
  assert_close(a[3], b[0], 1e-12);
  strength_of(plain, "hip_flexion_r", a);
  strength_of(other, "hip_flexion_r", b);
  assert_memory_equal(a, b, sizeof a);
  free(plain);
  free(other);
  free(turned);
  free(model_text);
  ambulo_model_free(negative);
  import_shut(&c);
}

/* no arms: the weights of walk.yaml; coordinates that it does not know are at rest */
static void other_coordinates(void **state) {
  (void)state;
  import_case c = walk_person();
  char *text = text_for(c.model);
  assert_null(strstr(text, "arm_flex"));
  assert_non_null(strstr(text, "points: [lumbar, head_top]"));
  assert_null(strstr(text, "name: rest"));
  char *renamed = walk_changed(c.text, "lumbar_bending", "side_bending");
  ambulo_model *model = walk_model(renamed);
  char *with_rest = text_for(model);
  assert_non_null(strstr(with_rest, "name: rest"));
  assert_non_null(strstr(with_rest, "{side_bending: 1}"));
  assert_null(strstr(with_rest, "lumbar_bending"));
  free(text);
  free(renamed);
  free(with_rest);
  ambulo_model_free(model);
  import_shut(&c);
}

static void a_robot_is_no_person(void **state) {
  (void)state;
  import_case c = walk_biped();
  ambulo__walker w;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &w), AMBULO_OK);
  assert_false(ambulo__walker_is_person(&w));
  ambulo__walker_free(&w);
  import_shut(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(knees_of_either_sign),
      cmocka_unit_test(other_coordinates),
      cmocka_unit_test(a_robot_is_no_person),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
