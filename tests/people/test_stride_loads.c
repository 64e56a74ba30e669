/* Forces on the feet in a mirrored stride: models/walk_normal.yaml at a gentle made-up point. */
#include "base/text_buffer.h"
#include "ambulo/tools/load.h"
#include "formats/motion_write.h"
#include "people/stride.h"
#include "people/waving_stride.h"
#include "support/test.h"

typedef struct fixture {
  ambulo_problem *problem;
  double *x;
  ambulo__stride stride;
} fixture;

static void fixture_open(fixture *f) {
  memset(f, 0, sizeof *f);
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", NULL, 0, NULL, NULL, &f->problem),
      AMBULO_OK);
  int n = f->problem->variables, d = f->problem->coordinates;
  f->x = calloc((size_t)n, sizeof *f->x);
  for (int i = 0; i < n; i++)
    f->x[i] = (i % d < 3 ? 0.01 : 0.1) * sin(0.3 * (i / d) + 1.7 * (i % d));
  f->problem->definition.rise = 0.17; /* as on stairs */
  assert_int_equal(ambulo__stride_create(f->problem, f->x, 0, NULL, &f->stride), AMBULO_OK);
  assert_int_equal(f->stride.feet, 2);
}

static void fixture_close(fixture *f) {
  ambulo__stride_free(&f->stride);
  free(f->x);
  ambulo_problem_free(f->problem);
}

/* about the origin: of the force at its centre of pressure, with what turns about the normal */
static void expect_moment(const ambulo__stride *s, int at) {
  const double *f = s->grf + 3 * at, *p = s->cop + 3 * at;
  if (!isfinite(p[0])) return;
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    double twist = i == 1 ? s->free_moment[at] : 0.0;
    assert_close(s->grf_moment[3 * at + i], p[j] * f[k] - p[k] * f[j] + twist, 1e-9);
  }
}

/* node 25 + k is node k with the feet exchanged; z is to the right, x forward */
static void feet_change_sides(void **state) {
  (void)state;
  fixture f;
  fixture_open(&f);
  const ambulo__stride *s = &f.stride;
  assert_int_equal(s->samples, 51);
  for (int k = 1; k <= 25; k++) {
    for (int foot = 0; foot < 2; foot++) {
      int here = 2 * (25 + k) + 1 - foot, there = 2 * k + foot;
      for (int i = 0; i < 3; i++) {
        double sign = i == 2 ? -1.0 : 1.0, shift = i == 0 ? 0.68 : i == 1 ? 0.17 : 0.0;
        assert_close(s->grf[3 * here + i], sign * s->grf[3 * there + i], 1e-9);
        if (isfinite(s->cop[3 * there + i]))
          assert_close(s->cop[3 * here + i], sign * s->cop[3 * there + i] + shift, 1e-12);
      }
      assert_close(s->free_moment[here], -s->free_moment[there], 1e-9);
      expect_moment(s, here);
      expect_moment(s, there);
    }
  }
  fixture_close(&f);
}

/* up a stair the second step is as high as the ends rise: its places, no force */
static void places_rise_with_the_ends(void **state) {
  (void)state;
  fixture level, stairs;
  fixture_open(&level);
  fixture_open(&stairs);
  ambulo__stride_free(&level.stride);
  level.problem->definition.rise = 0.0;
  assert_int_equal(ambulo__stride_create(level.problem, level.x, 0, NULL, &level.stride),
                   AMBULO_OK);
  ambulo__stride_free(&stairs.stride);
  stairs.problem->definition.rise = 0.25;
  assert_int_equal(ambulo__stride_create(stairs.problem, stairs.x, 0, NULL, &stairs.stride),
                   AMBULO_OK);
  const ambulo__stride *a = &level.stride, *b = &stairs.stride;
  int compared = 0;
  for (int k = 1; k < a->samples; k++) {
    double rise = k > 25 ? 0.25 - level.problem->definition.rise : 0.0;
    for (int i = 0; i < 6; i++) {
      double up = i % 3 == 1 ? rise : 0.0;
      assert_close(b->grf[6 * k + i], a->grf[6 * k + i], 0.0);
      if (i < 3 && isfinite(a->zmp[3 * k + i]))
        assert_close(b->zmp[3 * k + i], a->zmp[3 * k + i] + up, 1e-12);
      if (!isfinite(a->cop[6 * k + i])) continue;
      assert_close(b->cop[6 * k + i], a->cop[6 * k + i] + up, 1e-12);
      compared += rise > 0.0;
    }
  }
  assert_true(compared > 20);
  fixture_close(&level);
  fixture_close(&stairs);
}

