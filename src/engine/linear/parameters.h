/* linear/parameters.h - constants of the linear algebra that shape the method. How they were
 * measured, and what T, x and 0 stand for: method/parameters.h; tests in tests/linear. */
#ifndef AMBULO_LINEAR_PARAMETERS_H
#define AMBULO_LINEAR_PARAMETERS_H

/* Error, relative to the parts of a sum, that is rounding. T: kkt (a hundredfold), equalities (0).
 */
#define AMBULO__ROUNDING 1e-11
/* Half of the digits of a double: what is left of a row's gradient that follows from others, of a
 * pivot that has lost too many digits, of a gain that is none. T: border (1e-10), row_roles
 * (0), model_step (1e-3). */
#define AMBULO__HALF_DIGITS 1e-8
/* Passes of the method of multipliers (kkt.c): three reach rounding, more are for rows that nearly
 * depend on each other. 0 (1): +3 %, yardstick_72 +0.6 % of the objective. T: kkt (0). */
#define AMBULO__KKT_PASSES 8
/* A pass that leaves more than this share of the error brings nothing. T: kkt (5e-5). */
#define AMBULO__KKT_PROGRESS 0.5
/* Error after all passes that asks for more stiffness next time. 0 (never): walk_without_reaction
 * with a tolerance of 1e-9 is called infeasible. T: kkt (1). */
#define AMBULO__KKT_SLOW 1e-7
/* S |J|^2 of a row, relative to the largest diagonal element of the metric; or, where that cannot
 * be factored, to what the metric opposes to the row. It is START at first and changes by FACTOR:
 * down once (fine grids), up to where half the digits of a double are left. Row by row from the
 * outset: walk_without_reaction with a tolerance of 1e-10 is not solved. T: kkt, all (a
 * hundredfold). */
#define AMBULO__STIFFNESS_START 1e4
#define AMBULO__STIFFNESS_FACTOR 100.0
#define AMBULO__STIFFNESS_LEAST (AMBULO__STIFFNESS_START / AMBULO__STIFFNESS_FACTOR)
#define AMBULO__STIFFNESS_LARGEST (1.0 / AMBULO__HALF_DIGITS)
/* Of the border's largest diagonal element: keeps border rows solvable that others imply. T: kkt (a
 * hundredfold). */
#define AMBULO__BORDER_SHIFT 1e-14
/* Columns of an update (border.h) before M is factored anew, in tiles of 8. x: free. 0 (a factor
 * for each change): walks +5 to +11 % CPU, whole bodies +16 to +38 %. T: border. */
#define AMBULO__UPDATE_TILES 4
/* Of the trace of the normal equations of mixing (kkt.c). 0: free, +2 % evaluations. T: kkt
 * (0). */
#define AMBULO__MIXING_REGULARIZATION 1e-12

#endif
