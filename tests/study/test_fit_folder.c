/* Folders of fits: made, continued, refused. */
#include "study/fit_folder.h"
#include "support/fit_runner.h"

#define TEXT FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE

static ambulo_status prepare(fit_runner *w, const char *directory) {
  ambulo__lock lock = {-1, -1};
  ambulo_diagnostics_clear(w->list);
  ambulo_status status = ambulo__fit_folder_prepare(&w->runner, directory, &lock);
  ambulo__lock_release(&lock);
  return status;
}

static void made_and_continued(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  const char *folder = scratch_path(state, "out");
  assert_int_equal(prepare(&w, folder), AMBULO_OK);
  assert_int_equal(access(scratch_path(state, "out/fit_inputs.json"), F_OK), 0);
  assert_int_equal(prepare(&w, folder), AMBULO_OK);
  scratch_write(scratch_path(state, "out/notes.txt"), "mine"); /* harms nothing in a fit's folder */
  assert_int_equal(prepare(&w, folder), AMBULO_OK);
  fit_runner_close(&w);
}

static void other_inputs(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  const char *folder = scratch_path(state, "out");
  assert_int_equal(prepare(&w, folder), AMBULO_OK);
  unsigned long long own = w.fit->hash;
  w.fit->hash ^= 1;
  assert_int_equal(prepare(&w, folder), AMBULO_E_PROBLEM);
  assert_message(w.list, 0, "the fit file, its problem or a reference changed");
  assert_message(w.list, 0, "--force");
  w.options.force = 1;
  assert_int_equal(prepare(&w, folder), AMBULO_OK);
  w.options.force = 0;
  assert_int_equal(prepare(&w, folder), AMBULO_OK); /* it is that fit's folder now */
  w.fit->hash = own;
  w.options.force = 1;
  assert_int_equal(prepare(&w, folder), AMBULO_OK);
  w.options.force = 0;
  w.runner.sweep->base_hash ^= 1;
  assert_int_equal(prepare(&w, folder), AMBULO_E_PROBLEM);
  assert_message(w.list, 0, "the model, other data of the problem, or the version");
  fit_runner_close(&w);
}

static void something_else(void **state) {
  fit_runner w;
  fit_runner_open(state, TEXT, &w);
  assert_int_equal(mkdir(scratch_path(state, "d"), 0777), 0);
  scratch_write(scratch_path(state, "d/thesis.tex"), "x");
  assert_int_equal(prepare(&w, scratch_path(state, "d")), AMBULO_E_IO);
  assert_message(w.list, 0, "the folder holds other files ('thesis.tex')");
  assert_int_equal(entries_in(scratch_path(state, "d")), 1);
  scratch_write(scratch_path(state, "file"), "x");
  assert_int_equal(prepare(&w, scratch_path(state, "file")), AMBULO_E_IO);
  assert_int_equal(prepare(&w, scratch_path(state, "no/such")), AMBULO_E_IO);
  /* damaged inputs are other inputs */
  scratch_write(scratch_path(state, "fit_inputs.json"), "{\"schema\": \"ambulo-fit-inputs/1\"");
  assert_int_equal(prepare(&w, *state), AMBULO_E_PROBLEM);
  fit_runner_close(&w);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(made_and_continued), TEST(other_inputs),
                                     TEST(something_else)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
