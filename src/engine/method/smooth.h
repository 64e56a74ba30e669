/* method/smooth.h - a rough start made smooth. */
#ifndef AMBULO_METHOD_SMOOTH_H
#define AMBULO_METHOD_SMOOTH_H

#include "method/engine.h"

/* smooth := x through the filter of smooth.c (they may be the same); the workspace holds x.
 * E_NUMERIC: something at x is not finite; E_MEMORY. */
ambulo_status ambulo__smooth_curve(ambulo__engine *engine, const double *x, double *smooth);
/* Replaces the start x by a smoothed one where that is the better start: *smoothed. The engine's
 * iterate is used up. E_MEMORY. */
ambulo_status ambulo__smooth_start(ambulo__engine *engine, double *x, int *smoothed);

#endif
