/* method/auglag.c - see pipeline.h.
 *
 * The problem on the equalities' surface, minimize f(x) subject to v_i(x) <= 0, is NLopt's: AUGLAG
 * (Birgin & Martinez 2008) around its L-BFGS is given
 *
 *     S f(w) + constant,   c_i(w) = S v_i(w) + sigma_i <= 0,   each row a constraint
 *
 * and holds multipliers nu, penalty rho and the outer loop. In NLopt's inner problem
 *
 *     S f + rho/2 sum max(0, c + nu/rho)^2 = S F + constant,
 *     F = f + 1/(2 R) sum ( max(0, lambda + R v)^2 - lambda^2 ),
 *     lambda = nu + rho sigma,   R = rho S
 *
 * F is augmented.c's. What is ours:
 *
 *   variables  w is a chart of the surface (augmented.h), laid again after each inner solve around
 * the point where it ended: the metric there, whose rows with a force are those that the model step
 * foresees. NLopt's point does not move by that, and its L-BFGS starts afresh at every inner solve.
 *   gradients  where NLopt asks for gradients one row stands for all that have a force, or each has
 *              its own where NLopt's nu and rho are not the mirror's (mirror.h): then the call is
 *              begun anew. Between two inner solves each row has its own value: from these NLopt
 *              updates nu and rho.
 *   scale S    NLopt multiplies rho by 10 where a row does not give way; 2, up to a bound, is what
 *              walks stand (docs/solver.md: left alone it stops some of them too high). S is
 *              lowered in the same moment, for objective and rows alike: lambda stays, and R
 *              grows by 2.
 *   sigma      where a call has to be repeated, it starts with the lambda of the last one.
 *   ending     pipeline.h, by nlopt_force_stop.
 *
 *   R lower    near a solution, inner solves that bring less than half of what the model promised
 *              show a penalty too stiff for L-BFGS (trust.h). S is lowered with R; lambda stays.
 *
 * NLopt evaluates without a gradient when it starts, and when an inner solve has ended: this is how
 * the phases are distinguished. It starts with rho = 1e-6 where the constant makes its f zero and
 * some row is violated, with 10 where none is and f > 0: S makes R of it.
 */
#include "method/pipeline.h"
#include "method/augmented.h"
#include "method/mirror.h"
#include "method/model_step.h"
#include "method/parameters.h"
#include "method/trust.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

/* rows that NLopt is given as one vector: it keeps n doubles for each of them */
enum { BLOCK = 8 };

typedef struct drive drive; /* one call of ambulo__auglag */

typedef struct block {
  drive *drive;
  int first, count;
} block;

struct drive {
  ambulo__engine *engine;
  ambulo__stopping *stopping;
  ambulo__mirror mirror;
  ambulo__chart chart;
  nlopt_opt outer;
  block *blocks;
  int block_count;
  double *row, *shift; /* c, sigma: [inequalities] */
  double *x;           /* where the last inner solve ended; the caller's */
  double *w;           /* [n]: NLopt's point, in and out */
  double *gradient;    /* [n]: where NLopt asks for none */
  double *first;       /* [n]: at the first trial of an inner solve, what NLopt is to make of it */
  double *pooled;      /* [n]: of all rows, given to row `of_all` */
  int of_all;          /* -1: the objective */
  double *one;         /* [inequalities]: weight of a single row, else zero */
  double *l;           /* [equalities]: its multipliers */
  int *violated;       /* [inequalities]: at an update, so that it may have a multiplier */
  int flat;            /* the gradient counts as zero */
  int dirty;           /* slot of NLopt's one buffer for all blocks that is not zero; -1: none */
  double scale, constant;
  ambulo__trust trust;
  int trials;       /* with gradient, since the chart was laid */
  int started, lay; /* NLopt knows rho; the chart is to be laid at NLopt's next point */
  int anew;         /* the call is to be repeated with own gradients */
  int starved;      /* no memory for the next inner solve */
  ambulo_ending ending;
  double seconds; /* spent in callbacks */
};

/* ------------------------------------------------------------------ the chart */

static ambulo_ending lay_chart(drive *s, const double *w) {
  ambulo__engine *e = s->engine;
  memcpy(e->iterate.x, s->x, (size_t)e->setup->n * sizeof *w);
  int failed = ambulo__model_step(e, &s->trust.predicted);
  if (failed) return failed == 2 ? AMBULO_ENDING_NOT_FINITE : AMBULO_ENDING_BREAKDOWN;
  s->trials = 0;
  s->lay = 0;
  if (!ambulo__chart_lay(&s->chart, e, w, sqrt(s->scale))) return AMBULO_ENDING_NOT_FINITE;
  s->trust.start = s->trust.tried = s->chart.start;
  return AMBULO_ENDING_NONE;
}

/* -------------------------------------------------------- after an inner solve */

