/* The public batches: node-major arrays of any length, NULL outputs, and failures that leave
 * everything as it was. Accuracy of the kernels themselves is tested in test_kernels_*.c. */
#include "ambulo/mechanics.h"
#include "mechanics/kernel_fixture.h"
#include "mechanics/plan.h"
#include "support/fail_alloc.h"
#include "support/test.h"

#include <stdlib.h>

enum { most_nodes = 20 };

typedef struct batch {
  kernel_case c;
  ambulo_mechanics *mechanics;
  double *q, *qd, *qdd; /* [most_nodes][d] */
} batch;

static void batch_open(batch *b, int number) {
  random_source source = {9};
  case_open(&b->c, number);
  assert_int_equal(ambulo_mechanics_create(b->c.model, NULL, &b->mechanics), AMBULO_OK);
  size_t n = (size_t)(most_nodes * b->c.d);
  b->q = lane_array(n);
  b->qd = lane_array(n);
  b->qdd = lane_array(n);
  for (size_t i = 0; i < n; i++) {
    b->q[i] = random_between(&source, -2, 2);
    b->qd[i] = random_between(&source, -2, 2);
    b->qdd[i] = random_between(&source, -5, 5);
  }
}

static void batch_close(batch *b) {
  ambulo_mechanics_free(b->mechanics);
  free(b->q);
  free(b->qd);
  free(b->qdd);
  case_close(&b->c);
}

static void node_state(const batch *b, int node, double *state) {
  size_t d = (size_t)b->c.d, at = (size_t)node * d;
  memcpy(state, b->q + at, d * sizeof *state);
  memcpy(state + d, b->qd + at, d * sizeof *state);
  memcpy(state + 2 * d, b->qdd + at, d * sizeof *state);
}

static void outputs_at_every_length(void **state) {
  (void)state;
  static const int lengths[] = {0, 1, 7, 8, 9, most_nodes};
  static batch b;
  batch_open(&b, 44);
  int d = b.c.d, p = b.c.rows - d - 6, where = 0;
  assert_true(p > 0);
  for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
    int nodes = lengths[i];
    double *tau = lane_array((size_t)((nodes + 1) * d)),
           *points = lane_array((size_t)((nodes + 1) * p));
    double wrench[6 * (most_nodes + 1)];
    tau[nodes * d] = wrench[6 * nodes] = points[nodes * p] = 7;
    assert_int_equal(
        ambulo_mechanics_inverse_dynamics(
            b.mechanics, nodes, b.q, b.qd, b.qdd,
            &(ambulo_outputs){
                .size = sizeof(ambulo_outputs), .tau = tau, .wrench = wrench, .points = points}),
        AMBULO_OK);
    for (int node = 0; node < nodes; node++) {
      double x[3 * max_d], want[max_rows];
      node_state(&b, node, x);
      case_reference(&b.c, x, want);
      assert_true(difference(tau + node * d, 1, want, d, &where) < 1e-10);
      assert_true(difference(wrench + 6 * node, 1, want + d, 6, &where) < 1e-10);
      assert_true(difference(points + node * p, 1, want + d + 6, p, &where) < 1e-10);
    }
    assert_true(tau[nodes * d] == 7 && wrench[6 * nodes] == 7 && points[nodes * p] == 7);
    assert_int_equal(ambulo_mechanics_inverse_dynamics(b.mechanics, nodes, b.q, b.qd, b.qdd, NULL),
                     AMBULO_OK);
    free(tau);
    free(points);
  }
  batch_close(&b);
}

/* Rows of tau that are rows of the root force. */
static int follower_count(const ambulo__plan *plan) {
  ambulo__row_part part[AMBULO__MOST_PARTS];
  int count = 0;
  for (int k = 0; k < ambulo__plan_coordinates(plan); k++) {
    count += ambulo__plan_parts(plan, k, part) == 1 && part[0].row != k;
  }
  return count;
}

