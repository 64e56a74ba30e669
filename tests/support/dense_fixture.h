/* tests/support/dense_fixture.h - the planar walker on a finer grid, moved as a whole. */
#ifndef AMBULO_TESTS_DENSE_FIXTURE_H
#define AMBULO_TESTS_DENSE_FIXTURE_H

#include "solver/dense.h"
#include "support/planar_walker.h"
#include "support/test.h"

typedef struct dense_fixture {
  ambulo_model *model;
  ambulo_problem *problem;
  double *x;
  ambulo__dense dense;
} dense_fixture;

static inline void dense_open_on(dense_fixture *f, int intervals, ambulo_grid grid) {
  memset(f, 0, sizeof *f);
  f->model = planar_walker_create();
  assert_non_null(f->model);
  f->problem = walker_problem_on(f->model, intervals, grid);
  assert_non_null(f->problem);
  f->x = calloc((size_t)ambulo_problem_variable_count(f->problem), sizeof *f->x);
}

static inline void dense_open(dense_fixture *f, int intervals) {
  dense_open_on(f, intervals, AMBULO_GRID_UNIFORM);
}

/* a coordinate that moves as a + b t + c t^2: the knots' products make the control points of t^2 */
static inline void dense_move(dense_fixture *f, int coordinate, double a, double b, double c) {
  const ambulo__basis *basis = f->problem->basis;
  const double *breaks = ambulo__basis_breakpoints(basis);
  int intervals = ambulo__basis_intervals(basis);
  for (int p = 0; p < f->problem->control_points; p++) {
    double t[3];
    for (int k = 0; k < 3; k++) {
      int at = p + k - 2;
      t[k] = breaks[at < 0 ? 0 : at > intervals ? intervals : at];
    }
    f->x[p * WALKER_COORDINATES + coordinate] =
        a + b * (t[0] + t[1] + t[2]) / 3.0 + c * (t[0] * t[1] + t[0] * t[2] + t[1] * t[2]) / 3.0;
  }
}

static inline void dense_look(dense_fixture *f, int samples) {
  assert_int_equal(ambulo__dense_open(f->problem, f->x, samples, 0.0, NULL, NULL, &f->dense),
                   AMBULO_OK);
}

static inline void dense_close(dense_fixture *f) {
  ambulo__dense_close(&f->dense);
  free(f->x);
  ambulo_problem_free(f->problem);
  ambulo_model_free(f->model);
}

/* the largest sample, and where */
typedef struct dense_largest {
  ambulo__dense_sample sample;
  double after, before; /* only samples of after < time < before count */
  const char *subject;  /* NULL: any */
  int count;
} dense_largest;

static inline void dense_keep_largest(void *user, const ambulo__dense_sample *sample) {
  dense_largest *largest = user;
  if (!(sample->time > largest->after && sample->time < largest->before)) return;
  if (largest->subject && strcmp(largest->subject, sample->subject) != 0) return;
  if (largest->count++ == 0 || sample->value > largest->sample.value) largest->sample = *sample;
}

#endif
