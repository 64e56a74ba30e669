/* linear/row_blocks.c - see row_blocks.h. */
#include "linear/row_blocks.h"
#include "base/arithmetic.h"
#include "linear/sparse_rows.h"

#include <string.h>

enum { KINDS = 2 }; /* of blocks of a node: of q alone, of q, qd and qdd */

static int kind_of(const ambulo__row_shape *shape) {
  return KINDS * shape->host + (shape->orders == 1 ? 0 : 1);
}

/* counts of the rows of each node and kind into block_at, then the blocks themselves; block_at then
 * has their numbers */
static void lay_out(ambulo__row_blocks *b, int rows, int *block_at) {
  const int kinds = KINDS * b->problem->nodes;
  int first = 0;
  for (int i = 0; i < rows; i++) {
    if (b->shape[i].orders) block_at[kind_of(&b->shape[i])]++;
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

static void list_members(ambulo__row_blocks *b, int rows, const int *block_at) {
  for (int i = 0; i < rows; i++) {
    b->block_of[i] = b->shape[i].orders ? block_at[kind_of(&b->shape[i])] : -1;
    if (b->block_of[i] < 0) continue;
    ambulo__row_block *block = &b->block[b->block_of[i]];
    b->place_of[i] = block->count++;
    b->member[block->first + b->place_of[i]] = i;
  }
}

/* the coordinates of all of a block's rows, and room for their slopes */
static int lay_slopes(ambulo__row_blocks *b, ambulo__row_block *block, ambulo__pool *pool) {
  const int d = b->problem->coordinates, first = ambulo__node_first(b->problem, block->node);
  block->place = ambulo__pool_ints(pool, (size_t)d);
  block->coordinate = ambulo__pool_ints(pool, (size_t)d);
  if (pool->failed) return 1;
  for (int j = 0; j < block->count; j++) {
    const ambulo__row_shape *shape = &b->shape[b->member[block->first + j]];
    for (int e = 0; e < shape->support; e++) block->place[shape->column[e] - first] = 1;
  }
  for (int i = 0; i < d; i++) {
    int is = block->place[i];
    block->place[i] = block->support;
    if (is) block->coordinate[block->support++] = i;
  }
  size_t entries = (size_t)(block->orders * block->support);
  block->slope = ambulo__pool_doubles(pool, entries * (size_t)block->width);
  return pool->failed;
}

static int is_limit(const ambulo__row_shape *shape) {
  return shape->orders == 0 && shape->entry >= 0;
}

/* by counting: at first limit_first[k + 1] is where those of node k end, then where they begin */
static void list_limits(ambulo__row_blocks *b, int rows) {
  const int nodes = b->problem->nodes;
  int total = 0;
  for (int i = 0; i < rows; i++) {
    if (!is_limit(&b->shape[i])) continue;
    b->limit_first[b->shape[i].host + 1]++;
    total++;
  }
  for (int k = 0; k < nodes; k++) b->limit_first[k + 1] += b->limit_first[k];
  for (int i = rows - 1; i >= 0; i--) {
    if (is_limit(&b->shape[i])) b->limit[--b->limit_first[b->shape[i].host + 1]] = i;
  }
  for (int k = 0; k < nodes; k++) b->limit_first[k] = b->limit_first[k + 1];
  b->limit_first[nodes] = total;
}

/* how much of the motion of its host a row needs */
static int orders_of(const ambulo_problem *p, const ambulo__table_row *row) {
  const ambulo__row_term *term = p->table.terms + row->first_term;
  const ambulo__curved *curved = ambulo__row_curved_of(&p->table, row);
  int channel[AMBULO__CURVED_CHANNELS], most = 1;
  if (row->user >= 0 && !curved) return 3;
  int count = curved ? ambulo__curved_channels(curved, channel) : row->term_count;
  for (int k = 0; k < count; k++) {
    int orders = ambulo__channel_orders(p, curved ? channel[k] : term[k].channel);
    if (orders > most) most = orders;
  }
  return most;
}

/* others than limits on one number, of linear rows, are left to their gradients, which are short */
static ambulo__row_shape shape_of(const ambulo__sparse_rows *s, int i) {
  const ambulo_problem *p = s->problem;
  const ambulo__table_row *row = &p->table.rows[s->row[i]];
  const ambulo__row_term *term = p->table.terms + row->first_term;
  ambulo__row_shape shape = {.host = s->host[i], .entry = -1};
  if (s->support[i] == 0) return shape;
  shape.support = s->support[i];
  shape.column = s->column + s->start[i];
  if (!s->constant[i]) {
    shape.orders = orders_of(p, row);
  } else if (row->term_count == 1) {
    shape.entry = term->channel;
    shape.coefficient = term->coefficient;
  }
  return shape;
}

ambulo_status ambulo__row_blocks_create(const ambulo__sparse_rows *s, ambulo__pool *pool,
                                        ambulo__row_blocks *b) {
  const ambulo_problem *p = s->problem;
  const int rows = s->count;
  size_t n = (size_t)rows, d = (size_t)p->coordinates;
  size_t kinds = KINDS * (size_t)p->nodes, most = n < kinds ? n : kinds;
  *b = (ambulo__row_blocks){.problem = p, .kernels = ambulo__band_kernels_select()};
  b->shape = ambulo__pool_blocks(pool, n, sizeof *b->shape);
  int *block_at = ambulo__pool_ints(pool, kinds), widest = 0;
  b->block = ambulo__pool_blocks(pool, most, sizeof *b->block);
  b->member = ambulo__pool_ints(pool, n);
  b->block_of = ambulo__pool_ints(pool, n);
  b->place_of = ambulo__pool_ints(pool, n);
  b->limit = ambulo__pool_ints(pool, n);
  b->limit_first = ambulo__pool_ints(pool, (size_t)p->nodes + 1);
  b->motion = ambulo__pool_doubles(pool, 3 * d);
  b->part = ambulo__pool_doubles(pool, 3 * d);
  if (pool->failed) return AMBULO_E_MEMORY;
  for (int i = 0; i < rows; i++) b->shape[i] = shape_of(s, i);
  lay_out(b, rows, block_at);
  list_members(b, rows, block_at);
  list_limits(b, rows);
  for (int k = 0; k < b->count; k++) {
    if (lay_slopes(b, &b->block[k], pool)) return AMBULO_E_MEMORY;
    if (b->block[k].width > widest) widest = b->block[k].width;
  }
  b->product = ambulo__pool_doubles(pool, (size_t)widest);
  return pool->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__row_blocks_keep(ambulo__row_blocks *b, int row, const double *slopes) {
  const ambulo__row_block *block = &b->block[b->block_of[row]];
  const size_t width = (size_t)block->width;
  double *to = block->slope + b->place_of[row];
  for (int o = 0; o < block->orders; o++, slopes += b->problem->coordinates) {
    for (int u = 0; u < block->support; u++, to += width) *to = slopes[block->coordinate[u]];
  }
}

void ambulo__row_blocks_recall(const ambulo__row_blocks *b, int row, double *slopes) {
  const ambulo__row_block *block = &b->block[b->block_of[row]];
  const ambulo__row_shape *shape = &b->shape[row];
  const int first = ambulo__node_first(b->problem, block->node), width = block->width;
  const double *from = block->slope + b->place_of[row];
  for (int o = 0; o < block->orders; o++, from += block->support * width) {
    for (int e = 0; e < shape->support; e++)
      *slopes++ = from[block->place[shape->column[e] - first] * width];
  }
}

int ambulo__row_blocks_finite(const ambulo__row_blocks *b) {
  for (int k = 0; k < b->count; k++) {
    const ambulo__row_block *block = &b->block[k];
    size_t entries = (size_t)(block->orders * block->support) * (size_t)block->width;
    if (!ambulo__all_finite(block->slope, entries)) return 0;
  }
  return 1;
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

/* the motion of the block's coordinates */
static const double *part_of_motion(const ambulo__row_blocks *b, const ambulo__row_block *block) {
  const int d = b->problem->coordinates;
  double *to = b->part;
  if (block->support == d) return b->motion;
  for (int o = 0; o < block->orders; o++) {
    for (int u = 0; u < block->support; u++) *to++ = b->motion[o * d + block->coordinate[u]];
  }
  return b->part;
}

static void multiply_block(const ambulo__row_blocks *b, const ambulo__row_block *block,
                           const double *scale, double *out) {
  const int *member = b->member + block->first, entries = block->orders * block->support;
  const double *motion = part_of_motion(b, block);
  b->kernels->gather(entries, block->width, block->slope, motion, b->product);
  for (int j = 0; j < block->count; j++) out[member[j]] = scale[member[j]] * b->product[j];
}

void ambulo__row_blocks_multiply(const ambulo__row_blocks *b, const double *scale, const double *d,
                                 double *out) {
  int k = 0;
  for (int node = 0; node < b->problem->nodes; node++) {
    form_motion(b, node, d);
    for (; k < b->count && b->block[k].node == node; k++)
      multiply_block(b, &b->block[k], scale, out);
    for (int l = b->limit_first[node]; l < b->limit_first[node + 1]; l++) {
      const int i = b->limit[l];
      out[i] = scale[i] * b->shape[i].coefficient * b->motion[b->shape[i].entry];
    }
  }
}