static void check_jacobians_by_the_gradient(int number, int followers) {
  static batch b;
  batch_open(&b, number);
  assert_int_equal(follower_count(b.c.plan), followers);
  int d = b.c.d, p = b.c.rows - d - 6, nodes = 11, where = 0;
  size_t block = (size_t)(nodes * d * d), w = (size_t)(nodes * 6 * d), n = (size_t)(nodes * d);
  ambulo_jacobians j = {sizeof(ambulo_jacobians),
                        lane_array(block),
                        lane_array(block),
                        lane_array(block),
                        lane_array(w),
                        lane_array(w),
                        lane_array(w),
                        lane_array((size_t)(nodes * p * d))};
  double *y = lane_array((size_t)(nodes * b.c.rows)), *g = lane_array(3 * n);
  random_source source = {1};
  for (int i = 0; i < nodes * b.c.rows; i++) y[i] = random_between(&source, -1, 1);
  const double *yw = y + n, *yp = yw + 6 * nodes;
  assert_int_equal(ambulo_mechanics_jacobians(b.mechanics, nodes, b.q, b.qd, b.qdd, &j), AMBULO_OK);
  assert_int_equal(
      ambulo_mechanics_gradient(
          b.mechanics, nodes, b.q, b.qd, b.qdd,
          &(ambulo_output_weights){sizeof(ambulo_output_weights), y, yw, yp},
          &(ambulo_motion_gradient){sizeof(ambulo_motion_gradient), g, g + n, g + 2 * n}),
      AMBULO_OK);
  const double *const tau[] = {j.tau_q, j.tau_qd, j.tau_qdd};
  const double *const wrench[] = {j.wrench_q, j.wrench_qd, j.wrench_qdd};
  for (int k = 0; k < 3 * nodes; k++) {
    int node = k / 3, group = k % 3;
    double want[max_d];
    for (int i = 0; i < d; i++) {
      want[i] = 0;
      for (int r = 0; r < d; r++) want[i] += y[node * d + r] * tau[group][(node * d + r) * d + i];
      for (int r = 0; r < 6; r++)
        want[i] += yw[node * 6 + r] * wrench[group][(node * 6 + r) * d + i];
      for (int r = 0; r < p && group == 0; r++) {
        want[i] += yp[node * p + r] * j.points_q[(node * p + r) * d + i];
      }
    }
    assert_true(difference(g + group * (int)n + node * d, 1, want, d, &where) < 1e-10);
  }
  assert_int_equal(
      ambulo_mechanics_gradient(
          b.mechanics, nodes, b.q, b.qd, b.qdd,
          &(ambulo_output_weights){sizeof(ambulo_output_weights), NULL, NULL, NULL},
          &(ambulo_motion_gradient){sizeof(ambulo_motion_gradient), g, g + n, g + 2 * n}),
      AMBULO_OK);
  for (size_t i = 0; i < 3 * n; i++) assert_true(g[i] == 0);
  double *const owned[] = {j.tau_q,      j.tau_qd,   j.tau_qdd, j.wrench_q, j.wrench_qd,
                           j.wrench_qdd, j.points_q, y,         g};
  for (size_t i = 0; i < sizeof owned / sizeof *owned; i++) free(owned[i]);
  batch_close(&b);
}

/* With all rows, also those that the kernels do not write. */
static void jacobians_and_gradient_belong_together(void **state) {
  (void)state;
  check_jacobians_by_the_gradient(44, 0);
  check_jacobians_by_the_gradient(256, 3);
}

