/* base/text_buffer.h - text that grows, for files written in one piece.
 *
 * Failures stick: after the first one every append does nothing, and
 * ambulo__text_status() tells at the end. The text is always NUL-terminated. */
#ifndef AMBULO_BASE_TEXT_BUFFER_H
#define AMBULO_BASE_TEXT_BUFFER_H

#include "base/alloc.h"

typedef struct ambulo__text_buffer {
  ambulo_allocator allocator;
  struct ambulo__text_buffer *whole; /* that this one makes a part of; NULL: none */
  char *data;                        /* NULL until the first append: use ambulo__text_data() */
  size_t length, capacity;
  int failed;
} ambulo__text_buffer;

void ambulo__text_init(ambulo__text_buffer *buffer, const ambulo_allocator *allocator);
/* A buffer for a part of another text, such as a label of a picture: when it is cleared or freed,
 * its failure becomes one of the whole, which lacks that part. */
void ambulo__text_init_part(ambulo__text_buffer *part, ambulo__text_buffer *whole);
void ambulo__text_free(ambulo__text_buffer *buffer); /* accepts a zero-filled buffer */
/* Empties the buffer and keeps its memory; clears the failure. */
void ambulo__text_clear(ambulo__text_buffer *buffer);

void ambulo__text_append(ambulo__text_buffer *buffer, const char *text);
void ambulo__text_append_bytes(ambulo__text_buffer *buffer, const char *bytes, size_t length);
void ambulo__text_append_char(ambulo__text_buffer *buffer, char c);
/* Shortest form that reads back to the same double (base/numtext.h). */
void ambulo__text_append_number(ambulo__text_buffer *buffer, double value);
/* printf-like. Floating-point conversions would follow the locale: print numbers with
 * ambulo__text_append_number(). */
void ambulo__text_append_format(ambulo__text_buffer *buffer, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Never NULL. */
const char *ambulo__text_data(const ambulo__text_buffer *buffer);
/* AMBULO_OK or E_MEMORY. */
ambulo_status ambulo__text_status(const ambulo__text_buffer *buffer);

#endif
