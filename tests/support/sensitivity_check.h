/* tests/support/sensitivity_check.h - every number that a file has a name for: the derivative of
 * the Lagrangian by hand against central differences over problems that are read anew with the
 * number moved, at the same point and with the same multipliers. The identity holds at any point
 * and with any multipliers, so that those are chosen such that every row counts: the best point a
 * little off, random multipliers. */
#ifndef AMBULO_TESTS_SENSITIVITY_CHECK_H
#define AMBULO_TESTS_SENSITIVITY_CHECK_H

#include "ambulo/tools/tools.h"
#include "solver/result.h"
#include "solver/sensitivity.h"
#include "support/moved_problem.h"

enum { MOST_OVERRIDES = 14, MOST_WANTED = 20 };

typedef struct setting {
  const char *file;
  const char *overrides[MOST_OVERRIDES];
  const char *wanted[MOST_WANTED]; /* names that have to be among those compared */
} setting;

static inline double noise(unsigned *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 8388608.0 - 1.0;
}

/* a result that says so of itself, at a point that is none */
static inline ambulo_result *scattered(const ambulo_problem *problem) {
  ambulo_result *result = NULL;
  ambulo_options options = ambulo_problem_options(problem);
  unsigned state = 7;
  options.maximum_iterations = 3;
  options.continuation = 0;
  options.feasibility_tolerance = options.optimality_tolerance = 1.0; /* and nothing is explained */
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  for (int i = 0; i < result->variables; i++) result->x[i] += 1e-3 * noise(&state);
  for (int r = 0; r < result->rows; r++) result->multiplier[r] = 0.1 * noise(&state);
  result->verdict = AMBULO_OPTIMAL;
  return result;
}

/* of phases, of times of contacts and of what hands hold */
static inline int moves_nodes(const ambulo_sensitivity *s) {
  int of_contact = strncmp(s->name, "contacts[", 9) == 0 && strcmp(s->unit, "s") == 0;
  int of_hold = strncmp(s->name, "load", 4) == 0 && strcmp(s->unit, "s") == 0;
  return of_contact || of_hold || strncmp(s->name, "gait.phases.", 12) == 0;
}

static inline double step_of(const ambulo_sensitivity *s) {
  if (moves_nodes(s)) return 2e-6; /* of nodes that are 1e-3 of a stride apart */
  return s->value == 0.0 ? 1e-3 * s->step : 1e-5 * fmax(fabs(s->value), 0.1 * s->step);
}

/* more than what rounding leaves of a derivative that is none */
static inline int counts(const ambulo_sensitivity *s) {
  return fabs(s->derivative) * fmax(fabs(s->value), s->step) > 1e-10;
}

/* 0: the file refuses the number moved. Differences of fourth order: third derivatives with events
 * go with the third power of a node's rate */
static inline int compare(const setting *c, int count, const ambulo_problem *problem,
                          const ambulo_result *r, const ambulo_sensitivity *s) {
  static const double at[4] = {-1.0, 1.0, -2.0, 2.0};
  double value[4] = {NAN, NAN, NAN, NAN}, travel[4] = {0.0}, by = step_of(s);
  for (int k = 0; k < 4; k++) {
    ambulo_problem *moved = moved_problem(c->file, c->overrides, count, problem, s, at[k] * by);
    if (moved) value[k] = lagrangian_at(moved, r->x, r->multiplier, r->rows);
    if (moved) travel[k] = moved->definition.travel;
    ambulo_problem_free(moved);
  }
  double difference = (value[1] - value[0]) / (2.0 * by);
  double wider = (value[3] - value[2]) / (4.0 * by);
  if (isnan(difference)) return 0;
  if (!isnan(wider)) difference = (4.0 * difference - wider) / 3.0;
  double further = (travel[1] - travel[0]) / (2.0 * by);
  if (!(fabs(further - s->travel) <= 1e-8 * (1.0 + fabs(s->travel))))
    fail_msg("%s: %s carries by %.12g, %.12g by differences", c->file, s->name, s->travel, further);
  /* what rounding leaves of a difference of two values of this size */
  double slack = 1e-7 * fabs(s->derivative) + 1e-14 * (fabs(value[0]) + 1.0) / by;
  if (fabs(difference - s->derivative) <= slack) return 1;
  fail_msg("%s: %s is %.12g by hand, %.12g by differences (+- %.1g)", c->file, s->name,
           s->derivative, difference, slack);
  return 1;
}

