/* solver/rows_split.h - the roles that rows play in the solver.
 *
 *   equality    independent equalities inside one node's window: local
 *   border      independent equalities across nodes (periodic, mirrored ends): linear
 *   inequality  every inequality
 *
 * Each in the order of the problem's rows, as scaled gradients (solver/sparse_rows.h):
 *   equality    scale 1
 *   border      scale 1
 *   inequality  "excess" v = -s c <= 0, with s a size that makes rows of different unit
 *               comparable: 1 for lengths and angles, 1/|limit| for torques, ...
 */
#ifndef AMBULO_SOLVER_ROWS_SPLIT_H
#define AMBULO_SOLVER_ROWS_SPLIT_H

#include "solver/presolve_rank.h"
#include "solver/sparse_rows.h"

typedef struct ambulo__rows_split {
  ambulo__sparse_rows equality, border, inequality;
  int *rank; /* [rows]: ambulo__row_rank */
  int dropped;
  int regular; /* 0: some row fits none of the roles; the banded pipeline cannot serve */
} ambulo__rows_split;

/* Classifies, creates the three sets and fills their gradients at the start. */
ambulo_status ambulo__rows_split_create(const ambulo_problem *problem, ambulo_workspace *workspace,
                                        const double *start, ambulo__pool *pool,
                                        ambulo_diagnostics *diagnostics, ambulo__rows_split *out);

#endif
