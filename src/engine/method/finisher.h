/* method/finisher.h - `finisher: slsqp`: NLopt's SLSQP from where the pipeline ended. */
#ifndef AMBULO_METHOD_FINISHER_H
#define AMBULO_METHOD_FINISHER_H

#include "method/engine.h"

/* Most unknowns for which SLSQP's dense steps are worth their price. */
enum { AMBULO__FINISHER_UNKNOWNS = 750 };

/* Moves x (in and out), a point near a solution, by SLSQP in whitened coordinates on the
 * equalities' surface, with the inequalities near x as its rows. The caller judges the new
 * point. *message: NLopt's name of its result. E_MEMORY. */
ambulo_status ambulo__finish(ambulo__engine *engine, double *x, const char **message);

#endif
