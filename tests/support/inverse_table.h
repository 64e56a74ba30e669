/* tests/support/inverse_table.h - the table that an inverse dynamics gave, cell by cell. */
#ifndef AMBULO_TESTS_INVERSE_TABLE_H
#define AMBULO_TESTS_INVERSE_TABLE_H

#include "ambulo/tools/tools.h"
#include "formats/motion_file.h"
#include "support/messages.h"
#include "support/motion_text.h"

static inline double table_cell(const ambulo__motion *m, int row, const char *name) {
  int column = ambulo__motion_column(m, name);
  if (column < 0) print_error("no column %s\n", name);
  assert_true(column >= 0);
  return m->values[row * m->columns + column];
}

static inline ambulo__motion *table_of_text(const char *text) {
  ambulo__motion *m = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "result", AMBULO__MOTION_CSV, NULL, NULL, &m),
      AMBULO_OK);
  return m;
}

/* Inverse dynamics of a file, read back; NULL unless it succeeds. */
static inline ambulo__motion *inverse_of(const ambulo_model *model, const char *path,
                                         const ambulo_inverse_options *options,
                                         ambulo_diagnostics *list, ambulo_status expected) {
  char *text = NULL;
  ambulo_status status = ambulo_inverse_dynamics_motion(
      model, path, NULL, options, NULL, list,
      &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  if (status != expected && ambulo_diagnostics_count(list)) assert_message(list, 0, "(no message)");
  assert_int_equal(status, expected);
  if (status) {
    assert_null(text);
    return NULL;
  }
  ambulo__motion *m = table_of_text(text);
  ambulo_text_free(text, NULL);
  return m;
}

/* The list's messages are these; frees the list. */
static inline void assert_messages(ambulo_diagnostics *list, const char *const *messages) {
  size_t count = 0;
  while (messages[count]) count++;
  if (ambulo_diagnostics_count(list) != count) {
    for (size_t i = 0; i < ambulo_diagnostics_count(list); i++)
      print_error("message %zu: %s\n", i, ambulo_diagnostics_get(list, i)->message);
  }
  assert_int_equal(ambulo_diagnostics_count(list), count);
  for (size_t i = 0; i < count; i++) assert_message(list, i, messages[i]);
  ambulo_diagnostics_free(list);
}

#endif
