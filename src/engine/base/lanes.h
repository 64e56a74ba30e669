/* base/lanes.h - blocks of time nodes.
 *
 * Every per-node quantity is stored [block][entry][lane] with AMBULO__LANES time
 * nodes in a block, lane innermost: node k is lane k % 8 of block k / 8, and entry
 * e of it stands at base[((k / 8) * entries + e) * 8 + k % 8]. The last block is
 * padded, with copies of the last node where nothing else is said, so that kernels never
 * meet garbage. */
#ifndef AMBULO_BASE_LANES_H
#define AMBULO_BASE_LANES_H

#include <stddef.h>

#define AMBULO__LANES 8

/* Number of blocks that hold `nodes` nodes. */
static inline int ambulo__block_count(int nodes) {
  return (nodes + AMBULO__LANES - 1) / AMBULO__LANES;
}

/* Index of (node, entry) in an array with `entries` entries per node. */
static inline size_t ambulo__lane_index(int node, int entries, int entry) {
  size_t block = (size_t)node / AMBULO__LANES;
  return (block * (size_t)entries + (size_t)entry) * AMBULO__LANES + (size_t)node % AMBULO__LANES;
}

#endif
