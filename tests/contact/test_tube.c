/* Tube rows: reference between its samples, widths, free coordinates, equations, refusals. */
#include "support/messages.h"
#include "support/row_fixture.h"

enum { SAMPLES = 3, MOST = 32 };

typedef struct tube_fixture {
  row_fixture rows;
  double reference[SAMPLES * MOST], half_width[MOST];
  ambulo_tube tube;
} tube_fixture;

static int knee(const tube_fixture *f) {
  return ambulo_model_find_coordinate(f->rows.model, "knee_r");
}

/* the right knee runs 0, 1, 0 at 0, 0.5 and 1 s */
static void tube_open(tube_fixture *f) {
  memset(f, 0, sizeof *f);
  row_fixture_open(&f->rows, 0);
  for (int i = 0; i < MOST; i++) f->half_width[i] = INFINITY;
  int d = f->rows.model->coordinate_count;
  f->reference[d + knee(f)] = 1.0;
  f->half_width[knee(f)] = 0.25;
  f->tube = (ambulo_tube){SAMPLES, f->reference, f->half_width};
  f->rows.definition.tubes = &f->tube;
  f->rows.definition.tube_count = 1;
}

static void both_sides_of_one_coordinate(void **state) {
  (void)state;
  tube_fixture f;
  tube_open(&f);
  ambulo__tube_rows(&f.rows.context, &f.rows.table);
  assert_int_equal(f.rows.table.row_count, 2 * ROW_NODES);
  static const double middle[ROW_NODES] = {0.0, 0.5, 1.0, 0.5, 0.0};
  for (int k = 0; k < ROW_NODES; k++) {
    *row_channel(&f.rows, k, ambulo__channel_q(&f.rows.context.channels, knee(&f))) = 0.4;
    int low = row_find(&f.rows, "tracking_tube", "knee_r", "lower", 0.25 * k);
    int high = row_find(&f.rows, "tracking_tube", "knee_r", "upper", 0.25 * k);
    assert_close(row_value(&f.rows, low), 0.4 - (middle[k] - 0.25), 1e-14);
    assert_close(row_value(&f.rows, high), middle[k] + 0.25 - 0.4, 1e-14);
    assert_int_equal(f.rows.table.rows[low].relation, AMBULO_NOT_NEGATIVE);
    assert_string_equal(f.rows.table.rows[low].unit, "rad");
  }
  row_fixture_close(&f.rows);
}

static void no_width_is_an_equation(void **state) {
  (void)state;
  tube_fixture f;
  tube_open(&f);
  f.half_width[knee(&f)] = 0.0;
  ambulo__tube_rows(&f.rows.context, &f.rows.table);
  assert_int_equal(f.rows.table.row_count, ROW_NODES);
  int row = row_find(&f.rows, "tracking_tube", "knee_r", "on", 0.5);
  assert_int_equal(f.rows.table.rows[row].relation, AMBULO_EQUAL);
  *row_channel(&f.rows, 2, ambulo__channel_q(&f.rows.context.channels, knee(&f))) = 1.125;
  assert_close(row_value(&f.rows, row), 0.125, 1e-15);
  row_fixture_close(&f.rows);
}

static void impossible_tubes_are_refused(void **state) {
  (void)state;
  tube_fixture f;
  tube_open(&f);
  f.rows.definition.model = f.rows.model;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__tubes_check(&f.rows.definition, list), AMBULO_OK);
  f.half_width[knee(&f)] = -1.0;
  assert_int_equal(ambulo__tubes_check(&f.rows.definition, list), AMBULO_E_PROBLEM);
  assert_message(list, 0, "constraints.tubes[0]: half width -1 of 'knee_r'");
  f.half_width[knee(&f)] = 0.1;
  f.reference[knee(&f)] = (double)NAN;
  assert_int_equal(ambulo__tubes_check(&f.rows.definition, list), AMBULO_E_PROBLEM);
  assert_message(list, 1, "the reference of 'knee_r' is nan");
  f.tube.samples = 1;
  assert_int_equal(ambulo__tubes_check(&f.rows.definition, list), AMBULO_E_PROBLEM);
  assert_message(list, 2, "1 samples");
  ambulo_diagnostics_free(list);
  row_fixture_close(&f.rows);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(both_sides_of_one_coordinate),
                                     cmocka_unit_test(no_width_is_an_equation),
                                     cmocka_unit_test(impossible_tubes_are_refused)};
  return cmocka_run_group_tests_name("gait/tube", tests, NULL, NULL);
}
