/* What hands hold: forces, torques and all derivatives against a reference in complex numbers, and
 * what mechanics says of them: momentum, the least squares of the share, energy. */
#include "contact/hold_fixture.h"

#include "support/fail_alloc.h"

static void keep(hold_case *c, int lane) {
  ambulo__holds_keep(c->holds, c->q[0] + lane, c->q[1] + lane, c->q[2] + lane, c->told + lane,
                     c->kept);
}

static double largest_of(const number *values, int count) {
  double size = 1;
  for (int i = 0; i < count; i++) size = fmax(size, cabs(values[i]));
  return size;
}

/* every lane of each case, or two, other ones from case to case, where a lane takes long */
static void each_case(void (*check)(hold_case *, int lane), int every) {
  for (int index = 0; index < hold_case_count; index++) {
    hold_case c;
    hold_case_open(&c, index);
    for (int lane = index % every; lane < AMBULO__LANES; lane += every) {
      keep(&c, lane);
      check(&c, lane);
    }
    hold_case_close(&c);
  }
}

static void check_values(hold_case *c, int lane) {
  hold_motion s;
  number want[most_coordinates], wrench[6];
  double tau[most_coordinates * AMBULO__LANES], got[6] = {1, 2, 3, 4, 5, 6};
  for (int i = 0; i < c->d * AMBULO__LANES; i++) tau[i] = sin(1.0 + i);
  ambulo__holds_add_torques(c->holds, c->kept, tau);
  ambulo__holds_add_wrench(c->holds, c->kept, got, 1);
  lane_of(c, lane, &s);
  reference_holds(c, lane, &s, want, wrench);
  double size = fmax(largest_of(want, c->d), largest_of(wrench, 6));
  for (int i = 0; i < c->d; i++)
    assert_close((tau[i * AMBULO__LANES] - sin(1.0 + i * AMBULO__LANES)) / size,
                 creal(want[i]) / size, 1e-12);
  for (int k = 0; k < 6; k++) assert_close((got[k] - 1 - k) / size, creal(wrench[k]) / size, 1e-12);
}

static void test_forces_and_torques(void **state) {
  (void)state;
  each_case(check_values, 1);
}

/* L = sum y tau + wrench weights, by complex steps in every coordinate, rate and acceleration */
static number functional(const hold_case *c, int lane, const hold_motion *s, const double *y,
                         const double *root) {
  number tau[most_coordinates], wrench[6], sum = 0;
  reference_holds(c, lane, s, tau, wrench);
  for (int i = 0; i < c->d; i++) sum += y[i * AMBULO__LANES] * tau[i];
  for (int k = 0; k < 6; k++) sum += root[k] * wrench[k];
  return sum;
}

static void compare_gradient(const hold_case *c, int lane, const double *y, const double *root,
                             const double *gradient, int stride) {
  hold_motion s;
  const double step = 1e-150;
  number want[3 * most_coordinates];
  lane_of(c, lane, &s);
  for (int i = 0; i < c->d; i++) {
    number *member[3] = {&s.q[i], &s.qd[i], &s.qdd[i]};
    for (int o = 0; o < 3; o++) {
      *member[o] += step * I;
      want[o * c->d + i] = cimag(functional(c, lane, &s, y, root)) / step;
      *member[o] = creal(*member[o]);
    }
  }
  double size = largest_of(want, 3 * c->d);
  for (int i = 0; i < 3 * c->d; i++)
    assert_close(gradient[i * stride] / size, creal(want[i]) / size, 1e-11);
}

static void check_sweep(hold_case *c, int lane) {
  double y[most_coordinates * AMBULO__LANES], g[3 * most_coordinates * AMBULO__LANES] = {0};
  size_t d8 = (size_t)c->d * AMBULO__LANES;
  ambulo__hold_adjoints x = {
      .tau = y, .coordinate = -1, .q = g, .qd = g + d8, .qdd = g + 2 * d8, .stride = AMBULO__LANES};
  for (size_t i = 0; i < d8; i++) y[i] = cos(0.3 + 1.7 * (double)i);
  for (int k = 0; k < 6; k++) x.wrench[k] = lane % 2 ? sin(2.0 + k) : 0.0;
  ambulo__holds_reverse(c->holds, c->kept, &x);
  compare_gradient(c, lane, y, x.wrench, g, AMBULO__LANES);
}

