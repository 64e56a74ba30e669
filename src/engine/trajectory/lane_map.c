/* trajectory/lane_map.c - the sparse maps of lane_map.h, node by node.
 *
 * A node touches 3 or 4 control points (on a breakpoint or between two), each a contiguous
 * row of d numbers. Per node and coordinate i, with w the node's weights,
 *
 *     D^o q_i = sum_k w[o][k] x[first + k][i]                    forward, o = 0..2
 *     gx[first + k][i] += sum_o w[o][k] g_o,i                    transpose
 *
 * Working through whole blocks with lanes as vectors was measured and is slower by a
 * factor of seven: the 8 nodes of a block share few control points, so most of a common
 * window's weights are zero. Instead the loop over coordinates runs over contiguous
 * memory. All nodes of cubic and lower bases are widened to exactly four control points (a
 * weight of zero costs less than a loop), the window shifted so that it stays within x;
 * wider bases take the general loops. */
#include "trajectory/lane_map.h"

/* a node's map on exactly four control points; [order][control point] */
typedef struct quad {
  size_t first;
  double weight[3][4];
} quad;

struct ambulo__lane_map {
  ambulo_allocator allocator;
  int nodes, coordinates;
  ambulo__basis_point *points; /* [blocks * 8] */
  quad *quads;                 /* [blocks * 8]; NULL when some node needs more than four */
};

static void fill_quads(ambulo__lane_map *map, int count, int control_points) {
  for (int k = 0; k < count; k++) {
    const ambulo__basis_point *point = &map->points[k];
    int first = point->first + 4 > control_points ? control_points - 4 : point->first;
    map->quads[k].first = (size_t)first;
    for (int order = 0; order < 3; order++) {
      for (int c = 0; c < point->span; c++) {
        map->quads[k].weight[order][point->first - first + c] = point->weight[order][c];
      }
    }
  }
}

ambulo_status ambulo__lane_map_create(const ambulo__basis *basis, const double *times, int nodes,
                                      int coordinates, const ambulo_allocator *allocator,
                                      ambulo__lane_map **map) {
  if (!basis || !times || !map || nodes < 1 || coordinates < 1) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__lane_map *m = ambulo__alloc(&own, 1, sizeof *m);
  if (!m) return AMBULO_E_MEMORY;
  m->allocator = own;
  m->nodes = nodes;
  m->coordinates = coordinates;
  int padded = ambulo__block_count(nodes) * AMBULO__LANES;
  m->points = ambulo__alloc(&own, (size_t)padded, sizeof *m->points);
  int narrow = ambulo__basis_span(basis) <= 4;
  if (narrow) m->quads = ambulo__alloc(&own, (size_t)padded, sizeof *m->quads);
  if (!m->points || (narrow && !m->quads)) {
    ambulo__lane_map_free(m);
    return AMBULO_E_MEMORY;
  }
  for (int k = 0; k < nodes; k++) ambulo__basis_at(basis, times[k], &m->points[k]);
  for (int k = nodes; k < padded; k++) m->points[k] = m->points[nodes - 1];
  if (narrow) fill_quads(m, padded, ambulo__basis_control_points(basis));
  *map = m;
  return AMBULO_OK;
}

void ambulo__lane_map_free(ambulo__lane_map *map) {
  if (!map) return;
  ambulo_allocator allocator = map->allocator;
  ambulo__free(&allocator, map->points);
  ambulo__free(&allocator, map->quads);
  ambulo__free(&allocator, map);
}

const ambulo__basis_point *ambulo__lane_map_points(const ambulo__lane_map *map) {
  return map->points;
}

/* ------------------------------------------------------------------- forward */

static void forward_quad(const quad *node, int d, const double *restrict x, double *restrict q,
                         double *restrict qd, double *restrict qdd) {
  const double(*w)[4] = node->weight;
  const double a0 = w[0][0], a1 = w[0][1], a2 = w[0][2], a3 = w[0][3];
  const double b0 = w[1][0], b1 = w[1][1], b2 = w[1][2], b3 = w[1][3];
  const double c0 = w[2][0], c1 = w[2][1], c2 = w[2][2], c3 = w[2][3];
  const double *x0 = x + node->first * (size_t)d, *x1 = x0 + d, *x2 = x1 + d, *x3 = x2 + d;
  for (int i = 0; i < d; i++) {
    double p0 = x0[i], p1 = x1[i], p2 = x2[i], p3 = x3[i];
    q[i * AMBULO__LANES] = (a0 * p0 + a1 * p1) + (a2 * p2 + a3 * p3);
    qd[i * AMBULO__LANES] = (b0 * p0 + b1 * p1) + (b2 * p2 + b3 * p3);
    qdd[i * AMBULO__LANES] = (c0 * p0 + c1 * p1) + (c2 * p2 + c3 * p3);
  }
}

