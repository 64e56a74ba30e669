/* Keys of parameters: their own values in the file and in each condition, and keys and bounds that
 * the problem does not take. */
#include "support/fit_files.h"

static void own_values(void **state) {
  ambulo_fit *f = fit_of(
      state, FIT_HEAD "parameters:\n  - {name: a, keys: [\"objective[1].weight\", time.duration],"
                      " range: [0.5, 2]}\n" FIT_CONDITIONS FIT_DISTANCE);
  const ambulo__fit_parameter *p = &f->parameter[0];
  assert_close(p->in_file[0], 2.0, 0.0);
  assert_close(p->in_file[1], 1.0, 0.0);
  assert_close(p->own[0], 2.0, 0.0); /* slow: as the file is */
  assert_close(p->own[1], 1.0, 0.0);
  assert_close(p->own[2], 2.0, 0.0); /* quick sets the duration */
  assert_close(p->own[3], 0.7, 0.0);
  ambulo_fit_free(f);
}

static void a_key_of_conditions_alone(void **state) {
  ambulo_fit *f =
      fit_of(state, FIT_HEAD "parameters:\n  - {name: a, keys: [ends.initial_speed.pin],"
                             " scale: linear, step: 0.1, range: [-1, 1]}\n"
                             "conditions:\n  - {name: a, reference: slow.csv,\n"
                             "     set: {ends.initial_speed: {pin: 0.25}}}\n" FIT_DISTANCE);
  assert_true(isnan(f->parameter[0].in_file[0]));
  assert_close(f->parameter[0].own[0], 0.25, 0.0);
  ambulo_fit_free(f);
}

#define ONE(text) FIT_HEAD "parameters:\n  - " text "\n" FIT_CONDITIONS FIT_DISTANCE

static void keys_that_are_not_there(void **state) {
  fit_refused(state, ONE("{name: a, keys: [time.durration], range: [0.5, 2]}"),
              "fit.yaml:7:22: error[E_SCHEMA]: key 'time.durration' of the problem: the path needs "
              "a key that is not there");
  fit_refused(state, ONE("{name: a, keys: [time.durration], range: [0.5, 2]}"),
              "did you mean 'duration'?");
  fit_refused(state, ONE("{name: a, keys: [\"objective[upright].weight\"], range: [0.5, 2]}"),
              "no item is named 'upright'");
  assert_int_equal(fit_errors(state, ONE("{name: a, keys: [time.durration], range: [0.5, 2]}")), 1);
  fit_refused(state, ONE("{name: a, keys: [model], range: [0.5, 2]}"), "no number stands there");
  fit_refused(state, ONE("{name: a, keys: [ends.initial.pin], range: [0.5, 2]}"),
              "'ends.initial.pin' is 0, which no factor changes");
}

static void what_the_problem_does_not_take(void **state) {
  fit_refused(state,
              ONE("{name: a, keys: [time.duration], scale: linear, step: 1,"
                  " range: [-3, 1]}"),
              "with 'a' at its lower bound the problem cannot be read: ");
  fit_refused(
      state,
      FIT_HEAD FIT_PARAMETERS
      "conditions:\n  - {name: a, set: {time.duration: long}, reference: slow.csv}\n" FIT_DISTANCE,
      "fit.yaml:10:20: error[E_SCHEMA]: the problem cannot be read as condition 'a' sets");
  fit_refused(state,
              "ambulo: 1\nkind: fit\nname: swing\nproblem: none.yaml\n"
              "compare: {map: map.csv}\n" FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE,
              "fit.yaml:4:10: error[E_IO]: the problem");
  fit_refused(state,
              "ambulo: 1\nkind: fit\nname: swing\nproblem: one.yaml\n"
              "compare: {map: map.csv}\n" FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE,
              "fit.yaml:4:10: error[E_SCHEMA]: the problem cannot be read: this is a skeleton "
              "model; expected a problem");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(own_values),
      TEST(a_key_of_conditions_alone),
      TEST(keys_that_are_not_there),
      TEST(what_the_problem_does_not_take),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
