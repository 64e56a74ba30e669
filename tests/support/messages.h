/* tests/support/messages.h - what a diagnostics list must say. */
#ifndef AMBULO_TESTS_MESSAGES_H
#define AMBULO_TESTS_MESSAGES_H

#include "ambulo/status.h"
#include "support/test.h"

/* message `index`, formatted, contains `text` */
static inline void assert_message(const ambulo_diagnostics *list, size_t index, const char *text) {
  char buffer[2048] = "";
  ambulo_diagnostics_format(list, index, buffer, sizeof buffer);
  if (strstr(buffer, text)) return;
  print_error("message %zu is\n  %s\nexpected it to contain\n  %s\n", index, buffer, text);
  fail();
}

#endif
