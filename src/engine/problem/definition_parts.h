/* problem/definition_parts.h - definitions of older headers, piece by piece.
 *
 * A definition holds three parts by value. In an older one they, and the whole, may be shorter:
 *
 *     ours    [ a ][ clearance .... ][ ground_reaction .. ][ b ][ collision ... ][ c ..... ]
 *     theirs  [ a ][ clearance ][ ground_reaction ][ b ][ collision ][ c .. ]
 *
 * with the same a and b, between parts, and a beginning of c. The sizes stand at the beginning of
 * a.
 */
#ifndef AMBULO_PROBLEM_DEFINITION_PARTS_H
#define AMBULO_PROBLEM_DEFINITION_PARTS_H

#include "ambulo/problem.h"

enum { AMBULO__DEFINITION_RUNS = 7 };

/* A run of bytes that both have. */
typedef struct ambulo__definition_run {
  size_t ours, theirs, length;
} ambulo__definition_run;

/* Fills `runs`, in order; 0: no header of this library or of an older one had these sizes. */
int ambulo__definition_runs(const ambulo_problem_definition *theirs,
                            ambulo__definition_run runs[AMBULO__DEFINITION_RUNS]);
/* Sets the definition of a caller, whose sizes are set, to `usual`. */
void ambulo__definition_give(const ambulo_problem_definition *usual,
                             ambulo_problem_definition *given);

#endif
