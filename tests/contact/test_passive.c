/* Coordinates that nothing drives: which they are, where their equations stand, and what follows.
 */
#include "ambulo/tools/load.h"
#include "contact/row_families.h"
#include "problem/nlp.h"
#include "support/engine_fixture.h"

static int passive_rows_of(const ambulo_problem *p, const char *coordinate) {
  int count = 0;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    count += row->kind == AMBULO__KIND_PASSIVE && strcmp(row->subject, coordinate) == 0;
  }
  return count;
}

/* one equation for each coefficient of the accelerations, K + degree - 2, first and last included
 */
static void there_are_as_many_as_the_spline_holds(void **state) {
  (void)state;
  static const struct {
    const char *intervals, *nodes;
    int rows;
  } cases[] = {{"trajectory.intervals=20", "time.intervals=40", 22},
               {"trajectory.intervals=20", "time.intervals=83", 22},
               {"trajectory.intervals=20", "time.intervals=20", 21}}; /* as many as nodes */
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    const char *set[2] = {cases[i].intervals, cases[i].nodes};
    ambulo_problem *p = NULL;
    assert_int_equal(ambulo_problem_load("models/acrobot_swing.yaml", set, 2, NULL, NULL, &p),
                     AMBULO_OK);
    assert_int_equal(passive_rows_of(p, "bar"), cases[i].rows);
    assert_int_equal(passive_rows_of(p, "hip"), 0);
    ambulo_problem_free(p);
  }
}

/* the root of a body that touches the ground is carried by that */
static void roots_on_the_ground_are_not_passive(void **state) {
  (void)state;
  static const char *const walks[] = {"walk", "walk_without_reaction", "walker_2d_step"};
  for (size_t i = 0; i < sizeof walks / sizeof *walks; i++) {
    ambulo_problem *p = load_problem(walks[i]);
    for (int c = 0; c < p->coordinates; c++) assert_false(ambulo__is_passive(&p->definition, c));
    ambulo_problem_free(p);
  }
}

/* a device may be alone at a joint that has muscles otherwise */
static void a_device_may_be_alone(void **state) {
  (void)state;
  static const char *const set[] = {
      "devices=[{name: foot, kind: spring, coordinate: ankle_angle_r, stiffness: 300, rest: 0, "
      "alone: true, mirror: true}]"};
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load("models/walk.yaml", set, 1, NULL, NULL, &p), AMBULO_OK);
  int right = ambulo_model_find_coordinate(p->model, "ankle_angle_r");
  int left = ambulo_model_find_coordinate(p->model, "ankle_angle_l");
  int knee = ambulo_model_find_coordinate(p->model, "knee_angle_r");
  assert_true(ambulo__is_passive(&p->definition, right));
  assert_true(ambulo__is_passive(&p->definition, left));
  assert_false(ambulo__is_passive(&p->definition, knee));
  assert_true(passive_rows_of(p, "ankle_angle_r") >= 14);
  ambulo_problem_free(p);
}

/* Nothing drives the bar, so that the hip's work is all that the energy rises by: from hanging to
 * upright at rest or faster, at least the rise of both centres of mass. */
static void an_acrobat_swings_up(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("acrobot_swing");
  ambulo_result *result = NULL;
  ambulo_workspace *w = NULL;
  assert_int_equal(ambulo_solve(p, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  assert_int_equal(ambulo_result_dense_audit(result)->failing, 0);
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(w, ambulo_result_x(result)), AMBULO_OK);
  double work = 0.0;
  const int hip = ambulo_model_find_coordinate(p->model, "hip");
  for (int k = 0; k < p->nodes; k++) {
    const double *y = w->channel + ambulo__lane_index(k, w->channel_count, 0);
    work += p->quadrature[k] * y[ambulo__channel_tau(&p->channels, hip) * AMBULO__LANES] *
            y[ambulo__channel_qd(&p->channels, hip) * AMBULO__LANES];
  }
  const double rise = 9.81 * (40.0 * 1.0 + 30.0 * 2.0); /* J, the hip bent or not */
  const double *end = w->channel + ambulo__lane_index(p->nodes - 1, w->channel_count, 0);
  double a = end[0], b = end[AMBULO__LANES], u = end[2 * AMBULO__LANES], v = end[3 * AMBULO__LANES];
  /* 40 kg at 0.5 m, 3 kg m^2; 30 kg at 1 m and 0.4 m beyond the hip, 2 kg m^2 */
  double height = -40.0 * 0.5 * cos(a) - 30.0 * (cos(a) + 0.4 * cos(a + b));
  double kinetic = 0.5 * (3.0 + 40.0 * 0.25) * u * u + 0.5 * 2.0 * (u + v) * (u + v) +
                   15.0 * (u * u + 0.16 * (u + v) * (u + v) + 0.8 * u * (u + v) * cos(b));
  double gained = 9.81 * (height + 40.0 * 0.5 + 30.0 * 1.4) + kinetic;
  assert_true(gained > 0.9 * rise);
  if (fabs(work / gained - 1.0) > 2e-3) print_error("work %g J, energy %g J\n", work, gained);
  assert_true(fabs(work / gained - 1.0) <= 2e-3);
  ambulo_workspace_free(w);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

/* on as many knots as nodes the spline swings between them, which the look there finds */
static void what_is_left_between_nodes_is_seen(void **state) {
  (void)state;
  static const char *const set[] = {"trajectory.intervals=160", "time.intervals=160"};
  ambulo_problem *p = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_load("models/acrobot_swing.yaml", set, 2, NULL, NULL, &p),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(p, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  assert_string_equal(dense->families[0].violation.family, "passive");
  assert_string_equal(dense->families[0].violation.subject, "bar");
  assert_close(dense->families[0].tolerance, 0.01 * 70.0 * 9.81, 1e-9);
  assert_true(dense->families[0].violation.worst > 100.0);
  ambulo_result_free(result);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(there_are_as_many_as_the_spline_holds),
                                     cmocka_unit_test(roots_on_the_ground_are_not_passive),
                                     cmocka_unit_test(a_device_may_be_alone),
                                     cmocka_unit_test(an_acrobat_swings_up),
                                     cmocka_unit_test(what_is_left_between_nodes_is_seen)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
