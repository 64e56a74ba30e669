/* show/packed_text.h - long texts inside of a page. */
#ifndef AMBULO_SHOW_PACKED_TEXT_H
#define AMBULO_SHOW_PACKED_TEXT_H

#include "base/text_buffer.h"

/* Appends a JSON string: text [length] compressed (formats/deflate.h), in base64 (RFC 4648).
 * viewer/inflated.js reads it. */
void ambulo__packed_text(ambulo__text_buffer *out, const char *text, size_t length);

#endif
