/* Where a foot is in its stride, in motions that repeat and in one that does not. */
#include "base/lanes.h"
#include "contact/devices.h"
#include "contact/schedule.h"
#include "support/planar_walker.h"
#include "support/test.h"

static ambulo_contact held(int foot, ambulo_contact_mode mode, double from, double to) {
  return (ambulo_contact){.foot = foot, .mode = mode, .from = from, .to = to, .patch = -1};
}

static ambulo_problem_definition walk_of(ambulo_model *model, ambulo_ends ends, double duration,
                                         const ambulo_contact *contacts, int count) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.duration = duration;
  d.ends = ends;
  d.contacts = contacts;
  d.contact_count = count;
  return d;
}

/* one step of 0.5 s: the left foot strikes at 0, the right did half a stride before */
static void test_a_mirrored_step(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  const ambulo_contact contacts[] = {held(1, AMBULO_CONTACT_HEEL, 0, 0.1),
                                     held(1, AMBULO_CONTACT_FLAT, 0.1, 0.5),
                                     held(0, AMBULO_CONTACT_TOE, 0, 0.12)};
  ambulo_problem_definition d = walk_of(model, AMBULO_ENDS_MIRRORED, 0.5, contacts, 3);
  ambulo__stride_now now;
  for (double t = 0; t < 0.5; t += 0.049) {
    assert_int_equal(ambulo__stride_at(&d, 1, t, &now), 1);
    assert_close(now.share, t, 1e-12);
    assert_close(now.begin[1], 1.0, 1e-12);
    assert_int_equal(now.contact[0], 0);
    assert_int_equal(now.contact[1], 0);
    assert_int_equal(ambulo__stride_at(&d, 0, t, &now), 1);
    assert_close(now.share, 0.5 + t, 1e-12);
    assert_close(now.begin[0], -0.5, 1e-12);
  }
  assert_int_equal(ambulo__stride_at(&d, 0, 0.5, &now), 1);
  assert_close(now.share, 0, 1e-12);
  ambulo_model_free(model);
}

static void test_two_unlike_steps(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  const ambulo_contact contacts[] = {held(0, AMBULO_CONTACT_FLAT, 0.3, 0.9),
                                     held(1, AMBULO_CONTACT_FLAT, 0, 0.4),
                                     held(1, AMBULO_CONTACT_FLAT, 0.8, 1)};
  ambulo_problem_definition d = walk_of(model, AMBULO_ENDS_PERIODIC, 1, contacts, 3);
  ambulo__stride_now now;
  assert_int_equal(ambulo__stride_at(&d, 0, 0.25, &now), 1);
  assert_close(now.share, 0.95, 1e-12);
  assert_int_equal(ambulo__stride_at(&d, 1, 0.25, &now), 1); /* came down at -0.2 */
  assert_close(now.share, 0.45, 1e-12);
  assert_int_equal(now.contact[0], 2);
  assert_int_equal(now.contact[1], 2);
  d.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo__stride_at(&d, 0, 0.5, &now), 0);
  ambulo_model_free(model);
}

static void test_a_foot_that_stays_down_has_no_stride(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  const ambulo_contact contact = held(0, AMBULO_CONTACT_FLAT, 0, 1);
  ambulo_problem_definition d = walk_of(model, AMBULO_ENDS_PERIODIC, 1, &contact, 1);
  ambulo__stride_now now;
  assert_int_equal(ambulo__stride_at(&d, 0, 0.5, &now), 0);
  assert_int_equal(ambulo__stride_at(&d, 1, 0.5, &now), 0);
  ambulo_model_free(model);
}

static int test_stride_clock_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_mirrored_step),
                                     cmocka_unit_test(test_two_unlike_steps),
                                     cmocka_unit_test(test_a_foot_that_stays_down_has_no_stride)};
  return cmocka_run_group_tests_name("gait/stride_clock", tests, NULL, NULL);
}

/* Windows of what is held: their ramps, their ends, their events. */

static ambulo_hold test_hold_times_held(double from, double to) {
  ambulo_hold h = ambulo_hold_default();
  h.name = "box";
  h.hand[0] = 0;
  h.mass = 1;
  h.from = from;
  h.to = to;
  h.ramp = 0.2;
  return h;
}

static void test_a_window(void **state) {
  (void)state;
  ambulo_hold h = test_hold_times_held(0.5, 1.5);
  const double times[] = {0, 0.5, 0.55, 0.6, 0.7, 1, 1.3, 1.4, 1.5, 2};
  const double want[] = {0, 0, 0.15625, 0.5, 1, 1, 1, 0.5, 0, 0};
  for (int i = 0; i < 10; i++) assert_close(ambulo__hold_window(&h, 2, times[i]), want[i], 1e-12);
}

