/* tests/support/sealed_lines.h - a sealed JSON text with the value of one line replaced, sealed
 * again: whole, and wrong all the same. */
#ifndef AMBULO_TESTS_SEALED_LINES_H
#define AMBULO_TESTS_SEALED_LINES_H

#include "formats/read_file.h"
#include "support/test.h"

/* The text with the value of line `line` (0: "{") replaced; buffer->data is NULL where that line
 * has none of its own. */
static inline ambulo__text_buffer sealed_with(const char *text, int line, const char *value) {
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, NULL);
  const char *seal = strstr(text, "  \"sha256\": \""), *at = text;
  assert_non_null(seal);
  for (int k = 0; k < line && at; k++) at = strchr(at, '\n') ? strchr(at, '\n') + 1 : NULL;
  const char *end = at ? strchr(at, '\n') : NULL, *colon = at ? strstr(at, "\": ") : NULL;
  if (!at || at >= seal || !colon || colon > end) return buffer;
  if (end[-1] == '{' || end[-1] == '[') return buffer;
  ambulo__text_append_bytes(&buffer, text, (size_t)(colon + 3 - text));
  ambulo__text_append(&buffer, value);
  if (end[-1] == ',') ambulo__text_append(&buffer, ",");
  ambulo__text_append_bytes(&buffer, end, (size_t)(seal - 2 - end)); /* without ",\n" */
  ambulo__seal(&buffer);
  return buffer;
}

#endif
