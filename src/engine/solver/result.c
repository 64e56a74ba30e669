/* solver/result.c - memory of a result and access to it; the verdict that its audit supports, and
 * what is reported of the run that made it. */
#include "method/multipliers.h"
#include "solver/explain.h"

#include <math.h>
#include <nlopt.h>
#include <string.h>

ambulo_status ambulo__result_create(const ambulo_problem *p, const ambulo_allocator *allocator,
                                    ambulo_result **result) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_result *r = ambulo__alloc(&own, 1, sizeof *r);
  if (!r) return AMBULO_E_MEMORY;
  r->allocator = own;
  r->variables = p->variables;
  r->rows = p->rows;
  r->terms = p->definition.term_count;
  r->families = p->table.group_count;
  r->x = ambulo__alloc(&own, (size_t)r->variables, sizeof *r->x);
  r->term = ambulo__alloc(&own, (size_t)r->terms, sizeof *r->term);
  r->row = ambulo__alloc(&own, (size_t)r->rows, sizeof *r->row);
  r->multiplier = ambulo__alloc(&own, (size_t)r->rows, sizeof *r->multiplier);
  r->family = ambulo__alloc(&own, (size_t)r->families, sizeof *r->family);
  r->history = ambulo__history_create(&own);
  if (!r->x || !r->term || !r->row || !r->multiplier || !r->family || !r->history) {
    ambulo_result_free(r);
    return AMBULO_E_MEMORY;
  }
  ambulo_violation unknown = {.family = "", .subject = "", .detail = "", .unit = "", .size = 1.0};
  unknown.worst = NAN;
  r->audit.violation = r->audit.dense_violation = unknown;
  r->audit.kkt = HUGE_VAL;
  *result = r;
  return AMBULO_OK;
}

void ambulo_result_free(ambulo_result *r) {
  if (!r) return;
  ambulo_allocator a = r->allocator;
  ambulo__free(&a, r->x);
  ambulo__free(&a, r->term);
  ambulo__free(&a, r->row);
  ambulo__free(&a, r->multiplier);
  ambulo__free(&a, r->family);
  ambulo__free(&a, r->explanation);
  ambulo__free(&a, r->dense);
  ambulo__free(&a, r->outcome);
  ambulo__free(&a, r->valleys);
  ambulo__free(&a, r->refinement);
  ambulo__free(&a, r->history);
  ambulo__free(&a, r);
}

ambulo_verdict ambulo_result_verdict(const ambulo_result *r) {
  return r->verdict;
}
const double *ambulo_result_x(const ambulo_result *r) {
  return r->x;
}
double ambulo_result_objective(const ambulo_result *r) {
  return r->objective;
}
const double *ambulo_result_terms(const ambulo_result *r) {
  return r->term;
}
const double *ambulo_result_rows(const ambulo_result *r) {
  return r->row;
}
const double *ambulo_result_multipliers(const ambulo_result *r) {
  return r->multiplier;
}

ambulo_status ambulo_multipliers_of(const ambulo_problem *problem, const ambulo_result *result,
                                    const ambulo_allocator *allocator,
                                    ambulo_multipliers **multipliers) {
  if (!problem || !result || !multipliers) return AMBULO_E_ARGUMENT;
  return ambulo__multipliers_create(problem, result->multiplier, result->objective, allocator,
                                    multipliers);
}

const ambulo_audit *ambulo_result_audit(const ambulo_result *r) {
  return &r->audit;
}
int ambulo_result_family_count(const ambulo_result *r) {
  return r->families;
}

const ambulo_violation *ambulo_result_family(const ambulo_result *r, int index) {
  if (index < 0 || index >= r->families) return NULL;
  return &r->family[index];
}

int ambulo_result_iterations(const ambulo_result *r) {
  return r->iterations;
}
int ambulo_result_evaluations(const ambulo_result *r) {
  return r->evaluations;
}
const ambulo_nlopt_work *ambulo_result_nlopt(const ambulo_result *r) {
  return &r->nlopt;
}

const ambulo_history *ambulo_result_history(const ambulo_result *r) {
  return r ? &r->history->shown : NULL;
}

const ambulo_timing *ambulo_result_timing(const ambulo_result *r) {
  return &r->timing;
}
const char *ambulo_result_ending(const ambulo_result *r) {
  return r->ending;
}
ambulo_ending ambulo_result_ending_code(const ambulo_result *r) {
  return r->ending_code;
}

