/* study/filter.c - one comparison: "speed < 1.5", "subject.sex == female".
 *
 * Both sides are axis names, numbers or words. Numbers compare as numbers, anything else as
 * text, and then only for equality. */
#include "base/numtext.h"
#include "study/sweep.h"

#include <stdio.h>
#include <string.h>

typedef enum comparison { LESS, LESS_EQUAL, GREATER, GREATER_EQUAL, EQUAL, DIFFERENT } comparison;

static int is_blank(char c) {
  return c == ' ' || c == '\t';
}

/* position and length of the operator; 0 if there is none */
static size_t find_operator(const char *text, size_t *at, comparison *which) {
  static const struct {
    const char *word;
    comparison which;
  } words[] = {{"<=", LESS_EQUAL}, {">=", GREATER_EQUAL}, {"==", EQUAL},
               {"!=", DIFFERENT},  {"<", LESS},           {">", GREATER}};
  *at = strcspn(text, "<>=!");
  for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
    size_t length = strlen(words[i].word);
    if (strncmp(text + *at, words[i].word, length) != 0) continue;
    *which = words[i].which;
    return length;
  }
  return 0;
}

/* trimmed copy of text[0..length); 0 if empty or too long */
static int side(const char *text, size_t length, char out[AMBULO__SWEEP_TEXT]) {
  while (length > 0 && is_blank(*text)) {
    text++;
    length--;
  }
  while (length > 0 && is_blank(text[length - 1])) length--;
  if (length == 0 || length >= AMBULO__SWEEP_TEXT) return 0;
  memcpy(out, text, length);
  out[length] = '\0';
  return 1;
}

static int compare_numbers(double a, double b, comparison which) {
  switch (which) {
  case LESS:
    return a < b;
  case LESS_EQUAL:
    return a <= b;
  case GREATER:
    return a > b;
  case GREATER_EQUAL:
    return a >= b;
  case EQUAL:
    return a == b;
  case DIFFERENT:
    break;
  }
  return a != b;
}

size_t ambulo__filter_sides(const char *filter, char left[AMBULO__SWEEP_TEXT],
                            char right[AMBULO__SWEEP_TEXT]) {
  size_t at = 0;
  comparison which = EQUAL;
  size_t length = find_operator(filter, &at, &which);
  const char *rest = filter + at + length;
  return length && side(filter, at, left) && side(rest, strlen(rest), right) ? length : 0;
}

int ambulo__filter_holds(const char *filter, const char *(*text_of)(void *user, const char *name),
                         void *user) {
  char left[AMBULO__SWEEP_TEXT], right[AMBULO__SWEEP_TEXT];
  size_t at = 0;
  comparison which = EQUAL;
  size_t length = find_operator(filter, &at, &which);
  const char *rest = filter + at + length;
  if (!length || !side(filter, at, left) || !side(rest, strlen(rest), right)) return -1;
  const char *a = text_of(user, left), *b = text_of(user, right);
  if (!a) a = left;
  if (!b) b = right;
  double x = 0.0, y = 0.0;
  if (ambulo__parse_double(a, strlen(a), &x) && ambulo__parse_double(b, strlen(b), &y))
    return compare_numbers(x, y, which);
  if (which == EQUAL) return strcmp(a, b) == 0;
  if (which == DIFFERENT) return strcmp(a, b) != 0;
  return -1;
}
