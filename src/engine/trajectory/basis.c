/* trajectory/basis.c - what all discretizations share: breakpoints, finding the
 * interval of a time, trimming the map to the control points that carry weight.
 *
 * Reading order: basis.h, basis.c, bspline.c, node_values.c (central differences, Hermite),
 * lane_map.h, transfer.c for another grid; butterworth.h for measured motions.
 */
#include "trajectory/basis.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* more intervals than any problem has; keeps every index and product within int */
#define MAX_INTERVALS 10000000
/* weights below this part of the largest weight of their order are rounding */
#define NEGLIGIBLE 1e-14

static const ambulo__basis_methods *methods_of(ambulo__basis_kind kind) {
  switch (kind) {
  case AMBULO__BSPLINE:
    return &ambulo__bspline_methods;
  case AMBULO__CENTRAL_DIFFERENCE:
    return &ambulo__central_difference_methods;
  case AMBULO__HERMITE:
    return &ambulo__hermite_methods;
  }
  return NULL;
}

static int knots_are_valid(const double *knots, int intervals, double duration) {
  double tolerance = 1e-12 * duration;
  if (!(fabs(knots[0]) <= tolerance && fabs(knots[intervals] - duration) <= tolerance)) return 0;
  for (int i = 0; i < intervals; i++) {
    if (!(knots[i + 1] - knots[i] > tolerance)) return 0;
  }
  return 1;
}

static int arguments_are_valid(ambulo__basis_kind kind, int degree, int intervals, double duration,
                               const double *knots) {
  if (!methods_of(kind) || intervals < 1 || intervals > MAX_INTERVALS) return 0;
  if (!(duration > 0.0 && isfinite(duration))) return 0;
  if (kind != AMBULO__BSPLINE) return 1;
  if (degree < 3 || degree > AMBULO__MAX_DEGREE) return 0;
  return !knots || knots_are_valid(knots, intervals, duration);
}

/* breakpoints 0 .. duration; for a spline also the knots, both ends degree + 1 times */
static void fill_knots(ambulo__basis *basis, const double *knots) {
  int last = basis->intervals;
  for (int i = 0; i <= last; i++) {
    basis->breakpoints[i] = knots ? knots[i] : basis->duration * i / last;
  }
  basis->breakpoints[0] = 0.0;
  basis->breakpoints[last] = basis->duration;
  if (!basis->knots) return;
  int degree = basis->degree;
  for (int i = 0; i < degree; i++) {
    basis->knots[i] = 0.0;
    basis->knots[degree + last + 1 + i] = basis->duration;
  }
  memcpy(basis->knots + degree, basis->breakpoints, ((size_t)last + 1) * sizeof(double));
}

ambulo_status ambulo__basis_create(ambulo__basis_kind kind, int degree, int intervals,
                                   double duration, const double *knots,
                                   const ambulo_allocator *allocator, ambulo__basis **basis) {
  if (!basis || !arguments_are_valid(kind, degree, intervals, duration, knots)) {
    return AMBULO_E_ARGUMENT;
  }
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__basis *b = ambulo__alloc(&own, 1, sizeof *b);
  if (!b) return AMBULO_E_MEMORY;
  int is_spline = kind == AMBULO__BSPLINE;
  b->allocator = own;
  b->methods = methods_of(kind);
  b->kind = kind;
  b->degree = is_spline ? degree : kind == AMBULO__HERMITE ? 3 : 2;
  b->intervals = intervals;
  b->duration = duration;
  b->control_points = b->methods->control_points(b->degree, intervals);
  b->span = b->methods->span(b->degree, intervals);
  b->breakpoints = ambulo__alloc(&own, (size_t)intervals + 1, sizeof(double));
  if (is_spline) {
    b->knots = ambulo__alloc(&own, (size_t)(intervals + 1 + 2 * degree), sizeof(double));
  }
  if (!b->breakpoints || (is_spline && !b->knots)) {
    ambulo__basis_free(b);
    return AMBULO_E_MEMORY;
  }
  fill_knots(b, is_spline ? knots : NULL);
  *basis = b;
  return AMBULO_OK;
}