static void forces_and_peaks(void **state) {
  (void)state;
  fixture f;
  fixture_open(&f);
  ambulo__stride *s = &f.stride;
  for (int k = 0; k < s->samples; k++) {
    double *force = s->grf + 6 * k;
    force[0] = 100.0;
    force[1] = 10.0 * k;
    force[2] = 0.0;
  }
  assert_close(ambulo__stride_peak(s, 0), 500.0 / (75.0 * 9.81), 1e-9);
  assert_close(ambulo__stride_force(s, 3, 0, ambulo_model_forward(s->model)), 100.0 / (75.0 * 9.81),
               1e-9);
  fixture_close(&f);
}

static void the_table_has_their_columns(void **state) {
  (void)state;
  fixture f;
  fixture_open(&f);
  const ambulo__stride *s = &f.stride;
  ambulo__motion_table table = {.model = s->model,
                                .name = "walk",
                                .samples = 2,
                                .times = s->times,
                                .q = s->q,
                                .qd = s->qd,
                                .qdd = s->qdd,
                                .tau = s->tau,
                                .zmp = s->zmp,
                                .feet = s->feet,
                                .grf = s->grf,
                                .cop = s->cop,
                                .free_moment = s->free_moment,
                                .grf_moment = s->grf_moment};
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_csv(&table, &text);
  const char *csv = ambulo__text_data(&text);
  const char *expected = ",zmp.x,zmp.y,zmp.z,grf.right.x,grf.right.y,grf.right.z,cop.right.x,"
                         "cop.right.y,cop.right.z,free_moment.right,moment.right.x,"
                         "moment.right.y,moment.right.z,grf.left.x,grf.left.y,"
                         "grf.left.z,cop.left.x,cop.left.y,cop.left.z,free_moment.left,"
                         "moment.left.x,moment.left.y,moment.left.z\n";
  assert_non_null(strstr(csv, expected));
  /* as many numbers as names */
  const char *header = strstr(csv, "\ntime") + 1, *row = strchr(header, '\n') + 1;
  int names = 0, numbers = 0;
  for (const char *c = header; *c != '\n'; c++) names += *c == ',';
  for (const char *c = row; *c != '\n'; c++) numbers += *c == ',';
  assert_int_equal(names, 4 * 18 + 3 + 20);
  assert_int_equal(numbers, names);
  ambulo__text_free(&text);
  fixture_close(&f);
}

static int test_stride_feet_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(feet_change_sides), cmocka_unit_test(forces_and_peaks),
      cmocka_unit_test(places_rise_with_the_ends), cmocka_unit_test(the_table_has_their_columns)};
  return cmocka_run_group_tests_name("stride/stride_feet", tests, NULL, NULL);
}

/* Devices over a stride: the mirrored step, and work that a spring gives back. */

static const char *const worn =
    "devices=[{name: exo_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, rest: -60, "
    "side: above, mirror: true}, {name: twist, kind: spring, coordinate: lumbar_rotation, "
    "stiffness: 30, rest: 0}, {name: band, kind: spring, between: [{link: foot_r, position: [0.04, "
    "0, 0]}, {link: foot_l, position: [0.04, 0, 0]}], stiffness: 120, rest: 0.2}]";

/* the state of the spring at each sample: what it holds is what went in */
static void test_a_mirrored_stride(void **state) {
  (void)state;
  waving_stride waving;
  open_waving_stride(&waving, worn, 2001);
  const ambulo_problem *p = waving.problem;
  const ambulo__stride s = waving.stride;
  int d = s.coordinates, n = s.devices;
  int ankle[2] = {ambulo_model_find_coordinate(p->model, "ankle_angle_r"),
                  ambulo_model_find_coordinate(p->model, "ankle_angle_l")};
  int twist = ambulo_model_find_coordinate(p->model, "lumbar_rotation");
  assert_int_equal(n, 4);
  for (int k = 0; k < s.samples; k += 7) {
    for (int side = 0; side < 2; side++) {
      double q = s.q[k * d + ankle[side]];
      int v = side ? 3 : 0;
      assert_close(s.along[k * n + v], q, 1e-12);
      assert_close(s.effort[k * n + v], -150 * (q + acos(-1) / 3), 1e-10);
      assert_close(s.power[k * n + v], s.effort[k * n + v] * s.qd[k * d + ankle[side]], 1e-10);
    }
    assert_close(s.along[k * n + 1], s.q[k * d + twist], 1e-12);
    assert_close(s.effort[k * n + 1], -30 * s.q[k * d + twist], 1e-12);
    assert_close(s.effort[k * n + 2], 120 * (s.along[k * n + 2] - 0.2), 1e-10);
  }
  for (int v = 0; v < n; v++) {
    double stiffness[] = {150, 30, 120, 150}, rest[] = {-acos(-1) / 3, 0, 0.2, -acos(-1) / 3};
    ambulo__device_work work = ambulo__stride_device_work(&s, v);
    double first = s.along[v] - rest[v], last = s.along[(s.samples - 1) * n + v] - rest[v];
    double peak = 0, stored = 0.5 * stiffness[v] * (last * last - first * first);
    for (int k = 0; k < s.samples; k++) peak = fmax(peak, fabs(s.effort[k * n + v]));
    assert_close(fabs(work.peak), peak, 0);
    assert_true(work.positive > 0 && work.negative < 0);
    /* the motion is no gait: from one step to the next its state jumps */
    double middle = s.along[1000 * n + v] - rest[v], after = s.along[1001 * n + v] - rest[v];
    double jump = 0.5 * stiffness[v] * (after * after - middle * middle);
    assert_close((work.positive + work.negative + stored - jump) / work.positive, 0, 0.02);
  }
  close_waving_stride(&waving);
}

