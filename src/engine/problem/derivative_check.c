/* problem/derivative_check.c - hand-derived gradients against central differences, by name.
 *
 * For every unknown x_j the whole problem is evaluated at x_j +- h and x_j +- 2 h; each row and
 * each objective term gives D(h) = (c(x + h e_j) - c(x - h e_j)) / 2h, and from two of them
 * (4 D(h) - D(2 h)) / 3, whose error is of order h^4 (Richardson): smoothed absolute values have
 * large third derivatives. It is compared with the analytic entry. The error of an entry is
 * |analytic - numeric| / max(1, |row|), |row| the largest analytic entry of its row. With h about
 * eps^(1/3) the difference itself is good to about 1e-9 of the row's size.
 *
 * It is done with h, h / 16 and h / 256, and the nearest difference counts.
 *
 * The check needs twelve evaluations per unknown and rows * unknowns comparisons; it is meant
 * for grids of a few hundred unknowns.
 */
#include "base/arithmetic.h"
#include "problem/nlp.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef struct check {
  const ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x;            /* [variables] the moved point */
  double *minus, *plus; /* [rows + terms] values at both sides */
  double *slope;        /* [rows + terms] D(h) */
  double *nearest;      /* [rows + terms] of the differences with several steps */
  double *size;         /* [rows + terms] largest analytic entry */
  double *analytic;     /* [rows + terms][variables] */
  ambulo_derivative_error *errors;
  int capacity, count;
} check;

static int family_index(check *c, const char *family) {
  for (int i = 0; i < c->count; i++)
    if (strcmp(c->errors[i].family, family) == 0) return i;
  if (c->count == c->capacity) return -1;
  ambulo_derivative_error fresh = {.family = family, .subject = "", .variable = "", .error = -1.0};
  c->errors[c->count] = fresh;
  return c->count++;
}

static ambulo_status analytic_rows(check *c, const double *x) {
  const ambulo_problem *p = c->problem;
  size_t n = (size_t)p->variables;
  for (int r = 0; r < p->rows; r++) {
    double *row = c->analytic + (size_t)r * n;
    ambulo_status status = ambulo_problem_row_gradient(p, c->workspace, x, r, row);
    if (status) return status;
  }
  return AMBULO_OK;
}

/* the rows once more through the reverse sweep: both routes must agree */
static ambulo_status rows_by_reverse_sweep(check *c, const double *x, double *weights,
                                           double *gradient) {
  const ambulo_problem *p = c->problem;
  size_t n = (size_t)p->variables;
  for (int r = 0; r < p->rows; r++) weights[r] = sin(1.0 + (double)r);
  ambulo_status status = ambulo_problem_gradient(p, c->workspace, x, 0.0, weights, gradient);
  if (status) return status;
  for (size_t j = 0; j < n; j++) {
    double sum = 0.0, scale = 1.0;
    for (int r = 0; r < p->rows; r++) {
      double part = weights[r] * c->analytic[(size_t)r * n + j];
      sum += part;
      scale += fabs(part);
    }
    if (!(fabs(sum - gradient[j]) <= 1e-9 * scale)) return AMBULO_E_INTERNAL;
  }
  return AMBULO_OK;
}

static ambulo_status analytic_terms(check *c, const double *x) {
  const ambulo_problem *p = c->problem;
  size_t n = (size_t)p->variables;
  for (int t = 0; t < p->definition.term_count; t++) {
    ambulo_status status = ambulo__evaluate(c->workspace, x);
    if (status) return status;
    status = ambulo__term_gradient(c->workspace, t, c->analytic + (size_t)(p->rows + t) * n);
    if (status) return status;
  }
  return AMBULO_OK;
}

static ambulo_status values(check *c, double *out) {
  const ambulo_problem *p = c->problem;
  return ambulo_problem_evaluate(p, c->workspace, c->x, NULL, out + p->rows, out);
}

static void describe(check *c, int line, int j, double numeric, double error) {
  const ambulo_problem *p = c->problem;
  int is_row = line < p->rows;
  const ambulo__table_row *row = is_row ? &p->table.rows[line] : NULL;
  const char *family = is_row ? row->family : ambulo_problem_term_name(p, line - p->rows);
  int at = family_index(c, family);
  if (at < 0 || !ambulo__is_worse(c->errors[at].error, error)) return;
  ambulo_derivative_error *e = &c->errors[at];
  e->subject = is_row ? row->subject : "";
  e->time = is_row ? row->time : 0.0;
  e->variable = ambulo_model_coordinate(p->model, j % p->coordinates)->name;
  e->control_point = j / p->coordinates;
  e->analytic = c->analytic[(size_t)line * (size_t)p->variables + (size_t)j];
  e->numeric = numeric;
  e->error = error;
}

