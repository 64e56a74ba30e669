/* linear/row_blocks.c - see row_blocks.h. */
#include "linear/row_blocks.h"

enum { KINDS = 2 }; /* of blocks of a node: of q alone, of q, qd and qdd */

static int kind_of(int host, int orders) {
  return KINDS * host + (orders == 1 ? 0 : 1);
}

/* counts of the rows of each node and kind into block_at, then the blocks themselves; block_at then
 * has their numbers */
static void lay_out(ambulo__row_blocks *b, int rows, const int *host, const int *orders,
                    int *block_at) {
  const int kinds = KINDS * b->problem->nodes;
  int first = 0;
  for (int i = 0; i < rows; i++) {
    if (orders[i]) block_at[kind_of(host[i], orders[i])]++;
  }
  for (int k = 0; k < kinds; k++) {
    int count = block_at[k];
    block_at[k] = b->count;
    if (count == 0) continue;
    b->block[b->count++] = (ambulo__row_block){.node = k / KINDS,
                                               .orders = k % KINDS ? 3 : 1,
                                               .width = ambulo__whole_tiles(count),
                                               .first = first};
    first += count;
  }
}

static void list_members(ambulo__row_blocks *b, int rows, const int *host, const int *orders,
                         const int *block_at) {
  for (int i = 0; i < rows; i++) {
    b->block_of[i] = orders[i] ? block_at[kind_of(host[i], orders[i])] : -1;
    if (b->block_of[i] < 0) continue;
    ambulo__row_block *block = &b->block[b->block_of[i]];
    b->place_of[i] = block->count++;
    b->member[block->first + b->place_of[i]] = i;
  }
}

ambulo_status ambulo__row_blocks_create(const ambulo_problem *p, int rows, const int *host,
                                        const int *orders, ambulo__pool *pool,
                                        ambulo__row_blocks *b) {
  size_t n = (size_t)rows, d = (size_t)p->coordinates;
  size_t kinds = KINDS * (size_t)p->nodes, most = n < kinds ? n : kinds;
  *b = (ambulo__row_blocks){.problem = p, .kernels = ambulo__band_kernels_select()};
  int *block_at = ambulo__pool_ints(pool, kinds), widest = 0;
  b->block = ambulo__pool_blocks(pool, most, sizeof *b->block);
  b->member = ambulo__pool_ints(pool, n);
  b->block_of = ambulo__pool_ints(pool, n);
  b->place_of = ambulo__pool_ints(pool, n);
  b->motion = ambulo__pool_doubles(pool, 3 * d);
  if (pool->failed) return AMBULO_E_MEMORY;
  lay_out(b, rows, host, orders, block_at);
  list_members(b, rows, host, orders, block_at);
  for (int k = 0; k < b->count; k++) {
    ambulo__row_block *block = &b->block[k];
    block->slope = ambulo__pool_doubles(pool, (size_t)block->orders * d * (size_t)block->width);
    if (block->width > widest) widest = block->width;
  }
  b->product = ambulo__pool_doubles(pool, (size_t)widest);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__row_blocks_keep(ambulo__row_blocks *b, int row, const double *slopes) {
  const ambulo__row_block *block = &b->block[b->block_of[row]];
  double *to = block->slope + b->place_of[row];
  const size_t entries = (size_t)(block->orders * b->problem->coordinates);
  for (size_t e = 0; e < entries; e++) to[e * (size_t)block->width] = slopes[e];
}

/* q, qd and qdd of control points at a node */
static void form_motion(const ambulo__row_blocks *b, int node, const double *x) {
  const ambulo__basis_point *point = &ambulo__lane_map_points(b->problem->map)[node];
  const int d = b->problem->coordinates;
  const double *at = x + ambulo__node_first(b->problem, node);
  double *restrict q = b->motion, *restrict qd = q + d, *restrict qdd = qd + d;
  for (int i = 0; i < d; i++) q[i] = qd[i] = qdd[i] = 0.0;
  for (int c = 0; c < point->span; c++, at += d) {
    const double b0 = point->weight[0][c], b1 = point->weight[1][c], b2 = point->weight[2][c];
    for (int i = 0; i < d; i++) {
      q[i] += b0 * at[i];
      qd[i] += b1 * at[i];
      qdd[i] += b2 * at[i];
    }
  }
}

/* y = W'x, W [n][width] */
static void gather(int n, int width, const double *w, const double *x, double *restrict y) {
  for (int v = 0; v < width; v++) y[v] = 0.0;
  for (int e = 0; e < n; e++, w += width) {
    for (int v = 0; v < width; v++) y[v] += w[v] * x[e];
  }
}

void ambulo__row_blocks_multiply(const ambulo__row_blocks *b, const double *scale, const double *d,
                                 double *out) {
  int node = -1;
  for (int k = 0; k < b->count; k++) {
    const ambulo__row_block *block = &b->block[k];
    const int *member = b->member + block->first, entries = block->orders * b->problem->coordinates;
    if (block->node != node) form_motion(b, block->node, d);
    node = block->node;
    if (b->kernels) {
      b->kernels->gather(entries, block->width, block->slope, b->motion, b->product);
    } else {
      gather(entries, block->width, block->slope, b->motion, b->product);
    }
    for (int j = 0; j < block->count; j++) out[member[j]] = scale[member[j]] * b->product[j];
  }
}
