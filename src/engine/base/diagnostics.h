/* base/diagnostics.h - adding messages to a list (the list itself: ambulo/status.h).
 *
 * Reading order: diagnostics.h, alloc.h, arithmetic.h (how maxima treat what is not finite),
 * lanes.h (the layout of all node arrays), sized.h; numtext.h and text_buffer.h where texts are
 * written; the rest as it is called.
 */
#ifndef AMBULO_BASE_DIAGNOSTICS_H
#define AMBULO_BASE_DIAGNOSTICS_H

#include "ambulo/status.h"

/* Where in an input something stands; all members may be NULL / 0. */
typedef struct ambulo__place {
  const char *file;
  int line, column;
  const char *path;
} ambulo__place;

/* Of what stands in no file. */
extern const ambulo__place ambulo__nowhere;

/* Adds an error and returns `status`, so that a caller can `return` it. A NULL
 * list drops the message, never the status. `hint` may be NULL. The text is
 * printf-formatted. Without memory the first error of E_MEMORY and the first of
 * another status are kept all the same, without path and hint. */
ambulo_status ambulo__error(ambulo_diagnostics *list, ambulo_status status, ambulo__place place,
                            const char *hint, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* What a public function returns that takes a list: a failure that left no error in it since there
 * were `errors_before` is given one, about `file` (may be NULL), so that none is without; but for
 * E_ARGUMENT, a fault of the caller's program. */
ambulo_status ambulo__conclude(ambulo_diagnostics *list, size_t errors_before, ambulo_status status,
                               const char *file);
void ambulo__warning(ambulo_diagnostics *list, ambulo__place place, const char *hint,
                     const char *format, ...) __attribute__((format(printf, 4, 5)));
void ambulo__note(ambulo_diagnostics *list, ambulo__place place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Empties the list; accepts NULL. */
void ambulo__diagnostics_clear(ambulo_diagnostics *list);
/* Adds what is in `from` to `list`, in order. Either may be NULL. */
void ambulo__diagnostics_append(const ambulo_diagnostics *from, ambulo_diagnostics *list);

/* The candidate nearest to `word` in edit distance (at most a third of its
 * letters wrong, case ignored), or NULL. */
const char *ambulo__nearest(const char *word, const char *const *candidates, size_t count);

#endif
