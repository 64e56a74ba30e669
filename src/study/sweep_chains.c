/* study/sweep_chains.c - continuation chains: which case starts from which.
 *
 * A case starts from the nearest one before it that differs from it along the chain's axis
 * alone; axes that advance together (a table's columns, zip) count as one. Chains are found through
 * a hash table of all cases (open addressing, as many slots as the next power of two above twice
 * the cases), so that a million cases take a second. */
#include "formats/text_hash.h"
#include "study/sweep.h"

#include <string.h>

static const int *values_of(const ambulo_sweep *s, int index) {
  return s->value + (size_t)index * (size_t)s->stride;
}

/* the axes that advance together with the chain's: itself at least */
static ambulo__axis_group chain_group(const ambulo_sweep *s) {
  for (int g = 0; g < s->groups; g++) {
    const ambulo__axis_group *group = &s->group[g];
    if (s->chain_axis >= group->first && s->chain_axis < group->first + group->axes) return *group;
  }
  return (ambulo__axis_group){s->chain_axis, 1, 0};
}

static int in_group(const ambulo__axis_group *group, int axis) {
  return axis >= group->first && axis < group->first + group->axes;
}

/* of the values of a case, `down` places down along the chain */
static unsigned long long hash_values(const ambulo_sweep *s, const ambulo__axis_group *group,
                                      const int *value, int down) {
  unsigned long long hash = AMBULO__HASH_START;
  for (int i = 0; i < s->axes; i++)
    hash =
        ambulo__hash_word(hash, (unsigned long long)(value[i] - (in_group(group, i) ? down : 0)));
  return hash;
}

static int is_neighbour(const ambulo_sweep *s, const ambulo__axis_group *group, const int *value,
                        const int *other, int down) {
  for (int i = 0; i < s->axes; i++)
    if (other[i] != value[i] - (in_group(group, i) ? down : 0)) return 0;
  return 1;
}

/* filters may have taken away the next ones down, so it goes on to the end of the axis */
static int find_neighbour(const ambulo_sweep *s, const ambulo__axis_group *group, const int *slot,
                          size_t mask, const int *value) {
  for (int down = 1; down <= value[s->chain_axis]; down++) {
    size_t at = (size_t)hash_values(s, group, value, down) & mask;
    for (; slot[at] >= 0; at = (at + 1) & mask)
      if (is_neighbour(s, group, value, values_of(s, slot[at]), down)) return slot[at];
  }
  return -1;
}

ambulo_status ambulo__sweep_link_chains(ambulo_sweep *s) {
  if (s->chain_axis < 0) return AMBULO_OK;
  size_t slots = 2;
  while (slots < 2 * (size_t)s->case_count) slots *= 2;
  int *slot = ambulo__alloc(&s->allocator, slots, sizeof *slot);
  if (!slot) return AMBULO_E_MEMORY;
  memset(slot, 0xff, slots * sizeof *slot);
  ambulo__axis_group group = chain_group(s);
  /* a neighbour stands earlier in the list: places along an axis only grow */
  for (int k = 0; k < s->case_count; k++) {
    const int *value = values_of(s, k);
    ambulo__sweep_case *one = &s->cases[k];
    one->previous = find_neighbour(s, &group, slot, slots - 1, value);
    if (one->previous >= 0) one->key = ambulo__hash_word(one->key, s->cases[one->previous].key);
    size_t at = (size_t)hash_values(s, &group, value, 0) & (slots - 1);
    while (slot[at] >= 0) at = (at + 1) & (slots - 1);
    slot[at] = k;
  }
  ambulo__free(&s->allocator, slot);
  return AMBULO_OK;
}
