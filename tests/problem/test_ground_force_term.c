/* The root force in body weights, less the weight itself. */
#include "form_fixture.h"

static void standing_costs_nothing(void **state) {
  (void)state;
  form_fixture f;
  form_open(&f);
  ambulo_term term = {.kind = AMBULO_GROUND_FORCE};
  double weight = 3.5 * 9.81;
  *form_at(&f, 0, ambulo__channel_force(&f.context.channels, 0)) = 0.2 * weight;
  *form_at(&f, 0, ambulo__channel_force(&f.context.channels, 1)) = weight;
  *form_at(&f, 0, ambulo__channel_force(&f.context.channels, 2)) = 0.0;
  static const double want[] = {0.2, 0.0, 0.0};
  for (int axis = 0; axis < 3; axis++) {
    ambulo__form form;
    ambulo__term_form(&term, &f.context, 0, axis, &form);
    assert_close(form.u, want[axis], 1e-14);
    check_form_slopes(&f, &term, 0, axis);
  }
  form_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(standing_costs_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
