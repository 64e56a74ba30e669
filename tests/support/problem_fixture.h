/* tests/support/problem_fixture.h - a problem with workspace and a point, for one test. */
#ifndef AMBULO_TESTS_PROBLEM_FIXTURE_H
#define AMBULO_TESTS_PROBLEM_FIXTURE_H

#include "support/arm.h"
#include "support/test.h"

typedef struct fixture {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  int n, m;
  double *x, *gradient, *rows;
} fixture;

static inline void fixture_open(fixture *f, const ambulo_problem_definition *definition) {
  assert_int_equal(ambulo_problem_create(definition, NULL, NULL, &f->problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(f->problem, NULL, &f->workspace), AMBULO_OK);
  f->n = ambulo_problem_variable_count(f->problem);
  f->m = ambulo_problem_row_count(f->problem);
  f->x = calloc((size_t)f->n, sizeof(double));
  f->gradient = calloc((size_t)f->n, sizeof(double));
  f->rows = calloc((size_t)f->m + 1, sizeof(double));
  arm_point(f->x, f->n, 0.4);
}

static inline void fixture_close(fixture *f) {
  free(f->x);
  free(f->gradient);
  free(f->rows);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->problem);
  ambulo_model_free(f->model);
}

#endif
