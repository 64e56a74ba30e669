/* method/slsqp.h - NLopt's SLSQP on every row, in whitened coordinates: for small problems, and for
 * rows that the banded method cannot serve. */
#ifndef AMBULO_METHOD_SLSQP_H
#define AMBULO_METHOD_SLSQP_H

#include "method/engine.h"

/* Calls of SLSQP from x (in and out) while they help, at most options->maximum_iterations;
 * run->ending says what ended them. *message: NLopt's name of its last result. E_LIMIT: the dense
 * matrices would be too large; E_MEMORY. */
ambulo_status ambulo__solve_slsqp(ambulo__engine *engine, ambulo_diagnostics *diagnostics,
                                  double *x, const char **message);

#endif