static void check_refused(batch *b, double *input, int at, double bad) {
  int d = b->c.d;
  double *tau = lane_array((size_t)(most_nodes * d)), *g = lane_array((size_t)(3 * most_nodes * d));
  double good = input[at];
  ambulo_jacobians j = {.size = sizeof(ambulo_jacobians), .tau_q = tau};
  input[at] = bad;
  tau[0] = g[0] = 7;
  assert_int_equal(ambulo_mechanics_inverse_dynamics(
                       b->mechanics, most_nodes, b->q, b->qd, b->qdd,
                       &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                   AMBULO_E_NUMERIC);
  assert_int_equal(ambulo_mechanics_jacobians(b->mechanics, most_nodes, b->q, b->qd, b->qdd, &j),
                   AMBULO_E_NUMERIC);
  assert_int_equal(
      ambulo_mechanics_gradient(
          b->mechanics, most_nodes, b->q, b->qd, b->qdd,
          &(ambulo_output_weights){.size = sizeof(ambulo_output_weights), .tau = b->qdd},
          &(ambulo_motion_gradient){sizeof(ambulo_motion_gradient), g, g + most_nodes * d,
                                    g + 2 * most_nodes * d}),
      AMBULO_E_NUMERIC);
  assert_true(tau[0] == 7 && g[0] == 7);
  input[at] = good;
  free(tau);
  free(g);
}

/* A bad value in the second block, or the very last: the first block must not be written either. */
static void failures_leave_outputs_untouched(void **state) {
  (void)state;
  static batch b;
  static const double bad[] = {NAN, INFINITY, -INFINITY};
  batch_open(&b, 44);
  double *const inputs[] = {b.q, b.qd, b.qdd};
  for (int i = 0; i < 9; i++) {
    check_refused(&b, inputs[i / 3], 12 * b.c.d + 1, bad[i % 3]);
    check_refused(&b, inputs[i / 3], most_nodes * b.c.d - 1, bad[i % 3]);
  }
  check_refused(&b, b.qd, 12 * b.c.d + 1, 1e200);
  batch_close(&b);
}

/* Links without angles of their own, which rounding takes off a sum with a huge one. */
static void batch_open_without_link_angles(batch *b, int number) {
  batch_open(b, number);
  for (int i = 0; i < b->c.tree.definition.link_count; i++) b->c.tree.links[i].theta = 0;
  ambulo_mechanics_free(b->mechanics);
  ambulo_model_free(b->c.model);
  b->c.model = NULL;
  assert_int_equal(ambulo_model_create(&b->c.tree.definition, NULL, NULL, &b->c.model), AMBULO_OK);
  assert_int_equal(ambulo_mechanics_create(b->c.model, NULL, &b->mechanics), AMBULO_OK);
}

/* tau, and its Jacobians, of one node of a batch. */
static void check_node(const batch *b, int node, const double *tau, const ambulo_jacobians *j) {
  int d = b->c.d, where = 0;
  double x[3 * max_d], want[max_rows];
  double *jacobian = lane_array((size_t)(3 * b->c.rows * d));
  const double *const got[] = {j->tau_q, j->tau_qd, j->tau_qdd};
  node_state(b, node, x);
  case_reference(&b->c, x, want);
  assert_true(difference(tau + node * d, 1, want, d, &where) < 1e-9);
  case_jacobian(&b->c, x, jacobian);
  for (int order = 0; order < 3; order++) {
    const double *rows = jacobian + order * b->c.rows * d;
    assert_true(difference(got[order] + node * d * d, 1, rows, d * d, &where) < 1e-9);
  }
  free(jacobian);
}

/* Too large for the kernels' own sine and cosine: one angle of one node of a block. */
static void large_angles_use_libm(void **state) {
  (void)state;
  static batch b;
  static const double sizes[] = {1.1e5, 3e7, -1e16, 2e80, 1e300};
  enum { nodes = 3, large = 1 };
  batch_open_without_link_angles(&b, 22);
  int d = b.c.d;
  double *tau = lane_array((size_t)(nodes * d)), *all = lane_array((size_t)(3 * nodes * d * d));
  ambulo_jacobians j = {.size = sizeof(ambulo_jacobians),
                        .tau_q = all,
                        .tau_qd = all + nodes * d * d,
                        .tau_qdd = all + 2 * nodes * d * d};
  for (int i = 0; i < d; i++) {
    double *angle = &b.q[large * d + i], was = *angle;
    if (ambulo_model_coordinate(b.c.model, i)->type != AMBULO_REVOLUTE) continue;
    *angle = sizes[i % (int)(sizeof sizes / sizeof *sizes)];
    assert_int_equal(ambulo_mechanics_inverse_dynamics(
                         b.mechanics, nodes, b.q, b.qd, b.qdd,
                         &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = tau}),
                     AMBULO_OK);
    assert_int_equal(ambulo_mechanics_jacobians(b.mechanics, nodes, b.q, b.qd, b.qdd, &j),
                     AMBULO_OK);
    for (int node = 0; node < nodes; node++) check_node(&b, node, tau, &j);
    *angle = was;
  }
  free(tau);
  free(all);
  batch_close(&b);
}

