/* tests/support/fit_runner.h - a runner of solves for a small fit, in a scratch folder. */
#ifndef AMBULO_TESTS_FIT_RUNNER_H
#define AMBULO_TESTS_FIT_RUNNER_H

#include "study/fit.h"
#include "support/fail_alloc.h"
#include "support/fit_files.h"

typedef struct fit_runner {
  ambulo_fit *fit;
  ambulo_fit_options options;
  fail_alloc memory;
  ambulo_allocator allocator;
  ambulo_diagnostics *list;
  ambulo__fit_runner runner;
  ambulo__fit_trial *trial; /* [6] */
} fit_runner;

static inline void fit_runner_open(void **state, const char *text, fit_runner *w) {
  w->fit = fit_of(state, text);
  w->options = ambulo_fit_options_default();
  w->options.program = fit_program();
  w->options.workers = 2;
  w->memory = fail_alloc_at(-1);
  w->allocator = fail_alloc_hook(&w->memory);
  w->list = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      ambulo__fit_runner_open(w->fit, *state, &w->options, &w->allocator, w->list, &w->runner),
      AMBULO_OK);
  w->trial = ambulo__fit_trials_make(w->fit, 6, &w->allocator);
  assert_non_null(w->trial);
}

static inline void fit_runner_close(fit_runner *w) {
  ambulo__fit_runner_close(&w->runner);
  w->allocator.resize(w->allocator.user, w->trial, 0);
  assert_int_equal(w->memory.live, 0);
  ambulo_diagnostics_free(w->list);
  ambulo_fit_free(w->fit);
}

#endif
