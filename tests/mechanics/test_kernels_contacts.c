/* Contacts in every kernel set, on random trees and the shipped bodies: outputs against the
 * reference, gradients and Jacobians against complex steps of it and against central differences.
 */
#include "contact_fixture.h"

static const char *const order_names[] = {"by q", "by qd", "by qdd"};
static const char *const group_names[contact_groups] = {"generalized forces, root wrench", "points",
                                                        "contacts", "centre of mass"};

static void check_outputs(contact_case *c, const char *isa, int lane) {
  double state[3 * max_d], ground[3 + 4 * reference_most_contacts], want[contact_max_rows];
  double complex rows[contact_max_rows];
  int ends[contact_groups], from = 0, where = 0;
  case_state(&c->body, lane, state);
  contact_ground_of_lane(c, lane, ground);
  contact_reference_rows(c, state, -1, 0, ground, rows);
  for (int row = 0; row < c->body.rows; row++) want[row] = creal(rows[row]);
  contact_group_ends(c, ends);
  for (int group = 0; group < contact_groups; group++) {
    double error = difference(c->body.out + from * AMBULO__LANES + lane, AMBULO__LANES, want + from,
                              ends[group] - from, &where);
    if (error > 1e-10) print_error("%s, lane %d:\n", group_names[group], lane);
    report_difference(&c->body, isa, "outputs", where, error, 1e-10);
    from = ends[group];
  }
}

static void outputs_equal_the_reference(void **state) {
  (void)state;
  static contact_case c;
  for (int number = -shipped_contact_count; number < contact_case_count; number++) {
    contact_case_open(&c, number);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      contact_forward(&c, kernels);
      for (int lane = 0; lane < AMBULO__LANES; lane++) check_outputs(&c, isa_names[i], lane);
    }
    contact_case_close(&c);
  }
}

static void check_gradient(const contact_case *c, const char *isa, const double *gradient,
                           const double *jacobian, int lane) {
  const kernel_case *b = &c->body;
  for (int order = 0; order < 3; order++) {
    double want[max_d] = {0};
    int where = 0;
    for (int row = 0; row < b->rows; row++) {
      const double *from = jacobian + (order * b->rows + row) * b->d;
      for (int k = 0; k < b->d; k++) want[k] += b->weights[row * AMBULO__LANES + lane] * from[k];
    }
    double error = difference(gradient + order * b->d * AMBULO__LANES + lane, AMBULO__LANES, want,
                              b->d, &where);
    if (error > 1e-9) print_error("lane %d:\n", lane);
    report_difference(b, isa, order_names[order], where, error, 1e-9);
  }
}

static void gradients_equal_complex_steps(void **state) {
  (void)state;
  static contact_case c;
  static double jacobian[3 * contact_max_rows * max_d];
  for (int number = -shipped_contact_count; number < contact_case_count; number++) {
    contact_case_open(&c, number);
    double *gradient = lane_array((size_t)(3 * c.body.d));
    int lane = (number + shipped_contact_count) % AMBULO__LANES;
    contact_reference_jacobian(&c, lane, jacobian);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      contact_reverse(&c, kernels, gradient);
      check_gradient(&c, isa_names[i], gradient, jacobian, lane);
    }
    free(gradient);
    contact_case_close(&c);
  }
}

static void check_jacobian(const contact_case *c, const char *isa, const double *entries,
                           const double *want, int lane) {
  static double dense[contact_max_rows * max_d];
  int d = c->body.d, ends[contact_groups];
  contact_group_ends(c, ends);
  for (int order = 0; order < 3; order++, want += c->body.rows * d) {
    case_dense(&c->body, entries, order, lane, dense);
    for (int group = 0, from = 0; group < contact_groups; from = ends[group++]) {
      int where = 0, at = from * d;
      double error = difference(dense + at, 1, want + at, (ends[group] - from) * d, &where);
      if (error > 1e-9)
        print_error("lane %d, %s %s:\n", lane, group_names[group], order_names[order]);
      report_difference(&c->body, isa, "Jacobian", where, error, 1e-9);
    }
  }
}

static void jacobians_equal_complex_steps(void **state) {
  (void)state;
  static contact_case c;
  static double jacobian[3 * contact_max_rows * max_d];
  for (int number = -shipped_contact_count; number < contact_case_count; number++) {
    int lane = (3 * (number + shipped_contact_count)) % AMBULO__LANES;
    contact_case_open(&c, number);
    contact_reference_jacobian(&c, lane, jacobian);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      double *entries = contact_entries(&c, kernels);
      check_jacobian(&c, isa_names[i], entries, jacobian, lane);
      free(entries);
    }
    contact_case_close(&c);
  }
}

