/* people/doubt.c - see doubt.h. */
#include "people/doubt.h"

#include <stdarg.h>
#include <stdio.h>

void ambulo__doubt(ambulo__doubts *doubts, const char *file, const char *hint, const char *format,
                   ...) {
  char text[1024] = "";
  ambulo__place place = {.file = file};
  va_list arguments;
  va_start(arguments, format);
  (void)vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  doubts->count++;
  if (doubts->strict) {
    (void)ambulo__error(doubts->diagnostics, AMBULO_E_SCHEMA, place, hint, "%s", text);
  } else {
    ambulo__warning(doubts->diagnostics, place, hint, "%s", text);
  }
}

void ambulo__doubt_header(ambulo__doubts *doubts, const char *file, const ambulo__motion *table) {
  if (table->declared_columns < 0 || table->declared_columns == table->columns + 1) return;
  ambulo__doubt(doubts, file, NULL, "%d columns; the header says %d (nColumns)", table->columns + 1,
                table->declared_columns);
}

ambulo_status ambulo__doubts_status(const ambulo__doubts *doubts) {
  return doubts->strict && doubts->count > 0 ? AMBULO_E_SCHEMA : AMBULO_OK;
}
