/* base/sized.h - structures of callers, whose headers may be older than the library's.
 *
 * A structure grows at its end alone. So the first bytes of a newer one are an older one, and what
 * the older one lacks is what `_default()` says (ambulo/status.h).
 */
#ifndef AMBULO_BASE_SIZED_H
#define AMBULO_BASE_SIZED_H

#include "ambulo/status.h"

/* Defines name_fill() of a structure that is usually `...`, an initializer; `size` is its argument.
 */
#define AMBULO__FILL(name, ...)                                                                    \
  void name##_fill(name *filled, size_t size) {                                                    \
    const name usual = __VA_ARGS__;                                                                \
    ambulo__sized_fill(filled, size, &usual, sizeof usual);                                        \
  }

/* *own becomes the defaults and, over them, what `given` (NULL: nothing) says, a structure that
 * begins with its size. 0: no header had that size. */
#define AMBULO__OWN(name, own, given)                                                              \
  (*(own) = name##_default(), ambulo__sized_take(own, sizeof *(own), given))
int ambulo__sized_take(void *own, size_t full, const void *given);

/* The first `size` bytes of `usual`, zeros behind its end. */
void ambulo__sized_fill(void *filled, size_t size, const void *usual, size_t full);

/* 1: items of `size` bytes are `full` ones, or older. */
int ambulo__sized_item(size_t size, size_t full);

/* `count` items of `size` bytes each as items of `full` bytes, to be freed: `usual` sets one to its
 * defaults, given the older one. NULL: no memory, or none at all. */
typedef void ambulo__usual_item(void *item, const void *given);
void *ambulo__sized_items(const ambulo_allocator *allocator, const void *items, int count,
                          size_t size, size_t full, ambulo__usual_item *usual);

#endif
