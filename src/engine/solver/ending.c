/* solver/ending.c - see ending.h */
#include "solver/ending.h"
#include "solver/verdict.h"

#include <nlopt.h>

void ambulo__report_families(const ambulo_result *r, double tolerance, ambulo_diagnostics *list) {
  if (r->verdict != AMBULO_INFEASIBLE) return;
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
  if (r->verdict != AMBULO_LIMIT_REACHED || run->ending != AMBULO_ENDING_ITERATIONS || !e) return;
  if (e->complete && !e->feasible_point && e->conflict_count > 0) r->verdict = AMBULO_INFEASIBLE;
}