static void test_the_sweep_back(void **state) {
  (void)state;
  each_case(check_sweep, AMBULO__LANES / 2);
}

/* a row of the Jacobian: one weight of 1, on a torque or on the root wrench */
static void check_rows(hold_case *c, int lane) {
  int row = (3 * lane + c->d) % (c->d + 6);
  double y[most_coordinates * AMBULO__LANES] = {0}, g[3 * most_coordinates] = {0};
  ambulo__hold_adjoints x = {.coordinate = row < c->d ? row : -1,
                             .q = g,
                             .qd = g + c->d,
                             .qdd = g + 2 * c->d,
                             .stride = 1};
  if (row < c->d) y[row * AMBULO__LANES] = 1;
  if (row >= c->d) x.wrench[row - c->d] = 1;
  ambulo__holds_reverse(c->holds, c->kept, &x);
  compare_gradient(c, lane, y, x.wrench, g, 1);
}

static void test_rows_of_the_jacobian(void **state) {
  (void)state;
  each_case(check_rows, AMBULO__LANES / 2);
}

/* (1) the hands' forces change the momentum of what is held, and push besides; (2) of all shares
 * theirs has the least sum of squares: what may be added, a squeeze along the line, is across to
 * them; (3) moments only twist about the line */
static void check_share(hold_case *c, int lane) {
  hold_motion s;
  lane_of(c, lane, &s);
  for (int i = 0; i < c->n; i++) {
    const ambulo_hold *h = &c->hold[i];
    double window = c->told[i * AMBULO__LANES + lane], size = 1, line[3], squeeze = 0;
    ambulo__hold_state at = ambulo__hold_at(c->holds, i, c->kept);
    number motion[2][3][3], push[3];
    int pair = h->hand[1] >= 0;
    assert_close(at.window, window, 0);
    world(c->model, h->force, push);
    for (int k = 0; k < 2; k++) reference_motion(c->model, h->hand[k * pair], &s, motion[k]);
    for (int k = 0; k < 6; k++) size = fmax(size, fabs(at.force[k / 3][k % 3]));
    for (int k = 0; k < 3; k++) {
      double a = 0.5 * creal(motion[0][2][k] + motion[1][2][k]) - c->model->gravity[k];
      double want = window * (h->mass * a + creal(push[k]));
      assert_close((at.force[0][k] + at.force[1][k]) / size, want / size, 1e-12);
      line[k] = creal(motion[1][0][k] - motion[0][0][k]);
      squeeze += line[k] * (at.force[1][k] - at.force[0][k]);
    }
    if (!pair) continue;
    double length = sqrt(line[0] * line[0] + line[1] * line[1] + line[2] * line[2]);
    assert_close(squeeze / (size * length), 0, 1e-10);
    for (int k = 0; k < 3; k++) {
      int p = (k + 1) % 3, r = (k + 2) % 3;
      double across = line[p] * at.moment[0][r] - line[r] * at.moment[0][p];
      assert_close(across / (size * length), 0, 1e-12);
    }
  }
}

static void test_momentum_and_least_squares(void **state) {
  (void)state;
  each_case(check_share, 1);
}

/* about the middle of the hands their forces and moments are what the law asks for */
static void check_moment(hold_case *c, int lane) {
  hold_motion s;
  lane_of(c, lane, &s);
  for (int i = 0; i < c->n; i++) {
    const ambulo_hold *h = &c->hold[i];
    if (h->hand[1] < 0) continue;
    double window = c->told[i * AMBULO__LANES + lane];
    ambulo__hold_state at = ambulo__hold_at(c->holds, i, c->kept);
    number motion[2][3][3], o[3], carried[3], want[3], turn[3], line[3], bend[3];
    world(c->model, h->center, o);
    for (int k = 0; k < 2; k++) reference_motion(c->model, h->hand[k], &s, motion[k]);
    for (int k = 0; k < 3; k++) {
      number a = 0.5 * (motion[0][2][k] + motion[1][2][k]) - c->model->gravity[k];
      carried[k] = window * h->mass * a;
      line[k] = motion[1][0][k] - motion[0][0][k];
      bend[k] = motion[1][2][k] - motion[0][2][k];
    }
    cross(o, carried, want);
    cross(line, bend, turn);
    double square = creal(dot(line, line)), size = 1;
    for (int k = 0; k < 3; k++) want[k] += window * h->inertia * turn[k] / square;
    size = fmax(largest_of(want, 3), size);
    for (int k = 0; k < 3; k++) {
      int p = (k + 1) % 3, r = (k + 2) % 3;
      double got = at.moment[0][k] + at.moment[1][k];
      got += 0.5 * (creal(line[p]) * (at.force[1][r] - at.force[0][r]) -
                    creal(line[r]) * (at.force[1][p] - at.force[0][p]));
      assert_close(got / size, creal(want[k]) / size, 1e-10);
    }
  }
}

