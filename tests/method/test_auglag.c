/* NLopt's AUGLAG runs the solve: its multipliers are those that the engine works with, it iterates
 * itself, and without its update nothing is solved. */
#define _GNU_SOURCE /* dlsym's RTLD_NEXT */
#include "base/arithmetic.h"
#include "method/pipeline.h"
#include "support/at_nodes.h"
#include "support/engine_fixture.h"
#include "support/arm.h"

#include <dlfcn.h>
#include <nlopt.h>
#include <unistd.h>

/* --------------------------------------- NLopt with its update defeated, or another one */

static int defeated; /* rows say that they hold by far where an inner solve has ended */
static int other;    /* NLopt reads rows, values and gradients, half as large again */
static struct {
  nlopt_mfunc rows;
  void *data;
  int asked;
} behind[4096];
static size_t used;

static void rows_in_disguise(unsigned m, double *row, unsigned n, const double *w, double *gradient,
                             void *data) {
  size_t k = (size_t)(uintptr_t)data;
  behind[k].rows(m, row, n, w, gradient, behind[k].data);
  for (unsigned i = 0; other && i < m; i++) row[i] *= 1.5;
  for (unsigned j = 0; other && gradient && j < m * n; j++) gradient[j] *= 1.5;
  if (other || gradient || behind[k].asked++ == 0) return;
  for (unsigned i = 0; i < m; i++) row[i] = -1e30;
}

/* stands before NLopt's own */
nlopt_result nlopt_add_inequality_mconstraint(nlopt_opt opt, unsigned m, nlopt_mfunc rows,
                                              void *data, const double *tolerance) {
  typedef nlopt_result (*add)(nlopt_opt, unsigned, nlopt_mfunc, void *, const double *);
  union {
    void *object;
    add function;
  } next = {dlsym(RTLD_NEXT, "nlopt_add_inequality_mconstraint")};
  if (!next.object) return NLOPT_FAILURE;
  if (!defeated && !other) return next.function(opt, m, rows, data, tolerance);
  behind[used].rows = rows;
  behind[used].data = data;
  behind[used].asked = 0;
  used = (used + 1) % (sizeof behind / sizeof *behind);
  return next.function(opt, m, rows_in_disguise,
                       (void *)(uintptr_t)((used + sizeof behind / sizeof *behind - 1) %
                                           (sizeof behind / sizeof *behind)),
                       tolerance);
}

static const char *const walks[] = {"yardstick_12",       "yardstick_36",
                                    "support/walk_rigid", "walk_tracking",
                                    "walk_uphill",        "support/walker_2d_step",
                                    "fig5b_torque",       "support/walk_without_reaction"};
/* their known optima */
static const double optima[] = {0.356402, 1.020010, 0.0603518, 0.0658217,
                                0.107495, 0.953141, 0.135367,  1.13813};
enum { WALKS = sizeof walks / sizeof *walks };

static void without_nlopts_update_nothing_is_solved(void **state) {
  (void)state;
  defeated = 1;
  for (int i = 0; i < WALKS; i++) {
    ambulo_problem *problem = load_problem(walks[i]);
    ambulo_options options = ambulo_problem_options(problem);
    ambulo_result *result = NULL;
    options.maximum_iterations = 60; /* far more than NLopt needs */
    assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
    if (verdict_at_nodes(result) == AMBULO_OPTIMAL)
      print_error("%s: %s\n", walks[i], ambulo_result_ending(result));
    assert_int_not_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
  defeated = 0;
}

/* multipliers that are not the mirror's are met, said, and done without */
static void another_nlopt_is_given_own_gradients(void **state) {
  (void)state;
  static const struct {
    const char *name;
    double optimum;
  } cases[] = {{"support/walker_2d_step", 0.953141},
               {"yardstick_12", 0.356402},
               {"support/two_link_reach", 5.29143}};
  for (int k = 0; k < 2; k++) {
    other = k;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
      ambulo_problem *problem = load_problem(cases[i].name);
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      ambulo_result *result = NULL;
      int said = 0;
      assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, list, &result), AMBULO_OK);
      for (size_t d = 0; d < ambulo_diagnostics_count(list); d++)
        said += strstr(ambulo_diagnostics_get(list, d)->message, "its own gradient") != NULL;
      assert_int_equal(said, k);
      assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
      assert_close(ambulo_result_objective(result) / cases[i].optimum, 1.0, 1e-4);
      ambulo_result_free(result);
      ambulo_diagnostics_free(list);
      ambulo_problem_free(problem);
    }
  }
  other = 0;
}

