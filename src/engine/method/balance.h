/* method/balance.h - what rows are divided by, so that one penalty serves all.
 *
 * A multiplier method brings a row to its bound by a factor of about 1 + rho l^2 a step, l the
 * length of its gradient in the metric. In their units (rows_split.h) rows are as different as the
 * force on a foot, l = 5, and the centre of pressure of a foot that has hardly any load, l = 0.01:
 * the penalty that the first stands is too weak for most. So stiff rows are weakened:
 *
 *     v = -c / (s max(1, sqrt l)),   s the size in its unit, l = (g'D^-1 g)^1/2, g = grad c / s
 *
 * with D the diagonal of the metric. Evaluations over 29 shipped problems, one run: in units 7900,
 * this 7300, by l instead of its root as many; with short rows strengthened likewise 6500, but
 * tasks that are hard to reach are then given up (range_excludes_posture; walker_2d_step on finer
 * grids takes 63 iterations, not 26). */
#ifndef AMBULO_METHOD_BALANCE_H
#define AMBULO_METHOD_BALANCE_H

#include "method/engine.h"

/* Sizes of the inequalities at x; multipliers become those of the rows as they are then. Where
 * something is not finite all stays as it is: whoever works with it next meets it again. */
void ambulo__balance_rows(ambulo__engine *engine, const double *x);

#endif
