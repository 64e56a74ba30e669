/* tests/fuzz/mutate.h - changes of a text that leave it nearly one of its kind: lines and words are
 * moved, doubled, left out and replaced, numbers become others, blocks change their indentation.
 * The first byte, which picks a variant, rarely changes. */
#ifndef AMBULO_TESTS_FUZZ_MUTATE_H
#define AMBULO_TESTS_FUZZ_MUTATE_H

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static unsigned mutate_draw(uint32_t *state, unsigned most) {
  *state ^= *state << 13;
  *state ^= *state >> 17;
  *state ^= *state << 5;
  return most ? *state % most : 0;
}

typedef struct mutate_span {
  size_t begin, end;
} mutate_span;

/* the line around `at`, with its end */
static mutate_span mutate_line(const uint8_t *d, size_t n, size_t at) {
  mutate_span s = {at, at};
  while (s.begin > 1 && d[s.begin - 1] != '\n') s.begin--;
  while (s.end < n && d[s.end] != '\n') s.end++;
  if (s.end < n) s.end++;
  return s;
}

static int mutate_is_word(uint8_t c) {
  return isalnum(c) || c == '_' || c == '.' || c == '-' || c == '+';
}

/* the word at or behind `at`; empty: none */
static mutate_span mutate_word(const uint8_t *d, size_t n, size_t at) {
  while (at < n && !mutate_is_word(d[at])) at++;
  mutate_span s = {at, at};
  while (s.begin > 1 && mutate_is_word(d[s.begin - 1])) s.begin--;
  while (s.end < n && mutate_is_word(d[s.end])) s.end++;
  return s;
}

/* d[span] becomes text[length]; the new size, n where there is no room */
static size_t mutate_replace(uint8_t *d, size_t n, size_t most, mutate_span span, const void *text,
                             size_t length) {
  size_t gone = span.end - span.begin;
  if (n - gone + length > most) return n;
  memmove(d + span.begin + length, d + span.end, n - span.end);
  if (length) memcpy(d + span.begin, text, length);
  return n - gone + length;
}

static const char *const mutate_values[] = {"0",           "-1",
                                            "1",           "2",
                                            "1e-300",      "1e300",
                                            "-1e308",      "nan",
                                            "inf",         "-inf",
                                            "2147483647",  "2147483648",
                                            "-2147483649", "9223372036854775807",
                                            "1e9",         "0.5",
                                            "1e-9",        "100000",
                                            "4097",        "[]",
                                            "{}",          "null",
                                            "none",        "true",
                                            "false",       "~",
                                            "\"\"",        "''",
                                            "..",          "/",
                                            "&a",          "*a",
                                            "1e999",       "0x10",
                                            "1_000",       "1,5",
                                            "\xff\xfe",    "\xef\xbb\xbf",
                                            "-0",          ".",
                                            "1.",          ".5",
                                            "+3"};

static size_t mutate_lines(uint8_t *d, size_t n, size_t most, unsigned kind, uint32_t *state) {
  mutate_span a = mutate_line(d, n, 1 + mutate_draw(state, (unsigned)(n - 1)));
  mutate_span b = mutate_line(d, n, 1 + mutate_draw(state, (unsigned)(n - 1)));
  size_t length = a.end - a.begin;
  uint8_t *copy = malloc(length + 1);
  if (!copy) return n;
  memcpy(copy, d + a.begin, length);
  if (kind == 0) n = mutate_replace(d, n, most, a, NULL, 0);
  if (kind == 1) n = mutate_replace(d, n, most, (mutate_span){b.begin, b.begin}, copy, length);
  if (kind == 2) n = mutate_replace(d, n, most, b, copy, length);
  if (kind == 3)
    n = mutate_replace(d, n, most, (mutate_span){a.begin, a.begin}, "    ",
                       2 * (1 + mutate_draw(state, 2)));
  if (kind == 4 && length > 2 && d[a.begin] == ' ' && d[a.begin + 1] == ' ')
    n = mutate_replace(d, n, most, (mutate_span){a.begin, a.begin + 2}, NULL, 0);
  free(copy);
  return n;
}

static size_t mutate_words(uint8_t *d, size_t n, size_t most, unsigned kind, uint32_t *state) {
  mutate_span a = mutate_word(d, n, 1 + mutate_draw(state, (unsigned)(n - 1)));
  mutate_span b = mutate_word(d, n, 1 + mutate_draw(state, (unsigned)(n - 1)));
  size_t length = b.end - b.begin;
  if (kind < 3) {
    unsigned count = sizeof mutate_values / sizeof *mutate_values;
    const char *value = mutate_values[mutate_draw(state, count)];
    return mutate_replace(d, n, most, a, value, strlen(value));
  }
  uint8_t *copy = malloc(length + 1);
  if (!copy) return n;
  memcpy(copy, d + b.begin, length);
  n = kind == 3 ? mutate_replace(d, n, most, a, copy, length)
                : mutate_replace(d, n, most, a, NULL, 0);
  free(copy);
  return n;
}

/* in d[n] with room for `most`; the new size */
static size_t mutate(uint8_t *d, size_t n, size_t most, uint32_t *state) {
  if (n < 3) return n;
  for (unsigned changes = 1 + mutate_draw(state, 3); changes > 0 && n > 3; changes--) {
    unsigned kind = mutate_draw(state, 12);
    if (kind < 5)
      n = mutate_lines(d, n, most, kind, state);
    else if (kind < 10)
      n = mutate_words(d, n, most, kind - 5, state);
    else if (kind == 10)
      d[1 + mutate_draw(state, (unsigned)(n - 1))] ^= (uint8_t)(1U << mutate_draw(state, 8));
    else if (mutate_draw(state, 4) == 0)
      n = 1 + mutate_draw(state, (unsigned)n); /* cut short */
  }
  if (mutate_draw(state, 8) == 0) d[0] = (uint8_t)mutate_draw(state, 256);
  return n;
}

#endif
