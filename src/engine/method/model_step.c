/* method/model_step.c - the step that foresees which rows become active.
 *
 * At the iterate x, with g = grad f, H0 = H_GN + mu I, excesses v with gradients J,
 * multipliers lambda and penalty rho, the augmented Lagrangian is modelled by
 *
 *     phi(d) = g.d + d' H0 d / 2 + sum_i max(0, lambda_i + rho (v + J d)_i)^2 / (2 rho)
 *
 * subject to J_e d = 0, C d = 0: convex and piecewise quadratic. Semismooth Newton, or primal-dual
 * active sets: with a set A of rows, solve
 *
 *     [ H0 + rho J_A'J_A   J_e' C' ]        [ -(g + H0 d + J_A'(lambda + rho (v + J d))) ]
 *     [ J_e, C                  0  ] step = [                     0                      ]
 *
 * and let A be the rows with lambda + rho (v + J d) > 0 at the new d. Three things make it short:
 *
 *   start   A is the set that the last model step ended with; its rows count with whatever force
 *           they have, which is where a full step from d = 0 with that set leads
 *   steps   are full while phi stays below the larger of its last two values: sets settle in a few
 *           of them. When it does not, back to the best point: from there the step is the exact
 *           minimum of phi along it (phi' is monotone and piecewise linear)
 *   end     when A repeats, or when a step brought less than a thousandth of the whole gain
 *
 * Rows that come or go are added to or taken from the band; few of them update its factor
 * (border.h), more have it factored anew. No evaluation but the first is needed. The metric of the
 * iterations that follow is the one with this predicted A: rows that the step is about to meet are
 * felt before they are hit, which is what plain Gauss-Newton steps lack.
 */
#include "method/model_step.h"
#include "method/point.h"
#include "method/parameters.h"
#include "base/arithmetic.h"

#include <float.h>
#include <math.h>
#include <string.h>