/* a setting with its numbers at a scattered point */
typedef struct listed {
  int count; /* of overrides */
  ambulo_problem *problem;
  ambulo_result *result;
  ambulo_sensitivity_list *list;
} listed;

static inline listed list_open(const setting *c) {
  listed l = {0};
  while (l.count < MOST_OVERRIDES && c->overrides[l.count]) l.count++;
  assert_int_equal(ambulo_problem_load(c->file, c->overrides, l.count, NULL, NULL, &l.problem),
                   AMBULO_OK);
  l.result = scattered(l.problem);
  /* derivatives alone: their errors take a solve each time, tests/solver/test_sensitivity_errors.c
   */
  assert_int_equal(ambulo__sensitivities_nearly(l.problem, l.result, NULL, 0, NULL, &l.list),
                   AMBULO_OK);
  assert_true(l.list->count > 6);
  return l;
}

static inline void list_close(listed *l) {
  ambulo_sensitivities_free(l->list);
  ambulo_result_free(l->result);
  ambulo_problem_free(l->problem);
}

static inline void expect_no_number(const listed *l, const char *name) {
  for (int i = 0; i < l->list->count; i++) assert_string_not_equal(name, l->list->items[i].name);
}

/* what a setting says already, by a word of it */
static inline int says(const setting *c, const char *word) {
  for (int k = 0; k < MOST_OVERRIDES && c->overrides[k]; k++)
    if (strstr(c->overrides[k], word)) return 1;
  return 0;
}

static inline void override(setting *c, const char *text) {
  int count = 0;
  while (count < MOST_OVERRIDES && c->overrides[count]) count++;
  if (count < MOST_OVERRIDES) c->overrides[count] = text;
}

/* As small as the claim allows: without rows between bodies, and walks on half of their intervals,
 * which still are several a phase; unless the setting is about them. */
static inline setting small_setting(const setting *c) {
  setting s = *c;
  if (!says(c, "collision")) override(&s, "constraints.collision=off");
  if (!says(c, "time.intervals") && !strncmp(c->file, "models/walk_", 12))
    override(&s, strstr(c->file, "asymmetric") ? "time.intervals=64" : "time.intervals=32");
  return s;
}

static inline int is_wanted(const setting *c, const ambulo_sensitivity *s) {
  for (int k = 0; k < MOST_WANTED && c->wanted[k]; k++)
    if (strcmp(c->wanted[k], s->name) == 0) return 1;
  return 0;
}

/* Those wanted and a third of the others, which settings of one file have in common; with
 * AMBULO_LONG all. `unwanted`: a name that has no derivative; NULL */
static inline void check(const setting *given, const char *unwanted) {
  const setting own = small_setting(given), *c = &own;
  listed l = list_open(c);
  int compared = 0, found[MOST_WANTED] = {0}, thirds = getenv("AMBULO_LONG") ? 1 : 3;
  static int settings;
  settings++; /* another third in each */
  for (int i = 0; i < l.list->count; i++) {
    const ambulo_sensitivity *s = &l.list->items[i];
    if ((i + settings) % thirds && !is_wanted(c, s)) continue;
    int did = compare(c, l.count, l.problem, l.result, s);
    compared += did;
    for (int k = 0; k < MOST_WANTED && c->wanted[k]; k++)
      found[k] |= did && counts(s) && strcmp(c->wanted[k], s->name) == 0;
  }
  for (int k = 0; k < MOST_WANTED && c->wanted[k]; k++)
    if (!found[k]) fail_msg("%s: %s was not compared", c->file, c->wanted[k]);
  if (unwanted) expect_no_number(&l, unwanted);
  assert_true(compared > 6 / thirds);
  list_close(&l);
}

/* no number has one of these names; the last is NULL */
static inline void expect_absent(const setting *given, const char *const *names) {
  const setting own = small_setting(given), *c = &own;
  listed l = list_open(c);
  for (; *names; names++) expect_no_number(&l, *names);
  list_close(&l);
}

#endif
