/* linear/band_kernels.h - the inner loops of band.c, one set for each instruction set.
 *
 * Matrices as in band.h, cut into tiles of 8 x 8: a is 64-byte aligned, ld - 1 a multiple of 8
 * and at least kd + 8, and there is room for n rounded up to 8 columns; what lies outside of
 * the band is zero. Vectors have room for n rounded up to 8, and zeros there.
 *
 * LAPACK takes these matrices column by column (dtbsv, and dpbtrf up to 64 diagonals), which
 * costs two to four times as much: bench/bench_factor.c.
 */
#ifndef AMBULO_LINEAR_BAND_KERNELS_H
#define AMBULO_LINEAR_BAND_KERNELS_H

#include "mechanics/plan.h"
#include <stddef.h>

enum { AMBULO__ORDERS = 3 }; /* of a motion: values, rates, accelerations */
enum { AMBULO__TILE = 8, AMBULO__CORNER = 2 * AMBULO__TILE * AMBULO__TILE };

typedef struct ambulo__band_kernels {
  const char *name; /* as ambulo__instruction_set() */
  /* A = L L' in place; tiles below each corner of L that are not zero into below [n / 8], the
   * inverses of the corners into corner [n / 8][AMBULO__CORNER]. 0, or 1 when A is not positive
   * definite. */
  int (*factor)(int n, int kd, int ld, double *a, int *below, double *corner);
  /* x = L^-1 x, x = L^-T x and x = L' x */
  void (*forward)(int n, int ld, const double *a, const int *below, const double *corner,
                  double *x);
  void (*backward)(int n, int ld, const double *a, const int *below, const double *corner,
                   double *x);
  void (*upper_multiply)(int n, int ld, const double *a, const int *below, double *x);
  /* Of rows W [n][width], aligned, width whole tiles: W = L^-1 W, with room for n rounded up */
  void (*forward_many)(int n, int ld, const double *a, const int *below, const double *corner,
                       int width, double *w);
  /* with the matrix: y = A x */
  void (*multiply)(int n, int kd, int ld, const double *a, const double *x, double *y);
  /* a += G'G for the first `width` unknowns of `a` in band storage, which need not be aligned, of
   * `count` rows G, aligned, `stride` whole tiles apart and zero from `width` on */
  void (*add_gram)(int count, int width, int stride, const double *g, int ld, double *a);
  /* the same, faster where half of G is zero (product_source.h) */
  void (*add_sparse_gram)(int count, int width, int stride, const double *g, int ld, double *a);
  /* a += P'MP, m [3 d][step] with leading dimension step (band.h); sums [3 d] is scratch */
  void (*spread)(int d, int span, const double *const b[3], const double *m, size_t step,
                 double *sums, int ld, double *a);
  /* of X [n][8], aligned: y = W'X, y [width][8], aligned; X -= W y */
  void (*cross)(int n, int width, const double *w, const double *x, double *y);
  void (*subtract)(int n, int width, const double *w, const double *y, double *x);
  /* y = W'x, y [width] aligned; x -= W y */
  void (*gather)(int n, int width, const double *w, const double *x, double *y);
  void (*scatter)(int n, int width, const double *w, const double *y, double *x);
} ambulo__band_kernels;

/* A count rounded up to whole tiles. */
static inline int ambulo__whole_tiles(int count) {
  return (count + AMBULO__TILE - 1) / AMBULO__TILE * AMBULO__TILE;
}

/* A set without functions was not compiled in. The baseline is there on every processor. */
extern const ambulo__band_kernels ambulo__band_kernels_baseline;
#if defined(__x86_64__)
extern const ambulo__band_kernels ambulo__band_kernels_avx2;
extern const ambulo__band_kernels ambulo__band_kernels_avx512;
#endif

/* The set for the instruction set that the mechanics run on. */
const ambulo__band_kernels *ambulo__band_kernels_select(void);

#endif