void ambulo__basis_free(ambulo__basis *basis) {
  if (!basis) return;
  ambulo_allocator allocator = basis->allocator;
  ambulo__free(&allocator, basis->breakpoints);
  ambulo__free(&allocator, basis->knots);
  ambulo__free(&allocator, basis);
}

ambulo__basis_kind ambulo__basis_get_kind(const ambulo__basis *basis) {
  return basis->kind;
}
int ambulo__basis_control_points(const ambulo__basis *basis) {
  return basis->control_points;
}
int ambulo__basis_degree(const ambulo__basis *basis) {
  return basis->degree;
}
int ambulo__basis_intervals(const ambulo__basis *basis) {
  return basis->intervals;
}
double ambulo__basis_duration(const ambulo__basis *basis) {
  return basis->duration;
}
const double *ambulo__basis_breakpoints(const ambulo__basis *basis) {
  return basis->breakpoints;
}
int ambulo__basis_span(const ambulo__basis *basis) {
  return basis->span;
}

/* interval of t: breakpoint[i] <= t < breakpoint[i + 1], the last one closed */
static int find_interval(const ambulo__basis *basis, double t) {
  int low = 0, high = basis->intervals;
  while (high - low > 1) {
    int middle = low + (high - low) / 2;
    if (t < basis->breakpoints[middle]) {
      high = middle;
    } else {
      low = middle;
    }
  }
  return low;
}

static int is_negligible(const double *weights, int k, double scale) {
  return fabs(weights[k]) <= NEGLIGIBLE * scale;
}

/* Shrinks [*first, *first + *span) to the control points that carry weight in at least
 * one of the orders low..high, moving the weights along. */
static void trim(ambulo__basis_point *point, int low, int high, int *first, int *span) {
  int head = *span, tail = 0; /* first and one past the last control point in use */
  for (int o = low; o <= high; o++) {
    double *w = point->weight[o], scale = 0.0;
    for (int k = 0; k < *span; k++) scale = fmax(scale, fabs(w[k]));
    for (int k = 0; k < *span; k++) {
      if (is_negligible(w, k, scale)) {
        w[k] = 0.0;
      } else {
        head = k < head ? k : head;
        tail = k + 1 > tail ? k + 1 : tail;
      }
    }
  }
  int kept = tail > head ? tail - head : 0;
  for (int o = low; o <= high; o++) {
    double *w = point->weight[o];
    memmove(w, w + (kept ? head : 0), (size_t)kept * sizeof *w);
    memset(w + kept, 0, (size_t)(AMBULO__MAX_SPAN - kept) * sizeof *w);
  }
  if (kept) *first += head;
  *span = kept;
}

/* the interval of t, and the time in it that t stands for */
static int place(const ambulo__basis *basis, double t, double *time_in) {
  double time = t > 0.0 ? (t < basis->duration ? t : basis->duration) : 0.0;
  /* k T / N and a breakpoint computed another way differ by rounding: treat as equal */
  double slack = 8.0 * DBL_EPSILON * basis->duration;
  int interval = find_interval(basis, time + slack);
  double start = basis->breakpoints[interval], end = basis->breakpoints[interval + 1];
  if (fabs(time - start) <= slack) time = start;
  *time_in = time > end ? end : time;
  return interval;
}

void ambulo__basis_at(const ambulo__basis *basis, double t, ambulo__basis_point *point) {
  double time;
  int interval = place(basis, t, &time);
  memset(point, 0, sizeof *point);
  basis->methods->at(basis, interval, time, point);
  trim(point, 0, 2, &point->first, &point->span);
  trim(point, 3, 3, &point->jerk_first, &point->jerk_span);
}

double ambulo__basis_abscissa(const ambulo__basis *basis, int c, int *is_value) {
  return basis->methods->abscissa(basis, c, is_value);
}
