/* Jacobians of every kernel set, on random trees: against complex steps of the reference and
 * central differences of the kernel, and that the pattern leaves nothing out. */
#include "mechanics/kernel_fixture.h"

static const char *const group_names[] = {"Jacobian by q", "Jacobian by qd", "Jacobian by qdd"};

/* Entries in pattern order: by q, by qd, by qdd. */
static double *jacobian_entries(kernel_case *c, const ambulo__kernels *kernels) {
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(c->plan);
  double *entries = zero_lane_array((size_t)(pattern.count + 2 * pattern.dynamic_count));
  double *jqd = entries + pattern.count * AMBULO__LANES;
  kernels->jacobian(c->plan, c->q, c->qd, c->qdd, NULL, entries, jqd,
                    jqd + pattern.dynamic_count * AMBULO__LANES, c->scratch);
  return entries;
}

/* Dense [3][rows][d] of one lane. */
static double *dense_jacobian(const kernel_case *c, const double *entries, int lane) {
  double *dense = lane_array((size_t)(3 * c->rows * c->d));
  for (int order = 0; order < 3; order++) {
    case_dense(c, entries, order, lane, dense + order * c->rows * c->d);
  }
  return dense;
}

static void check_lane(const kernel_case *c, const char *isa, const double *entries, int lane,
                       const double *want) {
  double *got = dense_jacobian(c, entries, lane);
  int where = 0, dynamic = (c->d + 6) * c->d, points = (c->rows - c->d - 6) * c->d;
  for (int group = 0; group < 3; group++) {
    int at = group * c->rows * c->d;
    double error = difference(got + at, 1, want + at, dynamic, &where);
    report_difference(c, isa, group_names[group], where, error, 1e-9);
    error = difference(got + at + dynamic, 1, want + at + dynamic, points, &where);
    report_difference(c, isa, "Jacobian of the points", where, error, 1e-9);
  }
  free(got);
}

static void equals_complex_steps_of_the_reference(void **state) {
  (void)state;
  static kernel_case c;
  for (int number = 0; number < case_count; number++) {
    case_open(&c, number);
    double state_of[3 * max_d], *want = lane_array((size_t)(3 * c.rows * c.d));
    int lane = number % AMBULO__LANES; /* the others: instruction_sets_agree */
    case_state(&c, lane, state_of);
    case_jacobian(&c, state_of, want);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      double *entries = jacobian_entries(&c, kernels);
      check_lane(&c, isa_names[i], entries, lane, want);
      free(entries);
    }
    free(want);
    case_close(&c);
  }
}

static void instruction_sets_agree(void **state) {
  (void)state;
  static kernel_case c;
  for (int number = 0; number < case_count; number++) {
    case_open(&c, number);
    ambulo__plan_pattern pattern = ambulo__plan_get_pattern(c.plan);
    int n = (pattern.count + 2 * pattern.dynamic_count) * AMBULO__LANES, where = 0;
    double *want = jacobian_entries(&c, ambulo__kernels_by_name("scalar"));
    for (int i = 1; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      double *got = jacobian_entries(&c, kernels);
      double error = difference(got, 1, want, n, &where);
      report_difference(&c, isa_names[i], "Jacobian against the scalar twin", where, error, 1e-12);
      free(got);
    }
    free(want);
    case_close(&c);
  }
}

static void equals_central_differences(void **state) {
  (void)state;
  static kernel_case c;
  const ambulo__kernels *kernels = ambulo__kernels_select();
  for (int number = 2; number < case_count; number += 25) {
    case_open(&c, number);
    double *entries = jacobian_entries(&c, kernels), *got = dense_jacobian(&c, entries, 3);
    double *const inputs[] = {c.q, c.qd, c.qdd};
    int where = 0;
    for (int k = 0; k < 3 * c.d; k++) {
      const double step = 1e-5;
      double *x = inputs[k / c.d] + k % c.d * AMBULO__LANES + 3, middle = *x;
      double above[max_rows], want[max_rows];
      *x = middle + step;
      case_forward(&c, kernels);
      for (int row = 0; row < c.rows; row++) above[row] = c.out[row * AMBULO__LANES + 3];
      *x = middle - step;
      case_forward(&c, kernels);
      *x = middle;
      for (int row = 0; row < c.rows; row++) {
        want[row] = (above[row] - c.out[row * AMBULO__LANES + 3]) / (2 * step);
      }
      const double *column = got + k / c.d * c.rows * c.d + k % c.d;
      double error = difference(column, c.d, want, c.rows, &where);
      report_difference(&c, kernels->name, group_names[k / c.d], where, error, 1e-5);
    }
    free(entries);
    free(got);
    case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equals_complex_steps_of_the_reference),
                                     cmocka_unit_test(instruction_sets_agree),
                                     cmocka_unit_test(equals_central_differences)};
  return cmocka_run_group_tests_name("mechanics/kernels jacobian", tests, NULL, NULL);
}
