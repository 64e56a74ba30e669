/* Rows of flight: no force and no moment where nothing touches the body. */
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "support/patched_walker.h"
#include "support/row_fixture.h"

/* Rows of a body that nothing touches, by hand: a walker that stands on its right foot until 0.5 s
 * of 1 s, then flies, and comes down on its left one at the end.
 *
 * World: x forward, y up, z right, so that left is -z; 72 kg. */

static const ambulo_contact hop[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.5, .place = {0.0, -0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 1.0, 1.0, .place = {0.5, 0.1}}};
static const double test_flight_mg = 72.0 * 9.81;

static void test_flight_prepare(row_fixture *f, int planar) {
  row_fixture_open(f, planar);
  f->definition.contacts = hop;
  f->definition.contact_count = 2;
  f->definition.ground_reaction.kind = AMBULO_REACTION_SHARED;
  f->definition.ground_reaction.flight_tolerance = 0.02;
  f->context.channels.feet = f->context.channels.slots = 2;
  free(f->channel);
  f->channel =
      calloc((size_t)(ROW_NODES * ambulo__channel_count(&f->context.channels)), sizeof(double));
  f->active[2 * 0 + WALKER_RIGHT] = f->active[2 * 1 + WALKER_RIGHT] = 0;
  f->active[2 * 4 + WALKER_LEFT] = 1;
}

static void expect_flights(const row_fixture *f, const char *want) {
  for (int k = 0; k < ROW_NODES; k++) {
    int flies = ambulo__in_flight(&f->context, k), rows = 0;
    if (flies != want[k] - '0') print_error("node %d: %d, expected %c\n", k, flies, want[k]);
    assert_int_equal(flies, want[k] - '0');
    for (int r = 0; r < f->table.row_count; r++)
      rows += f->table.rows[r].kind == AMBULO__KIND_FLIGHT && f->table.rows[r].node == k;
    if (f->table.row_count > 0) assert_true((rows > 0) == flies);
  }
}

static void nothing_holds_in_flight(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 0);
  expect_flights(&f, "00110");
  ambulo__flight_rows(&f.context, &f.table);
  expect_flights(&f, "00110");
  /* on a grid on events also where flight ends, and where it begins */
  row_event(&f, 2, WALKER_RIGHT, 0);
  row_event(&f, 4, WALKER_LEFT, -1);
  f.table.row_count = 0;
  ambulo__flight_rows(&f.context, &f.table);
  expect_flights(&f, "00111");
  row_fixture_close(&f);
}

/* where ends match up to accelerations the first node is the last: the flight that ends there */
static void ends_that_match_share_a_flight(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 0);
  row_event(&f, 4, WALKER_LEFT, -1);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.ends_order = 2;
  assert_int_equal(ambulo__in_flight(&f.context, 0), 1);
  ambulo__flight_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "flight", "body", "pushed up", 0.0), 1);
  assert_int_equal(row_count(&f, "flight", "body", "pushed up", 1.0), 0);
  /* forces may begin with a jump where only speeds match */
  f.definition.ends_order = 1;
  assert_int_equal(ambulo__in_flight(&f.context, 0), 0);
  f.table.row_count = 0;
  ambulo__flight_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "flight", "body", "pushed up", 0.0), 0);
  assert_int_equal(row_count(&f, "flight", "body", "pushed up", 1.0), 1);
  row_fixture_close(&f);
}

static void test_flight_expect(row_fixture *f, const char *detail, double value) {
  double got = row_value(f, row_find(f, "flight", "body", detail, 0.75));
  if (fabs(got - value) > 1e-12) print_error("%s: %.15g, expected %.15g\n", detail, got, value);
  assert_close(got, value, 1e-12);
}

/* a body of 1.4 m has 0.8 of the room about its centre */
static void rows_are_the_wrench_about_the_centre(void **state) {
  (void)state;
  const double room = 0.8 * 0.02;
  row_fixture f;
  test_flight_prepare(&f, 0);
  f.model->stature = 1.4;
  ambulo__flight_rows(&f.context, &f.table);
  const ambulo__channels *c = &f.context.channels;
  const double force[3] = {0.004, 0.007, -0.009}, moment[3] = {0.03, -0.02, 0.05},
               center[3] = {0.6, 1.1, 0.2};
  for (int i = 0; i < 3; i++) {
    *row_channel(&f, 3, ambulo__channel_force(c, i)) = test_flight_mg * force[i];
    *row_channel(&f, 3, ambulo__channel_moment(c, i)) = test_flight_mg * moment[i];
    *row_channel(&f, 3, ambulo__channel_center(c, i)) = center[i];
  }
  test_flight_expect(&f, "pushed backward", 0.02 + 0.004);
  test_flight_expect(&f, "pushed forward", 0.02 - 0.004);
  test_flight_expect(&f, "pushed up", 0.02 - 0.007);
  test_flight_expect(&f, "pushed to the left", 0.02 - 0.009);
  test_flight_expect(&f, "pushed to the right", 0.02 + 0.009);
  double about[3] = {moment[0] - (1.1 * -0.009 - 0.2 * 0.007),
                     moment[1] - (0.2 * 0.004 - 0.6 * -0.009),
                     moment[2] - (0.6 * 0.007 - 1.1 * 0.004)};
  test_flight_expect(&f, "tipped to the right", room - about[0]);
  test_flight_expect(&f, "tipped to the left", room + about[0]);
  test_flight_expect(&f, "turned to the left", room - about[1]);
  test_flight_expect(&f, "turned to the right", room + about[1]);
  test_flight_expect(&f, "tipped forward", room + about[2]);
  test_flight_expect(&f, "tipped backward", room - about[2]);
  row_fixture_close(&f);
}

