/* base/lapack.h - the BLAS and LAPACK routines in use, by their Fortran symbols.
 *
 * Why not LAPACKE or cblas.h: several builds of OpenBLAS and of the reference library
 * come without the C wrappers, and LAPACKE allocates and transposes behind the
 * caller's back. The Fortran symbols exist everywhere.
 *
 * Conventions: matrices column-major; every argument by address; INTEGER is int (the
 * LP64 builds). Fortran compilers also pass the length of each CHARACTER argument as a
 * hidden trailing value; all flags here are single letters whose length is never read,
 * so the prototypes leave it out, as the C world does. Several threads may call.
 *
 * What each routine computes stands beside it; A is symmetric in dpb and dsy.
 */
#ifndef AMBULO_BASE_LAPACK_H
#define AMBULO_BASE_LAPACK_H

/* ------------------------------------------------------------------- banded */

/* A = L L' or U' U in band storage ab[ldab][n], kd diagonals */
extern void dpbtrf_(const char *uplo, const int *n, const int *kd, double *ab, const int *ldab,
                    int *info);
/* factor and solve in one call */
extern void dpbsv_(const char *uplo, const int *n, const int *kd, const int *nrhs, double *ab,
                   const int *ldab, double *b, const int *ldb, int *info);
/* x = T^-1 x or T'^-1 x, T triangular and banded */
extern void dtbsv_(const char *uplo, const char *trans, const char *diag, const int *n,
                   const int *k, const double *a, const int *lda, double *x, const int *incx);
/* A = P L U in band storage with kl extra rows for the fill-in */
extern void dgbtrf_(const int *m, const int *n, const int *kl, const int *ku, double *ab,
                    const int *ldab, int *ipiv, int *info);
/* A X = B or A' X = B with the factor of dgbtrf */
extern void dgbtrs_(const char *trans, const int *n, const int *kl, const int *ku, const int *nrhs,
                    const double *ab, const int *ldab, const int *ipiv, double *b, const int *ldb,
                    int *info);

/* -------------------------------------------------------------------- dense */

/* A X = B by LU with partial pivoting */
extern void dgesv_(const int *n, const int *nrhs, double *a, const int *lda, int *ipiv, double *b,
                   const int *ldb, int *info);

/* least squares: min |B - A X| by QR, A of full rank; X in the first rows of B */
extern void dgels_(const char *trans, const int *m, const int *n, const int *nrhs, double *a,
                   const int *lda, double *b, const int *ldb, double *work, const int *lwork,
                   int *info);

/* eigenvalues w of A, rising, and with jobz "V" its eigenvectors, which become the columns of A;
 * lwork and liwork -1: only asks for their sizes */
extern void dsyevd_(const char *jobz, const char *uplo, const int *n, double *a, const int *lda,
                    double *w, double *work, const int *lwork, int *iwork, const int *liwork,
                    int *info);

/* --------------------------------------------------------------------- BLAS */

/* C = alpha A A' + beta C or alpha A' A + beta C */
extern void dsyrk_(const char *uplo, const char *trans, const int *n, const int *k,
                   const double *alpha, const double *a, const int *lda, const double *beta,
                   double *c, const int *ldc);
/* C = alpha op(A) op(B) + beta C */
extern void dgemm_(const char *transa, const char *transb, const int *m, const int *n, const int *k,
                   const double *alpha, const double *a, const int *lda, const double *b,
                   const int *ldb, const double *beta, double *c, const int *ldc);
/* y = alpha op(A) x + beta y */
extern void dgemv_(const char *trans, const int *m, const int *n, const double *alpha,
                   const double *a, const int *lda, const double *x, const int *incx,
                   const double *beta, double *y, const int *incy);
/* B = alpha op(T)^-1 B or alpha B op(T)^-1 */
extern void dtrsm_(const char *side, const char *uplo, const char *transa, const char *diag,
                   const int *m, const int *n, const double *alpha, const double *a, const int *lda,
                   double *b, const int *ldb);

#endif