/* --------------------------------------------------------------------- NLopt as it is */

static void nlopt_iterates(void **state) {
  (void)state;
  for (int i = 0; i < WALKS; i++) {
    ambulo_problem *problem = load_problem(walks[i]);
    ambulo_result *result = NULL;
    assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
    const ambulo_nlopt_work *work = ambulo_result_nlopt(result);
    assert_int_equal(verdict_at_nodes(result), AMBULO_OPTIMAL);
    if (work->outer < 5) print_error("%s: %d outer iterations\n", walks[i], work->outer);
    assert_true(work->outer >= 5 && work->inner >= work->outer && work->calls >= 1);
    assert_int_equal(work->outer, ambulo_result_iterations(result));
    assert_true(work->calls <= 2 + work->outer / 4); /* a grid is a call, or few */
    assert_string_equal(work->result_name, "FORCED_STOP");
    assert_int_equal(work->result, NLOPT_FORCED_STOP);
    assert_true(work->seconds > 0.0 && work->seconds < ambulo_result_timing(result)->total);
    double share = ambulo_result_objective(result) / optima[i];
    if (fabs(share - 1.0) > 1e-3) print_error("%s: %.6f of its optimum\n", walks[i], share);
    assert_true(fabs(share - 1.0) <= 1e-3);
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
}

typedef struct heard {
  const ambulo__engine *engine;
  FILE *file; /* the engine's multipliers, as NLopt would print them */
  int count;
} heard;

static int write_multipliers(void *user, const ambulo_progress *progress) {
  heard *h = user;
  if (isnan(progress->objective)) return 0;
  fprintf(h->file, "mu = ");
  for (int i = 0; i < h->engine->setup->inequalities; i++)
    fprintf(h->file, " %g", h->engine->iterate.lambda[i]);
  fputc('\n', h->file);
  h->count++;
  return 0;
}

/* a line of at most `size`, without its end; 0 at the end of the file */
static int next_line(FILE *file, char *line, size_t size) {
  if (!fgets(line, (int)size, file)) return 0;
  line[strcspn(line, "\n")] = '\0';
  return 1;
}

/* "auglag 7: mu = ..." lines of NLopt beside ours, all of them */
static int compare(FILE *theirs, FILE *ours) {
  enum { LONG = 1 << 18 };
  char *line = malloc(LONG), *own = malloc(LONG);
  int same = 0;
  rewind(theirs);
  rewind(ours);
  while (next_line(theirs, line, LONG)) {
    char *mu = strstr(line, ": mu = ");
    if (!mu) continue;
    assert_true(next_line(ours, own, LONG));
    if (strcmp(mu + 2, own) != 0) print_error("NLopt %.200s\nours  %.200s\n", mu + 2, own);
    assert_string_equal(mu + 2, own);
    same++;
  }
  assert_false(next_line(ours, own, LONG));
  free(line);
  free(own);
  return same;
}

static void multipliers_are_nlopts(void **state) {
  (void)state;
  static const char *const names[] = {"yardstick_12", "support/walker_2d_step",
                                      "support/walk_rigid"};
  int *verbose = dlsym(RTLD_DEFAULT, "auglag_verbose");
  if (!verbose) skip(); /* an NLopt that keeps it to itself */
  for (int i = 0; i < 3; i++) {
    engine_fixture f;
    engine_open(&f, names[i]);
    heard h = {f.engine, tmpfile(), 0};
    FILE *printed = tmpfile();
    assert_true(h.file && printed);
    f.options.progress = write_multipliers;
    f.options.user = &h;
    (void)fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    assert_true(dup2(fileno(printed), STDOUT_FILENO) >= 0);
    *verbose = 1;
    ambulo_status status = ambulo__pipeline(f.engine, AMBULO__FAR, f.x);
    *verbose = 0;
    (void)fflush(stdout);
    assert_true(dup2(kept, STDOUT_FILENO) >= 0);
    (void)close(kept);
    assert_int_equal(status, AMBULO_OK);
    assert_int_equal(compare(printed, h.file), h.count);
    assert_true(h.count >= 5);
    (void)fclose(h.file);
    (void)fclose(printed);
    engine_close(&f);
  }
}

/* NLopt starts with the engine's lambda and R, whether rows are violated or not */
static void nlopt_starts_where_the_engine_is(void **state) {
  (void)state;
  for (int run = 0; run < 3; run++) {
    engine_fixture f;
    ambulo_ending ending;
    engine_open_restored(&f, run == 2 ? "support/two_link_reach" : "yardstick_12");
    ambulo__engine *e = f.engine;
    ambulo__stopping stopping = ambulo__stopping_begin(0);
    assert_int_equal(ambulo__evaluate(e->workspace, f.x), AMBULO_OK);
    assert_int_equal(ambulo__engine_excess(e, e->measured.excess) > 0.0, run < 2);
    for (int i = 0; i < e->setup->inequalities; i++) e->iterate.lambda[i] = run == 1 ? 0.25 : 0.0;
    e->iterate.rho = 160.0;
    f.options.maximum_evaluations = f.run.evaluations + 3; /* in the first inner solve */
    assert_int_equal(ambulo__auglag(e, &stopping, f.x, &ending), AMBULO_OK);
    assert_int_equal(f.run.nlopt.outer, 0);
    assert_close(e->iterate.rho, 160.0, 1e-9);
    for (int i = 0; i < e->setup->inequalities; i++)
      assert_close(e->iterate.lambda[i], run == 1 ? 0.25 : 0.0, 1e-12);
    engine_close(&f);
  }
}

static void the_penalty_keeps_its_bound(void **state) {
  (void)state;
  engine_fixture f;
  ambulo_ending ending;
  engine_open_restored(&f, "yardstick_12");
  ambulo__stopping stopping = ambulo__stopping_begin(0);
  stopping.penalty_limit = 15.0;
  f.options.maximum_iterations = 6;
  assert_int_equal(ambulo__auglag(f.engine, &stopping, f.x, &ending), AMBULO_OK);
  assert_int_equal(ending, AMBULO_ENDING_ITERATIONS);
  assert_int_equal(f.run.nlopt.outer, 6);
  assert_close(f.engine->iterate.rho, 15.0, 1e-9);
  engine_close(&f);
}

static void a_centre_that_is_not_finite_is_told(void **state) {
  (void)state;
  engine_fixture f;
  ambulo_ending ending = AMBULO_ENDING_NONE;
  engine_open_restored(&f, "yardstick_12");
  ambulo__stopping stopping = ambulo__stopping_begin(0);
  f.x[4] = NAN;
  assert_int_equal(ambulo__auglag(f.engine, &stopping, f.x, &ending), AMBULO_OK);
  assert_int_equal(ending, AMBULO_ENDING_NOT_FINITE);
  engine_close(&f);
}

/* without limits there is nothing to multiply */
static void no_rows_need_no_penalty(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  engine_fixture f = {.options = ambulo_options_default()};
  d.joint_limits = AMBULO_LIMIT_OFF;
  d.speed_limits = d.torque_limits = 0;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.n = ambulo_problem_variable_count(f.problem);
  f.x = calloc((size_t)f.n, sizeof *f.x);
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  assert_int_equal(f.engine->setup->inequalities, 0);
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  assert_int_equal(f.run.ending, AMBULO_ENDING_CONVERGED);
  assert_close(f.engine->iterate.rho, 10.0, 1e-9);
  engine_close(&f);
  ambulo_model_free(model);
}

/* NLopt's first point beside the start is the model step, whether rows are violated or not */
static void the_first_trial_is_the_model_step(void **state) {
  (void)state;
  static const char *const names[] = {"support/two_link_reach", "yardstick_12"};
  for (int i = 0; i < 2; i++) {
    engine_fixture f;
    ambulo_ending ending;
    engine_open_restored(&f, names[i]);
    ambulo__engine *e = f.engine;
    ambulo__stopping stopping = ambulo__stopping_begin(0);
    f.options.maximum_evaluations = f.run.evaluations + 2;
    assert_int_equal(ambulo__auglag(e, &stopping, f.x, &ending), AMBULO_OK);
    double part = ambulo__step_limit(e->setup, e->quadratic->total, 0.5);
    double *step = calloc((size_t)f.n, sizeof *step);
    memcpy(step, e->quadratic->total, (size_t)f.n * sizeof *step);
    ambulo__band_upper_multiply(&e->linearized.whitener, step);
    double size = ambulo__largest(step, (size_t)f.n);
    assert_true(size > 0.0);
    for (int j = 0; j < f.n; j++) assert_close((e->last->w[j] - part * step[j]) / size, 0.0, 1e-8);
    free(step);
    engine_close(&f);
  }
}

/* from where it ended there is nothing to descend: below the accuracy of a gradient no line search
 * is begun; and what was not finite on the way is forgiven with the first point */
static void a_solution_is_left_alone(void **state) {
  (void)state;
  engine_fixture f;
  ambulo_ending ending = AMBULO_ENDING_NONE;
  engine_open(&f, "support/walk_rigid");
  assert_int_equal(ambulo__pipeline(f.engine, AMBULO__FAR, f.x), AMBULO_OK);
  int outer = f.run.nlopt.outer, inner = f.run.nlopt.inner;
  ambulo__stopping stopping = ambulo__stopping_begin(0);
  f.run.faults_lately = 5;
  assert_int_equal(ambulo__auglag(f.engine, &stopping, f.x, &ending), AMBULO_OK);
  assert_true(ending == AMBULO_ENDING_CONVERGED || ending == AMBULO_ENDING_SETTLED);
  outer = f.run.nlopt.outer - outer;
  assert_true(outer >= 1 && f.run.nlopt.inner - inner <= 6 * outer);
  assert_int_equal(f.run.faults_lately, 0);
  engine_close(&f);
}

/* more unknowns than the objective knows of, and next to no damping: the metric is factored
 * all the same (kkt.c) */
static void next_to_no_damping_is_enough(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition d = arm_definition(model);
  engine_fixture f = {.options = ambulo_options_default()};
  ambulo_ending ending = AMBULO_ENDING_NONE;
  double error;
  d.intervals = 6;
  d.spline_intervals = 16;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &f.problem), AMBULO_OK);
  f.x = calloc((size_t)f.problem->variables, sizeof *f.x);
  ambulo__run_begin(&f.run, &f.options);
  assert_int_equal(ambulo__engine_create(f.problem, f.x, NULL, &f.run, NULL, &f.engine), AMBULO_OK);
  f.engine->iterate.mu = 0.05;
  f.engine->iterate.rho = 10.0;
  assert_int_equal(ambulo__restore(f.engine, f.x, &error), AMBULO_OK);
  ambulo__stopping stopping = ambulo__stopping_begin(0);
  f.engine->iterate.mu = 1e-10;
  f.options.maximum_iterations = 3;
  assert_int_equal(ambulo__auglag(f.engine, &stopping, f.x, &ending), AMBULO_OK);
  assert_true(f.run.nlopt.outer >= 1 && ending != AMBULO_ENDING_BREAKDOWN);
  engine_close(&f);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(without_nlopts_update_nothing_is_solved),
                                     cmocka_unit_test(another_nlopt_is_given_own_gradients),
                                     cmocka_unit_test(nlopt_iterates),
                                     cmocka_unit_test(multipliers_are_nlopts),
                                     cmocka_unit_test(nlopt_starts_where_the_engine_is),
                                     cmocka_unit_test(the_penalty_keeps_its_bound),
                                     cmocka_unit_test(a_centre_that_is_not_finite_is_told),
                                     cmocka_unit_test(no_rows_need_no_penalty),
                                     cmocka_unit_test(the_first_trial_is_the_model_step),
                                     cmocka_unit_test(a_solution_is_left_alone),
                                     cmocka_unit_test(next_to_no_damping_is_enough)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
