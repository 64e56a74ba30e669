/* method/nlopt_direct.h - every row handed straight to NLopt (dense gradients).
 *
 *     x = start + L^-T w     (L the whitener; without one x = start + w)
 */
#ifndef AMBULO_METHOD_NLOPT_DIRECT_H
#define AMBULO_METHOD_NLOPT_DIRECT_H

#include "method/engine.h"

enum { AMBULO__DIRECT_SETS = 3 };

/* What NLopt is given. Sets carry the scales of their rows; inequalities are excesses
 * (value <= 0). */
typedef struct ambulo__direct {
  const ambulo_problem *problem;
  ambulo_workspace *workspace;
  ambulo__run *run;
  const ambulo__band *whitener; /* NULL: none */
  ambulo__sparse_rows *set[AMBULO__DIRECT_SETS];
  int is_equality[AMBULO__DIRECT_SETS];
  int sets;
  double objective_scale;
  int nearest;                           /* minimize |w|^2 / 2 instead, until the rows hold */
  double *start, *x, *w, *gradient;      /* [n] */
  double *values;                        /* [largest set] */
  double *best_x;                        /* [n] */
  double *last_x;                        /* [n]: where AUGLAG's last inner problem ended */
  double best_objective, best_violation; /* HUGE_VAL: none yet */
  const char *message;                   /* NLopt's name of its result */
  int result;
} ambulo__direct;

/* Vectors for problems of this size; the sets must be there. */
ambulo_status ambulo__direct_create(ambulo__direct *direct, ambulo__pool *pool);

/* Minimizes from direct->start with at most `evaluations`; the best point seen is kept.
 * AMBULO_AUGLAG or AMBULO_SLSQP. E_LIMIT: the dense matrices would be too large;
 * E_MEMORY. */
ambulo_status ambulo__direct_minimize(ambulo__direct *direct, ambulo_algorithm algorithm,
                                      int evaluations);

/* NLopt's name of its result, without the prefix. */
const char *ambulo__nlopt_name(int result);

/* presolve: off - the rows as they are, from x (in and out). Of the engine only workspace and
 * rows are used. */
ambulo_status ambulo__solve_plain(ambulo__engine *engine, ambulo_algorithm algorithm,
                                  ambulo_diagnostics *diagnostics, double *x, const char **message);

/* SLSQP in whitened coordinates on independent rows, restored and re-whitened in at most `most`
 * rounds, from x (in and out): the way for small problems. */
ambulo_status ambulo__solve_whitened(ambulo__engine *engine, ambulo_algorithm algorithm, int most,
                                     ambulo_diagnostics *diagnostics, double *x,
                                     const char **message);

#endif
