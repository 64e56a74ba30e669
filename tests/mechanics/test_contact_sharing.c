/* What the law by which contacts share a wrench promises, whatever the numbers: one contact takes
 * all of it, the sum is right, nothing acts without weight, equals share equally, no other sharing
 * is cheaper, and where it happens does not matter. */
#include "mechanics/lagrangian.h"
#include "contact_fixture.h"

/* Row of the outputs in a lane. */
static double row_of(const contact_case *c, int row, int lane) {
  return c->body.out[row * AMBULO__LANES + lane];
}

static void contact_of(const contact_case *c, int contact, int lane, double force[3],
                       double moment[3]) {
  for (int i = 0; i < 3; i++) {
    force[i] = row_of(c, c->first_row + 6 * contact + i, lane);
    moment[i] = row_of(c, c->first_row + 6 * contact + 3 + i, lane);
  }
}

static void root_of(const contact_case *c, int lane, double force[3], double moment[3]) {
  for (int i = 0; i < 3; i++) {
    moment[i] = row_of(c, c->body.d + i, lane);
    force[i] = row_of(c, c->body.d + 3 + i, lane);
  }
}

static double *weight_at(const contact_case *c, int contact, int lane) {
  return c->ground + (3 + 4 * contact) * AMBULO__LANES + lane;
}

static double center_at(const contact_case *c, int contact, int axis, int lane) {
  return weight_at(c, contact, lane)[(1 + axis) * AMBULO__LANES];
}

static void add_cross(const double a[3], const double b[3], double factor, double out[3]) {
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    out[i] += factor * (a[u] * b[v] - a[v] * b[u]);
  }
}

static double length3(const double v[3]) {
  return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Sums of forces, and of moments about the world origin; returns that of the sizes of the forces:
 * contacts may push against each other. */
static double sum_of(const contact_case *c, int lane, double force[3], double moment[3]) {
  double size = 0;
  memset(force, 0, 3 * sizeof *force);
  memset(moment, 0, 3 * sizeof *moment);
  for (int k = 0; k < c->contacts.count; k++) {
    double f[3], m[3], p[3];
    contact_of(c, k, lane, f, m);
    for (int i = 0; i < 3; i++) {
      p[i] = center_at(c, k, i, lane);
      force[i] += f[i];
      moment[i] += m[i];
    }
    add_cross(p, f, 1, moment);
    size += length3(f);
  }
  return size;
}

/* Every case in every instruction set. */
static void with_every_case(void (*check)(contact_case *, const ambulo__kernels *)) {
  static contact_case c;
  for (int number = -shipped_contact_count; number < contact_coupled_cases; number++) {
    contact_case_open(&c, number);
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      contact_forward(&c, kernels);
      check(&c, kernels);
    }
    contact_case_close(&c);
  }
}

static void check_sum(contact_case *c, const ambulo__kernels *kernels) {
  (void)kernels;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double force[3], moment[3], f[3], m[3], arm = 1;
    if (lane == in_flight) continue;
    root_of(c, lane, force, moment);
    double size = sum_of(c, lane, f, m);
    for (int i = 0; i < 3; i++) arm = fmax(arm, fabs(center_at(c, 0, i, lane)));
    double turn = size * arm + length3(moment);
    for (int i = 0; i < 3; i++) {
      assert_close(f[i] / size, force[i] / size, 1e-12);
      assert_close(m[i] / turn, moment[i] / turn, 1e-12);
    }
  }
}

static void the_sum_is_the_root_wrench(void **state) {
  (void)state;
  with_every_case(check_sum);
}

static void check_alone(contact_case *c, const ambulo__kernels *kernels) {
  (void)kernels;
  for (int lane = alone_first; lane <= alone_last; lane++) {
    int alone = lane == alone_first ? 0 : c->contacts.count - 1;
    double force[3], moment[3], f[3], m[3], p[3];
    root_of(c, lane, force, moment);
    double turn = length3(moment);
    for (int i = 0; i < 3; i++) p[i] = center_at(c, alone, i, lane);
    add_cross(p, force, -1, moment);
    for (int k = 0; k < c->contacts.count; k++) {
      double size = length3(force), arm = turn + size * (1 + length3(p));
      contact_of(c, k, lane, f, m);
      for (int i = 0; i < 3; i++) {
        assert_close(f[i] / size, k == alone ? force[i] / size : 0, k == alone ? 1e-12 : 0);
        assert_close(m[i] / arm, k == alone ? moment[i] / arm : 0, k == alone ? 1e-12 : 0);
      }
    }
  }
}

