/* Reads the deflate format as raw bytes, by zlib; without it blocks that are not compressed (RFC
 * 1951, 3.2.4), which is all that is written then. And base64 (RFC 4648). */
#ifndef AMBULO_TESTS_INFLATE_H
#define AMBULO_TESTS_INFLATE_H

#include <stdlib.h>
#include <string.h>

#include "support/test.h"

#ifdef AMBULO_HAS_ZLIB
#define ZLIB_CONST
#include <zlib.h>

static void unpack(const unsigned char *bytes, size_t length, unsigned char *out, size_t *size) {
  z_stream stream = {.next_in = bytes,
                     .avail_in = (unsigned)length,
                     .next_out = out,
                     .avail_out = (unsigned)*size};
  assert_int_equal(inflateInit2(&stream, -MAX_WBITS), Z_OK);
  assert_int_equal(inflate(&stream, Z_FINISH), Z_STREAM_END);
  assert_int_equal(stream.avail_in, 0);
  *size = stream.total_out;
  (void)inflateEnd(&stream);
}
#else
static void unpack(const unsigned char *bytes, size_t length, unsigned char *out, size_t *size) {
  size_t at = 0;
  *size = 0;
  for (int last = 0; !last; at += 5) {
    assert_true(at + 5 <= length);
    size_t part = bytes[at + 1] | (size_t)bytes[at + 2] << 8;
    last = bytes[at];
    assert_int_equal(part ^ (bytes[at + 3] | (size_t)bytes[at + 4] << 8), 0xffff);
    memcpy(out + *size, bytes + at + 5, part);
    *size += part;
    at += part;
  }
  assert_int_equal(at, length);
}
#endif

/* To be freed; a zero stands behind it. */
static unsigned char *unpacked(const char *bytes, size_t length, size_t *size) {
  enum { MOST = 1 << 24 };
  unsigned char *out = malloc(MOST + 1);
  assert_non_null(out);
  *size = MOST;
  unpack((const unsigned char *)bytes, length, out, size);
  out[*size] = 0;
  return out;
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
