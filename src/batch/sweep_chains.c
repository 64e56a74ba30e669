/* batch/sweep_chains.c - continuation chains: which case starts from which.
 *
 * A case starts from the one that differs from it along the chain's axis alone, by one place
 * down. Chains are found through a hash table of all cases (open addressing, as many slots as
 * the next power of two above twice the cases), so that a million cases take a second. */
#include "batch/paths.h"
#include "batch/sweep.h"

#include <string.h>

static const int *values_of(const ambulo_sweep *s, int index) {
  return s->value + (size_t)index * (size_t)s->stride;
}

/* of the values of a case, with `place` on the chain's axis */
static unsigned long long hash_values(const ambulo_sweep *s, const int *value, int place) {
  unsigned long long hash = AMBULO__HASH_START;
  for (int i = 0; i < s->axes; i++)
    hash = ambulo__hash_word(hash, (unsigned long long)(i == s->chain_axis ? place : value[i]));
  return hash;
}

static int is_neighbour(const ambulo_sweep *s, const int *value, const int *other) {
  for (int i = 0; i < s->axes; i++)
    if (other[i] != value[i] - (i == s->chain_axis)) return 0;
  return 1;
}

static int find_neighbour(const ambulo_sweep *s, const int *slot, size_t mask, const int *value) {
  size_t at = (size_t)hash_values(s, value, value[s->chain_axis] - 1) & mask;
  for (; slot[at] >= 0; at = (at + 1) & mask)
    if (is_neighbour(s, value, values_of(s, slot[at]))) return slot[at];
  return -1;
}

ambulo_status ambulo__sweep_link_chains(ambulo_sweep *s) {
  if (s->chain_axis < 0) return AMBULO_OK;
  size_t slots = 2;
  while (slots < 2 * (size_t)s->case_count) slots *= 2;
  int *slot = ambulo__alloc(&s->allocator, slots, sizeof *slot);
  if (!slot) return AMBULO_E_MEMORY;
  memset(slot, 0xff, slots * sizeof *slot);
  /* a neighbour stands earlier in the list: places along an axis only grow */
  for (int k = 0; k < s->case_count; k++) {
    const int *value = values_of(s, k);
    ambulo__sweep_case *one = &s->cases[k];
    if (value[s->chain_axis] > 0) one->previous = find_neighbour(s, slot, slots - 1, value);
    if (one->previous >= 0) one->key = ambulo__hash_word(one->key, s->cases[one->previous].key);
    size_t at = (size_t)hash_values(s, value, value[s->chain_axis]) & (slots - 1);
    while (slot[at] >= 0) at = (at + 1) & (slots - 1);
    slot[at] = k;
  }
  ambulo__free(&s->allocator, slot);
  return AMBULO_OK;
}
