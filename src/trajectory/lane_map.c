/* trajectory/lane_map.c - the sparse maps of lane_map.h, node by node.
 *
 * A node touches span = 3 or 4 control points (nodes on breakpoints or between them), each
 * a contiguous row of d numbers. Per node and coordinate i, with w the node's weights,
 *
 *     D^o q_i = sum_k w[o][k] x[first + k][i]                    forward, o = 0..2
 *     gx[first + k][i] += sum_o w[o][k] g_o,i                    transpose
 *
 * Working through whole blocks with lanes as vectors was measured and is slower by a
 * factor of seven: the 8 nodes of a block share few control points, so most of a common
 * window's weights are zero. Instead the loop over coordinates runs over contiguous
 * memory, with the span a compile-time constant in the frequent cases. */
#include "trajectory/lane_map.h"

struct ambulo__lane_map {
  ambulo_allocator allocator;
  int nodes, coordinates;
  ambulo__basis_point *points; /* [blocks * 8] */
};

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
  if (!m->points) {
    ambulo__lane_map_free(m);
    return AMBULO_E_MEMORY;
  }
  for (int k = 0; k < nodes; k++) ambulo__basis_at(basis, times[k], &m->points[k]);
  for (int k = nodes; k < padded; k++) m->points[k] = m->points[nodes - 1];
  *map = m;
  return AMBULO_OK;
}

void ambulo__lane_map_free(ambulo__lane_map *map) {
  if (!map) return;
  ambulo_allocator allocator = map->allocator;
  ambulo__free(&allocator, map->points);
  ambulo__free(&allocator, map);
}

int ambulo__lane_map_nodes(const ambulo__lane_map *map) {
  return map->nodes;
}
int ambulo__lane_map_coordinates(const ambulo__lane_map *map) {
  return map->coordinates;
}
const ambulo__basis_point *ambulo__lane_map_points(const ambulo__lane_map *map) {
  return map->points;
}

/* one node, orders 0..2; `span` equals point->span and is constant where inlined */
static inline void forward_node(const ambulo__basis_point *point, int span, int d,
                                const double *restrict x, double *restrict q, double *restrict qd,
                                double *restrict qdd) {
  for (int i = 0; i < d; i++) {
    double value = 0.0, rate = 0.0, acceleration = 0.0;
    for (int k = 0; k < span; k++) {
      double control = x[k * d + i];
      value += point->weight[0][k] * control;
      rate += point->weight[1][k] * control;
      acceleration += point->weight[2][k] * control;
    }
    q[i * AMBULO__LANES] = value;
    qd[i * AMBULO__LANES] = rate;
    qdd[i * AMBULO__LANES] = acceleration;
  }
}

static void forward_jerk(const ambulo__basis_point *point, int d, const double *restrict x,
                         double *restrict jerk) {
  const double *control = x + (size_t)point->jerk_first * (size_t)d;
  for (int i = 0; i < d; i++) {
    double sum = 0.0;
    for (int k = 0; k < point->jerk_span; k++) sum += point->weight[3][k] * control[k * d + i];
    jerk[i * AMBULO__LANES] = sum;
  }
}

void ambulo__lane_map_forward(const ambulo__lane_map *map, const double *x, double *q, double *qd,
                              double *qdd, double *jerk, size_t block_stride) {
  int d = map->coordinates;
  int padded = ambulo__block_count(map->nodes) * AMBULO__LANES;
  for (int node = 0; node < padded; node++) {
    const ambulo__basis_point *point = &map->points[node];
    const double *control = x + (size_t)point->first * (size_t)d;
    size_t at = (size_t)(node / AMBULO__LANES) * block_stride + (size_t)(node % AMBULO__LANES);
    switch (point->span) {
    case 3:
      forward_node(point, 3, d, control, q + at, qd + at, qdd + at);
      break;
    case 4:
      forward_node(point, 4, d, control, q + at, qd + at, qdd + at);
      break;
    default:
      forward_node(point, point->span, d, control, q + at, qd + at, qdd + at);
    }
    if (jerk) forward_jerk(point, d, x, jerk + at);
  }
}

static inline void transpose_node(const ambulo__basis_point *point, int span, int d,
                                  const double *restrict gq, const double *restrict gqd,
                                  const double *restrict gqdd, double *restrict gx) {
  for (int i = 0; i < d; i++) {
    double value = gq[i * AMBULO__LANES];
    double rate = gqd[i * AMBULO__LANES];
    double acceleration = gqdd[i * AMBULO__LANES];
    for (int k = 0; k < span; k++) {
      gx[k * d + i] += point->weight[0][k] * value + point->weight[1][k] * rate +
                       point->weight[2][k] * acceleration;
    }
  }
}

static void transpose_jerk(const ambulo__basis_point *point, int d, const double *restrict gjerk,
                           double *restrict gx) {
  double *control = gx + (size_t)point->jerk_first * (size_t)d;
  for (int k = 0; k < point->jerk_span; k++) {
    for (int i = 0; i < d; i++) {
      control[k * d + i] += point->weight[3][k] * gjerk[i * AMBULO__LANES];
    }
  }
}

void ambulo__lane_map_transpose(const ambulo__lane_map *map, const double *gq, const double *gqd,
                                const double *gqdd, const double *gjerk, size_t block_stride,
                                double *gx) {
  int d = map->coordinates;
  for (int node = 0; node < map->nodes; node++) {
    const ambulo__basis_point *point = &map->points[node];
    double *control = gx + (size_t)point->first * (size_t)d;
    size_t at = (size_t)(node / AMBULO__LANES) * block_stride + (size_t)(node % AMBULO__LANES);
    switch (point->span) {
    case 3:
      transpose_node(point, 3, d, gq + at, gqd + at, gqdd + at, control);
      break;
    case 4:
      transpose_node(point, 4, d, gq + at, gqd + at, gqdd + at, control);
      break;
    default:
      transpose_node(point, point->span, d, gq + at, gqd + at, gqdd + at, control);
    }
    if (gjerk) transpose_jerk(point, d, gjerk + at, gx);
  }
}
