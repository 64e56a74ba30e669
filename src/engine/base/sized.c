/* base/sized.c - reading and filling structures of older headers. */
#include "base/sized.h"
#include "base/alloc.h"

#include <string.h>

int ambulo__sized_take(void *own, size_t full, const void *given) {
  size_t size;
  if (!given) return 1;
  memcpy(&size, given, sizeof size);
  if (size <= sizeof size || size > full) return 0;
  memcpy(own, given, size);
  memcpy(own, &full, sizeof full);
  return 1;
}

void ambulo__sized_fill(void *filled, size_t size, const void *usual, size_t full) {
  memcpy(filled, usual, size < full ? size : full);
  if (size > full) memset((char *)filled + full, 0, size - full);
}

int ambulo__sized_item(size_t size, size_t full) {
  return size > 0 && size <= full;
}

void *ambulo__sized_items(const ambulo_allocator *allocator, const void *items, int count,
                          size_t size, size_t full, ambulo__usual_item *usual) {
  if (!items || count < 1) return NULL;
  char *own = ambulo__alloc(allocator, (size_t)count, full);
  for (size_t i = 0; own && i < (size_t)count; i++) {
    const char *given = (const char *)items + i * size;
    usual(own + i * full, given);
    memcpy(own + i * full, given, size);
  }
  return own;
}
