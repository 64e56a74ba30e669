/* method/presolve_rank.h - which equality rows are independent. */
#ifndef AMBULO_METHOD_PRESOLVE_RANK_H
#define AMBULO_METHOD_PRESOLVE_RANK_H

#include "problem/nlp.h"
#include "method/run.h"
#include "linear/sparse_rows.h"

typedef enum ambulo__row_rank {
  AMBULO__ROW_INDEPENDENT,
  AMBULO__ROW_DEPENDENT,    /* follows from the rows before it */
  AMBULO__ROW_CONTRADICTORY /* its gradient follows from theirs, its value does not */
} ambulo__row_rank;

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
