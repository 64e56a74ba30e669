/* Keys of parameters: their own values in the file and in each condition, and keys and bounds that
 * the problem does not take. */
#include "ambulo/tools/load.h"
#include "study/fit.h"
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
  fit_refused(state,
              ONE("{name: a, keys: [trajectory.intervals], scale: linear, step: 1,"
                  " range: [0, 0.5]}"),
              "with 'a' at its upper bound the problem cannot be read: ");
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

/* From steps to numbers of the problem. */

static void changes(void **state) {
  (void)state;
  ambulo__fit_parameter p = {.scale = AMBULO__FIT_LOG, .step = 0.3, .range = {0.1, 10.0}};
  assert_close(ambulo__fit_change(&p, 0.0), 1.0, 0.0);
  assert_close(ambulo__fit_change(&p, 2.0), exp(0.6), 1e-15);
  assert_close(ambulo__fit_change(&p, 100.0), 10.0, 0.0);
  assert_close(ambulo__fit_value(&p, 5.0, -1.0), 5.0 * exp(-0.3), 1e-8);
  p = (ambulo__fit_parameter){.scale = AMBULO__FIT_LINEAR, .step = 0.01, .range = {-0.03, 0.02}};
  assert_close(ambulo__fit_change(&p, 1.0), 0.01, 0.0);
  assert_close(ambulo__fit_change(&p, 9.0), 0.02, 0.0);
  assert_close(ambulo__fit_value(&p, 0.62, -1.0), 0.61, 1e-12);
}

/* nine digits, and the file's own number as it is where nothing changes */
static void numbers_are_short(void **state) {
  (void)state;
  ambulo__fit_parameter p = {.scale = AMBULO__FIT_LOG, .step = 0.3, .range = {0.1, 10.0}};
  double own = 0.12345678901234567, value = ambulo__fit_value(&p, own, 1.0);
  assert_true(ambulo__fit_value(&p, own, 0.0) == own);
  char text[40];
  (void)snprintf(text, sizeof text, "%.9g", value);
  assert_true(strtod(text, NULL) == value);
  assert_close(ambulo__fit_value(&p, 3e-7, 1.0), 3e-7 * exp(0.3), 1e-14);
  assert_close(ambulo__fit_value(&p, 3e11, 1.0) / 3e11, exp(0.3), 1e-8);
}

static void overrides_of_a_condition(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  const char **list = NULL;
  int count = 0;
  double u[2] = {1.0, -2.0};
  assert_int_equal(ambulo__fit_overrides(f, 1, u, &list, &count), AMBULO_OK);
  assert_int_equal(count, 3);
  assert_string_equal(list[0], "time.duration=0.7");
  assert_string_equal(list[1], "objective[acceleration].weight=2.69971762");
  assert_string_equal(list[2], "ends.final.pin=0.8");
  free((void *)list);
  ambulo_fit_free(f);
}

/* The problem file with fitted numbers: what is replaced, what stays, names of files. */

static char *rewritten(void **state, const ambulo_fit *f, const double *u, const char *folder) {
  ambulo__text_buffer text;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__text_init(&text, NULL);
  ambulo_status status = ambulo__fitted_problem(f, u, scratch_path(state, folder), list, &text);
  char buffer[1024] = "";
  ambulo_diagnostics_format(list, 0, buffer, sizeof buffer);
  if (status) print_error("%s\n", buffer);
  assert_int_equal(status, AMBULO_OK);
  char *copy = strdup(ambulo__text_data(&text));
  ambulo__text_free(&text);
  ambulo_diagnostics_free(list);
  return copy;
}

