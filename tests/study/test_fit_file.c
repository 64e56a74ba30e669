/* Fit files: what is read, what is refused with its place, memory that gives out. */
#include "base/diagnostics.h"
#include "support/fail_alloc.h"
#include "support/fit_files.h"

static void a_fit_is_read(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE
                         "method: {iterations: 3, ridge: 0.5, tolerance: 0.1}\n"
                         "limits: {seconds: 7, megabytes: 300}\n");
  assert_string_equal(f->name, "swing");
  assert_int_equal(f->parameters, 2);
  assert_int_equal(f->parameter[0].scale, AMBULO__FIT_LOG);
  assert_close(f->parameter[0].step, 0.3, 0.0); /* the default of factors */
  assert_close(f->parameter[0].upper, log(20.0) / 0.3, 1e-12);
  assert_close(f->parameter[0].lower, log(0.05) / 0.3, 1e-12);
  assert_int_equal(f->parameter[1].scale, AMBULO__FIT_LINEAR);
  assert_close(f->parameter[1].lower, -5.0, 1e-12);
  assert_int_equal(f->iterations, 3);
  assert_close(f->ridge, 0.5, 0.0);
  assert_close(f->tolerance, 0.1, 0.0);
  assert_close(f->case_seconds, 7.0, 0.0);
  assert_int_equal(f->case_megabytes, 300);
  assert_string_equal(f->compare.foot, "left");
  ambulo_fit_free(f);
  ambulo_fit_free(NULL);
}

static void defaults(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  assert_int_equal(f->iterations, 6);
  assert_close(f->ridge, 0.0025, 0.0);
  assert_close(f->cap, 12.0, 0.0);
  assert_close(f->correlation, 1.2, 0.0);
  assert_close(f->range_cost, 0.8, 0.0);
  assert_close(f->case_seconds, 60.0, 0.0);
  ambulo_fit_free(f);
  f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE
             "method: {kind: gauss_newton, iterations: 3, ridge: 0}\n");
  assert_int_equal(f->iterations, 3);
  assert_close(f->ridge, 0.0, 0.0);
  ambulo_fit_free(f);
}

static void what_is_no_fit(void **state) {
  fit_refused(state, "ambulo: 1\nkind: sweep\naxes: []\n", "expected a fit");
  fit_refused(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS, "missing required key 'distance'");
  fit_refused(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE "methods: {}\n",
              "did you mean 'method'?");
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE
              "method: {kind: bobyqa, evaluations: 60}\n",
              "error[E_SCHEMA]: the methods bobyqa and sbplx are no longer offered (got 'bobyqa')");
  fit_refused(state,
              FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE "method: {evaluations: 60}\n",
              "no longer offered (got '60')");
}

#define ONE(text) FIT_HEAD "parameters:\n  - " text "\n" FIT_CONDITIONS FIT_DISTANCE

static void parameters_that_are_none(void **state) {
  fit_refused(state, ONE("{name: a, keys: [ends.final.pin], range: [2, 1]}"),
              "fit.yaml:7:46: error[E_SCHEMA]: range [2, 1]; expected two rising factors above 0");
  fit_refused(state, ONE("{name: a, keys: [ends.final.pin], range: [2, 3]}"),
              "range [2, 3] is without 1, where the problem stands");
  fit_refused(state,
              ONE("{name: a, keys: [ends.final.pin], scale: linear, step: 1, range: [1, 3]}"),
              "range [1, 3] is without 0");
  fit_refused(state, ONE("{name: a, keys: [ends.final.pin], scale: linear, range: [-1, 3]}"),
              "missing required key 'step'");
  fit_refused(state, ONE("{name: a, keys: [], range: [0.5, 2]}"), "0 keys; expected 1 to");
  fit_refused(state, ONE("{name: a, keys: [model.gravity], range: [0.5, 2]}"),
              "is a key of the model file");
  fit_refused(state, ONE("{name: a, keys: [time.duration, time.duration], range: [0.5, 2]}"),
              "fit.yaml:7:37: error[E_SCHEMA]: the key 'time.duration' is taken already");
  fit_refused(state,
              ONE("{name: a, keys: [time.duration], range: [0.5, 2]}\n"
                  "  - {name: a, keys: [ends.final.pin], range: [0.5, 2]}"),
              "fit.yaml:8:12: error[E_SCHEMA]: two parameters are named 'a'");
}