static void test_no_devices_no_arrays(void **state) {
  (void)state;
  waving_stride still;
  open_waving_stride(&still, NULL, 0);
  assert_int_equal(still.stride.devices, 0);
  assert_null(still.stride.effort);
  close_waving_stride(&still);
}

static int test_stride_devices_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_mirrored_stride),
                                     cmocka_unit_test(test_no_devices_no_arrays)};
  return cmocka_run_group_tests_name("stride/stride_devices", tests, NULL, NULL);
}

/* What hands hold over a stride: the mirrored step, peaks, work. */

static const char *const box =
    "load={name: box, hands: [hip_r, hip_l], mass: 10, inertia: 0.3, center: [0.1, 0, -0.1], "
    "force: [30, 0, 5]}";

static const double *force_of(const ambulo__stride *s, int k, int hand) {
  return s->hold_force + 6 * k + 3 * hand;
}

/* at a phase of the second step hands have what the others had at that of the first */
static void test_stride_holds_test_a_mirrored_stride(void **state) {
  (void)state;
  waving_stride waving;
  double work[2], sum = 0, most = 0, least = 0;
  open_waving_stride(&waving, box, 401);
  const ambulo__stride s = waving.stride;
  assert_int_equal(s.holds, 1);
  for (int k = 0; k <= 200; k++) {
    /* axes of the model: forward, up, to the right */
    const double mirror[3] = {1, 1, -1};
    int other = k + 200;
    if (k == 0) continue; /* of the two states at the middle the first one is shown */
    for (int hand = 0; hand < 2; hand++)
      for (int i = 0; i < 3; i++) {
        assert_close(force_of(&s, other, hand)[i], mirror[i] * force_of(&s, k, 1 - hand)[i], 1e-9);
        assert_close(s.hold_moment[6 * other + 3 * hand + i],
                     -mirror[i] * s.hold_moment[6 * k + 3 * (1 - hand) + i], 1e-9);
        least = fmax(least, fabs(s.hold_moment[6 * k + i]));
      }
    assert_close(s.hold_power[other], s.hold_power[k], 1e-9);
  }
  assert_true(least > 0.1);
  ambulo__hand_peak peak = ambulo__stride_hand_peak(&s, 0, 1);
  for (int k = 0; k < s.samples; k++) {
    const double *f = force_of(&s, k, 1);
    double force = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    double half = k == 0 || k == 400 ? 0.5 : 1;
    most = fmax(most, force);
    sum += half * s.duration / 400 * s.hold_power[k];
    if (force == peak.force) assert_close(peak.force_time, s.times[k], 0);
  }
  assert_close(peak.force, most, 0);
  assert_true(peak.moment > 0 && peak.moment <= 2 * least);
  ambulo__stride_hold_work(&s, 0, work);
  assert_true(work[0] > 0 && work[1] < 0);
  assert_close(work[0] + work[1], sum, 1e-9);
  close_waving_stride(&waving);
}

static void test_nothing_held(void **state) {
  (void)state;
  waving_stride still;
  open_waving_stride(&still, NULL, 0);
  assert_true(still.stride.holds == 0 && !still.stride.hold_force && !still.stride.hold_power);
  close_waving_stride(&still);
}

static int test_stride_holds_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_stride_holds_test_a_mirrored_stride),
                                     cmocka_unit_test(test_nothing_held)};
  return cmocka_run_group_tests_name("stride/stride_holds", tests, NULL, NULL);
}

int main(void) {
  return test_stride_feet_tests() + test_stride_devices_tests() + test_stride_holds_tests();
}
