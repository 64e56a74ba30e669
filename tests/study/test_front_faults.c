/* Every step of reading a finished front fails once, in its table, its page and its resumption:
 * what cannot be read is corrupt, and never a point that the front lacks, or a row without its
 * values. */
#define _DEFAULT_SOURCE /* syscall */
#include "study/results.h"
#include "support/fault_world.h"
#include "support/fit_files.h"

static const char front_problem[] =
    "ambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml\nangles: radians\n"
    "time: {duration: 1.0, intervals: 20}\ntrajectory: {intervals: 8, degree: 4}\n"
    "ends: {kind: free, initial: {pin: 0}, initial_speed: {pin: 0}}\n"
    "objective:\n  - {term: acceleration, weight: 0.02}\n"
    "  - {term: posture, angles: {pin: 1}, scale: {pin: 1}}\n";
static const char front_study[] = "front: {terms: [acceleration, posture], points: 4}\n"
                                  "outputs: [objective, verdict, max(q.pin)]\n";

/* a finished front, its table and its page */
typedef struct finished {
  ambulo_sweep *sweep;
  char *table, *page;
  int cases;
} finished;

static finished f;

static ambulo_status run_front(ambulo_diagnostics *list) {
  ambulo_batch_options o = ambulo_batch_options_default();
  o.program = fit_program();
  o.workers = 1;
  return ambulo_batch_run(f.sweep, w.folder, &o, NULL, list, NULL);
}

static int open_front(void **state) {
  static char folder[SCRATCH_PATH + 8];
  ambulo_batch_census census;
  if (scratch_open(state)) return -1;
  (void)snprintf(folder, sizeof folder, "%s/b", (const char *)*state);
  w.folder = folder;
  w.batch.state = state;
  if (sweep_load_over(state, front_problem, front_study, NULL, NULL, &f.sweep) || run_front(NULL) ||
      ambulo_batch_collect(folder, NULL, NULL, &census) ||
      ambulo_batch_page(folder, scratch_path(state, "page.html"), NULL, NULL, NULL, NULL))
    return -1;
  f.cases = census.cases;
  f.table = read_whole(in_folder("results.csv"));
  f.page = read_whole(scratch_path(state, "page.html"));
  return census.done == census.cases && census.front.points >= 3 ? 0 : -1;
}

static int close_front(void **state) {
  free(f.table);
  free(f.page);
  ambulo_sweep_free(f.sweep);
  return scratch_close(state);
}

/* the rows: optimal ones have every value, corrupt ones are as many as were counted */
static void expect_whole_rows(const char *table, int corrupt) {
  int rows = 0, counted = 0;
  for (const char *line = strchr(table, '\n') + 1; *line; line = strchr(line, '\n') + 1) {
    char row[1000];
    (void)snprintf(row, sizeof row, "%.*s", (int)strcspn(line, "\n"), line);
    int is_corrupt = strstr(row, ",corrupt,") != NULL;
    if (!is_corrupt && (!strstr(row, ",optimal,") || row[strlen(row) - 1] == ',')) {
      print_error("%s\n", row);
      fail();
    }
    rows++;
    counted += is_corrupt;
  }
  assert_int_equal(rows, f.cases);
  assert_int_equal(counted, corrupt);
}

static void files_fail_while_it_collects(void **state) {
  (void)state;
  int partial = 0;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (long k = 0;; k++) {
      ambulo_batch_census census;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      (void)unlink(in_folder("results.csv"));
      fault_arm((fault_kind)kind, k);
      ambulo_status status = ambulo_batch_collect(w.folder, NULL, list, &census);
      int hit = fault_disarm();
      expect_told(status, list);
      if (!status) {
        char *table = read_whole(in_folder("results.csv"));
        expect_whole_rows(table, census.corrupt);
        if (census.corrupt == 0) assert_string_equal(table, f.table);
        if (census.corrupt > 0) assert_message(list, 0, "damaged: ");
        partial += census.corrupt > 0;
        free(table);
      }
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
  assert_true(partial > 2 * f.cases);
}

static void files_fail_while_its_page_is_made(void **state) {
  const char *path = scratch_path(state, "page.html");
  int partial = 0;
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    for (long k = 0;; k += getenv("AMBULO_LONG") ? 1 : 1 + k / 20) {
      ambulo_batch_census census;
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      (void)unlink(path);
      fault_arm((fault_kind)kind, k);
      ambulo_status status = ambulo_batch_page(w.folder, path, NULL, NULL, list, &census);
      int hit = fault_disarm();
      expect_told(status, list);
      char *page = status ? NULL : read_whole(path);
      if (page && census.corrupt == 0) assert_int_equal(strcmp(page, f.page), 0);
      free(page);
      if (!status && census.corrupt > 0) assert_message(list, 0, "damaged: ");
      partial += !status && census.corrupt > 0;
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
  assert_true(partial > 2 * f.cases);
}

/* a resumed run either says what failed, or ends with the same front */
static void files_fail_while_it_resumes(void **state) {
  (void)state;
  static const fault_kind kinds[] = {FAULT_OPEN, FAULT_READ, FAULT_STAT};
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    for (long k = 0;; k += 1 + k / 10) {
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      fault_arm(kinds[i], k);
      ambulo_status status = run_front(list);
      int hit = fault_disarm();
      expect_told(status, list);
      if (status) assert_int_equal(run_front(NULL), AMBULO_OK);
      assert_int_equal(ambulo_batch_collect(w.folder, NULL, NULL, NULL), AMBULO_OK);
      assert_file_equal(in_folder("results.csv"), f.table);
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, open_front, close_front)
  const struct CMUnitTest tests[] = {TEST(files_fail_while_it_collects),
                                     TEST(files_fail_while_its_page_is_made),
                                     TEST(files_fail_while_it_resumes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
