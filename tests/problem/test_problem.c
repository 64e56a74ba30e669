/* Building: what is refused and how it is said; copies; memory running out; the hash. */
#include "problem/nlp.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/planar_walker.h"
#include "support/problem_fixture.h"

static void expect_refusal(const ambulo_problem_definition *definition, const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(definition, NULL, list, &problem), AMBULO_E_PROBLEM);
  assert_null(problem);
  assert_true(ambulo_diagnostics_count(list) > 0);
  const char *message = ambulo_diagnostics_get(list, 0)->message;
  if (!strstr(message, text)) print_error("got '%s', expected '%s'\n", message, text);
  assert_non_null(strstr(message, text));
  ambulo_diagnostics_free(list);
}

static void faults_are_named(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  const ambulo_problem_definition good = arm_definition(model);
  ambulo_problem_definition d = good;
  d.duration = -1.0;
  expect_refusal(&d, "time.duration is -1 s");
  d = good;
  d.intervals = 0;
  expect_refusal(&d, "time.intervals is 0");
  d = good;
  d.spline_intervals = -3;
  expect_refusal(&d, "trajectory.intervals is -3");
  d = good;
  d.degree = 2;
  expect_refusal(&d, "trajectory.degree is 2");
  d = good;
  double breakpoints[3] = {0.0, 0.8, 0.7};
  d.spline_intervals = 2;
  d.breakpoints = breakpoints;
  expect_refusal(&d, "trajectory.breakpoints[2] is 0.7 s after 0.8 s");
  d = good;
  d.ends_order = 3;
  expect_refusal(&d, "ends.order is 3");
  d = good;
  d.rise = 0.17;
  expect_refusal(&d, "ends.rise is 0.17 with free ends; expected 0");
  d = good;
  ambulo_end_value end = {5, 0, 0, 0.0};
  d.end_values = &end;
  d.end_value_count = 1;
  expect_refusal(&d, "end value 0 names coordinate 5; the model has 2");
  d = good;
  d.travel = INFINITY;
  expect_refusal(&d, "ends.travel is inf m");
  d = good;
  d.support_margin = -0.1;
  expect_refusal(&d, "zmp_margin is -0.1 m");
  ambulo_model_free(model);
}

static void faulty_terms_are_named(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  d.terms = &term;
  term.weight = -2.0;
  expect_refusal(&d, "objective[0] (torque_squared): weight is -2");
  term.weight = 0.0;
  expect_refusal(&d, "every objective weight is 0");
  term = ambulo_term_default(AMBULO_TORQUE_ABSOLUTE);
  term.smoothing = 0.0;
  expect_refusal(&d, "objective[0] (torque_absolute): smoothing is 0");
  term = ambulo_term_default(AMBULO_TRACKING);
  expect_refusal(&d, "objective[0] (tracking): no reference motion");
  term = ambulo_term_default(AMBULO_USER_TERM);
  expect_refusal(&d, "no function");
  ambulo_model_free(model);
}

static void a_stale_definition_is_refused(void **state) {
  (void)state;
  ambulo_problem_definition zero;
  memset(&zero, 0, sizeof zero);
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_create(&zero, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_problem_create(NULL, NULL, NULL, &problem), AMBULO_E_ARGUMENT);
  assert_null(problem);
}

static void the_problem_owns_its_arrays(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  double scale[2] = {2.0, 0.5};
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  term.scale = scale;
  ambulo_problem_definition d = arm_definition(f.model);
  d.terms = &term;
  fixture_open(&f, &d);
  double before, after;
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, &before, NULL, NULL), 0);
  scale[0] = 100.0;
  term.weight = 9.0;
  f.x[0] += 1.0;
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, &after, NULL, NULL), 0);
  f.x[0] -= 1.0;
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, &after, NULL, NULL), 0);
  assert_true(before == after);
  fixture_close(&f);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  int completed = 0;
  for (long k = 0; k < 1000 && !completed; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_problem *problem = NULL;
    ambulo_workspace *workspace = NULL;
    ambulo_status status = ambulo_problem_create(&d, &allocator, NULL, &problem);
    if (!status) status = ambulo_workspace_create(problem, &allocator, &workspace);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    ambulo_problem_free(problem); /* before the workspace, as collectors of garbage may */
    ambulo_workspace_free(workspace);
    assert_int_equal(memory.live, 0);
    completed = !memory.failed;
  }
  assert_true(completed);
  ambulo_model_free(model);
}

static void the_hash_sees_every_change(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  unsigned long long hashes[7];
  double times[12];
  for (int i = 0; i < 7; i++) {
    ambulo_problem_definition changed = d;
    double scale[2] = {1.0, 1.0 + 1e-15};
    ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
    changed.terms = &term;
    if (i == 2) changed.intervals = 11;
    if (i == 3) term.scale = scale;
    if (i == 4) changed.torque_limits = 0;
    if (i >= 5) changed.grid = AMBULO_GRID_EVENTS;
    if (i == 6) changed.node_times = times;
    for (int k = 0; k <= d.intervals; k++) times[k] = (double)(k * k) / (d.intervals * d.intervals);
    ambulo_problem *problem = NULL;
    assert_int_equal(ambulo_problem_create(&changed, NULL, NULL, &problem), AMBULO_OK);
    hashes[i] = ambulo_problem_hash(problem);
    ambulo_problem_free(problem);
  }
  assert_true(hashes[0] == hashes[1]);
  for (int i = 2; i < 7; i++) assert_true(hashes[i] != hashes[0]);
  assert_true(hashes[5] != hashes[6]);
  ambulo_model_free(model);
}

