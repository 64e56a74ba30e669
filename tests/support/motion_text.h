/* support/motion_text.h - a table of a test, written out in the test. */
#ifndef AMBULO_TESTS_MOTION_TEXT_H
#define AMBULO_TESTS_MOTION_TEXT_H

#include "formats/motion_file.h"

/* as ambulo__motion_read does with a file of that name */
static inline ambulo_status motion_read_text(const char *text, size_t length, const char *name,
                                             ambulo__motion_format format,
                                             const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics,
                                             ambulo__motion **motion) {
  return ambulo__table_read(text, length, name, format, 0, allocator, diagnostics, motion);
}

#endif
