/* linear/kkt.h - equality-constrained quadratic problems in a banded metric, and mixing of
 * iterates.
 *
 *     H d + J' l + C' m = a,    J d = h,    C d = b                                (KKT)
 *
 * H [n][n] banded and positive definite, J the local equalities (banded J'J), C the few
 * border rows that couple distant unknowns. Derivation in kkt.c.
 */
#ifndef AMBULO_LINEAR_KKT_H
#define AMBULO_LINEAR_KKT_H

#include "linear/border.h"
#include "linear/pool.h"

typedef struct ambulo__kkt {
  int n, equalities;
  const ambulo__sparse_rows *equality;
  ambulo__band factor; /* L of M = H + J' S J */
  ambulo__border border;
  ambulo__update update; /* rows that H has gained or lost since then */
  double stiffness;      /* S_r |J_r|^2 relative to the largest diagonal element of H, */
  int by_row;            /* or to what H opposes to the row, once the former has drowned H */
  double most_stiffness; /* that rows which are slow may raise it to */
  double *penalty;       /* [equalities]: diagonal of S */
  double *residual;      /* [equalities] */
} ambulo__kkt;

ambulo_status ambulo__kkt_create(const ambulo__sparse_rows *equality,
                                 const ambulo__sparse_rows *border, int kd, ambulo__pool *pool,
                                 ambulo__kkt *kkt);

/* Factors (KKT) for metric H and the gradients that the row sets hold; they must not change
 * while the factor is in use. 0, or 1 when H is not positive definite. */
int ambulo__kkt_factor(ambulo__kkt *kkt, const ambulo__band *h);
/* The factor of the last H with all changes since (ambulo__update_row), which is h: by an update of
 * few columns, or anew. As ambulo__kkt_factor. */
int ambulo__kkt_renew(ambulo__kkt *kkt, const ambulo__band *h);

/* One pass: d solves M d + C' m = right, C d = b exactly; J d is what it comes out as.
 * b NULL: zero. right becomes d. m [border->count] may be NULL. */
void ambulo__kkt_pass(ambulo__kkt *kkt, double *right, const double *b, double *m);

/* Solves (KKT) to rounding: a, h, b NULL are zero; l [equalities] is the first guess of the
 * multipliers on entry. m may be NULL. */
void ambulo__kkt_solve(ambulo__kkt *kkt, const double *a, const double *h, const double *b,
                       double *d, double *l, double *m);

/* Anderson mixing of a fixed-point iteration, such as passes with a factor that is not quite that
 * of the matrix. */
#define AMBULO__MIXING_DEPTH 5

typedef struct ambulo__mixing {
  int points, residuals; /* lengths */
  int count, next;       /* pairs held; where the next goes */
  double *point[AMBULO__MIXING_DEPTH];
  double *residual[AMBULO__MIXING_DEPTH];
} ambulo__mixing;

ambulo_status ambulo__mixing_create(ambulo__pool *pool, int points, int residuals,
                                    ambulo__mixing *mixing);
void ambulo__mixing_reset(ambulo__mixing *mixing);
/* Given the image of an iterate under the fixed-point map and the iterate's residual,
 * replaces the image by the mixture of the last images whose residuals cancel best.
 * Coefficients sum to one. */
void ambulo__mixing_apply(ambulo__mixing *mixing, const double *residual, double *image);

#endif
