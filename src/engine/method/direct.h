/* method/direct.h - every row handed straight to NLopt, with its dense gradient: to compare, and
 * for problems with rows that the banded method cannot serve.
 *
 *     x = start + L^-T w     L L' the metric of the model step at `start`; plain: x = start + w
 */
#ifndef AMBULO_METHOD_DIRECT_H
#define AMBULO_METHOD_DIRECT_H

#include "method/engine.h"

enum { AMBULO__DIRECT_SETS = 3 }; /* equalities, border rows, inequalities as excesses <= 0 */

typedef struct ambulo__direct {
  ambulo__engine *engine;
  ambulo__sparse_rows *set[AMBULO__DIRECT_SETS];
  const ambulo__band *whitener;          /* NULL: plain */
  int nearest;                           /* minimize |w|^2 / 2 instead, until the rows hold */
  double *start, *x, *w;                 /* [n] */
  double *values;                        /* [largest set] */
  double *last_x;                        /* [n]: where AUGLAG's last inner problem ended */
  double *best_x, *spare_x;              /* [n]: the best point so far; of another stage */
  double best_objective, best_violation; /* HUGE_VAL: none yet */
  const char *message;                   /* NLopt's name of its result */
} ambulo__direct;

/* For all rows of the engine. E_MEMORY. */
ambulo_status ambulo__direct_create(ambulo__engine *engine, int plain, ambulo__direct *direct);
/* Minimizes from direct->start with at most `evaluations`; the best point seen is kept
 * (feasible: lowest objective; else smallest violation). AMBULO_AUGLAG or AMBULO_SLSQP. E_LIMIT:
 * the dense matrices would be too large; E_MEMORY. */
ambulo_status ambulo__direct_minimize(ambulo__direct *direct, ambulo_algorithm algorithm,
                                      int evaluations);

/* Calls of NLopt from x (in and out) while they help, at most options->maximum_iterations;
 * run->ending says what ended them. *message: NLopt's name of its last result. */
ambulo_status ambulo__solve_direct(ambulo__engine *engine, ambulo_algorithm algorithm, int plain,
                                   ambulo_diagnostics *diagnostics, double *x,
                                   const char **message);

#endif
