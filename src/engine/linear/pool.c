/* linear/pool.c - see pool.h. A block begins with its place in the list; what it holds comes 64
 * bytes later. */
#include "linear/pool.h"

#include <stdint.h>

enum { HEADER = 64 }; /* bytes: keeps what follows aligned */

struct ambulo__pool_block {
  ambulo__pool_block *before;
};

void ambulo__pool_init(ambulo__pool *pool, const ambulo_allocator *allocator) {
  pool->allocator = ambulo__allocator_or_default(allocator);
  pool->last = NULL;
  pool->failed = 0;
}

void *ambulo__pool_blocks(ambulo__pool *pool, size_t count, size_t size) {
  ambulo__pool_block *block = NULL;
  if (!pool->failed && count <= (SIZE_MAX - HEADER) / size)
    block = ambulo__alloc_aligned(&pool->allocator, HEADER + count * size, 1);
  if (!block) {
    pool->failed = 1;
    return NULL;
  }
  block->before = pool->last;
  pool->last = block;
  return (char *)block + HEADER;
}

double *ambulo__pool_doubles(ambulo__pool *pool, size_t count) {
  return ambulo__pool_blocks(pool, count, sizeof(double));
}

int *ambulo__pool_ints(ambulo__pool *pool, size_t count) {
  return ambulo__pool_blocks(pool, count, sizeof(int));
}

void ambulo__pool_clear(ambulo__pool *pool) {
  while (pool->last) {
    ambulo__pool_block *block = pool->last;
    pool->last = block->before;
    ambulo__free_aligned(&pool->allocator, block);
  }
  pool->failed = 0;
}
