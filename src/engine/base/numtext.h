/* base/numtext.h - numbers as text, independent of the locale. */
#ifndef AMBULO_BASE_NUMTEXT_H
#define AMBULO_BASE_NUMTEXT_H

#include <stddef.h>

/* Whether text[0..length) has the form [+-]digits[.digits][e[+-]digits]. */
int ambulo__is_decimal(const char *text, size_t length);

/* Reads a finite decimal number that fills the whole of text[0..length):
 * [+-]digits[.digits][e[+-]digits], at least one digit. Correctly rounded.
 * Returns 1 and sets *value, or 0 (not a number, beyond the range of double,
 * not zero but rounded to zero, trailing text; *value untouched). */
int ambulo__parse_double(const char *text, size_t length, double *value);
/* The same for a whole number in [min, max]. */
int ambulo__parse_integer(const char *text, size_t length, long long min, long long max,
                          long long *value);

/* Shortest text that reads back to the same double ("0.1", "1e-05", "nan", "inf"), always with '.'
 * and never with ','. In a message: printf("%s", ambulo__number_text(x).text). */
#define AMBULO__NUMTEXT_SIZE 40
typedef struct ambulo__number {
  char text[AMBULO__NUMTEXT_SIZE];
} ambulo__number;
ambulo__number ambulo__number_text(double value);
/* How many digits, at least six, tell two numbers apart. */
int ambulo__digits_apart(double a, double b);

#endif
