/* solver/free_outcome.h - what a run over free parameters leaves with its result. */
#ifndef AMBULO_SOLVER_FREE_OUTCOME_H
#define AMBULO_SOLVER_FREE_OUTCOME_H

#include "solver/free_search.h"

/* Gives run->best.result what became of the run, in one block with its texts. E_MEMORY. */
ambulo_status ambulo__outcome_attach(ambulo__outer *run);

#endif
