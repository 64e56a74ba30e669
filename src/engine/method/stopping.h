/* method/stopping.h - when the method on one grid is done.
 *
 * Asked after every inner solve, about the point engine->reached:
 *
 *   converged  f has settled, the reduced gradient is small and the rows hold, or hold after a few
 *              Newton steps on them (polish.c)
 *   settled    f has not moved for some inner solves, its gradient is not small
 *   vanished   f has fallen to a thousandth of its first value and is negligible: relative tests
 *              never end a solve whose objective goes to zero
 *   stalled    neither the violation nor f moved for long, at the bound of the penalty, and again
 *              at tenfold and hundredfold bounds. A coarse grid sooner, and at the first: it has no
 *              room for what the rows ask
 */
#ifndef AMBULO_METHOD_STOPPING_H
#define AMBULO_METHOD_STOPPING_H

#include "method/engine.h"

typedef struct ambulo__stopping {
  int loose;                         /* a coarse grid that only starts the next one */
  double objective, least_violation; /* at the last point; so far */
  double first;                      /* f after the first inner solve */
  int settled, since_better, points;
  int since_halved;     /* points since the violation had fallen by half */
  double halved;        /* violation then */
  double penalty_limit; /* bound on the penalty that the engine's rho does not pass */
} ambulo__stopping;

ambulo__stopping ambulo__stopping_begin(int loose);

/* Why there is nothing more to do, or none. x [n] is the point reached; polishing moves it. */
ambulo_ending ambulo__stopping_test(ambulo__stopping *stopping, ambulo__engine *engine, double *x);

/* The run was cut short: what can still be had at once, when x is close. */
void ambulo__stopping_cut(const ambulo__stopping *stopping, ambulo__engine *engine, double *x);

#endif
