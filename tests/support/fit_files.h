/* tests/support/fit_files.h - a small fit in a scratch folder: a rod that swings up, whose price of
 * acceleration and last angle are to be found; its problem, model, map and references.
 *
 * The references are made by the program itself from the problem with other numbers, or by formula
 * where a test needs no truth: angle 30 + 20 sin(2 pi p / 100) degrees, deviation 2. */
#ifndef AMBULO_TESTS_FIT_FILES_H
#define AMBULO_TESTS_FIT_FILES_H

#include "people/compare.h"
#include "ambulo/problem.h"
#include "study/fit.h"
#include "support/messages.h"
#include "support/scratch.h"

static const char fit_problem[] =
    "# a rod\nambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml # the rod\n"
    "angles: radians\ntime: {duration: 1.0, intervals: 10}\ntrajectory: {intervals: 6}\n"
    "ends: {initial: {pin: 0}, final: {pin: 1.0}}\n"
    "objective:\n  - {term: torque_squared, weight: 1}\n"
    "  - {term: acceleration, weight: 2.0} # price\n";
static const char fit_model[] =
    "ambulo: 1\nkind: model\nname: one\nunits: {angle: radians}\ngravity: [0, -9.81, 0]\nforward: "
    "[1, 0, 0]\nlinks:\n"
    "  - {name: rod, parent: none, joint: revolute, dh: [-1.5708, 0, 1, 0], coordinate: {name: "
    "pin, range: [-3, 3]},\n"
    "     body: {mass: 1, com: [-0.5, 0, 0], inertia: [0, 0.1, 0.1, 0, 0, 0]}}\n";

#define FIT_HEAD                                                                                   \
  "ambulo: 1\nkind: fit\nname: swing\nproblem: p.yaml\ncompare: {map: map.csv, foot: left}\n"
#define FIT_PARAMETERS                                                                             \
  "parameters:\n"                                                                                  \
  "  - {name: price, keys: [\"objective[acceleration].weight\"], range: [0.05, 20]}\n"             \
  "  - {name: last, keys: [ends.final.pin], scale: linear, range: [-0.5, 0.5], step: 0.1}\n"
#define FIT_CONDITIONS                                                                             \
  "conditions:\n  - {name: slow, reference: slow.csv}\n"                                           \
  "  - {name: quick, set: {time.duration: 0.7}, reference: quick.csv}\n"
#define FIT_DISTANCE "distance: {curves: {pin: 1}}\n"

/* of a wide layout; deviations or not */
static inline void fit_reference(void **state, const char *name, int deviations) {
  FILE *f = fopen(scratch_path(state, name), "w");
  assert_non_null(f);
  fprintf(f, deviations ? "percent,pin,pin sd\n" : "percent,pin\n");
  for (int p = 0; p <= 100; p += 5) {
    fprintf(f, "%d,%.12g", p, 30.0 + 20.0 * sin(0.0628318530717958648 * p));
    fprintf(f, deviations ? ",2\n" : "\n");
  }
  assert_int_equal(fclose(f), 0);
}

/* everything but the fit file */
static inline void fit_world(void **state) {
  scratch_write(scratch_path(state, "p.yaml"), fit_problem);
  scratch_write(scratch_path(state, "one.yaml"), fit_model);
  scratch_write(scratch_path(state, "map.csv"), "curve,reference,result,unit\npin,pin,q.pin,deg\n");
  fit_reference(state, "slow.csv", 1);
  fit_reference(state, "quick.csv", 1);
  fit_reference(state, "plain.csv", 0);
}

static inline ambulo_status fit_load_text(void **state, const char *text, ambulo_diagnostics *list,
                                          ambulo_fit **fit) {
  scratch_write(scratch_path(state, "fit.yaml"), text);
  return ambulo_fit_load(scratch_path(state, "fit.yaml"), NULL, list, fit);
}

/* the fit of a text that must be read */
static inline ambulo_fit *fit_of(void **state, const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_fit *fit = NULL;
  char buffer[2048] = "";
  fit_world(state);
  ambulo_status status = fit_load_text(state, text, list, &fit);
  ambulo_diagnostics_format(list, 0, buffer, sizeof buffer);
  if (status) print_error("%s\n", buffer);
  assert_int_equal(status, AMBULO_OK);
  ambulo_diagnostics_free(list);
  return fit;
}

/* of a text that must be refused */
static inline size_t fit_errors(void **state, const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_fit *fit = NULL;
  fit_world(state);
  assert_int_not_equal(fit_load_text(state, text, list, &fit), AMBULO_OK);
  size_t errors = ambulo_diagnostics_error_count(list);
  ambulo_diagnostics_free(list);
  return errors;
}

/* the text is refused, and one of the messages says so */
static inline void fit_refused(void **state, const char *text, const char *says) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_fit *fit = NULL;
  char buffer[2048] = "";
  fit_world(state);
  assert_int_not_equal(fit_load_text(state, text, list, &fit), AMBULO_OK);
  assert_null(fit);
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
    ambulo_diagnostics_format(list, i, buffer, sizeof buffer);
    if (strstr(buffer, says)) {
      ambulo_diagnostics_free(list);
      return;
    }
  }
  print_error("said\n  %s\nexpected\n  %s\n", buffer, says);
  fail();
}

/* the program under test */
static inline const char *fit_program(void) {
  const char *program = getenv("AMBULO");
  return program && *program ? program : "build/ambulo";
}

#endif
