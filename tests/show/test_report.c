/* The result folder: complete, replaced only on request, never half. */
#include "ambulo/tools/tools.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/walker_result.h"

#include <signal.h>
#include <sys/resource.h>

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

static const char *const files[] = {"summary.json",  "motion.csv", "motion.sto",
                                    "solution.yaml", "gait.svg",   "scene.json"};

static const char *inside(const char *folder, const char *name) {
  static char path[SCRATCH_PATH + 512];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

static void test_complete(void **state) {
  walk w;
  walk_open(&w, 12);
  const char *folder = scratch_path(state, "result");
  ambulo_report_options options = ambulo_report_options_default();
  assert_int_equal(ambulo_report_check(folder, &options, NULL), AMBULO_OK);
  assert_int_equal(entries_in(*state), 0);
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL),
                   AMBULO_OK);
  for (int i = 0; i < 6; i++) {
    char *text = read_text(inside(folder, files[i]));
    if (strlen(text) < 200) print_error("%s is only\n%s\n", files[i], text);
    assert_true(strlen(text) >= 200);
    free(text);
  }
  assert_int_equal(entries_in(folder), 6);
  assert_int_equal(entries_in(*state), 1);
  walk_close(&w);
}

/* muscles come with the rest or not at all, in the words of summary.json too */
static void test_muscles(void **state) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_report_options options = ambulo_report_options_default();
  const char *const set = "time.intervals=24";
  assert_int_equal(ambulo_problem_load("models/walk_muscles.yaml", &set, 1, NULL, NULL, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__result_create(problem, NULL, &result), AMBULO_OK);
  const char *folder = scratch_path(state, "result");
  for (int times = 0; times < 2; times++) {
    options.overwrite = times; /* a folder with muscles is one of ambulo's */
    assert_int_equal(ambulo_report_write(problem, result, folder, &options, NULL, NULL), AMBULO_OK);
    assert_int_equal(entries_in(folder), 7);
  }
  char *text = NULL, *summary = read_text(inside(folder, "summary.json"));
  char *table = read_text(inside(folder, "muscles.csv"));
  assert_int_equal(ambulo_report_summary(problem, result, &options, NULL, &text), AMBULO_OK);
  assert_string_equal(text, summary);
  assert_non_null(strstr(text, "\"muscles\": {"));
  assert_non_null(strstr(text, "\"bhargava_per_kg_metre\": "));
  assert_null(strstr(text, "\"metabolic_per_kg_metre\": "));
  assert_non_null(strstr(table, "\ntime,activation.addbrev_r,"));
  ambulo_text_free(text, NULL);
  free(summary);
  free(table);
  result->x[0] = (double)NAN;
  folder = scratch_path(state, "endless");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_report_write(problem, result, folder, &options, NULL, list), AMBULO_OK);
  assert_message(list, 0, "the motion is not finite; the result is without muscles");
  assert_int_equal(entries_in(folder), 6);
  ambulo_diagnostics_free(list);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

/* people stand behind the curves where their folder is given; no result is lost over them */
static void test_people(void **state) {
  walk w;
  walk_open(&w, 12);
  ambulo_report_options options = ambulo_report_options_default();
  for (int readable = 0; readable < 2; readable++) {
    const char *folder = scratch_path(state, readable ? "with" : "without");
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    options.norms = readable ? AMBULO_SOURCE_DIR "/models/norms" : "/no/such/norms";
    assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, list),
                     AMBULO_OK);
    assert_int_equal(ambulo_diagnostics_count(list), readable ? 0 : 1);
    if (!readable) assert_message(list, 0, "warning: the curves of people cannot be read");
    char *svg = read_text(inside(folder, "gait.svg"));
    assert_int_equal(strstr(svg, "left-people\"") != NULL, readable);
    free(svg);
    ambulo_diagnostics_free(list);
  }
  walk_close(&w);
}

static void test_replaced_only_on_request(void **state) {
  walk w;
  walk_open(&w, 12);
  const char *folder = scratch_path(state, "result");
  ambulo_report_options options = ambulo_report_options_default();
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL), 0);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_report_check(folder, &options, list), AMBULO_E_IO);
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL),
                   AMBULO_E_IO);
  assert_message(list, 0, "result");
  ambulo_diagnostics_free(list);
  options.overwrite = 1;
  options.samples = 7;
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL), 0);
  char *csv = read_text(inside(folder, "motion.csv"));
  int lines = 0;
  for (const char *c = csv; *c; c++) lines += *c == '\n';
  assert_int_equal(lines, 2 + 7);
  free(csv);
  assert_int_equal(entries_in(*state), 1);
  walk_close(&w);
}

static void test_a_folder_of_others_is_kept(void **state) {
  const char *folder = scratch_path(state, "mine");
  assert_int_equal(mkdir(folder, 0700), 0);
  scratch_write(inside(folder, "thesis.tex"), "years of work\n");
  ambulo_report_options options = ambulo_report_options_default();
  options.overwrite = 1;
  assert_int_equal(ambulo_report_check(folder, &options, NULL), AMBULO_E_IO);
  assert_file_equal(inside(folder, "thesis.tex"), "years of work\n");
}

