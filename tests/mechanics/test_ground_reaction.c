/* The reference of the ground reaction against virtual work: what the torques lose, compared to
 * those without contact, is the power of the feet's wrenches on the motion of the feet, measured
 * on three points of each. */
#include "ground_fixture.h"

static void cross(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    out[i] = a[u] * b[v] - a[v] * b[u];
  }
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Angular velocity, and velocity at the world origin, of a rigid body from three points:
 * the velocities u, w of two of its vectors a, b give omega = (u x w) / (u . b). */
static void motion_of(const double r[3][3], const double v[3][3], double omega[3],
                      double slide[3]) {
  double b[3], u[3], w[3], along[3];
  for (int i = 0; i < 3; i++) {
    b[i] = r[2][i] - r[0][i];
    u[i] = v[1][i] - v[0][i];
    w[i] = v[2][i] - v[0][i];
  }
  cross(u, w, omega);
  for (int i = 0; i < 3; i++) omega[i] /= dot(u, b);
  cross(omega, r[0], along);
  for (int i = 0; i < 3; i++) slide[i] = v[0][i] - along[i];
}

/* Wrench of a foot from its rows, its centre of pressure and its free moment. */
static double foot_power(const ground_case *c, const double *rows, const double *rates, int foot,
                         const double *ground) {
  const double *n = c->body.model->up, *m = rows + c->body.d, *f = m + 3;
  const double *force = rows + c->foot_row + 4 * foot;
  const ambulo_foot *shape = &c->body.model->feet[foot];
  const int points[3] = {shape->heel[0], shape->heel[1], shape->toe[0]};
  double r[3][3], v[3][3], omega[3], slide[3], lever[3], center[3], moment[3];
  double share = foot ? -ground[0] : 1 - ground[0];
  for (int k = 0; k < 3; k++) {
    int row = c->body.d + 6 + 3 * points[k];
    memcpy(r[k], rows + row, sizeof r[k]);
    memcpy(v[k], rates + row, sizeof v[k]);
  }
  motion_of((const double(*)[3])r, (const double(*)[3])v, omega, slide);
  cross(n, m, lever);
  for (int i = 0; i < 3; i++) {
    center[i] = (lever[i] + c->height * f[i]) / dot(n, f) + share * ground[1 + i];
  }
  cross(center, force, moment);
  for (int i = 0; i < 3; i++) moment[i] += force[3] * n[i];
  return dot(moment, omega) + dot(force, slide);
}

static void torques_lose_the_power_of_the_feet(void **state) {
  (void)state;
  static ground_case c;
  for (int number = -shipped_count; number < 0; number++) {
    ground_case_open(&c, number);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      const double step = 1e-40;
      double motion[3 * max_d], z[6 * max_d] = {0}, rows[ground_max_rows], rates[ground_max_rows];
      double ground[AMBULO__GROUND_ENTRIES], free_rows[ground_max_rows], lost = 0, power = 0;
      double complex out[ground_max_rows];
      int d = c.body.d;
      case_state(&c.body, lane, motion);
      ground_of_lane(&c, lane, ground);
      case_reference(&c.body, motion, free_rows);
      for (int i = 0; i < 3 * d; i++) z[2 * i] = motion[i];
      for (int i = 0; i < d; i++) z[2 * i + 1] = step * motion[d + i];
      assert_int_equal(ground_reaction_reference(c.body.model, c.height, ground, z, z + 2 * d,
                                                 z + 4 * d, (double *)out,
                                                 c.body.reference_scratch),
                       AMBULO_OK);
      for (int row = 0; row < c.body.rows; row++) {
        rows[row] = creal(out[row]);
        rates[row] = cimag(out[row]) / step;
      }
      for (int i = 0; i < d; i++) lost += motion[d + i] * (free_rows[i] - rows[i]);
      for (int f = 0; f < 2; f++) power += foot_power(&c, rows, rates, f, ground);
      assert_close(lost / ground_weight(&c), power / ground_weight(&c), 1e-9);
    }
    ground_case_close(&c);
  }
}

/* The free moments are shares of the one that the whole wrench has at its zero-moment point. */
static void free_moments_are_shares(void **state) {
  (void)state;
  static ground_case c;
  for (int number = -shipped_count; number < 20; number++) {
    ground_case_open(&c, number);
    for (int lane = 0; lane < AMBULO__LANES; lane++) {
      double motion[3 * max_d], ground[AMBULO__GROUND_ENTRIES];
      double complex out[ground_max_rows];
      const double *up = c.body.model->up;
      double twist = 0, normal = 0;
      case_state(&c.body, lane, motion);
      ground_of_lane(&c, lane, ground);
      ground_reference(&c, motion, -1, 0, ground, (double *)out);
      for (int i = 0; i < 3; i++) {
        twist += creal(out[c.body.d + i]) * creal(out[c.body.d + 3 + i]);
        normal += up[i] * creal(out[c.body.d + 3 + i]);
      }
      twist /= normal;
      double scale = fmax(fabs(twist), ground_weight(&c));
      assert_close(creal(out[c.foot_row + 3]) / scale, ground[0] * twist / scale, 1e-9);
      assert_close(creal(out[c.foot_row + 7]) / scale, (1 - ground[0]) * twist / scale, 1e-9);
    }
    ground_case_close(&c);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(torques_lose_the_power_of_the_feet),
                                     cmocka_unit_test(free_moments_are_shares)};
  return cmocka_run_group_tests_name("mechanics/ground_reaction", tests, NULL, NULL);
}
