/* Eight threads on the same model, problem, result and sweep: each call gives the bytes that it
 * gives alone. Nothing is locked; `make check-threads` has the sanitizer watch. */
#include <pthread.h>

#include "ambulo/tools/tools.h"
#include "support/scratch.h"

enum { THREADS = 8, ROUNDS = 3, MOST_TEXT = 1 << 17 };

/* what all of them read */
typedef struct shared {
  const ambulo_model *model;
  const ambulo_problem *problem;
  const ambulo_result *result;
  const ambulo_sweep *sweep;
} shared;

/* what one of them found, in bytes */
typedef struct findings {
  const shared *of;
  char *bytes;
  size_t used;
  int bad;
} findings;

static void note(findings *f, const void *bytes, size_t length) {
  if (f->used + length > MOST_TEXT) {
    f->bad = 1;
    return;
  }
  memcpy(f->bytes + f->used, bytes, length);
  f->used += length;
}

static void note_text(findings *f, const char *text) {
  if (text) note(f, text, strlen(text) + 1);
}

static void ask_model(findings *f) {
  const ambulo_model *m = f->of->model;
  enum { NODES = 9 };
  int d = ambulo_model_coordinate_count(m);
  double *q = calloc((size_t)(4 * NODES * d), sizeof *q), mass = ambulo_model_mass(m);
  ambulo_mechanics *mechanics = NULL;
  ambulo_outputs outputs = ambulo_outputs_default();
  if (!q || ambulo_mechanics_create(m, NULL, &mechanics)) {
    f->bad = 1;
    free(q);
    return;
  }
  for (int i = 0; i < 3 * NODES * d; i++) q[i] = 0.2 * sin(0.7 * i);
  outputs.tau = q + 3 * NODES * d;
  f->bad |= ambulo_mechanics_inverse_dynamics(mechanics, NODES, q, q + NODES * d, q + 2 * NODES * d,
                                              &outputs) != AMBULO_OK;
  note(f, &mass, sizeof mass);
  note(f, outputs.tau, (size_t)(NODES * d) * sizeof *q);
  for (int i = 0; i < d; i++) note_text(f, ambulo_model_coordinate(m, i)->name);
  ambulo_mechanics_free(mechanics);
  free(q);
}

static void ask_problem(findings *f) {
  const ambulo_problem *p = f->of->problem;
  size_t n = (size_t)ambulo_problem_variable_count(p), m = (size_t)ambulo_problem_row_count(p);
  double *x = calloc(2 * n + m, sizeof *x), objective = 0.0;
  ambulo_workspace *workspace = NULL;
  if (!x || ambulo_workspace_create(p, NULL, &workspace)) {
    f->bad = 1;
    free(x);
    return;
  }
  for (size_t i = 0; i < n; i++) x[i] = 0.3 * sin(1.0 + 0.9 * (double)i);
  f->bad |= ambulo_problem_evaluate(p, workspace, x, &objective, NULL, x + 2 * n) != AMBULO_OK;
  f->bad |= ambulo_problem_gradient(p, workspace, x, 1.0, NULL, x + n) != AMBULO_OK;
  note(f, x + n, (n + m) * sizeof *x);
  note(f, &objective, sizeof objective);
  unsigned long long hash = ambulo_problem_hash(p);
  note(f, &hash, sizeof hash);
  ambulo_workspace_free(workspace);
  free(x);
}

/* a solve from the shared result, its audit, its text without what the clock says */
static void ask_solver(findings *f) {
  const ambulo_problem *p = f->of->problem;
  size_t n = (size_t)ambulo_problem_variable_count(p);
  ambulo_options options = ambulo_problem_options(p);
  ambulo_result *solved = NULL, *audited = NULL;
  ambulo_sensitivity_list *list = NULL;
  options.maximum_iterations = 4;
  f->bad |= ambulo_solve(p, &options, NULL, NULL, NULL, &solved) != AMBULO_OK;
  f->bad |= ambulo_audit_point(p, &options, ambulo_result_x(f->of->result), NULL, NULL, &audited) !=
            AMBULO_OK;
  f->bad |= ambulo_sensitivities(p, f->of->result, NULL, &list) != AMBULO_OK;
  if (!f->bad) {
    note(f, ambulo_result_x(solved), n * sizeof(double));
    note(f, ambulo_result_multipliers(audited),
         (size_t)ambulo_problem_row_count(p) * sizeof(double));
    for (int i = 0; i < list->count; i++) {
      note_text(f, list->items[i].name);
      note(f, &list->items[i].derivative, sizeof(double));
    }
  }
  ambulo_sensitivities_free(list);
  ambulo_result_free(audited);
  ambulo_result_free(solved);
}

static void ask_tools(findings *f) {
  char *text = NULL;
  ambulo_case one;
  f->bad |= ambulo_report_summary(f->of->problem, f->of->result, NULL, NULL, &text) != AMBULO_OK;
  note_text(f, text);
  ambulo_text_free(text, NULL);
  for (int k = 0; k < ambulo_sweep_case_count(f->of->sweep); k++) {
    f->bad |= ambulo_sweep_case(f->of->sweep, k, &one) != AMBULO_OK;
    note_text(f, one.id);
    note_text(f, one.name);
  }
}

static void *ask_all(void *argument) {
  findings *f = argument;
  for (int k = 0; k < ROUNDS; k++) {
    ask_model(f);
    ask_problem(f);
    ask_solver(f);
    ask_tools(f);
  }
  return NULL;
}

static void open_shared(void **state, shared *s) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_sweep *sweep = NULL;
  assert_int_equal(ambulo_problem_load("models/two_link_reach.yaml", NULL, 0, NULL, NULL, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  char text[1200], here[900];
  assert_non_null(getcwd(here, sizeof here));
  (void)snprintf(text, sizeof text,
                 "ambulo: 1\nkind: sweep\nname: s\nbase: %s/models/two_link_reach.yaml\n"
                 "axes:\n  - {key: time.duration, values: [1, 1.1, 1.2]}\n",
                 here);
  scratch_write(scratch_path(state, "s.yaml"), text);
  assert_int_equal(ambulo_sweep_load(scratch_path(state, "s.yaml"), NULL, NULL, &sweep), AMBULO_OK);
  *s = (shared){ambulo_problem_model(problem), problem, result, sweep};
}

static void same_bytes_in_eight_threads(void **state) {
  shared s;
  findings found[THREADS + 1];
  pthread_t handle[THREADS];
  open_shared(state, &s);
  for (int i = 0; i <= THREADS; i++) {
    found[i] = (findings){.of = &s, .bytes = calloc(1, MOST_TEXT)};
    assert_non_null(found[i].bytes);
  }
  (void)ask_all(&found[THREADS]);
  for (int i = 0; i < THREADS; i++)
    assert_int_equal(pthread_create(&handle[i], NULL, ask_all, &found[i]), 0);
  for (int i = 0; i < THREADS; i++) assert_int_equal(pthread_join(handle[i], NULL), 0);
  assert_true(found[THREADS].used > 20000);
  for (int i = 0; i <= THREADS; i++) {
    assert_false(found[i].bad);
    assert_int_equal(found[i].used, found[THREADS].used);
    assert_memory_equal(found[i].bytes, found[THREADS].bytes, found[i].used);
    free(found[i].bytes);
  }
  ambulo_sweep_free((ambulo_sweep *)s.sweep);
  ambulo_result_free((ambulo_result *)s.result);
  ambulo_problem_free((ambulo_problem *)s.problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(same_bytes_in_eight_threads, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
