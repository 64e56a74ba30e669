/* linear/spread.h - Gram matrices of rows on a motion, spread over its control points.
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
 * control points, and the rows keep the zeros of the limbs that they do not concern side by side
 * (gram_source.h); to spread it costs as much as some 17 rows of G P (45 coordinates). With few
 * rows, or no more control points than orders, there is nothing to win: then it is the rows that
 * become G P. */
#ifndef AMBULO_LINEAR_SPREAD_H
#define AMBULO_LINEAR_SPREAD_H

#include "linear/band.h"

enum { AMBULO__ORDERS = 3 };

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
