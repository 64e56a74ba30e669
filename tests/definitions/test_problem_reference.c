/* Tracking references: interpolation, units, missing columns, refusals. */
#include "definitions/problem_text.h"
#include "problem/nlp.h"
#include "support/scratch.h"

/* loads a walker that tracks `table`, written to the scratch folder */
static ambulo_status load_with(const char *folder, const char *file, const char *table,
                               const char *time, ambulo_diagnostics *list,
                               ambulo_problem **problem) {
  char path[SCRATCH_PATH + 64], text[SCRATCH_PATH + 512];
  (void)snprintf(path, sizeof path, "%s/%s", folder, file);
  FILE *stream = fopen(path, "w");
  assert_non_null(stream);
  fputs(table, stream);
  fclose(stream);
  (void)snprintf(text, sizeof text,
                 WALKER "%s\n"
                        "objective: [{term: tracking, scale: 2, reference: %s}]\n",
                 time, path);
  return load_text(text, list, problem);
}

static ambulo_status load(const char *folder, const char *file, const char *table,
                          ambulo_diagnostics *list, ambulo_problem **problem) {
  return load_with(folder, file, table, "time: {duration: 1, intervals: 4}", list, problem);
}

static double reference(const ambulo_problem *p, const char *coordinate, int node) {
  int i = ambulo_model_find_coordinate(p->model, coordinate);
  return p->definition.terms[0].reference[node * p->coordinates + i];
}

static double scale(const ambulo_problem *p, const char *coordinate) {
  return p->definition.terms[0].scale[ambulo_model_find_coordinate(p->model, coordinate)];
}

static void motions_are_sampled_at_the_nodes(void **state) {
  ambulo_problem *p = NULL;
  const char *table = "time,knee_angle_r,pelvis_tx\n"
                      "5,0.0,0\n"
                      "5.5,1.0,0.4\n"
                      "6.0,0.0,0.6\n"
                      "7.0,9.0,9.0\n";
  assert_int_equal(load(*state, "walk.csv", table, NULL, &p), AMBULO_OK);
  static const double knee[] = {0.0, 0.5, 1.0, 0.5, 0.0}, tx[] = {0.0, 0.2, 0.4, 0.5, 0.6};
  for (int k = 0; k < 5; k++) {
    assert_close(reference(p, "knee_angle_r", k), knee[k], 1e-14);
    assert_close(reference(p, "pelvis_tx", k), tx[k], 1e-14);
  }
  assert_close(scale(p, "knee_angle_r"), 2.0, 0.0);
  assert_close(scale(p, "knee_angle_l"), 0.0, 0.0);
  ambulo_problem_free(p);
}

/* of a grid on events at its nodes, wherever they are */
static void nodes_need_not_be_equally_spaced(void **state) {
  ambulo_problem *p = NULL;
  const char *table = "time,knee_angle_r,pelvis_tx\n5,0.0,0\n6.0,1.0,0.6\n";
  assert_int_equal(
      load_with(*state, "walk.csv", table,
                "time: {duration: 1, intervals: 6, grid: events}\n"
                "contacts: [{foot: left, mode: flat, from: 0.1, to: 1, place: [0, 0]}]",
                NULL, &p),
      AMBULO_OK);
  static const double times[] = {0.0, 0.05, 0.1, 0.325, 0.55, 0.775, 1.0};
  for (int k = 0; k < 7; k++) {
    assert_close(p->times[k], times[k], 1e-15);
    assert_close(reference(p, "knee_angle_r", k), times[k], 1e-14);
  }
  ambulo_problem_free(p);
}

static void degrees_are_turned_into_radians(void **state) {
  ambulo_problem *p = NULL;
  const char *table = "walk\ninDegrees=yes\nendheader\ntime\tknee_angle_r\tpelvis_tx\n"
                      "0\t90\t3\n1\t90\t3\n";
  assert_int_equal(load(*state, "walk.sto", table, NULL, &p), AMBULO_OK);
  assert_close(reference(p, "knee_angle_r", 2), 1.5707963267948966, 1e-15);
  assert_close(reference(p, "pelvis_tx", 2), 3.0, 1e-15);
  ambulo_problem_free(p);
}

/* units that nobody declared: accepted, with a word */
static void doubtful_references_are_warned_of(void **state) {
  static const struct {
    const char *table, *message;
  } cases[] = {
      {"time,knee_angle_r\n0,5\n0.5,65\n1,5\n", "the reference has 'knee_angle_r' at 65 rad"},
      {"time,pelvis_tx\n0,0\n0.5,650\n1,1300\n", "'pelvis_tx' at 650 m"},
      {"time,knee_angle_r\n0,0.1\n10,0.2\n20,0.3\n1000,0\n",
       "the reference has a row every 10 s; the problem lasts 1 s"},
      {"time,knee_angle_r\n0,0.1\n1,0.2\n", NULL},
      {"# inDegrees=yes\ntime,knee_angle_r\n0,5\n0.5,65\n1,5\n", NULL},
      {"t\nnColumns=3\nendheader\ntime\tknee_angle_r\n0\t0.1\n1\t0.2\n",
       "the reference has 2 columns; its header says 3 (nColumns)"},
      {"t\nnColumns=0\nendheader\ntime\tknee_angle_r\n0\t0.1\n1\t0.2\n",
       "the reference has 2 columns; its header says 0 (nColumns)"},
      {"t\nnColumns=2\nendheader\ntime\tknee_angle_r\n0\t0.1\n1\t0.2\n", NULL}};
  for (int i = 0; i < 8; i++) {
    ambulo_problem *p = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(load(*state, i >= 5 ? "odd.sto" : "odd.csv", cases[i].table, list, &p),
                     AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_count(list), cases[i].message != NULL);
    if (cases[i].message) assert_message(list, 0, cases[i].message);
    if (cases[i].message) assert_message(list, 0, "warning");
    ambulo_diagnostics_free(list);
    ambulo_problem_free(p);
  }
}

static void useless_references_are_refused(void **state) {
  static const struct {
    const char *table, *message;
    ambulo_status status;
  } cases[] = {{"time,knee_angle_r\n0,1\n0.5,1\n",
                "the reference lasts 0.5 s; expected at least the duration, 1 s", AMBULO_E_PROBLEM},
               {"time,nothing\n0,1\n1,1\n", "no column named after a coordinate", AMBULO_E_PROBLEM},
               {"time,knee_angle_r\n0,1\n1,x\n", "bad.csv:3:", AMBULO_E_SCHEMA},
               {"time,knee_angle_r,q.knee_angle_r\n0,1,1\n1,1,2\n",
                "'knee_angle_r' and 'q.knee_angle_r' both stand for", AMBULO_E_SCHEMA}};
  for (int i = 0; i < 4; i++) {
    ambulo_problem *p = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    assert_int_equal(load(*state, "bad.csv", cases[i].table, list, &p), cases[i].status);
    assert_null(p);
    assert_message(list, 0, cases[i].message);
    ambulo_diagnostics_free(list);
  }
  expect_refusal(WALKER "time: {duration: 1, intervals: 4}\n"
                        "objective: [{term: tracking, reference: /no/such/file.csv}]\n",
                 AMBULO_E_IO, "/no/such/file.csv");
}

/* Tubes in a problem file: sampling, widths in the file's unit, other grids, refusals. */

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
      cmocka_unit_test_setup_teardown(motions_are_sampled_at_the_nodes, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(nodes_need_not_be_equally_spaced, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(degrees_are_turned_into_radians, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(doubtful_references_are_warned_of, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(useless_references_are_refused, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(widths_and_samples, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(rows_and_grids, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
