/* Ground reaction in every kernel set, on random trees and the lower body: outputs against the
 * reference, gradients and Jacobians against complex steps of it, and what the split promises. */
#include "ground_fixture.h"

static const char *const order_names[] = {"by q", "by qd", "by qdd"};

static void check_outputs(ground_case *c, const char *isa, int lane) {
  double state[3 * max_d], ground[AMBULO__GROUND_ENTRIES], want[ground_max_rows];
  double complex rows[ground_max_rows];
  int ends[ground_groups], from = 0, where = 0;
  case_state(&c->body, lane, state);
  ground_of_lane(c, lane, ground);
  ground_reference(c, state, -1, 0, ground, (double *)rows);
  for (int row = 0; row < c->body.rows; row++) want[row] = creal(rows[row]);
  ground_group_ends(c, ends);
  for (int group = 0; group < ground_groups; group++) {
    double error = difference(c->body.out + from * AMBULO__LANES + lane, AMBULO__LANES, want + from,
                              ends[group] - from, &where);
    report_difference(&c->body, isa, ground_group_names[group], where, error, 1e-10);
    from = ends[group];
  }
}

static void outputs_equal_the_reference(void **state) {
  (void)state;
  static ground_case c;
  for (int number = -shipped_count; number < ground_case_count; number++) {
    ground_case_open(&c, number);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      ground_forward(&c, kernels);
      for (int lane = 0; lane < AMBULO__LANES; lane++) check_outputs(&c, isa_names[i], lane);
    }
    ground_case_close(&c);
  }
}

static void reverse(ground_case *c, const ambulo__kernels *kernels, double *gradient) {
  kernel_case *b = &c->body;
  int n = b->d * AMBULO__LANES;
  ground_forward(c, kernels);
  kernels->reverse(b->plan, b->qd, b->qdd, c->ground, b->weights, gradient, gradient + n,
                   gradient + 2 * n, b->scratch);
}

static void check_gradient(ground_case *c, const char *isa, const double *gradient,
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
    report_difference(b, isa, order_names[order], where, error, 1e-9);
  }
}

static void gradients_equal_complex_steps(void **state) {
  (void)state;
  static ground_case c;
  static double jacobian[3 * ground_max_rows * max_d];
  for (int number = -shipped_count; number < ground_case_count; number++) {
    ground_case_open(&c, number);
    double *gradient = lane_array((size_t)(3 * c.body.d));
    int lane = (number + shipped_count) % AMBULO__LANES;
    ground_reference_jacobian(&c, lane, jacobian);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      reverse(&c, kernels, gradient);
      check_gradient(&c, isa_names[i], gradient, jacobian, lane);
    }
    free(gradient);
    ground_case_close(&c);
  }
}

/* Entries in pattern order: by q, by qd, by qdd. */
static double *entries_of(ground_case *c, const ambulo__kernels *kernels) {
  kernel_case *b = &c->body;
  ambulo__plan_pattern pattern = ambulo__plan_get_pattern(b->plan);
  double *entries = zero_lane_array((size_t)(pattern.count + 2 * pattern.dynamic_count));
  double *jqd = entries + pattern.count * AMBULO__LANES;
  kernels->jacobian(b->plan, b->q, b->qd, b->qdd, c->ground, entries, jqd,
                    jqd + pattern.dynamic_count * AMBULO__LANES, b->scratch);
  return entries;
}

static void check_jacobian(const ground_case *c, const char *isa, const double *entries,
                           const double *want, int lane) {
  static double dense[ground_max_rows * max_d];
  int d = c->body.d, ends[ground_groups];
  ground_group_ends(c, ends);
  for (int order = 0; order < 3; order++, want += c->body.rows * d) {
    case_dense(&c->body, entries, order, lane, dense);
    for (int group = 0, from = 0; group < ground_groups; from = ends[group++]) {
      int where = 0, at = from * d;
      double error = difference(dense + at, 1, want + at, (ends[group] - from) * d, &where);
      if (error > 1e-9) print_error("%s %s:\n", ground_group_names[group], order_names[order]);
      report_difference(&c->body, isa, "Jacobian", where, error, 1e-9);
    }
  }
}

static void jacobians_equal_complex_steps(void **state) {
  (void)state;
  static ground_case c;
  static double jacobian[3 * ground_max_rows * max_d];
  for (int number = -shipped_count; number < ground_case_count; number++) {
    ground_case_open(&c, number);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      int lane = (number + shipped_count + 3 * i) % AMBULO__LANES;
      if (!kernels) continue;
      double *entries = entries_of(&c, kernels);
      ground_reference_jacobian(&c, lane, jacobian);
      check_jacobian(&c, isa_names[i], entries, jacobian, lane);
      free(entries);
    }
    ground_case_close(&c);
  }
}

static void check_same(const ground_case *c, const char *isa, const char *what, const double *got,
                       const double *want, int entries) {
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double one[4096];
    int where = 0;
    assert_in_range(entries, 0, 4096);
    for (int e = 0; e < entries; e++) one[e] = want[e * AMBULO__LANES + lane];
    double error = difference(got + lane, AMBULO__LANES, one, entries, &where);
    report_difference(&c->body, isa, what, where, error, 1e-12);
  }
}

