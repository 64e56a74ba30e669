/* Reads the deflate format (RFC 1951), blocks with codes of their own alone, and base64 (RFC 4648):
 * bit by bit, from tables of lengths. */
#ifndef AMBULO_TESTS_INFLATE_H
#define AMBULO_TESTS_INFLATE_H

#include <stdlib.h>
#include <string.h>

#include "support/test.h"

typedef struct inflater {
  const unsigned char *bytes;
  size_t length, bit;
  unsigned char *out;
  size_t size, capacity;
} inflater;

static unsigned inflate_bits(inflater *s, int count) {
  unsigned value = 0;
  for (int i = 0; i < count; i++, s->bit++) {
    assert_true(s->bit / 8 < s->length);
    value |= ((unsigned)s->bytes[s->bit / 8] >> (s->bit % 8) & 1u) << i;
  }
  return value;
}

/* the symbol whose code comes next; codes are found anew from the lengths (RFC 1951, 3.2.2) */
static int inflate_symbol(inflater *s, const unsigned char *length, int symbols) {
  unsigned code = 0, first = 0;
  for (int bits = 1; bits <= 15; bits++) {
    unsigned count = 0;
    code = code << 1 | inflate_bits(s, 1);
    for (int i = 0; i < symbols; i++) count += length[i] == bits;
    if (code < first + count) {
      for (int i = 0; i < symbols; i++)
        if (length[i] == bits && code == first++) return i;
    }
    first = (first + count) << 1;
  }
  fail_msg("no code has these bits");
  return -1;
}

static void inflate_put(inflater *s, unsigned char byte) {
  if (s->size + 1 >= s->capacity) {
    s->capacity = 2 * s->capacity + 1024;
    s->out = realloc(s->out, s->capacity);
    assert_non_null(s->out);
  }
  s->out[s->size++] = byte;
  s->out[s->size] = 0;
}

static void inflate_codes(inflater *s, unsigned char *length, int *literals, int *distances) {
  static const int order[] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  unsigned char tells[19] = {0};
  *literals = (int)inflate_bits(s, 5) + 257;
  *distances = (int)inflate_bits(s, 5) + 1;
  int told = (int)inflate_bits(s, 4) + 4, all = *literals + *distances;
  assert_true(*literals <= 286 && *distances <= 30);
  for (int i = 0; i < told; i++) tells[order[i]] = (unsigned char)inflate_bits(s, 3);
  for (int i = 0; i < all;) {
    int symbol = inflate_symbol(s, tells, 19);
    int run = symbol < 16    ? 1
              : symbol == 16 ? 3 + (int)inflate_bits(s, 2)
              : symbol == 17 ? 3 + (int)inflate_bits(s, 3)
                             : 11 + (int)inflate_bits(s, 7);
    assert_true(i + run <= all && (symbol != 16 || i > 0));
    unsigned char value = symbol < 16 ? (unsigned char)symbol : symbol == 16 ? length[i - 1] : 0;
    while (run-- > 0) length[i++] = value;
  }
}

static void inflate_match(inflater *s, int symbol, const unsigned char *length, int distances) {
  int group = symbol < 265 ? 0 : (symbol - 261) / 4, run = symbol - 254;
  if (group > 0) run = 3 + ((4 + (symbol - 261) % 4) << group) + (int)inflate_bits(s, group);
  if (symbol == 285) run = 258;
  if (symbol == 285) s->bit -= (size_t)group;
  int code = inflate_symbol(s, length, distances), more = code < 4 ? 0 : code / 2 - 1;
  size_t distance = code < 4 ? (size_t)code + 1 : ((2u + (unsigned)code % 2) << more) + 1;
  distance += inflate_bits(s, more);
  assert_true(distance <= s->size);
  while (run-- > 0) inflate_put(s, s->out[s->size - distance]);
}

/* To be freed; a zero stands behind it. */
static unsigned char *inflate(const char *bytes, size_t length, size_t *size) {
  inflater s = {.bytes = (const unsigned char *)bytes, .length = length};
  unsigned char codes[286 + 30];
  inflate_put(&s, 0);
  s.size = 0;
  for (int last = 0, literals, distances; !last;) {
    last = (int)inflate_bits(&s, 1);
    assert_int_equal(inflate_bits(&s, 2), 2);
    inflate_codes(&s, codes, &literals, &distances);
    for (int symbol; (symbol = inflate_symbol(&s, codes, literals)) != 256;) {
      if (symbol < 256)
        inflate_put(&s, (unsigned char)symbol);
      else
        inflate_match(&s, symbol, codes + literals, distances);
    }
  }
  assert_int_equal((s.bit + 7) / 8, length);
  s.out[s.size] = 0;
  *size = s.size;
  return s.out;
}

/* Bytes that base64 stands for; to be freed. */
static inline char *unbase64(const char *text, size_t *size) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  size_t length = strlen(text);
  char *bytes = malloc(length + 1);
  assert_non_null(bytes);
  assert_int_equal(length % 4, 0);
  *size = 0;
  for (size_t i = 0; i < length; i += 4) {
    unsigned value = 0;
    int known = 0;
    for (size_t k = i; k < i + 4; k++) {
      const char *at = text[k] == '=' ? NULL : strchr(digits, text[k]);
      assert_true(at || (text[k] == '=' && i + 4 == length));
      value = value << 6 | (at ? (unsigned)(at - digits) : 0u);
      known += at != NULL;
    }
    for (int b = 0; b < known - 1; b++) bytes[(*size)++] = (char)(value >> (16 - 8 * b) & 255);
  }
  return bytes;
}

#endif
