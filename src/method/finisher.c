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
#include "method/parameters.h"
#include "method/nlopt_direct.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

typedef struct finisher {
  ambulo__engine *engine;
  nlopt_opt opt;
  int count;   /* rows handed to SLSQP */
  int *row;    /* [inequalities]: which */
  double *one; /* [inequalities]: weights of a single row */
  double *tolerance, *multiplier;
  int held, failed; /* engine->w is the point in the workspace; it could not be reached */
  double seconds;
} finisher;

/* the workspace at w; 1 on failure */
static int move_to(finisher *s, const double *w) {
  ambulo__engine *e = s->engine;
  size_t bytes = (size_t)e->n * sizeof *w;
  if (s->held && memcmp(w, e->w, bytes) == 0) return s->failed;
  memcpy(e->w, w, bytes);
  memcpy(e->held.x, w, bytes);
  s->held = 1;
  ambulo__run_count(e->run);
  ambulo__band_backward(&e->whitener, e->held.x);
  for (int j = 0; j < e->n; j++) e->held.x[j] += e->center[j];
  s->failed = !ambulo__retract(e, e->held.x);
  if (!s->failed) ambulo__engine_excess(e, e->held.excess);
  if (e->run->stopped) nlopt_force_stop(s->opt);
  return s->failed;
}

/* of the rows weighted by p, with the objective scaled by `scale`; l: first guess and result; 1
 * when it is not finite */
static int differentiate(ambulo__engine *e, double scale, const double *p, double *l,
                         double *gradient) {
  double objective_scale = e->objective_scale;
  size_t bytes = (size_t)e->equalities * sizeof *l;
  e->objective_scale = scale;
  memcpy(e->equality_multiplier, l, bytes);
  int failed = ambulo__reduced_gradient(e, p, gradient) != AMBULO_OK;
  ambulo__band_upper_multiply(&e->whitener, gradient);
  memcpy(l, e->equality_multiplier, bytes);
  e->objective_scale = objective_scale;
  return failed;
}

static double objective(unsigned n, const double *w, double *gradient, void *data) {
  finisher *s = data;
  double begin = ambulo__seconds_now(), value = HUGE_VAL;
  if (!move_to(s, w)) value = s->engine->objective_scale * s->engine->workspace->objective;
  if (!s->failed && gradient)
    s->failed = differentiate(s->engine, s->engine->objective_scale, NULL, s->multiplier, gradient);
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
    result[i] = failed ? 1.0 : e->held.excess[r];
    if (failed || !gradient) continue;
    s->one[r] = 1.0;
    memset(e->held.equality_multiplier, 0,
           (size_t)e->equalities * sizeof *e->held.equality_multiplier);
    double *row = gradient + (size_t)i * (size_t)n;
    if (differentiate(e, 0.0, s->one, e->held.equality_multiplier, row))
      memset(row, 0, n * sizeof *row);
    s->one[r] = 0.0;
  }
  s->seconds += ambulo__seconds_now() - begin;
}

/* marks rows near active at the point held; returns how many are new and violated */
static int screen(finisher *s) {
  ambulo__engine *e = s->engine;
  double tolerance = e->run->options->feasibility_tolerance;
  int found = 0;
  for (int i = 0; i < e->inequalities; i++) {
    if (e->active_next[i]) continue;
    int row = e->rows.inequality.row[i];
    double size = e->problem->table.rows[row].size;
    double excess = e->held.excess[i] / (-e->rows.inequality.scale[i] * size);
    if (excess < -AMBULO__FINISHER_MARGIN) continue;
    e->active_next[i] = 1;
    s->row[s->count++] = i;
    found += excess > tolerance;
  }
  return found;
}

static int minimize(finisher *s, double *w) {
  ambulo__engine *e = s->engine;
  unsigned n = (unsigned)e->n;
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

static ambulo_status create(ambulo__engine *e, finisher *s) {
  size_t m = (size_t)e->inequalities;
  s->engine = e;
  s->row = ambulo__pool_ints(&e->pool, m);
  s->one = ambulo__pool_doubles(&e->pool, m);
  s->tolerance = ambulo__pool_doubles(&e->pool, m);
  s->multiplier = ambulo__pool_doubles(&e->pool, (size_t)e->equalities);
  return e->pool.failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

ambulo_status ambulo__finish(ambulo__engine *e, double *x, const char **message) {
  finisher s = {0};
  double predicted, adjoint = e->adjoint_tolerance, retraction = e->retraction_tolerance;
  size_t bytes = (size_t)e->n * sizeof *x;
  ambulo_status status = create(e, &s);
  if (status) return status;
  memcpy(e->center, x, bytes);
  if (ambulo__model_step(e, &predicted)) return AMBULO_OK;
  double begin = ambulo__seconds_now();
  e->adjoint_tolerance = AMBULO__FINISHER_ADJOINT;
  e->retraction_tolerance = AMBULO__FINISHER_RETRACTION;
  memset(e->active_next, 0, (size_t)e->inequalities * sizeof *e->active_next);
  memset(e->iterate, 0, bytes);
  if (!move_to(&s, e->iterate)) (void)screen(&s);
  for (int round = 0; round < AMBULO__FINISHER_ROUNDS && !s.failed; round++) {
    int result = minimize(&s, e->iterate);
    *message = ambulo__nlopt_name(result);
    ambulo__run_nlopt(e->run, result, *message, 0.0); /* seconds below */
    if (result == NLOPT_OUT_OF_MEMORY) status = AMBULO_E_MEMORY;
    if (status || move_to(&s, e->iterate) || screen(&s) == 0) break;
  }
  if (!status && s.held && !s.failed) memcpy(x, e->held.x, bytes);
  e->adjoint_tolerance = adjoint;
  e->retraction_tolerance = retraction;
  e->run->iterations++;
  e->run->nlopt.seconds += ambulo__seconds_now() - begin - s.seconds;
  return status;
}
