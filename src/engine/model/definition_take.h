/* model/definition_take.h - the definition of a caller as one of this library. */
#ifndef AMBULO_MODEL_DEFINITION_TAKE_H
#define AMBULO_MODEL_DEFINITION_TAKE_H

#include "ambulo/model.h"

enum { AMBULO__MODEL_ARRAYS = 6 };

/* The caller's arrays where they are of this library's items, else longer ones. */
typedef struct ambulo__taken_model {
  ambulo_model_definition definition;
  ambulo_allocator allocator;
  void *longer[AMBULO__MODEL_ARRAYS];
} ambulo__taken_model;

/* E_ARGUMENT: not from ambulo_model_definition_default(), or arrays that are not there; E_MEMORY.
 * Dropped in either case. */
ambulo_status ambulo__model_take(const ambulo_model_definition *given,
                                 const ambulo_allocator *allocator, ambulo__taken_model *taken);
void ambulo__model_drop(ambulo__taken_model *taken);

#endif
