/* base/alloc.c - see alloc.h. */
#include "base/alloc.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64 };

static void *default_resize(void *user, void *pointer, size_t size) {
  (void)user;
  if (size == 0) {
    free(pointer);
    return NULL;
  }
  return realloc(pointer, size);
}

ambulo_allocator ambulo__allocator_or_default(const ambulo_allocator *allocator) {
  if (allocator && allocator->resize) return *allocator;
  ambulo_allocator standard = {default_resize, NULL};
  return standard;
}

/* bytes of count items; 0 when the product overflows, at least 1 otherwise */
static size_t total_size(size_t count, size_t size) {
  if (size != 0 && count > (SIZE_MAX - 2 * ALIGNMENT) / size) return 0;
  size_t total = count * size;
  return total > 0 ? total : 1;
}

void *ambulo__alloc(const ambulo_allocator *allocator, size_t count, size_t size) {
  size_t total = total_size(count, size);
  void *pointer = total ? allocator->resize(allocator->user, NULL, total) : NULL;
  if (pointer) memset(pointer, 0, total);
  return pointer;
}

/* the block handed out is preceded by the pointer that the hook gave */
void *ambulo__alloc_aligned(const ambulo_allocator *allocator, size_t count, size_t size) {
  size_t total = total_size(count, size);
  if (!total) return NULL;
  char *raw = allocator->resize(allocator->user, NULL, total + ALIGNMENT + sizeof(void *));
  if (!raw) return NULL;
  uintptr_t start = (uintptr_t)raw + sizeof(void *);
  size_t shift = (ALIGNMENT - start % ALIGNMENT) % ALIGNMENT;
  char *aligned = raw + sizeof(void *) + shift;
  memcpy(aligned - sizeof(void *), &raw, sizeof raw);
  memset(aligned, 0, total);
  return aligned;
}

void *ambulo__realloc(const ambulo_allocator *allocator, void *pointer, size_t count, size_t size) {
  size_t total = total_size(count, size);
  return total ? allocator->resize(allocator->user, pointer, total) : NULL;
}

void ambulo__free(const ambulo_allocator *allocator, void *pointer) {
  if (pointer) (void)allocator->resize(allocator->user, pointer, 0);
}

void ambulo__free_aligned(const ambulo_allocator *allocator, void *pointer) {
  if (!pointer) return;
  char *raw;
  memcpy(&raw, (char *)pointer - sizeof(void *), sizeof raw);
  ambulo__free(allocator, raw);
}

char *ambulo__strdup(const ambulo_allocator *allocator, const char *text) {
  size_t size = strlen(text) + 1;
  char *copy = ambulo__alloc(allocator, size, 1);
  if (copy) memcpy(copy, text, size);
  return copy;
}
