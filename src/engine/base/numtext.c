/* base/numtext.c - numbers as text without the locale.
 *
 * Reading: the text is first checked against the grammar, then handed to strtod_l in the
 * "C" locale, which rounds correctly. Printing: the shortest of the 1- to 17-digit forms that
 * reads back to the same bits. Both use a "C" locale_t of their own for the call, so that
 * the process's locale is neither read nor changed. */
#define _GNU_SOURCE
#include "base/numtext.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

enum { MAX_NUMBER_LENGTH = 400 };

static size_t skip_digits(const char *text, size_t length, size_t at) {
  while (at < length && text[at] >= '0' && text[at] <= '9') at++;
  return at;
}

/* [+-]digits[.digits][e[+-]digits] with a digit before or after the point */
int ambulo__is_decimal(const char *text, size_t length) {
  size_t at = 0;
  if (at < length && (text[at] == '+' || text[at] == '-')) at++;
  size_t whole = at;
  at = skip_digits(text, length, at);
  size_t digits = at - whole;
  if (at < length && text[at] == '.') {
    size_t fraction = ++at;
    at = skip_digits(text, length, at);
    digits += at - fraction;
  }
  if (digits == 0) return 0;
  if (at < length && (text[at] == 'e' || text[at] == 'E')) {
    at++;
    if (at < length && (text[at] == '+' || text[at] == '-')) at++;
    size_t exponent = at;
    at = skip_digits(text, length, at);
    if (at == exponent) return 0;
  }
  return at == length;
}

static double read_c_locale(const char *text) {
  locale_t c = newlocale(LC_ALL_MASK, "C", (locale_t)0);
  if (c == (locale_t)0) return (double)NAN;
  double value = strtod_l(text, NULL, c);
  freelocale(c);
  return value;
}

/* before the exponent */
static int has_nonzero_digit(const char *text) {
  return text[strcspn(text, "123456789eE")] != '\0' &&
         strchr("123456789", text[strcspn(text, "123456789eE")]) != NULL;
}

int ambulo__parse_double(const char *text, size_t length, double *value) {
  char copy[MAX_NUMBER_LENGTH];
  if (length == 0 || length >= sizeof copy || !ambulo__is_decimal(text, length)) return 0;
  memcpy(copy, text, length);
  copy[length] = '\0';
  double result = read_c_locale(copy);
  if (!isfinite(result) || (result == 0.0 && has_nonzero_digit(copy))) return 0;
  *value = result;
  return 1;
}

int ambulo__parse_integer(const char *text, size_t length, long long min, long long max,
                          long long *value) {
  size_t at = 0;
  int negative = 0;
  if (at < length && (text[at] == '+' || text[at] == '-')) negative = text[at++] == '-';
  if (at == length || length - at > 18 || skip_digits(text, length, at) != length) return 0;
  long long result = 0;
  for (; at < length; at++) result = result * 10 + (text[at] - '0');
  if (negative) result = -result;
  if (result < min || result > max) return 0;
  *value = result;
  return 1;
}

/* ------------------------------------------------------------------- printing */

/* The shortest digits: the first of %.15g, %.16g and %.17g that reads back.
 *
 * A number is v = m 2^e with whole m, 2^52 < m < 2^53. With X its decimal exponent, k = 16 - X and
 * s = -(e + k) > 0 its first 17 digits are the whole part of
 *
 *     v 10^k = P / 2^s,    P = m 5^k < 2^116
 *
 * and D digits with u = 10^(17 - D) the nearest whole number N to P / (u 2^s). The text N u 10^-k
 * reads back as v when it is nearer to v than half of the distance 2^e to its neighbours, which are
 * as far on both sides since m > 2^52:
 *
 *     2 |N u 2^s - P| < 5^k,
 *
 * never equal, as 5^k is odd. All of this is exact in whole numbers of 128 bits.
 */

#ifdef __SIZEOF_INT128__

__extension__ typedef unsigned __int128 wide;
typedef unsigned long long whole;

enum { LEAST_DIGITS = 15, MOST_DIGITS = 17, LARGEST_POWER = 27, LARGEST_SHIFT = 64 };

static const whole ten_to_16 = 10000000000000000ULL;

static whole power_of(whole base, int exponent) {
  whole power = 1;
  for (int i = 0; i < exponent; i++) power *= base;
  return power;
}

/* v 10^k as P / 2^shift; exponent: X */
typedef struct scaled {
  wide p;
  whole five; /* 5^k */
  int shift, exponent;
} scaled;

/* 0 where P or the shift would not fit */
static int scale(whole m, int e, int exponent, scaled *v) {
  int k = MOST_DIGITS - 1 - exponent;
  v->exponent = exponent;
  v->shift = -(e + k);
  if (k < 0 || k > LARGEST_POWER || v->shift <= 0 || v->shift > LARGEST_SHIFT - 1) return 0;
  v->five = power_of(5, k);
  v->p = (wide)m * v->five;
  return 1;
}

/* the number with its decimal exponent, which is guessed from the binary one and at most one more
 */
