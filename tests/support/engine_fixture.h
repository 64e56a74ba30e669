/* tests/support/engine_fixture.h - the yardstick on 12 intervals, opened as the solver does. */
#ifndef AMBULO_TESTS_ENGINE_FIXTURE_H
#define AMBULO_TESTS_ENGINE_FIXTURE_H

#include "method/augmented.h"
#include "ambulo/tools/load.h"
#include "method/point.h"
#include "method/model_step.h"
#include "method/pipeline.h"
#include "method/equalities.h"
#include "support/problem_path.h"
#include "support/test.h"

typedef struct engine_fixture {
  ambulo_problem *problem;
  ambulo_options options;
  ambulo__run run;
  ambulo__engine *engine;
  double *x;
  int n;
} engine_fixture;

/* with one override, NULL: none */
static inline ambulo_problem *load_problem_with(const char *name, const char *override) {
  char path[96];
  ambulo_problem *problem = NULL;
  problem_path(name, path, sizeof path);
  ambulo_status status =
      ambulo_problem_load(path, &override, override != NULL, NULL, NULL, &problem);
  if (status) print_error("%s: %s\n", path, ambulo_status_name(status));
  assert_int_equal(status, AMBULO_OK);
  return problem;
}

static inline ambulo_problem *load_problem(const char *name) {
  return load_problem_with(name, NULL);
}

static inline void engine_open_with(engine_fixture *f, const char *name, const char *override) {
  f->problem = load_problem_with(name, override);
  f->options = ambulo_options_default();
  f->n = ambulo_problem_variable_count(f->problem);
  f->x = calloc((size_t)f->n, sizeof *f->x);
  ambulo__run_begin(&f->run, &f->options);
  assert_int_equal(ambulo__engine_create(f->problem, f->x, NULL, &f->run, NULL, &f->engine),
                   AMBULO_OK);
  f->engine->iterate.mu = 0.05;
  f->engine->iterate.rho = 10.0;
}

static inline void engine_open(engine_fixture *f, const char *name) {
  engine_open_with(f, name, NULL);
}

/* also carries x to a point that satisfies the equalities */
static inline void engine_open_restored(engine_fixture *f, const char *name) {
  double error;
  engine_open(f, name);
  assert_int_equal(ambulo__restore(f->engine, f->x, &error), AMBULO_OK);
  assert_true(error < 1e-9);
  memcpy(f->engine->iterate.x, f->x, (size_t)f->n * sizeof *f->x);
}

/* what only ambulo__engine_create writes */
static inline ambulo__setup *setup_to_break(ambulo__engine *engine) {
  return (ambulo__setup *)engine->setup;
}

static inline void engine_close(engine_fixture *f) {
  ambulo__engine_free(f->engine);
  ambulo_problem_free(f->problem);
  free(f->x);
}

/* numbers in [-1, 1) that are the same on every machine */
static inline double random_number(unsigned *state) {
  *state = *state * 1664525u + 1013904223u;
  return (double)(*state >> 8) / 8388608.0 - 1.0;
}

#endif
