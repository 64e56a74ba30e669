/* formats/deflate.c - see deflate.h. */
#include "formats/deflate.h"

#ifdef AMBULO_HAS_ZLIB

#define ZLIB_CONST
#include <limits.h>
#include <zlib.h>

/* zlib's own memory comes from the text's */
static voidpf take(voidpf allocator, uInt items, uInt size) {
  return ambulo__alloc(allocator, items, size);
}

static void give(voidpf allocator, voidpf block) {
  ambulo__free(allocator, block);
}

/* all of zlib's input, and its output */
static void pump(z_stream *stream, const char *bytes, size_t length, ambulo__text_buffer *out) {
  char piece[4096];
  int said = Z_OK;
  while (said == Z_OK && !out->failed) {
    if (stream->avail_in == 0) {
      uInt next = length < UINT_MAX ? (uInt)length : UINT_MAX;
      stream->next_in = (const Bytef *)bytes;
      stream->avail_in = next;
      bytes += next;
      length -= next;
    }
    stream->next_out = (Bytef *)piece;
    stream->avail_out = sizeof piece;
    said = deflate(stream, length == 0 ? Z_FINISH : Z_NO_FLUSH);
    ambulo__text_append_bytes(out, piece, sizeof piece - stream->avail_out);
  }
  if (said != Z_STREAM_END) out->failed = 1;
}

void ambulo__deflate(ambulo__text_buffer *out, const char *bytes, size_t length) {
  enum { RAW = -MAX_WBITS };
  z_stream stream = {.zalloc = take, .zfree = give, .opaque = &out->allocator};
  if (out->failed) return;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, RAW, MAX_MEM_LEVEL,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    out->failed = 1;
    return;
  }
  pump(&stream, bytes, length, out);
  (void)deflateEnd(&stream);
}

ambulo_status ambulo__inflate(ambulo__text_buffer *out, const char *bytes, size_t length,
                              size_t limit) {
  enum { RAW = -MAX_WBITS };
  char piece[4096];
  z_stream stream = {.zalloc = take, .zfree = give, .opaque = &out->allocator};
  if (length > UINT_MAX) return AMBULO_E_PARSE;
  stream.next_in = (const Bytef *)bytes;
  stream.avail_in = (uInt)length;
  if (inflateInit2(&stream, RAW) != Z_OK) return AMBULO_E_MEMORY;
  int said = Z_OK;
  while (said == Z_OK && stream.total_out <= limit && !out->failed) {
    stream.next_out = (Bytef *)piece;
    stream.avail_out = sizeof piece;
    said = inflate(&stream, Z_NO_FLUSH);
    ambulo__text_append_bytes(out, piece, sizeof piece - stream.avail_out);
  }
  int whole = said == Z_STREAM_END && stream.total_out <= limit;
  (void)inflateEnd(&stream);
  if (out->failed) return AMBULO_E_MEMORY;
  return whole ? AMBULO_OK : AMBULO_E_PARSE;
}

#else

ambulo_status ambulo__inflate(ambulo__text_buffer *out, const char *bytes, size_t length,
                              size_t limit) {
  (void)out, (void)bytes, (void)length, (void)limit;
  return AMBULO_E_IO;
}

/* RFC 1951, 3.2.4: blocks that are not compressed, each with its length and the complement of it */
void ambulo__deflate(ambulo__text_buffer *out, const char *bytes, size_t length) {
  enum { MOST = 65535 };
  int last = 0;
  while (!last) {
    size_t part = length < MOST ? length : MOST;
    last = part == length;
    unsigned size = (unsigned)part, complement = ~size & 0xffffu;
    const char head[5] = {(char)last, (char)(size & 255), (char)(size >> 8),
                          (char)(complement & 255), (char)(complement >> 8)};
    ambulo__text_append_bytes(out, head, sizeof head);
    ambulo__text_append_bytes(out, bytes, part);
    bytes += part;
    length -= part;
  }
}

#endif
