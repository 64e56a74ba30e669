/* Outputs of every kernel set against the reference recursion, on random trees. */
#include "mechanics/kernel_fixture.h"

static void check_lane(kernel_case *c, const char *isa, int lane) {
  double state[3 * max_d], want[max_rows];
  int where = 0, dynamic = c->d + 6;
  case_state(c, lane, state);
  case_reference(c, state, want);
  double error = difference(c->out + lane, AMBULO__LANES, want, dynamic, &where);
  report_difference(c, isa, "generalized forces, then root wrench", where, error, 1e-10);
  error = difference(c->out + dynamic * AMBULO__LANES + lane, AMBULO__LANES, want + dynamic,
                     c->rows - dynamic, &where);
  report_difference(c, isa, "point positions", where, error, 1e-10);
}

static void equals_the_reference(void **state) {
  (void)state;
  static kernel_case c;
  int sets = 0;
  for (int i = 0; i < isa_count; i++) {
    const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
    if (!kernels) continue;
    sets++;
    for (int number = 0; number < case_count; number++) {
      case_open(&c, number);
      case_forward(&c, kernels);
      for (int lane = 0; lane < AMBULO__LANES; lane++) check_lane(&c, isa_names[i], lane);
      case_close(&c);
    }
  }
  assert_true(sets >= 2);
}

/* What one set computes equals what the scalar twin computes. */
static void instruction_sets_agree(void **state) {
  (void)state;
  static kernel_case c;
  const ambulo__kernels *one_lane = ambulo__kernels_by_name("scalar");
  assert_non_null(one_lane);
  for (int number = 0; number < case_count; number++) {
    case_open(&c, number);
    int n = c.rows * AMBULO__LANES, where = 0;
    double *want = lane_array((size_t)c.rows);
    case_forward(&c, one_lane);
    memcpy(want, c.out, (size_t)n * sizeof *want);
    for (int i = 1; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      case_forward(&c, kernels);
      double error = difference(c.out, 1, want, n, &where);
      report_difference(&c, isa_names[i], "outputs against the scalar twin", where, error, 1e-12);
    }
    free(want);
    case_close(&c);
  }
}

/* The same lane gives the same bits, whatever stands in its neighbours. */
static void lanes_are_independent(void **state) {
  (void)state;
  static kernel_case c;
  for (int i = 0; i < isa_count; i++) {
    const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
    if (!kernels) continue;
    case_open(&c, 37);
    double first[max_rows];
    case_forward(&c, kernels);
    for (int row = 0; row < c.rows; row++) first[row] = c.out[row * AMBULO__LANES];
    for (int k = 0; k < c.d; k++) {
      for (int lane = 1; lane < AMBULO__LANES; lane++) c.q[k * AMBULO__LANES + lane] = NAN;
    }
    case_forward(&c, kernels);
    for (int row = 0; row < c.rows; row++) {
      assert_close(c.out[row * AMBULO__LANES], first[row], 1e-12);
    }
    assert_true(isnan(c.out[1]) || c.d == 0);
    case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_reference),
                                     cmocka_unit_test(instruction_sets_agree),
                                     cmocka_unit_test(lanes_are_independent)};
  return cmocka_run_group_tests_name("mechanics/kernels forward", tests, NULL, NULL);
}
