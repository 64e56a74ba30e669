/* solver/inner.c - NLopt as the minimizer of the augmented Lagrangian.
 *
 * Two ways to the same iterates (measured: bench/bench_solve.c):
 *
 * LBFGS   F(w) of augmented.c is handed to NLopt's L-BFGS directly.
 *
 * AUGLAG  NLopt's own augmented Lagrangian around its L-BFGS. The inequality rows enter as
 *   one constraint, the distance of the shifted rows from the allowed side
 *
 *       c(w) = s |max(0, v + lambda / rho)|_2 <= 0,     s = sqrt(rho / 10)
 *
 *   with objective F - rho |max(0, v + lambda/rho)|^2 / 2. AUGLAG adds rho_N c^2 / 2 with
 *   rho_N = min(10, 2 |f| / c^2); a constant added to the objective makes it 10, so that
 *   its first inner problem is F: the multipliers of the last refresh are kept in the shift.
 *   AUGLAG only uses the gradient of the sum, and one adjoint solve yields that: it is
 *   delivered with the objective, the constraint's is zero. One inner problem a call; AUGLAG
 *   announces its end by evaluating without gradient for the second time.
 *
 * NLopt's verdicts are not used: the best point is kept by augmented.c.
 */
#include "solver/engine.h"
#include "solver/nlopt_memory.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

enum { STORED_VECTORS = 20 };
static const double value_tolerance = 1e-7;
static const double auglag_penalty = 10.0;

typedef struct inner {
  ambulo__engine *engine;
  nlopt_opt outer;
  int auglag, bare_calls;
  double offset;
  double seconds; /* spent in callbacks */
} inner;

/* rho |max(0, v + lambda/rho)|^2 / 2 at the point held */
static double penalty_of(const ambulo__engine *e) {
  double sum = 0.0;
  for (int i = 0; i < e->inequalities; i++) sum += e->held.multiplier[i] * e->held.multiplier[i];
  return sum / (2.0 * e->rho);
}

static double objective(unsigned n, const double *w, double *gradient, void *data) {
  inner *s = data;
  (void)n;
  double begin = ambulo__seconds_now();
  double value = ambulo__augmented(s->engine, w, gradient);
  int failed = !(s->engine->held.value < HUGE_VAL);
  if (s->auglag) value += failed ? s->offset : s->offset - penalty_of(s->engine);
  if (!gradient && s->auglag && ++s->bare_calls == 2) nlopt_force_stop(s->outer);
  if (s->engine->run->stopped) nlopt_force_stop(s->outer);
  s->seconds += ambulo__seconds_now() - begin;
  return value;
}

static double constraint(unsigned n, const double *w, double *gradient, void *data) {
  inner *s = data;
  double begin = ambulo__seconds_now();
  if (gradient) memset(gradient, 0, n * sizeof *gradient);
  (void)ambulo__augmented(s->engine, w, NULL);
  int failed = !(s->engine->held.value < HUGE_VAL);
  double value = failed ? -1.0 : sqrt(2.0 * penalty_of(s->engine) / auglag_penalty);
  s->seconds += ambulo__seconds_now() - begin;
  return value;
}

static nlopt_opt create_lbfgs(unsigned n, int evaluations) {
  nlopt_opt opt = nlopt_create(NLOPT_LD_LBFGS, n);
  if (!opt) return NULL;
  int failed = nlopt_set_maxeval(opt, evaluations) < 0 ||
               nlopt_set_ftol_rel(opt, value_tolerance) < 0 || nlopt_set_xtol_rel(opt, 1e-14) < 0 ||
               nlopt_set_vector_storage(opt, STORED_VECTORS) < 0;
  if (!failed) return opt;
  nlopt_destroy(opt);
  return NULL;
}

/* AUGLAG around `local`, which stays the caller's; NULL on failure */
static nlopt_opt create_auglag(unsigned n, nlopt_opt local, inner *s, int evaluations) {
  nlopt_opt opt = nlopt_create(NLOPT_AUGLAG, n);
  if (!opt) return NULL;
  int failed = !ambulo__nlopt_can_copy(n) || nlopt_set_local_optimizer(opt, local) < 0 ||
               nlopt_add_inequality_constraint(opt, constraint, s, 0.0) < 0 ||
               nlopt_set_maxeval(opt, 4 * evaluations + 16) < 0 ||
               nlopt_set_ftol_rel(opt, value_tolerance) < 0 || nlopt_set_xtol_rel(opt, 1e-14) < 0;
  if (!failed) return opt;
  nlopt_destroy(opt);
  return NULL;
}

ambulo_status ambulo__inner_minimize(ambulo__engine *e, ambulo__inner_kind kind, double *w,
                                     int evaluations) {
  inner s = {.engine = e, .auglag = kind == AMBULO__INNER_AUGLAG && e->inequalities > 0};
  unsigned n = (unsigned)e->n;
  double begin = ambulo__seconds_now(), least;
  nlopt_opt local = create_lbfgs(n, evaluations), outer = local;
  if (local && s.auglag) outer = create_auglag(n, local, &s, evaluations);
  int result = NLOPT_OUT_OF_MEMORY;
  if (local && outer) {
    s.outer = outer;
    double value = ambulo__augmented(e, w, NULL), penalty = penalty_of(e);
    if (s.auglag) s.offset = fmax(0.0, 1.0 + 2.0 * penalty - value);
    if (nlopt_set_min_objective(outer, objective, &s) >= 0)
      result = nlopt_optimize(outer, w, &least);
  }
  if (outer != local) nlopt_destroy(outer);
  nlopt_destroy(local);
  e->run->seconds_nlopt += ambulo__seconds_now() - begin - s.seconds;
  return result == NLOPT_OUT_OF_MEMORY ? AMBULO_E_MEMORY : AMBULO_OK;
}
