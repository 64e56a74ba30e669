/* Every step of reading a finished fit's solves fails once: the fit either says so, or is the same.
 * A solve that cannot be read is none that failed. */
#define _DEFAULT_SOURCE /* syscall */
#include "support/faulty_files.h"
#include "support/fit_files.h"

static const char text[] =
    FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE "method: {iterations: 1}\n";

static ambulo_status run(const ambulo_fit *fit, const char *folder, ambulo_diagnostics *list) {
  ambulo_fit_options o = ambulo_fit_options_default();
  o.program = fit_program();
  o.workers = 1;
  return ambulo_fit_run(fit, folder, &o, NULL, list, NULL, NULL);
}

static void files_fail_while_it_resumes(void **state) {
  static const fault_kind kinds[] = {FAULT_OPEN, FAULT_READ, FAULT_STAT};
  ambulo_fit *fit = fit_of(state, text);
  char folder[SCRATCH_PATH + 8];
  (void)snprintf(folder, sizeof folder, "%s/f", (const char *)*state);
  assert_int_equal(run(fit, folder, NULL), AMBULO_OK);
  char *calm = read_whole(scratch_path(state, "f/fit.json"));
  int refused = 0;
  for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
    for (long k = 0;; k += 1 + k / 10) {
      ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
      (void)unlink(scratch_path(state, "f/fit.json"));
      fault_arm(kinds[i], k);
      ambulo_status status = run(fit, folder, list);
      int hit = fault_disarm();
      assert_true(status == AMBULO_OK || ambulo_diagnostics_error_count(list) > 0);
      char *now = status ? NULL : read_whole(scratch_path(state, "f/fit.json"));
      if (now) assert_string_equal(now, calm);
      refused += status != AMBULO_OK;
      free(now);
      ambulo_diagnostics_free(list);
      if (!hit) break;
    }
  }
  assert_true(refused > 10);
  free(calm);
  ambulo_fit_free(fit);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(files_fail_while_it_resumes)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