const ambulo_explanation *ambulo_result_explanation(const ambulo_result *r) {
  return r->explanation ? &r->explanation->view : NULL;
}

/* ----------------------------------------------------------------------- names */

/* times its tolerance: a row further off between the nodes makes the motion one of its nodes only.
 * No optimality at the nodes excuses it, nor does an objective at its lower bound. */
static const double most_ratio = 10.0;

typedef struct wording {
  const char *name, *text;
} wording;

#define WORDING(id, name, text) {name, text},
static const wording verdicts[] = {AMBULO_VERDICT_LIST(WORDING)};
static const wording endings[] = {AMBULO_ENDING_LIST(WORDING)};
#undef WORDING

static wording wording_of_verdict(ambulo_verdict verdict) {
  if (verdict < AMBULO_NOT_JUDGED || verdict > AMBULO_FEASIBLE_AT_NODES)
    return (wording){"unknown", "unknown verdict"};
  return verdicts[verdict];
}

static wording wording_of_ending(ambulo_ending ending) {
  if (ending < AMBULO_ENDING_NONE || ending > AMBULO_ENDING_SOLVES)
    return (wording){"unknown", "unknown ending"};
  return endings[ending];
}

const char *ambulo_verdict_name(ambulo_verdict verdict) {
  return wording_of_verdict(verdict).name;
}
const char *ambulo_verdict_text(ambulo_verdict verdict) {
  return wording_of_verdict(verdict).text;
}
const char *ambulo__ending_name(ambulo_ending ending) {
  return wording_of_ending(ending).name;
}
const char *ambulo__ending_text(ambulo_ending ending) {
  return wording_of_ending(ending).text;
}

/* --------------------------------------------------------------------- verdict */

int ambulo_verdict_is_solution(ambulo_verdict verdict) {
  return verdict == AMBULO_OPTIMAL || verdict == AMBULO_FEASIBLE;
}

ambulo_verdict ambulo__verdict_at_nodes(ambulo_verdict verdict) {
  if (verdict == AMBULO_OPTIMAL_AT_NODES) return AMBULO_OPTIMAL;
  return verdict == AMBULO_FEASIBLE_AT_NODES ? AMBULO_FEASIBLE : verdict;
}

ambulo_verdict ambulo__verdict_between_nodes(ambulo_verdict verdict, double ratio) {
  if (ratio <= most_ratio) return verdict;
  if (verdict == AMBULO_OPTIMAL) return AMBULO_OPTIMAL_AT_NODES;
  return verdict == AMBULO_FEASIBLE ? AMBULO_FEASIBLE_AT_NODES : verdict;
}

double ambulo__relative(const ambulo_violation *v) {
  return v->worst / v->size;
}

int ambulo__is_limit(ambulo_ending ending) {
  return ending == AMBULO_ENDING_ITERATIONS || ending == AMBULO_ENDING_EVALUATIONS ||
         ending == AMBULO_ENDING_TIME;
}

int ambulo__ended_by_cap(const ambulo__run *run) {
  if (run->ending == AMBULO_ENDING_ITERATIONS)
    return run->options->maximum_iterations < ambulo_options_default().maximum_iterations;
  return ambulo__is_limit(run->ending);
}

/* (A.4) what violation and KKT residual allow to say */
ambulo_verdict ambulo__verdict_of(const ambulo_audit *audit, const ambulo_options *options,
                                  ambulo_ending ending) {
  if (audit->fault.kind != AMBULO_FAULT_NONE || !isfinite(audit->violation.worst))
    return AMBULO_NUMERIC_FAILURE;
  int feasible = ambulo__relative(&audit->violation) <= options->feasibility_tolerance;
  int stationary = audit->kkt <= options->optimality_tolerance;
  if (feasible && (stationary || audit->at_lower_bound)) return AMBULO_OPTIMAL;
  if (ending == AMBULO_ENDING_NOT_FINITE) return AMBULO_NUMERIC_FAILURE;
  if (ending == AMBULO_ENDING_CALLER) return AMBULO_INTERRUPTED;
  if (feasible) return AMBULO_FEASIBLE;
  if (ending == AMBULO_ENDING_BREAKDOWN) return AMBULO_NUMERIC_FAILURE; /* shows no conflict */
  return ambulo__is_limit(ending) ? AMBULO_LIMIT_REACHED : AMBULO_INFEASIBLE;
}