/* plus := D(h) of every line */
static ambulo_status difference(check *c, const double *x, int j, double h) {
  int lines = c->problem->rows + c->problem->definition.term_count;
  c->x[j] = x[j] + h;
  double upper = c->x[j];
  ambulo_status status = values(c, c->plus);
  c->x[j] = x[j] - h;
  double lower = c->x[j];
  if (!status) status = values(c, c->minus);
  c->x[j] = x[j];
  for (int line = 0; !status && line < lines; line++)
    c->plus[line] = (c->plus[line] - c->minus[line]) / (upper - lower);
  return status;
}

/* slope := (4 D(h) - D(2 h)) / 3 of every line, good to h^4 */
static ambulo_status extrapolate(check *c, const double *x, int j, double h) {
  int lines = c->problem->rows + c->problem->definition.term_count;
  ambulo_status status = difference(c, x, j, h);
  if (status) return status;
  memcpy(c->slope, c->plus, (size_t)lines * sizeof *c->slope);
  status = difference(c, x, j, 2.0 * h);
  for (int line = 0; !status && line < lines; line++)
    c->slope[line] = (4.0 * c->slope[line] - c->plus[line]) / 3.0;
  return status;
}

static double entry_error(const check *c, int line, int j, double numeric) {
  double analytic = c->analytic[(size_t)line * (size_t)c->problem->variables + (size_t)j];
  return fabs(analytic - numeric) / fmax(1.0, c->size[line]);
}

/* Long steps suffer less from rounding, short ones less from sharply bent functions. A right entry
 * agrees with one of them, a wrong one with none. */
static ambulo_status compare_variable(check *c, const double *x, int j, double step) {
  static const double parts[] = {1.0, 1.0 / 16.0, 1.0 / 256.0};
  int lines = c->problem->rows + c->problem->definition.term_count;
  double h = step * fmax(1.0, fabs(x[j]));
  for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
    ambulo_status status = extrapolate(c, x, j, parts[k] * h);
    if (status) return status;
    for (int line = 0; line < lines; line++)
      if (k == 0 ||
          entry_error(c, line, j, c->slope[line]) < entry_error(c, line, j, c->nearest[line]))
        c->nearest[line] = c->slope[line];
  }
  for (int line = 0; line < lines; line++)
    describe(c, line, j, c->nearest[line], entry_error(c, line, j, c->nearest[line]));
  return AMBULO_OK;
}

static void row_sizes(check *c) {
  int lines = c->problem->rows + c->problem->definition.term_count;
  size_t n = (size_t)c->problem->variables;
  for (int line = 0; line < lines; line++) {
    c->size[line] = 0.0;
    for (size_t j = 0; j < n; j++)
      c->size[line] = ambulo__worse(c->size[line], fabs(c->analytic[(size_t)line * n + j]));
  }
}

static ambulo_status run(check *c, const double *x, double step) {
  int n = c->problem->variables;
  ambulo_status status = analytic_rows(c, x);
  if (!status) status = rows_by_reverse_sweep(c, x, c->plus, c->x);
  if (!status) status = analytic_terms(c, x);
  if (status) return status;
  row_sizes(c);
  memcpy(c->x, x, (size_t)n * sizeof *x);
  for (int j = 0; j < n && !status; j++) status = compare_variable(c, x, j, step);
  return status;
}

/* (FD) central differences beside the gradients */
ambulo_status ambulo_problem_check_derivatives(const ambulo_problem *p, ambulo_workspace *workspace,
                                               const double *x, double step,
                                               ambulo_derivative_error *errors, int capacity,
                                               int *count) {
  if (!p || !workspace || workspace->problem != p || !x || !errors || capacity < 0 || !count)
    return AMBULO_E_ARGUMENT;
  const ambulo_allocator *a = &workspace->allocator;
  size_t n = (size_t)p->variables, lines = (size_t)(p->rows + p->definition.term_count);
  check c = {.problem = p, .workspace = workspace, .errors = errors, .capacity = capacity};
  c.x = ambulo__alloc(a, n, sizeof(double));
  c.minus = ambulo__alloc(a, lines, sizeof(double));
  c.plus = ambulo__alloc(a, lines, sizeof(double));
  c.slope = ambulo__alloc(a, lines, sizeof(double));
  c.nearest = ambulo__alloc(a, lines, sizeof(double));
  c.size = ambulo__alloc(a, lines, sizeof(double));
  c.analytic = n && lines > SIZE_MAX / n ? NULL : ambulo__alloc(a, lines * n, sizeof(double));
  ambulo_status status = AMBULO_E_MEMORY;
  if (c.x && c.minus && c.plus && c.slope && c.nearest && c.size && c.analytic)
    status = run(&c, x, step > 0.0 ? step : cbrt(DBL_EPSILON));
  ambulo__free(a, c.x);
  ambulo__free(a, c.minus);
  ambulo__free(a, c.plus);
  ambulo__free(a, c.slope);
  ambulo__free(a, c.nearest);
  ambulo__free(a, c.size);
  ambulo__free(a, c.analytic);
  if (!status) *count = c.count;
  return status;
}
