/* definitions/motion_repeat.c - see motion_repeat.h.
 *
 * Period s + 1 is the image of period s. With m the coordinate that takes the place of i,
 *
 *     q_m(t + T_1) = sign_i q_i(t) + shift_m       (mirrored; periodic: m = i, sign 1)
 *
 * shift_m = q_m(T_1) - sign_i q_i(0) for translations of the root, 0 for the rest. Values and rates
 * at equally spaced times make a Hermite spline over all periods, which is the motion itself where
 * that is cubic on a uniform grid; the problem's basis takes it over as from any other. */
#include "definitions/motion_repeat.h"

#include "model/neutral_pose.h"

#include <string.h>

enum { SAMPLES = 4 }; /* of an interval of the trajectory */

/* value and rate of coordinate i at time t of the one period */
static void motion_at(const ambulo__basis *one, const double *points, int d, double t, int i,
                      double *value, double *rate) {
  ambulo__basis_point point;
  ambulo__basis_at(one, t, &point);
  *value = *rate = 0.0;
  for (int k = 0; k < point.span; k++) {
    double control = points[(size_t)(point.first + k) * (size_t)d + (size_t)i];
    *value += point.weight[0][k] * control;
    *rate += point.weight[1][k] * control;
  }
}

/* the first period, as [last + 1][value of d, rate of d] */
static void sample(const ambulo__basis *one, const double *points, int d, int last, double *first) {
  for (int k = 0; k <= last; k++) {
    double *row = first + 2 * (size_t)k * (size_t)d;
    double t = k == last ? ambulo__basis_duration(one) : k * ambulo__basis_duration(one) / last;
    for (int i = 0; i < d; i++) motion_at(one, points, d, t, i, &row[i], &row[d + i]);
  }
}

/* the state `next` that follows from the state `now` a period before */
static void follow(const ambulo_model *model, ambulo_ends ends, const double *shift,
                   const double *now, double *next) {
  int d = model->coordinate_count;
  for (int i = 0; i < d; i++) {
    const ambulo_coordinate *c = &model->coordinates[i];
    int m = ends == AMBULO_ENDS_MIRRORED ? c->mirror : i;
    double sign = ends == AMBULO_ENDS_MIRRORED ? c->mirror_sign : 1.0;
    next[m] = sign * now[i] + shift[m];
    next[d + m] = sign * now[d + i];
  }
}

/* rows [count n + 1][2 d] of states from the first n + 1; then values and interval * rates */
static void extend(const ambulo_problem *p, ambulo_ends ends, int n, int count, double *rows,
                   double *shift) {
  size_t d = (size_t)p->coordinates, width = 2 * d;
  const double *last = rows + (size_t)n * width;
  memset(shift, 0, d * sizeof *shift);
  follow(p->model, ends, shift, rows, rows + (size_t)(n + 1) * width); /* room for it: a scratch */
  for (size_t i = 0; i < d; i++) {
    if (ambulo__is_root_translation(p->model, (int)i))
      shift[i] = last[i] - rows[(size_t)(n + 1) * width + i];
  }
  for (int k = n + 1; k <= count * n; k++)
    follow(p->model, ends, shift, rows + (size_t)(k - n) * width, rows + (size_t)k * width);
  double interval = p->definition.duration / (count * n);
  for (int k = 0; k <= count * n; k++) {
    for (size_t i = d; i < width; i++) rows[(size_t)k * width + i] *= interval;
  }
}

ambulo_status ambulo__motion_repeat(const ambulo__basis *one, const double *points, int count,
                                    ambulo_ends ends, const ambulo_problem *p, double *x) {
  int n = SAMPLES * ambulo__basis_intervals(one), d = p->coordinates;
  ambulo_allocator a = p->allocator;
  ambulo__basis *hermite = NULL;
  ambulo_status status = ambulo__basis_create(AMBULO__HERMITE, 3, count * n, p->definition.duration,
                                              NULL, &a, &hermite);
  if (status) return status;
  size_t states = (size_t)count * (size_t)n + 2; /* one more than there are: extend's scratch */
  double *rows = ambulo__alloc(&a, states, 2 * (size_t)d * sizeof *rows);
  double *shift = ambulo__alloc(&a, (size_t)d, sizeof *shift);
  status = rows && shift ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    sample(one, points, d, n, rows);
    extend(p, ends, n, count, rows, shift);
    status = ambulo__basis_transfer(hermite, rows, p->basis, x, d, &a);
  }
  ambulo__free(&a, shift);
  ambulo__free(&a, rows);
  ambulo__basis_free(hermite);
  return status;
}
