/* people/motion_fit.c - interpolating and smoothing splines of a sampled motion.
 *
 * Samples y_k at t_k, k = 0..m-1 (s), one spline of degree p = 3 or 5 per column, with as
 * many control points as samples. Its inner breakpoints are the samples without the
 * (p - 1) / 2 next to each end ("not a knot"), so the ends need no conditions.
 *
 * Interpolation: N x = y, N_kj = N_j,p(t_k); banded with p bands on either side and
 * regular by Schoenberg and Whitney; LU with pivoting.
 *
 * Smoothing with r = (p + 1) / 2 and w_k the trapezoidal weights of the samples:
 *
 *     min  sum_k w_k (q(t_k) - y_k)^2  +  omega^(-2 r) int (D^r q)^2 dt
 *
 * For dense samples this is the filter 1 / (1 + (f / cutoff)^(2 r)), without phase shift,
 * if omega = 2 pi cutoff. Normal equations, banded Cholesky. */
#include "people/motion_fit.h"
#include "trajectory/quadrature.h"
#include "base/lapack.h"
#include "trajectory/butterworth.h"

#include <math.h>

struct ambulo__motion_fit {
  ambulo_allocator allocator;
  ambulo__basis *basis;
  int columns;
  double start; /* s */
  double *x;    /* [control_points][columns] */
};

/* a banded system in LAPACK's storage; right-hand side column-major [columns][n] */
typedef struct banded {
  int n, band, leading, columns;
  double *matrix, *rhs;
  int *pivot;
} banded;

/* -------------------------------------------------------------- interpolation */

/* (FIT) N(t_i) P = q_i */
static void collocate(const ambulo__motion *motion, const ambulo__basis *basis, banded *system) {
  int diagonal = 2 * system->band; /* dgbtrf: `band` rows of fill-in, `band` above */
  for (int k = 0; k < motion->rows; k++) {
    ambulo__basis_point point;
    ambulo__basis_at(basis, motion->time[k] - motion->time[0], &point);
    for (int c = 0; c < point.span; c++) {
      int column = point.first + c;
      if (point.weight[0][c] == 0.0) continue;
      size_t at = (size_t)column * (size_t)system->leading + (size_t)(diagonal + k - column);
      system->matrix[at] = point.weight[0][c];
    }
    for (int i = 0; i < motion->columns; i++) {
      system->rhs[(size_t)i * (size_t)system->n + (size_t)k] =
          motion->values[(size_t)k * (size_t)motion->columns + (size_t)i];
    }
  }
}

static int solve_collocation(banded *system) {
  int info = 0;
  dgbtrf_(&system->n, &system->n, &system->band, &system->band, system->matrix, &system->leading,
          system->pivot, &info);
  if (info != 0) return info;
  dgbtrs_("N", &system->n, &system->band, &system->band, &system->columns, system->matrix,
          &system->leading, system->pivot, system->rhs, &system->n, &info);
  return info;
}

/* ------------------------------------------------------------------ smoothing */

/* adds weight * w w' (lower band), w the weights of one order at t */
static void add_square(const ambulo__basis_point *point, int order, double weight, banded *system) {
  int first = order == 3 ? point->jerk_first : point->first;
  int span = order == 3 ? point->jerk_span : point->span;
  const double *w = point->weight[order];
  for (int a = 0; a < span; a++) {
    double *column = system->matrix + (size_t)(first + a) * (size_t)system->leading;
    for (int b = a; b < span; b++) column[b - a] += weight * w[a] * w[b];
  }
}

static void add_samples(const ambulo__motion *motion, const ambulo__basis *basis, banded *system) {
  int last = motion->rows - 1;
  for (int k = 0; k <= last; k++) {
    double before = motion->time[k > 0 ? k - 1 : 0];
    double after = motion->time[k < last ? k + 1 : last];
    double weight = 0.5 * (after - before);
    ambulo__basis_point point;
    ambulo__basis_at(basis, motion->time[k] - motion->time[0], &point);
    add_square(&point, 0, weight, system);
    for (int c = 0; c < point.span; c++) {
      double w = weight * point.weight[0][c];
      for (int i = 0; i < motion->columns; i++) {
        system->rhs[(size_t)i * (size_t)system->n + (size_t)(point.first + c)] +=
            w * motion->values[(size_t)k * (size_t)motion->columns + (size_t)i];
      }
    }
  }
}