ambulo_status ambulo__quadratic_create(ambulo__engine *e) {
  ambulo__pool *pool = &e->pool;
  ambulo__quadratic *q = ambulo__pool_blocks(pool, 1, sizeof *q);
  if (!q) return AMBULO_E_MEMORY;
  e->quadratic = q;
  q->n = e->setup->n;
  q->inequalities = e->setup->inequalities;
  q->lambda = e->iterate.lambda;
  double **vectors[] = {&q->gradient, &q->total,        &q->step,       &q->right,
                        &q->curved,   &q->curved_total, &q->best_total, &q->best_curved};
  double **of_rows[] = {&q->linear, &q->force, &q->along, &q->best_linear};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    *vectors[i] = ambulo__pool_doubles(pool, (size_t)q->n);
  for (size_t i = 0; i < sizeof of_rows / sizeof *of_rows; i++)
    *of_rows[i] = ambulo__pool_doubles(pool, (size_t)q->inequalities);
  q->active = ambulo__pool_ints(pool, (size_t)q->inequalities);
  q->added = ambulo__pool_ints(pool, (size_t)q->inequalities);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

static double square(double x) {
  return x * x;
}

static double dot(const double *a, const double *b, int n) {
  double sum = 0.0;
  for (int j = 0; j < n; j++) sum += a[j] * b[j];
  return sum;
}

/* ---------------------------------------------------------------------- phi */

/* phi at total + t step */
static double value_at(const ambulo__quadratic *q, double t) {
  double smooth = 0.0, sum = 0.0;
  for (int j = 0; j < q->n; j++) {
    double d = q->total[j] + t * q->step[j];
    smooth += d * (q->gradient[j] + 0.5 * (q->curved_total[j] + t * q->curved[j]));
  }
  for (int i = 0; i < q->inequalities; i++) {
    double force = q->lambda[i] + q->rho * (q->linear[i] + t * q->along[i]);
    if (force > 0.0) sum += square(force);
  }
  return smooth + sum / (2.0 * q->rho);
}

/* phi' along the step at t, and phi'' */
static double slope_at(const ambulo__quadratic *q, const double smooth[2], double t,
                       double *curvature) {
  double slope = 0.0, second = 0.0;
  for (int i = 0; i < q->inequalities; i++) {
    double force = q->lambda[i] + q->rho * (q->linear[i] + t * q->along[i]);
    double on = force > 0.0 ? q->along[i] : 0.0;
    slope += on * force;
    second += on * on;
  }
  *curvature = smooth[1] + q->rho * second;
  return smooth[0] + smooth[1] * t + slope;
}

/* the minimum of phi along the step, at most the whole of it: by Newton's method within a bracket.
 * Beyond there is nothing but the rounding of a step that is next to none */
static double exact_step(const ambulo__quadratic *q) {
  double smooth[2] = {dot(q->step, q->gradient, q->n) + dot(q->step, q->curved_total, q->n),
                      dot(q->step, q->curved, q->n)};
  double low = 0.0, high = 1.0, t = 1.0, curvature;
  double zero = AMBULO__MODEL_LEVEL * fabs(slope_at(q, smooth, 0.0, &curvature));
  if (slope_at(q, smooth, 1.0, &curvature) <= zero) return 1.0;
  for (int k = 0; k < DBL_MANT_DIG; k++) {
    double slope = slope_at(q, smooth, t, &curvature);
    if (fabs(slope) <= zero) break;
    if (slope > 0.0) {
      high = t;
    } else {
      low = t;
    }
    t -= slope / curvature;
    if (!(t > low && t < high)) t = 0.5 * (low + high);
  }
  return t;
}

/* ----------------------------------------------------------------- active set */

/* the rows with a force at the step so far, into active; how many changed */
static int mark_active(ambulo__quadratic *q) {
  int changed = 0;
  for (int i = 0; i < q->inequalities; i++) {
    int is = q->lambda[i] + q->rho * q->linear[i] > 0.0;
    changed += is != q->active[i];
    q->active[i] = is;
  }
  return changed;
}

/* H0 + rho J_A'J_A into the whitener, and the KKT matrix with it factored: anew, or by an update
 * with the rows that came and went. 1 when it cannot be. */
static int factor(ambulo__linearized *at, ambulo__quadratic *q) {
  const ambulo__sparse_rows *rows = &at->rows.inequality;
  int fresh = !at->assembled, moved = 0;
  if (fresh) {
    ambulo__band_copy(&at->base, &at->whitener);
    memset(q->added, 0, (size_t)q->inequalities * sizeof *q->added);
  }
  for (int i = 0; i < q->inequalities; i++) {
    if (q->active[i] == q->added[i]) continue;
    double weight = q->active[i] ? q->rho : -q->rho;
    ambulo__band_add_sparse(&at->whitener, rows, i, weight);
    if (!fresh) ambulo__update_row(&at->kkt.update, rows, i, weight);
    q->added[i] = q->active[i];
    moved = 1;
  }
  at->assembled = 1;
  if (fresh) return ambulo__kkt_factor(&at->kkt, &at->whitener);
  return moved && ambulo__kkt_renew(&at->kkt, &at->whitener);
}

/* -------------------------------------------------------------------- one step */

/* The step for the active set; *slope: minus the product of phi's gradient with it. 1 when it
 * cannot be factored. */
static int direction(ambulo__engine *e, double *slope) {
  ambulo__linearized *at = &e->linearized;
  ambulo__quadratic *q = e->quadratic;
  const ambulo__sparse_rows *rows = &at->rows.inequality;
  if (factor(at, q)) return 1;
  for (int i = 0; i < q->inequalities; i++)
    q->force[i] = q->active[i] ? q->lambda[i] + q->rho * q->linear[i] : 0.0;
  for (int j = 0; j < q->n; j++) q->right[j] = -(q->gradient[j] + q->curved_total[j]);
  ambulo__sparse_rows_add_transpose(rows, -1.0, q->force, q->right);
  ambulo__kkt_solve(&at->kkt, q->right, NULL, NULL, q->step, e->iterate.equality_multiplier,
                    e->iterate.border_multiplier);
  ambulo__band_multiply(&at->base, q->step, q->curved);
  ambulo__sparse_rows_multiply(rows, q->step, q->along);
  *slope = dot(q->right, q->step, q->n);
  return 0;
}

static void take(ambulo__quadratic *q, double t) {
  for (int j = 0; j < q->n; j++) {
    q->total[j] += t * q->step[j];
    q->curved_total[j] += t * q->curved[j];
  }
  for (int i = 0; i < q->inequalities; i++) q->linear[i] += t * q->along[i];
}

/* what is known of phi on the way */
typedef struct descent {
  double start, value, before, least; /* phi at 0, now, one step ago, at the best point */
  int searching;                      /* line searches from now on */
  double tolerance;                   /* enough, or exact */
} descent;

static void keep(ambulo__quadratic *q, descent *d) {
  if (!(d->value < d->least)) return;
  d->least = d->value;
  memcpy(q->best_total, q->total, (size_t)q->n * sizeof *q->total);
  memcpy(q->best_curved, q->curved_total, (size_t)q->n * sizeof *q->total);
  memcpy(q->best_linear, q->linear, (size_t)q->inequalities * sizeof *q->linear);
}

static void go_back(ambulo__quadratic *q, descent *d) {
  d->value = d->least;
  memcpy(q->total, q->best_total, (size_t)q->n * sizeof *q->total);
  memcpy(q->curved_total, q->best_curved, (size_t)q->n * sizeof *q->total);
  memcpy(q->linear, q->best_linear, (size_t)q->inequalities * sizeof *q->linear);
}

/* k-th step; 1 when the model is solved, -1 when a factorization failed, else 0 */
static int newton(ambulo__engine *e, int k, descent *d) {
  ambulo__quadratic *q = e->quadratic;
  double slope, t = 1.0;
  if (direction(e, &slope)) return -1;
  double now = value_at(q, 1.0);
  if (!d->searching && k > 0 && now > fmax(d->before, d->value)) {
    d->searching = 1;
    go_back(q, d);
    (void)mark_active(q);
    return 0;
  }
  if (d->searching) {
    t = exact_step(q);
    now = value_at(q, t);
  }
  take(q, t);
  d->before = d->value;
  d->value = now;
  int better = now < d->least;
  keep(q, d);
  double gained = d->start - d->least;
  int changed = mark_active(q);
  if (changed == 0) return 1;
  if (!better) return 0;
  if (k > 0 && fabs(d->before - now) < d->tolerance * gained) return 1;
  return slope < AMBULO__HALF_DIGITS * gained;
}

int ambulo__model_minimize(ambulo__engine *e, double rho, int roughly, double *phi) {
  ambulo__quadratic *q = e->quadratic;
  size_t bytes = (size_t)q->n * sizeof *q->total;
  int settled = 0;
  if (q->rho != rho) e->linearized.assembled = 0;
  q->rho = rho;
  memset(q->total, 0, bytes);
  memset(q->curved_total, 0, bytes);
  memset(q->along, 0, (size_t)q->inequalities * sizeof *q->along);
  if (!roughly || !q->warm) (void)mark_active(q);
  q->warm = 0;
  descent d = {.before = HUGE_VAL,
               .least = HUGE_VAL,
               .searching = !roughly,
               .tolerance = roughly ? AMBULO__MODEL_ENOUGH : AMBULO__HALF_DIGITS};
  d.start = d.value = value_at(q, 0.0);
  keep(q, &d);
  for (int k = 0; k < AMBULO__MODEL_STEPS && settled == 0; k++) {
    (void)ambulo__run_poll(e->run); /* one step of a large problem takes seconds */
    settled = ambulo__run_late(e->run) ? -1 : newton(e, k, &d);
  }
  if (settled < 0) return -1;
  /* never where the minimum itself is wanted: next to it phi is rounding, and d = 0 says that there
   * is nothing left to gain */
  if (roughly && d.value > d.least) go_back(q, &d);
  for (int i = 0; i < q->inequalities; i++)
    q->force[i] = ambulo__worse(0.0, q->lambda[i] + q->rho * q->linear[i]);
  *phi = d.least - d.start;
  return 0;
}

/* the metric of the rows that were active when the KKT matrix was factored */
static int finish(ambulo__linearized *at, ambulo__quadratic *q) {
  memcpy(q->active, q->added, (size_t)q->inequalities * sizeof *q->active);
  at->assembled = 0; /* but factored */
  return ambulo__band_factor(&at->whitener);
}

static int not_finite(ambulo__engine *e) {
  ambulo__run_fault(e->run, &e->workspace->fault);
  return 2;
}

/* (P.5) the active set that phi foresees */
int ambulo__model_step(ambulo__engine *e, double *predicted) {
  ambulo__linearized *at = &e->linearized;
  ambulo__quadratic *q = e->quadratic;
  if (ambulo__evaluate_jacobian(e->workspace, e->iterate.x)) return not_finite(e);
  if (ambulo__engine_gradient(e, e->setup->objective_scale, NULL, NULL, q->gradient)) return 2;
  double begin = ambulo__seconds_now();
  if (ambulo__sparse_rows_fill(&at->rows.equality, e->workspace, 0) ||
      ambulo__sparse_rows_fill(&at->rows.inequality, e->workspace, 0))
    return not_finite(e);
  ambulo__engine_excess(e, q->linear);
  if (ambulo__engine_fill_metric(e, e->iterate.mu)) return 2;
  int failed = ambulo__model_minimize(e, e->iterate.rho, 1, predicted) || finish(at, q);
  q->warm = !failed && *predicted < 0.0;
  e->run->seconds_linear += ambulo__seconds_now() - begin;
  return failed;
}
