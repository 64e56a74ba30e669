/* End rows: prescribed values, periodic and mirrored matching with travel and scale.
 *
 * Cubic B-spline, 4 intervals in 1 s: the largest weights at t = 0 are 3 K / T = 12 of the
 * first derivative and 9 (K / T)^2 = 144 of the second. */
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "contact/schedule.h"
#include "model/model.h"
#include "support/messages.h"
#include "support/patched_walker.h"
#include "support/planar_walker.h"
#include "support/row_fixture.h"
#include "support/test.h"

static void set(row_fixture *f, int node, int coordinate, double q, double qd, double qdd) {
  *row_channel(f, node, ambulo__channel_q(&f->context.channels, coordinate)) = q;
  *row_channel(f, node, ambulo__channel_qd(&f->context.channels, coordinate)) = qd;
  *row_channel(f, node, ambulo__channel_qdd(&f->context.channels, coordinate)) = qdd;
}

static void prescribed_values(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  const ambulo_end_value values[] = {{3, 0, 0, 0.4}, {2, 1, 1, 1.2}, {4, 2, 1, -1.0}};
  f.definition.end_values = values;
  f.definition.end_value_count = 3;
  ambulo__end_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 3);
  set(&f, 0, 3, 0.5, 0.0, 0.0);
  set(&f, 4, 2, 9.0, 1.5, 9.0);
  set(&f, 4, 4, 9.0, 9.0, 2.0);
  int row = row_find(&f, "initial_state", "hip_r", "value", 0.0);
  assert_close(row_value(&f, row), 0.1, 1e-15);
  assert_string_equal(f.table.rows[row].unit, "rad");
  row = row_find(&f, "final_state", "pelvis_tx", "rate", 1.0);
  assert_close(row_value(&f, row), 0.3, 1e-15);
  assert_string_equal(f.table.rows[row].unit, "m/s");
  assert_int_equal(f.table.rows[row].node, 4);
  row = row_find(&f, "final_state", "knee_r", "acceleration", 1.0);
  assert_close(row_value(&f, row), 3.0, 1e-15);
  assert_string_equal(f.table.rows[row].unit, "rad/s^2");
  row_fixture_close(&f);
}

static void periodic_ends(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_PERIODIC;
  f.definition.ends_order = 2;
  f.definition.travel = 1.2;
  ambulo__end_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 7 * 3);
  for (int i = 1; i < 3; i++) {
    set(&f, 0, i, 0.1, 2.0, 10.0);
    set(&f, 4, i, 1.5, 3.2, -20.0);
  }
  int tx = row_find(&f, "periodic", "pelvis_tx", "value", 1.0);
  assert_close(row_value(&f, tx), 0.2, 1e-14);
  assert_int_equal(f.table.rows[tx].node, -1);
  assert_close(row_value(&f, row_find(&f, "periodic", "pelvis_ty", "value", 1.0)), 1.4, 1e-14);
  assert_close(row_value(&f, row_find(&f, "periodic", "pelvis_ty", "rate", 1.0)), 0.1, 1e-14);
  assert_close(row_value(&f, row_find(&f, "periodic", "pelvis_ty", "acceleration", 1.0)),
               -30.0 / 144.0, 1e-14);
  row_fixture_close(&f);
}

static void mirrored_ends(void **state) {
  (void)state;
  row_fixture f;
  row_fixture_open(&f, 0);
  f.definition.ends = AMBULO_ENDS_MIRRORED;
  f.definition.travel = 0.6;
  ambulo__end_rows(&f.context, &f.table);
  assert_int_equal(f.table.row_count, 7 * 2);
  set(&f, 0, 0, 0.02, 0.0, 0.0);
  set(&f, 4, 0, -0.05, 0.0, 0.0);
  set(&f, 0, 2, 0.1, 0.0, 0.0);
  set(&f, 4, 2, 0.8, 0.0, 0.0);
  set(&f, 0, 3, 0.3, 1.2, 0.0);
  set(&f, 4, 5, 0.5, 3.6, 0.0);
  assert_close(row_value(&f, row_find(&f, "mirrored", "pelvis_tz", "value", 1.0)), -0.03, 1e-14);
  assert_close(row_value(&f, row_find(&f, "mirrored", "pelvis_tx", "value", 1.0)), 0.1, 1e-14);
  assert_close(row_value(&f, row_find(&f, "mirrored", "hip_l", "value", 1.0)), 0.2, 1e-14);
  assert_close(row_value(&f, row_find(&f, "mirrored", "hip_l", "rate", 1.0)), 0.2, 1e-14);
  row_fixture_close(&f);
}

