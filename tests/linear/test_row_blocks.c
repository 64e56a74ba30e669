/* Products by the motion of nodes are those by gradients: of all kinds of rows, scaled or not, with
 * and without kernels of wide instruction sets. */
#include "support/engine_fixture.h"
#include "support/problem_fixture.h"

static void compare(const ambulo__sparse_rows *rows, const double *d, int want_blocks) {
  size_t m = (size_t)rows->count;
  double *got = calloc(m, sizeof *got), *want = calloc(m, sizeof *want), largest = 0.0;
  ambulo__sparse_rows plain = *rows;
  int in_blocks = 0;
  for (int i = 0; i < rows->count; i++) (void)ambulo__sparse_rows_gradient(rows, i);
  plain.blocks = NULL;
  assert_non_null(rows->blocks);
  for (size_t i = 0; i < m; i++) {
    got[i] = (double)NAN;
    in_blocks += ambulo__row_blocks_have(rows->blocks, (int)i);
  }
  ambulo__sparse_rows_multiply(rows, d, got);
  ambulo__sparse_rows_multiply(&plain, d, want);
  for (size_t i = 0; i < m; i++) largest = fmax(largest, fabs(want[i]));
  for (size_t i = 0; i < m; i++) assert_close(got[i] / largest, want[i] / largest, 1e-13);
  assert_int_equal(in_blocks > 0, want_blocks);
  free(got);
  free(want);
}

static void check_products(const char *name, const char *override, int want_blocks) {
  engine_fixture f;
  unsigned seed = 3;
  engine_open_with(&f, name, override);
  ambulo__sparse_rows *rows = &f.engine->linearized.rows.inequality;
  double *d = calloc((size_t)f.n, sizeof *d);
  const ambulo__band_kernels *kernels = rows->blocks->kernels;
  for (int j = 0; j < f.n; j++) f.x[j] = 0.05 * random_number(&seed);
  for (int j = 0; j < f.n; j++) d[j] = random_number(&seed);
  assert_int_equal(ambulo__evaluate_jacobian(f.engine->workspace, f.x), AMBULO_OK);
  assert_int_equal(ambulo__sparse_rows_fill(rows, f.engine->workspace, 0), AMBULO_OK);
  for (int scaled = 0; scaled < 2; scaled++) {
    for (int i = 0; i < rows->count && scaled; i++)
      ambulo__sparse_rows_set_scale(rows, i, -0.1 - 0.01 * (i % 7));
    rows->blocks->kernels = &ambulo__band_kernels_baseline;
    compare(rows, d, want_blocks);
    rows->blocks->kernels = kernels;
    compare(rows, d, want_blocks);
  }
  free(d);
  engine_close(&f);
}

static void products_are_those_of_the_gradients(void **state) {
  (void)state;
  check_products("yardstick_12", NULL, 1);
  check_products("yardstick_12", "trajectory={basis: hermite}", 1);
  check_products("yardstick_12", "constraints.joint_limits=control_points", 1); /* on no node */
  check_products("support/walk_rigid", "constraints.torque_limits=true", 1);
  check_products("support/walk_without_reaction", NULL, 1);
  check_products("walk", "constraints.torque_limits=true", 1);
  check_products("walk_whole_body_37", NULL, 1); /* collisions */
  check_products("step_over", NULL, 1);
  check_products("pendulum_swing", NULL, 1);
  check_products("fig5a_feasible", "constraints.joint_limits=nodes", 1);
}

/* which add to torques what depends on rates, to the ground's forces what is carried */
static void devices_and_hands_too(void **state) {
  (void)state;
  check_products("walk_ankle_exoskeleton", "constraints.torque_limits=true", 1);
  check_products("walk_exotendon", "constraints.torque_limits=true", 1);
  check_products("walk_carrying", "constraints.torque_limits=true", 1);
  check_products("push_wall", NULL, 1);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(products_are_those_of_the_gradients),
                                     cmocka_unit_test(devices_and_hands_too)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