/* Rows [rows][lanes] less those of the other side, over two steps. */
static void check_differences(const contact_case *c, const double *entries, int order, int k,
                              const double *ahead, const double *behind, double step) {
  static double dense[contact_max_rows * max_d];
  const kernel_case *b = &c->body;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double scale = 1;
    case_dense(b, entries, order, lane, dense);
    for (int row = 0; row < b->rows; row++) scale = fmax(scale, fabs(dense[row * b->d + k]));
    for (int row = 0; row < b->rows; row++) {
      int at = row * AMBULO__LANES + lane;
      double slope = (ahead[at] - behind[at]) / (2 * step);
      assert_close(dense[row * b->d + k] / scale, slope / scale, 1e-6);
    }
  }
}

static void jacobians_equal_central_differences(void **state) {
  (void)state;
  static contact_case c;
  const ambulo__kernels *kernels = ambulo__kernels_select();
  const double step = 1e-5;
  for (int number = -shipped_contact_count; number < 0; number++) {
    contact_case_open(&c, number);
    kernel_case *b = &c.body;
    double *entries = contact_entries(&c, kernels), *const inputs[3] = {b->q, b->qd, b->qdd};
    double *ahead = lane_array((size_t)b->rows);
    for (int i = 0; i < 3 * b->d; i++) {
      double *x = inputs[i / b->d] + i % b->d * AMBULO__LANES;
      for (int lane = 0; lane < AMBULO__LANES; lane++) x[lane] += step;
      contact_forward(&c, kernels);
      memcpy(ahead, b->out, (size_t)(b->rows * AMBULO__LANES) * sizeof *ahead);
      for (int lane = 0; lane < AMBULO__LANES; lane++) x[lane] -= 2 * step;
      contact_forward(&c, kernels);
      for (int lane = 0; lane < AMBULO__LANES; lane++) x[lane] += step;
      check_differences(&c, entries, i / b->d, i % b->d, ahead, b->out, step);
    }
    free(ahead);
    free(entries);
    contact_case_close(&c);
  }
}

static void check_same(const contact_case *c, const char *isa, const char *what, const double *got,
                       const double *want, int entries) {
  double *one = malloc((size_t)entries * sizeof *one);
  assert_non_null(one);
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    int where = 0;
    for (int e = 0; e < entries; e++) one[e] = want[e * AMBULO__LANES + lane];
    double error = difference(got + lane, AMBULO__LANES, one, entries, &where);
    report_difference(&c->body, isa, what, where, error, 1e-11);
  }
  free(one);
}

static void instruction_sets_agree(void **state) {
  (void)state;
  static contact_case c;
  const ambulo__kernels *one_lane = ambulo__kernels_by_name("scalar");
  for (int number = -shipped_contact_count; number < contact_case_count; number += 3) {
    contact_case_open(&c, number);
    ambulo__plan_pattern pattern = ambulo__plan_get_pattern(c.body.plan);
    size_t d = (size_t)c.body.d, rows = (size_t)c.body.rows;
    double *out = lane_array(rows), *gradient = lane_array(3 * d), *other = lane_array(3 * d);
    double *entries = contact_entries(&c, one_lane);
    contact_reverse(&c, one_lane, gradient);
    memcpy(out, c.body.out, rows * AMBULO__LANES * sizeof *out);
    for (int i = 1; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      double *got = contact_entries(&c, kernels);
      contact_reverse(&c, kernels, other);
      check_same(&c, isa_names[i], "outputs against the scalar twin", c.body.out, out, c.body.rows);
      check_same(&c, isa_names[i], "gradient against the scalar twin", other, gradient,
                 3 * c.body.d);
      check_same(&c, isa_names[i], "Jacobian against the scalar twin", got, entries, pattern.count);
      free(got);
    }
    double *const arrays[] = {out, gradient, other, entries};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
    contact_case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(outputs_equal_the_reference),
                                     cmocka_unit_test(gradients_equal_complex_steps),
                                     cmocka_unit_test(jacobians_equal_complex_steps),
                                     cmocka_unit_test(jacobians_equal_central_differences),
                                     cmocka_unit_test(instruction_sets_agree)};
  return cmocka_run_group_tests_name("mechanics/kernels contacts", tests, NULL, NULL);
}
