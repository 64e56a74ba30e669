/* Problems and solutions whose memory gives out at each place that asks for it: E_MEMORY, nothing
 * leaked, no problem and no point. */
#include "ambulo/tools/tools.h"
#include "support/fail_sites.h"
#include "show/report.h"
#include "support/scratch.h"
#include "support/walker_result.h"

static fail_sites sites;

static ambulo_status load(const ambulo_allocator *a, void *data) {
  ambulo_problem *p = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_load(data, NULL, 0, a, list, &p);
  assert_int_equal(p != NULL, status == AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_error_count(list) > 0, status != AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(p);
  return status;
}

/* one of each kind: devices, holds, feet, references, obstacles, free numbers, tasks */
static void problems(void **state) {
  (void)state;
  static const char *const files[] = {"pendulum_swing", "run_exotendon", "walk_ankle_exoskeleton",
                                      "walk_tracking",  "step_over",     "stairs_up",
                                      "walk_carrying",  "walk_turn"};
  for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
    char path[200];
    (void)snprintf(path, sizeof path, "models/%s.yaml", files[i]);
    print_message("%s: %d places\n", files[i], fail_at_every_site(&sites, load, path, 2));
  }
}

static ambulo_status load_text(const ambulo_allocator *a, void *text) {
  ambulo_problem *p = NULL;
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = strlen(text),
                                                      .name = "p",
                                                      .directory = "models"},
                               a, NULL, &p);
  ambulo_problem_free(p);
  return status;
}

/* pairs of capsules by name, obstacles, breakpoints, holds, scales by name, free numbers */
static void texts(void **state) {
  (void)state;
  static const char *const all[] = {
      "ambulo: 1\nkind: problem\nmodel: lower_body_21.yaml\ntime: {duration: 1, intervals: 8}\n"
      "trajectory: {breakpoints: [0, 0.25, 0.5, 1]}\nangles: degrees\n"
      "objective: [{term: torque_squared, scale: {knee_angle_r: 2, default: 3}, name: a}]\n"
      "constraints: {collision: {pairs: [[shank_l, shank_r], [foot_l, foot_r]]}}\n"
      "obstacles: [{name: o, from: [0, 0, 3], to: [1, 0, 3], radius: 0.1, "
      "capsules: [shank_l, foot_l]}]\n",
      "ambulo: 1\nkind: problem\nmodel: walker_2d.yaml\ntime: {duration: 1, intervals: 8}\n"
      "angles: degrees\nobjective: [{term: torque_power, strength: limits, "
      "scale: {knee_angle_r: [1, 2], default: 0}}, {term: torque_squared, offset: {pelvis_ty: "
      "body_weight}}]\n"
      "load: [{link: pelvis, mass: 5, position: [0, 0, 0]}, {link: pelvis, mass: 2, position: [0, "
      "0.1, 0]}]\n"
      "contacts: [{foot: left, mode: flat, from: 0, to: 1, place: [0, 0]}]\n"};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
    char text[1500];
    (void)snprintf(text, sizeof text, "%s", all[i]);
    print_message("text %zu: %d places\n", i, fail_at_every_site(&sites, load_text, text, 2));
  }
}

/* no warning is lost: a problem without it is none */
static ambulo_status load_warned(const ambulo_allocator *a, void *text) {
  ambulo_problem *p = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status =
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = text,
                                                      .length = strlen(text),
                                                      .name = "p",
                                                      .directory = "models"},
                               a, list, &p);
  if (!status) assert_int_equal(ambulo_diagnostics_count(list), 1);
  ambulo_diagnostics_free(list);
  ambulo_problem_free(p);
  return status;
}

static void a_warning(void **state) {
  (void)state;
  static fail_sites of_warnings;
  char text[] = "ambulo: 1\nkind: problem\nmodel: lower_body_21.yaml\n"
                "time: {duration: 1, intervals: 8}\nobjective: none\n"
                "constraints: {collision: {pairs: [[shank_l, thigh_l]]}}\n";
  assert_true(fail_at_every_site(&of_warnings, load_warned, text, 2) > 50);
}

/* ------------------------------------------------------------------------ solutions */

typedef struct start {
  const char *path;
  ambulo_problem *problem;
  double *x, *before;
  size_t size;
  ambulo_status (*call)(const char *path, const ambulo_problem *problem,
                        const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                        double *x);
} start;

static ambulo_status read_start(const ambulo_allocator *a, void *data) {
  start *s = data;
  memcpy(s->x, s->before, s->size);
  ambulo_status status = s->call(s->path, s->problem, a, NULL, s->x);
  if (status) assert_memory_equal(s->x, s->before, s->size); /* as it was */
  return status;
}

static ambulo_status repeat(const char *path, const ambulo_problem *problem,
                            const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                            double *x) {
  return ambulo_solution_repeat(path, problem, AMBULO_ENDS_PERIODIC, allocator, diagnostics, x);
}

static void solutions(void **state) {
  walk w;
  ambulo__text_buffer text;
  walk_open(&w, 12);
  ambulo__text_init(&text, NULL);
  ambulo__solution_yaml(w.problem, w.result, &text);
  const char *path = scratch_path(state, "solution.yaml");
  scratch_write(path, ambulo__text_data(&text));
  ambulo__text_free(&text);
  size_t n = (size_t)ambulo_problem_variable_count(w.problem);
  start s = {.path = path, .problem = w.problem, .size = n * sizeof(double)};
  s.x = calloc(n, sizeof *s.x);
  s.before = calloc(n, sizeof *s.before);
  for (size_t i = 0; i < n; i++) s.before[i] = 1.0 + (double)i;
  ambulo_status (*const calls[])(const char *, const ambulo_problem *, const ambulo_allocator *,
                                 ambulo_diagnostics *,
                                 double *) = {ambulo_solution_load, ambulo_solution_start, repeat};
  for (int i = 0; i < 3; i++) {
    s.call = calls[i];
    print_message("solution %d: %d places\n", i, fail_at_every_site(&sites, read_start, &s, 2));
  }
  free(s.x);
  free(s.before);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(problems), cmocka_unit_test(texts), cmocka_unit_test(a_warning),
      cmocka_unit_test_setup_teardown(solutions, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
