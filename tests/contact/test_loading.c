/* How long feet are down and in the air: a mirrored step of 0.5 s, left strikes at 0, phases 0 /
 * 0.1 / 0.4 / 0.6 of the stride of 1 s: double support from 0 to 0.1 s. Heel to toe 0.22 m. */
#include "contact/loading.h"
#include "support/walker_fixture.h"

typedef struct fixture {
  ambulo_model *model;
  ambulo_contact contacts[12];
  ambulo_problem_definition definition;
} fixture;

static void open_with(fixture *f, double heel_strike) {
  f->model = walker_create(0);
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = 1,
                      .first_foot = WALKER_LEFT,
                      .step_length = 0.6,
                      .step_time = 0.5,
                      .step_width = 0.18,
                      .heel_strike = heel_strike,
                      .foot_flat = 0.1 + heel_strike,
                      .heel_off = 0.4 + heel_strike,
                      .toe_off = 0.6 + heel_strike,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.duration = 0.5;
  f->definition.ends = AMBULO_ENDS_MIRRORED;
  f->definition.contacts = f->contacts;
  assert_int_equal(
      ambulo_gait_expand(f->model, &gait, f->contacts, 12, &f->definition.contact_count), 0);
}

/* with strikes 0.05 s early the double support spans both ends: half of it is over at 0 */
static void double_support_goes_on_beyond_the_ends(void **state) {
  (void)state;
  fixture f;
  open_with(&f, -0.05);
  ambulo__span span;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_LEFT, 0.0, &span), 1);
  assert_close(span.from, -0.05, 1e-12);
  assert_close(span.to, 0.55, 1e-12);
  f.definition.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_LEFT, 0.0, &span), 1);
  assert_close(span.from, 0.0, 1e-12);
  ambulo_model_free(f.model);
}

static void time_in_the_air(void **state) {
  (void)state;
  fixture f;
  open_with(&f, 0.0);
  ambulo__span air = ambulo__air_span(&f.definition, WALKER_RIGHT, 0.2);
  assert_close(air.from, 0.1, 1e-12);
  assert_close(air.to, 0.5, 1e-12);
  ambulo__span span;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_RIGHT, 0.2, &span), 0);
  ambulo_model_free(f.model);
}

/* whose times a span has */
static void spans_know_their_contacts(void **state) {
  (void)state;
  fixture f;
  ambulo__span span;
  open_with(&f, -0.05);
  const ambulo_contact *c = f.contacts;
  assert_int_equal(ambulo__loaded_span(&f.definition, WALKER_LEFT, 0.0, &span), 1);
  assert_int_equal(c[span.begins].foot, WALKER_RIGHT); /* the mirror image of what strikes at .45 */
  assert_close(c[span.begins].from - 0.5, span.from, 1e-12);
  assert_int_equal(c[span.ends].foot, WALKER_RIGHT);
  assert_close(c[span.ends].to + 0.5, span.to, 1e-12);
  span = ambulo__air_span(&f.definition, WALKER_RIGHT, 0.2);
  assert_close(c[span.begins].to, span.from, 1e-12);
  assert_close(c[span.ends].from, span.to, 1e-12);
  f.definition.ends = AMBULO_ENDS_FREE;
  span = ambulo__air_span(&f.definition, WALKER_LEFT, 0.02);
  assert_int_equal(span.begins, -1);
  ambulo_model_free(f.model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(double_support_goes_on_beyond_the_ends),
                                     cmocka_unit_test(time_in_the_air),
                                     cmocka_unit_test(spans_know_their_contacts)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
