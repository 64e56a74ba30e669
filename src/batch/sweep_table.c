/* batch/sweep_table.c - axes from a CSV table: one column an axis, one row a case. */
#include "base/read_file.h"
#include "batch/sweep.h"
#include "batch/paths.h"
#include "trajectory/table_text.h"

#include <string.h>

enum { MOST_TABLE_BYTES = 64 << 20 };

typedef struct table {
  ambulo_sweep *sweep;
  const char *file;
  ambulo__axis_group *group;
} table;

static ambulo_status fault(const table *t, int line, int column, const char *what, int got,
                           int expected) {
  ambulo__place place = {t->file, line, column, NULL};
  return ambulo__error(t->sweep->diagnostics, AMBULO_E_SCHEMA, place, NULL,
                       "%s (got %d); expected %d", what, got, expected);
}

static ambulo_status add_header(table *t, const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    char key[AMBULO__SWEEP_TEXT];
    if (cell.length == 0 || cell.length >= sizeof key)
      return fault(t, line->number, cell.column, "a column has no name", 0, 1);
    memcpy(key, cell.start, cell.length);
    key[cell.length] = '\0';
    if (!ambulo__sweep_add_axis(t->sweep, NULL, key)) return AMBULO_E_MEMORY;
    t->group->axes++;
  }
  return AMBULO_OK;
}

static ambulo_status add_row(table *t, const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  int column = 0, cells = ambulo__table_count_cells(line, AMBULO__CELLS_COMMA);
  if (cells != t->group->axes)
    return fault(t, line->number, 1, "number of cells", cells, t->group->axes);
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    ambulo__axis *axis = &t->sweep->axis[t->group->first + column++];
    ambulo_status status = ambulo__axis_add_text(t->sweep, axis, cell.start, cell.length);
    if (status) return status;
  }
  t->group->count++;
  return AMBULO_OK;
}

static ambulo_status read_lines(table *t, const char *text, size_t length) {
  ambulo__table_line line = {NULL, 0, 0, 0};
  ambulo_status status = AMBULO_OK;
  int header = 1;
  while (!status && ambulo__table_next_line(text, length, &line)) {
    if (ambulo__table_line_is_empty(&line) || line.start[0] == '#') continue;
    status = header ? add_header(t, &line) : add_row(t, &line);
    header = 0;
  }
  if (!status && t->group->count == 0)
    return fault(t, line.number, 1, "rows below the header", 0, 1);
  return status;
}

ambulo_status ambulo__sweep_read_table(ambulo_sweep *sweep, const ambulo__yaml_node *node) {
  const char *name = ambulo__yaml_text(node);
  if (!name) return AMBULO_E_SCHEMA;
  char *path = ambulo__sibling_path(&sweep->allocator, sweep->path, name), *text = NULL;
  size_t length = 0;
  if (!path) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__read_file(path, MOST_TABLE_BYTES, &sweep->allocator,
                                           sweep->diagnostics, &text, &length);
  table t = {sweep, path, &sweep->group[sweep->groups]};
  t.group->first = sweep->axes;
  if (!status) status = read_lines(&t, text, length);
  if (t.group->axes > 0) sweep->groups++;
  ambulo__free(&sweep->allocator, text);
  ambulo__free(&sweep->allocator, path);
  return status;
}