static void one_contact_takes_all(void **state) {
  (void)state;
  with_every_case(check_alone);
}

/* In flight: no wrenches, and the torques of a body in the air, but for those of joints that carry
 * everything. */
static void check_flight(contact_case *c, const ambulo__kernels *kernels) {
  kernel_case *b = &c->body;
  ambulo__plan *air = NULL;
  assert_int_equal(ambulo__plan_create(b->model, NULL, &air), AMBULO_OK);
  double *out = lane_array((size_t)ambulo__plan_rows(air));
  double *scratch = lane_array(ambulo__plan_scratch(air) / AMBULO__LANES);
  kernels->outputs(air, b->q, b->qd, b->qdd, NULL, out, scratch);
  for (int row = 0; row < c->first_row; row++) {
    double want = out[row * AMBULO__LANES + in_flight];
    int vanishes = row < b->d && b->plan->joints[row].torque_row == AMBULO__ROW_VANISHES;
    double size = contact_body_weight(c) + fabs(want);
    assert_close(row_of(c, row, in_flight) / size, vanishes ? 0 : want / size, 1e-10);
  }
  for (int row = 0; row < 6 * c->contacts.count; row++) {
    assert_close(row_of(c, c->first_row + row, in_flight), 0, 0);
  }
  free(out);
  free(scratch);
  ambulo__plan_free(air);
}

static void nothing_acts_in_flight(void **state) {
  (void)state;
  with_every_case(check_flight);
}

static double dot3(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* w l^2 and w times what the law asks to be stationary: A^-1 f, B^-1 m. */
static void prices(const contact_case *c, int contact, int lane, double by_force[3],
                   double by_moment[3]) {
  double f[3], m[3], e[3], size = 0, weight = *weight_at(c, contact, lane);
  double slant = creal(c->contacts.slant), reach = creal(c->contacts.moment_arm);
  contact_of(c, contact, lane, f, m);
  for (int i = 0; i < 3; i++) {
    int center = c->first_row + 6 * c->contacts.count + i;
    e[i] = row_of(c, center, lane) - center_at(c, contact, i, lane);
    size += e[i] * e[i];
  }
  double along = dot3(e, f) / size * (slant * slant - 1);
  for (int i = 0; i < 3; i++) {
    by_force[i] = (f[i] + along * e[i]) / weight;
    by_moment[i] = m[i] / (weight * reach * reach);
  }
}

/* What one contact gives another, any force and moment, does not change the price: with d the
 * arm from the second to the first, grad f_1 - grad f_2 - grad m_2 x d and grad m_1 - grad m_2 are
 * zero. */
static void check_price(contact_case *c, const ambulo__kernels *kernels) {
  (void)kernels;
  for (int lane = uneven + 1; lane < AMBULO__LANES; lane++) {
    double f[2][3], m[2][3], d[3], slide[3];
    for (int k = 1; k < c->contacts.count; k++) {
      prices(c, 0, lane, f[0], m[0]);
      prices(c, k, lane, f[1], m[1]);
      for (int i = 0; i < 3; i++) {
        d[i] = center_at(c, 0, i, lane) - center_at(c, k, i, lane);
        slide[i] = f[0][i] - f[1][i];
      }
      add_cross(m[1], d, -1, slide);
      double size = length3(f[0]) + length3(f[1]) + length3(m[0]) + length3(m[1]);
      for (int i = 0; i < 3; i++) {
        assert_close(slide[i] / size, 0, 1e-10);
        assert_close((m[0][i] - m[1][i]) / size, 0, 1e-10);
      }
    }
  }
}

static void no_other_sharing_is_cheaper(void **state) {
  (void)state;
  with_every_case(check_price);
}

/* Less weight, less wrench: in the end in proportion. */
static void a_wrench_goes_with_its_weight(void **state) {
  (void)state;
  static contact_case c;
  const ambulo__kernels *kernels = ambulo__kernels_select();
  for (int number = 1; number < contact_coupled_cases; number += 6) {
    double force[3], moment[3], last[3] = {0}, turn[3] = {0}, first = 0;
    contact_case_open(&c, number);
    assert_int_equal(c.contacts.count, 2);
    for (int power = -4; power >= -16; power -= 4) {
      *weight_at(&c, 1, 5) = pow(10, power);
      contact_forward(&c, kernels);
      contact_of(&c, 1, 5, force, moment);
      for (int i = 0; i < 3 && power < -8; i++) {
        double size = 1e-4 * (length3(last) + length3(turn));
        assert_close(force[i] / size, 1e-4 * last[i] / size, 1e-5);
        assert_close(moment[i] / size, 1e-4 * turn[i] / size, 1e-5);
      }
      memcpy(last, force, sizeof last);
      memcpy(turn, moment, sizeof turn);
      if (power == -4) first = length3(force);
    }
    assert_true(length3(force) > 0 && length3(force) < 2e-12 * first);
    contact_case_close(&c);
  }
}

/* Weights all scaled, or the point o far away. */
static void only_proportions_count(void **state) {
  (void)state;
  static contact_case c;
  const ambulo__kernels *kernels = ambulo__kernels_select();
  for (int number = -shipped_contact_count; number < 40; number++) {
    contact_case_open(&c, number);
    int rows = c.body.rows * AMBULO__LANES;
    double *want = lane_array((size_t)c.body.rows);
    contact_forward(&c, kernels);
    memcpy(want, c.body.out, (size_t)rows * sizeof *want);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      for (int k = 0; k < c.contacts.count; k++) *weight_at(&c, k, lane) *= 1e-5;
      for (int i = 0; i < 3; i++) c.ground[i * AMBULO__LANES + lane] += 3 - 2 * i;
    }
    contact_forward(&c, kernels);
    double size[AMBULO__LANES] = {0};
    for (int at = 0; at < rows; at++) {
      size[at % AMBULO__LANES] = fmax(size[at % AMBULO__LANES], fabs(want[at]));
    }
    for (int at = 0; at < rows; at++) {
      double scale = size[at % AMBULO__LANES];
      assert_close(c.body.out[at] / scale, want[at] / scale, 1e-11);
    }
    free(want);
    contact_case_close(&c);
  }
}

