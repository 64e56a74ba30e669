/* tests/support/fail_sites.h - memory that gives out at each place of the program that asks for it.
 *
 * A call is run once to learn which of its requests come from a new place: another chain of callers
 * than those before, over the last few of them. Then it is run again for each of these, which is
 * refused. Every branch that a refused request enters is entered, in a fraction of the runs that it
 * takes to refuse one request after the other. Places that were tried before are not tried again
 * while the same `fail_sites` is used.
 */
#ifndef AMBULO_TESTS_FAIL_SITES_H
#define AMBULO_TESTS_FAIL_SITES_H

#include "support/fail_alloc.h"
#include "support/test.h"

#if defined(__GLIBC__) || defined(__APPLE__)
#include <execinfo.h>
#endif

enum { FAIL_SITES_TABLE = 1 << 14, FAIL_SITES_MOST = 4096, FAIL_SITES_CALLERS = 9 };

typedef struct fail_sites {
  fail_alloc memory;
  size_t seen[FAIL_SITES_TABLE]; /* hashes of chains; 0: free */
  long request[FAIL_SITES_MOST]; /* the first one of each new place */
  int count;
  int step; /* of slow calls each step-th new place is tried; 0: each */
} fail_sites;

/* 0: this chain of callers is known */
static inline int fail_sites_learn(fail_sites *sites) {
#if defined(__GLIBC__) || defined(__APPLE__)
  void *callers[FAIL_SITES_CALLERS];
  int depth = backtrace(callers, FAIL_SITES_CALLERS);
  size_t hash = 1469598103934665603U;
  for (int i = 2; i < depth; i++) hash = (hash ^ (size_t)callers[i]) * 1099511628211U;
  size_t at = hash % FAIL_SITES_TABLE;
  for (; sites->seen[at]; at = (at + 1) % FAIL_SITES_TABLE)
    if (sites->seen[at] == hash) return 0;
  sites->seen[at] = hash;
  return 1;
#else
  return sites->memory.requests < 100 || sites->memory.requests % 17 == 0;
#endif
}

static inline void *fail_sites_resize(void *user, void *pointer, size_t size) {
  fail_sites *sites = user;
  if (size > 0 && sites->count < FAIL_SITES_MOST && fail_sites_learn(sites))
    sites->request[sites->count++] = sites->memory.requests;
  return fail_alloc_resize(&sites->memory, pointer, size);
}

typedef ambulo_status (*fail_sites_call)(const ambulo_allocator *allocator, void *data);

/* Runs the call, and returns how many requests, in `request`, come from new places. */
static inline int fail_sites_find(fail_sites *sites, fail_sites_call call, void *data) {
  sites->memory = fail_alloc_at(-1);
  sites->count = 0;
  ambulo_allocator learning = {fail_sites_resize, sites};
  assert_int_equal(call(&learning, data), AMBULO_OK);
  assert_int_equal(sites->memory.live, 0);
  return sites->count;
}

/* E_MEMORY, and nothing leaked, where a request and all that follow are refused; where one alone
 * is, what needs no more than a hint may succeed. Returns how many new places the call has. */
static inline int fail_at_every_site(fail_sites *sites, fail_sites_call call, void *data,
                                     int ways) {
  int count = fail_sites_find(sites, call, data);
  for (int i = 0; i<count; i += sites->step> 1 ? sites->step : 1) {
    for (int alone = 0; alone < ways; alone++) {
      fail_alloc memory = fail_alloc_at(sites->request[i]);
      memory.only_once = alone;
      ambulo_allocator hook = fail_alloc_hook(&memory);
      ambulo_status status = call(&hook, data);
      if (status != AMBULO_E_MEMORY && !(alone && status == AMBULO_OK))
        print_error("request %ld: %s\n", sites->request[i], ambulo_status_name(status));
      assert_true(status == AMBULO_E_MEMORY || (alone && status == AMBULO_OK));
      assert_int_equal(memory.live, 0);
    }
  }
  return count;
}

#endif
