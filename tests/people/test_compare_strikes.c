/* Strikes by reach: in people's published means, in noise, in slow walks; and the text of given
 * ones. */
#include "people/compare_people.h"
#include "people/compare_subject.h"
#include "support/messages.h"
#include "support/test.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

enum { STRIDES = 5 };
static const double rad = 0.017453292519943295;

static double mean_at(const ambulo__people *people, const char *curve, double share) {
  const ambulo__reference *r = &people->files[0].reference;
  for (int i = 0; i < r->count; i++) {
    if (strcmp(r->curves[i].entry->curve, curve) != 0) continue;
    double at = 50.0 * share;
    int k = at >= 50.0 ? 49 : (int)at;
    const double *m = r->curves[i].mean + k;
    return m[0] + (at - k) * (m[1] - m[0]);
  }
  fail();
  return 0.0;
}

/* between -1 and 1, the same in every run */
static double noise(unsigned *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 8388608.0 - 1.0;
}

/* the means of young adults, one cycle after the other, at 100 Hz; noise in degrees */
static ambulo__subject people_walk(double stride, double rough) {
  static const char *const names[] = {"q.pelvis_tilt", "q.hip_flexion_l", "q.knee_angle_l"};
  ambulo__subject s = {.file = "people"};
  ambulo__people people;
  unsigned seed = 7;
  int rows = (int)(STRIDES * stride * 100.0) + 15;
  s.allocator = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__norms_read(AMBULO_SOURCE_DIR "/models/norms", NULL, NULL, &people),
                   AMBULO_OK);
  assert_int_equal(ambulo__motion_create(rows, 3, names, NULL, &s.table), AMBULO_OK);
  for (int k = 0; k < rows; k++) {
    double t = 0.01 * k, share = t / stride - floor(t / stride), *row = s.table->values + 3 * k;
    s.table->time[k] = t;
    row[0] = -rad * mean_at(&people, "pelvis_anterior_tilt", share);
    row[1] = rad * mean_at(&people, "hip_flexion", share);
    row[2] = rad * mean_at(&people, "knee_flexion", share);
    for (int c = 0; c < 3; c++) row[c] += rad * rough * noise(&seed);
  }
  ambulo__people_free(&people);
  return s;
}

static void within_two_percent(void **state) {
  (void)state;
  static const struct {
    double stride, rough, share;
  } cases[] = {{1.1, 0.0, 0.02}, {0.8, 0.0, 0.02}, {2.5, 0.0, 0.02}, {1.1, 0.5, 0.03}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo__subject s = people_walk(cases[i].stride, cases[i].rough);
    double strikes[64];
    int count = 0;
    assert_int_equal(ambulo__subject_reach(&s, 0, strikes, 64, &count), AMBULO_OK);
    if (count != STRIDES) print_error("case %zu\n", i);
    assert_int_equal(count, STRIDES);
    for (int k = 0; k < count; k++) {
      double share = strikes[k] / cases[i].stride - (k + 1);
      if (!(fabs(share) < cases[i].share)) print_error("%zu: %g\n", i, share);
      assert_true(fabs(share) < cases[i].share);
    }
    assert_int_equal(ambulo__subject_reach(&s, 1, strikes, 64, &count), AMBULO_OK);
    assert_int_equal(count, 0); /* no right leg */
    assert_int_equal(ambulo__subject_reach(&s, 0, strikes, 2, &count), AMBULO_OK);
    assert_int_equal(count, 2);
    ambulo__motion_free(s.table);
  }
}

static void given(void **state) {
  (void)state;
  double t[4];
  int count = -1;
  assert_int_equal(ambulo__subject_given("right=2;left=0.5,1.5e0,3", 0, "m", NULL, t, 4, &count),
                   AMBULO_OK);
  assert_int_equal(count, 3);
  assert_close(t[1], 1.5, 0.0);
  assert_int_equal(ambulo__subject_given("right=2;left=0.5", 1, "m", NULL, t, 4, &count),
                   AMBULO_OK);
  assert_int_equal(count, 1);
  assert_int_equal(ambulo__subject_given(NULL, 1, "m", NULL, t, 4, &count), AMBULO_OK);
  assert_int_equal(count, 0);
  static const char *const wrong[] = {"left=",     "left=1,",    "left=1,x", "left=2,1",
                                      "paw=1",     "left=1;=2",  "left=1 2", "left=nan",
                                      "left=1,,2", "left=1;left"};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_status status = ambulo__subject_given(wrong[i], 0, "m", list, t, 4, &count);
    if (status != AMBULO_E_ARGUMENT) print_error("%s is taken\n", wrong[i]);
    assert_int_equal(status, AMBULO_E_ARGUMENT);
    assert_message(list, 0, "expected left=T,T,...");
    ambulo_diagnostics_free(list);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(within_two_percent), cmocka_unit_test(given)};
  return cmocka_run_group_tests_name("compare/compare_strikes", tests, NULL, NULL);
}
