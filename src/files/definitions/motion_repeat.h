/* definitions/motion_repeat.h - a motion of one period, repeated over a problem of several. */
#ifndef AMBULO_DEFINITIONS_MOTION_REPEAT_H
#define AMBULO_DEFINITIONS_MOTION_REPEAT_H

#include "problem/nlp.h"

/* x [variables of problem] of `count` periods, the first of which has these control points: a step
 * is followed by its mirror image (AMBULO_ENDS_MIRRORED), a stride by itself
 * (AMBULO_ENDS_PERIODIC), each carried on by what the period carries the root. E_MEMORY. */
ambulo_status ambulo__motion_repeat(const ambulo__basis *one, const double *points, int count,
                                    ambulo_ends ends, const ambulo_problem *problem, double *x);

#endif
