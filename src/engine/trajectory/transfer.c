/* trajectory/transfer.c - unknowns of one basis expressed in another, same duration T.
 *
 * x_from [n_from][d], x_to [n_to][d]. Four ways, the first that applies:
 *
 * 1. Knot insertion (Oslo algorithm; Cohen, Lyche & Riesenfeld 1980). Both are B-splines
 *    of degree p and every breakpoint of the source is one of the target. Control point j
 *    of the target is the blossom of the source's polynomial piece [u_s, u_s+1) that
 *    holds tau_j, at (tau_j+1, ..., tau_j+p):
 *
 *        P_i^(k) = ((u_i+p+1-k - tau_j+k) P_i-1 + (tau_j+k - u_i) P_i) / (u_i+p+1-k - u_i)
 *
 *    for k = 1..p, i = s-p+k..s; the result is P_s^(p). Convex combinations: stable.
 * 2. Source central differences: q_i and h qd_i at the nodes (Eq. 18) are unknowns of the
 *    Hermite basis on the same nodes; go on from there.
 * 3. Target central differences: node values; ghosts q_-1 = q_1 - 2 h qd_0 and
 *    q_N+1 = q_N-1 + 2 h qd_N keep the rates at the ends.
 * 4. Least squares in time, min over x of int_0^T |q_to(t) - q_from(t)|^2 dt: normal
 *    equations with the banded Gram matrix of the target. On every piece between
 *    consecutive breakpoints of either basis the integrand is a polynomial of degree
 *    <= 14, and 8 Gauss points integrate it exactly. Reproduces the source when the target
 *    contains it. */
#include "trajectory/basis.h"
#include "trajectory/quadrature.h"
#include "base/lapack.h"

#include <math.h>
#include <string.h>

static int same_time(double a, double b, double duration) {
  return fabs(a - b) <= 1e-12 * duration;
}

/* ------------------------------------------------------------ knot insertion */

static int is_knot_insertion(const ambulo__basis *from, const ambulo__basis *to) {
  if (from->kind != AMBULO__BSPLINE || to->kind != AMBULO__BSPLINE) return 0;
  if (from->degree != to->degree) return 0;
  int j = 0;
  for (int i = 0; i <= from->intervals; i++) {
    double u = from->breakpoints[i];
    while (j <= to->intervals && !same_time(to->breakpoints[j], u, to->duration)) j++;
    if (j > to->intervals) return 0;
  }
  return 1;
}

/* the source's knot index s with u_s <= t < u_s+1; a knot missed by rounding counts as hit */
static int source_span(const ambulo__basis *from, double t) {
  int low = 0, high = from->intervals;
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (t + 1e-12 * from->duration < from->breakpoints[middle]) {
      high = middle;
    } else {
      low = middle;
    }
  }
  return from->degree + low;
}

/* weights of the source's control points s-p .. s in control point j of the target */
static void oslo_weights(const ambulo__basis *from, const ambulo__basis *to, int j, int *first,
                         double *weight) {
  int p = from->degree;
  int s = source_span(from, to->knots[j]);
  double point[AMBULO__MAX_SPAN][AMBULO__MAX_SPAN] = {{0.0}}; /* [i - (s - p)][source point] */
  for (int i = 0; i <= p; i++) point[i][i] = 1.0;
  for (int k = 1; k <= p; k++) {
    double tau = to->knots[j + k];
    for (int i = p; i >= k; i--) {
      double left = from->knots[s - p + i], right = from->knots[s + i + 1 - k];
      double share = (tau - left) / (right - left);
      for (int c = 0; c <= p; c++) {
        point[i][c] = (1.0 - share) * point[i - 1][c] + share * point[i][c];
      }
    }
  }
  *first = s - p;
  memcpy(weight, point[p], ((size_t)p + 1) * sizeof *weight);
}

/* (K) blossoms */
static void insert_knots(const ambulo__basis *from, const double *x_from, const ambulo__basis *to,
                         double *x_to, int d) {
  for (int j = 0; j < to->control_points; j++) {
    double weight[AMBULO__MAX_SPAN];
    int first;
    oslo_weights(from, to, j, &first, weight);
    double *target = x_to + (size_t)j * (size_t)d;
    memset(target, 0, (size_t)d * sizeof *target);
    for (int c = 0; c <= from->degree; c++) {
      const double *source = x_from + (size_t)(first + c) * (size_t)d;
      for (int i = 0; i < d; i++) target[i] += weight[c] * source[i];
    }
  }
}

