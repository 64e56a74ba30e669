/* Places and slopes along a path against matrices from the world on. */
#include "contact/hold_fixture.h"
#include "contact/devices.h"
#include "device_fixture.h"
#include "mechanics/pose.h"

/* from the world: all that carries the link */
static void check_path(const ambulo_model *m, int link, const double local[3], const double *lanes,
                       const double *q) {
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo__device_path path;
  ambulo__pose pose;
  double point[3], world[3], axis[3 * most_coordinates], slope[3 * most_coordinates];
  assert_int_equal(ambulo__path_create(m, -1, link, local, &a, &path), AMBULO_OK);
  assert_int_equal(ambulo__pose_create(m, NULL, &pose), AMBULO_OK);
  ambulo__pose_at(&pose, q);
  ambulo__pose_point(&pose, link, local, world);
  ambulo__path_point(&path, lanes, point, axis, slope);
  for (int k = 0; k < 3; k++) assert_close(point[k], world[k], 1e-12);
  for (int i = 0; i < path.count; i++) {
    number z[most_coordinates], moved[3];
    double sum[3] = {0, 0, 0}; /* of all joints that the coordinate moves, times their slopes */
    for (int n = 0; n < path.count; n++) {
      double f[AMBULO__COUPLING_SLOPES];
      int coordinate = path.joints[n].coordinate;
      (void)ambulo__path_value(&path.joints[n], q[coordinate], f);
      for (int k = 0; k < 3 && coordinate == path.joints[i].coordinate; k++)
        sum[k] += f[0] * slope[3 * n + k];
    }
    for (int k = 0; k < m->coordinate_count; k++) z[k] = q[k];
    z[path.joints[i].coordinate] += 1e-40 * I;
    reference_point(m, link, local, z, moved);
    for (int k = 0; k < 3; k++) assert_close(sum[k], cimag(moved[k]) / 1e-40, 1e-11);
  }
  ambulo__pose_free(&pose);
  ambulo__path_free(&a, &path);
}

static void test_points_and_slopes(void **state) {
  (void)state;
  for (int index = 0; index < 60; index++) {
    device_case c;
    device_case_open(&c, index);
    double q[most_coordinates], local[3] = {0.1, -0.2, 0.3};
    for (int i = 0; i < c.d; i++) q[i] = c.q[i * AMBULO__LANES];
    for (int link = 0; link < c.model->link_count; link += 3)
      check_path(c.model, link, local, c.q, q);
    device_case_close(&c);
  }
}

static void test_the_deepest_link_in_common(void **state) {
  (void)state;
  device_case c;
  device_case_open(&c, 33);
  const ambulo_model *m = c.model;
  for (int a = 0; a < m->link_count; a++) {
    for (int b = 0; b < m->link_count; b++) {
      const int pair[2] = {a, b};
      int common = ambulo__path_common(m, pair), i = a, j = b;
      while (i >= 0 && i != common) i = m->links[i].parent;
      while (j >= 0 && j != common) j = m->links[j].parent;
      assert_int_equal(i, common);
      assert_int_equal(j, common);
      if (a == b) assert_int_equal(common, a);
    }
  }
  device_case_close(&c);
}

static int test_device_path_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_points_and_slopes),
                                     cmocka_unit_test(test_the_deepest_link_in_common)};
  return cmocka_run_group_tests_name("device/path", tests, NULL, NULL);
}

/* Efforts against the same laws in complex numbers, and their derivatives by everything. */

enum { laws = 400 };
static const double small = 1e-7;

static double effort_with(const ambulo_device *v, double s, double sd, double f) {
  return ambulo__effort_of(v, s, sd, f).value;
}