/* A walking body 20 m further on: what acts is the same. */
static void where_it_happens_does_not_matter(void **state) {
  (void)state;
  static contact_case c;
  const ambulo__kernels *kernels = ambulo__kernels_select();
  for (int number = -shipped_contact_count; number < 0; number++) {
    contact_case_open(&c, number);
    int first = c.first_row, count = 6 * c.contacts.count;
    double *want = lane_array((size_t)c.body.rows);
    contact_forward(&c, kernels);
    memcpy(want, c.body.out, (size_t)(c.body.rows * AMBULO__LANES) * sizeof *want);
    double x = row_of(&c, first + count, 0);
    for (int lane = 0; lane < AMBULO__LANES; lane++) c.body.q[lane] += 20;
    contact_forward(&c, kernels);
    double moved[3];
    for (int i = 0; i < 3; i++) {
      moved[i] = row_of(&c, first + count + i, 0) - want[(first + count + i) * AMBULO__LANES];
    }
    assert_close(fabs(x) < 5 ? length3(moved) : 0, 20, 1e-12); /* coordinate 0 slides */
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      for (int i = 0; i < 3; i++) {
        c.ground[i * AMBULO__LANES + lane] += moved[i];
        for (int k = 0; k < c.contacts.count; k++) {
          weight_at(&c, k, lane)[(1 + i) * AMBULO__LANES] += moved[i];
        }
      }
    }
    contact_forward(&c, kernels);
    for (int at = first * AMBULO__LANES; at < (first + count) * AMBULO__LANES; at++) {
      double size = contact_body_weight(&c);
      assert_close(c.body.out[at] / size, want[at] / size, 1e-11);
    }
    free(want);
    contact_case_close(&c);
  }
}

/* The body upright, in which left is the mirror image of right, that speeds up in the mirror
 * plane. */