static void add_roughness(const ambulo__basis *basis, int order, double factor, banded *system) {
  const double *breakpoints = ambulo__basis_breakpoints(basis);
  for (int interval = 0; interval < ambulo__basis_intervals(basis); interval++) {
    for (int g = 0; g < AMBULO__GAUSS_POINTS; g++) {
      double weight;
      double t = ambulo__gauss_time(g, breakpoints[interval], breakpoints[interval + 1], &weight);
      ambulo__basis_point point;
      ambulo__basis_at(basis, t, &point);
      add_square(&point, order, factor * weight, system);
    }
  }
}

static int solve_smoothing(const ambulo__motion *motion, const ambulo__basis *basis, double cutoff,
                           banded *system) {
  int order = (ambulo__basis_degree(basis) + 1) / 2, info = 0;
  double omega = 2.0 * 3.14159265358979323846 * cutoff;
  add_samples(motion, basis, system);
  add_roughness(basis, order, pow(omega, -2.0 * order), system);
  dpbsv_("L", &system->n, &system->band, &system->columns, system->matrix, &system->leading,
         system->rhs, &system->n, &info);
  return info;
}

/* ------------------------------------------------------------------- the whole */

static int arguments_are_valid(const ambulo__motion *motion, int degree, double cutoff) {
  if (!motion || (degree != 3 && degree != 5) || motion->rows < degree + 1) return 0;
  if (!(cutoff >= 0.0 && isfinite(cutoff)) || motion->columns < 1) return 0;
  for (int k = 1; k < motion->rows; k++) {
    if (!(motion->time[k] > motion->time[k - 1])) return 0;
  }
  return 1;
}

/* breakpoints: the samples without the (degree - 1) / 2 beside each end, from zero */
static ambulo_status create_basis(const ambulo__motion *motion, int degree,
                                  const ambulo_allocator *allocator, ambulo__basis **basis) {
  int intervals = motion->rows - degree, skip = (degree - 1) / 2;
  double start = motion->time[0], duration = motion->time[motion->rows - 1] - start;
  double *breakpoints = ambulo__alloc(allocator, (size_t)intervals + 1, sizeof *breakpoints);
  if (!breakpoints) return AMBULO_E_MEMORY;
  for (int i = 1; i < intervals; i++) breakpoints[i] = motion->time[i + skip] - start;
  breakpoints[intervals] = duration;
  ambulo_status status = ambulo__basis_create(AMBULO__BSPLINE, degree, intervals, duration,
                                              breakpoints, allocator, basis);
  ambulo__free(allocator, breakpoints);
  return status;
}

static ambulo_status keep_solution(const banded *system, ambulo__motion_fit *fit) {
  for (int c = 0; c < system->n; c++) {
    for (int i = 0; i < system->columns; i++) {
      double value = system->rhs[(size_t)i * (size_t)system->n + (size_t)c];
      if (!isfinite(value)) return AMBULO_E_NUMERIC;
      fit->x[(size_t)c * (size_t)system->columns + (size_t)i] = value;
    }
  }
  return AMBULO_OK;
}

static ambulo_status solve(const ambulo__motion *motion, double cutoff, ambulo__motion_fit *fit) {
  const ambulo_allocator *allocator = &fit->allocator;
  int degree = ambulo__basis_degree(fit->basis), smooth = cutoff > 0.0;
  banded system = {.n = motion->rows, .band = degree, .columns = motion->columns};
  system.leading = smooth ? degree + 1 : 3 * degree + 1;
  size_t n = (size_t)system.n;
  system.matrix = ambulo__alloc(allocator, n * (size_t)system.leading, sizeof(double));
  system.rhs = ambulo__alloc(allocator, n * (size_t)system.columns, sizeof(double));
  system.pivot = ambulo__alloc(allocator, n, sizeof *system.pivot);
  ambulo_status status = AMBULO_E_MEMORY;
  if (system.matrix && system.rhs && system.pivot) {
    int info;
    if (smooth) {
      info = solve_smoothing(motion, fit->basis, cutoff, &system);
    } else {
      collocate(motion, fit->basis, &system);
      info = solve_collocation(&system);
    }
    status = info != 0 ? AMBULO_E_NUMERIC : keep_solution(&system, fit);
  }
  ambulo__free(allocator, system.matrix);
  ambulo__free(allocator, system.rhs);
  ambulo__free(allocator, system.pivot);
  return status;
}

