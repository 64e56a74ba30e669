/* solver/free_search.c - ambulo_solve_parameters: NLopt's SLSQP over free parameters.
 *
 * NLopt sees u = (p - lower) / (upper - lower) and F / F(first). The run ends where
 *
 *     |projected dF/du| <= 1e-3 F                 F could gain a thousandth over the whole bounds
 *     two trials in a row are within 2e-5 F of the best
 *
 * or by NLopt's tests of u and F. F is known to about 1e-5: that is what inner solves from
 * different starts differ by, and where steps of SLSQP begin to turn in circles. Measured on walks
 * with one to three free parameters, SLSQP took 5 to 12 solves, MMA, CCSAQ and L-BFGS up to four
 * times as many. Values that lead to no optimal motion are HUGE_VAL, from which SLSQP's search
 * comes back toward the best. Its answer is not believed: the best trial is kept here.
 */
#include "solver/free_search.h"

#include "base/diagnostics.h"
#include "base/machine.h"
#include "base/sized.h"
#include "solver/result.h"
#include "solver/sensitivity.h"
#include "solver/session.h"

#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <string.h>

static const double small_gradient = 1e-3, small_step = 1e-4, small_change = 1e-5;
static const double near_best = 2e-5;
enum { CALLS = 4, TRIALS_NEAR = 2 };
static const int most_calls = 10000; /* of a function that has limits of its own */

/* ------------------------------------------------------------------- checking */

static ambulo_status refuse(const ambulo__outer *run, const char *name, const char *text) {
  return ambulo__error(run->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "free parameter '%s': %s", name ? name : "", text);
}

static ambulo_status check_item(ambulo__outer *run, int i) {
  const ambulo_parameter *item = &run->parameters.items[i];
  int smooth = 1;
  if (!item->name) return refuse(run, NULL, "no name");
  for (int k = 0; k < i; k++)
    if (strcmp(item->name, run->parameters.items[k].name) == 0)
      return refuse(run, item->name, "it is there twice");
  const ambulo__parameter *p = run->which[i] = ambulo__parameters_find(&run->known, item->name);
  ambulo_status status = p ? ambulo__parameter_is_smooth(&run->known, p, &smooth) : AMBULO_OK;
  if (status) return status;
  if (!p || !smooth) return refuse(run, item->name, "it has no sensitivity in this problem");
  double value = p->value, slack = 1e-12 * (item->upper - item->lower);
  if (!(item->lower < item->upper) || !isfinite(item->upper - item->lower))
    return refuse(run, item->name, "its bounds do not rise");
  if (!(value >= item->lower - slack && value <= item->upper + slack))
    return refuse(run, item->name, "the problem's value is outside of its bounds");
  run->latest.value[i] = value;
  return AMBULO_OK;
}

/* what the caller gave, of whatever age; items of an older header as *older, to be freed */
static ambulo_status take(ambulo__outer *run, const ambulo_parameters *given,
                          ambulo_parameter **older) {
  ambulo_parameters *own = &run->parameters;
  size_t full = sizeof **older;
  if (given) *own = ambulo_parameters_default();
  if (!ambulo__sized_take(own, sizeof *own, given) ||
      !ambulo__sized_item(own->parameter_size, full))
    return ambulo__error(run->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "free parameters did not come from ambulo_parameters_default()");
  run->start = own->start;
  if (own->parameter_size == full || own->count < 1 || !own->items) return AMBULO_OK;
  *older = ambulo__sized_items(&run->allocator, own->items, own->count, own->parameter_size, full,
                               "ambulo_parameter");
  own->items = *older;
  return *older ? AMBULO_OK : AMBULO_E_MEMORY;
}

static ambulo_status check_counts(const ambulo__outer *run) {
  const ambulo_parameters *p = &run->parameters;
  if (p->count < 1 || !p->items || p->maximum_solves < 1)
    return ambulo__error(run->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "%d free parameters, at most %d solves; expected at least 1 of each",
                         p->items ? p->count : 0, p->maximum_solves);
  return AMBULO_OK;
}

