/* The problem file with fitted numbers: what is replaced, what stays, names of files. */
#include "study/fitted_problem.h"
#include "ambulo/tools/load.h"
#include "support/fit_files.h"

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

static void a_file_that_changed(void **state) {
  ambulo_fit *f = fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE);
  const double u[] = {1.0, 0.0};
  ambulo__text_buffer text;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__text_init(&text, NULL);
  assert_int_equal(unlink(scratch_path(state, "p.yaml")), 0);
  assert_int_equal(ambulo__fitted_problem(f, u, *state, list, &text), AMBULO_E_IO);
  scratch_write(scratch_path(state, "p.yaml"), "ambulo: 1\nobjective: none\n");
  assert_int_not_equal(ambulo__fitted_problem(f, u, *state, list, &text), AMBULO_OK);
  assert_int_equal(text.length, 0);
  ambulo__text_free(&text);
  ambulo_diagnostics_free(list);
  ambulo_fit_free(f);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(numbers_and_names), TEST(nothing_to_change),
                                     TEST(what_is_read_again), TEST(a_file_that_changed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
