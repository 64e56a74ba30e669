/* formats/json_text.h - writing JSON: indentation, commas, escapes; numbers free of the locale. */
#ifndef AMBULO_FORMATS_JSON_TEXT_H
#define AMBULO_FORMATS_JSON_TEXT_H

#include "base/text_buffer.h"

typedef struct ambulo__json {
  ambulo__text_buffer *text;
  int depth, first; /* first: nothing yet stands in the innermost object or array */
} ambulo__json;

/* Keys are NULL inside arrays and for the outermost value. */
void ambulo__json_open(ambulo__json *json, const char *key, char bracket);      /* '{' or '[' */
void ambulo__json_close(ambulo__json *json, char bracket);                      /* '}' or ']' */
void ambulo__json_text(ambulo__json *json, const char *key, const char *value); /* NULL: null */
/* null for NaN and infinities, which JSON does not have */
void ambulo__json_number(ambulo__json *json, const char *key, double value);
void ambulo__json_integer(ambulo__json *json, const char *key, long long value);
/* 16 hexadecimal digits, as a text. */
void ambulo__json_hash(ambulo__json *json, const char *key, unsigned long long value);
/* A text in quotes, with its escapes; YAML reads it alike. */
void ambulo__json_quote(ambulo__text_buffer *text, const char *value);
/* A value that is JSON already. */
void ambulo__json_raw(ambulo__json *json, const char *key, const char *value);

#endif
