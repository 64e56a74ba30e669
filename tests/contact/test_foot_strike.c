/* Strike rows at q = 0: left heel at (-0.05, 0.09), left toe at (0.17, 0.09) m. */
#include "support/row_fixture.h"

static void open_with(row_fixture *f, int planar, const ambulo_contact *contacts) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  for (int k = 0; k < 3; k++) f->active[2 * k + WALKER_LEFT] = k;
  ambulo__foot_strike_rows(&f->context, &f->table);
}

static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, .place = {0.6, 0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, .place = {0.6, 0.1}},
    {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, .place = {0.6, 0.1}}};

static void places_by_mode(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 0, contacts);
  static const struct {
    const char *point, *detail;
    double time, value;
  } expected[] = {{"l_heel", "forward", 0.0, -0.65},  {"l_heel", "left", 0.0, -0.01},
                  {"l_heel", "forward", 0.25, -0.65}, {"l_heel", "left", 0.25, -0.01},
                  {"l_toe", "heading", 0.25, -0.01},  {"l_toe", "forward", 0.5, 0.17 - 0.82},
                  {"l_toe", "left", 0.5, -0.01}};
  assert_int_equal(f.table.row_count, 7);
  for (int i = 0; i < 7; i++) {
    int row = row_find(&f, "foot_strike", expected[i].point, expected[i].detail, expected[i].time);
    assert_int_equal(row, i);
    assert_int_equal(f.table.rows[row].relation, AMBULO_EQUAL);
    assert_close(row_value(&f, row), expected[i].value, 1e-14);
  }
  row_fixture_close(&f);
}

/* at an event both points are held; a flat foot holds its toes already */
static void points_at_events(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = contacts;
  for (int k = 1; k < 3; k++) f.active[2 * k + WALKER_LEFT] = k;
  row_event(&f, 1, WALKER_LEFT, 0);
  row_event(&f, 2, WALKER_LEFT, 1);
  row_event(&f, 3, WALKER_LEFT, 2);
  ambulo__foot_strike_rows(&f.context, &f.table);
  for (int k = 1; k < 3; k++) {
    assert_int_equal(row_count(&f, "foot_strike", "l_heel", "forward", 0.25 * k), 1);
    assert_int_equal(row_count(&f, "foot_strike", "l_heel", "left", 0.25 * k), 1);
    assert_int_equal(row_count(&f, "foot_strike", "l_toe", "heading", 0.25 * k), 1);
    assert_int_equal(row_count(&f, "foot_strike", "l_toe", "forward", 0.25 * k), 0);
  }
  assert_int_equal(row_count(&f, "foot_strike", "l_toe", "forward", 0.75), 1);
  assert_int_equal(f.table.row_count, 3 + 3 + 2);
  row_fixture_close(&f);
}

/* heel to toes at once, and a foot that goes on elsewhere: nothing covers anything */
static void unlike_contacts_both_hold(void **state) {
  (void)state;
  static const ambulo_contact apart[] = {
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 0.25, .place = {0.6, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.25, 0.5, .place = {0.7, 0.1}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.5, 1.0, .place = {0.7, 0.1}}};
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.contacts = apart;
  for (int k = 1; k < 3; k++) f.active[2 * k + WALKER_LEFT] = k;
  row_event(&f, 1, WALKER_LEFT, 0);
  row_event(&f, 2, WALKER_LEFT, 1);
  ambulo__foot_strike_rows(&f.context, &f.table);
  assert_int_equal(row_count(&f, "foot_strike", "l_heel", "forward", 0.25), 2);
  assert_int_equal(row_count(&f, "foot_strike", "l_heel", "forward", 0.5), 1);
  assert_int_equal(row_count(&f, "foot_strike", "l_toe", "forward", 0.5), 1);
  row_fixture_close(&f);
}

static void planar_models_have_no_lateral_rows(void **state) {
  (void)state;
  row_fixture f;
  open_with(&f, 1, contacts);
  assert_int_equal(f.table.row_count, 3);
  for (int r = 0; r < 3; r++) assert_string_equal(f.table.rows[r].detail, "forward");
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(places_by_mode),
                                     cmocka_unit_test(points_at_events),
                                     cmocka_unit_test(unlike_contacts_both_hold),
                                     cmocka_unit_test(planar_models_have_no_lateral_rows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
