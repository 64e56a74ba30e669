/* Contact tubes at q = 0: left heel at (-0.05, 0.09), left toe at (0.17, 0.09) m, sole level.
 * Heel's pads are in test_heel_pad.c. */
#include "contact/rows.h"
#include "support/row_fixture.h"
#include "support/toed_body.h"

static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, .place = {0.6, 0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, .place = {0.6, 0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, .place = {0.6, 0.1}}};

static void prepare(row_fixture *f, int planar) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = 3;
  f->definition.contact_tolerance = 0.002;
  f->definition.ground_height = 0.001;
  f->definition.strike_pitch[0] = 0.2;
  f->definition.strike_pitch[1] = 0.4;
  for (int k = 0; k < 3; k++) f->active[2 * k + WALKER_LEFT] = k;
}

static void open_with(row_fixture *f, int planar) {
  prepare(f, planar);
  ambulo__contact_tube_rows(&f->context, &f->table);
}

static void expect(row_fixture *f, const char *subject, const char *detail, double time,
                   double value) {
  int row = row_find(f, "contact", subject, detail, time);
  assert_int_equal(f->table.rows[row].relation, AMBULO_NOT_NEGATIVE);
  if (fabs(row_value(f, row) - value) > 1e-12)
    print_error("%s %s at %g s\n", subject, detail, time);
  assert_close(row_value(f, row), value, 1e-12);
}

static void places_within_the_tolerance(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  for (int k = 0; k < 2; k++) {
    double t = 0.25 * k;
    expect(&f, "l_heel", "behind", t, -0.05 - 0.6 + 0.002);
    expect(&f, "l_heel", "ahead", t, 0.002 + 0.05 + 0.6);
    expect(&f, "l_heel", "to the right", t, 0.09 - 0.1 + 0.002);
    expect(&f, "l_heel", "to the left", t, 0.002 - 0.09 + 0.1);
    expect(&f, "l_heel", "below", t, -0.001 + 0.002);
    expect(&f, "l_heel", "above", t, 0.002 + 0.001);
  }
  expect(&f, "l_toe", "ahead", 0.5, 0.002 - 0.17 + 0.6 + 0.22);
  row_fixture_close(&f);
}

/* raises the toe centre and one heel corner of every node by hand */
static void directions_within_the_tolerance(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0);
  const ambulo_foot *foot = &f.model->feet[WALKER_LEFT];
  double width = 0.08, length = 0.22;
  for (int k = 0; k < 3; k++) {
    *row_channel(&f, k, ambulo__channel_point(&f.context.channels, foot->toe_center, 1)) += 0.022;
    *row_channel(&f, k, ambulo__channel_point(&f.context.channels, foot->toe_center, 2)) -= 0.0044;
    *row_channel(&f, k, ambulo__channel_point(&f.context.channels, foot->heel[0], 1)) += 0.0004;
  }
  double *corner = row_channel(&f, 0, ambulo__channel_point(&f.context.channels, foot->heel[0], 2));
  double sign = corner[0] < -0.09 ? 1.0 : -1.0; /* left is -z: is heel[0] the left corner? */
  expect(&f, "left", "toes low", 0.0, 0.022 / length - sin(0.2)); /* the strike */
  expect(&f, "left", "toes high", 0.0, sin(0.4) - 0.022 / length);
  expect(&f, "left", "toes high", 0.25, 0.01 - 0.022 / length);
  expect(&f, "left", "toes low", 0.25, 0.01 + 0.022 / length);
  expect(&f, "left", "toes low", 0.5, 0.95 + 0.022 / length);
  expect(&f, "left", "toes high", 0.5, -0.022 / length);
  expect(&f, "left", "turned left", 0.25, 0.01 - 0.0044 / length);
  expect(&f, "left", "turned right", 0.5, 0.02 + 0.0044 / length);
  expect(&f, "left", "left side high", 0.25, 0.01 - sign * 0.0004 / width);
  expect(&f, "left", "left side low", 0.5, 0.02 + sign * 0.0004 / width);
  row_fixture_close(&f);
}

static void planar_feet_have_four_places_and_a_pitch(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 1);
  assert_int_equal(f.table.row_count, 3 * 6);
  row_fixture_close(&f);
}

/* from heel to flat at 0.25 s, from flat to toes at 0.5 s, off at 0.75 s: both points are held, the
 * heel's once, and directions within what both allow */
