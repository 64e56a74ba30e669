/* solver/elastic.c - the least violation that a problem can be brought to (explain.h).
 *
 * Levenberg-Marquardt. At x, with rows c and gradients J (divided by s, times w), the model
 *
 *     phi(d) = sum_eq (c + J d)^2 / 2 + sum_ineq min(0, c + J d)^2 / 2 + mu |d|^2 / 2
 *
 * is convex and piecewise quadratic; semismooth Newton on it foresees which rows the step
 * brings into play (as model_step.c does):
 *
 *     A = all equalities and { c + J d < 0 },   (J_A' J_A + mu I) step = -grad phi(d)
 *
 * until A repeats. Rows of one node make a banded matrix B = L L'; the border rows C (active
 * ones, weighted; the others are zero) enter by Woodbury's identity,
 *
 *     (B + C'C)^-1 a = L^-T (u - W (I + W'W)^-1 W'u),   W = L^-1 C',  u = L^-1 a.
 *
 * mu falls when E decreases as the model predicts, and rises when E does not decrease.
 */
#include "solver/explain.h"
#include "base/arithmetic.h"
#include "method/metric.h"
#include "method/row_roles.h"

#include <math.h>
#include <string.h>

enum { MAX_STEPS = 200, MAX_NEWTON = 12, MAX_HALVINGS = 10, MAX_BORDERS = 600, STEADY = 4 };
static const double mu_start = 1e-2, mu_least = 1e-9, mu_largest = 1e8;
static const double step_cap = 0.5; /* rad, m */
static const double vanished = 1e-18;
static const double steady_change = 1e-5; /* relative change of E that is no progress */

static ambulo_status create_rows(ambulo__elastic *e, ambulo__pool *pool) {
  const ambulo_problem *p = e->problem;
  int *local = ambulo__pool_ints(pool, (size_t)p->rows);
  int *border = ambulo__pool_ints(pool, (size_t)p->rows);
  if (pool->failed) return AMBULO_E_MEMORY;
  e->locals = e->borders = 0;
  for (int r = 0; r < p->rows; r++) {
    if (ambulo__row_host(p, r) >= 0) {
      local[e->locals++] = r;
    } else {
      border[e->borders++] = r;
    }
  }
  if (e->borders > MAX_BORDERS) return AMBULO_E_LIMIT;
  ambulo__poll poll = ambulo__run_poller(e->run);
  ambulo_status status = ambulo__sparse_rows_create(p, local, e->locals, &poll, pool, &e->local);
  if (status) return status;
  return ambulo__sparse_rows_create(p, border, e->borders, &poll, pool, &e->border);
}

