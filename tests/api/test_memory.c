/* Every call that reads or writes a file, and takes a list of messages, with memory that gives out
 * at each place that asks for it, once or from there on: E_MEMORY and an error in the list, never
 * another status and never silence, and nothing is leaked. What a call returns for which only a
 * hint got lost is as good as ever. */
#include "ambulo/tools/tools.h"
#include "support/fail_sites.h"
#include "support/gait_folder.h"
#include "support/walker_result.h"

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif
#define MODEL AMBULO_SOURCE_DIR "/models/"
#define SUPPORT AMBULO_SOURCE_DIR "/tests/support/"

typedef struct world {
  void **state;
  walk walk;
  ambulo_model *model; /* a shipped one */
} world;

static world w;

typedef ambulo_status (*call)(const ambulo_allocator *allocator, ambulo_diagnostics *list);

static int open_world(void **state) {
  if (scratch_open(state)) return -1;
  w.state = state;
  walk_open(&w.walk, 12);
  ambulo_report_options options = ambulo_report_options_default();
  const char *folder = scratch_path(state, "result");
  if (ambulo_report_write(w.walk.problem, w.walk.result, folder, &options, NULL, NULL)) return -1;
  return ambulo_model_load(MODEL "pendulum.yaml", NULL, NULL, NULL, &w.model) ? -1 : 0;
}

static int close_world(void **state) {
  ambulo_model_free(w.model);
  walk_close(&w.walk);
  return scratch_close(state);
}

static void try_at(const char *name, call function, long k, int only_once, int *failed) {
  fail_alloc memory = fail_alloc_at(k);
  memory.only_once = only_once;
  ambulo_allocator hook = fail_alloc_hook(&memory);
  /* the list has memory of its own, or shares the hook's shortage */
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = function(&hook, list);
  int told = ambulo_diagnostics_error_count(list) > 0;
  int right = status == AMBULO_OK ? !told && (only_once || !memory.failed)
                                  : status == AMBULO_E_MEMORY && told && memory.failed;
  if (!right || memory.live) {
    char text[512] = "no message";
    if (told) ambulo_diagnostics_format(list, 0, text, sizeof text);
    print_error("%s, request %ld%s: %s, %ld blocks left; %s\n", name, k, only_once ? " alone" : "",
                ambulo_status_name(status), memory.live, text);
  }
  assert_true(right);
  assert_int_equal(memory.live, 0);
  /* and nothing that only follows from it is reported */
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
    const ambulo_diagnostic *one = ambulo_diagnostics_get(list, i);
    if (one->severity != AMBULO_ERROR || one->status == AMBULO_E_MEMORY) continue;
    print_error("%s, request %ld: %s\n", name, k, one->message);
    fail();
  }
  ambulo_diagnostics_free(list);
  *failed = memory.failed;
}

static ambulo_status run(const ambulo_allocator *allocator, void *function) {
  return (*(call *)function)(allocator, NULL);
}

static void try_all(const char *name, call function) {
  static fail_sites sites;
  sites = (fail_sites){.count = 0};
  int count = fail_sites_find(&sites, run, &function), failed = 1;
  for (int i = 0; i < count; i++) {
    for (int only_once = 0; only_once < 2; only_once++)
      try_at(name, function, sites.request[i], only_once, &failed);
    assert_true(failed);
  }
  /* and some between: the same place in another state */
  for (long k = 0; failed; k += 1 + k / 20) try_at(name, function, k, 0, &failed);
  print_message("%s: %d places\n", name, count);
  assert_true(count > 1);
}

/* -------------------------------------------------------------------- calls */

static ambulo_status load_model(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_model *model = NULL;
  ambulo_status status = ambulo_model_load(MODEL "walker_2d.yaml", NULL, a, list, &model);
  ambulo_model_free(model);
  return status;
}

static ambulo_status load_model_text(const ambulo_allocator *a, ambulo_diagnostics *list) {
  static const char text[] = "ambulo: 1\nname: t\nunits: {angle: degrees}\nlinks:\n"
                             "  - {name: rod, parent: none, joint: revolute, dh: [0, 0, 1, 0],\n"
                             "     body: {mass: 2, com: [0, 0, 0], gyration: [0.1, 0.1, 0.1]}}\n";
  ambulo_model *model = NULL;
  ambulo_status status =
      ambulo_model_load_text(text, sizeof text - 1, "t.yaml", NULL, a, list, &model);
  ambulo_model_free(model);
  return status;
}