/* -------------------------------------------------------- central differences */

/* row[d] += factor * D^order q(t) */
static void add_motion(const ambulo__basis *basis, const double *x, double t, int order,
                       double factor, double *row, int d) {
  ambulo__basis_point point;
  ambulo__basis_at(basis, t, &point);
  for (int k = 0; k < point.span; k++) {
    const double *control = x + (size_t)(point.first + k) * (size_t)d;
    double w = factor * point.weight[order][k];
    for (int i = 0; i < d; i++) row[i] += w * control[i];
  }
}

/* row[d] = factor * D^order q(t), whatever the row held */
static void set_motion(const ambulo__basis *basis, const double *x, double t, int order,
                       double factor, double *row, int d) {
  memset(row, 0, (size_t)d * sizeof *row);
  add_motion(basis, x, t, order, factor, row, d);
}

static void sample_nodes(const ambulo__basis *from, const double *x_from, const ambulo__basis *to,
                         double *x_to, int d) {
  int last = to->intervals;
  size_t row = (size_t)d;
  double h = to->duration / last;
  for (int i = 0; i <= last; i++) {
    set_motion(from, x_from, to->breakpoints[i], 0, 1.0, x_to + (size_t)(i + 1) * row, d);
  }
  memcpy(x_to, x_to + 2 * row, row * sizeof *x_to);
  add_motion(from, x_from, 0.0, 1, -2.0 * h, x_to, d);
  double *ghost = x_to + (size_t)(last + 2) * row;
  memcpy(ghost, x_to + (size_t)last * row, row * sizeof *x_to);
  add_motion(from, x_from, to->duration, 1, 2.0 * h, ghost, d);
}

/* ------------------------------------------------------------- least squares */

/* normal equations: gram in dpbsv's lower band storage [n][band + 1], right-hand side
 * column-major [d][n] */
typedef struct projection {
  int n, band, d;
  double *gram, *rhs, *value;
} projection;

static void add_sample(projection *p, const ambulo__basis_point *point, double weight) {
  for (int a = 0; a < point->span; a++) {
    double w = weight * point->weight[0][a];
    int column = point->first + a;
    double *gram = p->gram + (size_t)column * (size_t)(p->band + 1);
    for (int b = a; b < point->span; b++) gram[b - a] += w * point->weight[0][b];
    for (int i = 0; i < p->d; i++)
      p->rhs[(size_t)i * (size_t)p->n + (size_t)column] += w * p->value[i];
  }
}

static void assemble(projection *p, const ambulo__basis *from, const double *x_from,
                     const ambulo__basis *to) {
  double start = 0.0;
  int i = 1, j = 1; /* next breakpoint of source and target */
  while (j <= to->intervals) {
    double end = fmin(to->breakpoints[j], from->breakpoints[i]);
    for (int g = 0; g < AMBULO__GAUSS_POINTS; g++) {
      double weight, t = ambulo__gauss_time(g, start, end, &weight);
      ambulo__basis_point point;
      ambulo__basis_at(to, t, &point);
      set_motion(from, x_from, t, 0, 1.0, p->value, p->d);
      add_sample(p, &point, weight);
    }
    if (same_time(end, to->breakpoints[j], to->duration)) j++;
    if (i < from->intervals && same_time(end, from->breakpoints[i], to->duration)) i++;
    start = end;
  }
}

static ambulo_status solve(projection *p, double *x_to) {
  int rows = p->band + 1, info = 0;
  dpbsv_("L", &p->n, &p->band, &p->d, p->gram, &rows, p->rhs, &p->n, &info);
  if (info != 0) return AMBULO_E_NUMERIC;
  for (size_t e = 0; e < (size_t)p->n * (size_t)p->d; e++) {
    if (!isfinite(p->rhs[e])) return AMBULO_E_NUMERIC;
  }
  for (int c = 0; c < p->n; c++) {
    for (int i = 0; i < p->d; i++) {
      x_to[(size_t)c * (size_t)p->d + (size_t)i] = p->rhs[(size_t)i * (size_t)p->n + (size_t)c];
    }
  }
  return AMBULO_OK;
}

