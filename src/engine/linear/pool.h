/* linear/pool.h - the memory of one solve: many blocks, one failure flag, one free.
 *
 * Everything a solve needs is taken here before its first iteration; the loops then
 * allocate nothing. */
#ifndef AMBULO_LINEAR_POOL_H
#define AMBULO_LINEAR_POOL_H

#include "base/alloc.h"

typedef struct ambulo__pool_block ambulo__pool_block;

typedef struct ambulo__pool {
  ambulo_allocator allocator;
  ambulo__pool_block *last; /* of a list of any length */
  int failed;               /* sticky: some block could not be had */
} ambulo__pool;

void ambulo__pool_init(ambulo__pool *pool, const ambulo_allocator *allocator);
/* Zero-filled, 64-byte aligned; NULL (and pool->failed) when memory is out. */
double *ambulo__pool_doubles(ambulo__pool *pool, size_t count);
int *ambulo__pool_ints(ambulo__pool *pool, size_t count);
/* The same, of anything. */
void *ambulo__pool_blocks(ambulo__pool *pool, size_t count, size_t size);
void ambulo__pool_clear(ambulo__pool *pool);

#endif
