/* method/smooth.h - a rough start made smooth. */
#ifndef AMBULO_METHOD_SMOOTH_H
#define AMBULO_METHOD_SMOOTH_H

#include "method/engine.h"

/* smooth := x through the filter of smooth.c (they may be the same); the workspace holds x. 1 when
 * something at x is not finite. */
int ambulo__smooth_curve(ambulo__engine *engine, const double *x, double *smooth);
/* Replaces the start x by a smoothed one where that is the better start; 1 when it was. The
 * engine's state is used up. */
int ambulo__smooth_start(ambulo__engine *engine, double *x);

#endif
