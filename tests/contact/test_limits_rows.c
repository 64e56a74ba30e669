/* Rows of limits and of tracking tubes: at nodes, on control points, of partners. */
#include "ambulo/tools/load.h"
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "support/messages.h"
#include "support/row_fixture.h"
#include "support/test.h"

/* Limit rows: finite ones only, both signs, units, fixed coordinates, control points. */

static void limits_at_nodes(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  f.definition.speed_limits = 1;
  f.definition.torque_limits = 1;
  ambulo__limit_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 5 * ROW_NODES);
  *row_channel(&f, 2, ambulo__channel_q(&f.context.channels, 4)) = -0.5;
  *row_channel(&f, 2, ambulo__channel_q(&f.context.channels, 3)) = 1.6;
  *row_channel(&f, 2, ambulo__channel_qd(&f.context.channels, 3)) = -3.0;
  *row_channel(&f, 2, ambulo__channel_tau(&f.context.channels, 3)) = 20.0;
  static const struct {
    const char *family, *subject, *detail, *unit;
    double value;
  } expected[] = {{"joint_limit", "knee_r", "lower", "rad", 1.5},
                  {"joint_limit", "knee_r", "upper", "rad", 0.6},
                  {"joint_limit", "hip_r", "upper", "rad", -0.1},
                  {"speed_limit", "hip_r", "lower", "rad/s", 5.0},
                  {"torque_limit", "hip_r", "upper", "N m", 100.0}};
  for (int i = 0; i < 5; i++) {
    int row = row_find(&f, expected[i].family, expected[i].subject, expected[i].detail, 0.5);
    assert_string_equal(f.table.rows[row].unit, expected[i].unit);
    assert_int_equal(f.table.rows[row].relation, AMBULO_NOT_NEGATIVE);
    assert_close(row_value(&f, row), expected[i].value, 1e-14);
  }
  row_fixture_close(&f);
}

static void open_with_a_fixed_coordinate(row_fixture *f, ambulo__basis_kind kind, int intervals) {
  row_fixture_open(f, 0);
  ambulo__basis_free(f->basis);
  f->basis = NULL;
  assert_int_equal(ambulo__basis_create(kind, 3, intervals, 1.0, NULL, NULL, &f->basis), AMBULO_OK);
  f->context.basis = f->basis;
  f->definition.joint_limits = AMBULO_LIMIT_NODES;
  f->model->coordinates[1].range[0] = f->model->coordinates[1].range[1] = 0.2;
  ambulo__limit_rows(&f->context, &f->table);
}

static void a_range_of_no_width_is_one_equation(void **state) {
  (void)state;
  row_fixture f;
  open_with_a_fixed_coordinate(&f, AMBULO__HERMITE, 4);
  int row = row_find(&f, "joint_limit", "pelvis_ty", "fixed", 0.0);
  assert_int_equal(f.table.rows[row].relation, AMBULO_EQUAL);
  assert_string_equal(f.table.rows[row].unit, "m");
  *row_channel(&f, 0, ambulo__channel_q(&f.context.channels, 1)) = 0.5;
  assert_close(row_value(&f, row), 0.3, 1e-15);
  row_fixture_close(&f);
}

/* with B-splines its equations stand on the control points, once each, whatever the nodes */
static void a_fixed_coordinate_is_fixed_everywhere(void **state) {
  (void)state;
  row_fixture f;
  open_with_a_fixed_coordinate(&f, AMBULO__BSPLINE, 2);
  int fixed = 0;
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (strcmp(row->detail, "fixed") != 0) continue;
    assert_int_equal(row->relation, AMBULO_EQUAL);
    assert_int_equal(row->node, -1);
    fixed++;
  }
  assert_int_equal(fixed, ambulo__basis_control_points(f.basis));
  row_fixture_close(&f);
}

static void limits_on_control_points(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.joint_limits = AMBULO_LIMIT_CONTROL_POINTS;
  ambulo__limit_rows(&f.context, &f.table);
  int points = ambulo__basis_control_points(f.basis);
  assert_int_equal(f.table.row_count, 3 * points);
  const ambulo__table_row *last = &f.table.rows[3 * points - 1];
  const ambulo__row_term *term = &f.table.terms[last->first_term];
  assert_string_equal(last->subject, "knee_r");
  assert_string_equal(last->detail, "upper");
  assert_int_equal(last->node, -1);
  assert_close(last->time, 1.0, 1e-14);
  assert_int_equal(term->node, -1);
  assert_int_equal(term->channel, (points - 1) * 7 + 4);
  assert_close(term->coefficient, -1.0, 0.0);
  assert_close(last->constant, 0.1, 0.0);
  row_fixture_close(&f);
}

