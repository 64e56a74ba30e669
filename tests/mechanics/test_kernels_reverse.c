/* Vector-Jacobian products of every kernel set, on random trees: against complex steps of the
 * reference, against central differences of the kernel itself, and against the scalar twin. */
#include "mechanics/kernel_fixture.h"

static const char *const group_names[] = {"gradient by q", "gradient by qd", "gradient by qdd"};

static void check_lane(kernel_case *c, const char *isa, const double *gradient, int lane,
                       const double *jacobian) {
  double want[max_d];
  int where = 0;
  for (int group = 0; group < 3; group++) {
    for (int k = 0; k < c->d; k++) {
      want[k] = 0;
      for (int row = 0; row < c->rows; row++) {
        want[k] +=
            c->weights[row * AMBULO__LANES + lane] * jacobian[(group * c->rows + row) * c->d + k];
      }
    }
    double error = difference(gradient + group * c->d * AMBULO__LANES + lane, AMBULO__LANES, want,
                              c->d, &where);
    report_difference(c, isa, group_names[group], where, error, 1e-9);
  }
}

static void equals_complex_steps_of_the_reference(void **state) {
  (void)state;
  static kernel_case c;
  for (int number = 0; number < case_count; number++) {
    case_open(&c, number);
    double *gradient = lane_array((size_t)(3 * c.d)), state_of[3 * max_d];
    double *jacobian = lane_array((size_t)(3 * c.rows * c.d));
    int lane = number % AMBULO__LANES; /* the others: instruction_sets_agree */
    case_state(&c, lane, state_of);
    case_jacobian(&c, state_of, jacobian);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      case_reverse(&c, kernels, gradient);
      check_lane(&c, isa_names[i], gradient, lane, jacobian);
    }
    free(jacobian);
    free(gradient);
    case_close(&c);
  }
}

static void instruction_sets_agree(void **state) {
  (void)state;
  static kernel_case c;
  for (int number = 0; number < case_count; number++) {
    case_open(&c, number);
    int n = 3 * c.d * AMBULO__LANES, where = 0;
    double *want = lane_array((size_t)(3 * c.d)), *got = lane_array((size_t)(3 * c.d));
    case_reverse(&c, ambulo__kernels_by_name("scalar"), want);
    for (int i = 1; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      case_reverse(&c, kernels, got);
      double error = difference(got, 1, want, n, &where);
      report_difference(&c, isa_names[i], "gradient against the scalar twin", where, error, 1e-12);
    }
    free(want);
    free(got);
    case_close(&c);
  }
}

/* weights differ from call to call, the motion does not */
static void one_forward_serves_many_sweeps(void **state) {
  (void)state;
  static kernel_case c;
  for (int number = 0; number < case_count; number += 4) {
    case_open(&c, number);
    int n = c.d * AMBULO__LANES, where = 0;
    double *first = lane_array((size_t)(3 * c.d)), *again = lane_array((size_t)(3 * c.d));
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      case_reverse(&c, kernels, first);
      kernels->reverse(c.plan, c.qd, c.qdd, NULL, c.weights, again, again + n, again + 2 * n,
                       c.scratch);
      double error = difference(again, 1, first, 3 * n, &where);
      report_difference(&c, isa_names[i], "second sweep against the first", where, error, 1e-300);
    }
    free(first);
    free(again);
    case_close(&c);
  }
}

static double weighted_sum(kernel_case *c, const ambulo__kernels *kernels, int lane) {
  double sum = 0;
  case_forward(c, kernels);
  for (int row = 0; row < c->rows; row++) {
    sum += c->weights[row * AMBULO__LANES + lane] * c->out[row * AMBULO__LANES + lane];
  }
  return sum;
}

/* A route that shares nothing with the reference. */
static void equals_central_differences(void **state) {
  (void)state;
  static kernel_case c;
  const ambulo__kernels *kernels = ambulo__kernels_select();
  for (int number = 2; number < case_count; number += 25) {
    case_open(&c, number);
    double *gradient = lane_array((size_t)(3 * c.d)), want[3 * max_d];
    double *const inputs[] = {c.q, c.qd, c.qdd};
    int where = 0;
    case_reverse(&c, kernels, gradient);
    for (int k = 0; k < 3 * c.d; k++) {
      const double step = 1e-5;
      double *x = inputs[k / c.d] + k % c.d * AMBULO__LANES, middle = *x;
      *x = middle + step;
      double above = weighted_sum(&c, kernels, 0);
      *x = middle - step;
      want[k] = (above - weighted_sum(&c, kernels, 0)) / (2 * step);
      *x = middle;
    }
    double error = difference(gradient, AMBULO__LANES, want, 3 * c.d, &where);
    report_difference(&c, kernels->name, "gradient against central differences", where, error,
                      1e-6);
    free(gradient);
    case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(equals_complex_steps_of_the_reference),
                                     cmocka_unit_test(instruction_sets_agree),
                                     cmocka_unit_test(one_forward_serves_many_sweeps),
                                     cmocka_unit_test(equals_central_differences)};
  return cmocka_run_group_tests_name("mechanics/kernels reverse", tests, NULL, NULL);
}
