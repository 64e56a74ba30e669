/* Limits in both halves of a mirrored stride. In the walker hip_r (3) and hip_l (5), knee_r (4) and
 * knee_l (6) are partners with sign +1; pelvis_tz (0) is its own image with sign -1, pelvis_tx (2)
 * travels. */
#include "ambulo/tools/load.h"
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "support/messages.h"
#include "support/row_fixture.h"
#include "support/test.h"

static void set(row_fixture *f, int i, double low, double high) {
  f->model->coordinates[i].range[0] = low;
  f->model->coordinates[i].range[1] = high;
}

static void expect(const ambulo__bound *b, double value, int owner, int is_upper, double given,
                   double later) {
  assert_close(b->value, value, 1e-15);
  assert_int_equal(b->owner, owner);
  assert_int_equal(b->is_upper, is_upper);
  assert_close(b->given, given, 1e-15);
  assert_close(b->later, later, 0);
}

static void open_mirrored(row_fixture *f) {
  row_fixture_open(f, 0);
  f->definition.ends = AMBULO_ENDS_MIRRORED;
}

static void the_narrower_end_wins(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  set(&f, 4, -2.0, 0.1);
  set(&f, 6, -1.0, 0.5);
  ambulo__bounds right = ambulo__bounds_of(&f.definition, 4, AMBULO_LIMITED_POSITION);
  ambulo__bounds left = ambulo__bounds_of(&f.definition, 6, AMBULO_LIMITED_POSITION);
  expect(&right.low, -1.0, 6, 0, -1.0, 1.0);
  expect(&right.high, 0.1, 4, 1, 0.1, 0.0);
  expect(&left.low, -1.0, 6, 0, -1.0, 0.0);
  expect(&left.high, 0.1, 4, 1, 0.1, 1.0);
  row_fixture_close(&f);
}

static void other_ends_leave_the_limits_alone(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  set(&f, 4, -2.0, 0.1);
  set(&f, 6, -1.0, 0.5);
  for (int ends = AMBULO_ENDS_FREE; ends <= AMBULO_ENDS_PERIODIC; ends++) {
    f.definition.ends = (ambulo_ends)ends;
    ambulo__bounds b = ambulo__bounds_of(&f.definition, 4, AMBULO_LIMITED_POSITION);
    expect(&b.low, -2.0, 4, 0, -2.0, 0.0);
    expect(&b.high, 0.1, 4, 1, 0.1, 0.0);
  }
  row_fixture_close(&f);
}

/* equal limits are each one's own: symmetric bodies keep the rows they have without mirror */
static void equal_limits_are_ones_own(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  set(&f, 4, -2.0, 0.1);
  set(&f, 6, -2.0, 0.1);
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 6, AMBULO_LIMITED_POSITION);
  expect(&b.low, -2.0, 6, 0, -2.0, 0.0);
  expect(&b.high, 0.1, 6, 1, 0.1, 0.0);
  row_fixture_close(&f);
}

/* the lower limit of the partner is the upper one of its negative */
static void a_sign_turns_the_interval(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  set(&f, 0, -0.3, 0.1);
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 0, AMBULO_LIMITED_POSITION);
  expect(&b.low, -0.1, 0, 1, 0.1, 1.0);
  expect(&b.high, 0.1, 0, 1, 0.1, 0.0);
  f.model->coordinates[4].mirror_sign = f.model->coordinates[6].mirror_sign = -1.0;
  set(&f, 4, -INFINITY, 0.4);
  set(&f, 6, -0.2, INFINITY);
  b = ambulo__bounds_of(&f.definition, 4, AMBULO_LIMITED_POSITION);
  assert_true(b.low.value == -INFINITY);
  expect(&b.high, 0.2, 6, 0, -0.2, 1.0);
  row_fixture_close(&f);
}

/* the second step is a travel further on; speed and torque do not travel */
static void what_travels_needs_room_for_two_steps(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  f.definition.travel = 0.6;
  set(&f, 2, -1.0, 2.0);
  f.model->coordinates[2].speed[1] = 3.0;
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 2, AMBULO_LIMITED_POSITION);
  expect(&b.low, -1.0, 2, 0, -1.0, 0.0);
  expect(&b.high, 1.4, 2, 1, 2.0, 1.0);
  b = ambulo__bounds_of(&f.definition, 2, AMBULO_LIMITED_SPEED);
  expect(&b.high, 3.0, 2, 1, 3.0, 0.0);
  b = ambulo__bounds_of(&f.definition, 1, AMBULO_LIMITED_POSITION); /* up: across the travel */
  assert_close(b.high.later, 0.0, 0);
  row_fixture_close(&f);
}

/* right angles of a model are right to rounding only: what crosses the travel has no share of it */
static void rounding_is_no_travel(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.ends = AMBULO_ENDS_MIRRORED;
  d.travel = 0.68;
  for (int i = 0; i < model->coordinate_count; i++) {
    ambulo__bounds b = ambulo__bounds_of(&d, i, AMBULO_LIMITED_POSITION);
    assert_close(b.low.later, 0.0, 0);
    assert_close(b.high.later, i == 0 ? d.duration : 0.0, 0);
    assert_int_equal(b.high.owner, i);
  }
  ambulo_model_free(model);
}

static void speed_and_torque_likewise(void **state) {
  (void)state;
  row_fixture f;
  open_mirrored(&f);
  ambulo__bounds speed = ambulo__bounds_of(&f.definition, 5, AMBULO_LIMITED_SPEED);
  ambulo__bounds torque = ambulo__bounds_of(&f.definition, 5, AMBULO_LIMITED_TORQUE);
  expect(&speed.low, -8.0, 3, 0, -8.0, 1.0);
  expect(&torque.high, 120.0, 3, 1, 120.0, 1.0);
  row_fixture_close(&f);
}