/* one order of one node, any span */
static void forward_order(const double *weight, int first, int span, int d,
                          const double *restrict x, double *restrict result) {
  const double *control = x + (size_t)first * (size_t)d;
  for (int i = 0; i < d; i++) {
    double sum = 0.0;
    for (int k = 0; k < span; k++) sum += weight[k] * control[k * d + i];
    result[i * AMBULO__LANES] = sum;
  }
}

/* (M) (q, qd, qdd) = (B_0, B_1, B_2) P */
void ambulo__lane_map_forward(const ambulo__lane_map *map, const double *x, double *q, double *qd,
                              double *qdd, double *jerk, size_t block_stride) {
  int d = map->coordinates;
  int padded = ambulo__block_count(map->nodes) * AMBULO__LANES;
  for (int node = 0; node < padded; node++) {
    const ambulo__basis_point *point = &map->points[node];
    size_t at = (size_t)(node / AMBULO__LANES) * block_stride + (size_t)(node % AMBULO__LANES);
    if (map->quads) {
      forward_quad(&map->quads[node], d, x, q + at, qd + at, qdd + at);
    } else {
      forward_order(point->weight[0], point->first, point->span, d, x, q + at);
      forward_order(point->weight[1], point->first, point->span, d, x, qd + at);
      forward_order(point->weight[2], point->first, point->span, d, x, qdd + at);
    }
    if (jerk) {
      forward_order(point->weight[3], point->jerk_first, point->jerk_span, d, x, jerk + at);
    }
  }
}

/* ----------------------------------------------------------------- transpose */

static void transpose_quad(const quad *node, int d, const double *restrict gq,
                           const double *restrict gqd, const double *restrict gqdd,
                           double *restrict gx) {
  const double(*w)[4] = node->weight;
  const double a0 = w[0][0], a1 = w[0][1], a2 = w[0][2], a3 = w[0][3];
  const double b0 = w[1][0], b1 = w[1][1], b2 = w[1][2], b3 = w[1][3];
  const double c0 = w[2][0], c1 = w[2][1], c2 = w[2][2], c3 = w[2][3];
  double *x0 = gx + node->first * (size_t)d, *x1 = x0 + d, *x2 = x1 + d, *x3 = x2 + d;
  for (int i = 0; i < d; i++) {
    double g0 = gq[i * AMBULO__LANES], g1 = gqd[i * AMBULO__LANES], g2 = gqdd[i * AMBULO__LANES];
    x0[i] += a0 * g0 + b0 * g1 + c0 * g2;
    x1[i] += a1 * g0 + b1 * g1 + c1 * g2;
    x2[i] += a2 * g0 + b2 * g1 + c2 * g2;
    x3[i] += a3 * g0 + b3 * g1 + c3 * g2;
  }
}

static void transpose_order(const double *weight, int first, int span, int d,
                            const double *restrict g, double *restrict gx) {
  double *control = gx + (size_t)first * (size_t)d;
  for (int k = 0; k < span; k++) {
    for (int i = 0; i < d; i++) control[k * d + i] += weight[k] * g[i * AMBULO__LANES];
  }
}

/* (M) its transpose */
void ambulo__lane_map_transpose(const ambulo__lane_map *map, const double *gq, const double *gqd,
                                const double *gqdd, const double *gjerk, size_t block_stride,
                                double *gx) {
  int d = map->coordinates;
  for (int node = 0; node < map->nodes; node++) {
    const ambulo__basis_point *point = &map->points[node];
    size_t at = (size_t)(node / AMBULO__LANES) * block_stride + (size_t)(node % AMBULO__LANES);
    if (map->quads) {
      transpose_quad(&map->quads[node], d, gq + at, gqd + at, gqdd + at, gx);
    } else {
      transpose_order(point->weight[0], point->first, point->span, d, gq + at, gx);
      transpose_order(point->weight[1], point->first, point->span, d, gqd + at, gx);
      transpose_order(point->weight[2], point->first, point->span, d, gqdd + at, gx);
    }
    if (gjerk) {
      transpose_order(point->weight[3], point->jerk_first, point->jerk_span, d, gjerk + at, gx);
    }
  }
}
