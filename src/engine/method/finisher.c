/* method/finisher.c - see finisher.h.
 *
 *     minimize f(R(y + L^-T w))   subject to   v_i(R(y + L^-T w)) <= 0,   i near y
 *
 * with R the retraction and L L' the metric of the model step at y: SLSQP's first quadratic
 * model, the identity, is that metric, and equality rows never reach it. All gradients are
 * tangent ((A) of retraction.c: dF/dw = L' z), so its steps stay in the tangent space although
 * w has all n components. A row's own gradient is that of the same map with f left out.
 *
 * Screening: rows within a margin of active are handed over; a row outside that the step
 * violates joins them, and SLSQP starts again from the point before.
 */
#include "method/finisher.h"
#include "method/engine_point.h"
#include "method/model_step.h"
#include "method/nlopt_direct.h"
#include "method/parameters.h"
#include "method/retraction.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

typedef struct finisher {
  ambulo__engine *engine;
  nlopt_opt opt;
  int count;            /* rows handed to SLSQP */
  int *row;             /* [inequalities]: which */
  int *handed;          /* [inequalities]: whether */
  double *start;        /* [n]: SLSQP's point, whitened, in and out */
  double *w, *x;        /* [n]: the point in the workspace, whitened and not */
  double *excess;       /* [inequalities]: there */
  double *one;          /* [inequalities]: weights of a single row */
  double *tolerance;    /* [inequalities] */
  double *l, *l_of_row; /* [equalities]: multipliers of the objective's gradient, of a row's */
  int held, failed;     /* w is the point in the workspace; it could not be reached */
  double seconds;
} finisher;

/* the workspace at w; 1 on failure */
static int move_to(finisher *s, const double *w) {
  ambulo__engine *e = s->engine;
  const int n = e->setup->n;
  size_t bytes = (size_t)n * sizeof *w;
  if (s->held && memcmp(w, s->w, bytes) == 0) return s->failed;
  memcpy(s->w, w, bytes);
  memcpy(s->x, w, bytes);
  s->held = 1;
  ambulo__run_count(e->run);
  ambulo__band_backward(&e->linearized.whitener, s->x);
  for (int j = 0; j < n; j++) s->x[j] += e->iterate.x[j];
  s->failed = !ambulo__retract(e, s->x);
  if (!s->failed) ambulo__engine_excess(e, s->excess);
  if (e->run->stopped) nlopt_force_stop(s->opt);
  return s->failed;
}

/* of the rows weighted by p, with the objective scaled by `scale`; l: first guess and result; 1
 * when it is not finite */
static int differentiate(ambulo__engine *e, double scale, const double *p, double *l,
                         double *gradient) {
  int failed = ambulo__reduced_gradient(e, scale, p, l, gradient) != AMBULO_OK;
  ambulo__band_upper_multiply(&e->linearized.whitener, gradient);
  return failed;
}

static double objective(unsigned n, const double *w, double *gradient, void *data) {
  finisher *s = data;
  double begin = ambulo__seconds_now(), value = HUGE_VAL;
  if (!move_to(s, w)) value = s->engine->setup->objective_scale * s->engine->workspace->objective;
  if (!s->failed && gradient)
    s->failed = differentiate(s->engine, s->engine->setup->objective_scale, NULL, s->l, gradient);
  if (s->failed) {
    value = HUGE_VAL;
    if (gradient) memset(gradient, 0, n * sizeof *gradient);
  }
  s->seconds += ambulo__seconds_now() - begin;
  return value;
}

static void rows(unsigned m, double *result, unsigned n, const double *w, double *gradient,
                 void *data) {
  finisher *s = data;
  ambulo__engine *e = s->engine;
  double begin = ambulo__seconds_now();
  int failed = move_to(s, w);
  if (gradient) memset(gradient, 0, (size_t)m * (size_t)n * sizeof *gradient);
  for (unsigned i = 0; i < m; i++) {
    int r = s->row[i];
    result[i] = failed ? 1.0 : s->excess[r];
    if (failed || !gradient) continue;
    s->one[r] = 1.0;
    memset(s->l_of_row, 0, (size_t)e->setup->equalities * sizeof *s->l_of_row);
    double *row = gradient + (size_t)i * (size_t)n;
    if (differentiate(e, 0.0, s->one, s->l_of_row, row)) memset(row, 0, n * sizeof *row);
    s->one[r] = 0.0;
  }
  s->seconds += ambulo__seconds_now() - begin;
}

