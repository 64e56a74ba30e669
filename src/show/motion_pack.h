/* show/motion_pack.h - many like motions as few bytes, every value within half a step.
 *
 * Motions of a study differ in few ways, however many they are. Of v_i [values], in steps, with
 * mean m and the principal components b_k that principal.h finds,
 *
 *     v_i = (M + sum_k  c_ik e_k B_k) / Q + r_i,      Q = 2 ceil(sqrt(K + 1)),
 *
 * M, B_k and c_ik are whole numbers: M = Q m and B_k = Q b_k rounded, c_ik = w_ik / e_k rounded,
 * e_k = Q / (4 max |B_k|): rounding a weight moves no value by more than 1/8. Errors of K + 1
 * vectors add up like the root of their number, hence Q. r_i is what is then left, rounded: mostly
 * zero, and whatever M, B and c are, the sum is within half a step of v_i. K is what takes the
 * fewest bytes of those that are tried.
 *
 * Written, as whole numbers: K and the order d; M in second, B_k in first differences along each
 * series; c_1k ... c_nk of each k; of each motion the number of values of r_i that are not zero,
 * and for each of these how many zeros stand before it, and itself. With d = 2 (motions that have
 * little in common, K = 0) r_i stands in second differences. A whole number x takes, from the
 * lowest on, seven bits a byte of 2 x or, below zero, -2 x - 1; the eighth bit says that more
 * follow. */
#ifndef AMBULO_SHOW_MOTION_PACK_H
#define AMBULO_SHOW_MOTION_PACK_H

#include "base/text_buffer.h"
#include "show/motions.h"

/* Appends bytes, zeros among them. Errors: E_MEMORY, E_INTERNAL (LAPACK gave up). */
ambulo_status ambulo__motion_pack(ambulo__text_buffer *out, const ambulo__motions *motions);

#endif
