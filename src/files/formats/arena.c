/* formats/arena.c - memory cut from chunks (arena.h). */
#include "formats/arena.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { CHUNK = 32768, UNIT = sizeof(double) };

struct ambulo__arena_chunk {
  ambulo__arena_chunk *next;
  size_t used, size;
  _Alignas(double) char bytes[]; /* `size` of them */
};

void *ambulo__arena_take(ambulo__arena *arena, size_t count, size_t size) {
  if (arena->failed || (size != 0 && count > (SIZE_MAX / 4) / size)) {
    arena->failed = 1;
    return NULL;
  }
  size_t bytes = (count * size + UNIT - 1) / UNIT * UNIT;
  ambulo__arena_chunk *chunk = arena->chunks;
  if (!chunk || chunk->size - chunk->used < bytes) {
    size_t room = bytes > CHUNK ? bytes : CHUNK;
    chunk = ambulo__alloc(&arena->allocator, 1, sizeof *chunk + room);
    if (!chunk) {
      arena->failed = 1;
      return NULL;
    }
    chunk->size = room;
    chunk->next = arena->chunks;
    arena->chunks = chunk;
  }
  void *block = chunk->bytes + chunk->used;
  chunk->used += bytes;
  return block;
}

char *ambulo__arena_copy(ambulo__arena *arena, const char *text, size_t length) {
  char *copy = ambulo__arena_take(arena, length + 1, 1);
  if (copy) memcpy(copy, text, length);
  return copy;
}

const char *ambulo__arena_vprint(ambulo__arena *arena, const char *format, va_list arguments) {
  va_list again;
  va_copy(again, arguments);
  int length = vsnprintf(NULL, 0, format, arguments);
  char *text = length < 0 ? NULL : ambulo__arena_take(arena, (size_t)length + 1, 1);
  if (text) (void)vsnprintf(text, (size_t)length + 1, format, again);
  va_end(again);
  return text ? text : "";
}

const char *ambulo__arena_print(ambulo__arena *arena, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const char *text = ambulo__arena_vprint(arena, format, arguments);
  va_end(arguments);
  return text;
}

int ambulo__arena_grow(ambulo__arena *arena, void *list, int count, int *capacity, size_t size) {
  if (count < *capacity) return 1;
  int room = *capacity ? 2 * *capacity : 16;
  void *own, *larger = ambulo__arena_take(arena, (size_t)room, size);
  if (!larger) return 0;
  memcpy(&own, list, sizeof own);
  if (count) memcpy(larger, own, (size_t)count * size);
  memcpy(list, &larger, sizeof larger);
  *capacity = room;
  return 1;
}

void ambulo__arena_free(ambulo__arena *arena) {
  for (ambulo__arena_chunk *chunk = arena->chunks; chunk;) {
    ambulo__arena_chunk *next = chunk->next;
    ambulo__free(&arena->allocator, chunk);
    chunk = next;
  }
  arena->chunks = NULL;
}
