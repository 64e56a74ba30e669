/* tests/people/waving_stride.h - the mirrored stride of models/walk.yaml whose joints wave: no
 * gait, but everything moves; with one more setting, of what is worn or held. */
#ifndef TESTS_STRIDE_WAVING_STRIDE_H
#define TESTS_STRIDE_WAVING_STRIDE_H

#include "people/stride.h"

#include "ambulo/tools/tools.h"
#include "support/test.h"

typedef struct waving_stride {
  ambulo_problem *problem;
  double *x;
  ambulo__stride stride;
} waving_stride;

/* more NULL: nothing worn, nothing held, at rest */
static inline void open_waving_stride(waving_stride *w, const char *more, int samples) {
  const char *const settings[] = {"time.intervals=30", "trajectory.intervals=9", more};
  w->problem = NULL;
  assert_int_equal(
      ambulo_problem_load("models/walk.yaml", settings, more ? 3 : 2, NULL, NULL, &w->problem),
      AMBULO_OK);
  const ambulo_problem *p = w->problem;
  w->x = calloc((size_t)p->variables, sizeof *w->x);
  assert_non_null(w->x);
  for (int j = 0; more && j < p->variables; j++)
    w->x[j] = 0.2 * sin(1.3 * (j % p->coordinates) + 0.7 * (j / p->coordinates));
  assert_int_equal(ambulo__stride_create(p, w->x, samples, NULL, &w->stride), AMBULO_OK);
}

static inline void close_waving_stride(waving_stride *w) {
  ambulo__stride_free(&w->stride);
  free(w->x);
  ambulo_problem_free(w->problem);
}

#endif