static ambulo_status create_vectors(ambulo__elastic *e, ambulo__pool *pool) {
  size_t n = (size_t)e->n, b = (size_t)e->borders, l = (size_t)e->locals;
  double **long_vectors[] = {&e->step, &e->total, &e->right, &e->trial};
  for (size_t i = 0; i < sizeof long_vectors / sizeof *long_vectors; i++)
    *long_vectors[i] = ambulo__pool_doubles(pool, n);
  e->linear_border = ambulo__pool_doubles(pool, b);
  e->along_border = ambulo__pool_doubles(pool, b);
  e->linear_local = ambulo__pool_doubles(pool, l);
  e->along_local = ambulo__pool_doubles(pool, l);
  e->pull = ambulo__pool_doubles(pool, l + b);
  e->active_local = ambulo__pool_ints(pool, l);
  e->active_border = ambulo__pool_ints(pool, b);
  e->size = ambulo__pool_doubles(pool, l + b);
  e->weight = ambulo__pool_doubles(pool, l + b);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

ambulo_status ambulo__elastic_create(const ambulo_problem *problem, ambulo_workspace *workspace,
                                     ambulo__run *run, ambulo__pool *pool, ambulo__elastic *e) {
  memset(e, 0, sizeof *e);
  e->problem = problem;
  e->workspace = workspace;
  e->run = run;
  e->n = problem->variables;
  e->deadline = e->time_limit = HUGE_VAL;
  ambulo_status status = create_rows(e, pool);
  if (!status) status = create_vectors(e, pool);
  int kd = ambulo__metric_diagonals(problem);
  if (!status) status = ambulo__band_create(pool, e->n, kd, &e->base);
  if (!status) status = ambulo__band_create(pool, e->n, kd, &e->factor);
  if (!status) status = ambulo__border_create(&e->border, pool, &e->bordered);
  if (!status) status = ambulo__evaluate_jacobian(workspace, workspace->x);
  if (status) return status;
  status = ambulo__sparse_rows_fill(&e->local, workspace, 1);
  if (!status) status = ambulo__sparse_rows_fill(&e->border, workspace, 1);
  if (status) return status;
  for (int i = 0; i < e->locals; i++)
    e->size[e->local.row[i]] = ambulo__rows_size(problem, &e->local, i);
  for (int i = 0; i < e->borders; i++)
    e->size[e->border.row[i]] = ambulo__rows_size(problem, &e->border, i);
  for (int r = 0; r < problem->rows; r++) e->weight[r] = 1.0;
  return AMBULO_OK;
}

double ambulo__elastic_excess(const ambulo__elastic *e, int row, double value) {
  return ambulo__row_missed(&e->problem->table.rows[row], value) / e->size[row];
}

/* by the caller or the clock */
static int is_stopped(ambulo__elastic *e) {
  ambulo__run *run = e->run;
  if (!e->cancelled && run->options->progress) {
    int stopped = run->stopped;
    run->stopped = 0; /* a limit that ended the solve is no wish of the caller */
    e->cancelled = ambulo__run_progress(run, e->workspace->objective, NAN);
    run->stopped |= stopped;
  }
  return e->cancelled || ambulo__seconds_now() >= e->time_limit;
}

int ambulo__elastic_over(ambulo__elastic *e) {
  return is_stopped(e) || e->work >= e->deadline;
}

/* ------------------------------------------------------------------- model */

static int pulls(const ambulo_problem *p, int row, double value) {
  return value < 0.0 || p->table.rows[row].relation == AMBULO_EQUAL;
}

/* sum of squares of the rows that pull, at linear + t along */
static double sum_rows(const ambulo__elastic *e, const ambulo__sparse_rows *rows,
                       const double *linear, const double *along, double t) {
  double sum = 0.0;
  for (int i = 0; i < rows->count; i++) {
    double value = linear[i] + t * along[i];
    if (pulls(e->problem, rows->row[i], value)) sum += value * value;
  }
  return 0.5 * sum;
}

static double model_rows(const ambulo__elastic *e, double t) {
  return sum_rows(e, &e->local, e->linear_local, e->along_local, t) +
         sum_rows(e, &e->border, e->linear_border, e->along_border, t);
}

/* values at the point held */
static void take_values(ambulo__elastic *e) {
  ambulo__sparse_rows_values(&e->local, e->workspace, e->linear_local);
  ambulo__sparse_rows_values(&e->border, e->workspace, e->linear_border);
  memset(e->along_local, 0, (size_t)e->locals * sizeof *e->along_local);
  memset(e->along_border, 0, (size_t)e->borders * sizeof *e->along_border);
}

static void set_scales(ambulo__elastic *e, ambulo__sparse_rows *rows) {
  for (int i = 0; i < rows->count; i++) {
    int r = rows->row[i];
    ambulo__sparse_rows_set_scale(rows, i, e->weight[r] / e->size[r]);
  }
}

static int mark(const ambulo__elastic *e, const ambulo__sparse_rows *rows, const double *linear,
                int *active) {
  int changed = 0;
  for (int i = 0; i < rows->count; i++) {
    int pulled = pulls(e->problem, rows->row[i], linear[i]);
    changed |= pulled != active[i];
    active[i] = pulled;
  }
  return changed;
}

static void assemble_equalities(ambulo__elastic *e) {
  ambulo__band_clear(&e->base);
  for (int i = 0; i < e->locals; i++) {
    if (e->problem->table.rows[e->local.row[i]].relation == AMBULO_EQUAL)
      ambulo__band_add_sparse(&e->base, &e->local, i, 1.0);
  }
}

static int factor(ambulo__elastic *e, double mu) {
  ambulo__band_copy(&e->base, &e->factor);
  ambulo__band_add_diagonal(&e->factor, mu);
  for (int i = 0; i < e->locals; i++) {
    int equal = e->problem->table.rows[e->local.row[i]].relation == AMBULO_EQUAL;
    if (!equal && e->active_local[i]) ambulo__band_add_sparse(&e->factor, &e->local, i, 1.0);
  }
  return ambulo__band_factor(&e->factor) ||
         ambulo__border_factor(&e->bordered, &e->factor, e->active_border, 1.0, 0.0);
}

/* right becomes the solution */
static void solve(ambulo__elastic *e, double *right) {
  ambulo__band_forward(&e->factor, right);
  ambulo__border_eliminate(&e->bordered, NULL, right);
  ambulo__band_backward(&e->factor, right);
}

/* y -= J' (values of the rows that pull) */
static void add_pull(const ambulo__elastic *e, const ambulo__sparse_rows *rows,
                     const double *linear, const int *active, double *y) {
  for (int i = 0; i < rows->count; i++) e->pull[i] = active[i] ? linear[i] : 0.0;
  ambulo__sparse_rows_add_transpose(rows, -1.0, e->pull, y);
}

static double damping(const ambulo__elastic *e, double mu, double t) {
  double sum = 0.0;
  for (int j = 0; j < e->n; j++) {
    double d = e->total[j] + t * e->step[j];
    sum += d * d;
  }
  return 0.5 * mu * sum;
}

/* one Newton step on phi; 1 when A repeats, -1 when the factorization failed */
static int newton(ambulo__elastic *e, double mu, double *phi) {
  e->work += 1.0;
  if (factor(e, mu)) return -1;
  for (int j = 0; j < e->n; j++) e->right[j] = -mu * e->total[j];
  add_pull(e, &e->local, e->linear_local, e->active_local, e->right);
  add_pull(e, &e->border, e->linear_border, e->active_border, e->right);
  memcpy(e->step, e->right, (size_t)e->n * sizeof *e->step);
  solve(e, e->step);
  ambulo__sparse_rows_multiply(&e->local, e->step, e->along_local);
  ambulo__sparse_rows_multiply(&e->border, e->step, e->along_border);
  double t = 1.0, value = *phi;
  for (int trial = 0; trial < MAX_HALVINGS; trial++) {
    value = model_rows(e, t) + damping(e, mu, t);
    if (value <= *phi) break;
    t *= 0.5;
  }
  for (int j = 0; j < e->n; j++) e->total[j] += t * e->step[j];
  for (int i = 0; i < e->locals; i++) e->linear_local[i] += t * e->along_local[i];
  for (int i = 0; i < e->borders; i++) e->linear_border[i] += t * e->along_border[i];
  double gained = *phi - value;
  *phi = value;
  int changed = mark(e, &e->local, e->linear_local, e->active_local);
  changed |= mark(e, &e->border, e->linear_border, e->active_border);
  return (!changed && t == 1.0) || gained <= 1e-9 * value;
}

/* minimizes phi; the step in e->total; its value in *phi. 0 on success */
static int minimize_model(ambulo__elastic *e, double mu, double *phi) {
  int done = 0;
  take_values(e);
  memset(e->total, 0, (size_t)e->n * sizeof *e->total);
  (void)mark(e, &e->local, e->linear_local, e->active_local);
  (void)mark(e, &e->border, e->linear_border, e->active_border);
  *phi = model_rows(e, 0.0);
  for (int k = 0; k < MAX_NEWTON && !done; k++) done = is_stopped(e) ? -1 : newton(e, mu, phi);
  return done < 0;
}

/* -------------------------------------------------------------------- outer */

/* E at the point held */
static double energy(ambulo__elastic *e) {
  take_values(e);
  return model_rows(e, 0.0);
}

/* 0 when every gradient at x is finite */
static int linearize(ambulo__elastic *e, const double *x) {
  if (ambulo__evaluate_jacobian(e->workspace, x) ||
      ambulo__sparse_rows_fill(&e->local, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&e->border, e->workspace, 0))
    return 1;
  assemble_equalities(e);
  return 0;
}

/* tries the step of damping mu from x; 1 when E fell to *value */
static int advance(ambulo__elastic *e, double mu, double *x, double *value) {
  double phi, largest, before = *value;
  if (minimize_model(e, mu, &phi)) return 0;
  largest = ambulo__largest(e->total, (size_t)e->n);
  double t = largest <= step_cap ? 1.0 : step_cap / largest;
  for (int j = 0; j < e->n; j++) e->trial[j] = x[j] + t * e->total[j];
  if (ambulo__evaluate(e->workspace, e->trial)) return 0;
  double after = energy(e);
  if (!(after < before)) return 0;
  memcpy(x, e->trial, (size_t)e->n * sizeof *x);
  *value = after;
  return 1;
}

int ambulo__elastic_minimize(ambulo__elastic *e, double *x) {
  double mu = mu_start;
  int steady = 0;
  set_scales(e, &e->local);
  set_scales(e, &e->border);
  if (linearize(e, x)) return 0;
  double value = energy(e);
  for (int k = 0; k < MAX_STEPS && value > vanished && steady < STEADY; k++) {
    if (ambulo__elastic_over(e)) return 0;
    double before = value;
    if (advance(e, mu, x, &value)) {
      mu = fmax(mu_least, 0.2 * mu);
      steady = before - value <= steady_change * before ? steady + 1 : 0;
      if (linearize(e, x)) return 0;
      continue;
    }
    mu *= 8.0;
    if (ambulo__evaluate_jacobian(e->workspace, x)) return 0;
    if (mu > mu_largest) break;
  }
  return ambulo__evaluate_jacobian(e->workspace, x) == AMBULO_OK;
}
