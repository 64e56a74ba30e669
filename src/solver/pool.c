/* solver/pool.c - see pool.h. */
#include "solver/pool.h"

void ambulo__pool_init(ambulo__pool *pool, const ambulo_allocator *allocator) {
  pool->allocator = ambulo__allocator_or_default(allocator);
  pool->count = 0;
  pool->failed = 0;
}

static void *take(ambulo__pool *pool, size_t count, size_t size) {
  void *block = NULL;
  if (!pool->failed && pool->count < AMBULO__POOL_CAPACITY) {
    block = ambulo__alloc_aligned(&pool->allocator, count, size);
  }
  if (!block) {
    pool->failed = 1;
    return NULL;
  }
  pool->block[pool->count++] = block;
  return block;
}

double *ambulo__pool_doubles(ambulo__pool *pool, size_t count) {
  return take(pool, count, sizeof(double));
}

int *ambulo__pool_ints(ambulo__pool *pool, size_t count) {
  return take(pool, count, sizeof(int));
}

void ambulo__pool_clear(ambulo__pool *pool) {
  while (pool->count > 0) ambulo__free_aligned(&pool->allocator, pool->block[--pool->count]);
  pool->failed = 0;
}
