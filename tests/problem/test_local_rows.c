/* Local gradients are the dense ones, cut out; Gauss-Newton is a sum of outer products. */
#include "problem/nlp.h"
#include "support/gauss_newton.h"
#include "support/problem_fixture.h"

static void local_gradient_is_the_dense_one_cut_out(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  double local[64];
  assert_int_equal(ambulo__evaluate_jacobian(f.workspace, f.x), AMBULO_OK);
  for (int r = 0; r < f.m; r++) {
    if (!ambulo__row_is_local(f.problem, r)) continue;
    int node = f.problem->table.rows[r].node;
    int first = ambulo__node_first(f.problem, node), width = ambulo__node_width(f.problem, node);
    assert_true(width <= 64);
    ambulo__row_local_gradient(f.workspace, r, local);
    assert_int_equal(ambulo_problem_row_gradient(f.problem, f.workspace, f.x, r, f.gradient), 0);
    for (int j = 0; j < f.n; j++) {
      double want = j >= first && j < first + width ? local[j - first] : 0.0;
      assert_close(f.gradient[j], want, 1e-13);
    }
  }
  fixture_close(&f);
}

/* J = sum_k w_k |tau_k|^2, so the Gauss-Newton form along v is sum_k 2 w_k |dtau_k/dx v|^2;
 * the slopes of tau are also those of the torque-limit rows, a second route to them */
static void gauss_newton_form_is_the_sum_of_squared_torque_slopes(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  int n = f.n, nodes = ambulo_problem_node_count(f.problem);
  double *h = calloc((size_t)n * (size_t)n, sizeof *h), *v = calloc((size_t)n, sizeof *v);
  double local[64 * 64];
  assert_int_equal(ambulo__evaluate_jacobian(f.workspace, f.x), AMBULO_OK);
  for (int k = 0; k < nodes; k++) {
    int first = ambulo__node_first(f.problem, k), width = ambulo__node_width(f.problem, k);
    memset(local, 0, sizeof local);
    node_gauss_newton(f.workspace, k, local);
    for (int a = 0; a < width; a++)
      for (int b = 0; b < width; b++) h[(first + a) * n + first + b] += local[a * width + b];
  }
  arm_point(v, n, 1.0);
  double quadratic = 0.0, expected = 0.0;
  for (int a = 0; a < n; a++)
    for (int b = 0; b < n; b++) quadratic += v[a] * h[a * n + b] * v[b];
  for (int r = 0; r < f.m; r++) {
    ambulo_row row;
    assert_int_equal(ambulo_problem_row(f.problem, r, &row), AMBULO_OK);
    if (strcmp(row.family, "torque_limit") != 0 || strcmp(row.detail, "lower") != 0) continue;
    assert_int_equal(ambulo_problem_row_gradient(f.problem, f.workspace, f.x, r, f.gradient), 0);
    double slope = 0.0;
    for (int j = 0; j < n; j++) slope += f.gradient[j] * v[j];
    expected += 2.0 * f.problem->quadrature[row.node] * slope * slope;
  }
  assert_true(expected > 0.0);
  assert_close(quadratic, expected, 1e-11);
  free(h);
  free(v);
  fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(local_gradient_is_the_dense_one_cut_out),
      cmocka_unit_test(gauss_newton_form_is_the_sum_of_squared_torque_slopes),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