static void a_file_that_is_not_there(void **state) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_fit *fit = NULL;
  assert_int_equal(ambulo_fit_load(scratch_path(state, "none.yaml"), NULL, list, &fit),
                   AMBULO_E_IO);
  assert_message(list, 0, "none.yaml: error[E_IO]");
  ambulo__diagnostics_clear(list);
  assert_int_equal(ambulo_fit_load("", NULL, list, &fit), AMBULO_E_ARGUMENT);
  assert_message(list, 0, "the name of the file is empty");
  assert_int_equal(ambulo_fit_load(NULL, NULL, list, &fit), AMBULO_E_ARGUMENT);
  ambulo_diagnostics_free(list);
}

/* once, and from there on */
static void every_allocation_may_fail(void **state) {
  fit_world(state);
  scratch_write(scratch_path(state, "fit.yaml"),
                FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  int rounds = 0;
  for (int once = 0; once < 2; once++)
    for (long k = 0; k < 100000; k += 1 + k / 40) {
      fail_alloc memory = fail_alloc_at(k);
      memory.only_once = once;
      ambulo_allocator allocator = fail_alloc_hook(&memory);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_fit *fit = NULL;
      ambulo_status status =
          ambulo_fit_load(scratch_path(state, "fit.yaml"), &allocator, list, &fit);
      /* a hint may be lost alone */
      if (status != AMBULO_OK) assert_int_equal(status, AMBULO_E_MEMORY);
      if (status != AMBULO_OK) assert_true(ambulo_diagnostics_error_count(list) > 0);
      ambulo_fit_free(fit);
      ambulo_diagnostics_free(list);
      assert_int_equal(memory.live, 0);
      rounds++;
      if (!memory.failed) break;
    }
  assert_true(rounds > 100);
}

/* The distance: weights, numbers of curves, deviations, parts of the cycle. */

#define WITH(distance) FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS "distance: " distance "\n"

static void curves_are_read(void **state) {
  ambulo_fit *f = fit_of(state, WITH("{correlation: 0.5, range: 0.25, cap: 9, curves: {pin: 3,\n"
                                     "  rom: {curve: pin, of: range, weight: 0.5, sd: 4},\n"
                                     "  shape: {curve: pin, centred: true, between: [10, 60],\n"
                                     "    range: 1.5, correlation: 0}}}"));
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
  /* those of the distance, or its own */
  assert_close(f->curve[0].correlation, 0.5, 0.0);
  assert_close(f->curve[0].range_cost, 0.25, 0.0);
  assert_close(f->curve[2].correlation, 0.0, 0.0);
  assert_close(f->curve[2].range_cost, 1.5, 0.0);
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
  fit_refused(state, WITH("{curves: {pin: {of: range, range: 2}}}"),
              "fit.yaml:12:45: error[E_SCHEMA]: 'range' is of whole curves; expected it without "
              "'of: range'");
  fit_refused(state, WITH("{curves: {pin: {of: peak, correlation: 0}}}"),
              "'correlation' is of whole curves");
  fit_refused(state, WITH("{curves: {pin: {range: -1}}}"), "fit.yaml:12:34: error[E_SCHEMA]");
  fit_refused(state, WITH("{curves: {pin: {between: [60, 20]}}}"), "between 60 and 20");
  fit_refused(state, WITH("{curves: {pin: {centered: true}}}"), "did you mean 'centred'?");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(a_fit_is_read),
      TEST(defaults),
      TEST(what_is_no_fit),
      TEST(parameters_that_are_none),
      TEST(a_file_that_is_not_there),
      TEST(every_allocation_may_fail),
      TEST(curves_are_read),
      TEST(what_is_no_distance),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
