/* formats/sha256.h - SHA-256 (FIPS 180-4): what tells whether a file is still what was written.
 *
 * Not for secrets: it finds damage, and anybody can compute it again with sha256sum. */
#ifndef AMBULO_FORMATS_SHA256_H
#define AMBULO_FORMATS_SHA256_H

#include <stddef.h>
#include <stdint.h>

/* 64 hexadecimal digits and a NUL */
enum { AMBULO__SHA256_TEXT = 65 };

typedef struct ambulo__sha256 {
  uint32_t state[8];
  uint64_t length; /* bytes so far */
  unsigned char block[64];
} ambulo__sha256;

void ambulo__sha256_begin(ambulo__sha256 *hash);
void ambulo__sha256_add(ambulo__sha256 *hash, const void *bytes, size_t length);
/* `hash` is used up. */
void ambulo__sha256_end(ambulo__sha256 *hash, char text[AMBULO__SHA256_TEXT]);

/* The three in one. */
void ambulo__sha256_of(const void *bytes, size_t length, char text[AMBULO__SHA256_TEXT]);

#endif