static void test_moments_about_the_middle(void **state) {
  (void)state;
  each_case(check_moment, 1);
}

/* Of a box whose middle is between the hands, the power of the forces is the rate of its energy,
 * m |v|^2 / 2 - m g . c + I |d x dd|^2 / (2 |d|^4), as long as the hands keep their distance; of
 * hands on one link they do. */
static void test_power_is_the_rate_of_energy(void **state) {
  (void)state;
  for (int index = 0; index < hold_case_count; index++) {
    hold_case c;
    hold_case_open(&c, index);
    ambulo_hold *h = &c.hold[0];
    h->hand[0] = 2;
    h->hand[1] = 3;
    memset(h->center, 0, sizeof h->center);
    memset(h->force, 0, sizeof h->force);
    ambulo__holds_free(c.holds);
    free(c.kept);
    c.definition.hold_count = c.n = 1;
    assert_int_equal(ambulo__holds_create(&c.definition, c.plan, NULL, &c.holds), AMBULO_OK);
    c.kept = calloc(ambulo__holds_entries(c.holds), sizeof *c.kept);
    assert_non_null(c.kept);
    c.told[0] = 1;
    keep(&c, 0);
    /* the state a complex step of time later */
    hold_motion s;
    const double step = 1e-150;
    lane_of(&c, 0, &s);
    for (int i = 0; i < c.d; i++) {
      s.q[i] += step * I * s.qd[i];
      s.qd[i] += step * I * s.qdd[i];
    }
    number at[2][3][3], energy = 0, line[3], rate[3], turn[3];
    for (int k = 0; k < 2; k++) reference_motion(c.model, h->hand[k], &s, at[k]);
    for (int k = 0; k < 3; k++) {
      number v = 0.5 * (at[0][1][k] + at[1][1][k]), p = 0.5 * (at[0][0][k] + at[1][0][k]);
      energy += h->mass * (0.5 * v * v - c.model->gravity[k] * p);
      line[k] = at[1][0][k] - at[0][0][k];
      rate[k] = at[1][1][k] - at[0][1][k];
    }
    cross(line, rate, turn);
    energy += 0.5 * h->inertia * dot(turn, turn) / (dot(line, line) * dot(line, line));
    double want = cimag(energy) / step, got = ambulo__hold_at(c.holds, 0, c.kept).power;
    assert_close(got / fmax(1, fabs(want)), want / fmax(1, fabs(want)), 1e-9);
    hold_case_close(&c);
  }
}

static void test_memory(void **state) {
  (void)state;
  hold_case c;
  hold_case_open(&c, 7);
  for (int failing = 0;; failing++) {
    fail_alloc memory = fail_alloc_at(failing);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__holds *holds = NULL;
    ambulo_status status = ambulo__holds_create(&c.definition, c.plan, &allocator, &holds);
    ambulo__holds_free(holds);
    assert_int_equal(memory.live, 0);
    if (!status) break;
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_true(failing < 100);
  }
  ambulo__holds_free(NULL);
  assert_int_equal(ambulo__holds_entries(NULL), 0);
  hold_case_close(&c);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_forces_and_torques),
      cmocka_unit_test(test_the_sweep_back),
      cmocka_unit_test(test_rows_of_the_jacobian),
      cmocka_unit_test(test_momentum_and_least_squares),
      cmocka_unit_test(test_moments_about_the_middle),
      cmocka_unit_test(test_power_is_the_rate_of_energy),
      cmocka_unit_test(test_memory),
  };
  return cmocka_run_group_tests_name("device/holds", tests, NULL, NULL);
}