static void arguments_are_checked(void **state) {
  (void)state;
  static batch b;
  batch_open(&b, 3);
  double x[max_d] = {0};
  ambulo_mechanics *none = NULL;
  assert_int_equal(ambulo_mechanics_create(NULL, NULL, &none), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_mechanics_create(b.c.model, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          NULL, 1, x, x, x, &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = x}),
      AMBULO_E_ARGUMENT);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          b.mechanics, -1, x, x, x, &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = x}),
      AMBULO_E_ARGUMENT);
  assert_int_equal(
      ambulo_mechanics_inverse_dynamics(
          b.mechanics, 1, x, NULL, x, &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = x}),
      AMBULO_E_ARGUMENT);
  const ambulo_output_weights weights = {.size = sizeof(ambulo_output_weights), .tau = x};
  const ambulo_motion_gradient whole = {sizeof(ambulo_motion_gradient), x, x, x},
                               part = {sizeof(ambulo_motion_gradient), x, NULL, x};
  assert_int_equal(ambulo_mechanics_gradient(b.mechanics, 1, x, x, x, &weights, &part),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_mechanics_gradient(b.mechanics, 1, x, x, x, &weights, NULL),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_mechanics_gradient(b.mechanics, 1, x, x, x, NULL, &whole),
                   AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_mechanics_jacobians(b.mechanics, 1, x, x, x, NULL), AMBULO_E_ARGUMENT);
  ambulo_mechanics_free(NULL);
  batch_close(&b);
}

static void failed_allocations_unwind(void **state) {
  (void)state;
  static kernel_case c;
  case_open(&c, 12);
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_mechanics *mechanics = NULL;
    ambulo_status status = ambulo_mechanics_create(c.model, &allocator, &mechanics);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_true((mechanics == NULL) == (status != AMBULO_OK));
    ambulo_mechanics_free(mechanics);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 999);
  }
  case_close(&c);
}

static int test_mechanics_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(outputs_at_every_length),
                                     cmocka_unit_test(jacobians_and_gradient_belong_together),
                                     cmocka_unit_test(failures_leave_outputs_untouched),
                                     cmocka_unit_test(large_angles_use_libm),
                                     cmocka_unit_test(arguments_are_checked),
                                     cmocka_unit_test(failed_allocations_unwind)};
  return cmocka_run_group_tests_name("mechanics/mechanics", tests, NULL, NULL);
}

/* Choosing a kernel set: names, the environment's word, and nothing half-built. */

static const char *const names[] = {"avx512", "avx2", "baseline", "scalar"};

static void sets_are_complete_and_named(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const ambulo__kernels *set = ambulo__kernels_by_name(names[i]);
    if (!set) continue;
    assert_string_equal(set->name, names[i]);
    assert_true(set->outputs && set->forward && set->reverse && set->jacobian);
  }
  assert_non_null(ambulo__kernels_by_name("baseline"));
  assert_non_null(ambulo__kernels_by_name("scalar"));
  assert_null(ambulo__kernels_by_name("avx1024"));
  assert_null(ambulo__kernels_by_name(NULL));
}

static void the_fastest_is_chosen_unless_told(void **state) {
  (void)state;
  unsetenv("AMBULO_ISA");
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    const ambulo__kernels *set = ambulo__kernels_by_name(names[i]);
    if (!set) continue;
    assert_ptr_equal(ambulo__kernels_select(), set);
    break;
  }
  for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
    if (!ambulo__kernels_by_name(names[i])) continue;
    setenv("AMBULO_ISA", names[i], 1);
    assert_string_equal(ambulo__instruction_set(), names[i]);
  }
  setenv("AMBULO_ISA", "nonsense", 1);
  const char *chosen = ambulo__instruction_set();
  unsetenv("AMBULO_ISA");
  assert_string_equal(chosen, ambulo__instruction_set());
}

static int test_dispatch_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(sets_are_complete_and_named),
                                     cmocka_unit_test(the_fastest_is_chosen_unless_told)};
  return cmocka_run_group_tests_name("mechanics/dispatch", tests, NULL, NULL);
}

int main(void) {
  return test_mechanics_tests() + test_dispatch_tests();
}