static void events_hold_what_ends_and_what_begins(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0);
  row_event(&f, 1, WALKER_LEFT, 0);
  row_event(&f, 2, WALKER_LEFT, 1);
  row_event(&f, 3, WALKER_LEFT, 2);
  ambulo__contact_tube_rows(&f.context, &f.table);
  expect(&f, "l_heel", "behind", 0.25, -0.05 - 0.6 + 0.002); /* one row: row_find */
  expect(&f, "left", "toes low", 0.25, 0.0);
  expect(&f, "left", "toes high", 0.25, 0.01);
  expect(&f, "l_heel", "above", 0.5, 0.002 + 0.001);
  expect(&f, "l_toe", "ahead", 0.5, 0.002 - 0.17 + 0.6 + 0.22);
  expect(&f, "left", "toes low", 0.5, 0.01);
  expect(&f, "left", "toes high", 0.5, 0.0);
  expect(&f, "left", "turned left", 0.5, 0.01); /* flat is the tighter */
  expect(&f, "l_toe", "ahead", 0.75, 0.002 - 0.17 + 0.6 + 0.22);
  expect(&f, "left", "turned left", 0.75, 0.02);
  assert_int_equal(row_count(&f, "contact", "l_heel", "above", 0.75), 0);
  assert_int_equal(row_count(&f, "contact", "l_toe", "ahead", 0.25), 0);
  row_fixture_close(&f);
}

/* of feet with arcs, here at the heel's and the toes' centres: on its heel and on its toes a foot
 * is held by them, flat by its heel alone, also where it was on its heel just before */
static void arcs_hold_feet_that_roll(void **state) {
  (void)state;
  static const double radius = 0.03;
  row_fixture f;
  prepare(&f, 0);
  ambulo_foot *foot = &f.model->feet[WALKER_LEFT];
  foot->has_arcs = 1;
  foot->arc[0] = ambulo_model_find_point(f.model, "l_heel_in");
  foot->arc[1] = ambulo_model_find_point(f.model, "l_toe_out");
  double neutral = f.model->neutral[3 * foot->arc[1] + 1];
  f.model->neutral[3 * foot->arc[1] + 1] += radius; /* its centre is that far above the sole */
  row_event(&f, 1, WALKER_LEFT, 0);
  ambulo__contact_tube_rows(&f.context, &f.table);
  expect(&f, "l_heel_in", "ahead", 0.0, 0.002 + 0.05 + 0.6);
  expect(&f, "l_heel_in", "behind", 0.0, -0.05 - 0.6 + 0.002);
  assert_int_equal(row_count(&f, "contact", "l_heel", "ahead", 0.0), 0);
  assert_int_equal(row_count(&f, "contact", "l_heel_in", "ahead", 0.25), 0);
  expect(&f, "l_heel", "ahead", 0.25, 0.002 + 0.05 + 0.6);
  expect(&f, "l_toe_out", "above", 0.5, 0.002 + 0.001 + radius);
  /* the heel rises by a sine of 0.3: the centre is due ahead of where the flat foot has it */
  *row_channel(&f, 2, ambulo__channel_point(&f.context.channels, foot->heel_center, 1)) += 0.066;
  expect(&f, "l_toe_out", "ahead", 0.5, 0.002 - 0.17 + 0.6 + 0.22 - radius * asin(-0.3));
  expect(&f, "l_toe_out", "behind", 0.5, 0.002 + 0.17 - 0.6 - 0.22 + radius * asin(-0.3));
  f.model->neutral[3 * foot->arc[1] + 1] = neutral;
  row_fixture_close(&f);
}

/* toes that point down as they land: at the first node of a contact on the toes, and of no other */
static void a_foot_may_land_on_its_toes(void **state) {
  (void)state;
  static const ambulo_contact landing[] = {
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.0, 0.3, .place = {0.6, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.3, 0.6, .place = {0.6, 0.1}}};
  row_fixture f;
  prepare(&f, 0);
  f.definition.contacts = landing;
  f.definition.contact_count = 2;
  f.definition.strike_pitch[0] = -0.3;
  f.definition.strike_pitch[1] = -0.1;
  for (int k = 0; k < 3; k++) f.active[2 * k + WALKER_LEFT] = k == 2;
  ambulo__contact_tube_rows(&f.context, &f.table);
  expect(&f, "left", "toes low", 0.0, sin(0.3));
  expect(&f, "left", "toes high", 0.0, -sin(0.1));
  expect(&f, "left", "toes low", 0.25, 0.95);
  expect(&f, "left", "toes high", 0.25, 0.0);
  expect(&f, "left", "toes low", 0.5, 0.01);
  /* pitches of a heel are not about it */
  f.definition.strike_pitch[1] = 0.1;
  f.table.row_count = 0;
  ambulo__contact_tube_rows(&f.context, &f.table);
  expect(&f, "left", "toes low", 0.0, 0.95);
  row_fixture_close(&f);
}

/* a tip that the ball's joint moves: heel, flat and toes down on a surface that rises by 0.1 */
static void open_toed(row_fixture *f, double joint) {
  static ambulo_contact down[3];
  for (int k = 0; k < 3; k++) {
    down[k] = contacts[k];
    down[k].place[2] = 0.05;
    down[k].normal[0] = -0.1;
    down[k].normal[2] = 1.0;
  }
  row_fixture_open_body(f, toed_body_with(joint));
  f->definition.contacts = down;
  f->definition.contact_count = 3;
  f->definition.contact_tolerance = 0.002;
  f->definition.ground_height = 0.001;
  for (int k = 0; k < 3; k++) f->active[2 * k + TOED_LEFT] = k;
  ambulo__contact_tube_rows(&f->context, &f->table);
}

