/* linear/parameters.h - constants of the linear algebra that shape the method. How they were
 * measured, and what T, x and 0 stand for: method/parameters.h; tests in tests/linear. */
#ifndef AMBULO_LINEAR_PARAMETERS_H
#define AMBULO_LINEAR_PARAMETERS_H

/* passes of the method of multipliers (kkt.c): three reach rounding, more are for rows that nearly
 * depend on each other. 0 (1): +3 % iterations, yardstick_72 +0.6 % of the objective. T: kkt (0).
 */
#define AMBULO__KKT_PASSES 8
/* error of the rows, relative to their parts, that is rounding; a pass that leaves more than this
 * share of it brings nothing. T: kkt, both (a hundredfold; 5e-5). */
#define AMBULO__KKT_TOLERANCE 1e-11
#define AMBULO__KKT_PROGRESS 0.5
/* error after all passes that asks for more stiffness next time. 0 (never): walk_without_reaction
 * with a tolerance of 1e-9 is called infeasible. T: kkt (1). */
#define AMBULO__KKT_SLOW 1e-7
/* S |J|^2 of a row, relative to the largest diagonal element of the metric; or, where that cannot
 * be factored, to what the metric opposes to the row: at first, the least of the latter (fine
 * grids), its growth, and at most: half the digits of a double are left then. Row by row from the
 * outset: walk_without_reaction with a tolerance of 1e-10 is not solved. T: kkt, all (a
 * hundredfold). */
#define AMBULO__STIFFNESS_START 1e4
#define AMBULO__STIFFNESS_LEAST 1e2
#define AMBULO__STIFFNESS_FACTOR 100.0
#define AMBULO__STIFFNESS_LARGEST 1e8
/* of the border's largest diagonal element: keeps border rows solvable that others imply.
 * T: kkt (a hundredfold). */
#define AMBULO__BORDER_SHIFT 1e-14
/* columns of an update (update.h) before M is factored anew, in tiles of 8. x: free. 0 (a factor
 * for each change): walks +5 to +11 % CPU, whole bodies +16 to +38 %. T: update. */
#define AMBULO__UPDATE_TILES 4
/* of a pivot's parts: what has to be left of it, half the digits of a double. T: update (1e-10). */
#define AMBULO__UPDATE_LOSS 1e-8
/* of the trace of the normal equations of mixing (mixing.c). 0: free, +2 % evaluations. T: mixing
 * (0). */
#define AMBULO__MIXING_REGULARIZATION 1e-12

#endif
