/* support/find_capsule.h - a capsule of a model by its name. */
#ifndef TEST_FIND_CAPSULE_H
#define TEST_FIND_CAPSULE_H

#include <string.h>

#include "ambulo/model.h"

/* -1: none of this name */
static inline int find_capsule(const ambulo_model *model, const char *name) {
  int index = ambulo_model_capsule_count(model) - 1;
  while (index >= 0 && strcmp(ambulo_model_capsule(model, index)->name, name) != 0) index--;
  return index;
}

#endif
