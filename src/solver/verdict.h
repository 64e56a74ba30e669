/* solver/verdict.h - from the audit (and the reason of the ending) to a verdict. */
#ifndef AMBULO_SOLVER_VERDICT_H
#define AMBULO_SOLVER_VERDICT_H

#include "ambulo/solve.h"

typedef enum ambulo__ending_kind {
  AMBULO__ENDED_BY_ITSELF,
  AMBULO__ENDED_BY_LIMIT, /* time or evaluations */
  AMBULO__ENDED_BY_CALLER /* the progress callback said stop */
} ambulo__ending_kind;

/* A feasible point that is a KKT point or at the objective's lower bound is optimal however the
 * solver ended. */
ambulo_verdict ambulo__verdict_of(const ambulo_audit *audit, const ambulo_options *options,
                                  ambulo__ending_kind ending);

#endif