static ambulo_status adapt_model(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_conditions conditions = ambulo_conditions_default();
  ambulo_model *model = NULL;
  conditions.slope = 0.05;
  ambulo_status status = ambulo_model_adapt(w.model, &conditions, a, list, &model);
  ambulo_model_free(model);
  return status;
}

static ambulo_status load_problem(const ambulo_allocator *a, ambulo_diagnostics *list) {
  static const char *const overrides[] = {"time.intervals=8", "model.links[pelvis].body.mass=3"};
  ambulo_problem *problem = NULL;
  ambulo_status status =
      ambulo_problem_load(SUPPORT "walker_2d_step.yaml", overrides, 1, a, list, &problem);
  ambulo_problem_free(problem);
  return status;
}

/* a reference motion, a table of its own */
static ambulo_status load_tracking(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_problem *problem = NULL;
  ambulo_status status = ambulo_problem_load(AMBULO_SOURCE_DIR "/models/walk_tracking.yaml", NULL,
                                             0, a, list, &problem);
  ambulo_problem_free(problem);
  return status;
}

static ambulo_status load_problem_text(const ambulo_allocator *a, ambulo_diagnostics *list) {
  static const char text[] =
      "ambulo: 1\nkind: problem\nmodel: pendulum.yaml\ntime: {duration: 1, intervals: 4}\n"
      "objective:\n  - {term: torque_squared, weight: 1, scale: {swing: 2}}\n";
  ambulo_problem *problem = NULL;
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = sizeof text - 1,
                                                      .name = "p",
                                                      .directory = MODEL},
                               a, list, &problem);
  ambulo_problem_free(problem);
  return status;
}

static ambulo_status create_problem(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_problem_definition definition = w.walk.problem->definition;
  ambulo_problem *problem = NULL;
  ambulo_status status = ambulo_problem_create(&definition, a, list, &problem);
  ambulo_problem_free(problem);
  return status;
}

static ambulo_status ask_file_kind(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_file_kind kind;
  return ambulo_file_kind_of(MODEL "pendulum.yaml", a, list, &kind);
}

static ambulo_status load_solution(const ambulo_allocator *a, ambulo_diagnostics *list) {
  double *x = calloc((size_t)ambulo_problem_variable_count(w.walk.problem), sizeof *x);
  ambulo_status status = ambulo_solution_load(scratch_path(w.state, "result/solution.yaml"),
                                              w.walk.problem, a, list, x);
  free(x);
  return status;
}

static ambulo_status start_from_solution(const ambulo_allocator *a, ambulo_diagnostics *list) {
  double *x = calloc((size_t)ambulo_problem_variable_count(w.walk.problem), sizeof *x);
  ambulo_status status = ambulo_solution_start(scratch_path(w.state, "result/solution.yaml"),
                                               w.walk.problem, a, list, x);
  free(x);
  return status;
}

static ambulo_status write_report(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_report_options options = ambulo_report_options_default();
  const char *folder = scratch_path(w.state, "again");
  (void)scratch_remove_at(AT_FDCWD, folder);
  ambulo_status status =
      ambulo_report_write(w.walk.problem, w.walk.result, folder, &options, a, list);
  assert_int_equal(access(folder, F_OK) == 0, status == AMBULO_OK); /* whole or not at all */
  return status;
}

static ambulo_status compare_folder(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_comparison *comparison = NULL;
  ambulo_status status = ambulo_compare(
      scratch_path(w.state, "gait"), scratch_path(w.state, "band.csv"), NULL, a, list, &comparison);
  ambulo_comparison_free(comparison);
  return status;
}

/* ------------------------------------------------------------------- solving */

static ambulo_problem *small; /* of solve_with: two links */

static ambulo_status solve_with(const ambulo_allocator *a, ambulo_diagnostics *list,
                                ambulo_algorithm algorithm) {
  ambulo_options options = ambulo_problem_options(small);
  ambulo_result *result = NULL;
  options.algorithm = algorithm;
  options.maximum_iterations = 2;
  ambulo_status status = ambulo_solve(small, &options, NULL, a, list, &result);
  ambulo_result_free(result);
  return status;
}

static ambulo_status solve(const ambulo_allocator *a, ambulo_diagnostics *list) {
  return solve_with(a, list, AMBULO_AUTO);
}

