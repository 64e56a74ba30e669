/* solver/presolve_rank.h - which equality rows are independent. */
#ifndef AMBULO_SOLVER_PRESOLVE_RANK_H
#define AMBULO_SOLVER_PRESOLVE_RANK_H

#include "nlp/nlp.h"
#include "solver/pool.h"

typedef enum ambulo__row_rank {
  AMBULO__ROW_INDEPENDENT,
  AMBULO__ROW_DEPENDENT,      /* follows from the rows before it */
  AMBULO__ROW_CONTRADICTORY   /* its gradient follows from theirs, its value does not */
} ambulo__row_rank;

/* Sorts the equality rows: rank[rows] (inequalities are left independent). The check is
 * made at a generic point near `start`. Each dropped family is named in `diagnostics`
 * (may be NULL): a note, or a warning with name and time for a contradiction. */
ambulo_status ambulo__presolve_rank(const ambulo_problem *problem, ambulo_workspace *workspace,
                                    const double *start, ambulo__pool *pool,
                                    ambulo_diagnostics *diagnostics, int *rank);

#endif
