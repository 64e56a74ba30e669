/* cli/format.c - see format.h. */
#include "cli/format.h"

#include <stdarg.h>
#include <stdio.h>

void ambulo__cli_format(char *buffer, size_t size, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(buffer, size, format, arguments);
  va_end(arguments);
  if (length < 0 && size > 0) buffer[0] = '\0';
}