static int take(double value, scaled *v) {
  int e;
  double part = frexp(value, &e);
  whole m = (whole)ldexp(part, 53);
  if (m == 1ULL << 52) return 0;
  int guess = (int)floor((e - 1) * 0.30102999566398120);
  if (!scale(m, e - 53, guess, v)) return 0;
  return (whole)(v->p >> v->shift) < 10 * ten_to_16 || scale(m, e - 53, guess + 1, v);
}

/* N of so many digits; *back: whether it reads back. 0 at a tie */
static int round_to(const scaled *v, int digits, whole *n, int *back) {
  whole unit = power_of(10, MOST_DIGITS - digits), all = (whole)(v->p >> v->shift);
  wide one = (wide)unit << v->shift, below = v->p - (wide)(all / unit) * one;
  if (2 * below == one) return 0;
  int up = 2 * below > one;
  wide apart = up ? one - below : below;
  *n = all / unit + (whole)up;
  *back = digits == MOST_DIGITS || 2 * apart < v->five;
  return 1;
}

/* the digits of n without zeros at the end; their number */
static int write_digits(whole n, char *digit) {
  char reversed[24];
  int count = 0, used = 0;
  for (; n % 10 == 0; n /= 10) continue;
  for (; n > 0; n /= 10) reversed[count++] = (char)('0' + n % 10);
  while (count > 0) digit[used++] = reversed[--count];
  return used;
}

static char *put(char *to, const char *from, int count) {
  memcpy(to, from, (size_t)count);
  return to + count;
}

/* as %g: 0.00d, dd.dd, dd00 or d.dde-05 */
static char *write_number(char *to, const char *digit, int count, int exponent, int precision) {
  if (exponent < -4 || exponent >= precision) {
    int size = exponent < 0 ? -exponent : exponent;
    to = put(to, digit, 1);
    if (count > 1) to = put(put(to, ".", 1), digit + 1, count - 1);
    *to++ = 'e';
    *to++ = exponent < 0 ? '-' : '+';
    *to++ = (char)('0' + size / 10);
    *to++ = (char)('0' + size % 10);
    return to;
  }
  if (exponent < 0) {
    to = put(to, "0.000", 1 - exponent);
    return put(to, digit, count);
  }
  for (int i = 0; i <= exponent; i++) *to++ = i < count ? digit[i] : '0';
  if (count > exponent + 1) to = put(put(to, ".", 1), digit + exponent + 1, count - exponent - 1);
  return to;
}

/* length of the text; 0 where this is left to printf: below 1e-11, above 2^53, powers of two, ties,
 * and compilers without whole numbers of 128 bits */
static size_t shortest_digits(char *buffer, double value) {
  scaled v;
  char digit[24], *end = buffer;
  if (!take(fabs(value), &v)) return 0;
  for (int digits = LEAST_DIGITS; digits <= MOST_DIGITS; digits++) {
    whole n;
    int back;
    if (!round_to(&v, digits, &n, &back)) return 0;
    if (!back) continue;
    int carried = n == power_of(10, digits);
    int count = write_digits(n, digit);
    if (value < 0.0) *end++ = '-';
    end = write_number(end, digit, count, v.exponent + carried, digits);
    *end = '\0';
    return (size_t)(end - buffer);
  }
  return 0;
}

#else

static size_t shortest_digits(char *buffer, double value) {
  (void)buffer;
  (void)value;
  return 0;
}

#endif

static void print_digits(char *buffer, int digits, double value) {
  (void)snprintf(buffer, AMBULO__NUMTEXT_SIZE, "%.*g", digits, value);
  /* the process's locale may use another decimal separator: the only character here
     that is no digit, sign or exponent letter */
  for (char *c = buffer; *c; c++) {
    int plain = (*c >= '0' && *c <= '9') || *c == '-' || *c == '+' || *c == 'e';
    if (!plain) {
      size_t width = 1;
      while (c[width] && !(c[width] >= '0' && c[width] <= '9')) width++;
      *c = '.';
      memmove(c + 1, c + width, strlen(c + width) + 1);
    }
  }
}

/* what has no digits to find; NULL: another number */
static const char *word_of(double value) {
  if (isnan(value)) return "nan";
  if (isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return value != 0.0 ? NULL : signbit(value) ? "-0" : "0";
}

ambulo__number ambulo__number_text(double value) {
  ambulo__number number;
  const char *word = word_of(value);
  if (word) memcpy(number.text, word, strlen(word) + 1);
  if (word || shortest_digits(number.text, value) > 0) return number;
  /* every text of up to 15 digits survives in a normal double, so that %.15g already
     drops what is not needed; subnormal numbers carry fewer digits */
  for (int digits = fabs(value) < DBL_MIN ? 1 : 15; digits <= 17; digits++) {
    double back = 0.0;
    print_digits(number.text, digits, value);
    if (ambulo__parse_double(number.text, strlen(number.text), &back) && back == value) break;
  }
  return number;
}

int ambulo__digits_apart(double a, double b) {
  char text[2][48];
  int digits = 6;
  for (; digits < 17; digits++) {
    (void)snprintf(text[0], sizeof text[0], "%.*g", digits, a);
    (void)snprintf(text[1], sizeof text[1], "%.*g", digits, b);
    if (a == b || strcmp(text[0], text[1]) != 0) break;
  }
  return digits;
}
