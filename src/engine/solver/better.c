/* solver/better.c - see better.h */
#include "solver/better.h"
#include "base/worst.h"
#include "solver/result.h"
#include "solver/verdict.h"

#include <math.h>

static const double price_of_rows = 1e-5; /* relative change of the objective */

/* what the tolerances leave of a point's faults: below 1 it passes */
static double faults_of(const ambulo_result *r, const ambulo_options *o) {
  double kkt = r->audit.at_lower_bound ? 0.0 : r->audit.kkt;
  return ambulo__worse(ambulo__relative(&r->audit.violation) / o->feasibility_tolerance,
                       kkt / o->optimality_tolerance);
}

ambulo_status ambulo__is_better(const ambulo_problem *problem, const ambulo_options *options,
                                const double *before, const double *x,
                                const ambulo_allocator *allocator, int *better) {
  ambulo_result *old = NULL, *new = NULL;
  *better = 0;
  ambulo_status status = ambulo_audit_point(problem, options, before, allocator, NULL, &old);
  if (!status) status = ambulo_audit_point(problem, options, x, allocator, NULL, &new);
  if (!status) {
    double allowed = old->objective + price_of_rows * fabs(old->objective);
    *better = faults_of(new, options) < faults_of(old, options) &&
              (faults_of(old, options) > 1.0 || new->objective <= allowed);
  }
  ambulo_result_free(old);
  ambulo_result_free(new);
  /* a point with values that are not finite is not better, and nothing went wrong */
  return status == AMBULO_E_PROBLEM || status == AMBULO_E_NUMERIC ? AMBULO_OK : status;
}