/* Each contradiction of end values is refused by name, and sound ones are not. */

typedef struct test_end_check_fixture {
  ambulo_model *model;
  ambulo_problem_definition definition;
  ambulo_contact contact;
  ambulo_term term;
} test_end_check_fixture;

static void test_end_check_open_fixture(test_end_check_fixture *f) {
  f->model = planar_walker_create();
  assert_non_null(f->model);
  f->definition = ambulo_problem_definition_default();
  f->term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  f->contact = (ambulo_contact){.foot = 0, .mode = AMBULO_CONTACT_FLAT, .from = 0.0, .to = 1.0};
  f->definition.model = f->model;
  f->definition.terms = &f->term;
  f->definition.term_count = 1;
}

/* `phrase` NULL: accepted */
static void test_end_check_expect(test_end_check_fixture *f, const char *phrase) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_create(&f->definition, NULL, list, &problem);
  if (phrase) {
    assert_int_equal(status, AMBULO_E_PROBLEM);
    assert_message(list, 0, phrase);
  } else {
    if (status) assert_message(list, 0, "nothing");
    assert_int_equal(status, AMBULO_OK);
  }
  ambulo_problem_free(problem);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f->model);
}

static void one_value_an_end(void **state) {
  (void)state;
  test_end_check_fixture f;
  const ambulo_end_value twice[2] = {{4, 0, 1, 0.2}, {4, 0, 1, 0.3}};
  test_end_check_open_fixture(&f);
  f.definition.end_values = twice;
  f.definition.end_value_count = 2;
  test_end_check_expect(&f,
                        "the final value of knee_angle_r is prescribed twice: 0.2 rad and 0.3 rad");
}

static void mirrored_values_follow(void **state) {
  (void)state;
  const ambulo_end_value ends[2] = {{4, 0, 0, 0.2}, {7, 0, 1, 0.3}};
  for (int good = 0; good < 2; good++) {
    test_end_check_fixture f;
    ambulo_end_value values[2] = {ends[0], ends[1]};
    if (good) values[1].value = 0.2;
    test_end_check_open_fixture(&f);
    f.definition.ends = AMBULO_ENDS_MIRRORED;
    f.definition.travel = 0.6;
    f.definition.end_values = values;
    f.definition.end_value_count = 2;
    test_end_check_expect(
        &f, good ? NULL
                 : "the final value of knee_angle_l is 0.3 rad, but mirrored ends with a travel "
                   "of 0.6 m make it 0.2 rad from the initial value of knee_angle_r, 0.2 rad");
  }
}

static void periodic_rates_follow(void **state) {
  (void)state;
  const ambulo_end_value values[2] = {{4, 1, 0, 1.0}, {4, 1, 1, -1.0}};
  for (int order = 0; order < 2; order++) {
    test_end_check_fixture f;
    test_end_check_open_fixture(&f);
    f.definition.ends = AMBULO_ENDS_PERIODIC;
    f.definition.ends_order = order;
    f.definition.end_values = values;
    f.definition.end_value_count = 2;
    test_end_check_expect(
        &f, order ? "the final rate of knee_angle_r is -1 rad/s, but periodic ends" : NULL);
  }
}

/* a value within its own range may be beyond what the other half of the stride allows its partner
 */
