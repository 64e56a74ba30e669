/* The distance: weights, numbers of curves, deviations, parts of the cycle. */
#include "support/fit_files.h"

#define WITH(distance) FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS "distance: " distance "\n"

static void curves_are_read(void **state) {
  ambulo_fit *f = fit_of(state, WITH("{correlation: 0.5, range: 0.25, cap: 9, curves: {pin: 3,\n"
                                     "  rom: {curve: pin, of: range, weight: 0.5, sd: 4},\n"
                                     "  shape: {curve: pin, centred: true, between: [10, 60]}}}"));
  assert_close(f->correlation, 0.5, 0.0);
  assert_close(f->range_cost, 0.25, 0.0);
  assert_close(f->cap, 9.0, 0.0);
  assert_int_equal(f->curves, 3);
  assert_close(f->curve[0].weight, 3.0, 0.0);
  assert_string_equal(f->curve[0].curve, "pin");
  assert_int_equal(f->curve[1].of, AMBULO__FIT_RANGE);
  assert_string_equal(f->curve[1].name, "rom");
  assert_string_equal(f->curve[1].curve, "pin");
  assert_close(f->curve[1].sd, 4.0, 0.0);
  assert_int_equal(f->curve[2].centred, 1);
  assert_close(f->curve[2].from, 10.0, 0.0);
  assert_close(f->curve[2].to, 60.0, 0.0);
  ambulo_fit_free(f);
}

static void what_is_no_distance(void **state) {
  fit_refused(state, WITH("{curves: {}}"), "0 curves; expected 1 to");
  fit_refused(state, WITH("{curves: {pin: 0}}"), "all weights are 0");
  fit_refused(state, WITH("{curves: {pin: -1}}"), "fit.yaml:12:26: error[E_SCHEMA]");
  fit_refused(state, WITH("{curves: {pin: {sd: 0}}}"), "a deviation of 0; expected one above 0");
  fit_refused(state, WITH("{curves: {pin: {of: peek}}}"), "did you mean 'peak'?");
  fit_refused(state, WITH("{curves: {pin: {of: peak, centred: true}}}"),
              "'centred' is of whole curves");
  fit_refused(state, WITH("{curves: {pin: {between: [60, 20]}}}"), "between 60 and 20");
  fit_refused(state, WITH("{curves: {pin: {centered: true}}}"), "did you mean 'centred'?");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(curves_are_read), TEST(what_is_no_distance)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
