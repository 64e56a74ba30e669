/* linear/band.h - symmetric banded matrices, lower triangle in LAPACK's band storage.
 *
 *     element (i, j), j <= i <= j + kd, stands at a[j * ld + i - j]
 *
 * Read with leading dimension ld - 1, a square diagonal block of at most kd + 1 unknowns
 * is an ordinary column-major lower triangle: rank-k updates go straight into the band. The
 * rows of a[] below the band stay zero, so that rectangles that reach past it can be read;
 * ld - 1 is a multiple of 8, so that aligned tiles can (band_kernels.h).
 *
 * A node's motion is y = P x: the values, rates and accelerations of d coordinates, from `span`
 * control points,
 *
 *     y[k d + i] = sum_c b_k[c] x[c d + i],   k = 0, 1, 2
 *
 * and rows G [count][3 d] on y are G P on x. What they add to a metric is P' M P with M = G'G,
 *
 *     block (c, c') of d x d  +=  sum_kk' b_k[c] b_k'[c'] M_kk'
 *
 * G'G first takes 9 of the 25 products that (G P)'(G P) takes where splines of degree 4 have five
 * control points, and the rows keep the zeros of the limbs that they do not concern side by side;
 * to spread it costs as much as some 17 rows of G P (45 coordinates). With few rows, or no more
 * control points than orders, there is nothing to win: then it is the rows that become G P.
 *
 * Reading order: band.h, sparse_rows.h, row_blocks.h, band.c, band_kernels.h, band_source.h,
 * product_source.h; border.h, kkt.h, kkt.c; kkt.h.
 */
#ifndef AMBULO_LINEAR_BAND_H
#define AMBULO_LINEAR_BAND_H

#include "linear/band_kernels.h"
#include "linear/sparse_rows.h"

typedef struct ambulo__band {
  int n, kd, ld;
  const ambulo__band_kernels *kernels; /* of this processor */
  double *a;                           /* [n rounded up to 8][ld] */
  double *corner;                      /* inverses of the factor's corners, */
  int *below;                          /* and its tiles below them (band_kernels.h) */
  double *work;                        /* [2][n rounded up to 8]: a right-hand side and a product */
} ambulo__band;

/* n unknowns, kd diagonals below the main one, zero. */
ambulo_status ambulo__band_create(ambulo__pool *pool, int n, int kd, ambulo__band *band);
void ambulo__band_clear(ambulo__band *band);
void ambulo__band_copy(const ambulo__band *from, ambulo__band *to);
void ambulo__band_add_diagonal(ambulo__band *band, double value);
/* Adds `share` of each diagonal element to itself. */
void ambulo__band_raise_diagonal(ambulo__band *band, double share);
/* Adds G'G of rows G [count][stride] (row-major) on the `width` unknowns from `first` on. G is
 * 64-byte aligned, its stride whole tiles, and what lies beyond the width zero. */
void ambulo__band_add_rows(ambulo__band *band, int first, int width, int count, int stride,
                           const double *g);
/* Adds weight * g'g of a row with `count` entries, `stride` unknowns (and places in g) apart from
 * `first` on. */
void ambulo__band_add_outer(ambulo__band *band, int first, int count, int stride, double weight,
                            const double *g);
/* Adds a form of `count` unknowns, `stride` apart from `first` on; its lower triangle row by row.
 */
void ambulo__band_add_form(ambulo__band *band, int first, int count, int stride,
                           const double *form);
/* Adds weight * g'g of row i of a set of hosted rows. */
void ambulo__band_add_sparse(ambulo__band *band, const ambulo__sparse_rows *rows, int i,
                             double weight);
/* Largest diagonal element. */
double ambulo__band_largest(const ambulo__band *band);
/* (J D^-1 J')^1/2 of row i of a set, D the diagonal of A: 1 / its square is about what A opposes to
 * a change of the row. */
double ambulo__band_row_length(const ambulo__band *band, const ambulo__sparse_rows *rows, int i);
/* y = A x, y apart from x */
void ambulo__band_multiply(const ambulo__band *band, const double *x, double *y);
/* A = L L' in place. 0, or 1 when A is not positive definite. */
int ambulo__band_factor(ambulo__band *band);
/* With the factor: x = L^-1 x, L^-T x, L' x; and L^-1 of right-hand sides that stand side by side,
 * x [n rounded up to 8][width], width a multiple of 8, aligned to 64 bytes. */
void ambulo__band_forward(const ambulo__band *factor, double *x);
void ambulo__band_backward(const ambulo__band *factor, double *x);
void ambulo__band_upper_multiply(const ambulo__band *factor, double *x);
void ambulo__band_forward_many(const ambulo__band *factor, int width, double *x);

typedef struct ambulo__spread {
  int d;
  ambulo__band square; /* M, both triangles, with leading dimension ld - 1 */
  double *sums;        /* [3 d] */
} ambulo__spread;

ambulo_status ambulo__spread_create(ambulo__pool *pool, int d, ambulo__spread *spread);
/* Adds P' G'G P on the span d unknowns from `first` on; rows as for ambulo__band_add_rows, with
 * room for whole tiles of 3 d and of span d numbers, which are used up. */
void ambulo__spread_rows(ambulo__spread *spread, int count, int stride, double *g, int span,
                         const double *const b[AMBULO__ORDERS], int first, ambulo__band *band);

#endif