static ambulo_status check_per(ambulo__outer *run) {
  ambulo_parameters *p = &run->parameters;
  double travel = run->problem->definition.travel;
  if (p->per < AMBULO_PER_DEFAULT || p->per > AMBULO_PER_NONE)
    return ambulo__error(run->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "the objective of free parameters per %d; expected an ambulo_per",
                         (int)p->per);
  if (p->per == AMBULO_PER_DEFAULT) p->per = travel != 0.0 ? AMBULO_PER_DISTANCE : AMBULO_PER_NONE;
  if (p->per == AMBULO_PER_DISTANCE && travel == 0.0)
    return ambulo__error(run->diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                         "the objective per distance, but the body travels 0 m");
  return AMBULO_OK;
}

static ambulo_status check(ambulo__outer *run) {
  ambulo_status status = check_counts(run);
  if (!status) status = check_per(run);
  return status;
}

/* ----------------------------------------------------------------- trials kept */

static double width(const ambulo__outer *run, int i) {
  return run->parameters.items[i].upper - run->parameters.items[i].lower;
}

/* largest |dF/du| that a step within the bounds could follow, against F */
static int is_stationary(const ambulo__outer *run) {
  const ambulo__outer_trial *t = &run->best;
  if (ambulo__verdict_at_nodes(ambulo_result_verdict(t->result)) != AMBULO_OPTIMAL) return 0;
  double most = 0.0;
  for (int i = 0; i < run->parameters.count; i++) {
    double down = -t->gradient[i] * width(run, i);
    if (down * ambulo__outer_bound(run, t->value, i) <= 0.0) most = fmax(most, fabs(down));
  }
  return most <= small_gradient * fabs(t->objective);
}

static void keep_better(ambulo__outer *run) {
  double change = fabs(run->latest.objective - run->best.objective);
  int is_near = run->best.result && change <= near_best * fabs(run->best.objective);
  run->near = is_near ? run->near + 1 : 0;
  if (run->best.result && !(run->latest.objective < run->best.objective)) return;
  ambulo__outer_trial before = run->best;
  run->best = run->latest;
  run->latest = before;
  ambulo__outer_drop(&run->latest);
}

/* the trial at these values, which NLopt asks for twice; NULL: there is none */
static const ambulo__outer_trial *known_at(const ambulo__outer *run, const double *value) {
  size_t bytes = (size_t)run->parameters.count * sizeof *value;
  const ambulo__outer_trial *const both[] = {&run->best, &run->latest};
  for (int i = 0; i < 2; i++)
    if (!isnan(both[i]->objective) && memcmp(both[i]->value, value, bytes) == 0) return both[i];
  return NULL;
}

/* --------------------------------------------------------------- NLopt's calls */

typedef struct callback {
  ambulo__outer *run;
  nlopt_opt opt;
  double *value; /* [count] */
} callback;

static const ambulo__outer_trial *trial_at(callback *c) {
  ambulo__outer *run = c->run;
  const ambulo__outer_trial *known = known_at(run, c->value);
  if (known) return known;
  if (run->status || ambulo__outer_over(run)) return NULL;
  memcpy(run->latest.value, c->value, (size_t)run->parameters.count * sizeof *c->value);
  run->status = ambulo__outer_try(run);
  if (run->status) return NULL;
  keep_better(run);
  return known_at(run, c->value);
}

static double objective(unsigned n, const double *u, double *gradient, void *data) {
  callback *c = data;
  ambulo__outer *run = c->run;
  double scale = run->first != 0.0 ? fabs(run->first) : 1.0;
  for (unsigned i = 0; i < n; i++) {
    const ambulo_parameter *item = &run->parameters.items[i];
    double p = item->lower + u[i] * width(run, (int)i);
    c->value[i] = fmin(item->upper, fmax(item->lower, p));
  }
  const ambulo__outer_trial *t = trial_at(c);
  run->converged = is_stationary(run);
  run->settled = run->near >= TRIALS_NEAR;
  if (!t || run->converged || run->settled || ambulo__outer_over(run)) nlopt_force_stop(c->opt);
  for (unsigned i = 0; gradient && i < n; i++)
    gradient[i] = t ? t->gradient[i] * width(run, (int)i) / scale : 0.0;
  return t ? t->objective / scale : HUGE_VAL;
}

