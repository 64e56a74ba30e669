/* show/packed_text.c - see packed_text.h. */
#include "show/packed_text.h"

#include "formats/deflate.h"

static void append_base64(ambulo__text_buffer *out, const char *bytes, size_t length) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (size_t at = 0; at < length; at += 3) {
    unsigned value = 0;
    for (size_t i = at; i < at + 3; i++)
      value = value << 8 | (i < length ? (unsigned)(unsigned char)bytes[i] : 0u);
    for (size_t i = 0; i < 4; i++)
      ambulo__text_append_char(out, at + i > length ? '=' : digits[(value >> (18 - 6 * i)) & 63]);
  }
}

void ambulo__packed_text(ambulo__text_buffer *out, const char *text, size_t length) {
  ambulo__text_buffer packed;
  ambulo__text_init_part(&packed, out);
  ambulo__deflate(&packed, text, length);
  ambulo__text_append_char(out, '"');
  append_base64(out, ambulo__text_data(&packed), packed.length);
  ambulo__text_append_char(out, '"');
  ambulo__text_free(&packed);
}
