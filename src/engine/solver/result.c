/* solver/result.c - memory of a result and access to it. */
#include "solver/result.h"
#include "method/run.h"

#include <math.h>
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
