/* formats/yaml_memory.c - the memory of a document, and hashes of its keys (yaml_tree.h). */
#include "formats/yaml_tree.h"

#include <string.h>

enum { CHUNK_SIZE = 16384 };

struct ambulo__yaml_chunk {
  ambulo__yaml_chunk *next;
  size_t used, size;
  _Alignas(double) char bytes[]; /* `size` of them */
};

void *ambulo__yaml_allocate(ambulo__yaml *document, size_t count, size_t size) {
  enum { UNIT = sizeof(double) };
  if (size != 0 && count > (SIZE_MAX / 2) / size) return NULL;
  size_t bytes = (count * size + UNIT - 1) / UNIT * UNIT;
  ambulo__yaml_chunk *chunk = document->chunks;
  if (!chunk || chunk->size - chunk->used < bytes) {
    size_t room = bytes > CHUNK_SIZE ? bytes : CHUNK_SIZE;
    chunk = ambulo__alloc(&document->allocator, 1, sizeof *chunk + room);
    if (!chunk) return NULL;
    chunk->size = room;
    chunk->next = document->chunks;
    document->chunks = chunk;
  }
  void *block = chunk->bytes + chunk->used;
  chunk->used += bytes;
  return block;
}

char *ambulo__yaml_copy(ambulo__yaml *document, const char *text, size_t length) {
  char *copy = ambulo__yaml_allocate(document, length + 1, 1);
  if (copy) memcpy(copy, text, length);
  return copy;
}

void ambulo__yaml_free(ambulo__yaml *document) {
  if (!document) return;
  ambulo_allocator allocator = document->allocator;
  for (ambulo__yaml_chunk *chunk = document->chunks; chunk;) {
    ambulo__yaml_chunk *next = chunk->next;
    ambulo__free(&allocator, chunk);
    chunk = next;
  }
  ambulo__free(&allocator, document);
}

uint32_t ambulo__yaml_hash(const char *text) {
  uint32_t hash = 2166136261U;
  for (; *text; text++) hash = (hash ^ (unsigned char)*text) * 16777619U;
  return hash;
}
