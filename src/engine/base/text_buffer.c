/* base/text_buffer.c - growth by doubling; one terminating NUL beyond length. */
#include "base/text_buffer.h"
#include "base/numtext.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define FIRST_CAPACITY 256

void ambulo__text_init(ambulo__text_buffer *buffer, const ambulo_allocator *allocator) {
  memset(buffer, 0, sizeof *buffer);
  buffer->allocator = ambulo__allocator_or_default(allocator);
}

void ambulo__text_init_part(ambulo__text_buffer *part, ambulo__text_buffer *whole) {
  ambulo__text_init(part, &whole->allocator);
  part->whole = whole;
}

static void pass_on_failure(const ambulo__text_buffer *part) {
  if (part->failed && part->whole) part->whole->failed = 1;
}

void ambulo__text_free(ambulo__text_buffer *buffer) {
  ambulo_allocator allocator = buffer->allocator;
  pass_on_failure(buffer);
  ambulo__free(&allocator, buffer->data);
  ambulo__text_init(buffer, &allocator);
}

void ambulo__text_clear(ambulo__text_buffer *buffer) {
  pass_on_failure(buffer);
  buffer->length = 0;
  buffer->failed = 0;
  if (buffer->data) buffer->data[0] = '\0';
}

/* room for `extra` more characters and the NUL; 0 on failure */
static int reserve(ambulo__text_buffer *buffer, size_t extra) {
  if (buffer->failed) return 0;
  if (extra < buffer->capacity - buffer->length) return 1;
  if (extra >= SIZE_MAX / 4 || buffer->length >= SIZE_MAX / 4) {
    buffer->failed = 1;
    return 0;
  }
  size_t needed = buffer->length + extra + 1;
  size_t capacity = buffer->capacity ? 2 * buffer->capacity : FIRST_CAPACITY;
  if (capacity < needed) capacity = needed;
  char *data = ambulo__realloc(&buffer->allocator, buffer->data, capacity, 1);
  if (!data) {
    buffer->failed = 1;
    return 0;
  }
  buffer->data = data;
  buffer->capacity = capacity;
  return 1;
}

void ambulo__text_append_bytes(ambulo__text_buffer *buffer, const char *bytes, size_t length) {
  if (!reserve(buffer, length)) return;
  if (length > 0) memcpy(buffer->data + buffer->length, bytes, length);
  buffer->length += length;
  buffer->data[buffer->length] = '\0';
}

void ambulo__text_append(ambulo__text_buffer *buffer, const char *text) {
  ambulo__text_append_bytes(buffer, text, strlen(text));
}

void ambulo__text_append_char(ambulo__text_buffer *buffer, char c) {
  ambulo__text_append_bytes(buffer, &c, 1);
}

void ambulo__text_append_number(ambulo__text_buffer *buffer, double value) {
  ambulo__text_append(buffer, ambulo__number_text(value).text);
}

void ambulo__text_append_format(ambulo__text_buffer *buffer, const char *format, ...) {
  va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  int length = vsnprintf(NULL, 0, format, arguments);
  if (length < 0) {
    buffer->failed = 1;
  } else if (reserve(buffer, (size_t)length)) {
    vsnprintf(buffer->data + buffer->length, (size_t)length + 1, format, again);
    buffer->length += (size_t)length;
  }
  va_end(again);
  va_end(arguments);
}

const char *ambulo__text_data(const ambulo__text_buffer *buffer) {
  return buffer->data ? buffer->data : "";
}

ambulo_status ambulo__text_status(const ambulo__text_buffer *buffer) {
  return buffer->failed ? AMBULO_E_MEMORY : AMBULO_OK;
}
