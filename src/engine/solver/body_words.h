/* solver/body_words.h - violations of rows on capsules and obstacles, as what happens. */
#ifndef AMBULO_SOLVER_BODY_WORDS_H
#define AMBULO_SOLVER_BODY_WORDS_H

#include "ambulo/solve.h"
#include "problem/nlp.h"

/* "foot_r is 0.012 m inside obstacle 'beam' at t = 0.31 s", or "comes within .." where only the
 * margin is missed; into text[size]. 0: the violation is of another kind of rows. */
int ambulo__bodies_in_words(const ambulo_problem *problem, const ambulo_violation *violation,
                            char *text, size_t size);

#endif
