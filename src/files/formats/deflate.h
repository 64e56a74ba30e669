/* formats/deflate.h - compressed text: the deflate format (RFC 1951), as zlib, browsers and ZIP
 * files read it. zlib makes it; where it was not there at build time the text stands in the format
 * as it is. */
#ifndef AMBULO_FORMATS_DEFLATE_H
#define AMBULO_FORMATS_DEFLATE_H

#include "base/text_buffer.h"

/* Appends bytes [length], compressed; what is appended may hold zeros. The same bytes every time
 * from one version of zlib. */
void ambulo__deflate(ambulo__text_buffer *out, const char *bytes, size_t length);

/* Appends what compressed bytes hold, at most `limit` of it. E_IO: built without zlib; E_PARSE:
 * they are damaged, or hold more; E_MEMORY. */
ambulo_status ambulo__inflate(ambulo__text_buffer *out, const char *bytes, size_t length,
                              size_t limit);

#endif