static nlopt_result minimize(callback *c, double *u) {
  ambulo__outer *run = c->run;
  double least;
  for (int i = 0; i < run->parameters.count; i++) {
    double at = (run->best.value[i] - run->parameters.items[i].lower) / width(run, i);
    u[i] = fmin(1.0, fmax(0.0, at));
  }
  return nlopt_optimize(c->opt, u, &least);
}

static nlopt_opt create_optimizer(unsigned n) {
  nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, n);
  int failed = !opt || nlopt_set_lower_bounds1(opt, 0.0) < 0 ||
               nlopt_set_upper_bounds1(opt, 1.0) < 0 || nlopt_set_xtol_abs1(opt, small_step) < 0 ||
               nlopt_set_ftol_rel(opt, small_change) < 0 || nlopt_set_maxeval(opt, most_calls) < 0;
  if (!failed) return opt;
  nlopt_destroy(opt);
  return NULL;
}

/* A call that ends away from a stationary point is followed by another, whose quadratic model is
 * fresh, while that helps. */
static ambulo_status descend(ambulo__outer *run) {
  unsigned n = (unsigned)run->parameters.count;
  double *u = ambulo__alloc(&run->allocator, 2 * (size_t)n, sizeof *u);
  nlopt_opt opt = u ? create_optimizer(n) : NULL;
  callback c = {run, opt, u + n};
  ambulo_status status = opt ? AMBULO_OK : AMBULO_E_MEMORY;
  if (opt) (void)nlopt_set_min_objective(opt, objective, &c);
  run->converged = opt && is_stationary(run);
  for (int call = 0; call < CALLS && !status && !run->converged; call++) {
    double before = run->best.objective;
    nlopt_result result = minimize(&c, u);
    status = result == NLOPT_OUT_OF_MEMORY ? AMBULO_E_MEMORY : run->status;
    if (run->ending != AMBULO_ENDING_NONE || run->converged || run->settled) break;
    run->settled = result == NLOPT_FTOL_REACHED || result == NLOPT_XTOL_REACHED;
    if (!(before - run->best.objective > small_change * fabs(before))) break;
  }
  nlopt_destroy(opt);
  ambulo__free(&run->allocator, u);
  return status;
}

/* ----------------------------------------------------------------- outcome */

enum { ENDING = 240 };

/* texts stand behind the structure, in its block */
typedef struct ambulo__outcome {
  ambulo_parameters_outcome shown;
  char ending[ENDING];
  ambulo_parameter_value item[];
} ambulo__outcome;

static const char *why(const ambulo__outer *run) {
  if (!(run->best.objective < HUGE_VAL))
    return "the first solve found no motion that holds, so that nothing was varied";
  if (run->ending != AMBULO_ENDING_NONE) return ambulo__ending_text(run->ending);
  if (run->converged) return "the gradient is small, or points out of the bounds";
  if (run->settled) return "objective and parameters settled";
  return "no better values were found";
}

static size_t texts_of(const ambulo__outer *run) {
  size_t size = 0;
  for (int i = 0; i < run->parameters.count; i++) {
    const ambulo__parameter *p = run->which[i];
    size += strlen(p->name) + strlen(p->label) + 2;
  }
  return size;
}

static const char *put(char **at, const char *text) {
  char *own = *at;
  size_t size = strlen(text) + 1;
  memcpy(own, text, size);
  *at += size;
  return own;
}

static void fill_items(const ambulo__outer *run, ambulo__outcome *outcome) {
  char *text = (char *)(outcome->item + run->parameters.count);
  int known = run->best.objective < HUGE_VAL;
  for (int i = 0; i < run->parameters.count; i++) {
    const ambulo__parameter *p = run->which[i];
    const ambulo_parameter *item = &run->parameters.items[i];
    outcome->item[i] =
        (ambulo_parameter_value){.name = put(&text, p->name),
                                 .label = put(&text, p->label),
                                 .unit = ambulo__quantity_unit(p->quantity),
                                 .value = run->best.value[i],
                                 .lower = item->lower,
                                 .upper = item->upper,
                                 .first = p->value,
                                 .derivative = known ? run->best.gradient[i] : (double)NAN};
    outcome->item[i].bound =
        (ambulo_bound)(AMBULO_BETWEEN + ambulo__outer_bound(run, run->best.value, i));
  }
}

