/* Pairs of rows from a linear form; a form that holds no more terms makes the table fail. */
#include "contact/rows.h"
#include "support/row_fixture.h"
#include "support/test.h"

static const ambulo__bounded_name name = {AMBULO__KIND_CLEARANCE, "subject", "low", "high",
                                          AMBULO__METRES};

static void a_pair_of_rows(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 1);
  ambulo__linear form = {.constant = 0.25};
  const double direction[3] = {0.0, 2.0, -1.0};
  ambulo__linear_add(&form, 3, direction, 3.0);
  assert_int_equal(form.count, 2); /* no term of coefficient zero */
  ambulo__bounded_rows(&f.context, 1, &name, &form, -1.0, 4.0, &f.table);
  assert_int_equal(f.table.row_count, 2);
  *row_channel(&f, 1, 4) = 0.5;
  *row_channel(&f, 1, 5) = -0.2;
  double value = 0.25 + 6.0 * 0.5 + 3.0 * 0.2;
  assert_close(row_value(&f, 0), value + 1.0, 1e-15);
  assert_close(row_value(&f, 1), 4.0 - value, 1e-15);
  row_fixture_close(&f);
}

static void an_infinite_bound_has_no_row(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 1);
  ambulo__linear form = {.constant = 1.0};
  ambulo__bounded_rows(&f.context, 0, &name, &form, -INFINITY, 2.0, &f.table);
  assert_int_equal(f.table.row_count, 1);
  assert_string_equal(f.table.rows[0].detail, "high");
  ambulo__bounded_rows(&f.context, 0, &name, &form, -INFINITY, INFINITY, &f.table);
  assert_int_equal(f.table.row_count, 1);
  row_fixture_close(&f);
}

/* four directions fill a form, a fifth is no term that may be dropped */
static void a_full_form_is_an_error(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 1);
  ambulo__linear form = {.constant = 0.0};
  const double direction[3] = {1.0, 1.0, 1.0};
  for (int i = 0; i < AMBULO__FORM_TERMS / 3; i++) ambulo__linear_add(&form, 0, direction, 1.0);
  assert_int_equal(form.count, AMBULO__FORM_TERMS);
  assert_int_equal(form.overflow, 0);
  ambulo__bounded_rows(&f.context, 0, &name, &form, 0.0, 1.0, &f.table);
  assert_int_equal(f.table.status, AMBULO_OK);
  ambulo__linear_add(&form, 0, direction, 1.0);
  assert_int_equal(form.overflow, 1);
  ambulo__bounded_rows(&f.context, 0, &name, &form, 0.0, 1.0, &f.table);
  assert_int_equal(f.table.status, AMBULO_E_INTERNAL);
  row_fixture_close(&f);
}

/* a curved row is of one form, and a linear one of none */
static void curved_rows_are_of_one_form(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_table_init(&table, NULL);
  const ambulo__arc arc = {.slack = 0.25};
  const ambulo__solid solid = {.about = 3};
  ambulo__row_begin(&table, AMBULO__KIND_ZMP, "", "", AMBULO__METRES, AMBULO_EQUAL, 0, 0.0, 0.0);
  ambulo__row_arc(&table, AMBULO__KIND_PRESSURE, "", "", 0, 0.0, &arc);
  ambulo__row_solid(&table, AMBULO__KIND_OBSTACLE, "", "", 0, 0.0, &solid);
  assert_int_equal(table.status, AMBULO_OK);
  const ambulo__table_row *row = table.rows;
  assert_null(ambulo__row_curved_of(&table, &row[0]));
  for (int r = 0; r < 3; r++) {
    const ambulo__arc *found = ambulo__row_arc_of(&table, &row[r]);
    const ambulo__solid *kept = ambulo__row_solid_of(&table, &row[r]);
    assert_int_equal(found != NULL, r == 1);
    assert_int_equal(kept != NULL, r == 2);
    if (found) assert_close(found->slack, arc.slack, 0.0);
    if (kept) assert_int_equal(kept->about, solid.about);
  }
  ambulo__row_table_clear(&table);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_pair_of_rows), cmocka_unit_test(an_infinite_bound_has_no_row),
      cmocka_unit_test(curved_rows_are_of_one_form), cmocka_unit_test(a_full_form_is_an_error)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