/* what is held from the beginning, or to the end, is held whole there */
static void test_open_ends(void **state) {
  (void)state;
  ambulo_hold all = test_hold_times_held(0, INFINITY), first = test_hold_times_held(-1, 1),
              last = test_hold_times_held(1, 2);
  double time[4];
  for (int i = 0; i <= 20; i++) assert_close(ambulo__hold_window(&all, 2, 0.1 * i), 1, 0);
  assert_int_equal(ambulo__hold_events(&all, 2, time), 0);
  assert_close(ambulo__hold_window(&first, 2, 0), 1, 0);
  assert_close(ambulo__hold_window(&first, 2, 0.9), 0.5, 1e-12);
  assert_int_equal(ambulo__hold_events(&first, 2, time), 2);
  assert_close(time[0], 0.8, 1e-15);
  assert_close(time[1], 1, 0);
  assert_close(ambulo__hold_window(&last, 2, 2), 1, 0);
  assert_int_equal(ambulo__hold_events(&last, 2, time), 2);
  assert_close(time[1], 1.2, 1e-15);
}

/* ends of ramps are nodes of a grid on events, and no knots */
static void test_events_of_the_grid(void **state) {
  (void)state;
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = planar_walker_create();
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  ambulo_hold h = test_hold_times_held(0.5, 1.5);
  ambulo__events events;
  d.model = model;
  d.duration = 2;
  d.holds = &h;
  d.hold_count = 1;
  assert_int_equal(ambulo__events_create(&d, AMBULO__EVENTS_OF_ROWS, &a, &events), AMBULO_OK);
  const double want[] = {0.5, 0.7, 1.3, 1.5};
  assert_int_equal(events.count, 4);
  for (int i = 0; i < 4; i++) assert_close(events.time[i], want[i], 1e-15);
  ambulo__free(&a, events.time);
  assert_int_equal(ambulo__events_create(&d, AMBULO__EVENTS_OF_CONTACTS, &a, &events), AMBULO_OK);
  assert_int_equal(events.count, 0);
  ambulo__free(&a, events.time);
  ambulo_model_free(model);
}

static int test_hold_times_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_window),
                                     cmocka_unit_test(test_open_ends),
                                     cmocka_unit_test(test_events_of_the_grid)};
  return cmocka_run_group_tests_name("gait/hold_times", tests, NULL, NULL);
}

/* Profiles and windows: values, no overshoot, and slopes by differences. */

static const double points[][2] = {{0.1, -1}, {0.3, 2}, {0.35, 2.5}, {0.8, 2.5}, {0.9, 0}};
enum { point_count = 5 };

static void test_curves_go_through_their_points(void **state) {
  (void)state;
  for (int repeats = 0; repeats < 2; repeats++) {
    double slope;
    for (int i = 0; i < point_count; i++)
      assert_close(ambulo__device_curve(points, point_count, repeats, points[i][0], &slope),
                   points[i][1], 1e-14);
    for (double x = -1.2; x < 2.3; x += 0.0137) {
      double value = ambulo__device_curve(points, point_count, repeats, x, &slope), none;
      double up = ambulo__device_curve(points, point_count, repeats, x + 1e-6, &none);
      double down = ambulo__device_curve(points, point_count, repeats, x - 1e-6, &none);
      assert_true(value >= -1 - 1e-12 && value <= 2.5 + 1e-12);
      assert_close(slope, (up - down) / 2e-6, 1e-2); /* it bends at points */
      if (repeats)
        assert_close(value, ambulo__device_curve(points, point_count, 1, x + 3, &none), 1e-12);
    }
  }
  double slope;
  assert_close(ambulo__device_curve(points, point_count, 0, -5, &slope), -1, 0);
  assert_close(ambulo__device_curve(points, point_count, 0, 5, &slope), 0, 0);
  assert_close(ambulo__device_curve(points, 1, 1, 0.77, &slope), -1, 0);
  assert_true(slope == 0.0);
}

/* a stride of the right foot from 0.2 s to 1.3 s, over 1.1 s and so on */
static ambulo_problem_definition strides(const ambulo_model *model, ambulo_contact contact[2],
                                         ambulo_device *device) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  contact[0] =
      (ambulo_contact){.foot = 0, .mode = AMBULO_CONTACT_FLAT, .from = 0.2, .to = 0.9, .patch = -1};
  contact[1] =
      (ambulo_contact){.foot = 1, .mode = AMBULO_CONTACT_FLAT, .from = 0.7, .to = 1.1, .patch = -1};
  d.model = model;
  d.duration = 1.1;
  d.ends = AMBULO_ENDS_PERIODIC;
  d.contacts = contact;
  d.contact_count = 2;
  d.devices = device;
  d.device_count = 1;
  return d;
}

