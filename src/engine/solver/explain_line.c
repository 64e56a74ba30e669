/* solver/explain_line.c - one line of an explanation, as explain.h declares it. */
#include "solver/explain.h"

#include <stdarg.h>
#include <stdio.h>

void ambulo__explain_line(ambulo__explanation *out, const char *format, ...) {
  if (out->view.line_count >= AMBULO__MOST_LINES) return;
  char *text = out->text[out->view.line_count];
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, AMBULO__LINE_SIZE, format, arguments);
  va_end(arguments);
  out->line[out->view.line_count++] = text;
}
