/* page/packed_text.h - long texts inside of a page. */
#ifndef AMBULO_PAGE_PACKED_TEXT_H
#define AMBULO_PAGE_PACKED_TEXT_H

#include "base/text_buffer.h"

/* Appends a JSON string: text [length] compressed (format/deflate.h), in base64 (RFC 4648).
 * viewer/inflated.js reads it. */
void ambulo__packed_text(ambulo__text_buffer *out, const char *text, size_t length);

#endif