static ambulo_status least_squares(const ambulo__basis *from, const double *x_from,
                                   const ambulo__basis *to, double *x_to, int d,
                                   const ambulo_allocator *allocator) {
  projection p = {.n = to->control_points, .band = to->span - 1, .d = d};
  size_t columns = (size_t)p.n;
  ambulo_status status = AMBULO_E_MEMORY;
  p.gram = ambulo__alloc(allocator, columns * (size_t)(p.band + 1), sizeof(double));
  p.rhs = ambulo__alloc(allocator, columns, (size_t)d * sizeof(double));
  p.value = ambulo__alloc(allocator, (size_t)d, sizeof(double));
  if (p.gram && p.rhs && p.value) {
    assemble(&p, from, x_from, to);
    status = solve(&p, x_to);
  }
  ambulo__free(allocator, p.gram);
  ambulo__free(allocator, p.rhs);
  ambulo__free(allocator, p.value);
  return status;
}

/* ------------------------------------------------------------------ dispatch */

/* central differences -> Hermite on the same nodes -> target */
static ambulo_status through_hermite(const ambulo__basis *from, const double *x_from,
                                     const ambulo__basis *to, double *x_to, int d,
                                     const ambulo_allocator *allocator) {
  ambulo__basis *hermite = NULL;
  ambulo_status status = ambulo__basis_create(AMBULO__HERMITE, 3, from->intervals, from->duration,
                                              NULL, allocator, &hermite);
  if (status) return status;
  size_t row = (size_t)d;
  double *x = ambulo__alloc(allocator, (size_t)hermite->control_points, row * sizeof *x);
  if (!x) {
    ambulo__basis_free(hermite);
    return AMBULO_E_MEMORY;
  }
  double h = from->duration / from->intervals;
  for (int i = 0; i <= from->intervals; i++) {
    double *node = x + 2 * (size_t)i * row;
    set_motion(from, x_from, from->breakpoints[i], 0, 1.0, node, d);
    set_motion(from, x_from, from->breakpoints[i], 1, h, node + row, d);
  }
  status = ambulo__basis_transfer(hermite, x, to, x_to, d, allocator);
  ambulo__free(allocator, x);
  ambulo__basis_free(hermite);
  return status;
}

static int is_same_basis(const ambulo__basis *from, const ambulo__basis *to) {
  if (from->kind != to->kind || from->degree != to->degree || from->intervals != to->intervals) {
    return 0;
  }
  for (int i = 0; i <= to->intervals; i++) {
    if (!same_time(from->breakpoints[i], to->breakpoints[i], to->duration)) return 0;
  }
  return 1;
}

ambulo_status ambulo__basis_transfer(const ambulo__basis *from, const double *x_from,
                                     const ambulo__basis *to, double *x_to, int d,
                                     const ambulo_allocator *allocator) {
  if (!from || !to || !x_from || !x_to || d < 1) return AMBULO_E_ARGUMENT;
  if (!same_time(from->duration, to->duration, to->duration)) return AMBULO_E_ARGUMENT;
  size_t count = (size_t)from->control_points * (size_t)d;
  for (size_t e = 0; e < count; e++) {
    if (!isfinite(x_from[e])) return AMBULO_E_NUMERIC;
  }
  if (is_same_basis(from, to)) {
    memmove(x_to, x_from, count * sizeof *x_to);
    return AMBULO_OK;
  }
  if (is_knot_insertion(from, to)) {
    insert_knots(from, x_from, to, x_to, d);
    return AMBULO_OK;
  }
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  if (from->kind == AMBULO__CENTRAL_DIFFERENCE) {
    return through_hermite(from, x_from, to, x_to, d, &own);
  }
  if (to->kind == AMBULO__CENTRAL_DIFFERENCE) {
    sample_nodes(from, x_from, to, x_to, d);
    return AMBULO_OK;
  }
  return least_squares(from, x_from, to, x_to, d, &own);
}
