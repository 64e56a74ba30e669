/* exchange/markup.c - texts and numbers between the tags of XML (export.h). */
#include "exchange/export.h"

void ambulo__markup_text(ambulo__text_buffer *text, const char *before, const char *plain,
                         const char *after) {
  ambulo__text_append(text, before);
  for (const char *c = plain; *c; c++) {
    switch (*c) {
    case '&':
      ambulo__text_append(text, "&amp;");
      break;
    case '<':
      ambulo__text_append(text, "&lt;");
      break;
    case '>':
      ambulo__text_append(text, "&gt;");
      break;
    case '"':
      ambulo__text_append(text, "&quot;");
      break;
    default:
      ambulo__text_append_char(text, *c);
    }
  }
  ambulo__text_append(text, after);
}

void ambulo__markup_numbers(ambulo__text_buffer *text, const char *before, const double *values,
                            int count, const char *after) {
  ambulo__text_append(text, before);
  for (int i = 0; i < count; i++) {
    if (i) ambulo__text_append_char(text, ' ');
    ambulo__text_append_number(text, values[i] == 0.0 ? 0.0 : values[i]);
  }
  ambulo__text_append(text, after);
}

void ambulo__markup_tabs(ambulo__text_buffer *text, int depth) {
  while (depth-- > 0) ambulo__text_append_char(text, '\t');
}

void ambulo__markup_element(ambulo__text_buffer *text, int depth, const char *tag,
                            const double *values, int count) {
  ambulo__markup_tabs(text, depth);
  ambulo__text_append_format(text, "<%s>", tag);
  ambulo__markup_numbers(text, "", values, count, "");
  ambulo__text_append_format(text, "</%s>\n", tag);
}
