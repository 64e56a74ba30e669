/* Rates of a frame against differences of its place; quaternions against their rotation. */
#include "exchange/export.h"
#include "support/random_model.h"
#include "support/test.h"

/* q(t) = q + t qd + t^2 / 2 qdd */
static void at(const double *q, const double *qd, const double *qdd, int d, double t, double *out,
               double *rate) {
  for (int i = 0; i < d; i++) {
    out[i] = q[i] + t * qd[i] + 0.5 * t * t * qdd[i];
    rate[i] = qd[i] + t * qdd[i];
  }
}

static void check_seed(uint64_t seed) {
  random_tree *tree = malloc(sizeof *tree);
  random_source source = {seed + 77};
  ambulo_model *model = NULL;
  enum { MOST = 16 };
  double q[MOST], qd[MOST], qdd[MOST], x[MOST], dx[MOST];
  const double h = 1e-5;
  random_tree_make(tree, seed, 1 + (int)(seed % 6));
  assert_int_equal(ambulo_model_create(&tree->definition, NULL, NULL, &model), AMBULO_OK);
  int d = model->coordinate_count, link = model->link_count - 1;
  for (int i = 0; i < d; i++) {
    q[i] = random_between(&source, -2, 2);
    qd[i] = random_between(&source, -1, 1);
    qdd[i] = random_between(&source, -1, 1);
  }
  ambulo__rigid world = ambulo__ground_turn(model, AMBULO__Z_UP);
  ambulo__frame_motion now, back, ahead;
  ambulo__frame_motion_of(model, link, &world, q, qd, qdd, &now);
  at(q, qd, qdd, d, -h, x, dx);
  ambulo__frame_motion_of(model, link, &world, x, dx, qdd, &back);
  at(q, qd, qdd, d, h, x, dx);
  ambulo__frame_motion_of(model, link, &world, x, dx, qdd, &ahead);
  for (int k = 0; k < 3; k++) {
    assert_close(now.velocity[k], (ahead.place.p[k] - back.place.p[k]) / (2 * h), 1e-8);
    assert_close(now.acceleration[k], (ahead.velocity[k] - back.velocity[k]) / (2 * h), 1e-7);
    assert_close(now.spin_rate[k], (ahead.spin[k] - back.spin[k]) / (2 * h), 1e-8);
  }
  /* R' = w x R */
  for (int c = 0; c < 3; c++) {
    const double *w = now.spin, u[3] = {now.place.r[0][c], now.place.r[1][c], now.place.r[2][c]};
    const double want[3] = {w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2],
                            w[0] * u[1] - w[1] * u[0]};
    for (int r = 0; r < 3; r++)
      assert_close((ahead.place.r[r][c] - back.place.r[r][c]) / (2 * h), want[r], 1e-8);
  }
  ambulo_model_free(model);
  free(tree);
}

static void rates(void **state) {
  (void)state;
  for (uint64_t seed = 1; seed <= 100; seed++) check_seed(seed);
}

static void quaternions(void **state) {
  (void)state;
  random_source source = {9};
  const double none[3] = {0, 0, 0};
  int far = 0;
  for (int i = 0; i < 2000; i++) {
    double angles[3], q[4], other[4], again[4], r[3][3];
    for (int k = 0; k < 3; k++)
      angles[k] = i % 2 ? random_between(&source, -4, 4) : random_angle(&source);
    ambulo__rigid a = ambulo__rigid_of_xyz(none, angles);
    ambulo__quaternion_of((const double(*)[3])a.r, NULL, q);
    assert_true(q[3] >= 0.0);
    far += q[3] < 0.5;
    assert_close(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1.0, 1e-14);
    assert_true(ambulo__rotation_of_quaternion((double[]){q[3], q[0], q[1], q[2]}, r));
    for (int u = 0; u < 3; u++)
      for (int v = 0; v < 3; v++) assert_close(r[u][v], a.r[u][v], 1e-14);
    for (int k = 0; k < 4; k++) other[k] = -q[k];
    ambulo__quaternion_of((const double(*)[3])a.r, other, again);
    for (int k = 0; k < 4; k++) assert_close(again[k], other[k], 1e-15); /* no jump */
  }
  assert_true(far > 100);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(rates),
      cmocka_unit_test(quaternions),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
