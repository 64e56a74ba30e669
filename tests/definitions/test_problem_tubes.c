/* Tubes in a problem file: sampling, widths in the file's unit, other grids, refusals. */
#include "problem/problem.h"
#include "definitions/problem_text.h"
#include "support/scratch.h"

static const char table[] = "time,knee_angle_r,pelvis_tx\n0,0.0,0\n0.5,1.0,0.4\n1,0.0,0.6\n";

/* a walker with `tubes` as value of constraints.tubes; %s in it is the table's path */
static const char *problem_text(void **state, const char *tubes) {
  static char text[2048];
  const char *path = scratch_path(state, "walk.csv");
  const char *hole = strstr(tubes, "FILE");
  scratch_write(path, table);
  (void)snprintf(text, sizeof text,
                 WALKER "angles: degrees\ntime: {duration: 1, intervals: 4}\n"
                        "constraints: {tubes: %.*s%s%s}\nobjective: none\n",
                 hole ? (int)(hole - tubes) : (int)strlen(tubes), tubes, hole ? path : "",
                 hole ? hole + 4 : "");
  return text;
}

static void widths_and_samples(void **state) {
  ambulo_problem *p = problem_of(
      problem_text(state, "[{reference: FILE, coordinates: {knee_angle_r: 9, pelvis_tx: 0.02}}]"));
  const ambulo_tube *tube = &p->definition.tubes[0];
  int knee = ambulo_model_find_coordinate(p->model, "knee_angle_r");
  int other = ambulo_model_find_coordinate(p->model, "knee_angle_l");
  assert_int_equal(p->definition.tube_count, 1);
  assert_int_equal(tube->samples, 41);
  assert_close(tube->half_width[knee], 0.15707963267948966, 1e-15);
  assert_true(isinf(tube->half_width[other]));
  assert_close(tube->reference[10 * p->coordinates + knee], 0.5, 1e-14);
  assert_int_equal(p->rows, 2 * 2 * 5);
  ambulo_problem_free(p);
}

/* the rows' gradient is that of the curve, and another grid keeps the tube */
static void rows_and_grids(void **state) {
  ambulo_problem *p =
      problem_of(problem_text(state, "[{reference: FILE, coordinates: {knee_angle_r: 9}}]"));
  ambulo_problem *fine = NULL;
  ambulo_workspace *workspace = NULL;
  ambulo_derivative_error errors[8];
  int count = 0;
  double *x = calloc((size_t)p->variables, sizeof *x);
  double *rows = calloc((size_t)p->rows, sizeof *rows);
  assert_int_equal(ambulo_workspace_create(p, NULL, &workspace), AMBULO_OK);
  assert_int_equal(ambulo_problem_evaluate(p, workspace, x, NULL, NULL, rows), AMBULO_OK);
  assert_close(rows[4], 0.15707963267948966 - 1.0, 1e-12);
  assert_close(rows[5], 0.15707963267948966 + 1.0, 1e-12);
  assert_int_equal(ambulo_problem_check_derivatives(p, workspace, x, 0.0, errors, 8, &count), 0);
  assert_true(count >= 1);
  assert_string_equal(errors[0].family, "tracking_tube");
  assert_true(errors[0].error < 1e-8);
  assert_int_equal(ambulo__problem_with_grid(p, 40, 4, NULL, &fine), AMBULO_OK);
  assert_int_equal(fine->rows, 2 * 41);
  ambulo_row row;
  assert_int_equal(ambulo_problem_row(fine, 2 * 7, &row), AMBULO_OK);
  assert_close(fine->table.rows[2 * 7].constant, -(0.35 - 0.15707963267948966), 1e-12);
  assert_close(row.time, 0.175, 1e-12);
  free(x);
  free(rows);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(fine);
  ambulo_problem_free(p);
}

static void refusals(void **state) {
  static const struct {
    const char *tubes, *message;
    ambulo_status status;
  } cases[] = {
      {"{reference: FILE}", "expected a list", AMBULO_E_SCHEMA},
      {"[FILE]", "expected a mapping", AMBULO_E_SCHEMA},
      {"[{coordinates: {knee_angle_r: 9}}]", "reference", AMBULO_E_SCHEMA},
      {"[{reference: FILE}]", "coordinates", AMBULO_E_SCHEMA},
      {"[{reference: FILE, coordinates: [knee_angle_r]}]", "half widths", AMBULO_E_SCHEMA},
      {"[{reference: FILE, coordinates: {knee_angel_r: 9}}]", "knee_angle_r", AMBULO_E_SCHEMA},
      {"[{reference: FILE, coordinates: {knee_angle_r: -9}}]", "a half width of -9",
       AMBULO_E_SCHEMA},
      {"[{reference: FILE, coordinates: {knee_angle_l: 9}}]",
       "the reference has no column for 'knee_angle_l'", AMBULO_E_SCHEMA},
      {"[{reference: /no/such.csv, coordinates: {knee_angle_r: 9}}]", "/no/such.csv", AMBULO_E_IO}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_problem *problem = NULL;
    ambulo_status status = load_text(problem_text(state, cases[i].tubes), list, &problem);
    assert_message(list, 0, cases[i].message);
    assert_true(status != AMBULO_OK);
    if (cases[i].status == AMBULO_E_IO) assert_int_equal(status, AMBULO_E_IO);
    assert_null(problem);
    ambulo_diagnostics_free(list);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(widths_and_samples, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(rows_and_grids, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("reader/problem_tubes", tests, NULL, NULL);
}
