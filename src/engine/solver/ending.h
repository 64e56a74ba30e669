/* solver/ending.h - what is said of a run that has ended, and what its ending means for the
 * verdict. */
#ifndef AMBULO_SOLVER_ENDING_H
#define AMBULO_SOLVER_ENDING_H

#include "solver/audit.h"
#include "method/run.h"

/* A method that gave up where values or derivatives were not finite failed for that reason. */
void ambulo__ending_of_faults(ambulo__run *run);

/* Nothing that was not finite stays unsaid: of the result as a warning, of points that the search
 * gave up as a note. */
void ambulo__report_faults(const ambulo__run *run, ambulo_result *result,
                           ambulo_diagnostics *diagnostics);

/* Every family that could not be satisfied, and by how much it would have to give: warnings. */
void ambulo__report_families(const ambulo_result *result, double tolerance,
                             ambulo_diagnostics *diagnostics);

/* The method's own iteration limit is no answer where the least violation was found, and is not
 * zero: then no more iterations would have helped. */
void ambulo__settle_verdict(const ambulo__run *run, ambulo_result *result);

#endif
