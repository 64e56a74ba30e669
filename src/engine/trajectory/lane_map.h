/* trajectory/lane_map.h - unknowns to (q, qd, qdd) at all time nodes, and the transpose.
 *
 *     (q, qd, qdd, jerk) = (B0, B1, B2, B3) x            forward
 *     gx += B0' gq + B1' gqd + B2' gqdd + B3' gjerk      transpose
 *
 * x, gx: [control_points][d], row-major. Node arrays: [block][d][8] (base/lanes.h); block
 * b of each starts at array + b * block_stride, so that they may be parts of one larger
 * channel array (block_stride in doubles, at least 8 d). Neither call allocates; a map is
 * immutable and may be shared by threads. */
#ifndef AMBULO_TRAJECTORY_LANE_MAP_H
#define AMBULO_TRAJECTORY_LANE_MAP_H

#include "base/lanes.h"
#include "trajectory/basis.h"

typedef struct ambulo__lane_map ambulo__lane_map;

/* times[nodes], s, in any order; nodes >= 1, coordinates >= 1. Keeps no pointer to the
 * basis or to times. Errors: E_ARGUMENT, E_MEMORY. */
ambulo_status ambulo__lane_map_create(const ambulo__basis *basis, const double *times, int nodes,
                                      int coordinates, const ambulo_allocator *allocator,
                                      ambulo__lane_map **map);
void ambulo__lane_map_free(ambulo__lane_map *map); /* accepts NULL */

/* The map of each node, [nodes] (and copies of the last up to a full block). */
const ambulo__basis_point *ambulo__lane_map_points(const ambulo__lane_map *map);

/* Padding lanes receive copies of the last node. jerk may be NULL. */
void ambulo__lane_map_forward(const ambulo__lane_map *map, const double *x, double *q, double *qd,
                              double *qdd, double *jerk, size_t block_stride);
/* Padding lanes are ignored. gjerk may be NULL. Adds to gx. */
void ambulo__lane_map_transpose(const ambulo__lane_map *map, const double *gq, const double *gqd,
                                const double *gqdd, const double *gjerk, size_t block_stride,
                                double *gx);

#endif