static void instruction_sets_agree(void **state) {
  (void)state;
  static ground_case c;
  const ambulo__kernels *one_lane = ambulo__kernels_by_name("scalar");
  for (int number = -shipped_count; number < ground_case_count; number += 3) {
    ground_case_open(&c, number);
    ambulo__plan_pattern pattern = ambulo__plan_get_pattern(c.body.plan);
    size_t d = (size_t)c.body.d, rows = (size_t)c.body.rows;
    double *out = lane_array(rows), *gradient = lane_array(3 * d), *other = lane_array(3 * d);
    double *entries = entries_of(&c, one_lane);
    reverse(&c, one_lane, gradient);
    memcpy(out, c.body.out, rows * AMBULO__LANES * sizeof *out);
    for (int i = 1; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      double *got = entries_of(&c, kernels);
      reverse(&c, kernels, other);
      check_same(&c, isa_names[i], "outputs against the scalar twin", c.body.out, out, c.body.rows);
      check_same(&c, isa_names[i], "gradient against the scalar twin", other, gradient,
                 3 * c.body.d);
      if (pattern.count < 4096) {
        check_same(&c, isa_names[i], "Jacobian against the scalar twin", got, entries,
                   pattern.count);
      }
      free(got);
    }
    double *const arrays[] = {out, gradient, other, entries};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
    ground_case_close(&c);
  }
}

/* What the forward pass keeps: M, F, then moment and force of each foot. */
static void kept_wrench(const ground_case *c, int which, int lane, double moment[3],
                        double force[3]) {
  const double *at = c->body.scratch + c->body.plan->ground_at + 6 * which * AMBULO__LANES + lane;
  for (int i = 0; i < 3; i++) {
    moment[i] = at[i * AMBULO__LANES];
    force[i] = at[(3 + i) * AMBULO__LANES];
  }
}

/* Centre of pressure on the ground of a wrench. */
static void pressure_center(const ground_case *c, const double m[3], const double f[3],
                            double out[3]) {
  const double *n = c->body.model->up;
  double normal = n[0] * f[0] + n[1] * f[1] + n[2] * f[2];
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    out[i] = (n[u] * m[v] - n[v] * m[u] + c->height * f[i]) / normal;
  }
}

/* The feet's wrenches sum up to the root's; their centres of pressure are a_1 D and -a_0 D from
 * the zero-moment point; a foot without a share feels nothing. */
static void the_split_keeps_its_promises(void **state) {
  (void)state;
  static ground_case c;
  for (int number = -shipped_count; number < ground_case_count; number++) {
    ground_case_open(&c, number);
    ground_forward(&c, ambulo__kernels_select());
    double weight = ground_weight(&c);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      double m[3][3], f[3][3], zmp[3], center[3], share = c.ground[lane], arm = 1;
      for (int w = 0; w < 3; w++) kept_wrench(&c, w, lane, m[w], f[w]);
      pressure_center(&c, m[0], f[0], zmp);
      for (int i = 0; i < 3; i++) arm = fmax(arm, fabs(zmp[i]));
      for (int i = 0; i < 3; i++) {
        assert_close((m[1][i] + m[2][i] - m[0][i]) / (weight * arm), 0, 1e-12);
        assert_close((f[1][i] + f[2][i] - f[0][i]) / weight, 0, 1e-12);
        assert_close(f[1][i], c.body.out[(c.foot_row + i) * AMBULO__LANES + lane], 0);
        assert_close(f[2][i], c.body.out[(c.foot_row + 4 + i) * AMBULO__LANES + lane], 0);
        if (share == 0) assert_close(fabs(f[1][i]) + fabs(m[1][i]), 0, 0);
        if (share == 1) assert_close(fabs(f[2][i]) + fabs(m[2][i]), 0, 0);
      }
      for (int foot = 0; foot < 2; foot++) {
        double a = foot ? 1 - share : share, sign = foot ? -1 : 1;
        if (a < 1e-2) continue;
        pressure_center(&c, m[1 + foot], f[1 + foot], center);
        for (int i = 0; i < 3; i++) {
          double d = c.ground[(1 + i) * AMBULO__LANES + lane];
          assert_close((center[i] - zmp[i] - sign * (1 - a) * d) / arm, 0, 1e-10);
        }
      }
    }
    ground_case_close(&c);
  }
}

static void check_root(const ground_case *c, int lane) {
  double state[3 * max_d], ground[AMBULO__GROUND_ENTRIES];
  double complex rows[ground_max_rows];
  case_state(&c->body, lane, state);
  ground_of_lane(c, lane, ground);
  ground_reference(c, state, -1, 0, ground, (double *)rows);
  for (int k = 0; k < 6; k++) assert_close(creal(rows[k]) / ground_weight(c), 0, 1e-9);
}

/* No force is left at the six coordinates of the root: the kernels know, the reference finds it by
 * taking the feet's wrenches off. */
static void the_root_of_a_body_is_free(void **state) {
  (void)state;
  static ground_case c;
  for (int number = -shipped_count; number < 0; number++) {
    ground_case_open(&c, number);
    ambulo__plan_pattern p = ambulo__plan_get_pattern(c.body.plan);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      ground_forward(&c, kernels);
      check_root(&c, i % AMBULO__LANES);
      for (int k = 0; k < c.body.d; k++) {
        int empty = p.start[k] == p.start[k + 1];
        assert_int_equal(empty, k < 6);
        for (int lane = 0; lane < AMBULO__LANES; lane++) {
          double tau = c.body.out[k * AMBULO__LANES + lane] / ground_weight(&c);
          if (empty) assert_close(tau, 0, 1e-9);
          if (!empty && lane > 1) assert_true(fabs(tau) > 1e-9);
        }
      }
    }
    ground_case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(outputs_equal_the_reference),
                                     cmocka_unit_test(gradients_equal_complex_steps),
                                     cmocka_unit_test(jacobians_equal_complex_steps),
                                     cmocka_unit_test(instruction_sets_agree),
                                     cmocka_unit_test(the_split_keeps_its_promises),
                                     cmocka_unit_test(the_root_of_a_body_is_free)};
  return cmocka_run_group_tests_name("mechanics/kernels ground reaction", tests, NULL, NULL);
}