/* a result in which somebody keeps notes is not thrown away with them */
static void test_what_others_add_is_kept(void **state) {
  walk w;
  walk_open(&w, 12);
  const char *folder = scratch_path(state, "result");
  ambulo_report_options options = ambulo_report_options_default();
  options.overwrite = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL), 0);
  scratch_write(inside(folder, "notes.txt"), "remember\n");
  assert_int_equal(ambulo_report_check(folder, &options, list), AMBULO_E_IO);
  assert_message(list, 0, "also holds 'notes.txt'");
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL),
                   AMBULO_E_IO);
  assert_file_equal(inside(folder, "notes.txt"), "remember\n");
  assert_int_equal(unlink(inside(folder, "notes.txt")), 0);
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL), 0);
  scratch_write(inside(folder, "summary.json"), "{\"of\": \"another program\"}\n");
  assert_int_equal(ambulo_report_check(folder, &options, list), AMBULO_E_IO);
  assert_message(list, 1, "holds no 'summary.json' of ambulo's");
  ambulo_diagnostics_free(list);
  walk_close(&w);
}

static void test_bad_places(void **state) {
  ambulo_report_options options = ambulo_report_options_default();
  assert_int_equal(ambulo_report_check(scratch_path(state, "no/such/parent"), &options, NULL),
                   AMBULO_E_IO);
  scratch_write(scratch_path(state, "file"), "x");
  assert_int_equal(ambulo_report_check(scratch_path(state, "file"), &options, NULL), AMBULO_E_IO);
  assert_int_equal(ambulo_report_check(scratch_path(state, "file/below"), &options, NULL),
                   AMBULO_E_IO);
  assert_int_equal(ambulo_report_check("/proc/result", &options, NULL), AMBULO_E_IO);
  options.size = 0;
  assert_int_equal(ambulo_report_check(scratch_path(state, "r"), &options, NULL),
                   AMBULO_E_ARGUMENT);
}

/* a disk that is full after 8 kB: the old result stays, nothing half is left */
static void test_full_disk(void **state) {
  walk w;
  walk_open(&w, 12);
  const char *folder = scratch_path(state, "result");
  ambulo_report_options options = ambulo_report_options_default();
  assert_int_equal(ambulo_report_write(w.problem, w.result, folder, &options, NULL, NULL), 0);
  char *before = read_text(inside(folder, "motion.csv"));
  struct rlimit old, small;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
  small = old;
  small.rlim_cur = 8192;
  signal(SIGXFSZ, SIG_IGN);
  options.overwrite = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
  ambulo_status status = ambulo_report_write(w.problem, w.result, folder, &options, NULL, list);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
  assert_int_equal(status, AMBULO_E_IO);
  assert_message(list, 0, "File too large");
  ambulo_diagnostics_free(list);
  char *after = read_text(inside(folder, "motion.csv"));
  assert_string_equal(before, after);
  assert_int_equal(entries_in(folder), 6);
  assert_int_equal(entries_in(*state), 1);
  free(before);
  free(after);
  walk_close(&w);
}

/* every request of memory is refused once: nothing leaks, nothing is written */
static void test_out_of_memory(void **state) {
  walk w;
  walk_open(&w, 6);
  ambulo_report_options options = ambulo_report_options_default();
  long tried = 0;
  for (long k = 0; k < 10000; k++, tried++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    const char *folder = scratch_path(state, "result");
    ambulo_status status =
        ambulo_report_write(w.problem, w.result, folder, &options, &allocator, NULL);
    if (status != AMBULO_E_MEMORY && status != AMBULO_OK)
      print_error("request %ld: %s\n", k, ambulo_status_name(status));
    assert_true(status == AMBULO_OK || status == AMBULO_E_MEMORY);
    assert_int_equal(memory.live, 0);
    assert_int_equal(entries_in(*state), status == AMBULO_OK);
    if (!memory.failed) break;
    if (status == AMBULO_OK) assert_int_equal(scratch_remove_at(AT_FDCWD, folder), 0);
  }
  assert_true(tried > 40);
  walk_close(&w);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(test_complete),
                                     SCRATCH_TEST(test_muscles),
                                     SCRATCH_TEST(test_people),
                                     SCRATCH_TEST(test_replaced_only_on_request),
                                     SCRATCH_TEST(test_a_folder_of_others_is_kept),
                                     SCRATCH_TEST(test_what_others_add_is_kept),
                                     SCRATCH_TEST(test_bad_places),
                                     SCRATCH_TEST(test_full_disk),
                                     SCRATCH_TEST(test_out_of_memory)};
  return cmocka_run_group_tests_name("report/report", tests, NULL, NULL);
}