static void equals_share_equally(void **state) {
  (void)state;
  static contact_case c;
  for (int number = -2; number < 0; number++) {
    contact_case_open(&c, number);
    kernel_case *b = &c.body;
    int center = c.first_row + 12, up = b->model->up[1] > 0.5 ? 1 : 2, across = 3 - up;
    for (int i = 0; i < b->d * AMBULO__LANES; i++) b->q[i] = b->qd[i] = b->qdd[i] = 0;
    for (int lane = 0; lane < AMBULO__LANES; lane++) b->qdd[lane] = 0.7; /* forward */
    contact_forward(&c, ambulo__kernels_select());
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      for (int k = 0; k < 2; k++) {
        double away[3] = {0.05, 0, 0};
        away[up] = -0.9;
        away[across] = k == 0 ? 0.1 : -0.1;
        *weight_at(&c, k, lane) = 0.8;
        for (int i = 0; i < 3; i++) {
          weight_at(&c, k, lane)[(1 + i) * AMBULO__LANES] = row_of(&c, center + i, lane) + away[i];
        }
      }
    }
    for (int i = 0; i < isa_count; i++) {
      const ambulo__kernels *kernels = ambulo__kernels_by_name(isa_names[i]);
      if (!kernels) continue;
      contact_forward(&c, kernels);
      double f[2][3], m[2][3], size = contact_body_weight(&c);
      for (int k = 0; k < 2; k++) contact_of(&c, k, i, f[k], m[k]);
      for (int axis = 0; axis < 3; axis++) {
        double sign = axis == across ? -1 : 1; /* of a force; a moment has the opposite one */
        assert_close(f[0][axis] / size, sign * f[1][axis] / size, 1e-12);
        assert_close(m[0][axis] / size, -sign * m[1][axis] / size, 1e-12);
      }
      assert_close(f[0][up] / size, 0.5, 1e-9);
    }
    contact_case_close(&c);
  }
}

/* The reference's torques without ground, less the kernels' contacts: none is left at the root, and
 * elsewhere those of the kernels. */
static void check_root(contact_case *c, const ambulo__kernels *kernels) {
  kernel_case *b = &c->body;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double motion[3 * max_d], z[6 * max_d] = {0};
    double complex rows[contact_max_rows];
    (void)kernels;
    if (lane == in_flight) continue;
    case_state(b, lane, motion);
    for (int i = 0; i < 3 * b->d; i++) z[2 * i] = motion[i];
    assert_int_equal(ambulo__lagrangian(1, b->model, z, z + 2 * b->d, z + 4 * b->d,
                                        &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                          .tau = (double *)rows,
                                                          .wrench = (double *)(rows + b->d),
                                                          .points = (double *)(rows + b->d + 6)},
                                        b->reference_scratch),
                     AMBULO_OK);
    for (int k = 0; k < c->contacts.count; k++) {
      double p[3];
      scalar share[6];
      for (int i = 0; i < 3; i++) p[i] = center_at(c, k, i, lane);
      for (int i = 0; i < 6; i++) share[i] = row_of(c, c->first_row + 6 * k + i, lane);
      reference_take_off(b->model, b->reference_scratch, c->contacts.link[k], share, p, rows);
    }
    double size = contact_body_weight(c);
    for (int i = 0; i < b->d; i++) size = fmax(size, fabs(row_of(c, i, lane)));
    for (int i = 0; i < 6; i++) size = fmax(size, fabs(row_of(c, b->d + i, lane)));
    for (int i = 0; i < b->d; i++) {
      assert_close(creal(rows[i]) / size, row_of(c, i, lane) / size, 1e-10);
    }
  }
}

static void no_force_is_left_at_the_root(void **state) {
  (void)state;
  with_every_case(check_root);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_sum_is_the_root_wrench),
                                     cmocka_unit_test(one_contact_takes_all),
                                     cmocka_unit_test(nothing_acts_in_flight),
                                     cmocka_unit_test(no_other_sharing_is_cheaper),
                                     cmocka_unit_test(a_wrench_goes_with_its_weight),
                                     cmocka_unit_test(only_proportions_count),
                                     cmocka_unit_test(where_it_happens_does_not_matter),
                                     cmocka_unit_test(equals_share_equally),
                                     cmocka_unit_test(no_force_is_left_at_the_root)};
  return cmocka_run_group_tests_name("mechanics/contact sharing", tests, NULL, NULL);
}
