/* tests/support/older.h - arrays as a program of an older header has them: shorter items, close
 * together, and nothing behind the last one (a copy of its own size, for the sanitizer). */
#ifndef AMBULO_TESTS_OLDER_H
#define AMBULO_TESTS_OLDER_H

#include <stdlib.h>
#include <string.h>

/* the first `size` bytes of each of `count` items of `full` bytes; to be freed */
static inline void *older_items(const void *items, int count, size_t full, size_t size) {
  char *older = malloc((size_t)count * size);
  for (size_t i = 0; older && i < (size_t)count; i++)
    memcpy(older + i * size, (const char *)items + i * full, size);
  return older;
}

#endif