/* no stiffness at all is still an interval's power */
static void the_hash_sees_tendons(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  unsigned long long hashes[4];
  double tendon[2] = {0.0, 0.0};
  for (int i = 0; i < 4; i++) {
    ambulo_term term = ambulo_term_default(AMBULO_MECHANICAL_POWER);
    ambulo_problem *problem = NULL;
    tendon[1] = i == 3 ? 40.0 : 0.0;
    term.tendon = i >= 2 ? tendon : NULL;
    d.terms = &term;
    d.term_count = 1;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
    hashes[i] = ambulo_problem_hash(problem);
    ambulo_problem_free(problem);
  }
  assert_true(hashes[0] == hashes[1] && hashes[1] != hashes[2] && hashes[2] != hashes[3]);
  ambulo_model_free(model);
}

/* where an arc has to be is in no other row: of two footholds one behind the other too */
static void the_hash_sees_where_arcs_roll(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  unsigned long long hashes[3];
  for (int i = 0; i < 2; i++) {
    model->feet[i].has_arcs = 1;
    model->feet[i].arc[0] = model->feet[i].heel_center;
    model->feet[i].arc[1] = model->feet[i].toe_center;
  }
  for (int i = 0; i < 3; i++) {
    ambulo_problem_definition d = ambulo_problem_definition_default();
    ambulo_contact contact = {0, AMBULO_CONTACT_TOE, 0.0, 1.0, .place = {i == 2 ? 0.1 : 0.0, 0.0}};
    ambulo_problem *problem = NULL;
    d.model = model;
    d.contacts = &contact;
    d.contact_count = 1;
    d.contact_tolerance = 0.002;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
    hashes[i] = ambulo_problem_hash(problem);
    ambulo_problem_free(problem);
  }
  assert_true(hashes[0] == hashes[1] && hashes[0] != hashes[2]);
  ambulo_model_free(model);
}

/* of feet that pass each other it sees the gap */
static void the_hash_sees_how_far_feet_are_apart(void **state) {
  (void)state;
  static const char *const gaps[] = {"constraints.clearance.feet=0.01",
                                     "constraints.clearance.feet=0.01",
                                     "constraints.clearance.feet=0.011"};
  unsigned long long hashes[3];
  for (int i = 0; i < 3; i++) {
    ambulo_problem *problem = NULL;
    assert_int_equal(
        ambulo_problem_load("models/walk_normal.yaml", &gaps[i], 1, NULL, NULL, &problem),
        AMBULO_OK);
    hashes[i] = ambulo_problem_hash(problem);
    ambulo_problem_free(problem);
  }
  assert_true(hashes[0] == hashes[1] && hashes[0] != hashes[2]);
}

/* a mirrored step of the planar walker whose left knee is stiffer than its right one */
static void limits_are_those_of_both_halves(void **state) {
  (void)state;
  enum { KNEE_R = 4, KNEE_L = 7 };
  ambulo_model *model = planar_walker_create();
  ambulo_problem *problem = NULL;
  ambulo_limits l;
  model->coordinates[KNEE_R].range[0] = -1.5;
  model->coordinates[KNEE_L].range[0] = -0.2;
  problem = walker_problem(model, 4);
  assert_non_null(problem);
  assert_int_equal(ambulo_problem_limits(problem, KNEE_R, AMBULO_LIMITED_POSITION, &l), AMBULO_OK);
  assert_close(l.low, -0.2, 0);
  assert_true(l.high == INFINITY);
  assert_int_equal(l.low_of, KNEE_L);
  assert_int_equal(l.high_of, KNEE_R);
  assert_int_equal(ambulo_problem_limits(problem, KNEE_L, AMBULO_LIMITED_TORQUE, &l), AMBULO_OK);
  assert_true(l.low == -INFINITY);
  assert_int_equal(l.low_of, KNEE_L);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* also when only one request fails, and when the problem would be refused for another reason */
static void a_mirrored_problem_survives_failed_allocations(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  const ambulo_end_value twice[2] = {{4, 0, 1, 0.2}, {4, 0, 1, 0.3}};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_term term = ambulo_term_default(AMBULO_TORQUE_SQUARED);
  d.model = model;
  d.terms = &term;
  d.term_count = 1;
  d.ends = AMBULO_ENDS_MIRRORED;
  d.end_values = twice;
  for (d.end_value_count = 0; d.end_value_count <= 2; d.end_value_count += 2) {
    ambulo_status verdict = d.end_value_count ? AMBULO_E_PROBLEM : AMBULO_OK;
    for (long k = 0, completed = 0; k < 1000 && !completed; k++) {
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = 1;
      ambulo_allocator allocator = fail_alloc_hook(&memory);
      ambulo_problem *problem = NULL;
      ambulo_status status = ambulo_problem_create(&d, &allocator, NULL, &problem);
      assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : verdict);
      ambulo_problem_free(problem);
      assert_int_equal(memory.live, 0);
      completed = !memory.failed;
    }
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(faults_are_named),
      cmocka_unit_test(faulty_terms_are_named),
      cmocka_unit_test(a_stale_definition_is_refused),
      cmocka_unit_test(the_problem_owns_its_arrays),
      cmocka_unit_test(every_allocation_may_fail),
      cmocka_unit_test(the_hash_sees_every_change),
      cmocka_unit_test(the_hash_sees_tendons),
      cmocka_unit_test(the_hash_sees_where_arcs_roll),
      cmocka_unit_test(the_hash_sees_how_far_feet_are_apart),
      cmocka_unit_test(limits_are_those_of_both_halves),
      cmocka_unit_test(a_mirrored_problem_survives_failed_allocations),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