static void the_limit_of_a_row_is_the_models(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  ambulo__table_row row = {
      .kind = AMBULO__KIND_JOINT_LIMIT, .subject = "knee_r", .detail = "upper"};
  assert_close(ambulo__limit_given(f.model, &row), 0.1, 0);
  row.detail = "lower";
  assert_close(ambulo__limit_given(f.model, &row), -2.0, 0);
  row =
      (ambulo__table_row){.kind = AMBULO__KIND_SPEED_LIMIT, .subject = "hip_r", .detail = "lower"};
  assert_close(ambulo__limit_given(f.model, &row), -8.0, 0);
  row =
      (ambulo__table_row){.kind = AMBULO__KIND_TORQUE_LIMIT, .subject = "hip_r", .detail = "upper"};
  assert_close(ambulo__limit_given(f.model, &row), 120.0, 0);
  row = (ambulo__table_row){
      .subject = "nobody", .kind = AMBULO__KIND_JOINT_LIMIT, .detail = "lower", .constant = 2.0};
  assert_close(ambulo__limit_given(f.model, &row), -2.0, 0);
  row_fixture_close(&f);
}

static void words_name_the_owner(void **state) {
  (void)state;
  row_fixture f;
  char text[AMBULO__WHOSE_SIZE];
  open_mirrored(&f);
  ambulo__bounds b = ambulo__bounds_of(&f.definition, 5, AMBULO_LIMITED_POSITION);
  ambulo__bounds_whose(f.model, &b, text);
  assert_string_equal(text,
                      " (the upper end by the upper limit of hip_r, 1.5, in the mirrored half)");
  b = ambulo__bounds_of(&f.definition, 3, AMBULO_LIMITED_POSITION);
  ambulo__bounds_whose(f.model, &b, text);
  assert_string_equal(text, "");
  set(&f, 0, -0.3, 0.1); /* its own image, turned */
  b = ambulo__bounds_of(&f.definition, 0, AMBULO_LIMITED_POSITION);
  ambulo__bounds_whose(f.model, &b, text);
  assert_string_equal(
      text, " (the lower end by the upper limit of pelvis_tz, 0.1, in the mirrored half)");
  row_fixture_close(&f);
}

static int test_bounds_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_narrower_end_wins),
                                     cmocka_unit_test(other_ends_leave_the_limits_alone),
                                     cmocka_unit_test(equal_limits_are_ones_own),
                                     cmocka_unit_test(a_sign_turns_the_interval),
                                     cmocka_unit_test(what_travels_needs_room_for_two_steps),
                                     cmocka_unit_test(rounding_is_no_travel),
                                     cmocka_unit_test(speed_and_torque_likewise),
                                     cmocka_unit_test(the_limit_of_a_row_is_the_models),
                                     cmocka_unit_test(words_name_the_owner)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

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

static int test_limits_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(limits_at_nodes),
                                     cmocka_unit_test(a_range_of_no_width_is_one_equation),
                                     cmocka_unit_test(limits_on_control_points),
                                     cmocka_unit_test(a_fixed_coordinate_is_fixed_everywhere),
                                     cmocka_unit_test(rates_are_not_bounded),
                                     cmocka_unit_test(a_partners_limit_carries_its_name),
                                     cmocka_unit_test(a_limit_turns_with_the_sign),
                                     cmocka_unit_test(a_fixed_partner_fixes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
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

static int test_tube_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(both_sides_of_one_coordinate),
                                     cmocka_unit_test(no_width_is_an_equation),
                                     cmocka_unit_test(impossible_tubes_are_refused)};
  return cmocka_run_group_tests_name("gait/tube", tests, NULL, NULL);
}

/* Joints that could not carry the body at rest are named before solving. */

static const char text[] = "ambulo: 1\n"
                           "kind: problem\n"
                           "name: standing\n"
                           "model: %s.yaml\n"
                           "time: {duration: 0.6, intervals: 6}\n"
                           "trajectory: {basis: bspline, degree: 3, intervals: 6}\n"
                           "contacts:\n"
                           "  - {foot: right, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                           "  - {foot: left, mode: flat, from: 0, to: 0.6, place: [0, 0]}\n"
                           "ground_reaction: {kind: shared}\n"
                           "constraints: {ground_penetration: true, torque_limits: true}\n"
                           "objective: none\n";

static size_t warnings(const char *folder, const char *model, const char *phrase) {
  char problem_text[1200];
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  (void)snprintf(problem_text, sizeof problem_text, text, model);
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = problem_text,
                                                      .length = strlen(problem_text),
                                                      .name = "standing",
                                                      .directory = folder},
                               NULL, list, &problem);
  if (status) assert_message(list, 0, "no error");
  assert_int_equal(status, AMBULO_OK);
  size_t count = ambulo_diagnostics_count(list);
  if (phrase) assert_message(list, 0, phrase);
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(list);
  return count;
}

static void a_strong_body_stands(void **state) {
  (void)state;
  assert_int_equal(warnings("models", "walker_2d", NULL), 0);
}

/* ankles that push the toes up with 1 % of weight times stature or more */
static void a_weak_joint_is_named(void **state) {
  (void)state;
  assert_int_equal(
      warnings("tests/infeasible/models", "weak_ankles",
               "ankle_angle_r needs 0 N m to carry the body standing still; its torque limits are "
               "12.88 to 55.37 N m"),
      2);
}

static int test_strength_check_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_strong_body_stands),
                                     cmocka_unit_test(a_weak_joint_is_named)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_bounds_tests() + test_limits_tests() + test_tube_tests() +
         test_strength_check_tests();
}
