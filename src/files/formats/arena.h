/* formats/arena.h - memory of one document or import: cut from chunks, freed together.
 *
 * A tree that is abandoned half-way needs no unwinding. Failures stick: after the first one every
 * request yields NULL, and `failed` is 1. */
#ifndef AMBULO_FORMATS_ARENA_H
#define AMBULO_FORMATS_ARENA_H

#include "base/alloc.h"

#include <stdarg.h>

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
/* printf into the arena; "" when memory runs out, never NULL. */
const char *ambulo__arena_print(ambulo__arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
const char *ambulo__arena_vprint(ambulo__arena *arena, const char *format, va_list arguments)
    __attribute__((format(printf, 2, 0)));
/* Makes room for one more item in the list whose pointer is at `list`: a full list moves to a block
 * of twice the size. Returns 0 when memory runs out. */
int ambulo__arena_grow(ambulo__arena *arena, void *list, int count, int *capacity, size_t size);

#endif
