/* base/sized.h - structures of callers, whose headers may be older than the library's.
 *
 * A structure grows at its end alone. So the first bytes of a newer one are an older one, and what
 * the older one lacks is what `_default()` says (ambulo/status.h).
 */
#ifndef AMBULO_BASE_SIZED_H
#define AMBULO_BASE_SIZED_H

#include "ambulo/status.h"

/* A structure's defaults: `usual` of `bytes` bytes, of which the first `sizes` members are sizes.
 */
typedef struct ambulo__usual {
  const char *name;
  const void *usual;
  size_t bytes;
  int sizes;
} ambulo__usual;

/* ambulo_defaults from a table. */
ambulo_status ambulo__defaults_of(const ambulo__usual *table, int count, const char *name,
                                  void *structure, size_t bytes);

/* *own becomes the defaults and, over them, what `given` (NULL: nothing) says, a structure that
 * begins with its size. 0: no header had that size. */
#define AMBULO__OWN(name, own, given)                                                              \
  (*(own) = name##_default(), ambulo__sized_take(own, sizeof *(own), given))
int ambulo__sized_take(void *own, size_t full, const void *given);

/* The first `size` bytes of `usual`, zeros behind its end. */
void ambulo__sized_fill(void *filled, size_t size, const void *usual, size_t full);

/* 1: items of `size` bytes are `full` ones, or older. */
int ambulo__sized_item(size_t size, size_t full);

/* `count` items of the structure `name`, `size` bytes each, as items of `full` bytes, to be freed:
 * what they lack is what ambulo_defaults says. NULL: no memory, or none at all. */
void *ambulo__sized_items(const ambulo_allocator *allocator, const void *items, int count,
                          size_t size, size_t full, const char *name);

#endif
