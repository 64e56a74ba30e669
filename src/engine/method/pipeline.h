/* method/pipeline.h - the method on one grid, from a start to a solution. */
#ifndef AMBULO_METHOD_PIPELINE_H
#define AMBULO_METHOD_PIPELINE_H

#include "method/engine.h"

typedef enum ambulo__stage {
  AMBULO__COARSE, /* a coarse grid whose solution only starts the next one: wide tolerances */
  AMBULO__FAR,    /* from anywhere */
  AMBULO__BESIDE, /* from the solution of a problem like this one, with its multipliers */
  AMBULO__NEAR    /* from a point that nearly satisfies the rows, and stays in its valley */
} ambulo__stage;

/* From x (in and out); run->ending says why it ended. The last multipliers stay in the engine's
 * iterate, the last point of AUGLAG in engine->reached. Rows between bodies join as they come near
 * (near.c): the engine may then be another inside, so x is not of its pool. */
ambulo_status ambulo__pipeline(ambulo__engine *engine, ambulo__stage stage, double *x);
/* The same with the rows that the engine has. */
ambulo_status ambulo__pipeline_of_set(ambulo__engine *engine, ambulo__stage stage, double *x);
/* Gives the engine every row; x: finite there. E_MEMORY; E_LIMIT: the run was stopped. */
ambulo_status ambulo__near_all(ambulo__engine *engine, const double *x);

/* ------------------------------------------------------------------- its parts */

/* smooth := x through the filter of pipeline.c (they may be the same); the workspace holds x.
 * E_NUMERIC: something at x is not finite; E_MEMORY. */
ambulo_status ambulo__smooth_curve(ambulo__engine *engine, const double *x, double *smooth);
/* Replaces the start x by a smoothed one where that is the better start: *smoothed. The engine's
 * iterate is used up. E_MEMORY. */
ambulo_status ambulo__smooth_start(ambulo__engine *engine, double *x, int *smoothed);

/* What rows are divided by, so that one penalty serves all.
 *
 * A multiplier method brings a row to its bound by a factor of about 1 + rho l^2 a step, l the
 * length of its gradient in the metric. In their units (row_roles.h) rows are as different as the
 * force on a foot, l = 5, and the centre of pressure of a foot that has hardly any load, l = 0.01:
 * the penalty that the first stands is too weak for most. So stiff rows are weakened:
 *
 *     v = -c / (s max(1, sqrt l)),   s the size in its unit, l = (g'D^-1 g)^1/2, g = grad c / s
 *
 * with D the diagonal of the metric. Evaluations over 29 shipped problems, one run: in units 7900,
 * this 7300, by l instead of its root as many; with short rows strengthened likewise 6500, but
 * tasks that are hard to reach are then abandoned (range_excludes_posture; walker_2d_step on finer
 * grids takes 63 iterations, not 26). Beside a solution, where the multipliers are known, short
 * rows are strengthened too: max(.3, sqrt l). */

/* Sizes of the inequalities at x; multipliers become those of the rows as they are then. Where
 * something is not finite all stays as it is: whoever works with it next meets it again. */
void ambulo__balance_rows(ambulo__engine *engine, ambulo__stage stage, const double *x);

/* When the method on one grid is done (stopping.c).
 *
 * Asked after every inner solve, about the point engine->reached:
 *
 *   converged  f has settled, the reduced gradient is small and the rows hold, or hold after a few
 *              Newton steps on them (polishing)
 *   settled    f has not moved for some inner solves, its gradient is not small
 *   vanished   f has fallen to a thousandth of its first value and is negligible: relative tests
 *              never end a solve whose objective goes to zero
 *   stalled    neither the violation nor f moved for long, at the bound of the penalty, and again
 *              at tenfold and hundredfold bounds. A coarse grid sooner, and at the first: it has no
 *              room for what the rows ask
 */
typedef struct ambulo__stopping {
  int loose;                                    /* a coarse grid that only starts the next one */
  double objective, violation, least_violation; /* at the last point; so far */
  double first;                                 /* f after the first inner solve */
  int settled, since_better, points;
  int still;            /* points in a row that did not move at all */
  int since_halved;     /* points since the violation had fallen by half */
  double halved;        /* violation then */
  double penalty_limit; /* bound on the penalty that the engine's rho does not pass */
} ambulo__stopping;

ambulo__stopping ambulo__stopping_begin(int loose);

/* Why there is nothing more to do, or none. x [n] is the point reached; polishing moves it. */
ambulo_ending ambulo__stopping_test(ambulo__stopping *stopping, ambulo__engine *engine, double *x);

/* The run was cut short: what can still be had at once, when x is close. */
void ambulo__stopping_cut(const ambulo__stopping *stopping, ambulo__engine *engine, double *x);

/* Moves x by a few Newton steps until the inequalities hold; 1 on
 * success, else x stays: also when the objective rises by more than the multipliers predict,
 * unless `anyhow`. engine->reached must belong to x; its multipliers become the iterate's. */
int ambulo__polish(ambulo__engine *engine, int anyhow, double *x);

/* NLopt's AUGLAG runs the method on one grid (auglag.c).
 * From x, on the equalities (ambulo__restore), with the engine's lambda, rho and mu, until
 * `stopping` or a limit ends it: *ending. x moves to where the last inner solve ended, and
 * polishing from there. E_MEMORY. */
ambulo_status ambulo__auglag(ambulo__engine *engine, ambulo__stopping *stopping, double *x,
                             ambulo_ending *ending);

#endif
