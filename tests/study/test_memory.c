/* Studies whose memory gives out at each place that asks for it: E_MEMORY, nothing leaked; what was
 * done stays. Batches, fronts and fits are finished before, so that no worker is started. */
#include "ambulo/tools/tools.h"
#include "support/fail_sites.h"
#include "support/fake_batch.h"
#include "support/fit_files.h"

static fail_sites sites;

static void each(const char *name, fail_sites_call call, void *data) {
  print_message("%s: %d places\n", name, fail_at_every_site(&sites, call, data, 1));
}

static ambulo_status load_sweep(const ambulo_allocator *a, void *path) {
  ambulo_sweep *sweep = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_sweep_load(path, a, list, &sweep);
  assert_int_equal(sweep != NULL, status == AMBULO_OK);
  assert_int_equal(ambulo_diagnostics_error_count(list) > 0, status != AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_sweep_free(sweep);
  return status;
}

static void sweeps(void **state) {
  static const char *const texts[] = {
      "axes:\n  - {key: time.duration, name: T, unit: s, values: [1, 2]}\n"
      "  - {key: \"objective[0].weight\", name: w, linspace: [1, 4, 3]}\n"
      "start_from: neighbour\nalong: T\ncase_name: \"a{T}_{w}\"\n"
      "outputs: [objective, {output: \"max(tau.pin)\", label: top, unit: N m}]\n",
      "table: t.csv\nrandom: {samples: 5, seed: 7, axes: [{key: time.duration, range: [1, 2]}]}\n",
      "latin_hypercube: {samples: 5, seed: 7, axes: [{key: time.duration, range: [1, 2]}]}\n"};
  char path[SCRATCH_PATH + 8];
  (void)snprintf(path, sizeof path, "%s/s.yaml", (const char *)*state);
  scratch_write(scratch_path(state, "t.csv"), "\"objective[0].weight\",time.intervals\n1,8\n2,9\n");
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    ambulo_sweep *sweep = NULL;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    if (sweep_load(state, texts[i], list, &sweep)) {
      assert_message(list, 0, "a sweep that is right");
    }
    ambulo_sweep_free(sweep);
    ambulo_diagnostics_free(list);
    each("ambulo_sweep_load", load_sweep, path);
  }
}

/* ------------------------------------------------------------------- what has run */

typedef struct study {
  const char *folder, *page;
  ambulo_sweep *sweep;
  ambulo_batch_options options;
} study;

static ambulo_status run_again(const ambulo_allocator *a, void *data) {
  const study *s = data;
  return ambulo_batch_run(s->sweep, s->folder, &s->options, a, NULL, NULL);
}

static ambulo_status ask_state(const ambulo_allocator *a, void *data) {
  ambulo_batch_census census;
  return ambulo_batch_status(((const study *)data)->folder, a, NULL, &census);
}

static ambulo_status verify(const ambulo_allocator *a, void *data) {
  ambulo_batch_census census;
  return ambulo_batch_verify(((const study *)data)->folder, NULL, NULL, a, NULL, &census);
}

static ambulo_status collect(const ambulo_allocator *a, void *data) {
  ambulo_batch_census census;
  return ambulo_batch_collect(((const study *)data)->folder, a, NULL, &census);
}

static ambulo_status write_page(const ambulo_allocator *a, void *data) {
  const study *s = data;
  (void)unlink(s->page);
  ambulo_status status = ambulo_batch_page(s->folder, s->page, NULL, a, NULL, NULL);
  assert_int_equal(access(s->page, F_OK) == 0, status == AMBULO_OK); /* whole or not at all */
  return status;
}

static void of_study(study *s) {
  each("ambulo_batch_run", run_again, s);
  each("ambulo_batch_status", ask_state, s);
  each("ambulo_batch_verify", verify, s);
  each("ambulo_batch_collect", collect, s);
}

static void batches(void **state) {
  fake_batch b;
  assert_int_equal(fake_batch_open(&b, state,
                                   "axes:\n  - {key: time.duration, name: T, values: [1, 2]}\n"
                                   "outputs: [objective, \"max(tau.pin)\"]\n"),
                   0);
  study s = {b.folder, NULL, b.sweep, ambulo_batch_options_default()};
  s.options.program = scratch_path(state, "worker");
  s.options.workers = 1;
  of_study(&s);
  fake_batch_close(&b);
}

static void fronts(void **state) {
  char folder[SCRATCH_PATH + 8];
  (void)snprintf(folder, sizeof folder, "%s/f", (const char *)*state);
  study s = {folder, scratch_path(state, "page.html"), NULL, ambulo_batch_options_default()};
  assert_int_equal(ambulo_sweep_load("tests/study/front.yaml", NULL, NULL, &s.sweep), AMBULO_OK);
  s.options.program = fit_program();
  assert_int_equal(run_again(NULL, &s), AMBULO_OK);
  of_study(&s);
  sites.step = 4; /* of slow calls some */
  each("ambulo_batch_page", write_page, &s);
  sites.step = 0;
  ambulo_sweep_free(s.sweep);
}

/* --------------------------------------------------------------------------- fits */

typedef struct fitting {
  ambulo_fit *fit;
  const char *folder;
  ambulo_fit_options options;
} fitting;

static ambulo_status load_fit(const ambulo_allocator *a, void *path) {
  ambulo_fit *fit = NULL;
  char *text = NULL;
  ambulo_status status = ambulo_fit_load(path, a, NULL, &fit);
  if (!status) status = ambulo_fit_describe(fit, a, &text);
  ambulo_text_free(text, a);
  ambulo_fit_free(fit);
  return status;
}

static ambulo_status run_fit(const ambulo_allocator *a, void *data) {
  const fitting *f = data;
  char *report = NULL;
  ambulo_status status = ambulo_fit_run(f->fit, f->folder, &f->options, a, NULL, NULL, &report);
  assert_int_equal(report != NULL, status == AMBULO_OK);
  ambulo_text_free(report, a);
  return status;
}

static void fits(void **state) {
  char path[SCRATCH_PATH + 16], folder[SCRATCH_PATH + 8];
  (void)snprintf(path, sizeof path, "%s/fit.yaml", (const char *)*state);
  (void)snprintf(folder, sizeof folder, "%s/f", (const char *)*state);
  fitting f = {fit_of(state, FIT_HEAD FIT_PARAMETERS FIT_CONDITIONS FIT_DISTANCE
                      "method: {iterations: 1}\n"),
               folder, ambulo_fit_options_default()};
  f.options.program = fit_program();
  each("ambulo_fit_load", load_fit, path);
  assert_int_equal(run_fit(NULL, &f), AMBULO_OK);
  sites.step = 8;
  each("ambulo_fit_run", run_fit, &f);
  ambulo_fit_free(f.fit);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(sweeps), TEST(batches), TEST(fronts), TEST(fits)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