/* the engine's lambda and R are NLopt's */
static void take_multipliers(drive *s) {
  ambulo__iterate *iterate = &s->engine->iterate;
  iterate->rho = s->scale * s->mirror.penalty;
  for (int i = 0; i < s->mirror.rows; i++)
    iterate->lambda[i] = s->mirror.multiplier[i] + s->mirror.penalty * s->shift[i];
}

/* (P.12): NLopt's update, and what becomes of R by it */
static void update_multipliers(drive *s) {
  ambulo__engine *e = s->engine;
  for (int i = 0; i < s->mirror.rows; i++) s->violated[i] |= s->row[i] > 0.0;
  int raised = ambulo__mirror_update(&s->mirror, s->row);
  if (raised) s->scale /= AMBULO__NLOPT_GROWTH;
  s->scale *= ambulo__trust_penalty(&s->trust, raised, e->iterate.rho, &s->stopping->penalty_limit);
  memset(s->shift, 0, (size_t)e->setup->inequalities * sizeof *s->shift);
  take_multipliers(s);
}

/* an inner solve has ended at the last point, where F is `value` */
static void inner_ended(drive *s, double value) {
  ambulo__engine *e = s->engine;
  const ambulo__trial *last = &e->last->trial;
  ambulo__run *run = e->run;
  ambulo__trial_copy(last, &e->reached);
  memcpy(s->x, last->x, (size_t)e->setup->n * sizeof *s->x);
  e->iterate.mu = ambulo__trust_damping(&s->trust, e->iterate.mu, value, last);
  update_multipliers(s);
  ambulo__run_forgive(run);
  run->iterations++;
  run->nlopt.outer++;
  double gradient = last->gradient_norm / fmax(1.0, fabs(last->objective));
  (void)ambulo__run_iteration(run,
                              e->setup->problem->definition.intervals, /* a stop is the run's */
                              last->objective / e->setup->objective_scale, last->violation,
                              last->gradient_norm < 0.0 ? NAN : gradient);
  s->ending = ambulo__stopping_test(s->stopping, e, s->x);
  if (!s->ending && s->stopping->points >= run->options->maximum_iterations)
    s->ending = AMBULO_ENDING_ITERATIONS;
  s->lay = 1;
}

/* ---------------------------------------------------------------- what NLopt asks */

static int is_over(const drive *s) {
  return s->ending != AMBULO_ENDING_NONE || s->anew || s->engine->run->stopped;
}

/* ends NLopt's line search and then NLopt */
static double give_up(drive *s, unsigned n, double *gradient) {
  nlopt_force_stop(s->outer);
  if (gradient) memset(gradient, 0, n * sizeof *gradient);
  return -HUGE_VAL;
}

/* what the rows are at the last point; where there is none, far from any bound: then F, which has
 * the objective's place, is high enough */
static void take_rows(drive *s) {
  const ambulo__trial *last = &s->engine->last->trial;
  int none = !(last->value < HUGE_VAL);
  for (int i = 0; i < s->mirror.rows; i++)
    s->row[i] = none ? -HUGE_VAL : s->scale * last->excess[i] + s->shift[i];
}

static double value_of(const drive *s, double merit) {
  const ambulo__trial *last = &s->engine->last->trial;
  return s->scale * (last->value < HUGE_VAL ? last->objective : merit) + s->constant;
}

/* a trial of L-BFGS */
static double trial(drive *s, unsigned n, const double *w, double *gradient) {
  ambulo__engine *e = s->engine;
  const ambulo__trial *last = &e->last->trial;
  if (s->lay && !is_over(s)) s->ending = lay_chart(s, w);
  if (is_over(s)) return give_up(s, n, gradient);
  double merit = ambulo__chart_value(&s->chart, e, w, gradient);
  e->run->nlopt.inner++;
  if (e->run->stopped) return give_up(s, n, gradient);
  for (unsigned j = 0; j < n; j++) gradient[j] *= s->scale;
  double least = AMBULO__GRADIENT_NONE * e->run->options->optimality_tolerance *
                 fmax(1.0, fabs(last->objective));
  s->flat = last->value < HUGE_VAL && last->gradient_norm <= least;
  if (s->flat) memset(gradient, 0, n * sizeof *gradient);
  if (++s->trials == 1) memcpy(s->first, gradient, n * sizeof *gradient);
  if (s->trials == 2) {
    s->trust.tried = fmin(merit, s->chart.start);
    s->anew = !e->run->own_gradients && !ambulo__mirror_agrees(n, s->chart.origin, w, s->first);
    e->run->own_gradients |= s->anew;
    if (s->anew) return give_up(s, n, gradient);
  }
  take_rows(s);
  if (e->run->own_gradients) {
    double scale = s->scale * e->setup->objective_scale;
    if (last->value < HUGE_VAL && !s->flat)
      ambulo__chart_gradient(&s->chart, e, scale, NULL, s->l, gradient);
  } else {
    s->of_all = ambulo__mirror_pool(&s->mirror, s->row, n, gradient, s->pooled);
    if (s->of_all >= 0) memset(gradient, 0, n * sizeof *gradient);
  }
  return value_of(s, merit);
}