static ambulo_status attach_outcome(ambulo__outer *run) {
  ambulo_result *result = run->best.result;
  size_t items = (size_t)run->parameters.count * sizeof(ambulo_parameter_value);
  ambulo__outcome *outcome =
      ambulo__alloc(&result->allocator, sizeof *outcome + items + texts_of(run), 1);
  if (!outcome) return AMBULO_E_MEMORY;
  int known = run->best.objective < HUGE_VAL;
  fill_items(run, outcome);
  (void)snprintf(outcome->ending, sizeof outcome->ending, "%s; %d solves, %d rejected", why(run),
                 run->solves, run->failed);
  outcome->shown = (ambulo_parameters_outcome){
      .items = outcome->item,
      .count = run->parameters.count,
      .per = run->parameters.per,
      .distance = run->best.distance,
      .objective = known ? run->best.objective : (double)NAN,
      .first = known ? run->first : (double)NAN,
      .solves = run->solves,
      .failed = run->failed,
      .evaluations = run->evaluations,
      .converged = run->converged || (run->settled && run->ending == AMBULO_ENDING_NONE),
      .seconds = ambulo__seconds_now() - run->started,
      .ending = outcome->ending};
  result->outcome = outcome;
  return AMBULO_OK;
}

const ambulo_parameters_outcome *ambulo_result_parameters(const ambulo_result *result) {
  return result->outcome ? &result->outcome->shown : NULL;
}

/* ----------------------------------------------------------------- entry point */

static ambulo_status begin(ambulo__outer *run) {
  size_t n = (size_t)run->parameters.count;
  double **const vectors[] = {&run->best.value, &run->best.gradient, &run->latest.value,
                              &run->latest.gradient};
  run->which = ambulo__alloc(&run->allocator, n, sizeof *run->which);
  ambulo_status status = run->which ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; i < 4; i++) {
    *vectors[i] = ambulo__alloc(&run->allocator, n, sizeof **vectors[i]);
    if (!*vectors[i]) status = AMBULO_E_MEMORY;
  }
  run->best.objective = run->latest.objective = NAN;
  if (!status) status = ambulo__parameters_init(run->problem, &run->allocator, &run->known);
  for (int i = 0; i < run->parameters.count && !status; i++) status = check_item(run, i);
  return status;
}

static ambulo_status search(ambulo__outer *run) {
  ambulo_status status = ambulo__outer_try(run);
  if (status) {
    ambulo__diagnostics_append(run->latest.messages, run->diagnostics);
    return status;
  }
  keep_better(run);
  run->first = run->best.objective;
  if (run->best.objective < HUGE_VAL && !ambulo__outer_over(run)) status = descend(run);
  if (!status) ambulo__diagnostics_append(run->best.messages, run->diagnostics);
  return status ? status : attach_outcome(run);
}

static void end(ambulo__outer *run) {
  double *const vectors[] = {run->best.value, run->best.gradient, run->latest.value,
                             run->latest.gradient};
  for (int i = 0; i < 4; i++) ambulo__free(&run->allocator, vectors[i]);
  ambulo__outer_drop(&run->best);
  ambulo__outer_drop(&run->latest);
  ambulo__parameters_clear(&run->known);
  ambulo__free(&run->allocator, run->which);
}

ambulo_status ambulo_solve_parameters(const ambulo_problem *problem,
                                      const ambulo_parameters *parameters,
                                      const ambulo_options *options,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics, ambulo_problem **best,
                                      ambulo_result **result) {
  if (!problem || !best || !result) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__outer run = {.allocator = ambulo__allocator_or_default(allocator),
                       .diagnostics = diagnostics,
                       .problem = problem,
                       .parameters = ambulo_problem_parameters(problem),
                       .started = ambulo__seconds_now()};
  ambulo_parameter *older = NULL;
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &run.options);
  if (!status) status = take(&run, parameters, &older);
  if (!status) status = check(&run);
  if (status) {
    ambulo__free(&run.allocator, older);
    return status;
  }
  status = begin(&run);
  if (!status) status = search(&run);
  if (!status) {
    *best = run.best.problem;
    *result = run.best.result;
    run.best.problem = NULL;
    run.best.result = NULL;
  }
  end(&run);
  ambulo__free(&run.allocator, older);
  return ambulo__conclude(diagnostics, errors, status, NULL);
}
