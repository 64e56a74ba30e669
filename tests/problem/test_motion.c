/* The motion at free times: the nodes agree with the evaluation, derivatives with each other. */
#include "support/problem_fixture.h"
#include "problem/nlp.h"

static void nodes_agree_with_the_evaluation(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  int nodes = ambulo_problem_node_count(f.problem);
  double q[22], tau[22], points[66];
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q, .tau = tau, .points = points};
  assert_int_equal(
      ambulo_problem_motion(f.problem, f.workspace, f.x, nodes, f.problem->times, &motion),
      AMBULO_OK);
  assert_int_equal(ambulo_problem_evaluate(f.problem, f.workspace, f.x, NULL, NULL, f.rows), 0);
  for (int r = 0; r < f.m; r++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(f.problem, r, &row), AMBULO_OK);
    int i = strcmp(row.subject, "elbow") == 0, lower = strcmp(row.detail, "lower") == 0;
    if (!lower) continue;
    if (strcmp(row.family, "joint_limit") == 0)
      assert_close(f.rows[r], q[2 * row.node + i] + 2.0, 1e-13);
    if (strcmp(row.family, "torque_limit") == 0)
      assert_close(f.rows[r], tau[2 * row.node + i] + 30.0, 1e-12);
  }
  /* the hand is where plane trigonometry puts it */
  for (int k = 0; k < nodes; k++) {
    double a = q[2 * k], b = a + q[2 * k + 1];
    assert_close(points[6 * k], 0.3 * cos(a) + 0.25 * cos(b), 1e-13);
    assert_close(points[6 * k + 1], 0.3 * sin(a) + 0.25 * sin(b), 1e-13);
  }
  fixture_close(&f);
}

static void rates_are_the_derivatives_of_the_motion(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  double h = 1e-5, times[3] = {0.437 - h, 0.437, 0.437 + h};
  double q[6], qd[6], qdd[6];
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .q = q, .qd = qd, .qdd = qdd};
  assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 3, times, &motion),
                   AMBULO_OK);
  for (int i = 0; i < 2; i++) {
    assert_close((q[4 + i] - q[i]) / (2 * h), qd[2 + i], 1e-7);
    assert_close((qd[4 + i] - qd[i]) / (2 * h), qdd[2 + i], 1e-7);
  }
  fixture_close(&f);
}

static void zmp_lies_on_the_ground_plane(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  definition.ground_height = -0.4;
  fixture_open(&f, &definition);
  memset(f.x, 0, (size_t)f.n * sizeof *f.x);
  double time = 0.5, zmp[3];
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .zmp = zmp};
  assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 1, &time, &motion), 0);
  /* at rest the ZMP is the projection of the centre of mass, on the plane y = h */
  double com = (2.0 * 0.14 + 1.5 * 0.43) / 3.5;
  assert_close(zmp[0], com, 1e-12);
  assert_close(zmp[1], -0.4, 1e-12);
  fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(nodes_agree_with_the_evaluation),
      cmocka_unit_test(rates_are_the_derivatives_of_the_motion),
      cmocka_unit_test(zmp_lies_on_the_ground_plane),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
