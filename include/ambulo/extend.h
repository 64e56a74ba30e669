/* ambulo/extend.h - terms and rows added to an existing problem, from a file or from C. */
#ifndef AMBULO_EXTEND_H
#define AMBULO_EXTEND_H

#include "ambulo/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What to add: for example, a term of the caller's own on a walk from a file. Borrowed during the
 * call only, except the callbacks' user pointers, which must outlive the problem. */
typedef struct ambulo_extension {
  size_t size, term_size, user_row_size; /* set by ambulo_extension_default() */
  const ambulo_term *terms; /* [term_count] of any kind; they follow the problem's own */
  int term_count;
  const ambulo_user_row *user_rows; /* [user_row_count]; they follow the problem's own */
  int user_row_count;
} ambulo_extension;
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_extension ambulo_extension_default(void) { /* nothing */
  ambulo_extension usual;
  usual.size = sizeof usual;
  usual.term_size = sizeof(ambulo_term);
  usual.user_row_size = sizeof(ambulo_user_row);
  ambulo_defaults("ambulo_extension", &usual, sizeof usual);
  return usual;
}
#endif

/* A copy of `problem` with the extension. It keeps the unknowns, options and free parameters
 * (parameters.h), and its own rows and terms come first. It uses the model of `problem`: free it
 * before `problem`. `allocator` and `diagnostics` may be NULL. Errors: as ambulo_problem_create;
 * E_ARGUMENT also for an extension that did not come from ambulo_extension_default(). */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_problem_extend(const ambulo_problem *problem,
                                                                const ambulo_extension *extension,
                                                                const ambulo_allocator *allocator,
                                                                ambulo_diagnostics *diagnostics,
                                                                ambulo_problem **extended);

#ifdef __cplusplus
}
#endif
#endif
