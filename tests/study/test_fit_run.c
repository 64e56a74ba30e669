/* Whole fits by the program itself, of a rod whose truth is known: the references are motions of
 * the problem with other numbers, which the fit finds; results that do not depend on workers or
 * stops; folders that are refused; first solves that all fail. */
#include "base/diagnostics.h"
#include "ambulo/solve.h"
#include "ambulo/tools/compare.h"
#include "ambulo/tools/load.h"
#include "study/fit.h"
#include "support/fit_files.h"
#include "support/fit_runner.h"

#define TRUE_PRICE 5.0 /* 2.5 times that of the file */
#define TRUE_LAST 1.2  /* 0.2 more */

/* solves the problem as the truth has it and writes its curve as a reference */
static void make_truth(void **state, const char *duration, const char *name) {
  char price[64], last[64];
  (void)snprintf(price, sizeof price, "objective[acceleration].weight=%g", TRUE_PRICE);
  (void)snprintf(last, sizeof last, "ends.final.pin=%g", TRUE_LAST);
  const char *overrides[] = {price, last, duration};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_report_options options = ambulo_report_options_default();
  options.overwrite = 1;
  const char *folder = scratch_path(state, "truth");
  assert_int_equal(
      ambulo_problem_load(scratch_path(state, "p.yaml"), overrides, 3, NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_report_write(problem, result, folder, &options, NULL, NULL), AMBULO_OK);
  ambulo_result_free(result);
  ambulo_problem_free(problem);

  ambulo_compare_options compare = ambulo_compare_options_default();
  ambulo__map_entry entry = {.curve = "pin", .result = "q.pin", .factor = 1.0};
  ambulo__cycle cycle;
  double percent[21], values[21];
  ambulo__sampler sampler = {.cycle = NULL};
  int found = 0;
  compare.foot = "left";
  for (int i = 0; i < 21; i++) percent[i] = 5.0 * i;
  percent[20] = 99.9; /* 100 is the next beginning */
  assert_int_equal(ambulo__cycle_open(folder, &compare, NULL, NULL, &cycle), AMBULO_OK);
  assert_int_equal(ambulo__sampler_create(&cycle, &compare, 21, &sampler), AMBULO_OK);
  assert_int_equal(ambulo__sample_curve(&sampler, &entry, percent, 21, values, NULL, &found),
                   AMBULO_OK);
  assert_true(found);
  ambulo__sampler_free(&sampler);
  ambulo__cycle_close(&cycle);
  FILE *f = fopen(scratch_path(state, name), "w");
  assert_non_null(f);
  fprintf(f, "percent,pin,pin sd\n");
  for (int i = 0; i < 21; i++) fprintf(f, "%.17g,%.17g,2\n", percent[i], values[i]);
  assert_int_equal(fclose(f), 0);
}

#define TRUTH_CONDITIONS                                                                           \
  "conditions:\n  - {name: slow, set: {time.duration: 1.0}, reference: slow.csv}\n"                \
  "  - {name: quick, set: {time.duration: 0.7}, reference: quick.csv}\n"                           \
  "  - {name: middle, set: {time.duration: 0.8}, reference: middle.csv, held_out: true}\n"

/* the fit of known truth, in a world of its own */
static ambulo_fit *truth_fit(void **state, const char *method) {
  char text[2048];
  ambulo_fit *fit = NULL;
  fit_world(state);
  make_truth(state, "time.duration=1.0", "slow.csv");
  make_truth(state, "time.duration=0.7", "quick.csv");
  make_truth(state, "time.duration=0.8", "middle.csv");
  (void)snprintf(text, sizeof text, "%s%s", FIT_HEAD FIT_PARAMETERS TRUTH_CONDITIONS FIT_DISTANCE,
                 method);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(fit_load_text(state, text, list, &fit), AMBULO_OK);
  ambulo_diagnostics_free(list);
  return fit;
}

static ambulo_fit_options usual(int workers) {
  ambulo_fit_options o = ambulo_fit_options_default();
  o.program = fit_program();
  o.workers = workers;
  return o;
}

static ambulo_status run(const ambulo_fit *fit, const char *directory, const ambulo_fit_options *o,
                         ambulo_fit_progress *end, ambulo_fit_ending *ending, char **report) {
  ambulo_fit_progress own = {.ending = AMBULO_FIT_NOT_RUN};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_fit_run(fit, directory, o, NULL, list, &own, report);
  if (end) *end = own;
  if (ending && !status) *ending = own.ending;
  char buffer[1024] = "";
  ambulo_diagnostics_format(list, 0, buffer, sizeof buffer);
  if (status) print_error("%s\n", buffer);
  ambulo_diagnostics_free(list);
  return status;
}

static double number_at(ambulo__yaml *document, const char *path) {
  const ambulo__yaml_node *node = ambulo__yaml_at(document, path);
  if (!node) print_error("no %s\n", path);
  assert_non_null(node);
  return ambulo__yaml_number(node, (double)NAN);
}

/* what fit.json says of the truth */
static void check_truth(const char *directory, double tolerance) {
  char path[SCRATCH_PATH + 300];
  ambulo__yaml *document = NULL;
  (void)snprintf(path, sizeof path, "%s/fit.json", directory);
  assert_int_equal(ambulo__yaml_load(path, NULL, NULL, &document), AMBULO_OK);
  double before = number_at(document, "distance.before");
  assert_true(before > 1.0);
  assert_true(number_at(document, "distance.after") < 1e-3 * before);
  assert_true(number_at(document, "distance.from_zero") < 1e-3 * before);
  assert_true(number_at(document, "distance.held_out_after") < 1e-3 * before);
  assert_true(number_at(document, "distance.held_out_before") > 1.0);
  assert_close(number_at(document, "parameters.price.change"), TRUE_PRICE / 2.0, tolerance);
  assert_close(number_at(document, "parameters.last.change"), TRUE_LAST - 1.0, tolerance);
  assert_true(number_at(document, "conditions.slow.curves.pin.after.r") > 0.999);
  ambulo__yaml_free(document);
}

/* fitted.yaml is a problem that solves, and has the truth in it */
static void check_fitted(const char *directory, double tolerance) {
  char path[SCRATCH_PATH + 300];
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo__yaml *document = NULL;
  (void)snprintf(path, sizeof path, "%s/fitted.yaml", directory);
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  assert_int_equal(ambulo_result_verdict(result), AMBULO_OPTIMAL);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  assert_int_equal(ambulo__yaml_load(path, NULL, NULL, &document), AMBULO_OK);
  assert_close(number_at(document, "objective[acceleration].weight"), TRUE_PRICE, tolerance);
  assert_close(number_at(document, "ends.final.pin"), TRUE_LAST, tolerance);
  ambulo__yaml_free(document);
}

static void the_truth_is_found(void **state) {
  ambulo_fit *fit = truth_fit(state, "method: {iterations: 12, ridge: 0}\n");
  ambulo_fit_options o = usual(2);
  ambulo_fit_progress end;
  ambulo_fit_ending ending;
  char *report = NULL;
  const char *folder = scratch_path(state, "out");
  assert_int_equal(run(fit, folder, &o, &end, &ending, &report), AMBULO_OK);
  assert_int_equal(ending, AMBULO_FIT_CONVERGED);
  check_truth(folder, 0.01);
  check_fitted(folder, 0.01);
  assert_int_equal(end.resumed, 0);
  assert_int_equal(end.failed, 0);
  assert_non_null(strstr(report, "held out"));
  assert_non_null(strstr(report, "price"));
  free(report);
  ambulo_fit_free(fit);
}

/* a bound that keeps from the truth, and held-out conditions by their weights */
static void fit_json_says_it(void **state) {
  ambulo_fit *fit = NULL;
  ambulo_fit_options o = usual(2);
  ambulo__yaml *document = NULL;
  fit_world(state);
  make_truth(state, "time.duration=1.0", "slow.csv");
  assert_int_equal(
      fit_load_text(state,
                    FIT_HEAD "parameters:\n  - {name: price, keys: "
                             "[\"objective[acceleration].weight\"], range: [0.5, 1.5]}\n"
                             "conditions:\n  - {name: slow, reference: slow.csv}\n"
                             "  - {name: one, reference: quick.csv, held_out: true}\n"
                             "  - {name: three, set: {time.duration: 0.7}, reference: quick.csv, "
                             "held_out: true, weight: 3}\n" FIT_DISTANCE,
                    NULL, &fit),
      AMBULO_OK);
  assert_int_equal(run(fit, scratch_path(state, "out"), &o, NULL, NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo__yaml_load(scratch_path(state, "out/fit.json"), NULL, NULL, &document),
                   AMBULO_OK);
  assert_string_equal(ambulo__yaml_text(ambulo__yaml_at(document, "parameters.price.at_bound")),
                      "upper");
  assert_close(number_at(document, "parameters.price.change"), 1.5, 1e-12);
  static const char *const times[] = {"before", "after"};
  for (int i = 0; i < 2; i++) {
    char path[3][80];
    (void)snprintf(path[0], sizeof path[0], "conditions.one.distance.%s", times[i]);
    (void)snprintf(path[1], sizeof path[1], "conditions.three.distance.%s", times[i]);
    (void)snprintf(path[2], sizeof path[2], "distance.held_out_%s", times[i]);
    double one = number_at(document, path[0]), three = number_at(document, path[1]);
    assert_close(number_at(document, path[2]), (one + 3.0 * three) / 4.0, 1e-12);
    assert_true(fabs(one - three) > 1e-3);
  }
  ambulo__yaml_free(document);
  ambulo_fit_free(fit);
}

/* user: after how many solves */
static int stop_after(void *user, const ambulo_fit_progress *p) {
  return p->solves >= *(const int *)user;
}

static void same_file(void **state, const char *a, const char *b) {
  char *one = read_whole(scratch_path(state, a)), *other = read_whole(scratch_path(state, b));
  assert_string_equal(one, other);
  free(one);
  free(other);
}

/* one and three processes, and a run that is stopped again and again, write the same */
static void neither_workers_nor_stops_matter(void **state) {
  ambulo_fit *fit = truth_fit(state, "method: {iterations: 3}\n");
  ambulo_fit_options o = usual(1);
  ambulo_fit_progress end;
  ambulo_fit_ending ending = AMBULO_FIT_INTERRUPTED;
  assert_int_equal(run(fit, scratch_path(state, "one"), &o, &end, &ending, NULL), AMBULO_OK);
  int whole = end.solves, stops = 0;
  o = usual(3);
  assert_int_equal(run(fit, scratch_path(state, "three"), &o, NULL, NULL, NULL), AMBULO_OK);
  same_file(state, "one/fit.json", "three/fit.json");
  same_file(state, "one/fitted.yaml", "three/fitted.yaml");
  ending = AMBULO_FIT_INTERRUPTED;
  for (int after = 2; ending == AMBULO_FIT_INTERRUPTED; after += 11, stops++) {
    o = usual(2);
    o.progress = stop_after;
    o.user = &after;
    assert_int_equal(run(fit, scratch_path(state, "bits"), &o, &end, &ending, NULL), AMBULO_OK);
    assert_true(stops < 100);
  }
  assert_true(stops > 2);
  assert_int_equal(end.solves, whole);
  assert_true(end.resumed > 0);
  same_file(state, "one/fit.json", "bits/fit.json");
  same_file(state, "one/fitted.yaml", "bits/fitted.yaml");
  /* once more: nothing is left to be computed */
  o = usual(2);
  assert_int_equal(run(fit, scratch_path(state, "one"), &o, &end, &ending, NULL), AMBULO_OK);
  assert_int_equal(end.resumed, whole);
  ambulo_fit_free(fit);
}

static void stopped_before_anything(void **state) {
  ambulo_fit *fit = truth_fit(state, "");
  ambulo_fit_options o = usual(1);
  ambulo_fit_ending ending = AMBULO_FIT_NOT_RUN;
  int after = 0;
  char *report = NULL;
  o.progress = stop_after;
  o.user = &after;
  assert_int_equal(run(fit, scratch_path(state, "out"), &o, NULL, &ending, &report), AMBULO_OK);
  assert_int_equal(ending, AMBULO_FIT_INTERRUPTED);
  assert_null(report);
  assert_int_not_equal(access(scratch_path(state, "out/fit.json"), F_OK), 0);
  ambulo_fit_free(fit);
}

/* a program that solves nothing: no condition is solved, and nothing is fitted */
static void first_solves_that_fail(void **state) {
  ambulo_fit *fit = truth_fit(state, "");
  ambulo_fit_options o = usual(2);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  o.program = "/bin/false";
  assert_int_equal(ambulo_fit_run(fit, scratch_path(state, "out"), &o, NULL, list, NULL, NULL),
                   AMBULO_E_PROBLEM);
  assert_message(list, 0,
                 "no condition could be solved where the parameters stand; 'slow' is "
                 "error");
  assert_int_not_equal(access(scratch_path(state, "out/fit.json"), F_OK), 0);
  ambulo_diagnostics_free(list);
  ambulo_fit_free(fit);
}

static void a_motion_without_the_curve(void **state) {
  fit_world(state);
  scratch_write(scratch_path(state, "map.csv"), "curve,reference,result,unit\npin,pin,q.pen,deg\n");
  ambulo_fit *fit = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      fit_load_text(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE, list, &fit),
      AMBULO_OK);
  ambulo_fit_options o = usual(2);
  assert_int_equal(ambulo_fit_run(fit, scratch_path(state, "out"), &o, NULL, list, NULL, NULL),
                   AMBULO_E_PROBLEM);
  assert_message(list, 0, "condition 'slow': the motion has no curve 'pin' (from 'q.pen')");
  ambulo_diagnostics_free(list);
  ambulo_fit_free(fit);
}

static void arguments(void **state) {
  ambulo_fit *fit = truth_fit(state, "");
  ambulo_fit_options o = usual(1);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_fit_run(NULL, "x", &o, NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_fit_run(fit, "", &o, NULL, list, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_message(list, 0, "the name of the folder is empty");
  o.grace = -1.0;
  assert_int_equal(ambulo_fit_run(fit, "x", &o, NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  memset(&o, 0, sizeof o);
  assert_int_equal(ambulo_fit_run(fit, "x", &o, NULL, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  ambulo_diagnostics_free(list);
  ambulo_fit_free(fit);
}

#define TEXT FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE

/* the folder is made or refused; nothing is solved */
static ambulo_status prepare(const ambulo_fit *fit, const char *directory, int force,
                             ambulo_diagnostics *list) {
  ambulo_fit_options o = usual(1);
  int after = 0;
  o.progress = stop_after;
  o.user = &after;
  o.force = force;
  ambulo__diagnostics_clear(list);
  return ambulo_fit_run(fit, directory, &o, NULL, list, NULL, NULL);
}

static void made_and_continued(void **state) {
  ambulo_fit *fit = fit_of(state, TEXT);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *folder = scratch_path(state, "out");
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_OK);
  assert_int_equal(access(scratch_path(state, "out/fit_inputs.json"), F_OK), 0);
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_OK);
  scratch_write(scratch_path(state, "out/notes.txt"), "mine"); /* harms nothing in a fit's folder */
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_fit_free(fit);
}

static void other_inputs(void **state) {
  ambulo_fit *fit = fit_of(state, TEXT);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *folder = scratch_path(state, "out");
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_OK);
  fit->hash ^= 1;
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_E_PROBLEM);
  assert_message(list, 0, "model or references, or the version of ambulo changed since");
  assert_message(list, 0, "--force");
  assert_int_equal(prepare(fit, folder, 1, list), AMBULO_OK);
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_OK); /* it is that fit's folder now */
  ambulo_fit_free(fit);
  fit = fit_of(state, TEXT); /* as it was */
  assert_int_equal(prepare(fit, folder, 0, list), AMBULO_E_PROBLEM);
  assert_int_equal(prepare(fit, folder, 1, list), AMBULO_OK);
  /* a reference, the map and the model are inputs, too */
  static const char *const names[] = {"slow.csv", "map.csv", "one.yaml"};
  for (int i = 0; i < 3; i++) {
    char *own = read_whole(scratch_path(state, names[i])), other[2048];
    (void)snprintf(other, sizeof other, "%s\n", own);
    if (i == 2) memcpy(strstr(other, "mass: 1"), "mass: 3", 7);
    scratch_write(scratch_path(state, names[i]), other);
    ambulo_fit_free(fit);
    fit = NULL;
    assert_int_equal(ambulo_fit_load(scratch_path(state, "fit.yaml"), NULL, list, &fit), AMBULO_OK);
    assert_int_equal(prepare(fit, folder, 0, list), AMBULO_E_PROBLEM);
    scratch_write(scratch_path(state, names[i]), own);
    free(own);
  }
  ambulo_diagnostics_free(list);
  ambulo_fit_free(fit);
}

static void something_else(void **state) {
  ambulo_fit *fit = fit_of(state, TEXT);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(mkdir(scratch_path(state, "d"), 0777), 0);
  scratch_write(scratch_path(state, "d/thesis.tex"), "x");
  assert_int_equal(prepare(fit, scratch_path(state, "d"), 0, list), AMBULO_E_IO);
  assert_message(list, 0, "the folder holds other files ('thesis.tex')");
  assert_int_equal(entries_in(scratch_path(state, "d")), 1);
  scratch_write(scratch_path(state, "file"), "x");
  assert_int_equal(prepare(fit, scratch_path(state, "file"), 0, list), AMBULO_E_IO);
  assert_int_equal(prepare(fit, scratch_path(state, "no/such"), 0, list), AMBULO_E_IO);
  /* damaged inputs are other inputs */
  assert_int_equal(prepare(fit, scratch_path(state, "out"), 0, list), AMBULO_OK);
  scratch_write(scratch_path(state, "out/fit_inputs.json"), "{\"schema\": \"ambulo-fit-inputs/");
  assert_int_equal(prepare(fit, scratch_path(state, "out"), 0, list), AMBULO_E_PROBLEM);
  ambulo_diagnostics_free(list);
  ambulo_fit_free(fit);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(the_truth_is_found),
      TEST(fit_json_says_it),
      TEST(neither_workers_nor_stops_matter),
      TEST(stopped_before_anything),
      TEST(first_solves_that_fail),
      TEST(a_motion_without_the_curve),
      TEST(arguments),
      TEST(made_and_continued),
      TEST(other_inputs),
      TEST(something_else),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
