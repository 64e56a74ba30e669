/* A point in motion: place, velocity and acceleration against 4 x 4 products in complex numbers,
 * and what each coordinate does to them by complex steps. */
#include "contact/hold_fixture.h"

#include "contact/hand_motion.h"

typedef struct hand_case {
  hold_case c;
  ambulo__device_path path;
  ambulo__hand_motion motion;
  double *kept;
} hand_case;

static void open_case(hand_case *h, int index, int point) {
  hold_case_open(&h->c, index);
  const ambulo_point *p = &h->c.model->points[point];
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__path_create(h->c.model, -1, p->link, p->position, &a, &h->path),
                   AMBULO_OK);
  h->kept = calloc(ambulo__hand_entries(h->path.count), sizeof *h->kept);
  assert_non_null(h->kept);
  h->motion = ambulo__hand_motion_in(h->kept, h->path.count);
  assert_true(h->motion.slope_gain + 3 * h->path.count ==
              h->kept + ambulo__hand_entries(h->path.count));
}

static void close_case(hand_case *h) {
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__path_free(&a, &h->path);
  free(h->kept);
  hold_case_close(&h->c);
}

static double size_of(number v[3][3]) {
  double size = 1;
  for (int k = 0; k < 9; k++) size = fmax(size, cabs(v[k / 3][k % 3]));
  return size;
}

/* da/dq = Jdd, da/dqd = 2 Jd, dp/dq = dv/dqd = da/dqdd = J */
static void compare_slopes(const hand_case *h, int point, hold_motion *s, int j) {
  const double step = 1e-150;
  int i = h->path.joints[j].coordinate;
  number *member[3] = {&s->q[i], &s->qd[i], &s->qdd[i]}, by[3][3][3];
  for (int o = 0; o < 3; o++) {
    *member[o] += step * I;
    reference_motion(h->c.model, point, s, by[o]);
    *member[o] = creal(*member[o]);
  }
  double size = 1;
  for (int o = 0; o < 3; o++)
    for (int k = 0; k < 9; k++) size = fmax(size, fabs(cimag(by[o][k / 3][k % 3])) / step);
  for (int k = 0; k < 3; k++) {
    double slope = h->motion.slope[3 * j + k] / size;
    assert_close(slope, cimag(by[0][0][k]) / step / size, 1e-12);
    assert_close(slope, cimag(by[1][1][k]) / step / size, 1e-12);
    assert_close(slope, cimag(by[2][2][k]) / step / size, 1e-12);
    assert_close(2 * h->motion.slope_rate[3 * j + k] / size, cimag(by[1][2][k]) / step / size,
                 1e-12);
    assert_close(h->motion.slope_gain[3 * j + k] / size, cimag(by[0][2][k]) / step / size, 1e-12);
  }
}

static void test_motion_and_slopes(void **state) {
  (void)state;
  for (int index = 0; index < hold_case_count; index++) {
    int point = index % hold_points, lane = index % AMBULO__LANES;
    hand_case h;
    hold_motion s;
    number want[3][3];
    open_case(&h, index, point);
    const double *q[3] = {h.c.q[0] + lane, h.c.q[1] + lane, h.c.q[2] + lane};
    ambulo__hand_move(&h.path, q[0], q[1], q[2], &h.motion);
    lane_of(&h.c, lane, &s);
    reference_motion(h.c.model, point, &s, want);
    double size = size_of(want);
    for (int k = 0; k < 3; k++) {
      assert_close(h.motion.place[k] / size, creal(want[0][k]) / size, 1e-13);
      assert_close(h.motion.velocity[k] / size, creal(want[1][k]) / size, 1e-13);
      assert_close(h.motion.acceleration[k] / size, creal(want[2][k]) / size, 1e-13);
    }
    for (int j = 0; j < h.path.count; j++) compare_slopes(&h, point, &s, j);
    close_case(&h);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_motion_and_slopes)};
  return cmocka_run_group_tests_name("device/hand_motion", tests, NULL, NULL);
}
