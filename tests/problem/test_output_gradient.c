/* Gradients of the mechanics' outputs, put together from the stored Jacobians, are those of the
 * reverse sweep with a weight on one output. */
#include <stdlib.h>

#include "problem/nlp.h"
#include "support/engine_fixture.h"
#include "support/fail_alloc.h"

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
  check_problem("two_link_reach", 0);
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
  const struct CMUnitTest tests[] = {cmocka_unit_test(outputs_in_the_air),
                                     cmocka_unit_test(outputs_on_the_ground),
                                     cmocka_unit_test(any_allocation_of_a_workspace_may_fail)};
  return cmocka_run_group_tests_name("nlp/output_gradient", tests, NULL, NULL);
}
