/* problem/definition_take.h - the definition, or the extension, of a caller as one of this library.
 */
#ifndef AMBULO_PROBLEM_DEFINITION_TAKE_H
#define AMBULO_PROBLEM_DEFINITION_TAKE_H

#include "ambulo/extend.h"

enum { AMBULO__DEFINITION_ARRAYS = 10 };

/* The caller's arrays where they are of this library's items, else longer ones. */
typedef struct ambulo__taken_definition {
  ambulo_problem_definition definition;
  ambulo_allocator allocator;
  void *longer[AMBULO__DEFINITION_ARRAYS];
  int count; /* of them */
} ambulo__taken_definition;

/* E_ARGUMENT: not from ambulo_problem_definition_default(); E_MEMORY. Dropped in either case. */
ambulo_status ambulo__definition_take(const ambulo_problem_definition *given,
                                      const ambulo_allocator *allocator,
                                      ambulo__taken_definition *taken);
/* The same of ambulo_extension_default(); `definition` has its terms and rows alone. */
ambulo_status ambulo__extension_take(const ambulo_extension *given,
                                     const ambulo_allocator *allocator,
                                     ambulo__taken_definition *taken);
void ambulo__definition_drop(ambulo__taken_definition *taken);

#endif
