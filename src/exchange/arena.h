/* exchange/arena.h - memory of one import: cut from chunks, freed together.
 *
 * Failures stick: after the first one every request yields NULL, and `failed` tells at the end. */
#ifndef AMBULO_EXCHANGE_ARENA_H
#define AMBULO_EXCHANGE_ARENA_H

#include <stdarg.h>

#include "base/alloc.h"

typedef struct ambulo__arena_chunk ambulo__arena_chunk;
typedef struct ambulo__arena {
  ambulo_allocator allocator;
  ambulo__arena_chunk *chunks;
  int failed;
} ambulo__arena;

void ambulo__arena_free(ambulo__arena *arena); /* accepts a zero-filled one */

/* Zero-filled, aligned for doubles and pointers. */
void *ambulo__arena_take(ambulo__arena *arena, size_t count, size_t size);
/* Copy of text[0..length) with a NUL. */
char *ambulo__arena_copy(ambulo__arena *arena, const char *text, size_t length);
/* printf; "" for want of memory, never NULL. */
const char *ambulo__arena_print(ambulo__arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
const char *ambulo__arena_vprint(ambulo__arena *arena, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));
/* A list with room for one more item: itself, or twice as large and elsewhere. NULL: no memory. */
void *ambulo__arena_grow(ambulo__arena *arena, void *list, int count, int *capacity, size_t size);

#endif