/* NLopt starts, or an inner solve has ended */
static double between(drive *s, unsigned n, const double *w) {
  ambulo__engine *e = s->engine;
  if (is_over(s)) return give_up(s, n, NULL);
  double merit = ambulo__chart_value(&s->chart, e, w, s->gradient);
  if (e->run->stopped) return give_up(s, n, NULL);
  if (!(e->last->trial.value < HUGE_VAL)) {
    s->ending = AMBULO_ENDING_NO_DESCENT;
    return give_up(s, n, NULL);
  }
  take_rows(s);
  double value = value_of(s, merit);
  if (!s->started) {
    ambulo__mirror_start(&s->mirror, value, s->row);
    take_multipliers(s);
    s->started = 1;
  } else {
    inner_ended(s, merit);
  }
  s->starved = !is_over(s) && !ambulo__nlopt_can_descend(n, AMBULO__INNER_EVALUATIONS);
  return s->starved ? give_up(s, n, NULL) : value;
}

static double objective(unsigned n, const double *w, double *gradient, void *data) {
  drive *s = data;
  double begin = ambulo__seconds_now();
  double value = gradient ? trial(s, n, w, gradient) : between(s, n, w);
  s->seconds += ambulo__seconds_now() - begin;
  return value;
}

/* gradients of rows, each its own: of those that have a force, or may have one */
static void own_gradients(drive *s, const block *b, unsigned n, double *gradient) {
  memset(gradient, 0, (size_t)b->count * n * sizeof *gradient);
  if (!(s->engine->last->trial.value < HUGE_VAL) || s->flat) return;
  for (int k = 0; k < b->count; k++) {
    int i = b->first + k;
    if (!(s->row[i] > 0.0) && !s->violated[i]) continue;
    s->one[i] = s->scale;
    memset(s->l, 0, (size_t)s->engine->setup->equalities * sizeof *s->l);
    ambulo__chart_gradient(&s->chart, s->engine, 0.0, s->one, s->l, gradient + (size_t)k * n);
    s->one[i] = 0.0;
  }
}

/* NLopt asks for the rows right after the objective, at the same point */
static void rows(unsigned m, double *result, unsigned n, const double *w, double *gradient,
                 void *data) {
  const block *b = data;
  drive *s = b->drive;
  int slot = s->of_all - b->first;
  (void)w;
  memcpy(result, s->row + b->first, m * sizeof *result);
  if (!gradient) return;
  if (s->engine->run->own_gradients) {
    own_gradients(s, b, n, gradient);
    return;
  }
  if (s->dirty >= 0 && s->dirty < (int)m) { /* of another block; NLopt clears it once, at first */
    memset(gradient + (size_t)s->dirty * n, 0, n * sizeof *gradient);
    s->dirty = -1;
  }
  if (s->of_all < 0 || slot < 0 || slot >= (int)m) return;
  memcpy(gradient + (size_t)slot * n, s->pooled, n * sizeof *gradient);
  s->dirty = slot;
}

/* -------------------------------------------------------------------- one call */

static int set_up(drive *s, nlopt_opt outer, nlopt_opt local) {
  static const double tolerance[BLOCK] = {0.0}; /* pipeline.h has its own */
  unsigned n = (unsigned)s->engine->setup->n;
  int failed = nlopt_set_maxeval(local, AMBULO__INNER_EVALUATIONS) < 0 ||
               nlopt_set_ftol_rel(local, AMBULO__INNER_VALUE) < 0 ||
               nlopt_set_vector_storage(local, AMBULO__INNER_EVALUATIONS) < 0 ||
               !ambulo__nlopt_can_copy(n) || nlopt_set_local_optimizer(outer, local) < 0 ||
               nlopt_set_min_objective(outer, objective, s) < 0;
  for (int i = 0; i < s->block_count && !failed; i++)
    failed = nlopt_add_inequality_mconstraint(outer, (unsigned)s->blocks[i].count, rows,
                                              &s->blocks[i], tolerance) < 0;
  return failed || !ambulo__nlopt_can_descend(n, AMBULO__INNER_EVALUATIONS);
}

