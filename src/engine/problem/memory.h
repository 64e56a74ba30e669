/* problem/memory.h - how much memory a problem takes, before it is taken.
 *
 * Bytes, as doubles: absurd sizes do not overflow them.
 */
#ifndef AMBULO_PROBLEM_MEMORY_H
#define AMBULO_PROBLEM_MEMORY_H

#include "problem/nlp.h"

/* Of a workspace of a problem whose grid and plan are there. */
double ambulo__workspace_bytes(const ambulo_problem *problem, int with_jacobians);
/* Of the rows that this definition can bring at the most, with the tables made of them. */
double ambulo__row_bytes(const ambulo_problem *problem, double rows);
double ambulo__rows_at_most(const ambulo_problem *problem);
/* E_LIMIT with the figures when a problem whose grid and plan are there would not fit. */
ambulo_status ambulo__check_memory(const ambulo_problem *problem, ambulo_diagnostics *diagnostics);

#endif