/* n . (tip - p) + e >= 0 wherever the foot is loaded, and nothing from above; in the air nothing.
 * The row is linear: what it says is its gradient, n on the tip, and has to follow the tip. */
static void toes_of_their_own_stay_above_the_surface(void **state) {
  (void)state;
  row_fixture f;
  open_toed(&f, 0.01);
  const double n[3] = {-0.1 / sqrt(1.01), 1.0 / sqrt(1.01), 0.0}; /* y is up, z to the right */
  const double surface[3] = {0.6, 0.001 + 0.05, -0.1};
  int tip = f.model->feet[TOED_LEFT].tip;
  assert_int_not_equal(f.model->points[tip].link,
                       f.model->points[f.model->feet[TOED_LEFT].toe_center].link);
  for (int k = 0; k < 3; k++) {
    double *r = row_channel(&f, k, ambulo__channel_point(&f.context.channels, tip, 0));
    double above = 0.002;
    for (int i = 0; i < 3; i++) above += n[i] * (r[i] - surface[i]);
    expect(&f, "toe_l", "below", 0.25 * k, above);
    for (int i = 0; i < 3; i++) {
      r[i] += 0.01;
      expect(&f, "toe_l", "below", 0.25 * k, above += 0.01 * n[i]);
    }
    int row = row_find(&f, "contact", "toe_l", "below", 0.25 * k);
    assert_int_equal(f.table.rows[row].term_count, 2); /* the tip's x and y: nothing else counts */
    assert_int_equal(row_count(&f, "contact", "toe_l", "above", 0.25 * k), 0);
    assert_int_equal(row_count(&f, "contact", "toe_r", "below", 0.25 * k), 0);
  }
  assert_int_equal(row_count(&f, "contact", "toe_l", "below", 0.75), 0);
  row_fixture_close(&f);
  open_toed(&f, -0.02); /* tip and ball on one link: the foot's pitch says where the tip is */
  for (int k = 0; k < 3; k++)
    assert_int_equal(row_count(&f, "contact", "toe_l", "below", 0.25 * k), 0);
  row_fixture_close(&f);
}

/* the pitch of a strike is asked at the first node of a contact, however far the next is */
static void a_strike_is_the_first_node_of_any_grid(void **state) {
  (void)state;
  row_fixture f;
  prepare(&f, 0);
  f.times[1] = 0.01;
  f.times[2] = 0.02;
  f.definition.contacts =
      (const ambulo_contact[]){{WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.01, 1.0, .place = {0.6, 0.1}}};
  f.definition.contact_count = 1;
  f.active[WALKER_LEFT] = -1;
  f.active[2 + WALKER_LEFT] = f.active[4 + WALKER_LEFT] = 0;
  ambulo__contact_tube_rows(&f.context, &f.table);
  expect(&f, "left", "toes low", 0.01, -sin(0.2));
  expect(&f, "left", "toes low", 0.02, 0.0);
  row_fixture_close(&f);
}

static void expect_nodes(const row_fixture *f, int places, int forces) {
  assert_int_equal(ambulo__distinct_nodes(&f->context, AMBULO__OF_PLACES), places);
  assert_int_equal(ambulo__distinct_nodes(&f->context, AMBULO__OF_FORCES), forces);
}

/* ends that match make the last node the first one; forces repeat only where accelerations do */
static void the_last_node_of_a_repeating_motion_has_none(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  expect_nodes(&f, ROW_NODES, ROW_NODES);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.ends_order = 2;
  expect_nodes(&f, ROW_NODES, ROW_NODES);
  f.definition.contact_tolerance = 0.002;
  expect_nodes(&f, ROW_NODES - 1, ROW_NODES - 1);
  f.definition.ends_order = 1;
  expect_nodes(&f, ROW_NODES - 1, ROW_NODES);
  f.definition.ends_order = 0;
  expect_nodes(&f, ROW_NODES - 1, ROW_NODES);
  f.definition.ends = AMBULO_ENDS_FREE;
  expect_nodes(&f, ROW_NODES, ROW_NODES);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(places_within_the_tolerance),
      cmocka_unit_test(directions_within_the_tolerance),
      cmocka_unit_test(planar_feet_have_four_places_and_a_pitch),
      cmocka_unit_test(events_hold_what_ends_and_what_begins),
      cmocka_unit_test(arcs_hold_feet_that_roll),
      cmocka_unit_test(a_foot_may_land_on_its_toes),
      cmocka_unit_test(toes_of_their_own_stay_above_the_surface),
      cmocka_unit_test(a_strike_is_the_first_node_of_any_grid),
      cmocka_unit_test(the_last_node_of_a_repeating_motion_has_none)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