static void mirrored_values_keep_the_partners_limits(void **state) {
  (void)state;
  const ambulo_end_value value = {4, 0, 0, 0.6};
  for (int mirrored = 0; mirrored < 2; mirrored++) {
    test_end_check_fixture f;
    test_end_check_open_fixture(&f);
    f.model->coordinates[7].range[1] = 0.5;
    f.definition.joint_limits = AMBULO_LIMIT_NODES;
    f.definition.ends = mirrored ? AMBULO_ENDS_MIRRORED : AMBULO_ENDS_PERIODIC;
    f.definition.end_values = &value;
    f.definition.end_value_count = 1;
    test_end_check_expect(
        &f, mirrored ? "the initial value of knee_angle_r is 0.6 rad; expected -inf to 0.5 rad, "
                       "its limits (the upper end by the upper limit of knee_angle_l, 0.5, in "
                       "the mirrored half)"
                     : NULL);
  }
}

/* two steps of 0.6 m need a range of 1.2 m */
static void a_mirrored_stride_needs_room_for_both_steps(void **state) {
  (void)state;
  for (int wide = 0; wide < 2; wide++) {
    test_end_check_fixture f;
    test_end_check_open_fixture(&f);
    f.model->coordinates[0].range[0] = 0.0;
    f.model->coordinates[0].range[1] = wide ? 1.2 : 1.1;
    f.definition.joint_limits = AMBULO_LIMIT_NODES;
    f.definition.ends = AMBULO_ENDS_MIRRORED;
    f.definition.travel = 0.6;
    test_end_check_expect(
        &f, wide ? NULL
                 : "pelvis_tx has to move by 0.6 m from beginning to end; its range, 0 to 0.5 m "
                   "(the upper end by the upper limit of pelvis_tx, 1.1, in the mirrored half), "
                   "is only 0.5 m wide");
  }
}

/* q = 0 in all coordinates puts the pelvis on the ground: corners far below */
static void a_prescribed_state_respects_the_ground(void **state) {
  (void)state;
  for (int lifted = 0; lifted < 2; lifted++) {
    test_end_check_fixture f;
    ambulo_end_value values[WALKER_COORDINATES];
    test_end_check_open_fixture(&f);
    for (int i = 0; i < WALKER_COORDINATES; i++) {
      ambulo_end_value value = {i, 0, 0, 0.0};
      values[i] = value;
    }
    values[1].value = lifted ? 0.9 : 0.85; /* legs of 0.41 + 0.43 m, soles 0.06 m lower */
    f.definition.ground_penetration = 1;
    f.definition.contacts = &f.contact;
    f.definition.contact_count = 1;
    f.definition.end_values = values;
    f.definition.end_value_count = WALKER_COORDINATES;
    test_end_check_expect(
        &f, lifted ? NULL
                   : "the initial state puts right_heel (foot 'right') 0.05 m below the ground "
                     "at t = 0 s, where the schedule has it in contact");
  }
}

/* one coordinate left open: nothing can be said before solving */
static void an_open_chain_is_left_to_the_solver(void **state) {
  (void)state;
  test_end_check_fixture f;
  const ambulo_end_value value = {1, 0, 0, 3.0};
  test_end_check_open_fixture(&f);
  f.definition.ground_penetration = 1;
  f.definition.contacts = &f.contact;
  f.definition.contact_count = 1;
  f.definition.end_values = &value;
  f.definition.end_value_count = 1;
  test_end_check_expect(&f, NULL);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(prescribed_values),
                                     cmocka_unit_test(periodic_ends),
                                     cmocka_unit_test(mirrored_ends),
                                     cmocka_unit_test(one_value_an_end),
                                     cmocka_unit_test(mirrored_values_follow),
                                     cmocka_unit_test(periodic_rates_follow),
                                     cmocka_unit_test(mirrored_values_keep_the_partners_limits),
                                     cmocka_unit_test(a_mirrored_stride_needs_room_for_both_steps),
                                     cmocka_unit_test(a_prescribed_state_respects_the_ground),
                                     cmocka_unit_test(an_open_chain_is_left_to_the_solver)};
  return cmocka_run_group_tests_name("contact/ends", tests, NULL, NULL);
}