/* Hermite unknowns alternate between values and rates: only the values are bounded */
static void rates_are_not_bounded(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  ambulo__basis_free(f.basis);
  f.basis = NULL;
  assert_int_equal(ambulo__basis_create(AMBULO__HERMITE, 3, 4, 1.0, NULL, NULL, &f.basis),
                   AMBULO_OK);
  f.context.basis = f.basis;
  f.definition.joint_limits = AMBULO_LIMIT_CONTROL_POINTS;
  ambulo__limit_rows(&f.context, &f.table);
  assert_int_equal(ambulo__basis_control_points(f.basis), 10);
  assert_int_equal(f.table.row_count, 3 * 5);
  row_fixture_close(&f);
}

/* with mirrored ends a row of hip_r may be a limit of hip_l: its name, T = 1 s later */
static void a_partners_limit_carries_its_name(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  f.definition.torque_limits = 1;
  ambulo__limit_rows(&f.context, &f.table);
  /* hip_r upper, hip_l by hip_r; knee_r both, knee_l by knee_r; torque of both hips by hip_r's */
  assert_int_equal(f.table.row_count, (2 + 4 + 2) * ROW_NODES);
  *row_channel(&f, 2, ambulo__channel_q(&f.context.channels, 5)) = 1.6;
  *row_channel(&f, 2, ambulo__channel_tau(&f.context.channels, 5)) = 20.0;
  int row = row_find(&f, "joint_limit", "hip_r", "upper", 1.5);
  assert_int_equal(f.table.rows[row].node, 2);
  assert_close(row_value(&f, row), -0.1, 1e-14);
  assert_close(row_value(&f, row_find(&f, "torque_limit", "hip_r", "upper", 1.5)), 100.0, 1e-14);
  row_fixture_close(&f);
}

/* pelvis_tz is minus itself in the mirror: its upper limit is its lower one, too */
static void a_limit_turns_with_the_sign(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  f.model->coordinates[0].range[1] = 0.1;
  ambulo__limit_rows(&f.context, &f.table);
  *row_channel(&f, 1, ambulo__channel_q(&f.context.channels, 0)) = -0.3;
  int row = row_find(&f, "joint_limit", "pelvis_tz", "upper", 0.25);
  assert_close(row_value(&f, row), 0.4, 1e-14);
  row = row_find(&f, "joint_limit", "pelvis_tz", "upper", 1.25);
  assert_close(row_value(&f, row), -0.2, 1e-14);
  assert_int_equal(f.table.rows[row].relation, AMBULO_NOT_NEGATIVE);
  row_fixture_close(&f);
}

/* a partner that cannot move fixes the other one: equations on its control points */
static void a_fixed_partner_fixes(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.joint_limits = AMBULO_LIMIT_NODES;
  f.model->coordinates[5].range[0] = f.model->coordinates[5].range[1] = 0.2;
  ambulo__limit_rows(&f.context, &f.table);
  int fixed = 0;
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (strcmp(row->detail, "fixed") != 0) continue;
    assert_string_equal(row->subject, "hip_l");
    assert_int_equal(row->relation, AMBULO_EQUAL);
    assert_close(row->constant, -0.2, 0);
    fixed++;
  }
  assert_int_equal(fixed, 2 * ambulo__basis_control_points(f.basis));
  row_fixture_close(&f);
}

/* Tube rows: reference between its samples, widths, free coordinates, equations, refusals. */

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
  const struct CMUnitTest tests[] = {cmocka_unit_test(limits_at_nodes),
                                     cmocka_unit_test(a_range_of_no_width_is_one_equation),
                                     cmocka_unit_test(limits_on_control_points),
                                     cmocka_unit_test(a_fixed_coordinate_is_fixed_everywhere),
                                     cmocka_unit_test(rates_are_not_bounded),
                                     cmocka_unit_test(a_partners_limit_carries_its_name),
                                     cmocka_unit_test(a_limit_turns_with_the_sign),
                                     cmocka_unit_test(a_fixed_partner_fixes),
                                     cmocka_unit_test(both_sides_of_one_coordinate),
                                     cmocka_unit_test(no_width_is_an_equation),
                                     cmocka_unit_test(impossible_tubes_are_refused)};
  return cmocka_run_group_tests_name("contact/limits_rows", tests, NULL, NULL);
}
