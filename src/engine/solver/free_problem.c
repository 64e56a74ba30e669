/* solver/free_problem.c - which numbers of a problem are free, and the problem with them elsewhere.
 */
#include "ambulo/parameters.h"

#include "base/sized.h"
#include "solver/free_search.h"

#include <string.h>

/* One block, freed with the problem: texts stand behind the items. */
struct ambulo__free_section {
  ambulo_parameters parameters;
  ambulo_parameter item[];
};

/* The items are the library's own, of its size: the caller reads the beginning of each. */
void ambulo_problem_parameters_fill(const ambulo_problem *problem, ambulo_parameters *filled) {
  const struct ambulo__free_section *s = ambulo__problem_root(problem)->free;
  if (!s) return;
  ambulo_parameters usual = s->parameters;
  usual.size = filled->size;
  ambulo__sized_fill(filled, filled->size, &usual, sizeof usual);
}

ambulo_status ambulo__free_keep(ambulo_problem *problem, const ambulo_parameters *parameters) {
  size_t count = (size_t)parameters->count, size = count * sizeof(ambulo_parameter);
  for (size_t i = 0; i < count; i++) size += strlen(parameters->items[i].name) + 1;
  struct ambulo__free_section *s = ambulo__alloc(&problem->allocator, sizeof *s + size, 1);
  if (!s) return AMBULO_E_MEMORY;
  s->parameters = *parameters;
  s->parameters.items = s->item;
  char *text = (char *)(s->item + count);
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(parameters->items[i].name) + 1;
    s->item[i] = parameters->items[i];
    s->item[i].name = memcpy(text, parameters->items[i].name, length);
    text += length;
  }
  problem->free = s;
  return AMBULO_OK;
}

ambulo_status ambulo__free_problem(const ambulo_problem *problem,
                                   const ambulo_parameters *parameters, const double *values,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_problem **at) {
  ambulo__parameters known;
  ambulo_status status = ambulo__parameters_init(problem, allocator, &known);
  for (int i = 0; i < parameters->count && !status; i++) {
    const ambulo__parameter *p = ambulo__parameters_find(&known, parameters->items[i].name);
    if (p)
      ambulo__parameter_set(&known, p, values[i]);
    else
      status = AMBULO_E_ARGUMENT;
  }
  if (!status) status = ambulo__variant_problem(&known.variant, diagnostics, 1, at);
  ambulo__parameters_clear(&known);
  return status;
}

ambulo_status ambulo_problem_at(const ambulo_problem *problem, const double *values,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                ambulo_problem **at) {
  if (!problem || !values || !at || !ambulo__problem_root(problem)->free) return AMBULO_E_ARGUMENT;
  const ambulo_parameters free = ambulo_problem_parameters(problem);
  return ambulo__free_problem(problem, &free, values, allocator, diagnostics, at);
}
