/* format/deflate.c - see deflate.h.
 *
 * What has stood in the last 32768 bytes is told by its length and distance (Ziv & Lempel 1977):
 * the places of three bytes are found by a hash, the newest first, and a match waits for the next
 * byte's, which may be longer. Each block of tokens gets codes of its own (huffman.h), told before
 * it by their lengths.
 */
#include "format/deflate.h"

#include <string.h>

#include "format/huffman.h"

enum {
  WINDOW = 32768,
  HASHES = 32768,
  SHORTEST = 3,
  LONGEST = 258,
  CHAIN = 256, /* places that are tried */
  GOOD = 64,   /* a match so long does not wait */
  NEAR_THREE = 256,
  NEAR_FOUR = 2048,
  TOKENS = 16384,  /* of a block */
  BLOCK_END = 256, /* a literal, RFC 1951 */
  LITERALS = 286,
  DISTANCES = 30,
  LENGTH_CODES = 19 /* symbols that tell the lengths of codes */
};

/* RFC 1951, 3.2.5: the least length and distance of each code, and how many bits follow it */
static const short length_base[] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                    31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
static const short length_bits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                    2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
static const unsigned short distance_base[] = {
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
static const short distance_bits[] = {0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                      6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};

typedef struct token {
  unsigned short length;   /* 0: a literal */
  unsigned short distance; /* or the literal */
} token;

typedef struct deflater {
  ambulo__text_buffer *out;
  const unsigned char *bytes;
  size_t length;
  unsigned long held; /* bits that are no whole byte yet, the first lowest */
  int held_bits;
  size_t newest[HASHES]; /* place + 1 of the last three bytes with that hash; 0: none */
  size_t before[WINDOW]; /* of a place, modulo WINDOW: the one before it, likewise */
  token token[TOKENS];
  int tokens;
} deflater;

/* ----------------------------------------------------------------------- bits */

static void put(deflater *d, unsigned value, int bits) {
  d->held |= (unsigned long)value << d->held_bits;
  for (d->held_bits += bits; d->held_bits >= 8; d->held_bits -= 8, d->held >>= 8)
    ambulo__text_append_char(d->out, (char)(unsigned char)(d->held & 255));
}

static void put_symbol(deflater *d, const ambulo__huffman *h, int symbol) {
  put(d, h->code[symbol], h->length[symbol]);
}

/* --------------------------------------------------------------------- blocks */

static int length_code(int length) {
  int code = 0;
  while (code < 28 && length_base[code + 1] <= length) code++;
  return code;
}

static int distance_code(int distance) {
  int code = 0;
  while (code < DISTANCES - 1 && distance_base[code + 1] <= distance) code++;
  return code;
}

/* A run of code lengths, as RFC 1951, 3.2.7 tells them: its symbol, what follows it in how many
 * bits; returns how many lengths it stands for. */
static int run_of(const unsigned char *length, int left, int *symbol, int *extra, int *bits) {
  int run = 1;
  while (run < left && run < 138 && length[run] == length[0]) run++;
  if (length[0] != 0 || run < 3) {
    *symbol = length[0];
    *extra = *bits = 0;
    return 1;
  }
  *symbol = run < 11 ? 17 : 18;
  *extra = run < 11 ? run - 3 : run - 11;
  *bits = run < 11 ? 3 : 7;
  return run;
}

/* the two codes themselves */
static void put_codes(deflater *d, const ambulo__huffman *literal,
                      const ambulo__huffman *distance) {
  static const unsigned char order[] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
  unsigned char length[LITERALS + DISTANCES];
  unsigned count[LENGTH_CODES] = {0};
  int symbol, extra, bits, all = LITERALS + DISTANCES;
  ambulo__huffman lengths;
  memcpy(length, literal->length, LITERALS);
  memcpy(length + LITERALS, distance->length, DISTANCES);
  for (int i = 0; i < all; count[symbol]++)
    i += run_of(length + i, all - i, &symbol, &extra, &bits);
  ambulo__huffman_make(count, LENGTH_CODES, 7, &lengths);
  put(d, LITERALS - 257, 5);
  put(d, DISTANCES - 1, 5);
  put(d, LENGTH_CODES - 4, 4);
  for (int i = 0; i < LENGTH_CODES; i++) put(d, lengths.length[order[i]], 3);
  for (int i = 0; i < all;) {
    i += run_of(length + i, all - i, &symbol, &extra, &bits);
    put_symbol(d, &lengths, symbol);
    put(d, (unsigned)extra, bits);
  }
}

static void put_match(deflater *d, const ambulo__huffman *literal, const ambulo__huffman *distance,
                      token t) {
  int code = length_code(t.length);
  put_symbol(d, literal, BLOCK_END + 1 + code);
  put(d, (unsigned)(t.length - length_base[code]), length_bits[code]);
  code = distance_code(t.distance);
  put_symbol(d, distance, code);
  put(d, (unsigned)(t.distance - distance_base[code]), distance_bits[code]);
}

static void put_block(deflater *d, int is_last) {
  unsigned literals[LITERALS] = {0}, distances[DISTANCES] = {0};
  ambulo__huffman literal, distance;
  literals[BLOCK_END] = 1;
  for (int i = 0; i < d->tokens; i++) {
    token t = d->token[i];
    literals[t.length ? BLOCK_END + 1 + length_code(t.length) : t.distance]++;
    if (t.length) distances[distance_code(t.distance)]++;
  }
  ambulo__huffman_make(literals, LITERALS, AMBULO__HUFFMAN_LONGEST, &literal);
  ambulo__huffman_make(distances, DISTANCES, AMBULO__HUFFMAN_LONGEST, &distance);
  put(d, is_last ? 1 : 0, 1);
  put(d, 2, 2); /* codes of its own */
  put_codes(d, &literal, &distance);
  for (int i = 0; i < d->tokens; i++) {
    if (d->token[i].length)
      put_match(d, &literal, &distance, d->token[i]);
    else
      put_symbol(d, &literal, d->token[i].distance);
  }
  put_symbol(d, &literal, BLOCK_END);
  d->tokens = 0;
}

/* -------------------------------------------------------------------- matches */

static unsigned hash_at(const deflater *d, size_t at) {
  const unsigned char *b = d->bytes + at;
  unsigned three = (unsigned)b[0] | (unsigned)b[1] << 8 | (unsigned)b[2] << 16;
  return (three * 2654435761u) >> 17;
}

static void remember(deflater *d, size_t at) {
  if (at + SHORTEST > d->length) return;
  unsigned hash = hash_at(d, at);
  d->before[at % WINDOW] = d->newest[hash];
  d->newest[hash] = at + 1;
}

/* a short match far away takes more bits than its bytes do, which are mostly digits */
static int pays(int length, size_t distance) {
  return length > 4 || distance <= (length == 3 ? NEAR_THREE : NEAR_FOUR);
}

/* the longest match at that place among those before it; length 0: none */
static token match_at(const deflater *d, size_t at) {
  token best = {.length = 0};
  if (at + SHORTEST > d->length) return best;
  size_t left = d->length - at;
  int most = left < LONGEST ? (int)left : LONGEST, longest = SHORTEST - 1;
  const unsigned char *here = d->bytes + at;
  size_t next = d->newest[hash_at(d, at)];
  for (int tries = 0; next > 0 && next + WINDOW > at + 1 && tries < CHAIN; tries++) {
    const unsigned char *there = d->bytes + (next - 1);
    int length = 0;
    while (length < most && there[length] == here[length]) length++;
    if (length > longest && pays(length, (size_t)(here - there))) {
      longest = length;
      best.length = (unsigned short)length;
      best.distance = (unsigned short)(here - there);
    }
    if (longest == most) break;
    size_t older = d->before[(next - 1) % WINDOW];
    next = older < next ? older : 0;
  }
  return best;
}

static void take(deflater *d, token t) {
  d->token[d->tokens++] = t;
  if (d->tokens == TOKENS) put_block(d, 0);
}

void ambulo__deflate(ambulo__text_buffer *out, const char *bytes, size_t length) {
  deflater *d = ambulo__alloc(&out->allocator, 1, sizeof *d);
  if (!d) {
    out->failed = 1;
    return;
  }
  d->out = out;
  d->bytes = (const unsigned char *)bytes;
  d->length = length;
  for (size_t at = 0; at < length;) {
    token match = match_at(d, at), literal = {.distance = d->bytes[at]};
    remember(d, at);
    int waits =
        match.length > 0 && match.length < GOOD && match_at(d, at + 1).length > match.length;
    size_t end = at + (match.length && !waits ? match.length : 1u);
    take(d, end - at > 1 ? match : literal);
    while (++at < end) remember(d, at);
  }
  put_block(d, 1);
  if (d->held_bits > 0) put(d, 0, 8 - d->held_bits);
  ambulo__free(&out->allocator, d);
}
