/* solver/verdict.c - names of the verdicts, and the verdict that an audit supports. */
#include "solver/verdict.h"

#include <math.h>

const char *ambulo_verdict_name(ambulo_verdict verdict) {
  static const char *const names[] = {
#define NAME(id, name, text) name,
      AMBULO_VERDICT_LIST(NAME)
#undef NAME
  };
  if (verdict < AMBULO_NOT_JUDGED || verdict > AMBULO_INTERRUPTED) return "unknown";
  return names[verdict];
}

const char *ambulo_verdict_text(ambulo_verdict verdict) {
  static const char *const texts[] = {
#define TEXT(id, name, text) text,
      AMBULO_VERDICT_LIST(TEXT)
#undef TEXT
  };
  if (verdict < AMBULO_NOT_JUDGED || verdict > AMBULO_INTERRUPTED) return "unknown verdict";
  return texts[verdict];
}

int ambulo_verdict_is_solution(ambulo_verdict verdict) {
  return verdict == AMBULO_OPTIMAL || verdict == AMBULO_FEASIBLE;
}

const char *ambulo__ending_name(ambulo_ending ending) {
  static const char *const names[] = {
#define NAME(id, name, text) name,
      AMBULO_ENDING_LIST(NAME)
#undef NAME
  };
  if (ending < AMBULO_ENDING_NONE || ending > AMBULO_ENDING_SOLVES) return "unknown";
  return names[ending];
}

const char *ambulo__ending_text(ambulo_ending ending) {
  static const char *const texts[] = {
#define TEXT(id, name, text) text,
      AMBULO_ENDING_LIST(TEXT)
#undef TEXT
  };
  if (ending < AMBULO_ENDING_NONE || ending > AMBULO_ENDING_SOLVES) return "unknown ending";
  return texts[ending];
}

double ambulo__relative(const ambulo_violation *v) {
  return v->worst / v->size;
}

static int is_limit(ambulo_ending ending) {
  return ending == AMBULO_ENDING_ITERATIONS || ending == AMBULO_ENDING_EVALUATIONS ||
         ending == AMBULO_ENDING_TIME;
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
  return is_limit(ending) ? AMBULO_LIMIT_REACHED : AMBULO_INFEASIBLE;
}
