/* format/table_write.c - tables as CSV and STO (motion_file.h). */
#include "format/motion_file.h"

#include <string.h>

static void write_rows(const ambulo__motion *motion, char separator, ambulo__text_buffer *buffer) {
  ambulo__text_append(buffer, "time");
  for (int c = 0; c < motion->columns; c++) {
    ambulo__text_append_char(buffer, separator);
    ambulo__text_append(buffer, motion->names[c]);
  }
  ambulo__text_append_char(buffer, '\n');
  for (int r = 0; r < motion->rows; r++) {
    const double *row = motion->values + (size_t)r * (size_t)motion->columns;
    ambulo__text_append_number(buffer, motion->time[r]);
    for (int c = 0; c < motion->columns; c++) {
      ambulo__text_append_char(buffer, separator);
      ambulo__text_append_number(buffer, row[c]);
    }
    ambulo__text_append_char(buffer, '\n');
  }
}

void ambulo__motion_write_csv(const ambulo__motion *motion, const char *comment,
                              ambulo__text_buffer *buffer) {
  while (comment && *comment) {
    size_t length = strcspn(comment, "\n");
    ambulo__text_append(buffer, "# ");
    ambulo__text_append_bytes(buffer, comment, length);
    ambulo__text_append_char(buffer, '\n');
    comment += length + (comment[length] == '\n');
  }
  if (motion->in_degrees) ambulo__text_append(buffer, "# inDegrees=yes\n");
  write_rows(motion, ',', buffer);
}

void ambulo__motion_write_sto(const ambulo__motion *motion, const char *title,
                              ambulo__text_buffer *buffer) {
  ambulo__text_append(buffer, title);
  ambulo__text_append_format(buffer, "\nversion=1\nnRows=%d\nnColumns=%d\n", motion->rows,
                             motion->columns + 1);
  ambulo__text_append(buffer, motion->in_degrees ? "inDegrees=yes\n" : "inDegrees=no\n");
  ambulo__text_append(buffer, "endheader\n");
  write_rows(motion, '\t', buffer);
}
