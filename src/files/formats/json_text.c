/* formats/json_text.c - JSON (RFC 8259), two spaces a level. */
#include "formats/json_text.h"

#include <math.h>

void ambulo__json_quote(ambulo__text_buffer *text, const char *value) {
  ambulo__text_append_char(text, '"');
  for (const char *c = value; *c; c++) {
    unsigned char byte = (unsigned char)*c;
    if (byte == '"' || byte == '\\') {
      ambulo__text_append_char(text, '\\');
      ambulo__text_append_char(text, *c);
    } else if (byte < 0x20 || byte == 0x7f) {
      ambulo__text_append_format(text, "\\u%04x", byte);
    } else {
      ambulo__text_append_char(text, *c);
    }
  }
  ambulo__text_append_char(text, '"');
}

static void new_line(ambulo__json *json) {
  ambulo__text_append_char(json->text, '\n');
  for (int i = 0; i < json->depth; i++) ambulo__text_append(json->text, "  ");
}

static void begin_value(ambulo__json *json, const char *key) {
  if (json->depth > 0) {
    if (!json->first) ambulo__text_append_char(json->text, ',');
    new_line(json);
  }
  json->first = 0;
  if (!key) return;
  ambulo__json_quote(json->text, key);
  ambulo__text_append(json->text, ": ");
}

void ambulo__json_open(ambulo__json *json, const char *key, char bracket) {
  begin_value(json, key);
  ambulo__text_append_char(json->text, bracket);
  json->depth++;
  json->first = 1;
}

void ambulo__json_close(ambulo__json *json, char bracket) {
  json->depth--;
  if (!json->first) new_line(json);
  ambulo__text_append_char(json->text, bracket);
  if (json->depth == 0) ambulo__text_append_char(json->text, '\n');
  json->first = 0;
}

void ambulo__json_text(ambulo__json *json, const char *key, const char *value) {
  begin_value(json, key);
  if (value) {
    ambulo__json_quote(json->text, value);
  } else {
    ambulo__text_append(json->text, "null");
  }
}

void ambulo__json_number(ambulo__json *json, const char *key, double value) {
  begin_value(json, key);
  if (isfinite(value)) {
    ambulo__text_append_number(json->text, value);
  } else {
    ambulo__text_append(json->text, "null");
  }
}

void ambulo__json_integer(ambulo__json *json, const char *key, long long value) {
  begin_value(json, key);
  ambulo__text_append_format(json->text, "%lld", value);
}

void ambulo__json_hash(ambulo__json *json, const char *key, unsigned long long value) {
  begin_value(json, key);
  ambulo__text_append_format(json->text, "\"%016llx\"", value);
}

void ambulo__json_raw(ambulo__json *json, const char *key, const char *value) {
  begin_value(json, key);
  ambulo__text_append(json->text, value);
}
