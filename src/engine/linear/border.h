/* linear/border.h - a banded system with a few rows that couple distant unknowns.
 *
 *     M d + C' m = a,    C d - S m = b        M = L L' banded, S a multiple of the identity
 *
 * C the border rows: periodic or mirrored ends, limits on unknowns. By their Schur complement,
 * W = L^-1 C':
 *
 *     z = L^-1 a,    (W'W + S) m = W'z - b,    d = L^-T (z - W m)
 *
 * S = 0: C d = b exactly. S = I, b = 0: d = (M + C'C)^-1 a. In one pass of kkt.c and one step of
 * elastic.c what depends on the border is the middle line.
 */
#ifndef AMBULO_LINEAR_BORDER_H
#define AMBULO_LINEAR_BORDER_H

#include "linear/band.h"

typedef struct ambulo__border {
  const ambulo__sparse_rows *rows;
  int n, count, width;                 /* width: count rounded up to whole tiles */
  const ambulo__band_kernels *kernels; /* of this processor */
  double *wing;                        /* [n rounded up][width]: W */
  double *rest;                        /* [width]: m */
  ambulo__band schur;                  /* a full triangle: Cholesky factor of W'W + S */
} ambulo__border;

/* For rows that stay where they are. E_MEMORY. */
ambulo_status ambulo__border_create(const ambulo__sparse_rows *rows, ambulo__pool *pool,
                                    ambulo__border *border);
/* Factors W'W + S for the gradients that the rows hold; active NULL: all of them, else those
 * rows i with active[i], which takes S > 0. S is `shift` + `relative` times the largest diagonal
 * element of W'W. 0, or 1 when it is not positive definite. */
int ambulo__border_factor(ambulo__border *border, const ambulo__band *factor, const int *active,
                          double shift, double relative);
/* z [n] becomes z - W m; m stays in border->rest. b NULL: zero. */
void ambulo__border_eliminate(ambulo__border *border, const double *b, double *z);

#endif
