/* formats/motion_columns.c - see motion_columns.h. */
#include "formats/motion_columns.h"

#include <string.h>

static int is_joined(const char *column, const char *before, const char *name, const char *after) {
  size_t head = strlen(before), length = strlen(name);
  return strncmp(column, before, head) == 0 && strncmp(column + head, name, length) == 0 &&
         strcmp(column + head + length, after) == 0;
}

/* ".../NAME" followed by `ending` */
static int is_path(const char *column, const char *name, const char *ending) {
  size_t length = strlen(column), size = strlen(name), tail = strlen(ending);
  if (length < size + tail + 1 || strncmp(column, "/forceset/", 10) == 0) return 0;
  const char *at = column + length - tail - size;
  return at[-1] == '/' && is_joined(at, "", name, ending);
}

int ambulo__motion_names(const char *column, const char *name, ambulo__motion_order order) {
  switch (order) {
  case AMBULO__ORDER_VALUE:
    return is_joined(column, "", name, "") || is_joined(column, "q.", name, "") ||
           is_path(column, name, "") || is_path(column, name, "/value");
  case AMBULO__ORDER_RATE:
    return is_joined(column, "qd.", name, "") || is_joined(column, "", name, "_u") ||
           is_path(column, name, "/speed");
  case AMBULO__ORDER_ACCELERATION:
    break;
  }
  return is_joined(column, "qdd.", name, "") || is_path(column, name, "/accel") ||
         is_path(column, name, "/acceleration");
}

int ambulo__motion_is_value(const char *column) {
  size_t length = strlen(column);
  if (strncmp(column, "q.", 2) == 0) return 1;
  return strncmp(column, "/jointset/", 10) == 0 && length > 6 &&
         strcmp(column + length - 6, "/value") == 0;
}

/* first row in which two columns differ, or -1 */
static int first_difference(const ambulo__motion *motion, int a, int b) {
  for (int k = 0; k < motion->rows; k++) {
    const double *row = motion->values + (size_t)k * (size_t)motion->columns;
    if (!(row[a] == row[b])) return k;
  }
  return -1;
}

ambulo_status ambulo__motion_find(const ambulo__motion *motion, const char *file,
                                  const char *coordinate, ambulo__motion_order order,
                                  ambulo_diagnostics *diagnostics, int *column) {
  int found = -1;
  for (int c = 0; c < motion->columns; c++) {
    if (!coordinate[0] || !ambulo__motion_names(motion->names[c], coordinate, order)) continue;
    int row = found < 0 ? -1 : first_difference(motion, found, c);
    if (row >= 0) {
      ambulo__place place = {.file = file};
      const double *values = motion->values + (size_t)row * (size_t)motion->columns;
      return ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, "take one of them out of the file",
                           "the columns '%s' and '%s' both stand for coordinate '%s' and differ "
                           "(%g and %g at t = %g s)",
                           motion->names[found], motion->names[c], coordinate, values[found],
                           values[c], motion->time[row]);
    }
    if (found < 0) found = c;
  }
  *column = found;
  return AMBULO_OK;
}