/* a fifth of the tolerance where a contact ends or begins: all channels are zero here */
static void less_is_left_beside_a_contact(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 0);
  row_event(&f, 2, WALKER_RIGHT, 0);
  row_event(&f, 4, WALKER_LEFT, -1);
  ambulo__flight_rows(&f.context, &f.table);
  static const char *const details[] = {"pushed up", "pushed forward", "tipped forward"};
  for (int k = 2; k < ROW_NODES; k++)
    for (int i = 0; i < 3; i++) {
      int row = row_find(&f, "flight", "body", details[i], f.times[k]);
      assert_close(row_value(&f, row), k == 3 ? 0.02 : 0.2 * 0.02, 1e-15);
    }
  row_fixture_close(&f);
}

static void a_planar_body_has_three(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 1);
  ambulo__flight_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "flight", "body", "pushed up", 0.75), 1);
  assert_int_equal(row_count(&f, "flight", "body", "pushed forward", 0.75), 1);
  assert_int_equal(row_count(&f, "flight", "body", "tipped forward", 0.75), 1);
  assert_int_equal(f.table.row_count, 2 * 3 * 2);
  row_fixture_close(&f);
}

/* what the foot carried before, and what it carries from then on, is nothing on the event */
static void contacts_have_no_rows_there(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 0);
  row_event(&f, 2, WALKER_RIGHT, 0);
  ambulo__sharing_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "normal_force", "right", "pulls", 0.25), 1);
  assert_int_equal(row_count(&f, "normal_force", "right", "pulls", 0.5), 0);
  row_fixture_close(&f);
}

static void hands_hold_a_body_too(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 0);
  ambulo_model *body = patched_walker(0);
  const ambulo_contact held[] = {
      {-1, AMBULO_CONTACT_PATCH, 0.5, 0.75, .place = {0.0, 0.0}, .patch = HAND_R}};
  f.definition.model = body;
  f.context.model = body;
  f.definition.contacts = held;
  f.definition.contact_count = 1;
  for (int k = 0; k < 2 * ROW_NODES; k++) f.active[k] = -1;
  expect_flights(&f, "11011");
  row_event(&f, 0, WALKER_LEFT, -1);
  f.context.before = f.before;
  expect_flights(&f, "11111");
  f.context.model = f.definition.model = f.model;
  ambulo_model_free(body);
  row_fixture_close(&f);
}

static void the_first_flight_is_found(void **state) {
  (void)state;
  row_fixture f;
  ambulo__span span;
  test_flight_prepare(&f, 0);
  assert_int_equal(ambulo__flight_span(&f.definition, &span), 1);
  assert_close(span.from, 0.5, 0.0);
  assert_close(span.to, 1.0, 0.0);
  f.definition.contact_count = 1;
  assert_int_equal(ambulo__flight_span(&f.definition, &span), 1);
  assert_close(span.to, 1.0, 0.0);
  const ambulo_contact step[] = {hop[0],
                                 {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.8, 1.0, .place = {0.5, 0.1}}};
  f.definition.contacts = step;
  f.definition.contact_count = 2;
  assert_int_equal(ambulo__flight_span(&f.definition, &span), 1);
  assert_close(span.from, 0.5, 0.0);
  assert_close(span.to, 0.8, 0.0);
  f.definition.contact_count = 0;
  assert_int_equal(ambulo__flight_span(&f.definition, &span), 1);
  assert_close(span.from, 0.0, 0.0);
  const ambulo_contact walk[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.4, 1.0, .place = {0.5, 0.1}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.4 + 1e-12, .place = {0.0, -0.1}}};
  f.definition.contacts = walk;
  f.definition.contact_count = 2;
  assert_int_equal(ambulo__flight_span(&f.definition, &span), 0);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_holds_in_flight),
                                     cmocka_unit_test(ends_that_match_share_a_flight),
                                     cmocka_unit_test(rows_are_the_wrench_about_the_centre),
                                     cmocka_unit_test(less_is_left_beside_a_contact),
                                     cmocka_unit_test(a_planar_body_has_three),
                                     cmocka_unit_test(contacts_have_no_rows_there),
                                     cmocka_unit_test(hands_hold_a_body_too),
                                     cmocka_unit_test(the_first_flight_is_found)};
  return cmocka_run_group_tests_name("contact/force_rows_flight", tests, NULL, NULL);
}
