/* method/trial.c - see trial.h. */
#include "method/trial.h"

#include <math.h>
#include <string.h>

ambulo_status ambulo__trial_create(int n, int inequalities, int equalities, ambulo__pool *pool,
                                   ambulo__trial *trial) {
  *trial = (ambulo__trial){.n = n,
                           .inequalities = inequalities,
                           .equalities = equalities,
                           .value = HUGE_VAL,
                           .x = ambulo__pool_doubles(pool, (size_t)n),
                           .excess = ambulo__pool_doubles(pool, (size_t)inequalities),
                           .multiplier = ambulo__pool_doubles(pool, (size_t)inequalities),
                           .equality_multiplier = ambulo__pool_doubles(pool, (size_t)equalities)};
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__trial_copy(const ambulo__trial *from, ambulo__trial *to) {
  size_t rows = (size_t)from->inequalities * sizeof *to->excess;
  to->value = from->value;
  to->objective = from->objective;
  to->violation = from->violation;
  to->gradient_norm = from->gradient_norm;
  memcpy(to->x, from->x, (size_t)from->n * sizeof *to->x);
  memcpy(to->excess, from->excess, rows);
  memcpy(to->multiplier, from->multiplier, rows);
  memcpy(to->equality_multiplier, from->equality_multiplier,
         (size_t)from->equalities * sizeof *to->equality_multiplier);
}
