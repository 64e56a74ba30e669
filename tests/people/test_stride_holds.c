/* What hands hold over a stride: the mirrored step, peaks, work. */
#include "people/waving_stride.h"

static const char *const box =
    "load={name: box, hands: [hip_r, hip_l], mass: 10, inertia: 0.3, center: [0.1, 0, -0.1], "
    "force: [30, 0, 5]}";

static const double *force_of(const ambulo__stride *s, int k, int hand) {
  return s->hold_force + 6 * k + 3 * hand;
}

/* at a phase of the second step hands have what the others had at that of the first */
static void test_a_mirrored_stride(void **state) {
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_mirrored_stride),
                                     cmocka_unit_test(test_nothing_held)};
  return cmocka_run_group_tests_name("stride/stride_holds", tests, NULL, NULL);
}
