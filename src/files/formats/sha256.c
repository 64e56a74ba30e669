/* formats/sha256.c - SHA-256 as FIPS 180-4 writes it down: names and section numbers are its own.
 */
#include "formats/sha256.h"

#include <string.h>

enum { BLOCK = 64, WORDS = 64, LENGTH_AT = 56 };

/* 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64 primes */
static const uint32_t K[WORDS] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

static uint32_t rotate(uint32_t x, int n) {
  return x >> n | x << (32 - n);
}

/* 6.2.2, step 1: the message schedule */
static void schedule(uint32_t W[WORDS], const unsigned char *block) {
  for (int t = 0; t < 16; t++)
    W[t] = (uint32_t)block[4 * t] << 24 | (uint32_t)block[4 * t + 1] << 16 |
           (uint32_t)block[4 * t + 2] << 8 | (uint32_t)block[4 * t + 3];
  for (int t = 16; t < WORDS; t++) {
    uint32_t x = W[t - 15], y = W[t - 2];
    uint32_t sigma0 = rotate(x, 7) ^ rotate(x, 18) ^ x >> 3;
    uint32_t sigma1 = rotate(y, 17) ^ rotate(y, 19) ^ y >> 10;
    W[t] = sigma1 + W[t - 7] + sigma0 + W[t - 16];
  }
}

/* 6.2.2, steps 2 to 4 */
static void compress(uint32_t H[8], const unsigned char *block) {
  uint32_t W[WORDS];
  schedule(W, block);
  uint32_t a = H[0], b = H[1], c = H[2], d = H[3], e = H[4], f = H[5], g = H[6], h = H[7];
  for (int t = 0; t < WORDS; t++) {
    uint32_t sum1 = rotate(e, 6) ^ rotate(e, 11) ^ rotate(e, 25);
    uint32_t choice = (e & f) ^ (~e & g);
    uint32_t T1 = h + sum1 + choice + K[t] + W[t];
    uint32_t sum0 = rotate(a, 2) ^ rotate(a, 13) ^ rotate(a, 22);
    uint32_t majority = (a & b) ^ (a & c) ^ (b & c);
    h = g;
    g = f;
    f = e;
    e = d + T1;
    d = c;
    c = b;
    b = a;
    a = T1 + sum0 + majority;
  }
  const uint32_t working[8] = {a, b, c, d, e, f, g, h};
  for (int i = 0; i < 8; i++) H[i] += working[i];
}

void ambulo__sha256_begin(ambulo__sha256 *hash) {
  /* 5.3.3: square roots of the first eight primes */
  static const uint32_t first[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                    0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  memset(hash, 0, sizeof *hash);
  memcpy(hash->state, first, sizeof first);
}

void ambulo__sha256_add(ambulo__sha256 *hash, const void *bytes, size_t length) {
  const unsigned char *from = bytes;
  size_t held = (size_t)(hash->length % BLOCK);
  hash->length += length;
  while (length > 0) {
    if (held == 0 && length >= BLOCK) {
      compress(hash->state, from);
      from += BLOCK;
      length -= BLOCK;
      continue;
    }
    size_t taken = BLOCK - held < length ? BLOCK - held : length;
    memcpy(hash->block + held, from, taken);
    from += taken;
    length -= taken;
    held = (held + taken) % BLOCK;
    if (held == 0) compress(hash->state, hash->block);
  }
}

/* 5.1.1: a one bit, zeros, and the length in bits in the last eight bytes of a block */
static void pad(ambulo__sha256 *hash) {
  static const unsigned char filler[BLOCK] = {0x80};
  uint64_t bits = 8 * hash->length;
  size_t held = (size_t)(hash->length % BLOCK);
  unsigned char length[8];
  for (int i = 0; i < 8; i++) length[i] = (unsigned char)(bits >> (56 - 8 * i));
  ambulo__sha256_add(hash, filler, (held < LENGTH_AT ? LENGTH_AT : BLOCK + LENGTH_AT) - held);
  ambulo__sha256_add(hash, length, sizeof length);
}

void ambulo__sha256_end(ambulo__sha256 *hash, char text[AMBULO__SHA256_TEXT]) {
  static const char digits[] = "0123456789abcdef";
  pad(hash);
  for (int i = 0; i < 64; i++) text[i] = digits[hash->state[i / 8] >> (28 - 4 * (i % 8)) & 15];
  text[64] = '\0';
}

void ambulo__sha256_of(const void *bytes, size_t length, char text[AMBULO__SHA256_TEXT]) {
  ambulo__sha256 hash;
  ambulo__sha256_begin(&hash);
  ambulo__sha256_add(&hash, bytes, length);
  ambulo__sha256_end(&hash, text);
}
