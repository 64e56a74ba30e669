/* definitions/problem_free.h - what the section `free` of a problem file says, and what it takes to
 * read that file again with other numbers. */
#ifndef AMBULO_DEFINITIONS_PROBLEM_FREE_H
#define AMBULO_DEFINITIONS_PROBLEM_FREE_H

#include "ambulo/parameters.h"
#include "definitions/problem_reader.h"

/* How the value of a free parameter is written in the file. */
typedef struct ambulo__free_key {
  const char *with; /* keys that move along, "a, b"; "" */
  double with_sign;
  double unit; /* SI, rad per unit of the file */
} ambulo__free_key;

/* One block, freed with the problem. */
typedef struct ambulo__free_section {
  ambulo_parameters parameters; /* items are `item` */
  const ambulo_parameter *item; /* [count] */
  const ambulo__free_key *key;  /* [count] */
  const char *text;             /* the file as it was */
  size_t length;
  const char *name, *directory; /* as for ambulo_problem_load_text */
  const char *const *override;  /* [overrides], which it was read with */
  int overrides;
} ambulo__free_section;

/* ambulo_problem_at of a problem that has the section, by `load`. */
ambulo_status ambulo__problem_at(ambulo__text_loader *load, const ambulo_problem *problem,
                                 const double *values, const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics, ambulo_problem **at);

/* Reads root's `free` into problem->free, once the problem is made; E_SCHEMA, E_PROBLEM where the
 * document has faults, E_MEMORY. Nothing without such a section. */
ambulo_status ambulo__read_free(ambulo__problem_reader *reader, const ambulo__yaml_node *root,
                                ambulo_problem *problem);

#endif