static void test_a_clutch_opens_and_closes(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_contact contact[2];
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_SPRING);
  ambulo_problem_definition d = strides(model, contact, &v);
  v.clutch = 1;
  v.foot = 0;
  v.from = 0.8;
  v.to = 0.3;
  v.ramp = 0.1;
  double begin = 0.2, stride = 1.1;
  assert_close(ambulo__device_told_at(&d, 0, begin + 0.5 * stride).factor, 0, 0);
  assert_close(ambulo__device_told_at(&d, 0, begin + 0.79 * stride).factor, 0, 0);
  assert_close(ambulo__device_told_at(&d, 0, begin + 0.85 * stride).factor, 0.5, 1e-12);
  assert_close(ambulo__device_told_at(&d, 0, begin + 0.95 * stride).factor, 1, 1e-12);
  assert_close(ambulo__device_told_at(&d, 0, begin).factor, 1, 1e-12);
  assert_close(ambulo__device_told_at(&d, 0, begin + 0.25 * stride).factor, 0.5, 1e-12);
  for (double t = 0.013; t < 1.1; t += 0.05) {
    ambulo__device_told told = ambulo__device_told_at(&d, 0, t);
    double up = ambulo__device_told_at(&d, 0, t + 1e-7).factor;
    double down = ambulo__device_told_at(&d, 0, t - 1e-7).factor;
    assert_close(told.by_time, (up - down) / 2e-7, 1e-5);
    double *members[] = {&v.from, &v.to, &v.ramp};
    double by[] = {told.by_from, told.by_to, told.by_ramp};
    for (int i = 0; i < 3; i++) {
      *members[i] += 1e-7;
      up = ambulo__device_told_at(&d, 0, t).factor;
      *members[i] -= 2e-7;
      down = ambulo__device_told_at(&d, 0, t).factor;
      *members[i] += 1e-7;
      assert_close(by[i], (up - down) / 2e-7, 1e-5);
    }
    contact[0].from += 1e-7; /* both strikes around t are its images */
    up = ambulo__device_told_at(&d, 0, t).factor;
    contact[0].from -= 2e-7;
    down = ambulo__device_told_at(&d, 0, t).factor;
    contact[0].from += 1e-7;
    assert_close(told.by_strike[0] + told.by_strike[1], (up - down) / 2e-7, 1e-5);
    assert_int_equal(told.contact[0], 0);
    assert_int_equal(told.contact[1], 0);
    assert_close(told.strike[1] - told.strike[0], stride, 1e-12);
  }
  ambulo_model_free(model);
}

static void test_profiles_and_padding(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  ambulo_contact contact[2];
  ambulo_device v = ambulo_device_default(AMBULO_DEVICE_ACTUATOR);
  ambulo_problem_definition d = strides(model, contact, &v);
  v.points = points;
  v.point_count = point_count;
  v.clock = AMBULO_DEVICE_BY_TIME;
  const double times[] = {0, 0.1, 0.35, 1.0};
  ambulo_allocator a = ambulo__allocator_or_default(NULL);
  double *told = NULL, slope;
  assert_int_equal(ambulo__devices_tell(&d, &a, times, 4, &told), AMBULO_OK);
  for (int k = 0; k < AMBULO__LANES; k++)
    assert_close(told[k],
                 ambulo__device_curve(points, point_count, 0, times[k < 4 ? k : 3], &slope), 0);
  ambulo__free_aligned(&a, told);
  v.clock = AMBULO_DEVICE_BY_STRIDE;
  v.foot = 1;
  for (double t = 0.02; t < 1.1; t += 0.07) {
    ambulo__device_told at = ambulo__device_told_at(&d, 0, t);
    assert_close(at.factor, ambulo__device_curve(points, point_count, 1, (t - 0.7) / 1.1, &slope),
                 1e-12);
    assert_close(at.by_time, slope / 1.1, 1e-10);
  }
  d.device_count = 0;
  assert_int_equal(ambulo__devices_tell(&d, &a, times, 4, &told), AMBULO_OK);
  assert_null(told);
  ambulo_model_free(model);
}

static int test_load_profile_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_curves_go_through_their_points),
                                     cmocka_unit_test(test_a_clutch_opens_and_closes),
                                     cmocka_unit_test(test_profiles_and_padding)};
  return cmocka_run_group_tests_name("device/told", tests, NULL, NULL);
}

int main(void) {
  return test_stride_clock_tests() + test_hold_times_tests() + test_load_profile_tests();
}
