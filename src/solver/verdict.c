/* solver/verdict.c - names of the verdicts, and the verdict that an audit supports. */
#include "solver/verdict.h"

#include <math.h>

const char *ambulo_verdict_name(ambulo_verdict verdict) {
  static const char *const names[] = {
#define NAME(id, name, text) name,
      AMBULO_VERDICT_LIST(NAME)
#undef NAME
  };
  if (verdict < AMBULO_OPTIMAL || verdict > AMBULO_INTERRUPTED) return "unknown";
  return names[verdict];
}

const char *ambulo_verdict_text(ambulo_verdict verdict) {
  static const char *const texts[] = {
#define TEXT(id, name, text) text,
      AMBULO_VERDICT_LIST(TEXT)
#undef TEXT
  };
  if (verdict < AMBULO_OPTIMAL || verdict > AMBULO_INTERRUPTED) return "unknown verdict";
  return texts[verdict];
}

ambulo_verdict ambulo__verdict_of(const ambulo_audit *audit, const ambulo_options *options,
                                  ambulo__ending_kind ending) {
  if (!isfinite(audit->violation.worst)) return AMBULO_NUMERIC_FAILURE;
  int feasible = audit->violation.worst <= options->feasibility_tolerance;
  int stationary = audit->kkt <= options->optimality_tolerance;
  if (feasible && (stationary || audit->at_lower_bound)) return AMBULO_OPTIMAL;
  if (ending == AMBULO__ENDED_BY_CALLER) return AMBULO_INTERRUPTED;
  if (feasible) return AMBULO_FEASIBLE;
  return ending == AMBULO__ENDED_BY_LIMIT ? AMBULO_LIMIT_REACHED : AMBULO_INFEASIBLE;
}