static ambulo_status solve_by_slsqp(const ambulo_allocator *a, ambulo_diagnostics *list) {
  return solve_with(a, list, AMBULO_SLSQP);
}

/* a start that leads nowhere, a second attempt from zero, and an explanation */
static ambulo_status solve_in_vain(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_options options = ambulo_problem_options(small);
  ambulo_result *result = NULL;
  size_t n = (size_t)ambulo_problem_variable_count(small);
  double *start = calloc(n, sizeof *start);
  options.maximum_iterations = 2;
  ambulo_status status = ambulo_solve(small, &options, start, a, list, &result);
  if (!status) assert_non_null(ambulo_result_explanation(result));
  ambulo_result_free(result);
  free(start);
  return status;
}

static ambulo_status audit(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_result *result = NULL;
  ambulo_status status =
      ambulo_audit_point(w.walk.problem, NULL, ambulo_result_x(w.walk.result), a, list, &result);
  ambulo_result_free(result);
  return status;
}

static ambulo_status audit_progress(const ambulo_allocator *a, ambulo_diagnostics *list) {
  ambulo_result *result = NULL;
  const ambulo_progress last = {.point = ambulo_result_x(w.walk.result)};
  ambulo_status status =
      ambulo_audit_progress(w.walk.problem, NULL, &last, AMBULO_ENDING_CALLER, a, list, &result);
  ambulo_result_free(result);
  return status;
}

static ambulo_status inverse(const ambulo_allocator *a, ambulo_diagnostics *list) {
  char *text = NULL;
  ambulo_status status = ambulo_inverse_dynamics_motion(
      ambulo_problem_model(w.walk.problem), scratch_path(w.state, "result/motion.csv"), NULL, NULL,
      a, list, &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  ambulo_text_free(text, a);
  return status;
}

/* -------------------------------------------------------------------- tests */

static void models(void **state) {
  (void)state;
  try_all("ambulo_model_load", load_model);
  try_all("ambulo_model_load_text", load_model_text);
  try_all("ambulo_model_adapt", adapt_model);
}

static void problems(void **state) {
  (void)state;
  try_all("ambulo_problem_load", load_problem);
  try_all("ambulo_problem_load with a reference", load_tracking);
  try_all("ambulo_problem_load_text", load_problem_text);
  try_all("ambulo_problem_create", create_problem);
  try_all("ambulo_file_kind_of", ask_file_kind);
}

static void results(void **state) {
  (void)state;
  try_all("ambulo_solution_load", load_solution);
  try_all("ambulo_solution_start", start_from_solution);
  try_all("ambulo_report_write", write_report);
}

static void comparisons(void **state) {
  assert_int_equal(mkdir(scratch_path(state, "gait"), 0777), 0);
  gait_motion(scratch_path(state, "gait"), 0.0, 1);
  gait_summary(scratch_path(state, "gait"),
               "{\"verdict\": \"optimal\", " GAIT_STRIKES ", " GAIT_BODY "}");
  char band[4096] = "variable,percent,mean_deg,sd_deg\n";
  for (int p = 0; p <= 100; p += 2) {
    char line[64];
    (void)snprintf(line, sizeof line, "hip_flexion,%d,%d,2\n", p, 10 + p % 30);
    strcat(band, line);
  }
  scratch_write(scratch_path(state, "band.csv"), band);
  try_all("ambulo_compare", compare_folder);
}

static void solves(void **state) {
  (void)state;
  assert_int_equal(ambulo_problem_load(MODEL "two_link_reach.yaml", NULL, 0, NULL, NULL, &small),
                   AMBULO_OK);
  try_all("ambulo_solve", solve);
  try_all("ambulo_solve by SLSQP", solve_by_slsqp);
  ambulo_problem_free(small);
  assert_int_equal(ambulo_problem_load(AMBULO_SOURCE_DIR "/tests/infeasible/torque_too_weak.yaml",
                                       NULL, 0, NULL, NULL, &small),
                   AMBULO_OK);
  try_all("ambulo_solve in vain", solve_in_vain);
  ambulo_problem_free(small);
  try_all("ambulo_audit_point", audit);
  try_all("ambulo_audit_progress", audit_progress);
}

static void motions(void **state) {
  (void)state;
  try_all("ambulo_inverse_dynamics_motion", inverse);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, open_world, close_world)
  const struct CMUnitTest tests[] = {TEST(models),      TEST(problems), TEST(results),
                                     TEST(comparisons), TEST(solves),   TEST(motions)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