/* NLopt from w = 0; its result */
static int call(drive *s) {
  ambulo__engine *e = s->engine;
  unsigned n = (unsigned)e->setup->n;
  double least, begin = ambulo__seconds_now(), inside = s->seconds;
  nlopt_opt local = nlopt_create(NLOPT_LD_LBFGS, n), outer = nlopt_create(NLOPT_AUGLAG, n);
  int result = NLOPT_OUT_OF_MEMORY;
  if (local && outer && !set_up(s, outer, local)) {
    s->outer = outer;
    result = nlopt_optimize(outer, s->w, &least);
  }
  nlopt_destroy(outer);
  nlopt_destroy(local);
  ambulo__run_nlopt(e->run, result, ambulo__seconds_now() - begin - (s->seconds - inside));
  return result;
}

/* S, sigma and the constant for which NLopt starts with the engine's lambda and R; the chart */
static ambulo_ending prepare(drive *s) {
  ambulo__engine *e = s->engine;
  const ambulo__trial *last = &e->last->trial;
  const ambulo__iterate *iterate = &e->iterate;
  const int inequalities = e->setup->inequalities;
  double penalty = AMBULO__NLOPT_LEAST_PENALTY, violated = 0.0;
  memset(s->w, 0, (size_t)e->setup->n * sizeof *s->w);
  s->started = inequalities == 0; /* NLopt does not ask then */
  s->of_all = s->dirty = -1;
  s->anew = 0;
  s->scale = iterate->rho / penalty;
  ambulo_ending failed = lay_chart(s, s->w);
  if (failed) return failed;
  for (int i = 0; i < inequalities; i++) {
    double c = s->scale * last->excess[i] + iterate->lambda[i] / penalty;
    if (c > 0.0) violated = c;
  }
  s->constant = -s->scale * last->objective;
  if (violated == 0.0) {
    penalty = inequalities > 0 ? AMBULO__NLOPT_FIRST_PENALTY : 1.0; /* as mirror.c */
    s->scale = iterate->rho / penalty;
    s->chart.stretch = sqrt(s->scale);
    s->constant = 1.0 - s->scale * last->objective;
  }
  for (int i = 0; i < inequalities; i++) s->shift[i] = iterate->lambda[i] / penalty;
  if (inequalities == 0) ambulo__mirror_start(&s->mirror, 0.0, s->row);
  return AMBULO_ENDING_NONE;
}

static ambulo_status create(drive *s, ambulo__pool *pool) {
  ambulo__engine *e = s->engine;
  const int inequalities = e->setup->inequalities;
  size_t n = (size_t)e->setup->n, m = (size_t)inequalities;
  s->block_count = (inequalities + BLOCK - 1) / BLOCK;
  s->blocks = ambulo__pool_blocks(pool, (size_t)s->block_count, sizeof *s->blocks);
  s->row = ambulo__pool_doubles(pool, m);
  s->shift = ambulo__pool_doubles(pool, m);
  s->w = ambulo__pool_doubles(pool, n);
  s->gradient = ambulo__pool_doubles(pool, n);
  s->first = ambulo__pool_doubles(pool, n);
  s->pooled = ambulo__pool_doubles(pool, n);
  s->one = ambulo__pool_doubles(pool, m);
  s->l = ambulo__pool_doubles(pool, (size_t)e->setup->equalities);
  s->violated = ambulo__pool_ints(pool, m);
  ambulo_status status = ambulo__chart_create(e->setup->n, pool, &s->chart);
  if (!status) status = ambulo__mirror_create(inequalities, pool, &s->mirror);
  if (status || pool->failed) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->block_count; i++) {
    int left = inequalities - i * BLOCK;
    s->blocks[i] = (block){s, i * BLOCK, left < BLOCK ? left : BLOCK};
  }
  return AMBULO_OK;
}

/* Calls until something ends it. One more follows a call that NLopt ended by a test of its own,
 * since all rows hold without a multiplier; or whose line search found nothing after at least one
 * inner solve, for which the chart is laid again. */
static ambulo_status run(drive *s) {
  ambulo__run *r = s->engine->run;
  while (!s->ending && !ambulo__run_over(r)) {
    int before = r->nlopt.outer;
    s->ending = prepare(s);
    if (s->ending) break;
    int result = call(s);
    if (result == NLOPT_OUT_OF_MEMORY || s->starved) return AMBULO_E_MEMORY;
    if (is_over(s) || (result >= 0 && s->mirror.measure == 0.0)) continue;
    /* by a test of its own only if the mirror agrees; else the mirror is wrong */
    if (result >= 0 || r->nlopt.outer == before) s->ending = AMBULO_ENDING_NLOPT;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__auglag(ambulo__engine *e, ambulo__stopping *stopping, double *x,
                             ambulo_ending *ending) {
  drive s = {.engine = e, .stopping = stopping, .x = x, .trust = {.damping = e->iterate.mu}};
  ambulo__pool pool;
  ambulo__pool_init(&pool, &e->pool.allocator);
  ambulo_status status = create(&s, &pool);
  if (!status) status = run(&s);
  ambulo__pool_clear(&pool);
  *ending = s.ending;
  return status;
}
