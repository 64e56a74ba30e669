/* base/shortest_digits.h - the shortest text of a number that reads back, by whole numbers. */
#ifndef AMBULO_BASE_SHORTEST_DIGITS_H
#define AMBULO_BASE_SHORTEST_DIGITS_H

#include <stddef.h>

/* The first of %.15g, %.16g and %.17g that reads back as `value`, which is finite; its length. 0
 * where this is left to printf: below 1e-11, above 2^53, powers of two, ties, and compilers without
 * whole numbers of 128 bits. */
size_t ambulo__shortest_digits(char *buffer, double value);

#endif
