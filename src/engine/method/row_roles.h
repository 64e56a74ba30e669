/* method/row_roles.h - the roles that rows play in the solver.
 *
 *   equality    independent equalities inside one node's window: local
 *   border      independent equalities across nodes (periodic, mirrored ends): linear
 *   inequality  every inequality
 *
 * Each in the order of the problem's rows, as scaled gradients (linear/sparse_rows.h):
 *   equality    scale 1
 *   border      scale 1
 *   inequality  "excess" v = -c / size <= 0, size from the row table (contact/rows.h), which
 *               makes rows of different unit comparable; rows of the caller: the length of their
 *               gradient at the start
 */
#ifndef AMBULO_METHOD_ROW_ROLES_H
#define AMBULO_METHOD_ROW_ROLES_H

#include "linear/sparse_rows.h"
#include "method/run.h"
#include "problem/nlp.h"

/* Which equality rows are independent. */
typedef enum ambulo__row_rank {
  AMBULO__ROW_INDEPENDENT,
  AMBULO__ROW_DEPENDENT,    /* follows from the rows before it */
  AMBULO__ROW_CONTRADICTORY /* its gradient follows from theirs, its value does not */
} ambulo__row_rank;

typedef struct ambulo__row_roles {
  ambulo__sparse_rows equality, border, inequality;
  double *unit; /* [inequality.count]: the sizes above */
  double *size; /* what each is divided by: the same, or as ambulo__balance_rows weights it */
  int *rank;    /* [rows]: ambulo__row_rank */
  int dropped;
  int regular; /* 0: some row fits none of the roles; the banded pipeline cannot serve */
} ambulo__row_roles;

/* What row i of a filled set is divided by in the solver: see above. */
double ambulo__rows_size(const ambulo_problem *problem, const ambulo__sparse_rows *rows, int i);

/* 1 when some equality of the problem's `count` rows contradicts equalities before it. */
int ambulo__rows_contradict(const ambulo__row_roles *rows, int count);

/* Marks the rows between bodies that are far apart at x, which get no role: workspace->far. */
void ambulo__row_roles_set_far(ambulo_workspace *workspace, const double *x);

/* Classifies, creates the three sets and fills their gradients at the start. E_MEMORY; E_LIMIT: the
 * run (NULL: none) was stopped meanwhile. */
ambulo_status ambulo__row_roles_create(const ambulo_problem *problem, ambulo_workspace *workspace,
                                       const double *start, ambulo__run *run, ambulo__pool *pool,
                                       ambulo_diagnostics *diagnostics, ambulo__row_roles *out);

/* Sorts the equality rows: rank[rows] (inequalities are left independent). The check is
 * made at a generic point near `start`. `diagnostics` may be NULL: a warning with name and time for
 * each contradiction. E_MEMORY; E_LIMIT: the run (may be NULL) was stopped meanwhile. */
ambulo_status ambulo__presolve_rank(const ambulo_problem *problem, ambulo_workspace *workspace,
                                    const double *start, ambulo__run *run, ambulo__pool *pool,
                                    ambulo_diagnostics *diagnostics, int *rank);

/* The same for any set of rows whose gradients are filled and finite, with their values. rank is
 * indexed by row number of the problem; only rows of the set are touched. */
ambulo_status ambulo__rank_sort(const ambulo__sparse_rows *rows, const double *value,
                                ambulo__run *run, ambulo__pool *pool, int *rank);

#endif
