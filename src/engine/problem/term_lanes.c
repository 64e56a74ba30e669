/* problem/term_lanes.c - a simple term at the eight nodes of a block at once.
 *
 * Most terms are squares; theirs is a loop of fixed length that a compiler turns into vectors. */
#include "base/lanes.h"
#include "problem/term.h"

void ambulo__term_lanes(const ambulo_term *term, int coordinates, int node, int nodes, int i,
                        const double *y, double *u) {
  double scale = ambulo__term_scale(term, i);
  double offset[AMBULO__LANES];
  if (term->kind == AMBULO_TRACKING) { /* the only offset that varies: none beyond the last node */
    for (int l = 0; l < AMBULO__LANES; l++)
      offset[l] = node + l < nodes ? ambulo__term_offset(term, coordinates, node + l, i) : y[l];
  } else {
    double same = ambulo__term_offset(term, coordinates, node, i);
    for (int l = 0; l < AMBULO__LANES; l++) offset[l] = same;
  }
  for (int l = 0; l < AMBULO__LANES; l++) u[l] = scale * (y[l] - offset[l]);
}

static int is_squared(const ambulo_term *term) {
  return term->kind == AMBULO_TORQUE_SQUARED || term->kind == AMBULO_ACCELERATION ||
         term->kind == AMBULO_TRACKING || term->kind == AMBULO_POSTURE;
}

void ambulo__term_shapes(const ambulo_term *term, double least, const double *u, double *value,
                         double *slope) {
  if (is_squared(term)) {
    for (int l = 0; l < AMBULO__LANES; l++) {
      value[l] = u[l] * u[l];
      slope[l] = 2.0 * u[l];
    }
    return;
  }
  for (int l = 0; l < AMBULO__LANES; l++) {
    ambulo__residual residual = ambulo__term_residual_from(term, least, u[l]);
    value[l] = residual.value;
    slope[l] = residual.slope;
  }
}
