/* solver/auglag.h - NLopt's AUGLAG runs the method on one grid. */
#ifndef AMBULO_SOLVER_AUGLAG_H
#define AMBULO_SOLVER_AUGLAG_H

#include "solver/stopping.h"

/* From x, on the equalities (restore.c), with the engine's lambda, rho and mu, until `stopping` or
 * a limit ends it: *ending. x moves to where the last inner solve ended, and polish.c from there.
 * E_MEMORY. */
ambulo_status ambulo__auglag(ambulo__engine *engine, ambulo__stopping *stopping, double *x,
                             ambulo_ending *ending);

#endif