ambulo_status ambulo__motion_fit_create(const ambulo__motion *motion, int degree, double cutoff,
                                        const ambulo_allocator *allocator,
                                        ambulo__motion_fit **fit) {
  if (!fit || !arguments_are_valid(motion, degree, cutoff)) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__motion_fit *f = ambulo__alloc(&own, 1, sizeof *f);
  if (!f) return AMBULO_E_MEMORY;
  f->allocator = own;
  f->columns = motion->columns;
  f->start = motion->time[0];
  ambulo_status status = create_basis(motion, degree, &own, &f->basis);
  if (status == AMBULO_OK) {
    f->x = ambulo__alloc(&own, (size_t)motion->rows * (size_t)motion->columns, sizeof *f->x);
    status = f->x ? solve(motion, cutoff, f) : AMBULO_E_MEMORY;
  }
  if (status) {
    ambulo__motion_fit_free(f);
    return status;
  }
  *fit = f;
  return AMBULO_OK;
}

void ambulo__motion_fit_free(ambulo__motion_fit *fit) {
  if (!fit) return;
  ambulo_allocator allocator = fit->allocator;
  ambulo__basis_free(fit->basis);
  ambulo__free(&allocator, fit->x);
  ambulo__free(&allocator, fit);
}

void ambulo__motion_fit_at(const ambulo__motion_fit *fit, const double *times, int count, double *q,
                           double *qd, double *qdd) {
  double *output[3] = {q, qd, qdd};
  for (int k = 0; k < count; k++) {
    ambulo__basis_point point;
    ambulo__basis_at(fit->basis, times[k] - fit->start, &point);
    for (int order = 0; order < 3; order++) {
      if (!output[order]) continue;
      double *row = output[order] + (size_t)k * (size_t)fit->columns;
      for (int i = 0; i < fit->columns; i++) {
        const double *x = fit->x + (size_t)point.first * (size_t)fit->columns + i;
        double sum = 0.0;
        for (int c = 0; c < point.span; c++) {
          sum += point.weight[order][c] * x[(size_t)c * (size_t)fit->columns];
        }
        row[i] = sum;
      }
    }
  }
}

/* ------------------------------------------------------------------ filtering */

/* the largest distance between a time and where equal steps put it, in steps; *at: its row */
static double unevenness(const ambulo__filtering *f, double step, int *at) {
  double worst = 0.0;
  *at = 0;
  for (int k = 0; k < f->rows; k++) {
    double away = fabs(f->time[k] - f->time[0] - (double)k * step) / step;
    if (away <= worst) continue;
    worst = away;
    *at = k;
  }
  return worst;
}

ambulo_status ambulo__filter(const ambulo__filtering *f, double *values, int columns,
                             const ambulo_allocator *allocator) {
  ambulo__place place = {.file = f->file};
  int at = 0;
  double span = f->rows > 1 ? f->time[f->rows - 1] - f->time[0] : 0.0;
  double step = f->rows > 1 ? span / (double)(f->rows - 1) : 0.0;
  if (!(step > 0.0))
    return ambulo__error(f->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "%s needs rows of several times", f->option);
  if (unevenness(f, step, &at) > 0.1)
    return ambulo__error(
        f->diagnostics, AMBULO_E_SCHEMA, place, "resample the file first",
        "%s needs equally spaced times; with steps of %g s, t = %g s would be %g s", f->option,
        f->time_unit * step, f->time_unit * f->time[at],
        f->time_unit * (f->time[0] + (double)at * step));
  double rate = 1.0 / (f->time_unit * step);
  if (!(f->cutoff < 0.5 * rate))
    return ambulo__error(f->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                         "%s is %g Hz; expected less than half the %g rows a second", f->option,
                         f->cutoff, rate);
  return ambulo__butterworth(values, f->rows, columns, rate, f->cutoff, f->order, allocator);
}
