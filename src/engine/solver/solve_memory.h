/* solver/solve_memory.h - how much memory a solve takes, before it is taken. */
#ifndef AMBULO_SOLVER_SOLVE_MEMORY_H
#define AMBULO_SOLVER_SOLVE_MEMORY_H

#include "problem/nlp.h"

/* E_LIMIT with the figures when a solve with these options would not fit. */
ambulo_status ambulo__solve_check_memory(const ambulo_problem *problem,
                                         const ambulo_options *options,
                                         ambulo_diagnostics *diagnostics);

#endif
