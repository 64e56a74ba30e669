/* method/auglag.h - NLopt's AUGLAG runs the method on one grid. */
#ifndef AMBULO_METHOD_AUGLAG_H
#define AMBULO_METHOD_AUGLAG_H

#include "method/stopping.h"

/* From x, on the equalities (restore.c), with the engine's lambda, rho and mu, until `stopping` or
 * a limit ends it: *ending. x moves to where the last inner solve ended, and polish.c from there.
 * E_MEMORY. */
ambulo_status ambulo__auglag(ambulo__engine *engine, ambulo__stopping *stopping, double *x,
                             ambulo_ending *ending);

#endif
