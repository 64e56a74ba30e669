/* Strike rows at q = 0: left heel at (-0.05, 0.09), left toe at (0.17, 0.09) m. */
#include "support/row_fixture.h"

static void open_with(row_fixture *f, int planar, const ambulo_contact *contacts) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  for (int k = 0; k < 3; k++) f->active[2 * k + WALKER_LEFT] = k;
  ambulo__foot_strike_rows(&f->context, &f->table);
}

static const ambulo_contact contacts[] = {{WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.2, {0.6, 0.1}},
                                          {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.2, 0.4, {0.6, 0.1}},
                                          {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.4, 0.6, {0.6, 0.1}}};

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
                                     cmocka_unit_test(planar_models_have_no_lateral_rows)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
