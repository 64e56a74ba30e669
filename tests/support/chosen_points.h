/* support/chosen_points.h - points of the pendulum's swing, better and worse. */
#ifndef AMBULO_TESTS_CHOSEN_POINTS_H
#define AMBULO_TESTS_CHOSEN_POINTS_H

#include "solver/session.h"
#include "support/engine_fixture.h"

typedef struct chosen {
  engine_fixture f;
  ambulo__candidates c;
  double *good, *better, *invalid, *x;
} chosen;

/* points of the swing of the pendulum: its optimum, a valid point beside it, and one that is not */
static inline void open_chosen(chosen *s) {
  ambulo_result *result = NULL;
  memset(s, 0, sizeof *s);
  engine_open(&s->f, "pendulum_swing");
  size_t n = (size_t)s->f.n;
  s->good = calloc(n, sizeof *s->good);
  s->better = calloc(n, sizeof *s->better);
  s->invalid = calloc(n, sizeof *s->invalid);
  s->x = calloc(n, sizeof *s->x);
  assert_int_equal(ambulo_solve(s->f.problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
  memcpy(s->better, ambulo_result_x(result), n * sizeof *s->x);
  memcpy(s->good, s->better, n * sizeof *s->x);
  s->good[n / 2] += 0.01; /* control points in the middle are free */
  memcpy(s->invalid, s->better, n * sizeof *s->x);
  s->invalid[0] += 0.2; /* the first is prescribed */
  ambulo_result_free(result);
  assert_int_equal(ambulo__candidates_create(&s->c, s->f.engine), AMBULO_OK);
}

static inline void close_chosen(chosen *s) {
  free(s->good);
  free(s->better);
  free(s->invalid);
  free(s->x);
  engine_close(&s->f);
}

#endif
