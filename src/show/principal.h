/* show/principal.h - in how few ways motions differ.
 *
 * Of v_i [values], i < n, with mean m: G_ij = (v_i - m) . (v_j - m), whose eigenvectors u_k belong
 * to its eigenvalues, largest first. With w_ik = sqrt(n) u_k[i], of mean square one, and
 *
 *     b_k = 1/n sum_i w_ik (v_i - m)      v_i - m = sum_k w_ik b_k,
 *
 * and no other sum of so many terms leaves a smaller sum of squares. G is taken from one value in
 * four: that is enough to find the ways, whose components then are exact for these weights. */
#ifndef AMBULO_SHOW_PRINCIPAL_H
#define AMBULO_SHOW_PRINCIPAL_H

#include "base/alloc.h"
#include "show/motions.h"

/* weights[k n + i] = w_ik and left[k]: mean square of what k components leave of a value, both
 * [n]. `mean` [values]. Errors: E_MEMORY, E_INTERNAL (LAPACK gave up). */
ambulo_status ambulo__principal_weights(const ambulo__motions *motions, const double *mean,
                                        const ambulo_allocator *allocator, double *weights,
                                        double *left);

#endif
