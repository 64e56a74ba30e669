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
                          size_t size, size_t full, const char *name) {
  if (!items || count < 1) return NULL;
  char *own = ambulo__alloc(allocator, (size_t)count, full);
  for (size_t i = 0; own && i < (size_t)count; i++) {
    char *item = own + i * full;
    ambulo_defaults(name, item, full);
    memcpy(item, (const char *)items + i * size, size);
  }
  return own;
}

ambulo_status ambulo__defaults_of(const ambulo__usual *table, int count, const char *name,
                                  void *structure, size_t bytes) {
  const ambulo__usual *row = table;
  if (!name || !structure) return AMBULO_E_ARGUMENT;
  while (row < table + count && strcmp(row->name, name) != 0) row++;
  size_t sizes = row < table + count ? (size_t)row->sizes * sizeof(size_t) : 0;
  if (row == table + count || bytes < sizes) return AMBULO_E_ARGUMENT;
  ambulo__sized_fill((char *)structure + sizes, bytes - sizes, (const char *)row->usual + sizes,
                     row->bytes - sizes);
  if (sizes) memcpy(structure, &bytes, sizeof bytes);
  return AMBULO_OK;
}
