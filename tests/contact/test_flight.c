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

/* At nodes of collocation, of which a fixture with as many nodes as breakpoints has no others, a
 * twenty-fifth of the room between them. A body of 1.4 m has 0.8 of it about its centre. */
static void rows_are_the_wrench_about_the_centre(void **state) {
  (void)state;
  const double most = 0.02 / 50.0, room = 0.8 * most;
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
  test_flight_expect(&f, "pushed backward", most + 0.004);
  test_flight_expect(&f, "pushed forward", most - 0.004);
  test_flight_expect(&f, "pushed up", most - 0.007);
  test_flight_expect(&f, "pushed to the left", most - 0.009);
  test_flight_expect(&f, "pushed to the right", most + 0.009);
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

/* How far from zero the force may be at the nodes: all channels are zero here. */
static void expect_room(row_fixture *f, int node, double room) {
  static const char *const details[] = {"pushed up", "pushed forward", "tipped forward"};
  for (int i = 0; i < 3; i++) {
    int row = row_find(f, "flight", "body", details[i], f->times[node]);
    double got = row_value(f, row);
    if (fabs(got - room) > 1e-15) print_error("node %d: %g, expected %g\n", node, got, room);
    assert_close(got, room, 1e-15);
  }
}

static void set_basis(row_fixture *f, int degree, int intervals) {
  ambulo__basis_free(f->basis);
  assert_int_equal(
      ambulo__basis_create(AMBULO__BSPLINE, degree, intervals, 1.0, NULL, NULL, &f->basis),
      AMBULO_OK);
  f->context.basis = f->basis;
}

/* A flight from 0.5 s to 1 s. Accelerations of degree 1 with breakpoints at 0.5 and 1 s are a
 * straight line there: two equations, at its ends. Of degree 2 they are a parabola: three. With a
 * breakpoint at 0.75 s a straight line has three as well. */
static void as_many_nodes_are_held_as_a_spline_can(void **state) {
  (void)state;
  static const struct {
    int degree, intervals, middle;
  } cases[] = {{3, 2, 0}, {4, 2, 1}, {3, 4, 1}, {3, 1, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    row_fixture f;
    test_flight_prepare(&f, 0);
    row_event(&f, 2, WALKER_RIGHT, 0);
    row_event(&f, 4, WALKER_LEFT, -1);
    set_basis(&f, cases[i].degree, cases[i].intervals);
    ambulo__flight_rows(&f.context, &f.table);
    expect_room(&f, 2, 0.02 / 50.0);
    expect_room(&f, 3, cases[i].middle ? 0.02 / 50.0 : 0.02 / 2.0);
    expect_room(&f, 4, 0.02 / 50.0);
    row_fixture_close(&f);
  }
}

enum { MANY = 401 };

/* nodes of a flight that lasts all the time: which are held tight, and how many */
static int collocated(int degree, int intervals, int nodes, char held[MANY]) {
  row_fixture f;
  double times[MANY];
  int count = 0;
  row_fixture_open(&f, 0);
  set_basis(&f, degree, intervals);
  for (int k = 0; k < nodes; k++) times[k] = k / (nodes - 1.0);
  f.context.times = times;
  f.context.nodes = nodes;
  for (int k = 0; k < nodes; k++) {
    held[k] = (char)ambulo__is_collocated(&f.context, 0, nodes - 1, k);
    count += held[k];
  }
  row_fixture_close(&f);
  return count;
}

/* K intervals of degree p: K + p - 2 nodes, the ends among them, however many nodes there are; of
 * accelerations of degree 1 those on the breakpoints */
static void finer_nodes_have_no_more_equations(void **state) {
  (void)state;
  char held[MANY];
  for (int nodes = 101; nodes <= MANY; nodes += 100)
    for (int degree = 3; degree <= 6; degree++) {
      assert_int_equal(collocated(degree, 10, nodes, held), 10 + degree - 2);
      assert_true(held[0] && held[nodes - 1]);
    }
  collocated(3, 10, 101, held);
  for (int k = 0; k < 101; k++) assert_int_equal(held[k], k % 10 == 0);
  /* as many nodes as breakpoints: at every one */
  assert_int_equal(collocated(4, 10, 11, held), 11);
}

/* where the finer grid is tighter, and the one of the solve was not, that is not counted */
static void the_tighter_bound_is_of_the_nodes_alone(void **state) {
  (void)state;
  row_fixture f;
  test_flight_prepare(&f, 0);
  set_basis(&f, 3, 2);
  f.model->stature = 1.4;
  row_event(&f, 2, WALKER_RIGHT, 0);
  row_event(&f, 4, WALKER_LEFT, -1);
  ambulo__flight_rows(&f.context, &f.table);
  for (int r = 0; r < f.table.row_count; r++) {
    double room = ambulo__flight_room(&f.definition, &f.table, &f.table.rows[r]);
    double arm = ambulo__row_curved_of(&f.table, &f.table.rows[r]) ? 0.8 : 1.0;
    assert_close(room, f.table.rows[r].node == 3 ? 0.0 : arm * 0.02 * (0.5 - 0.02), 1e-15);
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
                                     cmocka_unit_test(as_many_nodes_are_held_as_a_spline_can),
                                     cmocka_unit_test(finer_nodes_have_no_more_equations),
                                     cmocka_unit_test(the_tighter_bound_is_of_the_nodes_alone),
                                     cmocka_unit_test(a_planar_body_has_three),
                                     cmocka_unit_test(contacts_have_no_rows_there),
                                     cmocka_unit_test(hands_hold_a_body_too),
                                     cmocka_unit_test(the_first_flight_is_found)};
  return cmocka_run_group_tests_name("contact/flight", tests, NULL, NULL);
}
