/* Conditions: what they set, their references, curves that lack, held-out ones. */
#include "study/fit.h"
#include "support/fit_files.h"
#include "support/test.h"

static void sets_are_overrides(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS
                         "conditions:\n"
                         "  - {name: a, set: {time.duration: 0.8, 'ends.initial': {pin: 0.1}},\n"
                         "     reference: slow.csv, weight: 2}\n"
                         "  - {name: b, after: a, set: {name: \"12\"}, reference: quick.csv,\n"
                         "     held_out: true}\n" FIT_DISTANCE);
  assert_int_equal(f->conditions, 2);
  assert_string_equal(f->condition[0].set[0], "time.duration=0.8");
  assert_string_equal(f->condition[0].set[1], "ends.initial={pin: 0.1}");
  assert_string_equal(f->condition[1].set[0], "name=\"12\"");
  assert_int_equal(f->condition[0].after, -1);
  assert_int_equal(f->condition[1].after, 0);
  assert_close(f->condition[0].weight, 2.0, 0.0);
  assert_int_equal(f->condition[0].held_out, 0);
  assert_int_equal(f->condition[1].held_out, 1);
  /* 21 points and two numbers; the held-out one is not among the residuals */
  assert_int_equal(f->condition[0].residuals, 23);
  assert_int_equal(f->residuals, 23);
  ambulo_fit_free(f);
}

static void blocks_stand_one_behind_the_other(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS
                         "distance: {curves: {pin: 1, top: {curve: pin, of: peak, sd: 4},\n"
                         "  late: {curve: pin, between: [50, 90]}}}\n");
  const ambulo__fit_target *t = f->condition[1].target;
  assert_int_equal(f->condition[1].targets, 3);
  assert_int_equal(t[0].count, 23);
  assert_int_equal(t[1].first, 23);
  assert_int_equal(t[1].count, 1);
  assert_int_equal(t[2].first, 24);
  assert_int_equal(t[2].points, 9); /* 50, 55, ... 90 */
  assert_close(t[2].percent[0], 50.0, 0.0);
  assert_close(t[2].percent[8], 90.0, 0.0);
  assert_close(t[0].sd, 2.0, 1e-12);
  assert_close(t[1].sd, 4.0, 0.0);
  assert_int_equal(f->condition[1].first, 35);
  assert_int_equal(f->residuals, 70);
  ambulo_fit_free(f);
}

static void a_condition_may_lack_curves(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS
                         "conditions:\n  - {name: a, reference: slow.csv}\n"
                         "  - {name: b, reference: quick.csv, curves: [top]}\n"
                         "distance: {curves: {pin: 1, top: {curve: pin, of: peak}}}\n");
  assert_int_equal(f->condition[0].targets, 2);
  assert_int_equal(f->condition[1].targets, 1);
  assert_int_equal(f->condition[1].target[0].curve, 1);
  assert_int_equal(f->residuals, 25);
  ambulo_fit_free(f);
}

#define WITH(conditions) FIT_HEAD FIT_PARAMETERS "conditions:\n" conditions FIT_DISTANCE

static void conditions_that_are_none(void **state) {
  fit_refused(state, FIT_HEAD FIT_PARAMETERS "conditions: []\n" FIT_DISTANCE, "0 conditions");
  fit_refused(state, WITH("  - {name: a, reference: slow.csv, held_out: true}\n"),
              "all conditions are held out");
  fit_refused(state,
              WITH("  - {name: a, reference: slow.csv}\n  - {name: a, reference: slow.csv}\n"),
              "two conditions are named 'a'");
  fit_refused(state,
              WITH("  - {name: slow, reference: slow.csv}\n"
                   "  - {name: b, after: slwo, reference: slow.csv}\n"),
              "'after' names no earlier condition (got 'slwo')");
  fit_refused(state,
              WITH("  - {name: slow, reference: slow.csv}\n"
                   "  - {name: b, after: slwo, reference: slow.csv}\n"),
              "did you mean 'slow'?");
  fit_refused(state, WITH("  - {name: a, reference: none.csv}\n"),
              "fit.yaml:10:26: error[E_IO]: the reference");
  fit_refused(state, WITH("  - {name: a, reference: slow.csv, curves: [pni]}\n"),
              "no curve of 'distance' (got 'pni')");
}

/* a fit without anything to come closer to */
static void conditions_without_weight(void **state) {
  fit_refused(state, WITH("  - {name: a, reference: slow.csv, curves: []}\n"),
              "fit.yaml:10:44: error[E_SCHEMA]: condition 'a' has no curve with a weight above 0");
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS
              "conditions:\n  - {name: a, reference: slow.csv, curves: [pin]}\n"
              "  - {name: b, reference: slow.csv, held_out: true}\n"
              "distance: {curves: {pin: 0, top: {curve: pin, of: peak}}}\n",
              "condition 'a' has no curve with a weight above 0");
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS
                         "distance: {curves: {pin: 0, top: {curve: pin, of: peak}}}\n");
  ambulo_fit_free(f);
}

static void references_that_lack(void **state) {
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS "distance: {curves: {knee_flexion: 1}}\n",
              "of condition 'slow' has no curve 'knee_flexion'");
  fit_refused(state, WITH("  - {name: a, reference: plain.csv}\n"),
              "has no deviations of 'pin'; expected 'sd' with the curve");
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS
              "distance: {curves: {pin: {weight: 1, between: [11, 14]}}}\n",
              "has 0 points of 'pin' between 11 and 14 percent");
  ambulo_fit *f =
      fit_of(state, FIT_HEAD FIT_PARAMETERS "conditions:\n  - {name: a, reference: plain.csv}\n"
                                            "distance: {curves: {pin: {sd: 5}}}\n");
  assert_close(f->condition[0].target[0].sd, 5.0, 0.0);
  ambulo_fit_free(f);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(sets_are_overrides),          TEST(blocks_stand_one_behind_the_other),
      TEST(a_condition_may_lack_curves), TEST(conditions_that_are_none),
      TEST(conditions_without_weight),   TEST(references_that_lack),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