/* KKT residual that is far from an optimum, whatever tolerance is asked for */
static const double far_from_optimal = 1e-3;
/* objective of a motion at rest, whose gradient is rounding and leads anywhere */
static const double at_rest = 1e-15;

/* 2: the rows hold; 1: at the nodes; 0: they do not */
static int rank_of(ambulo_verdict verdict) {
  if (ambulo_verdict_is_solution(verdict)) return 2;
  return ambulo_verdict_is_solution(ambulo__verdict_at_nodes(verdict));
}

int ambulo__result_is_better(const ambulo_result *one, const ambulo_result *other) {
  int rank = rank_of(one->verdict), of_other = rank_of(other->verdict);
  if (rank != of_other) return rank > of_other;
  if (rank > 0) return one->objective < other->objective;
  return ambulo__relative(&one->audit.violation) < ambulo__relative(&other->audit.violation);
}

int ambulo__result_leaves_doubts(const ambulo_options *o, const ambulo_result *r) {
  if (o->algorithm == AMBULO_SLSQP || ambulo__is_limit(r->ending_code)) return 0;
  if (r->verdict == AMBULO_FEASIBLE)
    return r->audit.kkt > far_from_optimal && fabs(r->objective) > at_rest;
  return r->verdict == AMBULO_NOT_CONVERGED;
}

/* --------------------------------------------------------------------- reports */

void ambulo__report_families(const ambulo_result *r, double tolerance, ambulo_diagnostics *list) {
  if (r->verdict != AMBULO_INFEASIBLE && r->verdict != AMBULO_NOT_CONVERGED) return;
  for (int f = 0; f < r->families; f++) {
    const ambulo_violation *v = &r->family[f];
    if (!(ambulo__relative(v) > tolerance)) continue;
    ambulo__warning(list, ambulo__nowhere, NULL,
                    "no point was found that satisfies %s: %s (%s) at t = %.6g s is off by %.3g %s",
                    v->family, v->subject, v->detail, v->time, v->worst, v->unit);
  }
}

void ambulo__ending_of_faults(ambulo__run *run) {
  int gave_up = run->ending == AMBULO_ENDING_STALLED || run->ending == AMBULO_ENDING_NO_DESCENT ||
                run->ending == AMBULO_ENDING_NOT_RESTORED ||
                run->ending == AMBULO_ENDING_BREAKDOWN || run->ending == AMBULO_ENDING_NLOPT;
  if (gave_up && run->faults_lately) {
    run->ending = AMBULO_ENDING_NOT_FINITE;
  } else if (run->ending == AMBULO_ENDING_NOT_RESTORED && run->breakdowns) {
    run->ending = AMBULO_ENDING_BREAKDOWN;
  }
}

void ambulo__report_faults(const ambulo__run *run, ambulo_result *r, ambulo_diagnostics *list) {
  char text[AMBULO__FAULT_TEXT];
  if (run->own_gradients) {
    int major, minor, patch;
    nlopt_version(&major, &minor, &patch);
    ambulo__note(
        list, ambulo__nowhere,
        "NLopt %d.%d.%d does not form the multipliers that NLopt 2.7.1 forms; each row was "
        "given its own gradient, which takes longer",
        major, minor, patch);
  }
  if (r->verdict == AMBULO_NUMERIC_FAILURE && r->audit.fault.kind == AMBULO_FAULT_NONE)
    r->audit.fault = run->fault;
  if (r->audit.fault.kind != AMBULO_FAULT_NONE) {
    ambulo_fault_text(&r->audit.fault, text, sizeof text);
    ambulo__warning(list, ambulo__nowhere, NULL, "%s", text);
  } else if (run->faults > 0) {
    ambulo_fault_text(&run->first_fault, text, sizeof text);
    ambulo__note(list, ambulo__nowhere, "%d of %d points were rejected; at the first %s",
                 run->faults, run->evaluations, text);
  }
}

void ambulo__settle_verdict(const ambulo__run *run, ambulo_result *r) {
  const ambulo_explanation *e = ambulo_result_explanation(r);
  if (!e) return;
  if (r->verdict == AMBULO_INFEASIBLE && !e->confirmed) r->verdict = AMBULO_NOT_CONVERGED;
  if (r->verdict == AMBULO_LIMIT_REACHED && e->confirmed && !ambulo__ended_by_cap(run))
    r->verdict = AMBULO_INFEASIBLE;
}
