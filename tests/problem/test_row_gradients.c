/* Local rows depend on the unknowns of their node alone; Gauss-Newton is a sum of outer products.
 */
#include "problem/nlp.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"
#include "support/gauss_newton.h"
#include "support/problem_fixture.h"

#include <stdlib.h>

static void local_rows_stay_on_their_node(void **state) {
  (void)state;
  fixture f = {.model = arm_create()};
  ambulo_problem_definition definition = arm_definition(f.model);
  fixture_open(&f, &definition);
  for (int r = 0; r < f.m; r++) {
    if (!ambulo__row_is_local(f.problem, r)) continue;
    int node = f.problem->table.rows[r].node;
    int first = ambulo__node_first(f.problem, node), width = ambulo__node_width(f.problem, node);
    assert_int_equal(ambulo_problem_row_gradient(f.problem, f.workspace, f.x, r, f.gradient), 0);
    double inside = 0.0;
    for (int j = 0; j < f.n; j++) {
      if (j < first || j >= first + width) assert_close(f.gradient[j], 0.0, 0.0);
      inside = fmax(inside, fabs(f.gradient[j]));
    }
    assert_true(inside > 0.0);
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

/* Gradients of the mechanics' outputs, put together from the stored Jacobians, are those of the
 * reverse sweep with a weight on one output. */

typedef struct block_sweep {
  const ambulo_workspace *workspace;
  int block, outputs;
  double *out, *weights, *gradient; /* lanes */
} block_sweep;

static double *lanes(int entries) {
  double *values = aligned_alloc(64, (size_t)entries * AMBULO__LANES * sizeof *values);
  assert_non_null(values);
  memset(values, 0, (size_t)entries * AMBULO__LANES * sizeof *values);
  return values;
}

static void sweep(const block_sweep *s, int output) {
  const ambulo_workspace *w = s->workspace;
  const ambulo_problem *p = w->problem;
  const double *ground = ambulo__ground_block(p, p->ground, s->block);
  size_t d8 = (size_t)p->coordinates * AMBULO__LANES;
  const double *q = w->channel + (size_t)s->block * (size_t)w->channel_count * AMBULO__LANES;
  memset(s->weights, 0, (size_t)s->outputs * AMBULO__LANES * sizeof *s->weights);
  for (int lane = 0; lane < AMBULO__LANES; lane++) s->weights[output * AMBULO__LANES + lane] = 1;
  p->kernels->forward(p->plan, q, q + d8, q + 2 * d8, ground, s->out, w->scratch);
  p->kernels->reverse(p->plan, q + d8, q + 2 * d8, ground, s->weights, s->gradient,
                      s->gradient + d8, s->gradient + 2 * d8, w->scratch);
}

/* Relative to the largest entry. */
static void compare(const block_sweep *s, int output) {
  const ambulo_problem *p = s->workspace->problem;
  int n = 3 * p->coordinates;
  double *got = calloc((size_t)n, sizeof *got), largest = 1e-3;
  assert_non_null(got);
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    int node = s->block * AMBULO__LANES + lane;
    if (node >= p->nodes) break;
    ambulo__output_gradient(s->workspace, node, output, got);
    for (int i = 0; i < n; i++) largest = fmax(largest, fabs(got[i]));
    for (int i = 0; i < n; i++) {
      assert_close(got[i] / largest, s->gradient[i * AMBULO__LANES + lane] / largest, 1e-10);
    }
  }
  free(got);
}

static void check_problem(const char *name, int grounded) {
  ambulo_problem *p = load_problem(name);
  ambulo_workspace *w = NULL;
  unsigned seed = 11;
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  assert_int_equal(ambulo__plan_contacts(p->plan) > 0, grounded);
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_non_null(x);
  for (int j = 0; j < p->variables; j++) x[j] = 0.1 * random_number(&seed);
  assert_int_equal(ambulo__evaluate_jacobian(w, x), AMBULO_OK);
  int outputs = ambulo__plan_rows(p->plan);
  block_sweep s = {w, 0, outputs, lanes(outputs), lanes(outputs), lanes(3 * p->coordinates)};
  for (s.block = 0; s.block < p->blocks; s.block++) {
    for (int output = 0; output < outputs; output++) {
      sweep(&s, output);
      compare(&s, output);
    }
  }
  double *const arrays[] = {s.out, s.weights, s.gradient, x};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
  ambulo_workspace_free(w);
  ambulo_problem_free(p);
}

static void outputs_in_the_air(void **state) {
  (void)state;
  check_problem("yardstick_12", 0);
  check_problem("support/two_link_reach", 0);
}

static void outputs_on_the_ground(void **state) {
  (void)state;
  check_problem("support/walk_rigid", 1);
  check_problem("walk_uphill", 1);
}

/* with the gradients of the root wrench, which only ground reaction needs */
static void any_allocation_of_a_workspace_may_fail(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  int completed = 0;
  for (long k = 0; k < 100 && !completed; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_workspace *w = NULL;
    ambulo_status status = ambulo_workspace_create(p, &allocator, &w);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_workspace_free(w);
    assert_int_equal(memory.live, 0);
    completed = !memory.failed;
  }
  assert_true(completed);
  ambulo_problem_free(p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(local_rows_stay_on_their_node),
      cmocka_unit_test(gauss_newton_form_is_the_sum_of_squared_torque_slopes),
      cmocka_unit_test(outputs_in_the_air), cmocka_unit_test(outputs_on_the_ground),
      cmocka_unit_test(any_allocation_of_a_workspace_may_fail)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
