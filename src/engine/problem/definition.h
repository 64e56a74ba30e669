/* problem/definition.h - what is done with whole definitions, by loops over the tables of
 * members.h.
 */
#ifndef AMBULO_PROBLEM_DEFINITION_H
#define AMBULO_PROBLEM_DEFINITION_H

#include "ambulo/extend.h"
#include "base/diagnostics.h"
#include "problem/members.h"

/* definition_check.c: every check that needs no grid; all faults are reported. E_ARGUMENT for a
 * definition that did not come from ambulo_problem_definition_default(). */
ambulo_status ambulo__definition_check(const ambulo_problem_definition *definition,
                                       ambulo_diagnostics *diagnostics);

/* What the numbers of a term and one coordinate, which turns or slides, are multiplied by for a
 * body of another size (definition_values.c): peak is that of passive torques and strengths. */
typedef struct ambulo__term_sizes {
  double weight, scale, offset, tendon, peak;
} ambulo__term_sizes;
ambulo__term_sizes ambulo__term_sizes_of(const ambulo_term *term, int turns, double longer,
                                         double heavier);

/* Deep copy (the model, callbacks and names of obstacles stay shared); strength that is limits gets
 * its curves. E_MEMORY leaves a half copy that ambulo__definition_free accepts. */
ambulo_status ambulo__definition_copy(const ambulo_problem_definition *from,
                                      const ambulo_allocator *allocator,
                                      ambulo_problem_definition *to);
void ambulo__definition_free(const ambulo_allocator *allocator,
                             ambulo_problem_definition *definition);
/* [count][2][3]: torque limits by their prices (NULL: 1), which do not depend on the angle; 0 of
 * those without, which stand for 1. */
void ambulo__strength_of_limits(const ambulo_coordinate *coordinates, int count,
                                const double *price, double *curves);
/* A copy's pairs of capsules are these, which it frees, instead of those it had. */
void ambulo__definition_set_pairs(const ambulo_allocator *allocator,
                                  ambulo_problem_definition *definition, ambulo_capsule_pair *pairs,
                                  int count);

/* FNV-1a (64 bit) of a model and of every member of a definition but callbacks, whose presence
 * counts; the same on every machine with the same byte order. It tells two inputs apart; it is no
 * cryptographic digest. */
unsigned long long ambulo__definition_hash(const ambulo_problem_definition *definition,
                                           const ambulo_model *model);

/* ------------------------------------------------------- programs of older headers */

enum { AMBULO__ARRAYS_OF_ITEMS = 10 };

/* The caller's arrays where they are of this library's items, else longer ones. */
typedef struct ambulo__taken_definition {
  ambulo_problem_definition definition;
  ambulo_allocator allocator;
  void *longer[AMBULO__ARRAYS_OF_ITEMS];
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

/* Every option in its range, else E_ARGUMENT with its key. */
ambulo_status ambulo__option_ranges_check(const ambulo_options *options,
                                          ambulo_diagnostics *diagnostics);

/* Numbers for a body of another size (definition_values.c): of the first `terms` terms of the
 * objective, and of all else. The arrays of these terms, and the list of them, belong to the
 * caller, and are written to. */
void ambulo__definition_resize(ambulo_problem_definition *definition, int terms, double longer,
                               double heavier);

#endif
