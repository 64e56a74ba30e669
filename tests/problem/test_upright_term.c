/* Direction cosines of a segment's line; a line over joints. */
#include "form_fixture.h"

static void a_leaning_line_has_its_cosines(void **state) {
  (void)state;
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_UPRIGHT, .point = {1, 0}};
  /* the two points of the arm are hypot(0.2, 0.05) apart on their link */
  double length = hypot(0.2, 0.05), lean = 0.3;
  for (int axis = 0; axis < 3; axis++)
    *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 1, axis)) = 1.0;
  *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 0, 0)) = 1.0 + length * sin(lean);
  *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 0, 1)) = 1.0 + length * cos(lean);
  *form_at(&f, 2, ambulo__channel_point(&f.context.channels, 0, 2)) = 1.0;
  ambulo__form form;
  ambulo__term_form(&term, &f.context, 2, 0, &form);
  assert_close(form.u, sin(lean), 1e-14);
  ambulo__term_form(&term, &f.context, 2, 1, &form);
  assert_close(form.u, 0.0, 1e-14);
  check_form_slopes(&f, &term, 2, 0);
  check_form_slopes(&f, &term, 2, 1);
  form_close(&f);
}

/* hip to ball of the foot: 0.534643 of the stature below and 0.08 ahead at q = 0 */
static void a_line_over_joints_has_its_length_at_rest(void **state) {
  (void)state;
  ambulo_model *body = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &body),
                   AMBULO_OK);
  int line[2] = {ambulo_model_find_point(body, "hip_r"), ambulo_model_find_point(body, "ball_r")};
  assert_close(ambulo__upright_length(body, line), 1.75 * hypot(0.534643, 0.08), 1e-9);
  ambulo_model_free(body);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_leaning_line_has_its_cosines),
                                     cmocka_unit_test(a_line_over_joints_has_its_length_at_rest)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