/* marks rows near active at the point held; returns how many are new and violated */
static int screen(finisher *s) {
  ambulo__engine *e = s->engine;
  double tolerance = e->run->options->feasibility_tolerance;
  int found = 0;
  for (int i = 0; i < e->setup->inequalities; i++) {
    if (s->handed[i]) continue;
    int row = e->setup->rows->inequality.row[i];
    double size = e->setup->problem->table.rows[row].size;
    double excess = s->excess[i] / (-e->setup->rows->inequality.scale[i] * size);
    if (excess < -AMBULO__FINISHER_MARGIN) continue;
    s->handed[i] = 1;
    s->row[s->count++] = i;
    found += excess > tolerance;
  }
  return found;
}

static int minimize(finisher *s, double *w) {
  ambulo__engine *e = s->engine;
  unsigned n = (unsigned)e->setup->n;
  double least;
  for (int i = 0; i < s->count; i++) s->tolerance[i] = AMBULO__FINISHER_ROW;
  s->opt = nlopt_create(NLOPT_LD_SLSQP, n);
  if (!s->opt) return NLOPT_OUT_OF_MEMORY;
  int result = nlopt_set_min_objective(s->opt, objective, s);
  if (result >= 0) result = nlopt_set_maxeval(s->opt, AMBULO__FINISHER_EVALUATIONS);
  if (result >= 0) result = nlopt_set_ftol_rel(s->opt, AMBULO__FINISHER_VALUE);
  if (result >= 0) result = nlopt_set_xtol_rel(s->opt, AMBULO__FINISHER_POINT);
  if (result >= 0 && s->count > 0)
    result = nlopt_add_inequality_mconstraint(s->opt, (unsigned)s->count, rows, s, s->tolerance);
  memset(w, 0, n * sizeof *w);
  if (result >= 0) result = nlopt_optimize(s->opt, w, &least);
  nlopt_destroy(s->opt);
  s->opt = NULL;
  return result;
}

static ambulo_status create(ambulo__engine *e, ambulo__pool *pool, finisher *s) {
  size_t n = (size_t)e->setup->n, m = (size_t)e->setup->inequalities;
  size_t equalities = (size_t)e->setup->equalities;
  s->engine = e;
  s->row = ambulo__pool_ints(pool, m);
  s->handed = ambulo__pool_ints(pool, m);
  s->start = ambulo__pool_doubles(pool, n);
  s->w = ambulo__pool_doubles(pool, n);
  s->x = ambulo__pool_doubles(pool, n);
  s->excess = ambulo__pool_doubles(pool, m);
  s->one = ambulo__pool_doubles(pool, m);
  s->tolerance = ambulo__pool_doubles(pool, m);
  s->l = ambulo__pool_doubles(pool, equalities);
  s->l_of_row = ambulo__pool_doubles(pool, equalities);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

/* from the iterate, with the whitener there; the point found is s->x */
static ambulo_status rounds(finisher *s, const char **message) {
  ambulo__run *run = s->engine->run;
  if (!move_to(s, s->start)) (void)screen(s);
  for (int round = 0; round < AMBULO__FINISHER_ROUNDS && !s->failed; round++) {
    int result = minimize(s, s->start);
    *message = ambulo__nlopt_name(result);
    ambulo__run_nlopt(run, result, *message, 0.0); /* seconds: see ambulo__finish */
    if (result == NLOPT_OUT_OF_MEMORY) return AMBULO_E_MEMORY;
    if (move_to(s, s->start) || screen(s) == 0) break;
  }
  return AMBULO_OK;
}

static ambulo_status finish(finisher *s, double *x, const char **message) {
  ambulo__engine *e = s->engine;
  ambulo__retraction *r = e->retraction;
  double predicted, adjoint = r->adjoint_tolerance, retraction = r->tolerance;
  size_t bytes = (size_t)e->setup->n * sizeof *x;
  memcpy(e->iterate.x, x, bytes);
  if (ambulo__model_step(e, &predicted)) return AMBULO_OK;
  double begin = ambulo__seconds_now();
  r->adjoint_tolerance = AMBULO__FINISHER_ADJOINT;
  r->tolerance = AMBULO__FINISHER_RETRACTION;
  ambulo_status status = rounds(s, message);
  if (!status && s->held && !s->failed) memcpy(x, s->x, bytes);
  r->adjoint_tolerance = adjoint;
  r->tolerance = retraction;
  e->run->iterations++;
  e->run->nlopt.seconds += ambulo__seconds_now() - begin - s->seconds;
  return status;
}

ambulo_status ambulo__finish(ambulo__engine *e, double *x, const char **message) {
  finisher s = {0};
  ambulo__pool pool;
  ambulo__pool_init(&pool, &e->pool.allocator);
  ambulo_status status = create(e, &pool, &s);
  if (!status) status = finish(&s, x, message);
  ambulo__pool_clear(&pool);
  return status;
}
