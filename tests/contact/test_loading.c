/* Transfer of the load: a mirrored step of 0.5 s, left strikes at 0, phases 0 / 0.1 / 0.4 / 0.6 of
 * the stride of 1 s: double support from 0 to 0.1 s. Heel to toe 0.22 m. */
#include "contact/loading.h"
#include "support/walker_fixture.h"

typedef struct fixture {
  ambulo_model *model;
  ambulo_contact contacts[12];
  ambulo_problem_definition definition;
  ambulo__foot_outline outlines[2];
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
  for (int i = 0; i < 2; i++) f->outlines[i] = ambulo__foot_outline_of(f->model, i);
}

static void expect_share(fixture *f, double time, double right) {
  ambulo__load load = ambulo__load_at(&f->definition, f->outlines, time);
  if (fabs(load.share[0] - right) > 1e-12)
    print_error("share of the right foot at %g s: %.15g, expected %.15g\n", time, load.share[0],
                right);
  assert_close(load.share[0], right, 1e-12);
  assert_close(load.share[0] + load.share[1], 1.0, 1e-15);
}

static void transfers_by_hand(void **state) {
  (void)state;
  fixture f;
  open_with(&f, 0.0);
  expect_share(&f, 0.0, 1.0);
  expect_share(&f, 0.05, pow(0.5, 1.4));
  expect_share(&f, 0.1, 0.0);
  expect_share(&f, 0.3, 0.0);
  expect_share(&f, 0.5, 0.0); /* the right foot only begins to carry */
  f.definition.ground_reaction.transfer = AMBULO_TRANSFER_LINEAR;
  expect_share(&f, 0.025, 0.75);
  f.definition.ground_reaction.transfer = AMBULO_TRANSFER_SMOOTH;
  expect_share(&f, 0.025, 1.0 - 0.0625 * 2.5);
  ambulo_model_free(f.model);
}

/* left heel at (0, 0.09), right ball at (-0.6 + 0.22, -0.09), 0.02 m ahead of it */
static void centres_of_pressure_are_apart(void **state) {
  (void)state;
  fixture f;
  open_with(&f, 0.0);
  ambulo__load load = ambulo__load_at(&f.definition, f.outlines, 0.05);
  assert_close(load.apart[0], -(0.6 - 0.22 - 0.02), 1e-12);
  assert_close(load.apart[1], -0.18, 1e-12);
  load = ambulo__load_at(&f.definition, f.outlines, 0.5); /* now the right foot is in front */
  assert_close(load.apart[0], 0.6 - 0.22 - 0.02, 1e-12);
  assert_close(load.apart[1], -0.18, 1e-12);
  load = ambulo__load_at(&f.definition, f.outlines, 0.3);
  assert_close(load.apart[0], 0.0, 0.0);
  ambulo_model_free(f.model);
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
  expect_share(&f, 0.0, pow(0.5, 1.4));
  expect_share(&f, 0.475, 1.0 - pow(0.75, 1.4));
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

/* the share of the right foot, with one time of a contact (side -1: none) and the time itself moved
 */
static double moved_share(fixture *f, int contact, int side, double by, double time) {
  double *moved = side < 0 ? NULL : side ? &f->contacts[contact].to : &f->contacts[contact].from;
  if (moved) *moved += by;
  double share = ambulo__load_at(&f->definition, f->outlines, time).share[0];
  if (moved) *moved -= by;
  return share;
}

static void expect_slope(fixture *f, int contact, int side, double time, double slope) {
  double step = 1e-6, moves = side < 0 ? step : 0.0;
  double difference = (moved_share(f, contact, side, step, time + moves) -
                       moved_share(f, contact, side, -step, time - moves)) /
                      (2.0 * step);
  assert_true(fabs(difference) > 1e-3);
  assert_close(slope, difference, 1e-6 * fabs(difference));
}

static void shares_have_slopes(void **state) {
  (void)state;
  static const ambulo_transfer transfers[] = {AMBULO_TRANSFER_EARLY, AMBULO_TRANSFER_SMOOTH,
                                              AMBULO_TRANSFER_LINEAR};
  static const double times[] = {0.01, 0.04, 0.46, 0.48}; /* the left foot in front, the right */
  fixture f;
  open_with(&f, -0.05);
  for (int k = 0; k < 12; k++) {
    double time = times[k % 4];
    f.definition.ground_reaction.transfer = transfers[k / 4];
    ambulo__share_slopes s = ambulo__load_slopes_at(&f.definition, time);
    expect_slope(&f, 0, -1, time, s.by_time);
    expect_slope(&f, s.begins, 0, time, s.by_begin);
    expect_slope(&f, s.ends, 1, time, s.by_end);
  }
  ambulo__share_slopes alone = ambulo__load_slopes_at(&f.definition, 0.2);
  assert_close(alone.by_time, 0.0, 0.0);
  assert_int_equal(alone.begins, -1);
  ambulo_model_free(f.model);
}

static void a_heel_rolls_until_it_is_flat(void **state) {
  (void)state;
  fixture f;
  open_with(&f, -0.05); /* the left foot from -.05 to .05 */
  const ambulo_contact *heel = ambulo__contact_of(&f.definition, WALKER_LEFT, 0.02);
  assert_int_equal(heel->mode, AMBULO_CONTACT_HEEL);
  ambulo__roll roll = ambulo__heel_roll_at(&f.definition, heel, 0.02);
  assert_close(roll.part, 0.7, 1e-12);
  assert_close(roll.duration, 0.1, 1e-12);
  assert_close(f.contacts[roll.begins].from, 0.45, 1e-12);
  ambulo_model_free(f.model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(transfers_by_hand),
                                     cmocka_unit_test(centres_of_pressure_are_apart),
                                     cmocka_unit_test(double_support_goes_on_beyond_the_ends),
                                     cmocka_unit_test(time_in_the_air),
                                     cmocka_unit_test(spans_know_their_contacts),
                                     cmocka_unit_test(shares_have_slopes),
                                     cmocka_unit_test(a_heel_rolls_until_it_is_flat)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