static void numbers_and_names(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  const double u[] = {1.0, -2.0};
  assert_int_equal(mkdir(scratch_path(state, "out"), 0777), 0);
  assert_int_equal(mkdir(scratch_path(state, "out/in"), 0777), 0);
  char *text = rewritten(state, f, u, "out/in");
  assert_string_equal(
      text, "# a rod\nambulo: 1\nkind: problem\nname: swing\nmodel: \"../../one.yaml\" # the rod\n"
            "angles: radians\ntime: {duration: 1.0, intervals: 10}\ntrajectory: {intervals: 6}\n"
            "ends: {initial: {pin: 0}, final: {pin: 0.8}}\n"
            "objective:\n  - {term: torque_squared, weight: 1}\n"
            "  - {term: acceleration, weight: 2.69971762} # price\n");
  free(text);
  ambulo_fit_free(f);
}

/* beside the problem, and where nothing was changed, the text is the same */
static void nothing_to_change(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  const double u[] = {0.0, 0.0};
  char *text = rewritten(state, f, u, ".");
  assert_string_equal(text, fit_problem);
  free(text);
  ambulo_fit_free(f);
}

/* one line that begins with a mark, with characters of several bytes before numbers, quotes, and
 * two keys; what it makes is a problem */
static void what_is_read_again(void **state) {
  fit_world(state);
  scratch_write(scratch_path(state, "r\xc3\xb6\xe2\x82\xac.yaml"), fit_model);
  scratch_write(
      scratch_path(state, "q.yaml"),
      "\xef\xbb\xbf{ambulo: 1, kind: problem, name: q, model: 'r\xc3\xb6\xe2\x82\xac.yaml', "
      "angles: "
      "radians, time: {duration: 1.0, intervals: 10}, trajectory: {intervals: 6}, ends: {initial: "
      "{pin: 0}, final: {pin: 1.0}}, objective: [{term: torque_squared, weight: 1, scale: {pin: "
      "3}}]}\r\n");
  scratch_write(scratch_path(state, "fit.yaml"),
                "ambulo: 1\nkind: fit\nname: q\nproblem: q.yaml\ncompare: {map: map.csv}\n"
                "parameters:\n  - {name: a, keys: [\"objective[0].weight\", "
                "\"objective[0].scale.pin\"], range: [0.1, 9]}\n" FIT_CONDITIONS FIT_DISTANCE);
  ambulo_fit *f = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_fit_load(scratch_path(state, "fit.yaml"), NULL, list, &f), AMBULO_OK);
  const double u[] = {2.0};
  assert_int_equal(mkdir(scratch_path(state, "sub"), 0777), 0);
  char *text = rewritten(state, f, u, "sub");
  assert_non_null(strstr(text, "weight: 1.8221188, scale: {pin: 5.4663564}}]}\r\n"));
  assert_non_null(strstr(text, "model: \"../r\xc3\xb6\xe2\x82\xac.yaml\", angles"));
  scratch_write(scratch_path(state, "sub/fitted.yaml"), text);
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load(scratch_path(state, "sub/fitted.yaml"), NULL, 0, NULL, list, &p),
      AMBULO_OK);
  ambulo_problem_free(p);
  free(text);
  ambulo_fit_free(f);
  ambulo_diagnostics_free(list);
}

/* what is written is the file that was solved */
static void a_file_that_changed(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  const double u[] = {1.0, 0.0};
  char *before = rewritten(state, f, u, ".");
  ambulo__text_buffer text;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__text_init(&text, NULL);
  scratch_write(scratch_path(state, "p.yaml"), "ambulo: 1\nobjective: none\n");
  assert_int_equal(ambulo__fitted_problem(f, u, *state, list, &text), AMBULO_OK);
  assert_string_equal(ambulo__text_data(&text), before);
  ambulo__text_free(&text);
  free(before);
  ambulo_diagnostics_free(list);
  ambulo_fit_free(f);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(own_values),
      TEST(a_key_of_conditions_alone),
      TEST(keys_that_are_not_there),
      TEST(what_the_problem_does_not_take),
      TEST(changes),
      TEST(numbers_are_short),
      TEST(overrides_of_a_condition),
      TEST(numbers_and_names),
      TEST(nothing_to_change),
      TEST(what_is_read_again),
      TEST(a_file_that_changed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
