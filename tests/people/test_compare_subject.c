/* A person's own motion: which strikes count, and what is refused. */
#include "people/compare.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/subject_motion.h"
#include "support/test.h"

static ambulo_status open_with(const char *file, const char *forces, const char *strikes,
                               ambulo_diagnostics *list, ambulo__subject *s) {
  ambulo_compare_options options = ambulo_compare_options_default();
  options.forces = forces;
  options.strikes = strikes;
  return ambulo__subject_open(file, &options, NULL, list, s);
}

static void by_reach(void **state) {
  ambulo__subject s;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  double late = (subject_reach_peak() + 0.02) * subject_stride;
  assert_int_equal(open_with(subject_plain(state), NULL, NULL, list, &s), AMBULO_OK);
  for (int side = 0; side < 2; side++) {
    assert_in_range(s.count[side], 4, 5);
    for (int i = 0; i < s.count[side]; i++) {
      double t = s.strikes[side][i] - late - subject_first[side];
      assert_close(t - subject_stride * round(t / subject_stride), 0.0, 2e-3);
      assert_int_equal(s.loaded[side][i], 0);
    }
  }
  assert_message(list, 0, "left foot, strides: 4, of 1.20 to 1.20 s");
  assert_message(list, 0, "sure to some 2 percent");
  ambulo__subject_free(&s);
  ambulo_diagnostics_free(list);
}

static void by_force(void **state) {
  ambulo__subject s;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *motion = subject_plain(state);
  const char *forces = subject_forces(state, "ground_force_l", "ground_force_r", 0.0);
  assert_int_equal(open_with(motion, forces, NULL, list, &s), AMBULO_OK);
  for (int side = 0; side < 2; side++) {
    assert_true(s.count[side] >= 4);
    for (int i = 0; i < s.count[side]; i++) {
      double t = s.strikes[side][i] - subject_first[side];
      /* 20 of 700 N are reached within 7 ms */
      assert_in_range((int)(1e4 * (t - subject_stride * floor(t / subject_stride))), 10, 100);
      assert_int_equal(s.loaded[side][i], i + 1 < s.count[side]);
    }
  }
  assert_message(list, 0, "strikes where the force begins");
  ambulo__subject_free(&s);
  ambulo_diagnostics_free(list);
}

/* a plate that is hit once: that strike takes its time, the others stay */
static void one_hit_of_a_plate(void **state) {
  ambulo__subject s;
  const char *motion = subject_plain(state);
  const char *forces = subject_forces(state, "ground_force_l", "ground_force_r", -4.25);
  assert_int_equal(open_with(motion, forces, NULL, NULL, &s), AMBULO_OK);
  int loaded = 0;
  for (int i = 0; i < s.count[0]; i++) {
    loaded += s.loaded[0][i];
    if (s.loaded[0][i]) assert_close(s.strikes[0][i], 0.5, 0.01);
  }
  assert_int_equal(loaded, 1);
  ambulo__subject_free(&s);
}

static void given(void **state) {
  ambulo__subject s;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *motion = subject_plain(state);
  assert_int_equal(open_with(motion, NULL, "left=0.25,1.5,9;right=2,3.25", list, &s), AMBULO_OK);
  assert_int_equal(s.count[0], 2); /* 9 s is after the motion */
  assert_int_equal(s.count[1], 2);
  assert_close(s.strikes[0][1], 1.5, 0.0);
  assert_close(s.strikes[1][0], 2.0, 0.0);
  assert_message(list, 0, "strikes as given");
  ambulo__subject_free(&s);
  assert_int_equal(open_with(motion, NULL, "left=0.2,0.9,3", list, &s), AMBULO_OK);
  assert_message(list, 3, "strides of the left foot last from 0.70 to 2.10 s");
  ambulo__subject_free(&s);
  ambulo_diagnostics_free(list);
}

static void refusals(void **state) {
  ambulo__subject s;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *path = scratch_path(state, "still.csv");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "# inDegrees=yes\ntime,hip_flexion_l,knee_angle_l\n");
  for (int k = 0; k < 20; k++) fprintf(f, "%d,10,5\n", k);
  assert_int_equal(fclose(f), 0);
  assert_int_equal(open_with(path, NULL, NULL, list, &s), AMBULO_E_SCHEMA);
  assert_message(list, 0, "no whole stride: 0 strikes of the left foot and 0 of the right one");
  f = fopen(path, "w"); /* sways */
  assert_non_null(f);
  fprintf(f, "# inDegrees=yes\ntime,hip_flexion_l,knee_angle_l\n");
  for (int k = 0; k < 500; k++) fprintf(f, "%g,%.9g,5\n", 0.01 * k, 2.0 * sin(0.06 * k));
  assert_int_equal(fclose(f), 0);
  assert_int_equal(open_with(path, NULL, NULL, list, &s), AMBULO_E_SCHEMA);
  scratch_write(path, "time,knee_angle_l\n0,1\n1,1\n");
  assert_int_equal(open_with(path, NULL, NULL, list, &s), AMBULO_E_SCHEMA);
  assert_message(list, 2, "2 times; expected at least 5");
  assert_int_equal(open_with("/no/such.csv", NULL, NULL, list, &s), AMBULO_E_IO);
  assert_int_equal(open_with(subject_plain(state), "/no/such.mot", NULL, list, &s), AMBULO_E_IO);
  ambulo_diagnostics_free(list);
}

static void memory_runs_out(void **state) {
  const char *motion = subject_plain(state);
  ambulo_compare_options options = ambulo_compare_options_default();
  options.forces = subject_forces(state, "ground_force_l", "ground_force_r", 0.0);
  for (long k = 0; k < 10000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__subject s;
    ambulo_status status = ambulo__subject_open(motion, &options, &allocator, NULL, &s);
    if (!status) ambulo__subject_free(&s);
    if (status) assert_int_equal(status, AMBULO_E_MEMORY);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

static int test_compare_subject_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(by_reach, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(by_force, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(one_hit_of_a_plate, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(given, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(memory_runs_out, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_subject", tests, NULL, NULL);
}

/* Strikes by reach: in people's published means, in noise, in slow walks; and the text of given
 * ones. */

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

static void test_compare_strikes_given(void **state) {
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

static int test_compare_strikes_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(within_two_percent),
                                     cmocka_unit_test(test_compare_strikes_given)};
  return cmocka_run_group_tests_name("compare/compare_strikes", tests, NULL, NULL);
}

int main(void) {
  return test_compare_subject_tests() + test_compare_strikes_tests();
}
