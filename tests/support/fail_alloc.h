/* tests/support/fail_alloc.h - an allocator that counts, and fails at the k-th request.
 *
 *     for (long k = 0; k < 10000; k++) {
 *       fail_alloc memory = fail_alloc_at(k);
 *       ambulo_allocator allocator = fail_alloc_hook(&memory);
 *       status = ambulo_x_create(..., &allocator, ...);
 *       if (status == AMBULO_OK) ambulo_x_free(x); else assert_int_equal(status, E_MEMORY);
 *       assert_int_equal(memory.live, 0);          nothing leaked
 *       if (!memory.failed) break;                 k was beyond the last request
 *     }
 */
#ifndef AMBULO_TESTS_FAIL_ALLOC_H
#define AMBULO_TESTS_FAIL_ALLOC_H

#include "ambulo/status.h"

#include <stdlib.h>

typedef struct fail_alloc {
  long fail_at;  /* this request (from 0) and all later ones fail; < 0: none does */
  int only_once; /* 1: later ones succeed again */
  long requests; /* allocations and growths asked for */
  long live;     /* blocks not freed yet */
  int failed;    /* whether a request was refused */
} fail_alloc;

static inline void *fail_alloc_resize(void *user, void *pointer, size_t size) {
  fail_alloc *memory = user;
  if (size == 0) {
    if (pointer) memory->live--;
    free(pointer);
    return NULL;
  }
  long request = memory->requests++;
  int fails = memory->only_once ? request == memory->fail_at : request >= memory->fail_at;
  if (memory->fail_at >= 0 && fails) {
    memory->failed = 1;
    return NULL;
  }
  void *block = realloc(pointer, size);
  if (block && !pointer) memory->live++;
  return block;
}

static inline fail_alloc fail_alloc_at(long k) {
  fail_alloc memory = {k, 0, 0, 0, 0};
  return memory;
}

static inline ambulo_allocator fail_alloc_hook(fail_alloc *memory) {
  ambulo_allocator hook = {fail_alloc_resize, memory};
  return hook;
}

#endif
