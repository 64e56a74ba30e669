/* solver/elastic.h - the least violation that a problem can be brought to.
 *
 * Every row may give way:
 *
 *     minimize  E(x) = sum_r w_r^2 e_r(x)^2 / 2,   e_r = c_r / s_r             (equality)
 *                                                  e_r = min(0, c_r) / s_r     (inequality)
 *
 * with s_r a size that makes rows of different unit comparable (ambulo__rows_size) and w_r a
 * weight, 1 unless a caller of this header changes it. E = 0: the problem has a feasible point. At
 * a minimum with E > 0 the forces sum w^2 e grad e = 0 balance: the rows that carry them contradict
 * each other, at least near that point.
 */
#ifndef AMBULO_SOLVER_ELASTIC_H
#define AMBULO_SOLVER_ELASTIC_H

#include "linear/border.h"
#include "method/run.h"

typedef struct ambulo__elastic {
  const ambulo_problem *problem;
  ambulo_workspace *workspace; /* borrowed */
  ambulo__run *run;            /* borrowed: its progress callback can cancel */
  ambulo__sparse_rows local, border;
  int locals, borders, n;
  ambulo__band base, factor; /* equalities' J'J; with active inequalities and damping */
  ambulo__border bordered;   /* the factor with the active border rows */
  double *size;              /* [rows]: s */
  double *weight;            /* [rows]: w */
  double *linear_local, *linear_border, *along_local, *along_border, *pull;
  int *active_local, *active_border;
  double *step, *total, *right, *trial; /* [n] */
  double work, deadline;                /* model steps done; where to stop */
  double time_limit;                    /* s, monotonic clock: the end of the solve's own limit */
  int cancelled;
} ambulo__elastic;

/* Memory from `pool`. E_MEMORY; E_LIMIT when too many rows couple distant unknowns. */
ambulo_status ambulo__elastic_create(const ambulo_problem *problem, ambulo_workspace *workspace,
                                     ambulo__run *run, ambulo__pool *pool,
                                     ambulo__elastic *elastic);

/* Moves x downhill until E has settled, vanishes, or the deadline is met. 1: settled;
 * 0: out of steps or time, cancelled, or no finite value at x. */
int ambulo__elastic_minimize(ambulo__elastic *elastic, double *x);

/* 1 when the steps or the time are used up or the caller's callback said stop. */
int ambulo__elastic_over(ambulo__elastic *elastic);

/* e_r for the value of row r: violations relative to its size, >= 0. */
double ambulo__elastic_excess(const ambulo__elastic *elastic, int row, double value);

#endif
