/* linear/border.h - a banded system with a few rows that couple distant unknowns, and with a few
 * rows more or less than when it was factored.
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
#include "linear/parameters.h"

typedef struct ambulo__border {
  const ambulo__sparse_rows *rows;
  int n, count, width;                 /* width: count rounded up to whole tiles */
  const ambulo__band_kernels *kernels; /* of this processor */
  double *columns;                     /* [n rounded up][width]: W */
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

/* A few rows more or less in a factored system, without a new factor:
 *
 *     (M + U' D U) d + C' m = a,    C d = b        M = L L', C as above, factored both
 *
 * U [count][n]: rows that came (D_i = their weight > 0) or went (D_i < 0). Woodbury's formula, with
 * y = D U d as further unknowns: their Schur complement beside the border's is small,
 *
 *     V = L^-1 U',   T = (W'W + S)^-1 W'V,   Z = V - W T          [n][count], [border][count]
 *     z = L^-1 a, less the border's part
 *     (Z'Z + D^-1) y = Z'z + T'b,    d = L^-T (z - Z y),    m = m of the border alone - T y
 *
 * Z'Z + D^-1 is positive definite in the rows that came and, after these, negative definite in
 * those that went as long as M + U'DU is positive definite: quasidefinite (Vanderbei 1995), so that
 * elimination needs no pivoting. There is room for AMBULO__UPDATE_TILES tiles of 8 columns. A
 * column costs one forward solve with L and two products with the border's W; a new factor costs as
 * much as half a forward solve for each diagonal of the band, and the border's W and W'W anew.
 */
typedef struct ambulo__update {
  const ambulo__band *factor; /* of M */
  ambulo__border *border;
  const ambulo__sparse_rows *rows;
  int n, taken, solved; /* columns in use; of these, with their Z */
  int full;             /* a row found no room */
  int *row;             /* [room]: of each column */
  double *weight;       /* [room]: D; 0: the row came and went */
  double *columns;      /* [tiles][n rounded up][8]: Z */
  double *cross;        /* [tiles][border width][8]: T */
  double *products;     /* [room][room]: Z'Z */
  double *complement;   /* [room][room]: L D L' of Z'Z + D^-1; unit lower triangle, pivots */
  double *rest;         /* [room]: y */
} ambulo__update;

ambulo_status ambulo__update_create(const ambulo__band *factor, ambulo__border *border,
                                    ambulo__pool *pool, ambulo__update *update);
/* M is factored anew: no rows. */
void ambulo__update_clear(ambulo__update *update);
/* M + weight J_i'J_i from now on, row i of a set of hosted rows; once ambulo__update_factor is
 * called. */
void ambulo__update_row(ambulo__update *update, const ambulo__sparse_rows *rows, int i,
                        double weight);
/* 0; 1: there was no room for a row, or too many digits are lost: M is to be factored anew. */
int ambulo__update_factor(ambulo__update *update);
/* z [n], and border->rest unless it is empty, become those of the changed system. b NULL: zero. */
void ambulo__update_eliminate(ambulo__update *update, const double *b, double *z);

#endif
