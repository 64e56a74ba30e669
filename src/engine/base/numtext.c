/* base/numtext.c - numbers as text without the locale.
 *
 * Reading: the text is first checked against the grammar, then handed to strtod_l in the
 * "C" locale, which rounds correctly. Printing: the shortest of the 1- to 17-digit forms that
 * reads back to the same bits. Both use a "C" locale_t of their own for the call, so that
 * the process's locale is neither read nor changed. */
#define _GNU_SOURCE
#include "base/numtext.h"
#include "base/shortest_digits.h"

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

/* Whole hundredths, as most numbers of pictures are, without printf: h / 100 is the double nearest
 * to that decimal, so the text reads back, and it is the one that %.15g gives. 0: another number.
 */
static size_t print_hundredths(char *buffer, double value) {
  double h = rint(value * 100.0);
  if (!(fabs(h) < 1e15) || h / 100.0 != value || (value == 0.0 && signbit(value))) return 0;
  long long rest = (long long)fabs(h);
  char reversed[24];
  size_t count = 0, length = 0;
  int places = rest % 100 == 0 ? 0 : rest % 10 == 0 ? 1 : 2;
  for (int skipped = places; skipped < 2; skipped++) rest /= 10;
  for (int digit = 0; digit <= places || rest > 0; digit++) {
    if (digit == places && places > 0) reversed[count++] = '.';
    reversed[count++] = (char)('0' + rest % 10);
    rest /= 10;
  }
  if (h < 0.0) buffer[length++] = '-';
  while (count > 0) buffer[length++] = reversed[--count];
  buffer[length] = '\0';
  return length;
}

size_t ambulo__print_double(char buffer[AMBULO__NUMTEXT_SIZE], double value) {
  if (!isfinite(value)) {
    const char *word = isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
    memcpy(buffer, word, strlen(word) + 1);
    return strlen(word);
  }
  size_t length = print_hundredths(buffer, value);
  if (length == 0) length = ambulo__shortest_digits(buffer, value);
  if (length > 0) return length;
  /* every text of up to 15 digits survives in a normal double, so that %.15g already
     drops what is not needed; subnormal numbers carry fewer digits */
  for (int digits = fabs(value) < DBL_MIN ? 1 : 15; digits <= 17; digits++) {
    double back = 0.0;
    print_digits(buffer, digits, value);
    if (ambulo__parse_double(buffer, strlen(buffer), &back) && back == value) break;
  }
  return strlen(buffer);
}

ambulo__number ambulo__number_text(double value) {
  ambulo__number number;
  size_t length = ambulo__print_double(number.text, value);
  number.text[length] = '\0';
  return number;
}
