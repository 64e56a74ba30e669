/* definitions/problem_free.h - the section `free` of a problem file. */
#ifndef AMBULO_DEFINITIONS_PROBLEM_FREE_H
#define AMBULO_DEFINITIONS_PROBLEM_FREE_H

#include "definitions/problem_reader.h"

/* Reads root's `free` into problem->free, once the problem is made; E_SCHEMA, E_PROBLEM where the
 * document has faults, E_MEMORY. Nothing without such a section. */
ambulo_status ambulo__read_free(ambulo__problem_reader *reader, const ambulo__yaml_node *root,
                                ambulo_problem *problem);

#endif