static void check_members(const ambulo_device *given, double s, double sd, double f) {
  ambulo__effort e = ambulo__effort_of(given, s, sd, f);
  ambulo_device v = *given;
#define BY(name)                                                                                   \
  do {                                                                                             \
    double *at = &v.name, kept = v.name;                                                           \
    v.name = kept + small;                                                                         \
    double up = effort_with(&v, s, sd, f);                                                         \
    v.name = kept - small;                                                                         \
    double difference = (up - effort_with(&v, s, sd, f)) / (2.0 * small);                          \
    *at = kept;                                                                                    \
    assert_close(e.by_##name, difference, 2e-5);                                                   \
  } while (0)
  if (v.kind == AMBULO_DEVICE_SPRING) {
    BY(stiffness);
    BY(rest);
    BY(pretension);
    if (v.side != AMBULO_DEVICE_BOTH) BY(smoothing);
  }
  if (v.kind == AMBULO_DEVICE_DAMPER) BY(damping);
  if (v.kind == AMBULO_DEVICE_ACTUATOR) BY(amount);
#undef BY
}

static void test_laws_and_their_derivatives(void **state) {
  (void)state;
  random_source source = {5};
  random_tree tree;
  ambulo_model *model = NULL;
  random_tree_make(&tree, 8, 6);
  assert_int_equal(ambulo_model_create(&tree.definition, NULL, NULL, &model), AMBULO_OK);
  for (int i = 0; i < laws; i++) {
    ambulo_device v;
    random_device(&source, model, &v);
    v.smoothing = random_between(&source, 0.2, 2);
    double s = random_between(&source, -0.5, 1.5), sd = random_between(&source, -3, 3);
    double f = random_between(&source, 0, 1);
    number energy;
    ambulo__effort e = ambulo__effort_of(&v, s, sd, f);
    assert_close(e.value, creal(reference_effort(&v, s, sd, f, &energy)), 1e-14);
    assert_close(e.by_along, cimag(reference_effort(&v, s + 1e-40 * I, sd, f, &energy)) / 1e-40,
                 1e-13);
    assert_close(e.by_rate, cimag(reference_effort(&v, s, sd + 1e-40 * I, f, &energy)) / 1e-40,
                 1e-13);
    assert_close(e.by_factor * f, e.value, 1e-13);
    check_members(&v, s, sd, f);
  }
  ambulo_model_free(model);
}

/* nothing below, the plain spring above, and no kink between */
static void test_one_side(void **state) {
  (void)state;
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  v.coordinate = 0;
  v.stiffness = 200;
  v.rest = 0.1;
  v.side = AMBULO_DEVICE_ABOVE;
  v.smoothing = 0.04;
  assert_true(effort_with(&v, 0.1 - 0.0200001, 0, 1) == 0.0);
  assert_close(effort_with(&v, 0.35, 0, 1), -200 * 0.25, 1e-15);
  assert_close(effort_with(&v, 0.12, 0, 1), -200 * 0.02, 1e-14);
  for (int end = 0; end < 2; end++) {
    double s = end ? 0.12 : 0.08;
    ambulo__effort in = ambulo__effort_of(&v, s + (end ? -1e-9 : 1e-9), 0, 1);
    ambulo__effort out = ambulo__effort_of(&v, s + (end ? 1e-9 : -1e-9), 0, 1);
    assert_close(in.by_along / 200, out.by_along / 200, 1e-9);
  }
  ambulo_device below = v;
  below.side = AMBULO_DEVICE_BELOW;
  for (double s = -0.2; s < 0.5; s += 0.013) {
    double both = effort_with(&v, s, 0, 1) + effort_with(&below, s, 0, 1);
    double mirrored = effort_with(&below, 0.2 - s, 0, 1);
    assert_close(mirrored, -effort_with(&v, s, 0, 1), 1e-12);
    assert_close(both, -200 * (s - 0.1), 1e-12);
  }
}

/* Everything at stiffness 0 is what it tends to: where the pull is straight in the stiffness, its
 * difference from there. */
static void test_no_stiffness(void **state) {
  (void)state;
  const double k = 1e-6, f = 0.7;
  for (int i = 0; i < 2 * 3 * 3 * 9; i++) {
    ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
    v.coordinate = i % 2 ? 3 : -1;
    v.side = (ambulo_device_side)(1 + i / 2 % 3);
    v.pretension = 8.0 * (i / 6 % 3 - 1);
    v.rest = 0.3;
    v.smoothing = 0.2;
    double s = 0.3 + 0.04 * (i / 18 - 4), g = v.coordinate >= 0 ? 1 : -1;
    ambulo__effort none = ambulo__effort_of(&v, s, 0, f);
    int pulls = v.side == AMBULO_DEVICE_BOTH ||
                (v.side == AMBULO_DEVICE_ABOVE ? v.pretension > 0 : v.pretension < 0);
    assert_close(none.value, pulls ? -g * f * v.pretension : 0.0, 1e-15);
    assert_true(none.by_along == 0.0 && none.by_rest == 0.0 && none.by_smoothing == 0.0);
    assert_close(none.by_factor * f, none.value, 1e-15);
    if (v.pretension != 0) assert_close(none.by_pretension, pulls ? -g * f : 0.0, 1e-15);
    v.stiffness = k;
    ambulo__effort some = ambulo__effort_of(&v, s, 0, f);
    assert_close(none.by_stiffness, (some.value - none.value) / k, 1e-8);
    assert_close(none.by_stiffness, some.by_stiffness, 1e-12);
    assert_close(none.by_pretension, some.by_pretension, 1e-12);
  }
}

static int test_device_law_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_laws_and_their_derivatives),
                                     cmocka_unit_test(test_one_side),
                                     cmocka_unit_test(test_no_stiffness)};
  return cmocka_run_group_tests_name("device/law", tests, NULL, NULL);
}

/* A point in motion: place, velocity and acceleration against 4 x 4 products in complex numbers,
 * and what each coordinate does to them by complex steps. */

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

static int test_hand_motion_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_motion_and_slopes)};
  return cmocka_run_group_tests_name("device/hand_motion", tests, NULL, NULL);
}

int main(void) {
  return test_device_path_tests() + test_device_law_tests() + test_hand_motion_tests();
}
