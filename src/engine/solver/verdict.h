/* solver/verdict.h - from the audit (and the reason of the ending) to a verdict. */
#ifndef AMBULO_SOLVER_VERDICT_H
#define AMBULO_SOLVER_VERDICT_H

#include "ambulo/solve.h"

/* worst / size: what the feasibility tolerance is compared with. */
double ambulo__relative(const ambulo_violation *violation);

/* Name and text of AMBULO_ENDING_LIST; never NULL. */
const char *ambulo__ending_name(ambulo_ending ending);
const char *ambulo__ending_text(ambulo_ending ending);

/* A feasible point that is a KKT point or at the objective's lower bound is optimal however the
 * solver ended; one with a value or a derivative that is not finite never is. */
ambulo_verdict ambulo__verdict_of(const ambulo_audit *audit, const ambulo_options *options,
                                  ambulo_ending ending);

#endif
