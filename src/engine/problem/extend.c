/* problem/extend.c - a problem and what a caller adds to it: terms, rows at the nodes.
 *
 * The extended problem is built anew from the definition that the first one came to (its nodes,
 * its contacts, its pairs of capsules), with the additions behind, and shares its model. */
#include "ambulo/extend.h"
#include "problem/definition.h"
#include "problem/problem.h"

#include <string.h>

static int is_there(const void *array, int count) {
  return count == 0 || (count > 0 && array);
}

/* copies `count` items behind the `own` ones; NULL without memory */
static void *joined(const ambulo_allocator *a, size_t size, const void *first, int own,
                    const void *second, int count) {
  char *both = ambulo__alloc(a, (size_t)own + (size_t)count, size);
  if (both && own > 0) memcpy(both, first, (size_t)own * size);
  if (both && count > 0) memcpy(both + (size_t)own * size, second, (size_t)count * size);
  return both;
}

static ambulo_status extend(const ambulo_problem *p, const ambulo_problem_definition *e,
                            const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                            ambulo_problem **extended) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_problem_definition d = p->definition;
  ambulo_term *terms = joined(&a, sizeof *terms, d.terms, d.term_count, e->terms, e->term_count);
  ambulo_user_row *rows =
      joined(&a, sizeof *rows, d.user_rows, d.user_row_count, e->user_rows, e->user_row_count);
  ambulo_status status = AMBULO_E_MEMORY;
  if (terms && rows) {
    d.terms = terms;
    d.term_count += e->term_count;
    d.user_rows = rows;
    d.user_row_count += e->user_row_count;
    status = ambulo_problem_create(&d, allocator, diagnostics, extended);
  }
  ambulo__free(&a, terms);
  ambulo__free(&a, rows);
  if (status) return status;
  (*extended)->extends = p;
  (*extended)->file_options = p->file_options;
  (*extended)->keys = p->keys;
  return AMBULO_OK;
}

ambulo_status ambulo_problem_extend(const ambulo_problem *problem,
                                    const ambulo_extension *extension,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **extended) {
  if (!problem || !extension || !extended) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__taken_definition own;
  const ambulo_problem_definition *d = &own.definition;
  ambulo_status status = ambulo__extension_take(extension, allocator, &own);
  if (!status && (!is_there(d->terms, d->term_count) || !is_there(d->user_rows, d->user_row_count)))
    status = AMBULO_E_ARGUMENT;
  int is_legal = status != AMBULO_E_ARGUMENT;
  if (!status) status = extend(problem, d, allocator, diagnostics, extended);
  ambulo__definition_drop(&own);
  if (!is_legal) return status;
  return ambulo__conclude(diagnostics, errors, status, NULL);
}

ambulo_status ambulo__extend_alike(const ambulo_problem *like, ambulo_problem *base,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_problem **extended) {
  const ambulo_problem_definition *d = &like->definition;
  const ambulo_problem_definition *root = &ambulo__problem_root(like)->definition;
  ambulo_extension e = ambulo_extension_default();
  e.term_count = d->term_count - root->term_count;
  e.user_row_count = d->user_row_count - root->user_row_count;
  if (e.term_count == 0 && e.user_row_count == 0) {
    *extended = base;
    return AMBULO_OK;
  }
  e.terms = d->terms + root->term_count;
  e.user_rows = d->user_rows + root->user_row_count;
  ambulo_problem *made = NULL;
  ambulo_status status = ambulo_problem_extend(base, &e, allocator, diagnostics, &made);
  if (!made) {
    ambulo_problem_free(base);
    return status;
  }
  made->owned_base = base;
  *extended = made;
  return AMBULO_OK;
}
